//! The exports of the generator artefact.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::params::Params;
use crate::rocks::{Generator, LayerView};

/// Returns a seed from the system's source of randomness.
#[wasm_bindgen]
pub fn fresh_seed() -> Result<u32, JsError> {
    Ok(getrandom::u32()?)
}

/// Returns the number of bytes that a run would need at its peak.
#[wasm_bindgen]
pub fn memory_estimate(params: &[f64]) -> Result<f64, JsValue> {
    Ok(crate::memory_estimate(&Params::from_flat(params)?).bytes as f64)
}

/// The generator with its cache; see [`crate::rocks::Generator`].
#[wasm_bindgen(js_name = Generator)]
#[derive(Default)]
pub struct JsGenerator(Generator);

#[wasm_bindgen(js_class = Generator)]
impl JsGenerator {
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    pub fn set_footprint(&mut self, triangles: &[f64]) -> Result<(), JsValue> {
        Ok(self.0.set_footprint(triangles)?)
    }

    #[cfg(feature = "full")]
    pub fn set_paint(&mut self, mask: Vec<u8>, width: usize, strokes: Vec<f64>) -> Result<(), JsValue> {
        Ok(self.0.set_paint(mask, width, strokes)?)
    }

    pub fn start(&mut self, params: &[f64], max_bytes: f64) -> Result<(), JsValue> {
        Ok(self.0.start(Params::from_flat(params)?, max_bytes as u64)?)
    }

    pub fn step(&mut self) -> Result<bool, JsValue> {
        Ok(self.0.step()?)
    }

    pub fn stage(&self) -> u32 {
        self.0.stage() as u32
    }

    pub fn progress(&self) -> f64 {
        self.0.progress()
    }

    pub fn positions(&self) -> Float32Array {
        self.0.mesh().positions.as_slice().into()
    }

    pub fn normals(&self) -> Float32Array {
        self.0.mesh().normals.as_slice().into()
    }

    pub fn indices(&self) -> Uint32Array {
        self.0.mesh().indices.as_slice().into()
    }

    pub fn rock_starts(&self) -> Uint32Array {
        self.0.mesh().rock_starts.as_slice().into()
    }

    pub fn vertex_starts(&self) -> Uint32Array {
        self.0.mesh().vertex_starts.as_slice().into()
    }

    pub fn rock_layer(&self) -> Uint8Array {
        self.0.mesh().rock_layer.as_slice().into()
    }

    pub fn layer_sites(&self, k: usize) -> Result<Float32Array, JsError> {
        Ok(self.layer(k)?.sites.positions().as_slice().into())
    }

    pub fn layer_cell_starts(&self, k: usize) -> Result<Uint32Array, JsError> {
        Ok(self.layer(k)?.cells.starts.as_slice().into())
    }

    pub fn layer_cell_vertices(&self, k: usize) -> Result<Float32Array, JsError> {
        Ok(self.layer(k)?.cells.flat_vertices().as_slice().into())
    }

    pub fn layer_selected(&self, k: usize) -> Result<Uint32Array, JsError> {
        Ok(self.layer(k)?.selection.selected.as_slice().into())
    }

    pub fn layer_summary(&self, k: usize) -> Result<Float64Array, JsError> {
        Ok(self.layer(k)?.summary().as_slice().into())
    }

    pub fn summary(&self) -> Float64Array {
        self.0.summary().as_slice().into()
    }

    fn layer(&self, k: usize) -> Result<LayerView<'_>, JsError> {
        self.0.layers().nth(k).ok_or_else(|| JsError::new(&format!("there is no layer {k}")))
    }
}
