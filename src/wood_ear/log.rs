//! The log as a mesh: a coarse one that individuals stand on, and a fine one that is visible.
//!
//! Both are a closed sweep of rings from the middle of one end to the middle of the other, sampled from the same shape.
//! The bark vertices of the coarse mesh are also vertices of the fine one, so individuals stand on the visible surface;
//! the vertices of the ends lie on the same surface. The coarse spacing only decides how dense a colony can be
//! (decision K6), not how the log looks.

use glam::DVec3;

use super::circle::turn;
use super::shape::{LogShape, Wood};
use crate::params::wood_ear::Log as LogParams;

/// Largest number of vertices of the fine mesh (5 MB of buffers), which is four or two times as fine as the coarse one.
const MOST_FINE_VERTICES: f64 = 90_000.0;

/// A closed mesh with normals. For the feet drawn on a mesh given by the user, only points and normals.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Log {
    /// Positions of the vertices, cm.
    pub points: Vec<DVec3>,
    /// Unit normals, area-weighted over the adjacent faces.
    pub normals: Vec<DVec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Per vertex, what it is made of, as the number of a [`Wood`].
    pub kinds: Vec<u8>,
    /// Per vertex, its place along the log's axis and its distance from it, cm.
    pub coords: Vec<[f32; 2]>,
}

impl Log {
    /// Makes an empty log with room for this many vertices and triangles. No room is made for the vertices' kinds,
    /// coordinates and normals.
    pub(super) fn with_capacity(vertices: usize, triangles: usize) -> Self {
        Log { points: Vec::with_capacity(vertices), triangles: Vec::with_capacity(triangles), ..Log::default() }
    }
}

/// One ring of the sweep. It is a single point if `count` is 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ring {
    count: u32,
    /// The share of a step by which its first vertex is turned.
    offset: f64,
    place: Place,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// On the bark, at this share of the length, −½ … ½.
    Bark(f64),
    /// On an end: whether it is the one towards +x, and the share of the radius.
    End(bool, f64),
}

/// Divides a log into rings: `rows` bands along the bark, with `around` vertices on each.
fn rings(log: &LogParams, fineness: u32) -> Vec<Ring> {
    // The rows are those of equilateral triangles.
    let rows = (log.length / (0.75_f64.sqrt() * log.spacing)).round() as u32 * fineness;
    let around = (std::f64::consts::TAU * log.radius / log.spacing).round().max(6.0) as u32 * fineness;
    let caps = ((log.radius / (0.9 * log.spacing)).round().max(1.0) as u32) * fineness;
    let cap = |positive: bool, k: u32| {
        let share = f64::from(k) / f64::from(caps);
        let count = if k == 0 { 1 } else { ((f64::from(around) * share).round() as u32).max(5) };
        Ring { count, offset: 0.5 * f64::from(k % 2), place: Place::End(positive, share) }
    };
    let mut rings = Vec::with_capacity((2 * caps + rows + 1) as usize);
    for k in 0..caps {
        rings.push(cap(false, k));
    }
    for row in 0..=rows {
        let along = f64::from(row) / f64::from(rows) - 0.5;
        rings.push(Ring { count: around, offset: 0.5 * f64::from(row % 2), place: Place::Bark(along) });
    }
    for k in (0..caps).rev() {
        rings.push(cap(true, k));
    }
    rings
}

/// Returns how much finer the fine mesh of a log is (1, 2 or 4), and the number of vertices of the coarse and of the
/// fine mesh.
pub(super) fn counts(log: &LogParams) -> (u32, [u64; 2]) {
    let count = |fineness| rings(log, fineness).iter().map(|ring| u64::from(ring.count)).sum::<u64>();
    let coarse = count(1);
    let fineness = [4, 2].into_iter().find(|k| (coarse * u64::from(k * k)) as f64 <= MOST_FINE_VERTICES).unwrap_or(1);
    (fineness, [coarse, count(fineness)])
}

/// Builds a mesh, ring by ring.
#[derive(Debug)]
pub(super) struct Sweep {
    shape: LogShape,
    rings: Vec<Ring>,
    next: usize,
    /// First vertex of the previous ring.
    before: u32,
    log: Log,
}

impl Sweep {
    pub(super) fn new(log: &LogParams, fineness: u32) -> Self {
        let rings = rings(log, fineness);
        let vertices = rings.iter().map(|ring| ring.count as usize).sum();
        // By Euler's formula, because the mesh is closed.
        let mut mesh = Log::with_capacity(vertices, 2 * vertices);
        mesh.kinds.reserve_exact(vertices);
        mesh.coords.reserve_exact(vertices);
        Sweep { shape: LogShape::new(*log), rings, next: 0, before: 0, log: mesh }
    }

    pub(super) fn progress(&self) -> f64 {
        self.next as f64 / self.rings.len().max(1) as f64
    }

    /// Adds rings with about `vertices` vertices in all. Returns true when the mesh is done.
    pub(super) fn advance(&mut self, vertices: usize) -> bool {
        let until = self.log.points.len() + vertices;
        while let Some(&ring) = self.rings.get(self.next) {
            if self.log.points.len() >= until {
                return false;
            }
            self.add(ring);
        }
        true
    }

    pub(super) fn finish(self) -> Log {
        let mut log = self.log;
        log.normals = normals(&log.points, &log.triangles);
        log
    }

    fn add(&mut self, ring: Ring) {
        let first = self.log.points.len() as u32;
        for i in 0..ring.count {
            let direction = turn((f64::from(i) + ring.offset) / f64::from(ring.count));
            let (point, coords, wood) = match ring.place {
                Place::Bark(along) => {
                    let (point, coords) = self.shape.bark(along, direction);
                    (point, coords, Wood::Bark)
                }
                Place::End(positive, share) => self.shape.end(positive, direction, share),
            };
            self.log.points.push(point);
            self.log.kinds.push(wood as u8);
            self.log.coords.push(coords.map(|c| c as f32));
        }
        if self.next > 0 {
            stitch(&mut self.log.triangles, (self.before, self.rings[self.next - 1]), (first, ring));
        }
        self.before = first;
        self.next += 1;
    }
}

/// Appends the triangles between two neighbouring rings. Each step takes the vertex whose angle comes first.
fn stitch(triangles: &mut Vec<[u32; 3]>, (a, lower): (u32, Ring), (b, upper): (u32, Ring)) {
    let [n, m] = [lower.count, upper.count];
    if n == 1 || m == 1 {
        for k in 0..n.max(m) {
            let next = (k + 1) % n.max(m);
            triangles.push(if n == 1 { [a, b + next, b + k] } else { [a + k, a + next, b] });
        }
        return;
    }
    let angle = |ring: Ring, k: u32| (f64::from(k) + ring.offset) / f64::from(ring.count);
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        // The middle of the next edge decides, so that the shorter diagonal is taken.
        let lower_first =
            i < n && (j == m || angle(lower, i) + angle(lower, i + 1) <= angle(upper, j) + angle(upper, j + 1));
        let [p, q] = [a + i % n, b + j % m];
        if lower_first {
            i += 1;
            triangles.push([p, a + i % n, q]);
        } else {
            j += 1;
            triangles.push([p, b + j % m, q]);
        }
    }
}

/// Computes unit normals from the sums of the adjacent faces' area vectors; +z if these cancel.
fn normals(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| points[v as usize]);
        let normal = (b - a).cross(c - a);
        for v in triangle {
            normals[*v as usize] += normal;
        }
    }
    for normal in &mut normals {
        *normal = normal.normalize_or(DVec3::Z);
    }
    normals
}
