//! A canvas' surface and the multisampled targets behind it.

use super::{Gpu, RenderError};

/// Depth of the view; near and far are fitted, so 24 bits do.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth24Plus;

/// The surface's first format, preferably one that stores what the shader wrote: we encode sRGB
/// ourselves, once, on both backends.
pub(crate) fn format(surface: &wgpu::Surface<'_>, adapter: &wgpu::Adapter) -> Result<wgpu::TextureFormat, RenderError> {
    let formats = surface.get_capabilities(adapter).formats;
    formats
        .iter()
        .find(|format| matches!(format, wgpu::TextureFormat::Rgba8Unorm | wgpu::TextureFormat::Bgra8Unorm))
        .or(formats.first())
        .copied()
        .ok_or_else(|| RenderError::Surface("it offers no format".into()))
}

/// Surface, size, and targets of that size.
pub(crate) struct Target {
    surface: wgpu::Surface<'static>,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// None with a single sample: the surface's texture is drawn to directly.
    color: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
}

impl Target {
    pub(crate) fn new(gpu: &Gpu, surface: wgpu::Surface<'static>) -> Self {
        let (width, height) = (1, 1);
        let (color, depth) = attachments(gpu, width, height);
        let target = Self { surface, width, height, color, depth };
        target.configure(gpu);
        target
    }

    /// Device pixels, clamped to what a texture can hold.
    pub(crate) fn resize(&mut self, gpu: &Gpu, width: u32, height: u32) {
        let max = gpu.max_side();
        let (width, height) = (width.clamp(1, max), height.clamp(1, max));
        if (width, height) == (self.width, self.height) {
            return;
        }
        (self.width, self.height) = (width, height);
        for view in self.color.iter().chain([&self.depth]) {
            view.texture().destroy();
        }
        (self.color, self.depth) = attachments(gpu, width, height);
        self.configure(gpu);
    }

    fn configure(&self, gpu: &Gpu) {
        self.surface.configure(
            &gpu.device,
            &wgpu::SurfaceConfiguration {
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                format: gpu.format,
                color_space: Default::default(),
                width: self.width,
                height: self.height,
                present_mode: wgpu::PresentMode::Fifo,
                desired_maximum_frame_latency: 2,
                alpha_mode: wgpu::CompositeAlphaMode::Auto,
                view_formats: Vec::new(),
            },
        );
    }

    /// The next texture to draw to; once more after a reconfiguration. None: skip this frame.
    pub(crate) fn acquire(&self, gpu: &Gpu) -> Option<wgpu::SurfaceTexture> {
        use wgpu::CurrentSurfaceTexture as Current;
        for _ in 0..2 {
            match self.surface.get_current_texture() {
                Current::Success(texture) | Current::Suboptimal(texture) => return Some(texture),
                Current::Outdated | Current::Lost => self.configure(gpu),
                Current::Timeout | Current::Occluded | Current::Validation => return None,
            }
        }
        None
    }

    /// The colour and depth attachments for drawing into `frame`, cleared.
    pub(crate) fn attachments<'a>(
        &'a self,
        frame: &'a wgpu::TextureView,
        clear: wgpu::Color,
    ) -> (wgpu::RenderPassColorAttachment<'a>, wgpu::RenderPassDepthStencilAttachment<'a>) {
        let (view, resolve_target, store) = match &self.color {
            Some(color) => (color, Some(frame), wgpu::StoreOp::Discard),
            None => (frame, None, wgpu::StoreOp::Store),
        };
        let color = wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store },
        };
        (color, depth_attachment(&self.depth, wgpu::StoreOp::Discard))
    }
}

/// A depth attachment cleared to the far plane.
pub(crate) fn depth_attachment(
    view: &wgpu::TextureView,
    store: wgpu::StoreOp,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store }),
        stencil_ops: None,
    }
}

fn attachments(gpu: &Gpu, width: u32, height: u32) -> (Option<wgpu::TextureView>, wgpu::TextureView) {
    let make = |label, format| {
        texture(&gpu.device, label, (width, height), gpu.samples, format, wgpu::TextureUsages::RENDER_ATTACHMENT)
    };
    let color = (gpu.samples > 1).then(|| make("rock-field/view/color", gpu.format));
    (color, make("rock-field/view/depth", DEPTH_FORMAT))
}

/// A 2D texture without mip levels, and its only view.
pub(crate) fn texture(
    device: &wgpu::Device,
    label: &'static str,
    (width, height): (u32, u32),
    sample_count: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureView {
    device
        .create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
        .create_view(&Default::default())
}
