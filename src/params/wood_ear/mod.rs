//! The parameters of wood-ear colonies: the table ([`PARAMS`]), the structs it describes, and the presets.
//!
//! Lengths are in cm, which is also one pixel of a rock field. The six sliders of the thesis keep its ranges (Tables 3.1, 4.2).

mod presets;
mod table;

pub use presets::{PRESETS, Preset, preset};
pub use table::{PARAMS, Stage, TEXTS};

use super::Notation;
use super::flat::{self, Flat};
use super::spec;
use crate::error::Error;

/// One row of the wood ears' table.
pub type ParamSpec = spec::ParamSpec<Params, Base, Stage>;
/// Whether a parameter belongs to the colony or to each of its bases.
pub type Scope = spec::Scope<Params, Base>;

/// Most base points a colony can have.
pub const MAX_BASES: usize = 16;

/// What becomes of individuals that pass through each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Collisions {
    /// They do.
    Off,
    /// The thesis's rule: whole meridians step inward until a pair is free (\[3.4\], decisions K8 to K11).
    #[default]
    Thesis,
    /// Ours: neighbours press flat against a plane between them; none pass through each other.
    Pressed,
}

/// A point that a colony spreads from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Base {
    /// Where it is wanted, cm; it is moved to the nearest vertex of the log.
    pub position: [f64; 3],
    /// Range of this base alone, cm.
    pub range: Option<f64>,
}

/// The log that is grown where none is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Log {
    /// cm, along x.
    pub length: f64,
    /// Mean radius, cm.
    pub radius: f64,
    /// 0 straight … 1 a gentle bow.
    pub bend: f64,
    /// 0 smooth … 1 deeply furrowed.
    pub bark: f64,
    /// Mean distance of neighbouring vertices, cm: individuals stand on vertices.
    pub spacing: f64,
    /// The log's own seed, so that another colony grows on the same log.
    pub seed: u32,
}

/// How a colony is lit and coloured: drawn, never generated, and in no hash.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// How far individuals differ in colour, 0 … 1.
    pub variation: f64,
    /// How much light comes through, 0 … 1.
    pub translucency: f64,
    /// Down on the outer side, 0 … 1.
    pub velvet: f64,
    /// Degrees, counted as the camera's azimuth.
    pub sun_azimuth: f64,
    /// Degrees above the horizon.
    pub sun_elevation: f64,
}

/// Everything a colony is a function of, besides a log of the user's own.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// The integer that starts the generator.
    pub seed: u32,
    /// Share of the log's vertices within range that carry an individual, %.
    pub density: f64,
    /// Reach of a base, cm.
    pub range: f64,
    /// Moisture content m, %.
    pub moisture: f64,
    /// Wrinkle density s, %.
    pub wrinkles: f64,
    /// Median rim radius, cm.
    pub size: f64,
    /// v: sizes lie between size / v and size · v (decision K7).
    pub size_spread: f64,
    /// d, rings of an individual.
    pub rings: u32,
    /// c, vertices of a ring.
    pub meridians: u32,
    /// How far the wrinkling of individuals differs (decision K3).
    pub per_individual: f64,
    /// Rule for individuals that pass through each other.
    pub collisions: Collisions,
    /// Bending under gravity, 0 … 1.
    pub droop: f64,
    /// Of the wet flesh at the foot, cm; 0 is a sheet.
    pub thickness: f64,
    /// 0 an open hole … 1 a thick stalk.
    pub foot: f64,
    /// Keep individuals out of the log.
    pub clear_log: bool,
    /// The log that is grown where none is given.
    pub log: Log,
    /// How the colony is drawn.
    pub look: Look,
    /// 1 … [`MAX_BASES`] points.
    pub bases: Vec<Base>,
}

impl Params {
    /// All values in table order; see [`Params::from_flat`].
    pub fn to_flat(&self) -> Vec<f64> {
        flat::to_flat(self)
    }

    /// Reads `[colony rows…, number of bases, per base: base rows…]`, rows in the order of [`PARAMS`].
    ///
    /// A choice is the index of its word; an optional number is NaN for "none".
    ///
    /// # Errors
    /// The first value out of range, with its key, value and bounds (for a base, `layer` is its index); a wrong length.
    pub fn from_flat(flat: &[f64]) -> Result<Params, Error> {
        flat::from_flat(flat)
    }

    /// Checks every value against the table.
    ///
    /// # Errors
    /// The first parameter that is out of range, with its key, value and bounds.
    pub fn validate(&self) -> Result<(), Error> {
        Params::from_flat(&self.to_flat()).map(|_| ())
    }
}

impl Flat for Params {
    type Item = Base;
    type Stage = Stage;
    const ROWS: &'static [ParamSpec] = PARAMS;
    const HEAD: usize = 0;

    fn empty(bases: f64) -> Result<Self, Error> {
        if !(bases >= 1.0 && bases <= MAX_BASES as f64) {
            return Err(Error::OutOfRange { key: "bases", layer: None, value: bases, min: 1.0, max: MAX_BASES as f64 });
        }
        Ok(Params { bases: Vec::with_capacity(bases as usize), ..Params::EMPTY })
    }

    fn notation(&self) -> Notation {
        Notation::Px
    }

    fn items(&self) -> &[Base] {
        &self.bases
    }

    fn head(_: &Base) -> Option<f64> {
        None
    }

    fn append(&mut self, _: &[f64]) -> Result<&mut Base, Error> {
        self.bases.push(Base::with_defaults());
        let last = self.bases.len() - 1;
        Ok(&mut self.bases[last])
    }
}
