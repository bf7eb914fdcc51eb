//! Converts the page's orbit camera to matrices. The conventions are those of the whole renderer: z up, depth 0…1,
//! column vectors.

use std::f32::consts::FRAC_PI_2;

use glam::{Mat4, Vec3, Vec4};

/// How far above the ground the eye is at least, px: from below it there is nothing to be seen.
const LOWEST: f32 = 1.0;

/// An eye on a sphere around a target. At azimuth 0 it looks along +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    /// Radians, counter-clockwise seen from above.
    pub(crate) azimuth: f32,
    /// Radians above the ground.
    pub(crate) elevation: f32,
    /// Distance of the eye from the target, px.
    pub(crate) distance: f32,
    /// The point that the eye looks at, px.
    pub(crate) target: [f32; 3],
    /// Vertical field of view, radians.
    pub(crate) fov: f32,
}

/// The eye and the unit axes of the picture, in the world.
pub(crate) struct Frame {
    pub(crate) eye: Vec3,
    pub(crate) right: Vec3,
    pub(crate) up: Vec3,
    pub(crate) forward: Vec3,
    /// Half the picture's height at a distance of one.
    pub(crate) tangent: f32,
}

impl Camera {
    /// Returns a camera that cannot produce NaN: values that are not finite are replaced by defaults, and the distance
    /// stays positive.
    pub(crate) fn sanitised(self) -> Self {
        let or = |value: f32, fallback: f32| if value.is_finite() { value } else { fallback };
        Self {
            azimuth: or(self.azimuth, 0.0),
            elevation: or(self.elevation, 1.0).clamp(-FRAC_PI_2, FRAC_PI_2),
            distance: or(self.distance, 1.0).max(1.0),
            target: self.target.map(|value| or(value, 0.0)),
            fov: or(self.fov, 1.0).clamp(0.02, 3.0),
        }
    }

    /// The eye and the axes. Up is derived from the azimuth, so that looking straight down is not a special case.
    pub(crate) fn frame(&self) -> Frame {
        let (sin_a, cos_a) = self.azimuth.sin_cos();
        let (sin_e, cos_e) = self.elevation.sin_cos();
        let ahead = Vec3::new(-sin_a, cos_a, 0.0);
        let forward = ahead * cos_e - Vec3::Z * sin_e;
        let eye = Vec3::from(self.target) - forward * self.distance;
        Frame {
            eye: eye.with_z(eye.z.max(LOWEST)),
            right: Vec3::new(cos_a, sin_a, 0.0),
            up: ahead * sin_e + Vec3::Z * cos_e,
            forward,
            tangent: self.tangent(),
        }
    }

    /// Half the picture's height at a distance of one.
    pub(crate) fn tangent(&self) -> f32 {
        (0.5 * self.fov).tan()
    }
}

impl Frame {
    /// The matrix from positions relative to the eye to clip space. Near and far lie just around the sphere (`center`,
    /// `radius`) that holds everything drawn with depth. `horizon` is given where the ground goes on: far is as far as it reaches, and
    /// near as near as anything can be that is no higher than so many px.
    pub(crate) fn clip_from_eye(&self, aspect: f32, center: Vec3, radius: f32, horizon: Option<f32>) -> Mat4 {
        let ahead = (center - self.eye).dot(self.forward);
        let far = (ahead + radius).max(2.0);
        // With 24 bits of depth, near must not be too small. 1/2000 of far still lets the eye stand among the rocks.
        // Where the lowest rays of the picture are as high.
        let below = |top: f32| (self.eye.z - top) / (self.tangent * self.up.z - self.forward.z);
        let near = horizon.map_or(ahead - radius, |top| (ahead - radius).min(0.95 * below(top)));
        let near = near.max(far / 2000.0).max(0.05);
        let view = Mat4::from_cols(
            Vec3::new(self.right.x, self.up.x, -self.forward.x).extend(0.0),
            Vec3::new(self.right.y, self.up.y, -self.forward.y).extend(0.0),
            Vec3::new(self.right.z, self.up.z, -self.forward.z).extend(0.0),
            Vec4::W,
        );
        // A larger far costs next to no precision, which depends on near.
        let far = if horizon.is_some() { 10_000.0 * far } else { far };
        // The eye looks along -z, and depth is 0…1.
        let focal = 1.0 / self.tangent;
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
