//! The exports of the renderer artefacts for a log and its wood ears. Each converts its arguments, makes a call, and
//! converts the result.

use wasm_bindgen::prelude::*;

use super::renderer::{Renderer, to_js};
use crate::render::{Mesh, Place, Prop};
use crate::shading::Mode;
use crate::shading::wood::Ears;

#[wasm_bindgen]
impl Renderer {
    /// Uploads a log: a mesh in cm that lies along x, and per vertex its kind (0 bark, 1 end grain, 2 splinter).
    /// `place` holds where its origin is in px of the image (x, y, z), and the px per cm. The log is shown with the
    /// next colony.
    #[wasm_bindgen(js_name = setLog)]
    pub fn set_log(
        &mut self,
        positions: &js_sys::Float32Array,
        normals: &js_sys::Float32Array,
        indices: &js_sys::Uint32Array,
        kinds: Vec<u8>,
        place: Vec<f32>,
    ) -> Result<(), js_sys::Error> {
        self.next_log = None;
        let mesh = Mesh { positions, normals, indices };
        let log = Prop::log(&self.gpu, Place::new(&place), &mesh, &kinds).map_err(|error| to_js(&error))?;
        self.next_log = Some(log);
        Ok(())
    }

    /// Puts wood ears into the field, together with the log set since the last ones. They are shown once there is a
    /// field, which may be empty. The mesh, in cm, consists of individuals that all have the same `rings` and
    /// `meridians`. `keys` holds a number per individual that does not change, such as the vertex of the log it stands
    /// on. `place` is as for the log. If there is an error, nothing changes.
    #[wasm_bindgen(js_name = setColony)]
    #[allow(clippy::too_many_arguments, reason = "one flat buffer each")]
    pub fn set_colony(
        &mut self,
        positions: &js_sys::Float32Array,
        normals: &js_sys::Float32Array,
        indices: &js_sys::Uint32Array,
        keys: Vec<u32>,
        rings: u32,
        meridians: u32,
        place: Vec<f32>,
    ) -> Result<(), js_sys::Error> {
        let log = self.next_log.take();
        let mesh = Mesh { positions, normals, indices };
        let ears = Ears { rings, meridians, keys };
        let colony = Prop::colony(&self.gpu, Place::new(&place), &mesh, &ears).map_err(|error| to_js(&error))?;
        self.props.set(log, colony);
        Ok(())
    }

    /// True if the wireframe is shown and waits for [`Renderer::set_wood_edges`].
    #[wasm_bindgen(js_name = needsWoodEdges)]
    pub fn needs_wood_edges(&self) -> bool {
        self.view.mode == Mode::Wireframe && !self.props.has_edges()
    }

    /// Makes the wireframe's lines. Pass the same indices of the log and of its colony as before.
    #[wasm_bindgen(js_name = setWoodEdges)]
    pub fn set_wood_edges(
        &mut self,
        log: &js_sys::Uint32Array,
        colony: &js_sys::Uint32Array,
    ) -> Result<(), js_sys::Error> {
        self.props.set_edges(&self.gpu, log, colony).map_err(|error| to_js(&error))
    }

    /// Removes the log and its wood ears.
    #[wasm_bindgen(js_name = clearWood)]
    pub fn clear_wood(&mut self) {
        self.next_log = None;
        self.props.clear();
    }
}
