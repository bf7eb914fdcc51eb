//! The parallel light of a shadow map: its camera.

use glam::{Mat4, Vec2, Vec3, Vec4};

/// A box that is parallel to the axes: its lowest and its highest corner.
pub(crate) type Bounds = [Vec3; 2];

/// The camera of a light that shines along -`way`, a unit vector: it sees all of `lit`, and before and behind it all of `bodies`.
/// Returns the matrix from the world to its clip space, with depth 0…1, and the side of its picture in px of the world.
pub(crate) fn beam(way: Vec3, lit: Bounds, bodies: Bounds) -> (Mat4, f32) {
    // If the light comes straight from above, any direction will do.
    let right = Vec3::Z.cross(way).try_normalize().unwrap_or(Vec3::X);
    let up = way.cross(right);
    let axes = [right, up, -way];
    let [[left, least], [lower, most]] = [lit, bodies].map(|bounds| extent(axes, bounds));
    let (from, to) = (left.with_z(left.z.min(lower.z)), least.with_z(least.z.max(most.z)));
    let view = Mat4::from_cols(
        Vec3::new(right.x, up.x, -way.x).extend(0.0),
        Vec3::new(right.y, up.y, -way.y).extend(0.0),
        Vec3::new(right.z, up.z, -way.z).extend(0.0),
        Vec4::W,
    );
    let span = to - from;
    let to_clip = Mat4::from_scale(Vec3::new(2.0 / span.x, 2.0 / span.y, 1.0 / span.z))
        * Mat4::from_translation(Vec3::new(-(from.x + to.x) * 0.5, -(from.y + to.y) * 0.5, -from.z));
    (to_clip * view, span.x.max(span.y))
}

/// What a camera at `eye` sees of a box, with a margin. `ray` gives the direction of a place in the picture, -1…1.
pub(crate) fn in_sight(eye: Vec3, ray: impl Fn(Vec2) -> Vec3, bounds: Bounds) -> Bounds {
    const STEPS: u32 = 24;
    let [low, high] = bounds;
    let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for step in 0..=STEPS * (STEPS + 2) {
        let place = Vec2::new((step % (STEPS + 1)) as f32, (step / (STEPS + 1)) as f32);
        let way = ray(place * (2.0 / STEPS as f32) - 1.0);
        // Where it comes in and goes out, along each axis; one that is parallel to a side never meets it.
        let (a, b) = ((low - eye) / way, (high - eye) / way);
        let (enters, leaves) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
        if enters <= leaves {
            let [first, last] = [enters, leaves].map(|share| eye + way * share);
            least = least.min(first).min(last);
            most = most.max(first).max(last);
        }
    }
    if !(most - least).is_finite() {
        return bounds;
    }
    let margin = (most - least) / STEPS as f32 + Vec3::splat(high.z - low.z) * 0.25;
    [(least - margin).max(low), (most + margin).min(high)]
}

/// The bounds of a box along other axes.
fn extent(axes: [Vec3; 3], [low, high]: Bounds) -> Bounds {
    let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for corner in 0..8 {
        let pick = |bit: u32, a: f32, b: f32| if corner >> bit & 1 == 0 { a } else { b };
        let at = Vec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z));
        let seen = Vec3::from(axes.map(|axis| at.dot(axis)));
        least = least.min(seen);
        most = most.max(seen);
    }
    [least, most]
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIELD: Bounds = [Vec3::new(0.0, 0.0, -3.0), Vec3::new(400.0, 300.0, 40.0)];

    fn corners([low, high]: Bounds) -> impl Iterator<Item = Vec3> {
        (0..8).map(move |corner| {
            let pick = |bit: u32| corner >> bit & 1 == 0;
            Vec3::select(glam::BVec3::new(pick(0), pick(1), pick(2)), low, high)
        })
    }

    #[test]
    fn a_light_sees_all_that_it_lights_and_the_depth_of_all_bodies() {
        let lit = [Vec3::new(100.0, 50.0, 0.0), Vec3::new(180.0, 90.0, 20.0)];
        for way in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.64, 0.6), Vec3::new(0.0, 0.8, -0.6)] {
            let (from_world, side) = beam(way, lit, FIELD);
            assert!(side > 0.0 && side < 200.0, "{way}: {side}");
            for corner in corners(lit) {
                let clip = from_world.project_point3(corner);
                assert!(clip.truncate().abs().max_element() < 1.0001, "{way}: {corner} at {clip}");
            }
            for corner in corners(FIELD) {
                let depth = from_world.project_point3(corner).z;
                assert!((-0.0001..1.0001).contains(&depth), "{way}: {corner} at {depth}");
            }
            // What is nearer to the light has less depth.
            let [near, far] = [1.0, 0.0].map(|step| from_world.project_point3(lit[0] + way * step).z);
            assert!(near < far, "{way}");
        }
    }

    #[test]
    fn what_a_camera_sees_of_a_box_lies_in_what_is_said_to_be_in_sight() {
        for step in 0..40 {
            let turn = step as f32 * 0.7;
            let eye = Vec3::new(200.0 + 300.0 * turn.sin(), 150.0 + 250.0 * turn.cos(), 8.0 + 13.0 * step as f32);
            let ahead = (Vec3::new(200.0, 150.0, 10.0) - eye).normalize();
            let right = ahead.cross(Vec3::Z).normalize();
            let up = right.cross(ahead);
            let ray = |place: Vec2| ahead + 0.5 * place.x * right + 0.32 * place.y * up;
            let [low, high] = in_sight(eye, ray, FIELD);
            for number in 0..2000 {
                let share = |by: f32| (number as f32 * by).fract();
                let at =
                    FIELD[0] + (FIELD[1] - FIELD[0]) * Vec3::new(share(0.754_877), share(0.569_84), share(0.430_16));
                let away = at - eye;
                let far = away.dot(ahead);
                let place = Vec2::new(away.dot(right) / far / 0.5, away.dot(up) / far / 0.32);
                if far > 0.0 && place.abs().max_element() < 1.0 {
                    assert!(at.cmpge(low).all() && at.cmple(high).all(), "{eye}: {at} beside {low} {high}");
                }
            }
        }
    }

    #[test]
    fn a_camera_that_sees_nothing_of_the_box_leaves_it_whole() {
        let away = in_sight(Vec3::new(0.0, 0.0, 500.0), |_| Vec3::Z, FIELD);
        assert_eq!(away, FIELD);
    }
}
