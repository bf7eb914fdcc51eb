//! Finds the bodies that pass through each other, by exact predicates.

use glam::{DVec3, Vec3};
use robust::{Coord3D, orient3d};

use crate::Mesh;
use crate::wood_ear::ColonyMesh;

/// Bodies that share buffers: body k has the triangles `indices[starts[k] .. starts[k + 1]]`.
#[derive(Debug, Clone, Copy)]
pub struct Bodies<'a> {
    positions: &'a [f32],
    indices: &'a [u32],
    starts: &'a [u32],
}

impl<'a> From<&'a Mesh> for Bodies<'a> {
    fn from(Mesh { positions, indices, rock_starts, .. }: &'a Mesh) -> Self {
        Bodies { positions, indices, starts: rock_starts }
    }
}

impl<'a> From<&'a ColonyMesh> for Bodies<'a> {
    fn from(ColonyMesh { positions, indices, individual_starts, .. }: &'a ColonyMesh) -> Self {
        Bodies { positions, indices, starts: individual_starts }
    }
}

/// Returns the pairs i < j of bodies in which an edge of one passes through the inside of a triangle of the other, decided
/// by exact predicates.
///
/// Cost: for bodies whose boxes overlap, all edges against all triangles. This is slow, and completely different from
/// what the generators do.
pub fn crossing_pairs<'a>(bodies: impl Into<Bodies<'a>>) -> Vec<[usize; 2]> {
    let Bodies { positions, indices, starts } = bodies.into();
    let corners = |k: usize| &indices[starts[k] as usize..starts[k + 1] as usize];
    let at = |v: u32| Vec3::from_slice(&positions[3 * v as usize..]).as_dvec3();
    let boxes: Vec<Box3> =
        (0..starts.len().saturating_sub(1)).map(|k| around(corners(k).iter().map(|v| at(*v)))).collect();
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|a, b| boxes[*a][0][0].total_cmp(&boxes[*b][0][0]));
    let mut pairs = Vec::new();
    for (n, &a) in order.iter().enumerate() {
        let mut body = None;
        for &b in order[n + 1..].iter().take_while(|b| boxes[**b][0][0] <= boxes[a][1][0]) {
            if meet(&boxes[a], &boxes[b]) {
                let body = body.get_or_insert_with(|| Body::new(corners(a), at));
                let other = Body::new(corners(b), at);
                if body.pierces(&other) || other.pierces(body) {
                    pairs.push([a.min(b), a.max(b)]);
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

type Box3 = [[f64; 3]; 2];

struct Body {
    around: Box3,
    /// Every edge once, together with the box around it.
    edges: Vec<([DVec3; 2], Box3)>,
    triangles: Vec<([DVec3; 3], Box3)>,
}

fn around(points: impl Iterator<Item = DVec3>) -> Box3 {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], p| {
        let p = p.to_array();
        [[0, 1, 2].map(|k| low[k].min(p[k])), [0, 1, 2].map(|k| high[k].max(p[k]))]
    })
}

fn meet(a: &Box3, b: &Box3) -> bool {
    (0..3).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k])
}

impl Body {
    fn new(indices: &[u32], at: impl Fn(u32) -> DVec3) -> Self {
        let mut sides: Vec<[u32; 2]> = Vec::new();
        let mut triangles = Vec::new();
        for corners in indices.chunks_exact(3) {
            let points = [corners[0], corners[1], corners[2]].map(&at);
            triangles.push((points, around(points.into_iter())));
            for c in 0..3 {
                let [s, t] = [corners[c], corners[(c + 1) % 3]];
                sides.push([s.min(t), s.max(t)]);
            }
        }
        sides.sort_unstable();
        sides.dedup();
        let edges: Vec<_> =
            sides.iter().map(|side| side.map(&at)).map(|ends| (ends, around(ends.into_iter()))).collect();
        Body { around: around(edges.iter().flat_map(|(ends, _)| *ends)), edges, triangles }
    }

    fn pierces(&self, other: &Body) -> bool {
        let near = |b: &&([DVec3; 3], Box3)| meet(&b.1, &self.around);
        let triangles: Vec<_> = other.triangles.iter().filter(near).collect();
        self.edges
            .iter()
            .filter(|(_, b)| meet(b, &other.around))
            .any(|([p, q], b)| triangles.iter().any(|(t, around)| meet(b, around) && edge_pierces(*p, *q, *t)))
    }
}

fn edge_pierces(p: DVec3, q: DVec3, [a, b, c]: [DVec3; 3]) -> bool {
    let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| {
        let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D { x: p.x, y: p.y, z: p.z });
        orient3d(a, b, c, d).partial_cmp(&0.0)
    };
    use std::cmp::Ordering::{Equal, Greater};
    let (above, below) = (volume(a, b, c, p), volume(a, b, c, q));
    let turns = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    above != Some(Equal)
        && below != Some(Equal)
        && above != below
        && turns[0] != Some(Equal)
        && turns.iter().all(|turn| (*turn == Some(Greater)) == (turns[0] == Some(Greater)) && *turn != Some(Equal))
}
