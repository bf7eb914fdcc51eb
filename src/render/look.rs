//! How a field in natural colours looks beyond its mesh: weather, ground, stone, and where the sun stands.

use std::collections::BTreeMap;

use glam::Vec3;

/// How much work a pixel is worth; counted up, as the shaders compare it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Quality {
    Low,
    Medium,
    High,
}

/// What JavaScript sets with `setLook`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    /// Variation, wetness, moss and dust, 0…1.
    pub(crate) weather: [f32; 4],
    /// 0 soil, 1 sand, 2 gravel.
    pub(crate) ground: f32,
    /// Towards the sun, of length 1. Its light falls on all colour modes.
    pub(crate) sun: Vec3,
    /// What the smallest stones are made of, which have no mesh: as those of the last layer.
    pub(crate) debris: u8,
    /// Of wood ears: moisture, variation, translucency, velvet, 0…1.
    pub(crate) flesh: [f32; 4],
    /// By layer id; see [`super::palette::natural`].
    pub(crate) materials: BTreeMap<u32, u8>,
}

impl Default for Look {
    fn default() -> Self {
        Self::new(&[0.5, 0.0, 0.0, 0.2, 0.0, 259.0, 35.0], &[], &[])
    }
}

impl Look {
    /// `values`: variation, wetness, moss, dust, ground, the sun's azimuth and elevation in degrees, and of
    /// wood ears moisture, variation, translucency, velvet; what is missing or no number is 0.
    pub(crate) fn new(values: &[f32], layers: &[u32], materials: &[u8]) -> Self {
        let value = |at: usize| values.get(at).copied().filter(|value| value.is_finite()).unwrap_or(0.0);
        Self {
            weather: [0, 1, 2, 3].map(|at| value(at).clamp(0.0, 1.0)),
            ground: value(4).clamp(0.0, 2.0).round(),
            sun: sun(value(5), value(6)),
            debris: materials.last().copied().unwrap_or(0),
            flesh: [7, 8, 9, 10].map(|at| value(at).clamp(0.0, 1.0)),
            materials: layers.iter().copied().zip(materials.iter().copied()).collect(),
        }
    }

    /// Of the rocks of a layer; 0 where none was set.
    pub(crate) fn material(&self, layer: u32) -> u8 {
        self.materials.get(&layer).copied().unwrap_or(0)
    }
}

/// The azimuth is counted like the camera's: at the same angle the sun is behind the viewer.
fn sun(azimuth: f32, elevation: f32) -> Vec3 {
    let (sin_a, cos_a) = azimuth.to_radians().sin_cos();
    // Lower, and the shadow of a pebble would be longer than the map is wide.
    let (sin_e, cos_e) = elevation.clamp(5.0, 90.0).to_radians().sin_cos();
    Vec3::new(sin_a * cos_e, -cos_a * cos_e, sin_e)
}
