//! Subdivision, weathering, roughness and embedding of rocks. They go beyond the papers and are off by default.
//!
//! Both papers leave wear and weathering to future work. Here a rock is a blend of the papers' mesh and a stone as
//! found in a river or a quarry. The stone is a convex [`Body`]. Most of its half-spaces are taken from the rock
//! itself: a side for every edge of its cell, and a facet for every top vertex, as far out and as high as Eqs 2 and 3
//! put it; a few more are drawn at random. The vertices lie on a disc with the rim on its circle, the disc is mapped to a
//! sphere, and the sphere along its rays to the body. Where nothing of the papers' mesh is left, they are those of a net
//! of even triangles (see `net.rs`). Where some of it is, or a rock is not cut, every vertex keeps its place in the
//! papers' triangulation: the top vertices are at the mean of their neighbours (Tutte 1963, *How to draw a graph*, so no
//! triangle turns over).
//!
//! The rim stays on its cell and sinks into the ground. The ring of vertices next to it is drawn in below the stone's
//! waist. Outlines are therefore those of the body and not those of the cell, and the surface stays closed against the
//! ground.

use glam::{DVec2, DVec3};

use super::body::Body;
use super::mesh::RockBuilder;
use super::net::Net;
use super::relief::Relief;
use super::stone::Stone;
use super::subdivide::Subdivision;
use crate::params::Layer;
use crate::rng::{Purpose, Stream};

/// The parameters of a layer that its wear depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wear {
    pub(crate) weathering: f64,
    pub(crate) roughness: f64,
    pub(crate) detail: f64,
    pub(crate) embedding: f64,
}

impl Wear {
    pub(crate) fn of(layer: &Layer) -> Self {
        // Without `..`, so that a new parameter of a layer does not compile before it is known whether the mesh depends
        // on it. The others belong to the keys of earlier stages, or are passed beside the wear.
        let Layer {
            weathering,
            roughness,
            detail,
            embedding,
            id: _,
            radius: _,
            area_fraction: _,
            cell_count: _,
            taper: _,
            height: _,
            material: _,
        } = *layer;
        Wear { weathering, roughness, detail, embedding }
    }

    /// Whether nothing has to be done, so that the papers' mesh stays as it is.
    pub(crate) fn is_none(self) -> bool {
        self == Wear { weathering: 0.0, roughness: 0.0, detail: 0.0, embedding: 0.0 }
    }

    /// Whether the faces at the rim of a rock whose edges are cut into this number of segments lie below the ground, where nobody sees
    /// them.
    pub(super) fn buries_rim(self, segments: usize) -> bool {
        self.weathering > 0.0 && segments > 1
    }

    /// How rounded a stone is: 0 freshly broken, 1 by a river.
    fn worn(self) -> f64 {
        ((self.weathering - BROKEN) / (1.0 - BROKEN)).clamp(0.0, 1.0)
    }
}

/// At this weathering only the shape of the broken stone is left. Below it, the papers' mesh (at 0) is blended in.
const BROKEN: f64 = 0.2;

/// The largest shares by which a stone may be narrower than its cell along one axis, and smaller altogether.
const SQUEEZE: f64 = 0.3;
const SHRINK: f64 = 0.2;

/// Tangent of the largest angle by which a stone is turned in its cell, so that neighbours do not face each other along
/// straight joints.
const TURN: f64 = 0.5;

/// Heights of a stone's parts, relative to its own height before it is embedded: of the waist above the ground, and
/// from the waist down to the underside.
const WAIST: f64 = 0.42;
const UNDERSIDE: f64 = 0.5;

/// Depth of a worn stone's rim below the ground, relative to its height. At z = 0 exactly it would flicker against the
/// ground.
const SINK: f64 = 0.04;

/// The same of a stone that is not cut: its sides go down to the rim, and are the steeper the deeper that is.
const SINK_UNCUT: f64 = 0.9;

/// How far out on the disc the outermost top vertices are: of a stone that is not cut, whose edges are cut in two, and of others.
const WIDEST_UNCUT: f64 = 0.8;
const WIDEST_HALVED: f64 = 0.62;
const WIDEST: f64 = 0.55;

/// A stone is at most so many times as high as its cell is wide: broken ones may stand, rounded ones lie.
const STANDS: f64 = 0.8;
const LIES: f64 = 0.42;

/// The rock to be worn.
pub(super) struct Rock<'a> {
    /// Number of segments into which each edge of the papers' mesh is cut.
    pub(super) segments: usize,
    pub(super) rim: &'a [DVec2],
    /// The points p_add before displacement, px.
    pub(super) top: &'a [DVec2],
    pub(super) triangles: &'a [[u16; 3]],
    /// Returns whether a rock of the same layer stands behind this edge of the cell.
    pub(super) touches: &'a dyn Fn(usize) -> bool,
    pub(super) seed: u32,
    pub(super) layer: u32,
    pub(super) site: u32,
}

/// Wears rocks, one after the other, re-using its buffers.
#[derive(Debug, Default)]
pub(super) struct Wearer {
    pub(super) subdivision: Subdivision,
    net: Net,
    body: Body,
    disc: Vec<DVec2>,
    /// Per edge of the cell, what a point of the disc is multiplied by to give 1 on its chord.
    chords: Vec<DVec2>,
    sums: Vec<(DVec2, f64)>,
    corners: Vec<DVec3>,
}

impl Wearer {
    /// Replaces the displaced corners in `builder` by the vertices of the worn rock. Its triangles are then
    /// `subdivision.triangles`.
    pub(super) fn wear(&mut self, wear: Wear, rock: &Rock<'_>, builder: &mut RockBuilder) {
        let rim = rock.rim.len();
        let middle = middle(rock.rim);
        let share = blend(wear.weathering / BROKEN);
        let has_net = share == 1.0 && rock.segments > 1 && self.net.lay(rock.rim, middle);
        self.subdivision.cut(rim, if has_net { &self.net.triangles } else { rock.triangles }, rock.segments);
        core::mem::swap(&mut self.corners, &mut builder.points);
        let highest = self.corners.iter().fold(0.0_f64, |most, corner| most.max(corner.z));
        builder.points.clear();
        let height = highest.min(most_height(rock.rim, wear.worn()));
        let sunk = DVec3::Z * (wear.embedding * (highest + (height - highest) * share));
        if share == 0.0 && wear.roughness == 0.0 {
            let Subdivision { blends, segments, .. } = &self.subdivision;
            builder.points.extend(blends.iter().map(|blend| blend.of(&self.corners, *segments) - sunk));
            return;
        }

        if !has_net {
            self.spread(rock, middle);
        }
        let stone = self.shape(wear, rock, middle, height);
        let relief = Relief::new(wear.roughness, wear.worn(), rock.segments, [rock.seed, rock.layer, rock.site]);
        let smooth = relief.is_none();
        let Subdivision { blends, segments, rim: rim_vertices, .. } = &self.subdivision;
        for (v, blend) in blends.iter().enumerate() {
            if v < *rim_vertices {
                builder.points.push(blend.of(&self.corners, *segments) - sunk - DVec3::Z * (share * stone.sink));
                continue;
            }
            let least = blend.rim_share(rim, *segments) * stone.last_ring;
            let from_middle = if has_net {
                let mut at = self.net.place(blend, *segments);
                if stone.is_sharp {
                    at += stone.slide(&self.body, at, self.net.steps(at, *segments));
                }
                stone.at(&self.body, at, at.length().max(least))
            } else {
                let at = blend.of(&self.disc, *segments);
                let worn = stone.at(&self.body, at, self.ring(at).max(least));
                let flat = blend.of(&self.corners, *segments);
                (flat - stone.centre).lerp(worn, share)
            };
            let out = if smooth { 1.0 } else { relief.at(from_middle / stone.radius) };
            builder.points.push(stone.centre + from_middle * out - sunk);
        }
    }

    /// Maps the corners to a disc without turning a triangle over; the result is in `disc`.
    fn spread(&mut self, rock: &Rock<'_>, middle: DVec2) {
        let rim = rock.rim.len();
        self.disc.clear();
        self.disc.extend(rock.rim.iter().map(|v| (*v - middle).normalize_or(DVec2::X)));
        self.disc.resize(2 * rim, DVec2::ZERO);
        // The error falls by a factor of about two per round. What is left after ten is not visible.
        for _ in 0..10 {
            self.sums.clear();
            self.sums.resize(2 * rim, (DVec2::ZERO, 0.0));
            for triangle in rock.triangles {
                let [a, b, c] = triangle.map(usize::from);
                for [v, next, last] in [[a, b, c], [b, c, a], [c, a, b]] {
                    let (sum, count) = &mut self.sums[v];
                    *sum += self.disc[next] + self.disc[last];
                    *count += 2.0;
                }
            }
            for (place, (sum, count)) in self.disc.iter_mut().zip(&self.sums).skip(rim) {
                *place = *sum / count.max(1.0);
            }
        }
        self.chords.clear();
        self.chords.extend((0..rim).map(|edge| {
            let [a, b] = [self.disc[edge], self.disc[(edge + 1) % rim]];
            let outward = DVec2::new(b.y - a.y, a.x - b.x);
            outward / outward.dot(a).max(1.0e-9)
        }));
        // The outermost top vertices stand where the stone is widest, or near there if more vertices follow.
        let outermost = self.disc[rim..].iter().fold(0.0_f64, |most, &at| most.max(self.ring(at)));
        let widest = match rock.segments {
            1 => WIDEST_UNCUT,
            2 => WIDEST_HALVED,
            _ => WIDEST,
        };
        let scale = widest / outermost.max(0.05);
        self.disc[rim..].iter_mut().for_each(|at| *at *= scale);
    }

    /// Breaks flakes off the edges of the body.
    fn chip(&mut self, stream: &mut Stream, [radius, up]: [f64; 2], worn: f64) {
        let fresh = (1.0 - worn) * (1.0 - worn);
        for _ in 0..(CHIPS as f64 * fresh) as usize {
            // Of a few directions that which is nearest to an edge.
            let (mut at, mut nearest) = (DVec3::Z, -1.0);
            for _ in 0..5 {
                let z = stream.unit();
                let candidate = (stream.direction() * ((1.0 - z * z).sqrt() * radius)).extend(z * up);
                let edge = self.body.edge(candidate);
                if edge > nearest {
                    (at, nearest) = (candidate, edge);
                }
            }
            let [wide, deep] = [CHIPS_WIDE, CHIPS_DEEP].map(|[least, range]| {
                let share = stream.unit();
                least + range * share * share
            });
            self.body.chip(at, wide * radius, deep * radius * fresh);
        }
    }

    /// How far out a point of the disc is: 0 in the middle, 1 on the chords between the rim's corners.
    #[inline(never)]
    fn ring(&self, at: DVec2) -> f64 {
        self.chords.iter().fold(0.0_f64, |most, chord| most.max(chord.dot(at)))
    }

    /// Builds the body of the stone around its middle and returns how to map the disc onto it. `highest` is the height
    /// of the stone above the ground before it is embedded, px.
    fn shape(&mut self, wear: Wear, rock: &Rock<'_>, middle: DVec2, highest: f64) -> Stone {
        let Rock { rim, .. } = *rock;
        let corners = rim.len();
        let top = &self.corners[corners..];
        let worn = wear.worn();
        let mut stream = Stream::new(rock.seed, Purpose::Facets, rock.layer, rock.site);

        // The sides stand outside the cell by as much as Eq. 2 has moved the top outward on average.
        let outward = |p: DVec2| (p - middle).length();
        let moved = top.iter().zip(rock.top).map(|(after, before)| outward(after.truncate()) - outward(*before));
        let step = moved.sum::<f64>() / top.len() as f64;
        let edges = (0..corners).map(|i| (rim[i], rim[(i + 1) % corners]));
        let sides: Vec<(DVec2, f64)> = edges
            .map(|(a, b)| {
                let outward = DVec2::new(b.y - a.y, a.x - b.x).normalize_or(DVec2::X);
                (outward, outward.dot(a - middle))
            })
            .collect();
        let radius = sides.iter().map(|(_, distance)| distance).sum::<f64>() / corners as f64;
        let least = 1.0e-3 * radius + 1.0e-9;
        let height = highest.max(least);
        let (up, down) = (height * (1.0 - WAIST), height * UNDERSIDE);

        self.body.start(worn);
        let turn = DVec2::new(1.0, TURN * (2.0 * stream.unit() - 1.0)).normalize();
        let mut inner = Vec::with_capacity(corners);
        for (i, &(outward, distance)) in sides.iter().enumerate() {
            // Rocks that touch have ground each other down.
            let gap = if (rock.touches)(i) { GAP + GAP_WORN * worn } else { 0.0 };
            let distance = (distance * (1.0 - gap) + step).max(LEAST_SIDE * distance).max(least);
            // Broken sides lean, each by its own random amount.
            let lean = (LEANS * stream.unit() - LEANS_INWARD) * (1.0 - UPRIGHT_WORN * worn);
            let lean = lean * radius / up.max(LEAST_HEIGHT * radius);
            let normal = turn.rotate(outward).extend(lean).normalize();
            self.body.push(normal, distance * normal.truncate().length());
            inner.push((outward, distance));
        }
        // A stone breaks along few planes. On a rounded stone, the facets of the top vertices merge into one surface
        // with those planes.
        for vertex in top {
            let at = (vertex.truncate() - middle).clamp_length_max(FACETS_WITHIN * radius);
            let z = (vertex.z - WAIST * height).max(FACETS_ABOVE * up);
            let normal = (at / (radius * radius)).extend(z / (up * up)).normalize();
            self.body.push(normal, (FACETS_OUT + FACETS_OUT_WORN * worn) * normal.dot(at.extend(z)).max(least));
        }
        for _ in 0..CUTS {
            let around = stream.direction();
            let z = CUTS_UP + CUTS_STEEPER * stream.unit();
            let normal = (around * (1.0 - z * z).sqrt() * up).extend(z * radius).normalize();
            let reach = (normal * DVec3::new(radius, radius, up)).length();
            self.body.push(normal, reach * (CUTS_OUT + CUTS_VARY * stream.unit() + CUTS_OUT_WORN * worn));
        }
        let tilt = TILT * stream.unit() * (1.0 - LEVEL_WORN * worn) * up / radius;
        self.body.push((stream.direction() * tilt).extend(1.0).normalize(), up);
        self.body.push(DVec3::NEG_Z, down);

        // Rounding has made the body smaller, so it is enlarged until it touches its cell and reaches its height.
        let fit = inner.iter().map(|&(outward, distance)| distance * self.body.gauge(outward.extend(0.0)));
        let share = 1.0 - SHRINK * stream.unit();
        let across = share * fit.fold(MOST_WIDENED, f64::min);
        let along = share * self.body.gauge(DVec3::Z) * up;
        let axis = stream.direction();
        let squeeze = 1.0 - SQUEEZE * stream.unit();

        if rock.segments >= CHIPPED_FROM {
            self.chip(&mut stream, [radius, up], worn);
        }

        // The ring next to the rim ends below the ground, or at least below the waist.
        let [waist, below] = [(WAIST - wear.embedding) * height, 0.03 * height];
        let dip = ((waist + below) / down).clamp(0.12, 0.9);
        Stone {
            centre: middle.extend(WAIST * height),
            radius,
            semi: [up, down],
            scale: [across, along],
            axis,
            squeeze,
            last: (1.0 + dip).sqrt(),
            first_ring: 1.0 - if rock.segments == 1 { 0.0 } else { 0.5 / rock.segments as f64 },
            last_ring: if rock.segments == 1 {
                0.0
            } else {
                (rock.segments as f64 - 0.5) / (rock.segments as f64 - 1.0)
            },
            is_sharp: worn < SHARP && rock.segments > 1,
            near_edge: 1.0 - NEAR_EDGE / rock.segments as f32,
            sink: if rock.segments == 1 { SINK_UNCUT } else { SINK } * height,
        }
    }
}

/// How finely a stone has to be cut for its chips to be seen.
const CHIPPED_FROM: usize = 16;

/// Below this wear, vertices slide to the edges of a stone.
const SHARP: f64 = 0.4;

/// By how much two planes may differ in height for their edge to be near, times the segments.
const NEAR_EDGE: f32 = 1.3;

/// Number of chips, and their radii and depths, in radii of the stone: least and range.
const CHIPS: usize = 12;
const CHIPS_WIDE: [f64; 2] = [0.3, 1.0];
const CHIPS_DEEP: [f64; 2] = [0.03, 0.1];

// The numbers below are chosen by eye. Those whose names end with `WORN` are what a fully rounded stone has in addition,
// or is lacking.

/// How much of a side rocks that touch have ground away, as a share of its distance from the middle.
const GAP: f64 = 0.01;
const GAP_WORN: f64 = 0.05;

/// Least distance of a side from the middle after Eq. 2 has moved it, as a share of its distance in the cell.
const LEAST_SIDE: f64 = 0.25;

/// Width of the range in which sides lean, and how much of it is inward; both are slopes, relative to the radius over
/// the height above the waist. That height counts as at least `LEAST_HEIGHT` radii.
const LEANS: f64 = 0.7;
const LEANS_INWARD: f64 = 0.2;
const UPRIGHT_WORN: f64 = 0.7;
const LEAST_HEIGHT: f64 = 0.3;

/// Where the facets of the top vertices touch the stone: at most this far from the middle, in radii, and at least this
/// high above the waist, as a share of the height above it. They are moved outward by the factors `FACETS_OUT`.
const FACETS_WITHIN: f64 = 0.85;
const FACETS_ABOVE: f64 = 0.2;
const FACETS_OUT: f64 = 1.24;
const FACETS_OUT_WORN: f64 = 0.01;

/// Number of planes that a stone has broken along, besides its top, its sides and the facets of its top vertices.
const CUTS: usize = 4;

/// The planes' normals on the unit sphere: least height, and range of heights above it.
const CUTS_UP: f64 = 0.1;
const CUTS_STEEPER: f64 = 0.75;

/// Distances of the planes from the middle, relative to the ellipsoid around it: least distance and range.
const CUTS_OUT: f64 = 0.6;
const CUTS_VARY: f64 = 0.38;
const CUTS_OUT_WORN: f64 = 0.33;

/// Largest tilt of the top, relative to the slope from the middle to the waist.
const TILT: f64 = 0.9;
const LEVEL_WORN: f64 = 0.5;

/// The most by which a body is widened so that it touches its cell.
const MOST_WIDENED: f64 = 1.3;

/// A smooth step: 0 up to t = 0, 1 from t = 1 on, with slope 0 at both ends.
fn blend(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The most that a stone on this cell can be high.
fn most_height(rim: &[DVec2], worn: f64) -> f64 {
    let corners = rim.len();
    let width = |i: usize| {
        let (a, b) = (rim[i], rim[(i + 1) % corners]);
        let inward = DVec2::new(a.y - b.y, b.x - a.x).normalize_or(DVec2::X);
        rim.iter().fold(0.0_f64, |most, &corner| most.max(inward.dot(corner - a)))
    };
    let narrowest = (0..corners).map(width).fold(f64::INFINITY, f64::min);
    (STANDS + (LIES - STANDS) * worn) * narrowest
}

/// The centroid of a polygon's outline. It is inside the polygon if that is convex, and needs no division by an area,
/// which may be 0.
fn middle(rim: &[DVec2]) -> DVec2 {
    let mut sum = DVec2::ZERO;
    let mut length = 0.0;
    for (i, a) in rim.iter().enumerate() {
        let b = rim[(i + 1) % rim.len()];
        let edge = (b - *a).length();
        sum += (*a + b) * (0.5 * edge);
        length += edge;
    }
    sum / length
}
