//! Decides whether two bodies pass through each other, based on the numbers in the buffers.

use glam::{DVec3, Vec3};

use super::body::Layout;
use super::pairs::{Bounds, overlapping};
use super::pose::Plane;
use super::work::tally;

/// Number of triangles per box within a body.
const GROUP: usize = 12;

/// Boxes around groups of a body's triangles.
#[derive(Debug, Clone, Default)]
pub(super) struct Boxes {
    groups: Vec<Bounds>,
}

impl Boxes {
    /// Computes the boxes of a body, and the box around the whole body.
    pub(super) fn of(layout: &Layout, positions: &[f32]) -> (Self, Bounds) {
        tally(30 * layout.triangles.len());
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

/// Whether an edge of one body passes through the inside of a triangle of the other. `a` and `b` are the positions, the
/// boxes and the whole box of each body.
///
/// Touching and coplanar faces do not count (decision K11).
pub(super) fn cross(layout: &Layout, a: (&[f32], &Boxes, &Bounds), b: (&[f32], &Boxes, &Bounds)) -> bool {
    tally(5 * a.1.groups.len());
    for (g, of_a) in a.1.groups.iter().enumerate() {
        if !of_a.overlaps(b.2) {
            continue;
        }
        tally(5 * b.1.groups.len());
        for (h, of_b) in b.1.groups.iter().enumerate() {
            if of_a.overlaps(of_b) && groups_cross(layout, (a.0, g), (b.0, h), of_b) {
                return true;
            }
        }
    }
    false
}

fn groups_cross(layout: &Layout, (a, g): (&[f32], usize), (b, h): (&[f32], usize), around_b: &Bounds) -> bool {
    tally(20 * GROUP);
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

/// Whether an edge of one triangle passes through the inside of the other.
pub(super) fn triangles_cross(s: [DVec3; 3], t: [DVec3; 3]) -> bool {
    tally(50);
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

/// The sign of the volume between a triangle and a point: 1, −1 or 0.
///
/// It is computed in f64 if the result is certain (bound from Shewchuk 1997, *Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates*), and otherwise with twice the digits. Numbers in the buffers have
/// 24 bits and their differences here about 33, so a product of three of them fits: the result is exact, unless a
/// coordinate is extremely close to 0. The crate `robust` would remove even that exception, but takes 4 kB more.
#[inline]
fn side([a, b, c]: [DVec3; 3], p: DVec3) -> f64 {
    let [u, v, w] = [a - p, b - p, c - p];
    let volume = u.dot(v.cross(w));
    let size = |x: f64, y: f64, z: f64, r: f64, s: f64| (x * y).abs() * r.abs() + (z * s).abs() * r.abs();
    let permanent = size(v.y, w.z, v.z, u.x, w.y) + size(v.z, w.x, v.x, u.y, w.z) + size(v.x, w.y, v.y, u.z, w.x);
    if volume.abs() > 8.0e-16 * permanent { sign(volume) } else { side_by_doubles(u, v, w) }
}

/// The sign of a number: 1, −1 or 0. Unlike the numbers, products of two signs neither overflow nor vanish.
#[inline]
fn sign(x: f64) -> f64 {
    f64::from(i8::from(x > 0.0) - i8::from(x < 0.0))
}

#[cold]
#[inline(never)]
fn side_by_doubles(u: DVec3, v: DVec3, w: DVec3) -> f64 {
    let mut sum = [0.0; 2];
    let terms =
        [(v.y, w.z, u.x), (-v.z, w.y, u.x), (v.z, w.x, u.y), (-v.x, w.z, u.y), (v.x, w.y, u.z), (-v.y, w.x, u.z)];
    for (x, y, z) in terms {
        let [high, low] = product(x, y);
        let [p, q] = [product(high, z), product(low, z)];
        for part in [p[0], p[1] + q[0], q[1]] {
            let [s, e] = two_sum(sum[0], part);
            sum = two_sum(s, e + sum[1]);
        }
    }
    sign(if sum[0] == 0.0 { sum[1] } else { sum[0] })
}

/// a + b and its rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let s = a + b;
    let t = s - a;
    [s, (a - (s - t)) + (b - t)]
}

/// a · b and its rounding error (Dekker, Veltkamp).
fn product(a: f64, b: f64) -> [f64; 2] {
    let split = |x: f64| {
        let t = 134_217_729.0 * x;
        let high = t - (t - x);
        [high, x - high]
    };
    let p = a * b;
    let ([ah, al], [bh, bl]) = (split(a), split(b));
    [p, ((ah * bh - p) + ah * bl + al * bh) + al * bl]
}

/// Whether a plane lies between two bodies by a margin larger than any rounding error.
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

/// Counts the pairs of a colony that pass through each other, some of them per step.
#[derive(Debug, Default)]
pub(super) struct Count {
    boxes: Vec<Boxes>,
    bounds: Vec<Bounds>,
    pairs: Option<Vec<[u32; 2]>>,
    next: usize,
    pub(super) crossing: Vec<[u32; 2]>,
    /// Per body, planes that may separate it from others. If one does, the pair's triangles need not be tested.
    planes: Vec<Vec<Plane>>,
}

impl Count {
    pub(super) fn with(planes: Vec<Vec<Plane>>) -> Self {
        Count { planes, ..Count::default() }
    }

    /// Works on up to `bodies` bodies or `pairs` pairs. Returns true when all pairs are counted.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_is_that_of_exact_predicates() {
        let mut state = 1_u64;
        let mut number = |steps: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from((100.0 + ((state >> 40) as f64 / (1 << 24) as f64 * steps).floor() / steps) as f32)
        };
        let mut zeros = 0;
        for k in 0..200_000 {
            // With few steps, many points are coplanar or nearly so.
            let steps = [3.0, 1000.0, 1.0e6][k % 3];
            let mut point = || DVec3::new(number(steps), number(steps), number(steps));
            let [a, b, c] = [point(), point(), point()];
            let p = if k % 2 == 0 { point() } else { (a + b * 0.5 + c * 0.5).as_vec3().as_dvec3() * 0.5 };
            let coord = |p: DVec3| robust::Coord3D { x: p.x, y: p.y, z: p.z };
            let exact = sign(robust::orient3d(coord(a), coord(b), coord(c), coord(p)));
            assert_eq!(side([a, b, c], p), exact, "{a} {b} {c} {p}");
            zeros += usize::from(exact == 0.0);
        }
        assert!(zeros > 1000);
    }
}
