//! Draws a field through wgpu, on WebGPU or WebGL2, and knows nothing of how it was generated.
//!
//! ```text
//! Gpu    device, queue, layouts, pipelines, maps              one for all canvases
//! Scene  one field's buffers
//! Props  a log and wood ears among the rocks of a view
//! Plan   the diagrams or the selection seen from above, as strokes and fills; built when first shown
//! View   camera, style, and with WebGPU its own surface and targets              one per canvas
//! ```
//!
//! One frame: if the field is new, its shadow and height maps; then one multisampled pass:
//! backdrop and ground (its depth too where rocks or props go on below it), then all rocks at once (outsides, insides;
//! edges in the wireframe view), and the props, or the fills and strokes of a plan. Nothing is drawn unless asked for.
//! In natural colours the rocks come first and the ground last, as a surface that hides what is below it.
//!
//! With WebGPU a device serves any number of canvases. WebGL2 binds a device to one canvas and allows
//! about 16 of them in a page, so there all views are drawn on one that nobody sees, and JavaScript
//! copies each picture to where it belongs.
//!
//! Both backends run the same shaders and encode sRGB in them, so they give the same picture.

mod camera;
mod error;
mod gpu;
mod look;
mod maps;
mod palette;
mod pass;
mod pipelines;
mod plan;
mod props;
mod scene;
mod settle;
mod surface;
mod uniforms;
mod upload;
mod view;
mod wood;

pub(crate) use camera::Camera;
pub(crate) use error::RenderError;
pub(crate) use gpu::Gpu;
pub(crate) use look::{Look, Quality};
pub(crate) use palette::ColorMode;
pub(crate) use plan::{Layer, Plan};
pub(crate) use props::{Place, Prop, PropMesh, Props};
pub(crate) use scene::{Mesh, Rocks, Scene};
pub(crate) use view::{Mode, View};
pub(crate) use wood::Ears;
