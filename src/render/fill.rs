//! A mesh on its way to the device.

use super::buffers::Mesh;
use super::indices::Arranging;
use crate::shading::{Body, Turned};

/// What is still to be put into the buffers of a field, from JavaScript's memory.
pub(crate) struct Fill {
    pub(crate) positions: js_sys::Float32Array,
    pub(crate) normals: js_sys::Float32Array,
    pub(crate) indices: js_sys::Uint32Array,
    pub(crate) bodies: Vec<Body>,
    /// How many vertices are uploaded, and how many rocks have all of theirs.
    pub(crate) vertices: u32,
    pub(crate) rocks: usize,
    pub(crate) turned: Turned,
    /// Once all vertices are known.
    pub(crate) arranging: Option<Arranging>,
}

impl Fill {
    pub(crate) fn new(mesh: &Mesh<'_>, bodies: Vec<Body>) -> Self {
        Self {
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            indices: mesh.indices.clone(),
            bodies,
            vertices: 0,
            rocks: 0,
            turned: Turned::default(),
            arranging: None,
        }
    }
}
