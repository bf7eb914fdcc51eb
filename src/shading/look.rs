//! How a field in natural colours looks beyond its mesh: weather, ground, stone, and the place of the sun.

use std::collections::BTreeMap;

use glam::Vec3;

use super::order::{FleshValues, LookValues};

/// The look that JavaScript sets with `setLook`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    /// Variation, wetness, moss and dust, 0…1.
    pub(crate) weather: [f32; 4],
    /// How much snow has fallen, 0…1.
    pub(crate) snow: f32,
    /// How high water stands, as a share of the height of the highest rock.
    pub(crate) water: f32,
    /// 0 soil, 1 sand, 2 gravel.
    pub(crate) ground: f32,
    /// Unit vector towards the sun. Its light is used in all colour modes.
    pub(crate) sun: Vec3,
    /// Material of the smallest stones, which have no mesh: that of the last layer.
    pub(crate) debris: u8,
    /// Moisture, variation, translucency and velvet of wood ears, 0…1.
    pub(crate) flesh: [f32; 4],
    /// Materials by layer id; see [`super::palette::natural`].
    pub(crate) materials: BTreeMap<u32, u8>,
}

impl Default for Look {
    fn default() -> Self {
        Self::new(&[0.5, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 259.0, 35.0], &[], &[])
    }
}

impl Look {
    /// `values` holds [`LookValues`] and then [`FleshValues`].
    pub(crate) fn new(values: &[f32], layers: &[u32], materials: &[u8]) -> Self {
        let mut values = values.iter().copied();
        let look = LookValues::take(&mut values);
        let flesh = FleshValues::take(&mut values);
        let share = |value: f32| value.clamp(0.0, 1.0);
        Self {
            weather: [look.variation, look.wetness, look.moss, look.dust].map(share),
            snow: share(look.snow),
            water: share(look.water),
            ground: look.ground.clamp(0.0, 2.0).round(),
            sun: sun(look.sun_azimuth, look.sun_elevation),
            debris: materials.last().copied().unwrap_or(0),
            flesh: [flesh.moisture, flesh.variation, flesh.translucency, flesh.velvet].map(share),
            materials: layers.iter().copied().zip(materials.iter().copied()).collect(),
        }
    }

    /// Material of the rocks of a layer; 0 if none was set.
    pub(crate) fn material(&self, layer: u32) -> u8 {
        self.materials.get(&layer).copied().unwrap_or(0)
    }
}

/// Unit vector towards the sun, for angles in degrees. The azimuth is counted like the camera's: at the same angle the
/// sun is behind the viewer.
fn sun(azimuth: f32, elevation: f32) -> Vec3 {
    let (sin_a, cos_a) = azimuth.to_radians().sin_cos();
    // If the sun were lower, the shadow of a pebble would be longer than the map is wide.
    let (sin_e, cos_e) = elevation.clamp(5.0, 90.0).to_radians().sin_cos();
    Vec3::new(sin_a * cos_e, -cos_a * cos_e, sin_e)
}
