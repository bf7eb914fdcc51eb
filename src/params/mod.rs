//! The parameters: one table for each generator, the structs that it describes, and the presets. Those of rocks are here;
//! those of wood ears are in [`wood_ear`].
//!
//! Everything that lists parameters (sliders, links, TypeScript types, JSON Schema, README) is generated from the
//! tables; `tests/params.rs` generates it again and fails on a difference.

mod flat;
mod rocks;
mod spec;
pub mod wood_ear;

pub use rocks::{
    Border, Crossing, Darts, Ground, Layer, Look, MAX_LAYERS, Material, PARAMS, PRESETS, ParamSpec, Params, Preset,
    Scope, Stage, Swing, TEXTS, preset,
};
pub use spec::{Kind, Notation, Range, Slider, Text};
