//! A rock's triangulation is the Delaunay triangulation, as spade makes it.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::collections::BTreeSet;

use common::{Random, field_test};
use glam::DVec2;
use robust::{Coord, incircle, orient2d};
use rock_field::rocks::triangulate;
use spade::{DelaunayTriangulation, Point2, Triangulation};

type Triangles = BTreeSet<[u16; 3]>;

const ROUNDS: u64 = if cfg!(target_arch = "wasm32") { 40 } else { 400 };

field_test! {
    fn random_rocks_equal_spade() {
        for round in 0..ROUNDS {
            let mut random = Random(round);
            for n in 3..=40 {
                let squash = random.pick(&[1.0, 1.0, 0.3, 1.0e-2]);
                let rim = ellipse(&mut random, n, squash);
                let top: Vec<_> = (0..n).map(|_| inside(&mut random, &rim)).collect();
                assert_equals_spade(&rim, &top);
            }
        }
    }
}

field_test! {
    fn nearly_degenerate_rocks_equal_spade() {
        for round in 0..ROUNDS {
            let mut random = Random(round + 1_000_000);
            for n in 3..=12 {
                // Flat as a hair, with points a hair from the rim, from one another, and from one circle or line.
                let squash = random.pick(&[1.0e-4, 1.0e-6, 1.0]);
                let rim = ellipse(&mut random, n, squash);
                let hair = random.pick(&[1.0e-6, 1.0e-9, 1.0e-12]);
                let centre = rim.iter().sum::<DVec2>() / n as f64;
                let mut top = vec![inside(&mut random, &rim)];
                for k in 1..n {
                    let (a, b) = (rim[k], rim[(k + 1) % n]);
                    let previous = top[k - 1];
                    let point = match random.below(4) {
                        0 => a.lerp(b, random.unit()).lerp(centre, hair),
                        1 => previous.lerp(centre, hair),
                        2 => a.lerp(centre, 0.5),
                        _ => previous.lerp(a, random.unit()),
                    };
                    top.push(point);
                }
                assert_equals_spade(&rim, &top);
            }
        }
    }
}

field_test! {
    fn rims_that_are_almost_straight_equal_spade() {
        for round in 0..ROUNDS {
            let mut random = Random(round + 2_000_000);
            // A square with more corners on its sides, bulging by less than anyone could see.
            let bulge = random.pick(&[1.0e-3, 1.0e-6, 1.0e-9]);
            let mut rim = Vec::new();
            for side in 0..4 {
                for step in 0..4 {
                    let t = f64::from(step) / 4.0;
                    let mut v = DVec2::new(t * 60.0, -bulge * t * (1.0 - t));
                    for _ in 0..side {
                        v = DVec2::new(60.0 - v.y, v.x);
                    }
                    rim.push(v + DVec2::splat(1000.5));
                }
            }
            let top: Vec<_> = rim.iter().map(|_| inside(&mut random, &rim)).collect();
            assert_equals_spade(&rim, &top);
        }
    }
}

field_test! {
    fn ties_are_settled_to_some_delaunay_triangulation() {
        // Squares in a square: every small circumcircle holds four points, so several triangulations are right.
        let rim = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]].map(DVec2::from_array);
        let top = [[2.0, 2.0], [4.0, 2.0], [4.0, 4.0], [2.0, 4.0]].map(DVec2::from_array);
        for turn in 0..4 {
            let mut top = top;
            top.rotate_left(turn);
            let triangles = triangulate(&rim, &top).unwrap();
            assert_eq!(triangles.len(), 10);
            assert_delaunay(&rim, &top, &triangles);
        }
    }
}

field_test! {
    fn points_that_are_not_strictly_inside_are_refused() {
        let rim = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]].map(DVec2::from_array);
        let middle = DVec2::new(3.0, 2.0);
        for bad in [[6.0, 3.0], [6.5, 3.0], [0.0, 0.0], [3.0, 6.0], [3.0, 2.0], [f64::from_bits(1).mul_add(-1.0, 0.0), 1.0]] {
            assert_eq!(triangulate(&rim, &[middle, bad.into()]), None, "{bad:?}");
        }
        assert_eq!(triangulate(&rim, &[DVec2::new(6.0, 1.0)]), None);
        assert_eq!(triangulate(&rim, &[]), None);
    }
}

/// A convex polygon of n vertices on an ellipse, counter-clockwise, somewhere on the image.
fn ellipse(random: &mut Random, n: usize, squash: f64) -> Vec<DVec2> {
    loop {
        let mut angles: Vec<f64> = (0..n).map(|_| random.between(0.0, core::f64::consts::TAU)).collect();
        angles.sort_unstable_by(f64::total_cmp);
        let centre = DVec2::new(random.between(60.0, 8000.0), random.between(60.0, 8000.0));
        let size = random.log_between(1.0, 200.0);
        let turn = DVec2::from_angle(random.between(0.0, core::f64::consts::TAU));
        let rim: Vec<DVec2> =
            angles.iter().map(|a| centre + turn.rotate(DVec2::new(size * a.cos(), size * squash * a.sin()))).collect();
        // Rounding can bend a flat rim inward; cells are never so flat.
        if (0..n).all(|k| orient(rim[k], rim[(k + 1) % n], rim[(k + 2) % n]) > 0.0) {
            return rim;
        }
    }
}

fn inside(random: &mut Random, rim: &[DVec2]) -> DVec2 {
    let weights: Vec<f64> = rim.iter().map(|_| -random.unit().max(1.0e-300).ln()).collect();
    let total: f64 = weights.iter().sum();
    rim.iter().zip(weights).map(|(v, w)| *v * (w / total)).sum()
}

/// Equal to spade's where all points are strictly inside and distinct; refused where not.
fn assert_equals_spade(rim: &[DVec2], top: &[DVec2]) {
    let n = rim.len();
    let legal = top
        .iter()
        .enumerate()
        .all(|(k, p)| (0..n).all(|a| orient(rim[a], rim[(a + 1) % n], *p) > 0.0) && !top[..k].contains(p));
    let ours = triangulate(rim, top);
    assert_eq!(ours.is_some(), legal, "rim {rim:?}\ntop {top:?}");
    let Some(ours) = ours else { return };
    assert_eq!(ours.len(), 3 * n - 2);
    let ours_sorted: Triangles = ours.iter().copied().map(sorted).collect();
    if ours_sorted != spade_triangles(rim, top) {
        // Points that lie on one circle exactly leave a choice.
        assert_delaunay(rim, top, &ours);
        assert!(has_tie(rim, top, &ours), "rim {rim:?}\ntop {top:?}\nours {ours:?}");
    }
}

fn spade_triangles(rim: &[DVec2], top: &[DVec2]) -> Triangles {
    let mut triangulation: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::new();
    for p in rim.iter().chain(top) {
        triangulation.insert(Point2::new(p.x, p.y)).unwrap();
    }
    triangulation.inner_faces().map(|face| sorted(face.vertices().map(|v| v.fix().index() as u16))).collect()
}

fn sorted(mut triangle: [u16; 3]) -> [u16; 3] {
    triangle.sort_unstable();
    triangle
}

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

fn orient(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    orient2d(coord(a), coord(b), coord(c))
}

/// Every triangle with every other point: how far the point lies in the circumcircle.
fn in_circles<'a>(rim: &[DVec2], top: &[DVec2], triangles: &'a [[u16; 3]]) -> impl Iterator<Item = f64> + 'a {
    let points: Vec<Coord<f64>> = rim.iter().chain(top).map(|&p| coord(p)).collect();
    triangles.iter().flat_map(move |triangle| {
        let [a, b, c] = triangle.map(|v| points[usize::from(v)]);
        let others = (0..points.len()).filter(|&d| !triangle.contains(&(d as u16)));
        others.map(|d| incircle(a, b, c, points[d])).collect::<Vec<_>>()
    })
}

fn assert_delaunay(rim: &[DVec2], top: &[DVec2], triangles: &[[u16; 3]]) {
    assert!(in_circles(rim, top, triangles).all(|inside| inside <= 0.0), "rim {rim:?}\ntop {top:?}\n{triangles:?}");
}

fn has_tie(rim: &[DVec2], top: &[DVec2], triangles: &[[u16; 3]]) -> bool {
    in_circles(rim, top, triangles).any(|inside| inside == 0.0)
}
