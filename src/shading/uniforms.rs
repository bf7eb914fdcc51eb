//! The uniform blocks, which have the same fields as in `shaders/common.wgsl`; `shaders/tests.rs` compares the sizes.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::beam;

/// Written once per frame and view. Size 288 B.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct Globals {
    /// Column-major, for positions relative to the eye.
    pub(crate) clip_from_eye: [[f32; 4]; 4],
    /// xyz the eye, px; w device pixels per CSS pixel.
    pub(crate) eye: [f32; 4],
    /// w: width of the picture, device pixels.
    pub(crate) ray_right: [f32; 4],
    /// w: height of the picture, device pixels.
    pub(crate) ray_up: [f32; 4],
    /// w: 1 in the wireframe view.
    pub(crate) ray_forward: [f32; 4],
    /// For plans: xy the middle in px of the image, zw the scale from px to clip space.
    pub(crate) plan: [f32; 4],
    /// The part of the picture that is drawn, device pixels: xy its upper left corner, zw its size.
    pub(crate) tile: [f32; 4],
    /// Linear colour; w is not used.
    pub(crate) backdrop_low: [f32; 4],
    /// Linear colour; w is not used.
    pub(crate) backdrop_high: [f32; 4],
    /// w: 1 or 2 where black or white stands in for ground and backdrop, else 0.
    pub(crate) soil: [f32; 4],
    /// Linear colour; w is not used.
    pub(crate) dust: [f32; 4],
    /// Variation, wetness, moss, dust.
    pub(crate) weather: [f32; 4],
    /// x how much snow has fallen, 0…1; y how high water stands, as a share of the height of the highest rock.
    pub(crate) waters: [f32; 4],
    /// x ground, y 1 / the number of a still's sample, z 1 in natural colours, w kind of the debris (0 mixed).
    pub(crate) scene: [f32; 4],
    /// Moisture, variation, translucency and velvet of wood ears.
    pub(crate) flesh: [f32; 4],
}

/// Written once per field and for each of its copies, and for every sample of a still. Size 480 B.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct FieldUniforms {
    pub(crate) sun_from_world: [[f32; 4]; 4],
    /// xyz unit vector towards the sun; w side of the shadow map in px of the world.
    pub(crate) sun: [f32; 4],
    /// xy corner of the height map, px; zw 1 / its sides.
    pub(crate) map: [f32; 4],
    /// xy image width and height, z top of the highest rock, w top of everything, px.
    pub(crate) size: [f32; 4],
    /// x width of the soil's fade, y one texel of the height map, px; z 1 if something extends below
    /// the ground; w the least height that casts a shadow.
    pub(crate) ground: [f32; 4],
    /// x middle of the log along x, y half its length (0 if there is no log), z its radius, w height of its axis, px.
    pub(crate) log: [f32; 4],
    /// y of the log's axis, px: the coefficients of a polynomial in t, −1…1 from end to end.
    pub(crate) bow: [f32; 4],
    /// The sun's light; w how deep the rocks stand in snow, px.
    pub(crate) sunshine: [f32; 4],
    /// [`super::Sky::diffuse`]; w of the first two: the sun's azimuth as a direction.
    pub(crate) sky: [[f32; 4]; 6],
    /// Of a sample of a still: the light from a point of the sky, as for the sun above.
    pub(crate) sky_from_world: [[f32; 4]; 4],
    pub(crate) sky_way: [f32; 4],
    /// The same for the light from a point of the ground.
    pub(crate) below_from_world: [[f32; 4]; 4],
    pub(crate) below_way: [f32; 4],
    /// Of the sun's shadow map: xy 1 / its sides, px; z half the width of a half-shadow whose caster is before it by a depth of 1, w of the
    /// widest, px.
    pub(crate) shadow: [f32; 4],
    /// xyz how far a copy of the field is moved, px; w a number of its own, 0 for the field itself.
    pub(crate) shift: [f32; 4],
    /// [`super::Bricks::uniform`]; w 1 if the maps are right for copies.
    pub(crate) bricks: [f32; 4],
}

impl FieldUniforms {
    /// Width of a half-shadow for each px to its caster: the sun's disc and the bright sky round it.
    const SPREAD: f32 = 0.035;

    /// Lower than anything is.
    pub(crate) const LOWEST: f32 = -1.0e9;

    /// Fits the sun's orthographic camera and the height map to the box `low`…`high`.
    pub(crate) fn fitted(sun: Vec3, image: [f32; 2], low: Vec3, high: Vec3, side: f32) -> Self {
        // There must be room on the ground for the longest shadow, so that none is cut off at the map's edge.
        let reach = high.z * (sun.truncate().length() / sun.z);
        let bounds = [low - Vec3::new(reach, reach, 0.0), high + Vec3::new(reach, reach, 0.0)];
        let (sun_from_world, across) = beam(sun, bounds, bounds);
        // With a margin of four texels, samples at the border read empty ground.
        let extent = (high - low).truncate();
        let texel = extent.max_element() / (side - 8.0);
        let corner = low.truncate() - Vec2::splat(4.0 * texel);
        let scale = (extent + Vec2::splat(8.0 * texel)).recip();
        // Depth is 1 over so many px: the rows of the matrix are as long as the map is wide and deep.
        let [across_x, across_y, deep] = [0, 1, 2].map(|row| sun_from_world.row(row).truncate().length());
        let top = high.z.max(1.0);
        let half = 0.5 * Self::SPREAD;
        Self {
            sun_from_world: sun_from_world.to_cols_array_2d(),
            shadow: [0.5 * across_x, 0.5 * across_y, half / deep, half * top / sun.z.max(0.2)],
            sun: sun.extend(across).to_array(),
            map: [corner.x, corner.y, scale.x, scale.y],
            size: [image[0], image[1], top, top],
            ground: [0.36 * image[0].max(image[1]), texel, 0.0, Self::LOWEST],
            ..Self::zeroed()
        }
    }
}
