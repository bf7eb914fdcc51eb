//! The exports of the artefact that makes the ground around rocks.

use js_sys::{Float32Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::ground::{Ground, Sheet};

/// The ground around rocks; see [`crate::ground::Ground`].
#[wasm_bindgen(js_name = GroundMesh)]
pub struct JsGroundMesh {
    ground: Ground,
    sheet: Sheet,
}

#[wasm_bindgen(js_class = GroundMesh)]
impl JsGroundMesh {
    #[wasm_bindgen(constructor)]
    pub fn new(width: u32, height: u32) -> Self {
        JsGroundMesh { ground: Ground::new(width, height), sheet: Sheet::default() }
    }

    pub fn add(&mut self, positions: &[f32], indices: &[u32], vertex_starts: &[u32], rock_starts: &[u32]) {
        self.ground.add(positions, indices, vertex_starts, rock_starts);
    }

    /// Triangulates what was added.
    pub fn make(&mut self, cut: bool) {
        self.sheet = self.ground.sheet(cut);
    }

    /// Two numbers for each vertex.
    pub fn positions(&self) -> Float32Array {
        self.sheet.positions.as_slice().into()
    }

    pub fn indices(&self) -> Uint32Array {
        self.sheet.indices.as_slice().into()
    }
}
