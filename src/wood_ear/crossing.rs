//! Whether two bodies pass through each other, decided exactly on the numbers in the buffers.

use glam::{DVec3, Vec3};
use robust::{Coord3D, orient3d};

use super::body::Layout;
use super::pairs::{Bounds, overlapping};
use super::pose::Plane;

/// Triangles to a box within a body.
const GROUP: usize = 12;

/// Boxes around a body's parts.
#[derive(Debug, Clone, Default)]
pub(super) struct Boxes {
    groups: Vec<Bounds>,
}

impl Boxes {
    /// Boxes of a body; `whole` is the box around all.
    pub(super) fn of(layout: &Layout, positions: &[f32]) -> (Self, Bounds) {
        let mut whole = Bounds::EMPTY;
        let groups = layout.triangles.chunks(GROUP).map(|group| {
            let bounds = Bounds::of(group.as_flattened().iter().map(|v| point(positions, *v)));
            whole = whole.with(bounds.min).with(bounds.max);
            bounds
        });
        (Boxes { groups: groups.collect() }, whole)
    }
}

#[inline]
fn point(positions: &[f32], v: u16) -> DVec3 {
    let at = 3 * usize::from(v);
    Vec3::from_slice(&positions[at..at + 3]).as_dvec3()
}

/// Whether an edge of one body passes through the inside of a triangle of the other: positions and boxes of both, and the second's box.
///
/// Touching and coplanar faces do not count (decision K11).
pub(super) fn cross(layout: &Layout, a: (&[f32], &Boxes, &Bounds), b: (&[f32], &Boxes, &Bounds)) -> bool {
    for (g, of_a) in a.1.groups.iter().enumerate() {
        if !of_a.overlaps(b.2) {
            continue;
        }
        for (h, of_b) in b.1.groups.iter().enumerate() {
            if of_a.overlaps(of_b) && groups_cross(layout, (a.0, g), (b.0, h), of_b) {
                return true;
            }
        }
    }
    false
}

fn groups_cross(layout: &Layout, (a, g): (&[f32], usize), (b, h): (&[f32], usize), around_b: &Bounds) -> bool {
    let of = |group: usize| layout.triangles.iter().skip(group * GROUP).take(GROUP);
    for s in of(g) {
        let s = s.map(|v| point(a, v));
        let around = Bounds::of(s.into_iter());
        if !around.overlaps(around_b) {
            continue;
        }
        for t in of(h) {
            let t = t.map(|v| point(b, v));
            if around.overlaps(&Bounds::of(t.into_iter())) && triangles_cross(s, t) {
                return true;
            }
        }
    }
    false
}

/// Whether an edge of either passes through the inside of the other.
pub(super) fn triangles_cross(s: [DVec3; 3], t: [DVec3; 3]) -> bool {
    let sides_of_t = t.map(|p| side(s, p));
    if sides_of_t.iter().all(|d| *d >= 0.0) || sides_of_t.iter().all(|d| *d <= 0.0) {
        return false;
    }
    let sides_of_s = s.map(|p| side(t, p));
    if sides_of_s.iter().all(|d| *d >= 0.0) || sides_of_s.iter().all(|d| *d <= 0.0) {
        return false;
    }
    (0..3).any(|k| pierces(s[k], s[(k + 1) % 3], sides_of_s[k], sides_of_s[(k + 1) % 3], t))
        || (0..3).any(|k| pierces(t[k], t[(k + 1) % 3], sides_of_t[k], sides_of_t[(k + 1) % 3], s))
}

fn pierces(p: DVec3, q: DVec3, side_p: f64, side_q: f64, [a, b, c]: [DVec3; 3]) -> bool {
    if side_p * side_q >= 0.0 {
        return false;
    }
    let turns = [side([p, q, a], b), side([p, q, b], c), side([p, q, c], a)];
    turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0)
}

/// The exact sign of the volume between a triangle and a point.
#[inline]
fn side([a, b, c]: [DVec3; 3], p: DVec3) -> f64 {
    let coord = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
    orient3d(coord(a), coord(b), coord(c), coord(p)).signum_or_zero()
}

trait SignumOrZero {
    fn signum_or_zero(self) -> f64;
}

impl SignumOrZero for f64 {
    /// Products of two signs neither overflow nor vanish.
    #[inline]
    fn signum_or_zero(self) -> f64 {
        f64::from(i8::from(self > 0.0) - i8::from(self < 0.0))
    }
}

/// Whether a plane stands between two bodies, by more than rounding could be wrong about.
fn parts(plane: &Plane, a: &[f32], b: &[f32]) -> bool {
    let heights = |body: &[f32]| {
        body.chunks_exact(3)
            .map(|p| plane.normal.dot(Vec3::from_slice(p).as_dvec3()))
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| [low.min(h), high.max(h)])
    };
    let [_, highest] = heights(a);
    let [lowest, _] = heights(b);
    lowest - highest > 1.0e-9 * (1.0 + highest.abs())
}

/// Counts the pairs of a colony that pass through each other, a piece at a time.
#[derive(Debug, Default)]
pub(super) struct Count {
    boxes: Vec<Boxes>,
    bounds: Vec<Bounds>,
    pairs: Option<Vec<[u32; 2]>>,
    next: usize,
    pub(super) crossing: Vec<[u32; 2]>,
    /// Planes that may part a body from others: where one does, no triangle has to be looked at.
    planes: Vec<Vec<Plane>>,
}

impl Count {
    pub(super) fn with(planes: Vec<Vec<Plane>>) -> Self {
        Count { planes, ..Count::default() }
    }

    /// True when all pairs are counted.
    pub(super) fn advance(&mut self, layout: &Layout, positions: &[f32], bodies: usize, pairs: usize) -> bool {
        let step = 3 * usize::from(layout.vertices);
        let Some(all) = &self.pairs else {
            for positions in positions.chunks_exact(step).skip(self.boxes.len()).take(bodies) {
                let (boxes, whole) = Boxes::of(layout, positions);
                self.boxes.push(boxes);
                self.bounds.push(whole);
            }
            if self.boxes.len() * step == positions.len() {
                self.pairs = Some(overlapping(&self.bounds));
            }
            return false;
        };
        let to = (self.next + pairs).min(all.len());
        for &[i, j] in &all[self.next..to] {
            let of = |k: u32| {
                let k = k as usize;
                (&positions[k * step..(k + 1) * step], &self.boxes[k], &self.bounds[k])
            };
            let known = self.planes.get(i as usize).and_then(|planes| planes.iter().find(|plane| plane.partner == j));
            if known.is_some_and(|plane| parts(plane, of(i).0, of(j).0)) {
                continue;
            }
            if cross(layout, of(i), of(j)) {
                self.crossing.push([i, j]);
            }
        }
        self.next = to;
        to == all.len()
    }

    pub(super) fn progress(&self) -> f64 {
        self.pairs.as_ref().map_or(0.0, |pairs| self.next as f64 / pairs.len().max(1) as f64)
    }
}
