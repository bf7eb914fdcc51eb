//! The exports of the renderer artefacts that make textures.

use wasm_bindgen::prelude::*;

use super::renderer::{Renderer, to_js};
use crate::render::{Bake, RenderError};

#[wasm_bindgen]
impl Renderer {
    /// Sets the atlas of the field: five numbers per vertex, its place in texels from the upper left corner and its
    /// tangent. The renderer needs no canvas for that, and its style does not matter.
    #[wasm_bindgen(js_name = setAtlas)]
    pub fn set_atlas(&mut self, atlas: &js_sys::Float32Array) -> Result<(), js_sys::Error> {
        let bake = Bake::new(&self.gpu, atlas);
        self.bake = Some(bake.map_err(|error| to_js(&error))?);
        Ok(())
    }

    /// Draws the tile of 1024 × 1024 texels whose upper left corner is (x, y). Then call [`Renderer::take_tile`] until it
    /// returns something.
    #[wasm_bindgen(js_name = bakeTile)]
    pub fn bake_tile(&mut self, x: f32, y: f32) -> Result<(), js_sys::Error> {
        match (&mut self.scene, &self.bake) {
            (Some(scene), Some(bake)) if bake.fits(scene.vertices()) => {
                self.view.bake(&self.gpu, scene, bake, [x, y]);
                Ok(())
            }
            _ => Err(to_js(&RenderError::Malformed("an atlas of another field"))),
        }
    }

    /// The eight bytes of each texel of the tile, row by row (see `bake.wgsl`); `undefined` until they are there.
    #[wasm_bindgen(js_name = takeTile)]
    pub fn take_tile(&self) -> Result<Option<js_sys::Uint8Array>, js_sys::Error> {
        match &self.bake {
            Some(bake) => bake.take(&self.gpu).map_err(|error| to_js(&error)),
            None => Ok(None),
        }
    }
}
