//! The exports that only the bench's artefact has in addition to the generator's: the papers' literal loops.

use js_sys::{Float32Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::params::Params;
use crate::rocks::literal::{self, LiteralField};

/// A field that was made by the literal loops.
#[wasm_bindgen]
pub struct Literal(LiteralField);

#[wasm_bindgen]
impl Literal {
    /// Runs all stages. Takes the same parameters as `Generator.start`.
    #[wasm_bindgen(constructor)]
    pub fn new(params: &[f64]) -> Result<Self, JsValue> {
        Ok(Self(literal::generate(&Params::from_flat(params)?)))
    }

    pub fn positions(&self) -> Float32Array {
        self.0.positions.as_slice().into()
    }

    pub fn indices(&self) -> Uint32Array {
        self.0.indices.as_slice().into()
    }

    pub fn rock_starts(&self) -> Uint32Array {
        self.0.rock_starts.as_slice().into()
    }
}
