//! The last stages, beyond the papers and off by default: subdivision, weathering, roughness, embedding.
//!
//! Both papers leave wear and weathering to future work. Here a rock is blended from its papers' mesh to a stone as a river or a
//! quarry leaves it: a convex [`Body`] whose half-spaces are taken from the rock itself (a side for every edge of its cell, a
//! facet for every top vertex, as far out and as high as Eqs 2 and 3 put it) and a few of its own. Every vertex keeps its place in the
//! triangulation: the cell is spread over a disc, its rim on the circle and its top vertices at the mean of their neighbours (Tutte
//! 1963, *How to draw a graph*: so no triangle turns over), the disc over a sphere, and the sphere along its rays onto the body.
//!
//! The rim itself stays on its cell and sinks into the ground; the ring next to it is drawn in below the stone's waist, so that
//! outlines are the body's, not the cell's, and the surface stays closed against the ground.

use glam::{DVec2, DVec3};

use super::body::Body;
use super::subdivide::Subdivision;
use crate::mesh::RockBuilder;
use crate::noise::noise;
use crate::params::Layer;
use crate::rng::{Purpose, Stream};

/// What the wear of a layer is a function of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wear {
    pub(crate) weathering: f64,
    pub(crate) roughness: f64,
    pub(crate) detail: u32,
    pub(crate) embedding: f64,
}

impl Wear {
    pub(crate) fn of(layer: &Layer) -> Self {
        let Layer { weathering, roughness, detail, embedding, .. } = *layer;
        Wear { weathering, roughness, detail, embedding }
    }

    /// Nothing to do: the papers' mesh as it is.
    pub(crate) fn is_none(self) -> bool {
        self == Wear { weathering: 0.0, roughness: 0.0, detail: 0, embedding: 0.0 }
    }

    /// Edges of the papers' mesh are cut into so many.
    pub(crate) fn segments(self) -> usize {
        1 << self.detail
    }
}

/// From the papers' facets (0) to broken stone; above this weathering the stone's own shape is all that is seen.
const BROKEN: f64 = 0.2;

/// How much narrower than its cell a stone may be along one axis, and how much smaller altogether, at most.
const SQUEEZE: f64 = 0.3;
const SHRINK: f64 = 0.2;

/// Tangent of the largest turn of a stone in its cell: so neighbours do not face each other along straight joints.
const TURN: f64 = 0.5;

/// Heights of a stone's parts over its own height, before it is embedded: the waist, and from there to the underside.
const WAIST: f64 = 0.42;
const UNDERSIDE: f64 = 0.5;

/// How far below the ground the rim of a worn stone lies, over its height: what is at z = 0 exactly would flicker.
const SINK: f64 = 0.04;

/// Where the noise displaces a stone most, over its radius.
const BUMPS: f64 = 0.16;

/// One rock to be worn.
pub(super) struct Rock<'a> {
    pub(super) rim: &'a [DVec2],
    /// p_add before displacement.
    pub(super) top: &'a [DVec2],
    pub(super) triangles: &'a [[u16; 3]],
    /// Per edge of the cell, whether a rock of the same layer stands behind it.
    pub(super) touches: &'a dyn Fn(usize) -> bool,
    pub(super) seed: u32,
    pub(super) layer: u32,
    pub(super) site: u32,
}

/// Wears rocks, one after the other.
#[derive(Debug, Default)]
pub(super) struct Wearer {
    pub(super) subdivision: Subdivision,
    body: Body,
    disc: Vec<DVec2>,
    sums: Vec<(DVec2, f64)>,
    corners: Vec<DVec3>,
}

impl Wearer {
    /// Replaces the displaced corners in `builder` by the worn rock's vertices; its triangles are then `subdivision.triangles`.
    pub(super) fn wear(&mut self, wear: Wear, rock: &Rock<'_>, builder: &mut RockBuilder) {
        let rim = rock.rim.len();
        self.subdivision.cut(rim, rock.triangles, wear.segments());
        core::mem::swap(&mut self.corners, &mut builder.points);
        let highest = self.corners.iter().fold(0.0_f64, |most, corner| most.max(corner.z));
        let sunk = DVec3::Z * (wear.embedding * highest);
        builder.points.clear();
        let share = blend(wear.weathering / BROKEN);
        if share == 0.0 && wear.roughness == 0.0 {
            let Subdivision { blends, segments, .. } = &self.subdivision;
            builder.points.extend(blends.iter().map(|blend| blend.of(&self.corners, *segments) - sunk));
            return;
        }

        let middle = middle(rock.rim);
        self.spread(rock, middle);
        let stone = self.shape(wear, rock, middle, highest);
        let bumps = Bumps::new(wear.roughness, rock);
        let Subdivision { blends, segments, rim: rim_vertices, .. } = &self.subdivision;
        for (v, blend) in blends.iter().enumerate() {
            let flat = blend.of(&self.corners, *segments);
            if v < *rim_vertices {
                builder.points.push(flat - DVec3::Z * (wear.embedding * highest + share * stone.sink));
                continue;
            }
            let at = blend.of(&self.disc, *segments);
            let worn = stone.at(&self.body, at, self.ring(at));
            let from_middle = (flat - stone.centre).lerp(worn, share);
            builder.points.push(stone.centre + from_middle * bumps.at(from_middle / stone.radius) - sunk);
        }
    }

    /// Places the corners on a disc, without turning a triangle over.
    fn spread(&mut self, rock: &Rock<'_>, middle: DVec2) {
        let rim = rock.rim.len();
        self.disc.clear();
        self.disc.extend(rock.rim.iter().map(|v| (*v - middle).normalize_or(DVec2::X)));
        self.disc.resize(2 * rim, DVec2::ZERO);
        // Converges by a factor of about two a round; what is left would be seen by nobody.
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
    }

    /// 0 in the middle of the disc, 1 on the chords between the rim's corners.
    fn ring(&self, at: DVec2) -> f64 {
        let rim = self.subdivision.rim / self.subdivision.segments;
        let mut most = 0.0_f64;
        for edge in 0..rim {
            let [a, b] = [self.disc[edge], self.disc[(edge + 1) % rim]];
            let outward = DVec2::new(b.y - a.y, a.x - b.x);
            most = most.max(outward.dot(at) / outward.dot(a).max(1.0e-9));
        }
        most
    }

    /// Builds the stone's body about its middle.
    fn shape(&mut self, wear: Wear, rock: &Rock<'_>, middle: DVec2, highest: f64) -> Stone {
        let Rock { rim, .. } = *rock;
        let corners = rim.len();
        let top = &self.corners[corners..];
        let worn = ((wear.weathering - BROKEN) / (1.0 - BROKEN)).clamp(0.0, 1.0);
        let mut stream = Stream::new(rock.seed, Purpose::Facets, rock.layer, rock.site);

        // As far as Eq. 2 has moved the top outward, the sides stand outside the cell.
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
            // Where rocks touch they have ground each other down.
            let gap = if (rock.touches)(i) { 0.01 + 0.05 * worn } else { 0.0 };
            let distance = (distance * (1.0 - gap) + step).max(0.25 * distance).max(least);
            // Broken sides lean, each by its own.
            let lean = (0.7 * stream.unit() - 0.2) * (1.0 - 0.7 * worn) * radius / up.max(0.3 * radius);
            let normal = turn.rotate(outward).extend(lean).normalize();
            self.body.push(normal, distance * normal.truncate().length());
            inner.push((outward, distance));
        }
        // A stone breaks along few planes; of a rounded one the facets of its top vertices are one surface with them.
        for vertex in top {
            let at = (vertex.truncate() - middle).clamp_length_max(0.85 * radius);
            let z = (vertex.z - WAIST * height).max(0.2 * up);
            let normal = (at / (radius * radius)).extend(z / (up * up)).normalize();
            self.body.push(normal, (1.08 + 0.17 * worn) * normal.dot(at.extend(z)).max(least));
        }
        for _ in 0..CUTS {
            let around = stream.direction();
            let z = 0.1 + 0.75 * stream.unit();
            let normal = (around * (1.0 - z * z).sqrt() * up).extend(z * radius).normalize();
            let reach = (normal * DVec3::new(radius, radius, up)).length();
            self.body.push(normal, reach * (0.68 + 0.3 * stream.unit() + 0.25 * worn));
        }
        let tilt = TILT * stream.unit() * (1.0 - 0.5 * worn) * up / radius;
        self.body.push((stream.direction() * tilt).extend(1.0).normalize(), up);
        self.body.push(DVec3::NEG_Z, down);

        // Rounding has made it smaller: it grows back until it touches its cell, and to its height.
        let fit = inner.iter().map(|&(outward, distance)| distance * self.body.gauge(outward.extend(0.0)));
        let share = 1.0 - SHRINK * stream.unit();
        let across = share * fit.fold(1.3_f64, f64::min);
        let along = share * self.body.gauge(DVec3::Z) * up;
        let axis = stream.direction();
        let squeeze = 1.0 - SQUEEZE * stream.unit();

        // The ring next to the rim ends below the ground, or below the waist at least.
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
            first_ring: if wear.detail == 0 { 1.15 } else { 1.0 - 0.5 / wear.segments() as f64 },
            sink: SINK * height,
        }
    }
}

/// Planes that a stone has broken along besides its top, its sides and the facets of its top vertices.
const CUTS: usize = 4;

/// How far the top may tilt, over the slope from the middle to the waist.
const TILT: f64 = 0.9;

/// What is needed to carry the disc onto the body.
struct Stone {
    centre: DVec3,
    /// Mean distance of the sides.
    radius: f64,
    /// From the waist up, and down.
    semi: [f64; 2],
    /// Across and up.
    scale: [f64; 2],
    axis: DVec2,
    squeeze: f64,
    /// √2·sin(θ/2) at the last ring, θ from the zenith.
    last: f64,
    /// Where that ring lies on the disc.
    first_ring: f64,
    sink: f64,
}

impl Stone {
    /// From the middle of the stone to where `at` of the disc comes to lie.
    fn at(&self, body: &Body, at: DVec2, ring: f64) -> DVec3 {
        // Lambert's azimuthal projection, which keeps areas: no trigonometry, and even triangles.
        let t = self.last * (ring / self.first_ring).min(1.0);
        let cos = 1.0 - t * t;
        let sin = t * (2.0 - t * t).max(0.0).sqrt();
        let around = at.normalize_or(DVec2::X) * (sin * self.radius);
        let [up, down] = self.semi;
        let ray = around.extend(cos * if cos > 0.0 { up } else { down });
        let on_body = ray / body.gauge(ray).max(1.0e-12);
        let across = on_body.truncate() * self.scale[0];
        let squeezed = across - self.axis * (self.axis.dot(across) * (1.0 - self.squeeze));
        squeezed.extend(on_body.z * self.scale[1])
    }
}

/// The noise that displaces one rock along the rays from its middle: so it can break nothing open.
struct Bumps {
    amplitude: f64,
    offset: DVec3,
}

impl Bumps {
    fn new(roughness: f64, rock: &Rock<'_>) -> Self {
        let mut stream = Stream::new(rock.seed, Purpose::Bumps, rock.layer, rock.site);
        let offset = DVec3::new(stream.unit(), stream.unit(), stream.unit()) * 512.0;
        Bumps { amplitude: BUMPS * roughness, offset }
    }

    /// The factor for a point in radii from the middle.
    fn at(&self, from_middle: DVec3) -> f64 {
        if self.amplitude == 0.0 {
            return 1.0;
        }
        let ray = from_middle.normalize_or(DVec3::Z);
        let octave = |frequency: f64| noise(ray * frequency + self.offset);
        1.0 + self.amplitude * (octave(1.4) + 0.5 * octave(3.1) + 0.3 * octave(6.7))
    }
}

/// 0 at 0, 1 from 1 on, smooth at both ends.
fn blend(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The centroid of a polygon's outline: inside, whatever the polygon, and without a division by its area.
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
