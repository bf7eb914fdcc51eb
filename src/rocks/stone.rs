//! Maps the disc of a rock's vertices onto the body of a stone; see `wear.rs`.

use glam::{DVec2, DVec3};

use super::body::Body;

/// Everything that is needed to map the disc onto the body.
#[derive(Debug)]
pub(super) struct Stone {
    pub(super) centre: DVec3,
    /// Mean distance of the sides from the middle, px.
    pub(super) radius: f64,
    /// Height above the waist and depth below it, px.
    pub(super) semi: [f64; 2],
    /// Scale of the body across and upward.
    pub(super) scale: [f64; 2],
    pub(super) axis: DVec2,
    pub(super) squeeze: f64,
    /// √2·sin(θ/2) at the last ring, with θ measured from the zenith.
    pub(super) last: f64,
    /// Place of that ring on the disc, 0 … 1.
    pub(super) first_ring: f64,
    /// By how much the share that the rim has in a vertex is multiplied, so that those next to the rim are in that ring.
    pub(super) last_ring: f64,
    pub(super) sink: f64,
    /// Whether its edges are so sharp that vertices slide to them.
    pub(super) is_sharp: bool,
    /// How high the second plane has to be, relative to the highest, for its edge to be within a vertex's reach.
    pub(super) near_edge: f32,
}

impl Stone {
    /// Returns the place of the disc's point `at` on the stone, relative to the stone's middle. `ring` is how far out
    /// the point is, 0 in the middle, 1 on the chords between the rim's corners.
    #[inline(never)]
    pub(super) fn at(&self, body: &Body, at: DVec2, ring: f64) -> DVec3 {
        let ray = self.ray(at, ring);
        let on_body = ray * body.reach(ray);
        let across = on_body.truncate() * self.scale[0];
        let squeezed = across - self.axis * (self.axis.dot(across) * (1.0 - self.squeeze));
        squeezed.extend(on_body.z * self.scale[1])
    }

    /// The direction of the disc's point `at` in the body.
    #[inline(never)]
    fn ray(&self, at: DVec2, ring: f64) -> DVec3 {
        // Lambert's azimuthal projection keeps areas, so triangles stay even, and it needs no trigonometry.
        let t = self.last * (ring / self.first_ring).min(1.0);
        let cos = 1.0 - t * t;
        let sin = t * (2.0 - t * t).max(0.0).sqrt();
        let [up, down] = self.semi;
        (at.normalize_or(DVec2::X) * (sin * self.radius)).extend(cos * if cos > 0.0 { up } else { down })
    }

    /// How far a vertex has to go on the disc to be on the edge between the two planes that are highest there, or nothing if that is out of
    /// its reach; `steps` are the ways to its neighbours. Otherwise triangles across an edge would be the teeth of a saw.
    #[inline(never)]
    pub(super) fn slide(&self, body: &Body, at: DVec2, steps: [DVec2; 2]) -> DVec2 {
        let ray = |at: DVec2| self.ray(at, at.length());
        let here = ray(at);
        let Some([first, second]) = body.highest_two(here, self.near_edge) else { return DVec2::ZERO };
        let apart = |ray: DVec3| (first - second).dot(ray);
        let height = apart(here);
        // The shortest way down is against the slope, in steps.
        let slope = DVec2::from(steps.map(|step| apart(ray(at + step)) - height));
        let square = slope.length_squared();
        if height * height >= SLIDE * SLIDE * square {
            return DVec2::ZERO;
        }
        let way = slope * (-height / square);
        let way = steps[0] * way.x + steps[1] * way.y;
        // Heights of planes are nearly linear along it.
        let left = apart(ray(at + way));
        way * (height / (height - left)).clamp(0.5, 1.5)
    }
}

/// Vertices slide by at most this share of the way to the next one.
const SLIDE: f64 = 0.42;
