//! Baseline (a) of the bench: the papers' loops, taken literally. Compiled only with the feature `bench`, and never
//! shipped. Numbers such as A1 refer to docs/decisions.md.
//!
//! Every flag is a byte, and picks are repeated until the number is reached or no pixel is free (Fig. 4). The crate
//! [`spade`] makes the Voronoi diagrams and triangulates every rock. Every pixel of a cell's bounding box is tested
//! (Fig. 7). Only the parameters that journal Fig. 1 uses are read: saturated darts, clipped cells, area fractions,
//! shared swings.

use glam::DVec2;
use spade::{DelaunayTriangulation, Point2, Triangulation};

use super::{displace, target_sites};
use crate::params::{Layer, Params};
use crate::rng::{Purpose, Stream};

/// The rocks of a field, like [`crate::Mesh`] but without normals.
#[derive(Debug, Default)]
pub(crate) struct LiteralField {
    pub(crate) positions: Vec<f32>,
    pub(crate) indices: Vec<u32>,
    pub(crate) rock_starts: Vec<u32>,
}

/// Runs the four stages, one after the other.
pub(crate) fn generate(params: &Params) -> LiteralField {
    let layers: Vec<Layer> = params.layers.iter().map(|layer| params.layer_in_px(layer)).collect();
    let cells: Vec<Vec<Vec<DVec2>>> = layers.iter().map(|layer| diagram(params, &sites(params, layer))).collect();
    let selected = select(params, &layers, &cells);
    let mut field = LiteralField { rock_starts: vec![0], ..LiteralField::default() };
    let mut triangulation = DelaunayTriangulation::new();
    for ((layer, cells), selected) in layers.iter().zip(&cells).zip(&selected) {
        for &cell in selected {
            field.add_rock(&mut triangulation, &cells[cell as usize], params.seed, layer, cell);
        }
    }
    field
}

/// Throws darts as in Fig. 4, with the pick repeated (decision A1).
fn sites(params: &Params, layer: &Layer) -> Vec<DVec2> {
    let (width, height) = (params.image_width, params.image_height);
    let target = target_sites(params.pixels() as f64, params.packing, layer.radius) as usize;
    let mut stream = Stream::new(params.seed, Purpose::Darts, layer.id, 0);
    let mut flags = vec![0_u8; params.pixels() as usize];
    let mut free = flags.len();
    let mut sites = Vec::new();
    let squared = layer.radius * layer.radius;
    let reach = layer.radius as u32;
    while sites.len() < target && free > 0 {
        let [x, y] = stream.pixel(width, height).map(u32::from);
        if flags[(y * width + x) as usize] != 0 {
            continue;
        }
        sites.push(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        for row in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
            for column in x.saturating_sub(reach)..=(x + reach).min(width - 1) {
                let (dx, dy) = (f64::from(column.abs_diff(x)), f64::from(row.abs_diff(y)));
                let flag = &mut flags[(row * width + column) as usize];
                if dx * dx + dy * dy < squared && *flag == 0 {
                    *flag = 1;
                    free -= 1;
                }
            }
        }
    }
    sites
}

/// Returns the Voronoi cells, clipped to the image, counter-clockwise.
fn diagram(params: &Params, sites: &[DVec2]) -> Vec<Vec<DVec2>> {
    let (width, height) = (f64::from(params.image_width), f64::from(params.image_height));
    // Four sites far away make every cell finite, without changing anything within the image.
    let far = 8.0 * (width + height);
    let ring = [(-far, -far), (far, -far), (-far, far), (far, far)].map(|(x, y)| DVec2::new(x, y));
    let points = sites.iter().chain(&ring).map(|p| Point2::new(p.x, p.y)).collect();
    // Sites are distinct and finite, so loading them cannot fail.
    let Ok(triangulation) = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(points) else { return Vec::new() };
    let faces = triangulation.voronoi_faces().take(sites.len());
    faces
        .map(|face| {
            let corners = face.adjacent_edges().filter_map(|edge| edge.from().position());
            let mut cell: Vec<DVec2> = corners.map(|p| DVec2::new(p.x, p.y)).collect();
            cell = clip(&cell, |p| p.x);
            cell = clip(&cell, |p| width - p.x);
            cell = clip(&cell, |p| p.y);
            cell = clip(&cell, |p| height - p.y);
            cell.dedup_by(|a, b| a.distance_squared(*b) < 1.0e-12);
            while cell.len() > 1 && cell[0].distance_squared(cell[cell.len() - 1]) < 1.0e-12 {
                cell.pop();
            }
            cell
        })
        .collect()
}

/// Returns the part of a convex polygon where `depth` is not negative.
fn clip(polygon: &[DVec2], depth: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &here) in polygon.iter().enumerate() {
        let next = polygon[(k + 1) % polygon.len()];
        let (a, b) = (depth(here), depth(next));
        if a >= 0.0 {
            kept.push(here);
        }
        if (a < 0.0) != (b < 0.0) {
            // Computed from inside to outside, so that both cells at an edge cut it at the same point.
            let (inside, outside, d, e) = if a < 0.0 { (next, here, b, a) } else { (here, next, a, b) };
            kept.push(inside + (outside - inside) * (d / (d - e)));
        }
    }
    kept
}

/// Selects cells as in Fig. 7. Returns, per layer, the selected cells in the order in which they were granted; the
/// coarsest layer goes first (decision A7).
fn select(params: &Params, layers: &[Layer], cells: &[Vec<Vec<DVec2>>]) -> Vec<Vec<u32>> {
    let mut flags = vec![0_u8; params.pixels() as usize];
    let mut pixels = Vec::new();
    let mut selected = vec![Vec::new(); layers.len()];
    let mut coarsest_first: Vec<usize> = (0..layers.len()).collect();
    coarsest_first.sort_by_key(|&k| cells[k].len());
    for k in coarsest_first {
        let mut stream = Stream::new(params.seed, Purpose::VisitingOrder, layers[k].id, 0);
        let mut order: Vec<u32> = (0..cells[k].len() as u32).collect();
        for last in (1..order.len()).rev() {
            order.swap(last, stream.below(last as u32 + 1) as usize);
        }
        let mut area = 0;
        for cell in order {
            if area as f64 >= layers[k].area_fraction * params.pixels() as f64 {
                break;
            }
            if is_free(params, &cells[k][cell as usize], &flags, &mut pixels) {
                pixels.iter().for_each(|&pixel| flags[pixel as usize] = 1);
                area += pixels.len();
                selected[k].push(cell);
            }
        }
    }
    selected
}

/// Whether no pixel of a cell is flagged and it has at least one. If so, `pixels` then holds the cell's pixels.
fn is_free(params: &Params, cell: &[DVec2], flags: &[u8], pixels: &mut Vec<u32>) -> bool {
    pixels.clear();
    let (low, high) = cell.iter().fold((DVec2::MAX, DVec2::MIN), |(lo, hi), &v| (lo.min(v), hi.max(v)));
    let (low, high) = ((low - 0.5).ceil().max(DVec2::ZERO), (high - 0.5).floor());
    for row in low.y as u32..=(high.y as u32).min(params.image_height - 1) {
        for column in low.x as u32..=(high.x as u32).min(params.image_width - 1) {
            if owns(cell, DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5)) {
                let pixel = row * params.image_width + column;
                if flags[pixel as usize] != 0 {
                    return false;
                }
                pixels.push(pixel);
            }
        }
    }
    !pixels.is_empty()
}

/// Whether a cell owns a pixel's centre. A centre on an edge belongs to the cell on one side only (decision A9).
fn owns(cell: &[DVec2], centre: DVec2) -> bool {
    let mut from = cell[cell.len() - 1];
    cell.iter().all(|&to| {
        let start = core::mem::replace(&mut from, to);
        // Always computed from the lesser end, so that both cells at the edge get the same number.
        let forward = (start.x, start.y) < (to.x, to.y);
        let (a, b) = if forward { (start, to) } else { (to, start) };
        let side = (b - a).perp_dot(centre - a);
        if forward { side >= 0.0 } else { side < 0.0 }
    })
}

impl LiteralField {
    /// Makes one rock, as in Fig. 10 and Eqs 2 and 3.
    fn add_rock(
        &mut self,
        triangulation: &mut DelaunayTriangulation<Point2<f64>>,
        rim: &[DVec2],
        seed: u32,
        layer: &Layer,
        cell: u32,
    ) {
        let mut stream = Stream::new(seed, Purpose::TopPoints, layer.id, cell);
        let top: Vec<DVec2> = rim.iter().map(|_| draw(rim, &mut stream)).collect();
        triangulation.clear();
        for p in rim.iter().chain(&top) {
            // The points are finite, and the chance that two coincide is below 1e-9.
            let _ = triangulation.insert(Point2::new(p.x, p.y));
        }
        let base = (self.positions.len() / 3) as u32;
        for face in triangulation.inner_faces() {
            self.indices.extend(face.vertices().map(|vertex| base + vertex.fix().index() as u32));
        }
        self.rock_starts.push(self.indices.len() as u32);
        self.positions.extend(rim.iter().flat_map(|v| [v.x as f32, v.y as f32, 0.0]));
        let mut swing = Stream::new(seed, Purpose::RockSwing, layer.id, cell);
        let j1 = swing.unit();
        let swings = || {
            let j = [j1, swing.unit()];
            [j, j]
        };
        displace(&top, layer.taper, layer.height, swings, |p| self.positions.extend(p.as_vec3().to_array()));
    }
}

/// Draws a point uniformly from a convex polygon: chooses a triangle of its fan by area, then a point of the triangle.
fn draw(polygon: &[DVec2], stream: &mut Stream) -> DVec2 {
    let fan = || polygon[1..].windows(2).map(|pair| (pair[0] - polygon[0], pair[1] - polygon[0]));
    let mut rest = stream.unit() * fan().map(|(u, v)| u.perp_dot(v)).sum::<f64>();
    let (mut s, mut t) = (stream.unit(), stream.unit());
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    let mut point = polygon[0];
    for (u, v) in fan() {
        point = polygon[0] + u * s + v * t;
        rest -= u.perp_dot(v);
        if rest < 0.0 {
            break;
        }
    }
    point
}
