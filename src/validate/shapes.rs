//! Checks shapes: each rock is a disc with a Delaunay triangulation, bounded by its cell only.

use glam::DVec2;
use robust::{Coord, incircle, orient2d};

use super::{Violation, ensure};
use crate::rocks::{Cells, Shapes};

/// Checks the rocks of one layer before displacement.
///
/// A cell of n vertices must have n p_add strictly inside it, 3n − 2 counter-clockwise triangles, 5n − 3 edges, the
/// cell's own edges as the only boundary (so V − E + F = 1, as for a disc), and every circumcircle must be empty. Signs
/// are exact.
///
/// # Errors
/// Returns the first violation.
pub fn check_shapes(cells: &Cells, selected: &[u32], shapes: &Shapes) -> Result<(), Violation> {
    ensure(shapes.len() == selected.len(), || format!("{} shapes for {} cells", shapes.len(), selected.len()))?;
    let vertices: usize = selected.iter().map(|&site| cells.polygon(site as usize).len()).sum();
    ensure(shapes.top_vertices() == vertices && shapes.triangles() + 2 * selected.len() == 3 * vertices, || {
        format!("{} p_add and {} triangles over {vertices} cell vertices", shapes.top_vertices(), shapes.triangles())
    })?;
    let mut edges = Vec::new();
    for (k, &site) in selected.iter().enumerate() {
        check_rock(cells.polygon(site as usize), shapes.top_of(k), shapes.triangles_of(k), &mut edges).map_err(
            |violation| violation.within(format_args!("rock {k} on cell {site}, p_add {:?}", shapes.top_of(k))),
        )?;
    }
    Ok(())
}

/// A directed edge, and the third vertex of its triangle.
type Edge = ([u16; 2], u16);

fn check_rock(rim: &[DVec2], top: &[DVec2], triangles: &[[u16; 3]], edges: &mut Vec<Edge>) -> Result<(), Violation> {
    let n = rim.len();
    ensure(top.len() == n && triangles.len() == 3 * n - 2, || {
        format!("{} p_add and {} triangles over {n} cell vertices", top.len(), triangles.len())
    })?;
    let points: Vec<Coord<f64>> = rim.iter().chain(top).map(|p| Coord { x: p.x, y: p.y }).collect();
    for (k, p) in top.iter().enumerate() {
        for a in 0..n {
            let side = orient2d(points[a], points[(a + 1) % n], points[n + k]);
            ensure(side > 0.0, || format!("p_add {k} at {p} is not inside: {side} at edge {a}"))?;
        }
    }

    edges.clear();
    for &triangle in triangles {
        let [a, b, c] = triangle;
        ensure(triangle.iter().all(|&v| usize::from(v) < 2 * n), || format!("{triangle:?} of {} vertices", 2 * n))?;
        let area = orient2d(points[usize::from(a)], points[usize::from(b)], points[usize::from(c)]);
        ensure(area > 0.0, || format!("triangle {triangle:?} has area {area}"))?;
        edges.extend([([a, b], c), ([b, c], a), ([c, a], b)]);
    }
    edges.sort_unstable();
    let across = |[a, b]: [u16; 2]| edges.binary_search_by_key(&[b, a], |&(edge, _)| edge).ok().map(|at| edges[at].1);
    let mut boundary = 0;
    for (at, &(edge, c)) in edges.iter().enumerate() {
        ensure(at == 0 || edges[at - 1].0 != edge, || format!("edge {edge:?} is run through twice"))?;
        let [a, b] = edge.map(usize::from);
        if let Some(d) = across(edge) {
            let inside = incircle(points[a], points[b], points[usize::from(c)], points[usize::from(d)]);
            ensure(inside <= 0.0, || format!("vertex {d} lies in the circle of {a}, {b}, {c}: {inside}"))?;
        } else {
            ensure(a < n && b == (a + 1) % n, || format!("edge {edge:?} is on the boundary"))?;
            boundary += 1;
        }
    }
    let distinct = (edges.len() + boundary) / 2;
    ensure(boundary == n && distinct == 5 * n - 3, || format!("{distinct} edges, {boundary} of them on the boundary"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIM: [DVec2; 4] = [DVec2::new(0.0, 0.0), DVec2::new(8.0, 0.0), DVec2::new(8.0, 8.0), DVec2::new(0.0, 8.0)];
    const TOP: [DVec2; 4] = [DVec2::new(2.0, 1.0), DVec2::new(6.0, 3.0), DVec2::new(5.0, 7.0), DVec2::new(1.0, 5.0)];

    #[test]
    fn a_delaunay_rock_passes_and_a_flipped_one_does_not() {
        let mut triangles = crate::rocks::triangulate(&RIM, &TOP).unwrap_or_default();
        let check = |triangles: &[[u16; 3]]| check_rock(&RIM, &TOP, triangles, &mut Vec::new());
        assert_eq!(check(&triangles), Ok(()));
        triangles[0].swap(0, 1);
        assert!(check(&triangles).is_err());
        triangles[0].swap(0, 1);
        triangles[1] = triangles[0];
        assert!(check(&triangles).is_err());
        assert!(check(&triangles[1..]).is_err());
    }

    #[test]
    fn a_point_on_the_rim_is_not_inside() {
        let mut top = TOP;
        let triangles = crate::rocks::triangulate(&RIM, &TOP).unwrap_or_default();
        top[1].x = 8.0;
        assert!(check_rock(&RIM, &top, &triangles, &mut Vec::new()).is_err());
    }
}
