//! What the shaders are and what they read: the look, colours, uniform blocks, and the paint of rocks, logs and wood
//! ears.
//!
//! Nothing here needs a graphics device, so that tests run it natively; [`crate::render`] puts it on one.

mod around;
mod beam;
pub(crate) mod hills;
mod levels;
mod look;
mod order;
pub(crate) mod palette;
pub(crate) mod patterns;
mod pieces;
mod recipe;
mod sample;
pub(crate) mod shaders;
mod sink;
mod sky;
mod turned;
mod uniforms;
pub(crate) mod wood;

pub(crate) use around::Bricks;
pub(crate) use beam::{Bounds, beam, in_sight};
pub(crate) use levels::{Arrangement, Body, LEVELS, Sight, coarser, least_of};
pub(crate) use look::Look;
pub(crate) use order::{ColorMode, Mode, Quality};
pub(crate) use pieces::{Piece, Pieces};
pub(crate) use recipe::{Recipe, Sort};
pub(crate) use sample::Sample;
pub(crate) use sink::Stands;
pub(crate) use sky::{COLUMNS as SKY_COLUMNS, ROWS as SKY_ROWS, Sky};
pub(crate) use turned::Turned;
pub(crate) use uniforms::{FieldUniforms, Globals};
