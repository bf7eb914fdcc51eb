//! Checks cells: they divide the image into convex cells, each bounded by the bisectors between its site and its
//! neighbours.

use glam::DVec2;

use super::buckets::{Buckets, distance2};
use super::{Violation, ensure};
use crate::rocks::{Cells, Sites, cell_pixels};

/// Tolerance, px. Cell vertices are rounded to a lattice of 2⁻²⁰ px and merged within one of its steps. Two
/// computations of one vertex, or two distances that should be equal, therefore differ by a few steps at most.
const ROUNDING: f64 = 8.0 / (1_u32 << 20) as f64;

/// Vertices nearer than this are merged, px (decision A8 in docs/decisions.md).
const MERGED: f64 = 1.0e-6;

/// Checks the Voronoi diagram of one layer.
///
/// Every edge has to lie on the side of the image or on the bisector that its neighbour implies, so that each cell
/// holds at least what it should; and the areas have to sum to W·H, so that none holds more. In addition, cells must be
/// convex, counter-clockwise from the lexicographically smallest vertex, around their site and within the image, and
/// both cells at an edge must agree about it.
///
/// # Errors
/// Returns the first violation.
pub fn check_cells(sites: &Sites, cells: &Cells) -> Result<(), Violation> {
    let count = sites.pixels.len();
    ensure(cells.len() == count, || format!("{} cells for {count} sites", cells.len()))?;
    ensure(cells.starts.last().is_none_or(|&end| end as usize == cells.vertices.len()), || {
        format!("cells end at {:?} of {} vertices", cells.starts.last(), cells.vertices.len())
    })?;
    let mut area = Sum::default();
    let mut edges = Vec::with_capacity(cells.vertices.len());
    for i in 0..count {
        ensure(cells.starts[i] + 3 <= cells.starts[i + 1], || format!("cell {i} has under three vertices"))?;
        check_polygon(sites, cells, i)
            .map_err(|violation| violation.within(format_args!("cell {i} {:?}", cells.polygon(i))))?;
        let centre = centre(sites, i);
        let polygon = cells.polygon(i);
        for (k, (a, b)) in sides(polygon).enumerate() {
            area.add(0.5 * (a - centre).perp_dot(b - centre));
            if let Some(j) = neighbor_site(sites, cells, i, k)? {
                edges.push((i.min(j), i.max(j), i < j, a, b));
            } else {
                ensure(is_on_side(sites, a, b), || {
                    let (w, h) = (sites.width, sites.height);
                    format!("cell {i}: its edge from {a} to {b} lies on no side of {w} × {h}")
                })?;
            }
        }
        let touches = sides(polygon).any(|(a, b)| is_on_side(sites, a, b));
        ensure(touches == cells.touches_border(i), || format!("cell {i} touches the border: {touches}"))?;
    }
    let image = f64::from(sites.width) * f64::from(sites.height);
    let sum = area.total();
    ensure(count == 0 || ((sum - image) / image).abs() <= 1.0e-9, || {
        format!("the areas of {count} cells sum to {sum}, the image's is {image}")
    })?;
    check_shared_edges(sites, edges)
}

fn check_polygon(sites: &Sites, cells: &Cells, i: usize) -> Result<(), Violation> {
    let polygon = cells.polygon(i);
    let corner = DVec2::new(sites.width.into(), sites.height.into());
    let centre = centre(sites, i);
    let count = polygon.len();
    let first = polygon[0];
    for (k, &v) in polygon.iter().enumerate() {
        let (next, after) = (polygon[(k + 1) % count], polygon[(k + 2) % count]);
        ensure(v.cmpge(DVec2::ZERO).all() && v.cmple(corner).all(), || format!("vertex {k} lies outside of {corner}"))?;
        ensure(k == 0 || (first.x, first.y) < (v.x, v.y), || format!("vertex {k} comes before the first"))?;
        ensure(v.distance(next) >= MERGED, || format!("vertices {k} and the next are {} apart", v.distance(next)))?;
        let (u, w) = (next - v, after - next);
        ensure(u.perp_dot(w) >= -ROUNDING * (u.length() + w.length()), || {
            format!("turns right by {} at vertex {}", u.perp_dot(w), (k + 1) % count)
        })?;
        let (u, w) = (v - centre, next - centre);
        ensure(u.perp_dot(w) >= -ROUNDING * (u.length() + w.length()), || {
            format!("site {centre} lies right of the edge from vertex {k}")
        })?;
    }
    // A closed path that only turns left could still go twice around its site.
    let crossings = sides(polygon).filter(|(a, b)| a.y <= centre.y && centre.y < b.y).count();
    ensure(crossings == 1, || format!("passes the site's height upwards {crossings} times"))
}

/// Returns the site across edge k of cell i, or `None` for a side of the image. Checks that the edge lies on the
/// bisector.
fn neighbor_site(sites: &Sites, cells: &Cells, i: usize, k: usize) -> Result<Option<usize>, Violation> {
    let j = cells.neighbors_of(i)[k] as usize;
    if j >= sites.pixels.len() {
        return Ok(None);
    }
    let polygon = cells.polygon(i);
    for v in [polygon[k], polygon[(k + 1) % polygon.len()]] {
        let [near, far] = [i, j].map(|site| v.distance(centre(sites, site)));
        ensure((near - far).abs() <= ROUNDING, || {
            format!("edge {k} of cell {i}: {v} is {near} from its site and {far} from its neighbour {j}")
        })?;
    }
    Ok(Some(j))
}

/// Whether an edge lies on a side of the image.
fn is_on_side(sites: &Sites, a: DVec2, b: DVec2) -> bool {
    let (w, h) = (f64::from(sites.width), f64::from(sites.height));
    (a.x == b.x && (a.x == 0.0 || a.x == w)) || (a.y == b.y && (a.y == 0.0 || a.y == h))
}

/// Checks that both cells of an edge have it, in opposite directions.
fn check_shared_edges(sites: &Sites, mut edges: Vec<(usize, usize, bool, DVec2, DVec2)>) -> Result<(), Violation> {
    edges.sort_unstable_by_key(|&(i, j, forwards, ..)| (i, j, forwards));
    for pair in edges.chunks(2) {
        let &[(i, j, back, a, b), (i2, j2, forth, c, d)] = pair else {
            return Err(Violation(format!("an edge of one cell alone: {pair:?}")));
        };
        ensure((i, j) == (i2, j2) && !back && forth, || {
            let [p, q] = [i, j].map(|site| sites.pixels[site]);
            format!(
                "cells {i} at {p:?} and {j} at {q:?} do not agree that they are neighbours; after it come {i2} and {j2}"
            )
        })?;
        ensure(a.distance(d) <= ROUNDING && b.distance(c) <= ROUNDING, || {
            format!("cells {i} and {j} see their edge as {c} – {d} and as {b} – {a}")
        })?;
    }
    Ok(())
}

/// Checks which cell owns which pixel (decision A9). Returns the index of the owner for every pixel, row by row.
///
/// Every pixel of the image has to be in exactly one cell: that of the nearest site, or of the one with the lowest
/// index if several are equally near. For every pixel, all sites as near as its owner are examined; squared distances
/// are integers.
///
/// # Errors
/// Returns the first violation.
pub fn check_ownership(sites: &Sites, cells: &Cells) -> Result<Vec<u32>, Violation> {
    const NOBODY: u32 = u32::MAX;
    let count = sites.pixels.len();
    if count == 0 {
        return Ok(Vec::new());
    }
    let (width, height) = (sites.width, sites.height);
    let mut owners = vec![NOBODY; width as usize * height as usize];
    for i in 0..count {
        for [x, y] in cell_pixels(sites, cells, i) {
            let inside = u32::from(x) < width && u32::from(y) < height;
            ensure(inside, || format!("pixel {x}, {y} of cell {i} lies outside of {width} × {height}"))?;
            let owner = &mut owners[usize::from(y) * width as usize + usize::from(x)];
            ensure(*owner == NOBODY, || format!("pixel {x}, {y} belongs to cell {owner} and to cell {i}"))?;
            *owner = i as u32;
        }
    }
    let buckets = Buckets::new(width, height, &sites.pixels);
    for (y, row) in owners.chunks_exact(width as usize).enumerate() {
        for (x, &owner) in row.iter().enumerate() {
            let (x, y) = (x as u32, y as u32);
            ensure(owner != NOBODY, || format!("pixel {x}, {y} belongs to no cell"))?;
            let owner = owner as usize;
            let own = distance2(sites.pixels[owner], x, y);
            let mut best = (own, owner);
            buckets.visit_near(x, y, own.isqrt() as u32, |site, d2| best = best.min((d2, site)));
            ensure(best == (own, owner), || {
                let (d2, nearest) = best;
                format!(
                    "pixel {x}, {y} is given to site {owner} at {:?} (d² {own}) instead of site {nearest} at {:?} (d² {d2})",
                    sites.pixels[owner], sites.pixels[nearest]
                )
            })?;
        }
    }
    Ok(owners)
}

fn centre(sites: &Sites, i: usize) -> DVec2 {
    let [x, y] = sites.pixels[i].map(|c| f64::from(c) + 0.5);
    DVec2::new(x, y)
}

/// The edges of a polygon, as start and end.
fn sides(polygon: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// A compensated sum: Neumaier (1974), *Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen*.
#[derive(Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        let (large, small) = if self.sum.abs() >= value.abs() { (self.sum, value) } else { (value, self.sum) };
        self.lost += (large - sum) + small;
        self.sum = sum;
    }

    fn total(&self) -> f64 {
        self.sum + self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rocks::voronoi;

    fn sample() -> (Sites, Cells) {
        let pixels = vec![[2, 2], [9, 1], [5, 7], [12, 6]];
        let sites = Sites { width: 15, height: 9, radius: 4.0, pixels, target: 9, saturated: false };
        let cells = voronoi(&sites);
        (sites, cells)
    }

    #[test]
    fn a_diagram_passes() {
        let (sites, cells) = sample();
        assert_eq!(check_cells(&sites, &cells), Ok(()));
        assert_eq!(check_ownership(&sites, &cells).map(|owners| owners.len()), Ok(15 * 9));
    }

    #[test]
    fn a_bent_diagram_is_found_out() {
        let (sites, cells) = sample();
        for vertex in 0..cells.vertices.len() {
            for shift in [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y] {
                let mut bent = cells.clone();
                bent.vertices[vertex] += shift * 1.0e-3;
                assert!(check_cells(&sites, &bent).is_err(), "vertex {vertex} moved along {shift}");
            }
        }
        let mut moved = sites.clone();
        moved.pixels[2] = [5, 6];
        assert!(check_cells(&moved, &cells).is_err());
    }
}
