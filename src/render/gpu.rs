//! The graphics device, which all canvases of a page share.

use std::cell::{Cell, OnceCell, RefCell};
use std::rc::Rc;

use glam::Vec3;

use super::RenderError;
use super::easel::Easel;
use super::maps::MapSets;
use super::pipelines::Pipelines;
use super::present::Present;
use super::surface::{Kind, Screen};
use crate::shading::Sky;

/// Device, queue, pipelines and maps, shared by many canvases ([`super::View`]) and fields ([`super::Scene`]).
pub(crate) struct Gpu {
    instance: wgpu::Instance,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) pipelines: Pipelines,
    pub(crate) kind: Kind,
    pub(crate) maps: RefCell<MapSets>,
    /// With WebGL2, where a device is bound to one canvas: the screen on which all views are drawn, and from which
    /// their pictures are copied.
    pub(crate) shared: Option<RefCell<Screen>>,
    /// Of pictures that are drawn in pieces.
    pub(crate) easel: RefCell<Option<Easel>>,
    pub(crate) present: OnceCell<Present>,
    numbers: Cell<u64>,
    /// The sky that was asked for last, and the sine of its sun's elevation.
    sky: RefCell<Option<([f32; 2], Rc<Sky>)>>,
}

/// Called once, with a reason, when the device is lost or out of memory.
pub(crate) type OnLost = fn(id: u32, reason: &str);

impl Gpu {
    /// Creates a device. With WebGL2 it is bound to `canvas`, on which all views are then drawn. With WebGPU, `canvas`
    /// only shows what canvases are like here, and is not used before the device exists. `on_lost` is called with `id`.
    /// It is a function pointer, because wgpu requires callbacks to be `Send`.
    pub(crate) async fn new(canvas: web_sys::HtmlCanvasElement, id: u32, on_lost: OnLost) -> Result<Self, RenderError> {
        let is_webgl = cfg!(feature = "renderer-webgl");
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let early = if is_webgl { Some(make_surface(&instance, canvas.clone())?) } else { None };
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                compatible_surface: early.as_ref(),
                ..Default::default()
            })
            .await
            .map_err(|error| RenderError::NoAdapter(error.to_string()))?;
        let (device, queue) = request_device(&adapter).await?;
        watch(&device, id, on_lost);
        let surface = match early {
            Some(surface) => surface,
            None => make_surface(&instance, canvas)?,
        };
        let kind = Kind::of(&surface, &adapter)?;
        Ok(Self {
            pipelines: Pipelines::new(&device, kind),
            shared: is_webgl.then(|| RefCell::new(Screen::new(&device, kind, surface))),
            instance,
            device,
            queue,
            kind,
            maps: RefCell::default(),
            easel: RefCell::default(),
            present: OnceCell::new(),
            numbers: Cell::new(0),
            sky: RefCell::default(),
        })
    }

    /// Makes the screen of a view that has its own canvas. Not for WebGL2.
    pub(crate) fn screen(&self, canvas: web_sys::HtmlCanvasElement) -> Result<Screen, RenderError> {
        Ok(Screen::new(&self.device, self.kind, make_surface(&self.instance, canvas)?))
    }

    /// Returns a number that was never returned before.
    pub(crate) fn next_number(&self) -> u64 {
        self.numbers.set(self.numbers.get() + 1);
        self.numbers.get()
    }

    /// The sky around the sun in this direction, over ground on which so much snow has fallen.
    pub(crate) fn sky(&self, sun: Vec3, snow: f32) -> Rc<Sky> {
        let mut last = self.sky.borrow_mut();
        match &*last {
            Some((key, sky)) if *key == [sun.z, snow] => sky.clone(),
            _ => {
                let sky = Rc::new(Sky::new(sun.z.asin(), snow));
                *last = Some(([sun.z, snow], sky.clone()));
                sky
            }
        }
    }

    /// Frees the device's memory now, and not only when JavaScript collects the device.
    pub(crate) fn destroy(&self) {
        self.device.destroy();
    }

    /// Largest side of a canvas, device pixels.
    pub(crate) fn max_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }
}

fn make_surface(
    instance: &wgpu::Instance,
    canvas: web_sys::HtmlCanvasElement,
) -> Result<wgpu::Surface<'static>, RenderError> {
    instance
        .create_surface(wgpu::SurfaceTarget::Canvas(canvas))
        .map_err(|error| RenderError::Surface(error.to_string()))
}

/// Requests a device with the smallest limits that are enough: those of WebGL2, with this adapter's own sizes of
/// textures and buffers.
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
