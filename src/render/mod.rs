//! Draws a field through wgpu, on WebGPU or WebGL2, and knows nothing of how it was generated.
//!
//! ```text
//! Gpu    device, queue, layouts, pipelines        one per device; may serve many canvases
//! Scene  one field's buffers, its shadow map and height map
//! Plan   the diagrams or the selection seen from above, as strokes and fills; built when first shown
//! View   surface, multisampled targets, camera, style                         one per canvas
//! ```
//!
//! One frame: if the field is new, its shadow and height maps; then one multisampled pass:
//! backdrop and ground, then all rocks at once (outsides, insides; edges in the wireframe view),
//! or the fills and strokes of a plan. Nothing is drawn unless asked for.
//!
//! Both backends run the same shaders and encode sRGB in them, so they give the same picture.

mod camera;
mod error;
mod gpu;
mod palette;
mod pipelines;
mod plan;
mod scene;
mod surface;
mod uniforms;
mod upload;
mod view;

pub(crate) use camera::Camera;
pub(crate) use error::RenderError;
pub(crate) use gpu::Gpu;
pub(crate) use palette::ColorMode;
pub(crate) use plan::{Layer, Plan};
pub(crate) use scene::{Maps, Mesh, Rocks, Scene};
pub(crate) use view::{Mode, View};
