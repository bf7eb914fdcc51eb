//! The parameters of rocks: the table ([`PARAMS`]), the structs that it describes, and the presets. Numbers such as A5
//! refer to docs/decisions.md.

mod presets;
mod table;

pub use presets::{PRESETS, Preset, preset};
pub use table::{Layer, PARAMS, Stage, TEXTS};

use super::flat::{self, Flat};
use super::spec::{self, Notation};
use crate::error::Error;

/// One row of the rocks' table.
pub type ParamSpec = spec::ParamSpec<Params, Layer, Stage>;
/// Whether a parameter belongs to the field or to each of its layers.
pub type Scope = spec::Scope<Params, Layer>;

/// Most layers a field can have.
pub const MAX_LAYERS: usize = 8;

/// How often Fig. 4 throws darts (decision A1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Darts {
    /// Until N_p sites stand or no pixel is free.
    #[default]
    Saturate,
    /// Exactly N_p times, as the pseudo-code is written.
    Attempts,
}

/// What is done with cells that touch the image's border (decision A6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Border {
    /// They are clipped to the image and kept as candidates.
    #[default]
    Clip,
    /// They are never selected.
    Drop,
}

/// Whether Eqs 2 and 3 use the same j1 and j2 (decision A11).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Swing {
    /// They use the same numbers, so wide rocks are the tall ones.
    #[default]
    Shared,
    /// Each equation draws its own numbers.
    Separate,
}

/// Whether rocks may pass through each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Crossing {
    /// They may, as in the papers: tops lean out of their cells (decision A14).
    #[default]
    Free,
    /// No two of them do.
    Apart,
}

/// What a layer's rocks are made of. It affects only how they are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Material {
    /// Each rock has its own material, as in the mix that a river carries.
    #[default]
    Mixed,
    /// Granite: interlocking grains of three minerals.
    Granite,
    /// Basalt: dark, fine-grained, slightly porous.
    Basalt,
    /// Sandstone: in beds, which are tilted differently in each rock.
    Sandstone,
    /// Limestone: pale and smooth.
    Limestone,
    /// Slate: blue-grey, in thin layers.
    Slate,
}

/// What lies between and around the rocks. It affects only the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ground {
    /// Soil: dark crumbs of earth.
    #[default]
    Soil,
    /// Sand: fine, pale grains.
    Sand,
    /// Gravel: pebbles that are too small to be rocks of their own.
    Gravel,
}

/// How a field is lit and weathered. It affects only the picture, not the generated field, and is not part of any hash.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// How far the rocks differ in colour and value, 0 … 1.
    pub variation: f64,
    /// 0 is dry, 1 is wet: darker and glossy.
    pub wetness: f64,
    /// Amount of moss, as a share of the most that could grow, 0 … 1.
    pub moss: f64,
    /// Amount of dust on surfaces that face up, 0 … 1.
    pub dust: f64,
    /// How much snow has fallen, 0 … 1: at 1 it lies about 6 px deep.
    pub snow: f64,
    /// How high water stands above the ground, as a share of the height of the highest rock, 0 … 1; 0 is dry.
    pub water: f64,
    /// The ground between and around the rocks.
    pub ground: Ground,
    /// Degrees, counted like the camera's azimuth: at 0 the sun stands towards −y, at 90 towards +x.
    pub sun_azimuth: f64,
    /// Degrees above the horizon.
    pub sun_elevation: f64,
}

/// All parameters of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// The seed of all random numbers.
    pub seed: u32,
    /// Image width W, px.
    pub image_width: u32,
    /// Image height H, px.
    pub image_height: u32,
    /// Packing coefficient c_d of Eq. 1.
    pub packing: f64,
    /// Units of the layers' lengths.
    pub notation: Notation,
    /// How often Fig. 4 throws darts.
    pub darts: Darts,
    /// What is done with cells at the border.
    pub border: Border,
    /// Whether Eqs 2 and 3 share j1 and j2.
    pub swing: Swing,
    /// Whether rocks may pass through each other.
    pub crossing: Crossing,
    /// How the field is drawn.
    pub look: Look,
    /// The layers in input order, at most [`MAX_LAYERS`] of them.
    pub layers: Vec<Layer>,
}

impl Params {
    /// Number of pixels of the image, W·H.
    pub fn pixels(&self) -> u64 {
        u64::from(self.image_width) * u64::from(self.image_height)
    }

    /// Returns the layer with its lengths converted to px (decision A5).
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
                    detail: layer.detail / unit,
                    ..layer.clone()
                }
            }
        }
    }

    /// Returns all values in table order; see [`Params::from_flat`].
    pub fn to_flat(&self) -> Vec<f64> {
        flat::to_flat(self)
    }

    /// Reads parameters from `[field rows…, number of layers, per layer: id, layer rows…]`, with the rows in the order
    /// of [`PARAMS`].
    ///
    /// A choice is given as the index of its word, and an optional number without a value as NaN.
    ///
    /// # Errors
    /// Returns the first value that is out of range, with its key, value and bounds, or an error if the length is wrong
    /// or a layer id occurs twice.
    pub fn from_flat(flat: &[f64]) -> Result<Params, Error> {
        flat::from_flat(flat)
    }

    /// Checks every value against the table.
    ///
    /// # Errors
    /// Returns the first parameter that is out of range, with its key, value and bounds.
    pub fn validate(&self) -> Result<(), Error> {
        Params::from_flat(&self.to_flat()).map(|_| ())
    }
}

impl Flat for Params {
    type Item = Layer;
    type Stage = Stage;
    const ROWS: &'static [ParamSpec] = PARAMS;
    const HEAD: usize = 1;

    fn empty(layers: f64) -> Result<Self, Error> {
        if !(layers >= 0.0 && layers <= MAX_LAYERS as f64) {
            return Err(Error::TooManyLayers { value: layers as usize, max: MAX_LAYERS });
        }
        Ok(Params { layers: Vec::with_capacity(layers as usize), ..Params::EMPTY })
    }

    fn notation(&self) -> Notation {
        self.notation
    }

    fn items(&self) -> &[Layer] {
        &self.layers
    }

    fn head(layer: &Layer) -> Option<f64> {
        Some(f64::from(layer.id))
    }

    fn append(&mut self, head: &[f64]) -> Result<&mut Layer, Error> {
        let id = check_id(head.first().copied().unwrap_or(f64::NAN), self.layers.len())?;
        if self.layers.iter().any(|other| other.id == id) {
            return Err(Error::DuplicateLayerId { value: id });
        }
        self.layers.push(Layer::with_defaults(id, self.notation));
        let last = self.layers.len() - 1;
        Ok(&mut self.layers[last])
    }
}

fn check_id(value: f64, index: usize) -> Result<u32, Error> {
    if value >= 0.0 && value <= f64::from(u32::MAX) && value == value.trunc() {
        Ok(value as u32)
    } else {
        Err(Error::OutOfRange { key: "id", layer: Some(index), value, min: 0.0, max: f64::from(u32::MAX) })
    }
}
