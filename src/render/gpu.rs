//! The device: what all canvases can share.

use super::RenderError;
use super::pipelines::Pipelines;
use super::surface;

/// Device, queue and pipelines; one may serve many canvases ([`super::View`]) and fields ([`super::Scene`]).
pub(crate) struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) pipelines: Pipelines,
    /// Of every canvas drawn to.
    pub(crate) format: wgpu::TextureFormat,
    /// 4, or 1 where the format cannot be multisampled.
    pub(crate) samples: u32,
}

/// Told once, with a reason, when the device is lost or out of memory.
pub(crate) type OnLost = fn(id: u32, reason: &str);

impl Gpu {
    /// Asks for a device, then for a surface on `canvas`: with WebGPU the canvas stays untouched until
    /// the device stands. WebGL2 has no adapter without its canvas, so there the surface comes first.
    /// `on_lost` is called with `id`; a function pointer, because wgpu wants its callbacks `Send`.
    pub(crate) async fn with_canvas(
        canvas: web_sys::HtmlCanvasElement,
        id: u32,
        on_lost: OnLost,
    ) -> Result<(Self, wgpu::Surface<'static>), RenderError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let make_surface = |canvas| {
            instance
                .create_surface(wgpu::SurfaceTarget::Canvas(canvas))
                .map_err(|error| RenderError::Surface(error.to_string()))
        };
        let (early, canvas) =
            if cfg!(feature = "renderer-webgl") { (Some(make_surface(canvas)?), None) } else { (None, Some(canvas)) };
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                compatible_surface: early.as_ref(),
                ..Default::default()
            })
            .await
            .map_err(|error| RenderError::NoAdapter(error.to_string()))?;
        let (device, queue) = request_device(&adapter).await?;
        let surface = match (early, canvas) {
            (Some(surface), _) => surface,
            (None, Some(canvas)) => make_surface(canvas)?,
            (None, None) => return Err(RenderError::Surface("no canvas".into())),
        };
        watch(&device, id, on_lost);

        let format = surface::format(&surface, &adapter)?;
        let flags = adapter.get_texture_format_features(format).flags;
        let samples = if flags.sample_count_supported(4) { 4 } else { 1 };
        let pipelines = Pipelines::new(&device, format, samples);
        let gpu = Self { device, queue, pipelines, format, samples };
        Ok((gpu, surface))
    }

    /// Gives the device's memory back now, rather than when JavaScript collects it.
    pub(crate) fn destroy(&self) {
        self.device.destroy();
    }

    /// Largest side of a canvas, device pixels.
    pub(crate) fn max_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }
}

/// The smallest limits that do: WebGL2's, with this adapter's own texture and buffer sizes.
async fn request_device(adapter: &wgpu::Adapter) -> Result<(wgpu::Device, wgpu::Queue), RenderError> {
    let offered = adapter.limits();
    let required_limits = wgpu::Limits {
        max_buffer_size: offered.max_buffer_size,
        ..wgpu::Limits::downlevel_webgl2_defaults().using_resolution(offered)
    };
    adapter
        .request_device(&wgpu::DeviceDescriptor {
            label: Some("rock-field/device"),
            required_limits,
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        })
        .await
        .map_err(|error| RenderError::NoDevice(error.to_string()))
}

fn watch(device: &wgpu::Device, id: u32, on_lost: OnLost) {
    device.set_device_lost_callback(move |_, message| {
        on_lost(id, &format!("the graphics device was lost: {message}"));
    });
    device.on_uncaptured_error(std::sync::Arc::new(move |error: wgpu::Error| match error {
        wgpu::Error::OutOfMemory { .. } => on_lost(id, "the graphics device is out of memory"),
        other => web_sys::console::error_1(&format!("rock-field: {other}").into()),
    }));
}
