//! Keeps rocks apart: no two of them pass through each other. This goes beyond the papers and is off by default.
//!
//! In the papers, a rock stays within its cell at the ground, but its top may lean out of it (decision A14), into the rocks beside it. Here, each
//! pair of rocks that could meet gets a plane between them. It stands on a line that separates their cells at the ground, and leans over the one or the
//! other so that the least is cut off from both. Where a vertex is beyond a plane, it is drawn towards the vertical axis over the rock's site, at its own
//! height, until it is not. All vertices of a rock are then on its own side of the plane, therefore its triangles are, too: nothing has to be tried out.
//!
//! A line that separates two convex polygons runs along an edge of one of them (the separating axis theorem in the plane; Gottschalk,
//! Lin & Manocha 1996, *OBBTree*).

use core::ops::Range;

use glam::{DVec2, DVec3, Vec3};

use super::bitmap::Pixel;
use super::cache::LayerCache;
use super::grid::Grid;
use super::mesh::{Extent, Mesh, RockBuilder};
use super::subdivide::Fineness;
use super::wear::Wear;

/// A plane leans over a rock by at most this share of the way from its line to the rock's axis, so that everything can
/// be drawn in far enough.
const MOST_LEAN: f64 = 0.7;

/// A rock reaches at most so many times as far as the farthest corner of its cell. Without a limit, every rock could
/// meet all others.
const MOST_REACH: f64 = 2.0;

/// What is not higher than this share of the rock counts as its foot.
const FOOT: f64 = 0.01;

/// Number of vertices that are looked at together.
const BLOCK: usize = 16;

/// How often the lean of a plane is improved.
const ROUNDS: usize = 3;

/// What the rocks of one layer are found by.
#[derive(Debug)]
struct Ground {
    /// The sites on which rocks stand, by their place in the selection.
    grid: Grid,
    /// Number of the layer's first rock.
    first: usize,
    /// The largest distance along x or y from a rock's axis to one of its vertices, px.
    reach: f64,
}

/// A rock's box, px, and the height of its lowest and its highest vertex.
#[derive(Debug, Clone, Copy)]
struct Extents {
    min: Vec3,
    max: Vec3,
}

impl Extents {
    const EMPTY: Extents = Extents { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    fn meet(&self, other: &Extents) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

/// One of the two rocks of a pair.
struct Rock<'a> {
    layer: usize,
    cell: &'a [DVec2],
    axis: DVec2,
    vertices: Range<usize>,
    extents: Extents,
}

/// A vertex relative to the line between two rocks: how far it is beyond the line, and how high above its foot.
#[derive(Debug, Clone, Copy, Default)]
struct Beyond {
    vertex: u32,
    out: f64,
    up: f64,
}

/// The steps of the work: each goes through all rocks.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    Measure,
    Separate,
    Draw,
}

/// Draws rocks apart, some of them per step.
#[derive(Debug)]
pub(super) struct Separator {
    /// What is in the buffers.
    pub(super) of: Extent,
    step: Step,
    /// Number of the next rock.
    rock: usize,
    grounds: Vec<Ground>,
    extents: Vec<Extents>,
    /// Boxes of up to [`BLOCK`] consecutive vertices of a rock each; those of rock k begin at [`first_block`].
    blocks: Vec<Extents>,
    /// Per vertex, the share of its distance from the axis that is kept.
    kept: Vec<f32>,
    /// The gap between two rocks that touch, px: wider than what positions are rounded by.
    gap: f64,
    /// The rocks that could meet the present one.
    near: Vec<usize>,
    beyond: [Vec<Beyond>; 2],
    builder: RockBuilder,
    faces: Vec<[u16; 3]>,
}

impl Separator {
    /// `longer` is the longer side of the image, px.
    pub(super) fn new(layers: &[LayerCache], of: Extent, longer: u32) -> Self {
        let mut first = 0;
        let grounds = layers
            .iter()
            .map(|cache| {
                let (sites, selected) = (&cache.sites.value, &cache.selection.value.selected);
                let pixels: Vec<Pixel> = selected.iter().map(|&site| sites.pixels[site as usize]).collect();
                first += selected.len();
                let grid = Grid::new(sites.width, sites.height, sites.radius as u32, &pixels);
                Ground { grid, first: first - selected.len(), reach: 0.0 }
            })
            .collect();
        Separator {
            of,
            step: Step::Measure,
            rock: 0,
            grounds,
            extents: Vec::with_capacity(of.rocks),
            blocks: vec![Extents::EMPTY; of.vertices / BLOCK + of.rocks],
            kept: vec![1.0; of.vertices],
            gap: f64::from(longer) / f64::from(1 << 22),
            near: Vec::new(),
            beyond: [Vec::new(), Vec::new()],
            builder: RockBuilder::default(),
            faces: Vec::new(),
        }
    }

    pub(super) fn progress(&self) -> f64 {
        (self.step as usize as f64 + self.rock as f64 / self.of.rocks.max(1) as f64) / 3.0
    }

    /// Works on rocks until about `count` vertices have been looked at. Returns true when all rocks are apart.
    #[inline(never)]
    pub(super) fn advance(&mut self, layers: &[LayerCache], mesh: &mut Mesh, count: usize) -> bool {
        let mut left = count;
        while left > 0 && self.rock < mesh.rocks() {
            let looked_at = match self.step {
                Step::Measure => self.measure(layers, mesh),
                Step::Separate => self.separate(layers, mesh),
                Step::Draw => self.draw(layers, mesh),
            };
            self.rock += 1;
            left = left.saturating_sub(looked_at);
        }
        if self.rock < mesh.rocks() {
            return false;
        }
        self.rock = 0;
        self.step = match self.step {
            Step::Measure => Step::Separate,
            Step::Separate => Step::Draw,
            Step::Draw => return true,
        };
        false
    }

    /// Draws in what reaches too far, and measures the rock.
    fn measure(&mut self, layers: &[LayerCache], mesh: &mut Mesh) -> usize {
        let layer = usize::from(mesh.rock_layer[self.rock]);
        let (cell, axis) = self.place(layers, layer, self.rock);
        let most = MOST_REACH * cell.iter().map(|corner| corner.distance_squared(axis)).fold(0.0, f64::max).sqrt();
        let vertices = vertices_of(mesh, self.rock);
        let mut extents = Extents::EMPTY;
        let blocks = first_block(&vertices, self.rock)..;
        for (block, from) in blocks.zip(vertices.clone().step_by(BLOCK)) {
            let around = &mut self.blocks[block];
            for vertex in from..(from + BLOCK).min(vertices.end) {
                let mut at = position(mesh, vertex);
                let away = at.truncate() - axis;
                if away.length_squared() > most * most {
                    at = (axis + away * (most / away.length())).extend(at.z);
                    mesh.positions[3 * vertex..3 * vertex + 3].copy_from_slice(&at.as_vec3().to_array());
                    // So that the rock's normals are computed again.
                    self.kept[vertex] = 1.0_f32.next_down();
                }
                around.min = around.min.min(at.as_vec3());
                around.max = around.max.max(at.as_vec3());
            }
            extents.min = extents.min.min(around.min);
            extents.max = extents.max.max(around.max);
        }
        let [low, high] = [extents.min, extents.max].map(|end| (end.as_dvec3().truncate() - axis).abs().max_element());
        let ground = &mut self.grounds[layer];
        ground.reach = ground.reach.max(low).max(high);
        self.extents.push(extents);
        vertices.len()
    }

    /// Finds the planes between the rock and all that come after it.
    fn separate(&mut self, layers: &[LayerCache], mesh: &Mesh) -> usize {
        let layer = usize::from(mesh.rock_layer[self.rock]);
        let own = self.extents[self.rock];
        let mut looked_at = 16;
        for other in layer..layers.len() {
            let Ground { grid, first, reach } = &self.grounds[other];
            if grid.order().is_empty() {
                continue;
            }
            let (first, reach) = (*first, *reach as f32);
            let bucket = |at: f32, count: u32| ((at.max(0.0) as u32) / grid.side).min(count - 1);
            let [left, right] = [own.min.x - reach, own.max.x + reach].map(|x| bucket(x, grid.columns));
            let [low, high] = [own.min.y - reach, own.max.y + reach].map(|y| bucket(y, grid.rows));
            self.near.clear();
            for row in low..=high {
                let rocks = grid.run(row, left, right).iter().map(|k| first + *k as usize);
                self.near.extend(rocks.filter(|&rock| rock > self.rock && self.extents[rock].meet(&own)));
            }
            looked_at += 8 * self.near.len();
            let near = core::mem::take(&mut self.near);
            for &rock in &near {
                looked_at += self.divide(layers, mesh, [self.rock, rock]);
            }
            self.near = near;
        }
        looked_at
    }

    /// Puts a plane between two rocks. Returns how many vertices were looked at.
    fn divide(&mut self, layers: &[LayerCache], mesh: &Mesh, pair: [usize; 2]) -> usize {
        let [a, b] = pair.map(|rock| {
            let layer = usize::from(mesh.rock_layer[rock]);
            let (cell, axis) = self.place(layers, layer, rock);
            Rock { layer, cell, axis, vertices: vertices_of(mesh, rock), extents: self.extents[rock] }
        });
        let (normal, distance) = line_between(&a, &b);
        // How far each axis is from the line, and how high each rock is above the foot of the plane.
        let room = [distance - normal.dot(a.axis), normal.dot(b.axis) - distance];
        let foot = f64::from(a.extents.min.z.min(b.extents.min.z));
        let height = [&a, &b].map(|rock| (f64::from(rock.extents.max.z) - foot).max(1.0e-9));
        let most = [0, 1].map(|side| MOST_LEAN * room[side] / height[side]);

        // The least lean of the plane over the other rock that leaves all of a rock as it is. The smaller rock comes first: of
        // the larger one only what that one's plane would cut off is of interest.
        let mut wanted = [f64::INFINITY; 2];
        let smaller = usize::from(a.vertices.len() > b.vertices.len());
        for side in [smaller, 1 - smaller] {
            let (rock, sign) = if side == 0 { (&a, 1.0) } else { (&b, -1.0) };
            let over = wanted[1 - side].max(-most[1 - side]).min(most[side]);
            wanted[side] =
                self.look_beyond(mesh, [pair[side], side], rock, (sign * normal, sign * distance), [foot, over]);
        }
        let weight = [0, 1].map(|side| {
            let of: &Rock<'_> = [&a, &b][side];
            1.0 / (of.vertices.len() as f64 * height[side] * room[side])
        });
        // Over the first rock the lean is negative, over the second it is positive.
        let lean = self.best_lean([-wanted[1], wanted[0]].map(|lean| lean.max(-most[0]).min(most[1])), weight);
        for side in [0, 1] {
            let lean = if side == 0 { lean } else { -lean };
            for beyond in &self.beyond[side] {
                let over = lean * beyond.up;
                if beyond.out > over {
                    // `out` counts the gap, the way from the axis does not.
                    let share = (room[side] - self.gap + over) / (room[side] - self.gap + beyond.out);
                    let kept = &mut self.kept[beyond.vertex as usize];
                    *kept = kept.min(share as f32);
                }
            }
        }
        a.vertices.len() + b.vertices.len()
    }

    /// Lists, in `beyond[side]`, the vertices of a rock that a plane would cut off which stands on the line and leans over the rock by
    /// `over` px for every px above `foot`. Returns by how much the plane has to lean over the other rock instead to cut off none of them,
    /// `−over` if there are none.
    ///
    /// `number` is the rock's, `side` 0 or 1 its place in the pair; `normal` has unit length and points to the other rock, and `distance`
    /// is the line's from the origin along it, px.
    #[inline(never)]
    fn look_beyond(
        &mut self,
        mesh: &Mesh,
        [number, side]: [usize; 2],
        rock: &Rock<'_>,
        (normal, distance): (DVec2, f64),
        [foot, over]: [f64; 2],
    ) -> f64 {
        let beyond = &mut self.beyond[side];
        beyond.clear();
        let mut steepest = -over;
        let low = FOOT * (f64::from(rock.extents.max.z) - foot);
        let plane = DVec3::from((normal, over));
        let start = distance - self.gap;
        let most = start + over * foot;
        let is_negative = plane.as_vec3().cmplt(Vec3::ZERO);
        let first = first_block(&rock.vertices, number);
        for (block, from) in (first..).zip(rock.vertices.clone().step_by(BLOCK)) {
            // The corner of the box that is farthest beyond.
            let Extents { min, max } = self.blocks[block];
            if plane.dot(Vec3::select(is_negative, min, max).as_dvec3()) <= most {
                continue;
            }
            let to = (from + BLOCK).min(rock.vertices.end);
            let mut found = beyond.len();
            // A branch for every vertex would often be predicted wrong.
            beyond.resize(found + BLOCK, Beyond::default());
            for (vertex, at) in (from as u32..).zip(mesh.positions[3 * from..3 * to].chunks_exact(3)) {
                let at = Vec3::from_slice(at).as_dvec3();
                let (out, up) = (normal.dot(at.truncate()) - start, at.z - foot);
                beyond[found] = Beyond { vertex, out, up };
                found += usize::from(out > -over * up);
                // Whatever the lean, a vertex at the foot has to be on its side of the line.
                steepest = steepest.max(if up > low { out / up } else { -over });
            }
            beyond.truncate(found);
        }
        steepest
    }

    /// The lean between two others at which the least is cut off from both rocks together, by the sum of squares, each weighted. At the
    /// first of them nothing is cut off from the second rock, at the other nothing from the first; if they are in the other order,
    /// nothing is cut off between them.
    fn best_lean(&self, [least, most]: [f64; 2], weight: [f64; 2]) -> f64 {
        let mut lean = 0.5 * (least + most);
        if least >= most {
            return lean;
        }
        // Newton's method: among vertices that are cut, the sum is a parabola.
        for _ in 0..ROUNDS {
            let (mut slope, mut bend) = (0.0, 0.0);
            for (side, lean) in [(0, lean), (1, -lean)] {
                let [mut own_slope, mut own_bend] = [0.0, 0.0];
                for Beyond { out, up, .. } in &self.beyond[side] {
                    let cut = (out - lean * up).max(0.0);
                    own_slope += cut * up;
                    own_bend += if cut > 0.0 { up * up } else { 0.0 };
                }
                slope += if side == 0 { weight[side] * own_slope } else { -weight[side] * own_slope };
                bend += weight[side] * own_bend;
            }
            if bend == 0.0 {
                break;
            }
            lean = (lean + slope / bend).max(least).min(most);
        }
        lean
    }

    /// Moves the rock's vertices, and computes its normals again if any of them has moved.
    fn draw(&mut self, layers: &[LayerCache], mesh: &mut Mesh) -> usize {
        let vertices = vertices_of(mesh, self.rock);
        if self.kept[vertices.clone()].iter().all(|&kept| kept == 1.0) {
            return vertices.len() / 8;
        }
        let layer = usize::from(mesh.rock_layer[self.rock]);
        let (cell, axis) = self.place(layers, layer, self.rock);
        let buried = layers[layer].layer.as_ref().map_or(0, |of| {
            let segments = Fineness::new(of.detail, of.height).segments(cell);
            if Wear::of(of).buries_rim(segments) { cell.len() * segments } else { 0 }
        });
        self.builder.points.clear();
        for vertex in vertices.clone() {
            let at = position(mesh, vertex);
            let away = at.truncate() - axis;
            let moved = (axis + away * f64::from(self.kept[vertex])).extend(at.z);
            let written = if self.kept[vertex] < 1.0 { moved.as_vec3() } else { at.as_vec3() };
            mesh.positions[3 * vertex..3 * vertex + 3].copy_from_slice(&written.to_array());
            self.builder.points.push(written.as_dvec3());
        }
        self.faces.clear();
        let indices = &mesh.indices[mesh.rock_starts[self.rock] as usize..mesh.rock_starts[self.rock + 1] as usize];
        let face = |corners: &[u32]| [corners[0], corners[1], corners[2]].map(|v| (v as usize - vertices.start) as u16);
        self.faces.extend(indices.chunks_exact(3).map(face));
        self.builder.finish(&self.faces, buried);
        mesh.write_normals(vertices.start, &self.builder);
        4 * vertices.len()
    }

    /// The cell and the axis of a rock.
    #[inline(never)]
    fn place<'a>(&self, layers: &'a [LayerCache], layer: usize, rock: usize) -> (&'a [DVec2], DVec2) {
        let cache = &layers[layer];
        let site = cache.selection.value.selected[rock - self.grounds[layer].first] as usize;
        let axis = DVec2::from(cache.sites.value.pixels[site].map(f64::from)) + 0.5;
        (cache.cells.value.polygon(site), axis)
    }
}

fn vertices_of(mesh: &Mesh, rock: usize) -> Range<usize> {
    mesh.vertex_starts[rock] as usize..mesh.vertex_starts[rock + 1] as usize
}

/// The place of the first block of a rock with these vertices. No rock has more blocks than lie between its own and the next one's.
fn first_block(vertices: &Range<usize>, rock: usize) -> usize {
    vertices.start / BLOCK + rock
}

fn position(mesh: &Mesh, vertex: usize) -> DVec3 {
    Vec3::from_slice(&mesh.positions[3 * vertex..3 * vertex + 3]).as_dvec3()
}

/// The line between two cells, in the middle of the widest gap along an edge of one of them: its unit normal, towards
/// the second cell, and its distance from the origin along it.
///
/// Cells of layers whose radii are about a pixel overlap, since cells exclude each other by pixels (decision A9). Where that
/// leaves no room beside an axis, the line stands half way between the axes.
#[inline(never)]
fn line_between(a: &Rock<'_>, b: &Rock<'_>) -> (DVec2, f64) {
    let between = b.axis - a.axis;
    if a.layer == b.layer {
        return half_way(a, b);
    }
    let mut widest = (f64::NEG_INFINITY, DVec2::X, 0.0);
    for (of, other, sign) in [(a, b, 1.0), (b, a, -1.0)] {
        let mut from = of.cell[of.cell.len() - 1];
        for &to in of.cell {
            let outward = DVec2::new(to.y - from.y, from.x - to.x);
            from = to;
            // No other edge can have the second cell behind it.
            if sign * outward.dot(between) <= 0.0 {
                continue;
            }
            let normal = outward.normalize();
            let edge = normal.dot(to);
            let gap = other.cell.iter().fold(f64::INFINITY, |least, corner| least.min(normal.dot(*corner))) - edge;
            if gap > widest.0 {
                widest = (gap, sign * normal, sign * (edge + 0.5 * gap));
            }
        }
    }
    let (_, normal, distance) = widest;
    if distance - normal.dot(a.axis) >= LEAST_ROOM && normal.dot(b.axis) - distance >= LEAST_ROOM {
        return (normal, distance);
    }
    half_way(a, b)
}

/// The line half way between two axes, which separates any two cells of one Voronoi diagram.
fn half_way(a: &Rock<'_>, b: &Rock<'_>) -> (DVec2, f64) {
    let normal = (b.axis - a.axis).normalize_or(DVec2::X);
    (normal, normal.dot(0.5 * (a.axis + b.axis)))
}

/// The least distance of an axis from a line, px. Sites are pixels, so half of it lies on each side of two neighbours.
const LEAST_ROOM: f64 = 0.25;
