//! The rocks' surface as textures: tiles of an atlas, drawn one after the other and read back.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::pass::BAKE_FORMAT;
use super::pipelines::ATLAS_STRIDE;
use super::surface::texture;
use super::{Gpu, RenderError, upload};

/// Side of a tile, texels: 8 MB are read back at a time, however large the atlas is.
pub(crate) const SIDE: u32 = 1024;

const TEXEL: u32 = 8;

/// The places of a scene's vertices in its atlas, and the tile that is being drawn.
pub(crate) struct Bake {
    atlas: wgpu::Buffer,
    tile: wgpu::TextureView,
    read: wgpu::Buffer,
    /// Whether the device has answered, be it that the tile is lost.
    is_answered: Arc<AtomicBool>,
}

impl Drop for Bake {
    /// As with the buffers of a mesh, the memory is not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        self.atlas.destroy();
        self.read.destroy();
        self.tile.texture().destroy();
    }
}

impl Bake {
    /// `atlas` holds five numbers per vertex: its place, texels from the upper left corner, and its tangent.
    pub(crate) fn new(gpu: &Gpu, atlas: &js_sys::Float32Array) -> Result<Self, RenderError> {
        let device = &gpu.device;
        let length = atlas.length();
        let vertex = wgpu::BufferUsages::VERTEX;
        let places = upload::buffer(device, "rock-field/bake/atlas", "atlas", 4 * u64::from(length), vertex)?;
        upload::write::<f32>(&gpu.queue, &places, length, |start, slice| {
            atlas.subarray(start, start + slice.len() as u32).copy_to(slice);
        });
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let read = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("rock-field/bake/read"),
            size: u64::from(SIDE * SIDE * TEXEL),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let tile = texture(device, "rock-field/bake/tile", (SIDE, SIDE), 1, BAKE_FORMAT, usage);
        Ok(Self { atlas: places, tile, read, is_answered: Arc::default() })
    }

    /// Whether it has a place for each of this many vertices.
    pub(crate) fn fits(&self, vertices: u32) -> bool {
        self.atlas.size() >= u64::from(vertices) * ATLAS_STRIDE
    }

    /// Draws a tile with what `draw` draws, and begins to read it back. `encoder` holds what has to be drawn before.
    pub(crate) fn draw(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        groups: [&wgpu::BindGroup; 4],
        pipeline: &wgpu::RenderPipeline,
        draw: impl Fn(&mut wgpu::RenderPass<'_>, &wgpu::RenderPipeline),
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/bake/pass"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.tile,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        for (index, group) in (0..).zip(groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.set_vertex_buffer(4, self.atlas.slice(..));
        draw(&mut pass, pipeline);
        drop(pass);
        encoder.copy_texture_to_buffer(
            self.tile.texture().as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.read,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(SIDE * TEXEL),
                    rows_per_image: Some(SIDE),
                },
            },
            wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        self.is_answered.store(false, Ordering::Relaxed);
        let is_answered = self.is_answered.clone();
        self.read.map_async(wgpu::MapMode::Read, .., move |_| {
            is_answered.store(true, Ordering::Relaxed);
        });
    }

    /// The bytes of the tile, row by row, once they are there; the next tile may be drawn then.
    pub(crate) fn take(&self, gpu: &Gpu) -> Result<Option<js_sys::Uint8Array>, RenderError> {
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        if !self.is_answered.load(Ordering::Relaxed) {
            return Ok(None);
        }
        // Of a device that was lost there is nothing to read.
        let unreadable = |_| RenderError::Surface("a tile of the textures could not be read".into());
        let bytes = js_sys::Uint8Array::from(&*self.read.get_mapped_range(..).map_err(unreadable)?);
        self.read.unmap();
        Ok(Some(bytes))
    }
}
