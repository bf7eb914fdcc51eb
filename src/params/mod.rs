//! The parameters of rocks: one table ([`PARAMS`]), the struct it describes, and the presets; those of wood ears are in [`wood_ear`].
//!
//! Whatever lists parameters anywhere (sliders, links, TypeScript types, JSON Schema, README) is
//! generated from the table; `tests/params.rs` regenerates it and fails on a difference.

mod flat;
mod presets;
mod spec;
mod table;
pub mod wood_ear;

pub use presets::{PRESETS, Preset, preset};
pub use spec::{Kind, Range, Slider, Text};
pub use table::{PARAMS, Stage, TEXTS};

use crate::error::Error;

/// One row of the rocks' table.
pub type ParamSpec = spec::ParamSpec<Params, Layer, Stage>;
/// Whether a parameter belongs to the field or to each of its layers.
pub type Scope = spec::Scope<Params, Layer>;

/// Most layers a field can have.
pub const MAX_LAYERS: usize = 8;

/// Units of the lengths (decisions A5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Notation {
    /// The journal's: radius, taper and height in px.
    #[default]
    Px,
    /// The conference's: radius and taper in image width / 100, height in multiples of the radius.
    Relative,
}

/// How long Fig. 4 throws darts (decision A1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Darts {
    /// Until N_p sites stand or no free pixel is left.
    #[default]
    Saturate,
    /// Exactly N_p throws, as the pseudo-code is written.
    Attempts,
}

/// What becomes of cells that touch the image's border (decision A6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Border {
    /// Clipped to the image and kept as candidates.
    #[default]
    Clip,
    /// Refused.
    Drop,
}

/// Whether Eqs 2 and 3 use the same j1, j2 (decision A11).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Swing {
    /// The same numbers: wide rocks are the tall ones.
    #[default]
    Shared,
    /// Two independent draws.
    Separate,
}

/// What a layer's rocks are made of; only how they are drawn depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Material {
    /// Every rock its own: what a river carries together.
    #[default]
    Mixed,
    /// Interlocking grains of three minerals.
    Granite,
    /// Dark, fine, a little porous.
    Basalt,
    /// Bedded, each rock tilted its own way.
    Sandstone,
    /// Pale and smooth.
    Limestone,
    /// Blue-grey, thinly cleaved.
    Slate,
}

/// What lies between and around the rocks; only the picture depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ground {
    /// Dark crumbs of earth.
    #[default]
    Soil,
    /// Pale fine grains.
    Sand,
    /// Pebbles too small to be rocks of their own.
    Gravel,
}

/// How a field is lit and worn to the eye: drawn, never generated, and in no hash.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// How far the rocks differ in colour and value, 0 … 1.
    pub variation: f64,
    /// 0 dry … 1 wet: darker and glossy.
    pub wetness: f64,
    /// Share of the moss that could grow, 0 … 1.
    pub moss: f64,
    /// Dust on what faces up, 0 … 1.
    pub dust: f64,
    /// Between and around the rocks.
    pub ground: Ground,
    /// Degrees, counted as the camera's azimuth: at 0 the sun stands towards −y, at 90 towards +x.
    pub sun_azimuth: f64,
    /// Degrees above the horizon.
    pub sun_elevation: f64,
}

/// One layer, in the notation of its [`Params`].
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Stable identity: the layer's random streams hang on it, not on its place in the list.
    pub id: u32,
    /// Disc radius r: no two sites are closer.
    pub radius: f64,
    /// A_s: share of the whole image the layer may fill.
    pub area_fraction: f64,
    /// Number of cells instead of an area.
    pub cell_count: Option<u32>,
    /// c_w1, c_w2, c_w3 of Eq. 2.
    pub taper: [f64; 3],
    /// c_h1, c_h2, c_h3 of Eq. 3.
    pub height: [f64; 3],
    /// 0 the papers' mesh, 0.2 freshly broken stone … 1 rounded by a river.
    pub weathering: f64,
    /// Share of the noise that displaces the surface.
    pub roughness: f64,
    /// How often every triangle is cut into four.
    pub detail: u32,
    /// Share of a rock's height that lies below the ground.
    pub embedding: f64,
    /// What the rocks are made of.
    pub material: Material,
}

/// Everything a field is a function of.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// The integer that starts the generator.
    pub seed: u32,
    /// W, px.
    pub image_width: u32,
    /// H, px.
    pub image_height: u32,
    /// c_d of Eq. 1.
    pub packing: f64,
    /// Units of the layers' lengths.
    pub notation: Notation,
    /// Reading of Fig. 4.
    pub darts: Darts,
    /// Border cells.
    pub border: Border,
    /// Shared or separate j1, j2.
    pub swing: Swing,
    /// How the field is drawn.
    pub look: Look,
    /// Layers in input order, at most [`MAX_LAYERS`].
    pub layers: Vec<Layer>,
}

impl Params {
    /// W·H.
    pub fn pixels(&self) -> u64 {
        u64::from(self.image_width) * u64::from(self.image_height)
    }

    /// The layer with its lengths converted to px (decision A5).
    pub fn layer_in_px(&self, layer: &Layer) -> Layer {
        match self.notation {
            Notation::Px => layer.clone(),
            Notation::Relative => {
                let unit = f64::from(self.image_width) / 100.0;
                let radius = layer.radius * unit;
                Layer {
                    radius,
                    taper: layer.taper.map(|c| c * unit),
                    height: layer.height.map(|c| c * radius),
                    ..layer.clone()
                }
            }
        }
    }

    /// Checks every value against the table.
    ///
    /// # Errors
    /// The first parameter that is out of range, with its key, value and bounds.
    pub fn validate(&self) -> Result<(), Error> {
        Params::from_flat(&self.to_flat()).map(|_| ())
    }
}
