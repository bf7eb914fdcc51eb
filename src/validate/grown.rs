//! Checks grown cells: they share the image among them, each place to the cell that reaches it first.

use glam::DVec2;

use super::{Violation, ensure};
use crate::rocks::cell::SIDES;
use crate::rocks::{Cells, FieldLayer, Outlines, Sites};

/// By how much two distances may differ that should be equal, px. Normals are rounded to 2⁻²⁶, and corners nearer than 2⁻¹⁰
/// px are merged.
const ROUNDING: f64 = 1.0e-3;

/// A cell as the lines of its edges: outward unit normal, and its distance from the origin.
struct Cell(Vec<(DVec2, f64)>);

impl Cell {
    /// The cell of a site: its edges run half way between it and its neighbours.
    fn of(sites: &Sites, cells: &Cells, site: usize) -> Self {
        let centre = |site: usize| DVec2::from(sites.pixels[site].map(f64::from)) + 0.5;
        let image = DVec2::new(sites.width.into(), sites.height.into());
        let here = centre(site);
        let lines = cells.neighbors_of(site).iter().map(|&neighbor| {
            let sides = [(DVec2::NEG_X, 0.0), (DVec2::X, image.x), (DVec2::NEG_Y, 0.0), (DVec2::Y, image.y)];
            if neighbor >= SIDES {
                return sides[(neighbor - SIDES) as usize];
            }
            let other = centre(neighbor as usize);
            let normal = (other - here).normalize();
            (normal, normal.dot(0.5 * (here + other)))
        });
        Cell(lines.collect())
    }

    /// A polygon, counter-clockwise.
    fn along(polygon: &[DVec2]) -> Self {
        let lines = sides(polygon).map(|(a, b)| (DVec2::new(b.y - a.y, a.x - b.x).normalize(), a));
        Cell(lines.map(|(n, a)| (n, n.dot(a))).collect())
    }

    /// How far the cell has to grow to reach a place, px.
    fn distance(&self, place: DVec2) -> f64 {
        self.0.iter().fold(f64::MIN, |most, (normal, c)| most.max(normal.dot(place) - c))
    }

    /// The edge that reaches a place last.
    fn edge(&self, place: DVec2) -> usize {
        let beyond = |k: usize| self.0[k].0.dot(place) - self.0[k].1;
        (0..self.0.len()).fold(0, |best, k| if beyond(k) > beyond(best) { k } else { best })
    }
}

/// Checks the outlines of the layers' rocks that have grown until they meet, with no joints between them.
///
/// The outlines must divide the pixels' centres among them, and the owner of every pixel must be the cell that reaches its centre
/// first; at the same distance, either. Of a cell's ground, only the part that hangs together with it counts: the rest must be
/// another's. Every cell must lie within its outline. `obstacles` grow, too, but are no rocks.
///
/// # Errors
/// Returns the first violation.
pub fn check_grown(
    [width, height]: [u32; 2],
    layers: &[FieldLayer],
    grown: &[Outlines],
    obstacles: &[[DVec2; 3]],
) -> Result<(), Violation> {
    let mut rocks: Vec<(usize, u32, usize)> = Vec::new();
    for (k, (layer, grown)) in layers.iter().zip(grown).enumerate() {
        let selected = &layer.selection.selected;
        ensure(selected.len() == grown.len(), || format!("layer {k}: {} outlines of {}", grown.len(), selected.len()))?;
        rocks.extend(selected.iter().enumerate().map(|(rock, &site)| (k, site, rock)));
    }
    rocks.sort_unstable();
    let cells: Vec<&[DVec2]> = rocks.iter().map(|&(k, site, _)| layers[k].cells.polygon(site as usize)).collect();
    let outlines: Vec<&[DVec2]> = rocks.iter().map(|&(k, _, rock)| grown[k].of(rock)).collect();
    if cells.is_empty() {
        return Ok(());
    }
    let of = |&(k, site, _): &(usize, u32, usize)| Cell::of(&layers[k].sites, &layers[k].cells, site as usize);
    let ccw = |t: &[DVec2; 3]| if (t[1] - t[0]).perp_dot(t[2] - t[0]) > 0.0 { *t } else { [t[0], t[2], t[1]] };
    let fronts: Vec<Cell> = rocks.iter().map(of).chain(obstacles.iter().map(|t| Cell::along(&ccw(t)))).collect();
    let is_open = obstacles.is_empty();
    let image = DVec2::new(width.into(), height.into());
    check_edges(image, &outlines, is_open)?;
    let (mut owners, twice) = owners([width, height], &outlines);
    for [x, y, one, other] in twice {
        let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let [a, b] = [one, other].map(|k| fronts[k as usize].distance(place));
        // A centre on a border is found on both of its sides, and cells that overlap between the centres of pixels may
        // touch one: both are kept whole.
        let is_on_border = to_border(outlines[one as usize], place) < 1.0e-6;
        ensure(is_on_border || a.max(b) < 1.0e-6, || {
            format!("pixel {x}, {y} belongs to {one}, {a} px away, and to {other}, {b} px away")
        })?;
        owners[(y * width + x) as usize] = if a <= b { one } else { other };
    }
    const BLOCK: u32 = 16;
    for (row, column) in (0..height.div_ceil(BLOCK)).flat_map(|y| (0..width.div_ceil(BLOCK)).map(move |x| (y, x))) {
        let [x0, y0] = [column * BLOCK, row * BLOCK];
        let half = 0.5 * f64::from(BLOCK);
        let middle = DVec2::new(f64::from(x0) + half, f64::from(y0) + half);
        // Distances change by no more than the place does.
        let there: Vec<f64> = fronts.iter().map(|cell| cell.distance(middle)).collect();
        let most = there.iter().copied().fold(f64::INFINITY, f64::min) + 4.0 * half;
        let near: Vec<usize> = (0..fronts.len()).filter(|&k| there[k] <= most).collect();
        for (y, x) in (y0..(y0 + BLOCK).min(height)).flat_map(|y| (x0..(x0 + BLOCK).min(width)).map(move |x| (y, x))) {
            let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let distances = near.iter().map(|&k| (fronts[k].distance(place), k));
            let (least, first) = distances.fold((f64::MAX, 0), |best, at| if at < best { at } else { best });
            let owner = owners[(y * width + x) as usize];
            if owner == NOBODY {
                let mut second = near.iter().filter(|&&k| k != first).map(|&k| fronts[k].distance(place));
                if second.any(|at| at - least < 1.0e-6) {
                    continue;
                }
                let is_kept = first >= cells.len() || !is_open && hangs_apart(&fronts, first, place, image);
                ensure(is_kept, || format!("pixel {x}, {y} belongs to nobody instead of {first}"))?;
                continue;
            }
            let given = fronts[owner as usize].distance(place);
            let is_on_border = || outlines.get(first).is_some_and(|outline| distance(outline, place) < 1.0e-6);
            ensure(given - least < ROUNDING || is_on_border() || hangs_apart(&fronts, first, place, image), || {
                format!("pixel {x}, {y} belongs to {owner}, {given} px away, instead of {first}, {least} px away")
            })?;
        }
    }
    for (k, (cell, outline)) in cells.iter().zip(outlines).enumerate() {
        for (a, b) in sides(cell) {
            for place in [0.0, 0.25, 0.5, 0.75].map(|share| a.lerp(b, share)) {
                ensure(distance(outline, place) < ROUNDING, || {
                    format!("{place} of cell {k} lies outside of its outline")
                })?;
            }
        }
    }
    Ok(())
}

/// Whether the ground of a cell at this place hangs together with the cell only through another's, or through what lies beside
/// the image. Straight back to the cell all ground is its own, so this can only be where its corner is walked along.
fn hangs_apart(fronts: &[Cell], k: usize, place: DVec2, image: DVec2) -> bool {
    let cell = &fronts[k];
    let edge = cell.edge(place);
    let (normal, c) = cell.0[edge];
    let back = normal.dot(place) - c;
    // Where the way back leaves the ground that this edge reaches last.
    let mut leaves: Option<(f64, usize)> = None;
    for (other, &(n, d)) in cell.0.iter().enumerate() {
        let (lead, gain) = (back - (n.dot(place) - d), 1.0 - n.dot(normal));
        if other != edge && lead / gain < leaves.map_or(back, |(way, _)| way) {
            leaves = Some((lead / gain, other));
        }
    }
    let is_cut = |at: DVec2| {
        let outside = at.cmplt(DVec2::ZERO).any() || at.cmpgt(image).any();
        outside
            || fronts.iter().enumerate().any(|(j, front)| j != k && front.distance(at) < cell.distance(at) + ROUNDING)
    };
    let shares = || (1..=1000).map(|step| f64::from(step) / 1000.0);
    // Where others are as far away all along the way, the ground is theirs.
    let way_back = leaves.map_or(back, |(way, _)| way);
    if shares().any(|share| is_cut(place - normal * (share * way_back))) {
        return true;
    }
    let Some((way, other)) = leaves else { return false };
    let (n, d) = cell.0[other];
    let start = place - normal * way;
    // Both are equally far along this line; it ends at the corner of the cell.
    let along = DVec2::new(normal.y - n.y, n.x - normal.x) / n.perp_dot(normal);
    let level = n.dot(start) - d;
    shares().any(|share| is_cut(start - along * (level * share)))
}

const NOBODY: u32 = u32::MAX;

/// The outline that holds the centre of each pixel, row by row; and column, row and outlines of those that are in two.
fn owners([width, height]: [u32; 2], outlines: &[&[DVec2]]) -> (Vec<u32>, Vec<[u32; 4]>) {
    let mut twice = Vec::new();
    let mut owners = vec![NOBODY; (width * height) as usize];
    for (k, outline) in outlines.iter().enumerate() {
        let (low, high) = outline.iter().fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v.y), high.max(v.y)));
        for row in (low - 0.5).floor().max(0.0) as u32..((high + 0.5).ceil() as u32).min(height) {
            let y = f64::from(row) + 0.5;
            let mut crossings: Vec<f64> = sides(outline)
                .filter(|(a, b)| (a.y <= y) != (b.y <= y))
                // Always computed from the lower end, so that both outlines at an edge get the same number.
                .map(|(a, b)| if a.y < b.y { (a, b) } else { (b, a) })
                .map(|(a, b)| a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)))
                .collect();
            crossings.sort_unstable_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let column = |x: f64| ((x - 0.5).ceil().max(0.0) as u32).min(width);
                for x in column(pair[0])..column(pair[1]) {
                    let owner = &mut owners[(row * width + x) as usize];
                    if *owner != NOBODY {
                        twice.push([x, row, *owner, k as u32]);
                    }
                    *owner = k as u32;
                }
            }
        }
    }
    (owners, twice)
}

/// Checks that every edge lies in the image, and that the outlines together have at least its area if they are to be `full`.
fn check_edges(image: DVec2, outlines: &[&[DVec2]], full: bool) -> Result<(), Violation> {
    let mut area = 0.0;
    for (k, outline) in outlines.iter().enumerate() {
        ensure(outline.len() >= 3, || format!("outline {k} has {} corners", outline.len()))?;
        for (a, b) in sides(outline) {
            let inside = |v: DVec2| v.cmpge(DVec2::ZERO).all() && v.cmple(image).all();
            ensure(inside(a) && a != b, || format!("outline {k} has an edge from {a} to {b}"))?;
            area += 0.5 * (a - outline[0]).perp_dot(b - outline[0]);
        }
    }
    let whole = image.x * image.y;
    ensure(!full || outlines.is_empty() || area > whole - 1.0e-6 * whole, || {
        format!("the areas of outlines sum to {area}, the image's is {whole}")
    })
}

/// The distance of a place from a polygon, 0 inside.
fn distance(polygon: &[DVec2], place: DVec2) -> f64 {
    let crosses = |(a, b): &(DVec2, DVec2)| {
        (a.y <= place.y) != (b.y <= place.y) && (place.x < a.x + (b.x - a.x) * ((place.y - a.y) / (b.y - a.y)))
    };
    if sides(polygon).filter(crosses).count() % 2 == 1 {
        return 0.0;
    }
    to_border(polygon, place)
}

/// The distance of a place from the edges of a polygon.
fn to_border(polygon: &[DVec2], place: DVec2) -> f64 {
    let from = |(a, b): (DVec2, DVec2)| {
        let share = ((place - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        place.distance(a.lerp(b, share))
    };
    sides(polygon).map(from).fold(f64::MAX, f64::min)
}

/// The edges of a polygon, as start and end.
fn sides(polygon: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}
