//! The exports of the wood-ear artefact.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use super::error::{coded, number};
use crate::params::wood_ear::Params;
use crate::wood_ear::{Generator, LogError, Stats};

impl From<LogError> for JsValue {
    fn from(error: LogError) -> JsValue {
        coded(error.code(), &error.message(&number), "log", None, error.numbers())
    }
}

/// Returns a random seed. JavaScript's own random numbers take less of the wasm file than the system's.
#[wasm_bindgen]
pub fn fresh_seed() -> u32 {
    (js_sys::Math::random() * 4_294_967_296.0) as u32
}

/// The generator with its cache; see [`crate::wood_ear::Generator`].
#[wasm_bindgen(js_name = WoodEarGenerator)]
#[derive(Default)]
pub struct JsWoodEar(Generator);

#[wasm_bindgen(js_class = WoodEarGenerator)]
impl JsWoodEar {
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    pub fn set_log(&mut self, positions: &[f32], indices: &[u32]) -> Result<(), JsValue> {
        Ok(self.0.set_log(positions, indices)?)
    }

    /// Whether the log that was set was inside out and has been turned.
    pub fn log_turned(&self) -> bool {
        self.0.log_turned()
    }

    pub fn clear_log(&mut self) {
        self.0.clear_log();
    }

    pub fn start(&mut self, params: &[f64], max_bytes: f64) -> Result<(), JsValue> {
        Ok(self.0.begin(Params::from_flat(params)?, max_bytes as u64)?)
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

    pub fn preview_ready(&self) -> bool {
        self.0.preview_ready()
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

    pub fn individual_starts(&self) -> Uint32Array {
        self.0.mesh().individual_starts.as_slice().into()
    }

    pub fn vertex_starts(&self) -> Uint32Array {
        self.0.mesh().vertex_starts.as_slice().into()
    }

    pub fn foot(&self) -> Uint32Array {
        self.0.mesh().foot.as_slice().into()
    }

    pub fn size(&self) -> Float32Array {
        self.0.mesh().size.as_slice().into()
    }

    pub fn base(&self) -> Uint8Array {
        self.0.mesh().base.as_slice().into()
    }

    pub fn log_positions(&self) -> Float32Array {
        self.0.log_mesh().positions.as_slice().into()
    }

    pub fn log_normals(&self) -> Float32Array {
        self.0.log_mesh().normals.as_slice().into()
    }

    pub fn log_indices(&self) -> Uint32Array {
        self.0.log_mesh().indices.as_slice().into()
    }

    pub fn log_kinds(&self) -> Uint8Array {
        self.0.log_mesh().kinds.as_slice().into()
    }

    pub fn log_coords(&self) -> Float32Array {
        self.0.log_mesh().coords.as_slice().into()
    }

    /// A number that grows whenever the log's buffers change, so that they are copied out only then.
    pub fn log_version(&self) -> u32 {
        self.0.log_version()
    }

    pub fn bases(&self) -> Float64Array {
        self.0.bases().as_slice().into()
    }

    /// The numbers of individuals, triangles, crossing pairs, sweeps and rounds; then the median and the tenth
    /// percentile of the share of the rim radius that was kept.
    pub fn summary(&self) -> Float64Array {
        let Stats { individuals, triangles, crossing_pairs, sweeps, rounds, kept_median, kept_p10 } = self.0.stats();
        let [a, b, c, d, e] = [individuals, triangles, crossing_pairs, sweeps, rounds].map(f64::from);
        [a, b, c, d, e, kept_median, kept_p10].as_slice().into()
    }
}
