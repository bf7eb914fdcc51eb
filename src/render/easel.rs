//! What the pieces of pictures are drawn on, before they are copied to their places.

use super::surface::{DEPTH_FORMAT, depth_attachment, texture};

/// What pieces are drawn on, one at a time, whatever picture they are of.
pub(crate) struct Easel {
    size: [u32; 2],
    samples: u32,
    /// `None` with a single sample.
    color: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
    frame: wgpu::TextureView,
}

impl Drop for Easel {
    /// Memory of the device is not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        for view in self.color.iter().chain([&self.depth, &self.frame]) {
            view.texture().destroy();
        }
    }
}

impl Easel {
    /// One for pieces of this size, with so many samples a pixel.
    pub(crate) fn new(device: &wgpu::Device, format: wgpu::TextureFormat, samples: u32, size: [u32; 2]) -> Self {
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let make = |label, samples, format, usage| texture(device, label, (size[0], size[1]), samples, format, usage);
        Self {
            size,
            samples,
            color: (samples > 1).then(|| make("rock-field/easel/color", samples, format, drawn)),
            depth: make("rock-field/easel/depth", samples, DEPTH_FORMAT, drawn),
            frame: make("rock-field/easel/frame", 1, format, drawn | wgpu::TextureUsages::COPY_SRC),
        }
    }

    /// Whether a piece of this size fits, and does not get lost: clearing the easel costs as much as its size.
    pub(crate) fn suits(&self, samples: u32, [width, height]: [u32; 2]) -> bool {
        self.samples == samples
            && self.size[0] >= width
            && self.size[1] >= height
            && self.size[0] * self.size[1] <= 4 * (width * height).max(4096)
    }

    /// The colour and depth attachments for drawing a piece, cleared.
    pub(crate) fn attachments(
        &self,
        clear: wgpu::Color,
    ) -> (wgpu::RenderPassColorAttachment<'_>, wgpu::RenderPassDepthStencilAttachment<'_>) {
        let (view, resolve_target, store) = match &self.color {
            Some(color) => (color, Some(&self.frame), wgpu::StoreOp::Discard),
            None => (&self.frame, None, wgpu::StoreOp::Store),
        };
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store };
        let color = wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target, ops };
        (color, depth_attachment(&self.depth, wgpu::StoreOp::Discard))
    }

    /// What was drawn, in the upper left corner.
    pub(crate) fn frame(&self) -> &wgpu::TextureView {
        &self.frame
    }
}
