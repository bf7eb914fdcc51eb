//! The parameters of wood-ear colonies: the table ([`PARAMS`]), the structs that it describes, and the presets. Numbers
//! such as K3 refer to docs/decisions.md.
//!
//! Lengths are in cm; one cm is one pixel of a rock field. The thesis's six sliders keep its ranges (Tables 3.1, 4.2).

mod presets;
mod table;

pub use presets::{PRESETS, Preset, preset};
pub use table::{PARAMS, Stage, TEXTS};

use super::flat::{self, Flat};
use super::spec::{self, Notation};
use crate::error::Error;

/// One row of the wood ears' table.
pub type ParamSpec = spec::ParamSpec<Params, Base, Stage>;
/// Whether a parameter belongs to the colony or to each of its bases.
pub type Scope = spec::Scope<Params, Base>;

/// Most base points a colony can have.
pub const MAX_BASES: usize = 16;

/// What is done with individuals that pass through each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Collisions {
    /// Nothing: they may pass through each other.
    Off,
    /// The thesis's rule: whole meridians step inward until the pair is free (\[3.4\], decisions K8 to K11).
    #[default]
    Thesis,
    /// A rule of our own: neighbours press flat against a plane between them, and no two pass through each other.
    Pressed,
}

/// A point from which a colony spreads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Base {
    /// Where the base is wanted, cm. It is moved to the nearest vertex of the log.
    pub position: [f64; 3],
    /// Range of this base, cm. `None` means the colony's range.
    pub range: Option<f64>,
}

/// The log that is grown if the user gives none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Log {
    /// Length along x, cm.
    pub length: f64,
    /// Mean radius, cm.
    pub radius: f64,
    /// 0 is straight, 1 a gentle bow.
    pub bend: f64,
    /// 0 is smooth, 1 deeply furrowed.
    pub bark: f64,
    /// Mean distance of neighbouring vertices, cm. Individuals stand on vertices, so it limits their density.
    pub spacing: f64,
    /// Seed of the log, which is separate so that another colony can grow on the same log.
    pub seed: u32,
}

/// How a colony is lit and coloured. It affects only the picture, not the generated colony, and is not part of any
/// hash.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// How far individuals differ in colour, 0 … 1.
    pub variation: f64,
    /// How much light shines through the flesh, 0 … 1.
    pub translucency: f64,
    /// Amount of fine hair on the outer side, 0 … 1.
    pub velvet: f64,
    /// Degrees, counted like the camera's azimuth.
    pub sun_azimuth: f64,
    /// Degrees above the horizon.
    pub sun_elevation: f64,
}

/// All parameters of a colony. Only a log given by the user is not among them.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// The seed of all random numbers.
    pub seed: u32,
    /// Probability that a vertex of the log within range carries an individual, %.
    pub density: f64,
    /// Range of a base, cm.
    pub range: f64,
    /// Moisture content m, %.
    pub moisture: f64,
    /// Wrinkle density s, %.
    pub wrinkles: f64,
    /// Median rim radius, cm.
    pub size: f64,
    /// Spread v: sizes lie between size / v and size · v (decision K7).
    pub size_spread: f64,
    /// Number of rings of an individual, d.
    pub rings: u32,
    /// Number of vertices of a ring, c.
    pub meridians: u32,
    /// How much individuals differ in how strongly they wrinkle, 0 … 1 (decision K3).
    pub per_individual: f64,
    /// What is done with individuals that pass through each other.
    pub collisions: Collisions,
    /// Bending under gravity, 0 … 1.
    pub droop: f64,
    /// Thickness of the wet flesh at the foot, cm. With 0, an individual is a single sheet.
    pub thickness: f64,
    /// 0 is an open hole, 1 a thick stalk.
    pub foot: f64,
    /// Whether individuals are kept out of the log.
    pub clear_log: bool,
    /// The log that is grown if the user gives none.
    pub log: Log,
    /// How the colony is drawn.
    pub look: Look,
    /// The points that the colony spreads from, 1 … [`MAX_BASES`] of them.
    pub bases: Vec<Base>,
}

impl Params {
    /// Returns all values in table order; see [`Params::from_flat`].
    pub fn to_flat(&self) -> Vec<f64> {
        flat::to_flat(self)
    }

    /// Reads parameters from `[colony rows…, number of bases, per base: base rows…]`, with the rows in the order of
    /// [`PARAMS`].
    ///
    /// A choice is given as the index of its word, and an optional number without a value as NaN.
    ///
    /// # Errors
    /// Returns the first value that is out of range, with its key, value and bounds (for a base, `layer` is its index),
    /// or an error if the length is wrong.
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
        // All of its values follow.
        self.bases.push(Base { position: [0.0; 3], range: None });
        let last = self.bases.len() - 1;
        Ok(&mut self.bases[last])
    }
}
