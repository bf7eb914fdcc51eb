//! A stone as a convex body: the intersection of half-spaces, with its edges and corners rounded by wear.
//!
//! A point x lies in the body where its gauge G(x) ≤ 1. With planes mᵢ·x = 1, G = maxᵢ mᵢ·x describes the polytope that
//! they bound: a freshly broken stone. The p-norm Gₚ(x) = (Σᵢ max(0, mᵢ·x)ᵖ)^(1/p) describes a body inside it with
//! rounded edges and even rounder corners, as abrasion rounds a pebble (Bloore 1977, *The shape of pebbles*; Domokos &
//! Gibbons 2012). As wear grows, p falls from about 90 to 2. Only powers of two are evaluated, by squaring and √, and
//! the values between are blended, so the result has the same bits on every platform.

use glam::{DVec3, Vec4};

/// Number of planes per SIMD vector.
const LANES: usize = 4;

/// log₂ of the largest power of two used for p: 2⁶. The blend also needs 2⁷.
const MAX_SQUARINGS: f64 = 6.0;

/// The half-spaces that bound one stone, relative to its middle.
#[derive(Debug, Default)]
pub(super) struct Body {
    /// Each plane's normal divided by its distance from the middle, four planes per entry.
    planes: Vec<[Vec4; 3]>,
    len: usize,
    squarings: u32,
    blend: f64,
    /// Balls that are cut out of it.
    chips: Vec<Chip>,
    /// How far the edges of chips are rounded, as a share of the distance from the middle.
    soft: f64,
}

/// A ball that has been cut out of a body: the hollow that a flake leaves where it breaks off.
#[derive(Debug)]
struct Chip {
    middle: DVec3,
    /// By how much the square of the middle's distance is larger than that of the ball's radius.
    power: f64,
}

/// A chip takes at most this share of the distance from the middle.
const MOST_CHIPPED: f64 = 0.22;

impl Body {
    /// Removes all planes and sets the wear: 0 is freshly broken, 1 is fully rounded.
    pub(super) fn start(&mut self, wear: f64) {
        self.planes.clear();
        self.chips.clear();
        self.len = 0;
        self.soft = 0.01 + 0.04 * wear.clamp(0.0, 1.0);
        let log_p = MAX_SQUARINGS + 0.5 - (MAX_SQUARINGS - 0.5) * wear.clamp(0.0, 1.0);
        let whole = log_p.floor();
        self.squarings = whole as u32;
        self.blend = log_p - whole;
    }

    /// Adds the half-space on the inner side of the plane with this unit normal at this distance from the middle.
    pub(super) fn push(&mut self, normal: DVec3, distance: f64) {
        let lane = self.len % LANES;
        if lane == 0 {
            // A lane of zeros bounds nothing.
            self.planes.push([Vec4::ZERO; 3]);
        }
        let scaled = (normal / distance).as_vec3().to_array();
        if let Some(group) = self.planes.last_mut() {
            for (axis, value) in group.iter_mut().zip(scaled) {
                axis[lane] = value;
            }
        }
        self.len += 1;
    }

    /// Cuts a ball of this radius out of the body, in the direction `at`, so that it goes this deep.
    pub(super) fn chip(&mut self, at: DVec3, radius: f64, depth: f64) {
        let distance = at.length() / self.gauge(at).max(1.0e-12) + radius - depth;
        let middle = at.normalize_or(DVec3::Z) * distance;
        self.chips.push(Chip { middle, power: distance * distance - radius * radius });
    }

    /// How much of a ray is in the body: where it comes out, in units of its length.
    #[inline(never)]
    pub(super) fn reach(&self, ray: DVec3) -> f64 {
        let whole = 1.0 / self.gauge(ray).max(1.0e-12);
        let square = ray.length_squared();
        let soft = self.soft * whole;
        let mut reach = whole;
        for Chip { middle, power } in &self.chips {
            let along = middle.dot(ray);
            let root = along * along - square * power;
            if along <= 0.0 || root <= 0.0 {
                continue;
            }
            let inside = (along - root.sqrt()) / square;
            // The smaller of both, with a rounded edge between them (Quilez, *Smooth minimum*).
            let share = (0.5 + 0.5 * (reach - inside) / soft).clamp(0.0, 1.0);
            reach += (inside - reach) * share - soft * share * (1.0 - share);
        }
        reach.max((1.0 - MOST_CHIPPED) * whole)
    }

    /// How near a direction is to an edge or a corner, 0 … 1: how high the second plane is there, relative to the highest.
    pub(super) fn edge(&self, at: DVec3) -> f64 {
        let at = at.as_vec3();
        let [x, y, z] = at.to_array().map(Vec4::splat);
        let (mut most, mut second) = (0.0_f32, 0.0_f32);
        for group in &self.planes {
            for height in (group[0] * x + group[1] * y + group[2] * z).to_array() {
                second = second.max(height.min(most));
                most = most.max(height);
            }
        }
        f64::from(second) / f64::from(most.max(1.0e-12))
    }

    /// The normals of the two planes that are highest in this direction, each divided by its distance from the middle, if the second is
    /// at least this high relative to the first.
    #[inline(never)]
    pub(super) fn highest_two(&self, at: DVec3, least: f32) -> Option<[DVec3; 2]> {
        let at = at.as_vec3();
        let [x, y, z] = at.to_array().map(Vec4::splat);
        let height = |group: &[Vec4; 3]| group[0] * x + group[1] * y + group[2] * z;
        let first = self.planes.iter().fold(Vec4::ZERO, |most, group| most.max(height(group))).max_element();
        let below = |most: Vec4, group| {
            let height = height(group);
            most.max(Vec4::select(height.cmplt(Vec4::splat(first)), height, Vec4::ZERO))
        };
        let second = self.planes.iter().fold(Vec4::ZERO, below).max_element();
        if second < least * first {
            return None;
        }
        let plane = |wanted: f32| {
            self.planes.iter().find_map(|group| {
                let lane = height(group).to_array().iter().position(|&height| height == wanted)?;
                Some(DVec3::from(group.map(|axis| f64::from(axis[lane]))))
            })
        };
        Some([plane(first)?, plane(second)?])
    }

    /// The gauge Gₚ(x). It is positive in every direction in which a plane bounds the body, and 0 in all others.
    pub(super) fn gauge(&self, at: DVec3) -> f64 {
        let at = at.as_vec3();
        let [x, y, z] = at.to_array().map(Vec4::splat);
        let height = |group: &[Vec4; 3]| (group[0] * x + group[1] * y + group[2] * z).max(Vec4::ZERO);
        let most = self.planes.iter().fold(Vec4::ZERO, |most, group| most.max(height(group)));
        let most = most.max_element();
        if most <= 0.0 {
            return 0.0;
        }
        // Values are scaled by the largest one, so that no power overflows. Those that underflow are too small to
        // matter.
        let scale = Vec4::splat(1.0 / most);
        let (mut sum, mut sum_of_squares) = (Vec4::ZERO, Vec4::ZERO);
        for group in &self.planes {
            let mut power = height(group) * scale;
            for _ in 0..self.squarings {
                power *= power;
            }
            sum += power;
            sum_of_squares += power * power;
        }
        let root = |sum: Vec4, squarings: u32| {
            let [a, b, c, d] = sum.to_array().map(f64::from);
            (0..squarings).fold((a + b) + (c + d), |root, _| root.sqrt())
        };
        let (rounder, sharper) = (root(sum, self.squarings), root(sum_of_squares, self.squarings + 1));
        f64::from(most) * (rounder + (sharper - rounder) * self.blend)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(wear: f64) -> Body {
        let mut body = Body::default();
        body.start(wear);
        for normal in [DVec3::X, DVec3::Y, DVec3::Z] {
            body.push(normal, 1.0);
            body.push(-normal, 1.0);
        }
        body
    }

    #[test]
    fn wear_rounds_corners_before_edges_and_leaves_faces() {
        let [face, edge, corner] = [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE];
        let mut before = [1.0, 1.0, 1.0];
        for wear in [0.0, 0.3, 0.6, 1.0] {
            let body = cube(wear);
            let gauge = [face, edge, corner].map(|at| body.gauge(at));
            assert!((gauge[0] - 1.0).abs() < 1.0e-6);
            assert!(gauge[1] > before[1] && gauge[2] > before[2] && gauge[2] > gauge[1], "{gauge:?} after {before:?}");
            before = gauge;
        }
        assert!(cube(0.0).gauge(corner) < 1.05, "freshly broken corners are sharp");
        assert!(cube(1.0).gauge(corner) > 1.5, "a river's are round");
    }

    #[test]
    fn the_gauge_is_homogeneous() {
        let body = cube(0.5);
        let at = DVec3::new(0.3, -0.8, 0.45);
        assert!((body.gauge(at * 3.0) - 3.0 * body.gauge(at)).abs() < 1.0e-5);
    }
}
