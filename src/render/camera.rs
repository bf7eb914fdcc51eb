//! From the page's orbit camera to matrices. Conventions as everywhere: z up, depth 0…1, column vectors.

use glam::{Mat4, Vec3, Vec4};

/// Vertical field of view, radians: 36°, long enough to keep boulders from leaning. The same number is
/// in `www/camera.ts`.
pub(crate) const FOV_Y: f32 = 36.0 * std::f32::consts::PI / 180.0;

/// An eye on a sphere around a target; at azimuth 0 it looks along +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    /// Radians, counter-clockwise seen from above.
    pub(crate) azimuth: f32,
    /// Radians above the ground.
    pub(crate) elevation: f32,
    /// px.
    pub(crate) distance: f32,
    /// px.
    pub(crate) target: [f32; 3],
}

/// Unit axes of the picture and the eye, in the world.
pub(crate) struct Frame {
    pub(crate) eye: Vec3,
    pub(crate) right: Vec3,
    pub(crate) up: Vec3,
    pub(crate) forward: Vec3,
}

impl Camera {
    /// A camera that cannot produce NaN: anything not finite falls back, the distance stays positive.
    pub(crate) fn sanitised(self) -> Self {
        let or = |value: f32, fallback: f32| if value.is_finite() { value } else { fallback };
        Self {
            azimuth: or(self.azimuth, 0.0),
            elevation: or(self.elevation, 1.0).clamp(0.01, std::f32::consts::FRAC_PI_2),
            distance: or(self.distance, 1.0).max(1.0),
            target: self.target.map(|value| or(value, 0.0)),
        }
    }

    /// The axes: up is taken from the azimuth, so that looking straight down is no special case.
    pub(crate) fn frame(&self) -> Frame {
        let (sin_a, cos_a) = self.azimuth.sin_cos();
        let (sin_e, cos_e) = self.elevation.sin_cos();
        let ahead = Vec3::new(-sin_a, cos_a, 0.0);
        let forward = ahead * cos_e - Vec3::Z * sin_e;
        Frame {
            eye: Vec3::from(self.target) - forward * self.distance,
            right: Vec3::new(cos_a, sin_a, 0.0),
            up: ahead * sin_e + Vec3::Z * cos_e,
            forward,
        }
    }
}

impl Frame {
    /// Clip space from positions relative to the eye, with near and far just around the sphere
    /// (`center`, `radius`) that holds everything drawn with depth; with
    /// `horizon`, far is as far as the ground goes.
    pub(crate) fn clip_from_eye(&self, aspect: f32, center: Vec3, radius: f32, horizon: bool) -> Mat4 {
        let ahead = (center - self.eye).dot(self.forward);
        let far = (ahead + radius).max(2.0);
        // 24 bits of depth want near not too small; 1/2000 of far still lets the eye stand among the rocks.
        let near = (ahead - radius).max(far / 2000.0).max(0.05);
        let view = Mat4::from_cols(
            Vec3::new(self.right.x, self.up.x, -self.forward.x).extend(0.0),
            Vec3::new(self.right.y, self.up.y, -self.forward.y).extend(0.0),
            Vec3::new(self.right.z, self.up.z, -self.forward.z).extend(0.0),
            Vec4::W,
        );
        // Costs next to nothing: depth is a matter of near.
        let far = if horizon { 10_000.0 * far } else { far };
        // The eye looks along -z, depth 0…1.
        let focal = 1.0 / (0.5 * FOV_Y).tan();
        let depth = far / (near - far);
        let projection = Mat4::from_cols(
            Vec4::X * (focal / aspect),
            Vec4::Y * focal,
            Vec4::new(0.0, 0.0, depth, -1.0),
            Vec4::Z * (near * depth),
        );
        projection * view
    }
}
