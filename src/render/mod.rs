//! Draws a field with wgpu, on WebGPU or WebGL2. Nothing here depends on how the field was generated. What can be
//! computed without a graphics device is in [`crate::shading`].
//!
//! ```text
//! Gpu    device, queue, layouts, pipelines, maps              one for all canvases
//! Scene  one field's buffers
//! Props  a log and wood ears among the rocks of a view
//! Plan   the diagrams or the selection seen from above, as strokes and fills; built when first shown
//! Bake   where a scene's vertices are in an atlas, and the tile of it that is being drawn; made for exports
//! Picture    what a view shows, drawn piece by piece on the device's easel, and shown when it is whole
//! Still  the mean of samples of a view, each in the light of one point of the sun, the sky and the ground
//! View   camera, style, and with WebGPU its own surface and targets              one per canvas
//! ```
//!
//! To draw a frame, the shadow and height maps are drawn first if the field is new. Then one multisampled pass draws
//! the backdrop and the ground (its depth too, if rocks or props extend below it), then the rocks that are in the
//! picture (outsides, insides; in the wireframe view also the edges) and the props, or the fills and strokes of a plan.
//! Nothing is drawn unless a frame is asked for. In natural colours the ground's depth comes first, so that nothing is
//! shaded that it hides, then the rocks, each with as many triangles as can be told apart ([`crate::shading`]'s levels),
//! and last the ground's colour. Copies of the field lie round it: the same triangles, each time with the uniforms of another place
//! ([`Scene`]'s `around`).
//!
//! With WebGPU, a device serves any number of canvases. WebGL2 binds a device to one canvas and allows about 16 of them
//! per page. There, all views are drawn on one canvas that is not visible, and JavaScript copies each picture to its
//! place.
//!
//! Where a frame takes the device too long, it is drawn as a [`Picture`] in pieces ([`crate::shading::Pieces`] says which), out of sight, while
//! the page goes on; it may be smaller than the canvas, and have one sample a pixel.
//!
//! Both backends run the same shaders, which encode sRGB themselves, so both give the same picture.

mod around;
mod bake;
mod buffers;
mod camera;
mod easel;
mod error;
mod fill;
mod gpu;
mod indices;
mod maps;
mod pass;
mod patterns;
mod picture;
mod pipelines;
mod plan;
mod present;
mod props;
mod scene;
mod still;
mod surface;
mod upload;
mod view;

pub(crate) use bake::Bake;
pub(crate) use buffers::Mesh;
pub(crate) use camera::Camera;
pub(crate) use error::RenderError;
pub(crate) use gpu::Gpu;
pub(crate) use picture::Picture;
pub(crate) use plan::{Layer, Plan};
pub(crate) use props::{Place, Prop, Props};
pub(crate) use scene::{Rocks, Scene};
pub(crate) use still::{Lens, Still};
pub(crate) use view::{Tile, View};
