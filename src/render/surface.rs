//! A canvas's surface, and the multisampled targets behind it.

use std::cell::OnceCell;

use super::RenderError;

/// Depth format of the view. Near and far are fitted to the scene, so 24 bits are enough.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth24Plus;

/// Format and sample count of every surface of a device.
#[derive(Clone, Copy)]
pub(crate) struct Kind {
    pub(crate) format: wgpu::TextureFormat,
    /// 4, or 1 if the format cannot be multisampled.
    pub(crate) samples: u32,
}

impl Kind {
    /// Chooses the surface's first format that stores what the shader wrote, since the shaders encode sRGB themselves
    /// on both backends; if there is none, its first format.
    pub(crate) fn of(surface: &wgpu::Surface<'_>, adapter: &wgpu::Adapter) -> Result<Self, RenderError> {
        let formats = surface.get_capabilities(adapter).formats;
        let format = formats
            .iter()
            .find(|format| matches!(format, wgpu::TextureFormat::Rgba8Unorm | wgpu::TextureFormat::Bgra8Unorm))
            .or(formats.first())
            .copied()
            .ok_or_else(|| RenderError::Surface("it offers no format".into()))?;
        let flags = adapter.get_texture_format_features(format).flags;
        Ok(Self { format, samples: if flags.sample_count_supported(4) { 4 } else { 1 } })
    }
}

/// A surface with its targets: of one canvas with WebGPU, of all canvases together with WebGL2.
pub(crate) struct Screen {
    surface: wgpu::Surface<'static>,
    width: u32,
    height: u32,
    /// Colour and depth, made when the first frame is drawn: pictures in pieces are drawn elsewhere. The colour is `None` with a single sample: the
    /// surface's texture is then drawn to directly.
    targets: OnceCell<(Option<wgpu::TextureView>, wgpu::TextureView)>,
}

impl Drop for Screen {
    /// Textures are not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        self.destroy_attachments();
    }
}

impl Screen {
    pub(crate) fn new(device: &wgpu::Device, kind: Kind, surface: wgpu::Surface<'static>) -> Self {
        let (width, height) = (1, 1);
        let screen = Self { surface, width, height, targets: OnceCell::new() };
        screen.configure(device, kind);
        screen
    }

    /// Changes the size to exactly this many device pixels, which must not be more than a texture can have.
    pub(crate) fn resize(&mut self, device: &wgpu::Device, kind: Kind, width: u32, height: u32) {
        if (width, height) == (self.width, self.height) {
            return;
        }
        (self.width, self.height) = (width, height);
        self.destroy_attachments();
        self.targets.take();
        self.configure(device, kind);
    }

    /// Makes it at least this large, and never smaller, because the views that share it would pay for every change.
    pub(crate) fn grow(&mut self, device: &wgpu::Device, kind: Kind, width: u32, height: u32) {
        self.resize(device, kind, self.width.max(width), self.height.max(height));
    }

    /// Makes it so large, unless it is already and not much larger: what is copied from it is copied with all that is around it.
    pub(crate) fn fit(&mut self, device: &wgpu::Device, kind: Kind, width: u32, height: u32) {
        let is_enough = self.width >= width && self.height >= height;
        if !is_enough || self.width * self.height > 2 * width * height {
            self.resize(device, kind, width, height);
        }
    }

    fn destroy_attachments(&self) {
        if let Some((color, depth)) = self.targets.get() {
            color.iter().chain([depth]).for_each(|view| view.texture().destroy());
        }
    }

    fn configure(&self, device: &wgpu::Device, kind: Kind) {
        self.surface.configure(
            device,
            &wgpu::SurfaceConfiguration {
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                format: kind.format,
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

    /// Returns the next texture to draw to, if necessary after configuring the surface again. `None` means that this
    /// frame is to be skipped.
    pub(crate) fn acquire(&self, device: &wgpu::Device, kind: Kind) -> Option<wgpu::SurfaceTexture> {
        use wgpu::CurrentSurfaceTexture as Current;
        for _ in 0..2 {
            match self.surface.get_current_texture() {
                Current::Success(texture) | Current::Suboptimal(texture) => return Some(texture),
                Current::Outdated | Current::Lost => self.configure(device, kind),
                Current::Timeout | Current::Occluded | Current::Validation => return None,
            }
        }
        None
    }

    /// The colour and depth attachments for drawing into `frame`, cleared.
    pub(crate) fn attachments<'a>(
        &'a self,
        device: &wgpu::Device,
        kind: Kind,
        frame: &'a wgpu::TextureView,
        clear: wgpu::Color,
    ) -> (wgpu::RenderPassColorAttachment<'a>, wgpu::RenderPassDepthStencilAttachment<'a>) {
        let (color, depth) = self.targets.get_or_init(|| attachments(device, kind, self.width, self.height));
        let (view, resolve_target, store) = match color {
            Some(color) => (color, Some(frame), wgpu::StoreOp::Discard),
            None => (frame, None, wgpu::StoreOp::Store),
        };
        let color = wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store },
        };
        (color, depth_attachment(depth, wgpu::StoreOp::Discard))
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

/// What an attachment holds stays in it.
pub(crate) fn kept<T>() -> wgpu::Operations<T> {
    wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store }
}

fn attachments(
    device: &wgpu::Device,
    Kind { format, samples }: Kind,
    width: u32,
    height: u32,
) -> (Option<wgpu::TextureView>, wgpu::TextureView) {
    let make = |label, format| {
        texture(device, label, (width, height), samples, format, wgpu::TextureUsages::RENDER_ATTACHMENT)
    };
    let color = (samples > 1).then(|| make("rock-field/view/color", format));
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
