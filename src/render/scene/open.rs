//! What the rocks see of the sky: found once for each vertex, since all pictures of a field ask for it.
//!
//! WebGL2 computes for pixels only. So some vertices at a time are copied to textures, a texel is drawn for each of them, and these are copied back. Points
//! for the vertices would do as well, and take a device without a GPU three times as long.

use super::super::Gpu;
use super::super::maps::Maps;
use super::super::pass::OPEN_FORMAT;
use super::super::pipelines::Fixed;
use super::super::surface::texture;
use super::Scene;

/// Texels of what is drawn on: so many vertices are looked at in a submission, which takes a device without a GPU some 15 ms.
const COLUMNS: u32 = 512;
const ROWS: u32 = 128;

/// The textures: of positions, with three texels for each vertex, normals, colours, and of what is drawn.
const TEXTURES: [(&str, u32, wgpu::TextureFormat); 4] = [
    ("rock-field/open/positions", 3, wgpu::TextureFormat::R32Float),
    ("rock-field/open/normals", 1, wgpu::TextureFormat::R32Uint),
    ("rock-field/open/colors", 1, wgpu::TextureFormat::Rgba8Unorm),
    ("rock-field/open/rocks", 1, OPEN_FORMAT),
];

impl Scene {
    /// Finds what the rocks see of the sky, unless it is known. In natural colours, `frame_group` being that of a picture and `maps` drawn.
    pub(crate) fn open(&self, gpu: &Gpu, frame_group: &wgpu::BindGroup, maps: &Maps) {
        let Some(open) = self.buffers.open().filter(|_| self.opened.get() != self.drawn.heights) else {
            return;
        };
        self.opened.set(self.drawn.heights);
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let textures = TEXTURES.map(|(label, each, format)| {
            let usage = if label == TEXTURES[3].0 { drawn } else { read };
            texture(&gpu.device, label, (each * COLUMNS, ROWS), 1, format, usage)
        });
        let [positions, normals, colors, seen] = &textures;
        let entry =
            |(binding, view)| wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) };
        let entries: Vec<_> = (0..).zip([positions, normals, colors]).map(entry).collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("rock-field/open/group"),
            layout: &gpu.pipelines.vertices_layout,
            entries: &entries,
        });
        let count = self.vertices();
        for start in (0..count).step_by((COLUMNS * ROWS) as usize) {
            let some = count.min(start + COLUMNS * ROWS) - start;
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            for ((buffer, view), (_, each, _)) in self.buffers.each().into_iter().zip(&textures).zip(TEXTURES) {
                for (place, size) in rows(view, some, each) {
                    encoder.copy_buffer_to_texture(slice(buffer, start, place, each), place, size);
                }
            }
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("rock-field/open/rocks"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: seen,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            for (index, group) in (0..).zip([frame_group, &self.field_group, &maps.group, &group]) {
                pass.set_bind_group(index, group, &[]);
            }
            pass.set_pipeline(gpu.pipelines.fixed(&gpu.device, Fixed::OpenRocks));
            pass.set_scissor_rect(0, 0, COLUMNS, some.div_ceil(COLUMNS));
            pass.draw(0..3, 0..1);
            drop(pass);
            for (place, size) in rows(seen, some, 1) {
                encoder.copy_texture_to_buffer(place, slice(open, start, place, 1), size);
            }
            gpu.queue.submit([encoder.finish()]);
        }
        for view in &textures {
            view.texture().destroy();
        }
    }
}

/// Where so many vertices lie in a texture that has `each` texels for one: in whole rows, and in a part of the next.
fn rows(
    view: &wgpu::TextureView,
    vertices: u32,
    each: u32,
) -> impl Iterator<Item = (wgpu::TexelCopyTextureInfo<'_>, wgpu::Extent3d)> {
    let (whole, part) = (vertices / COLUMNS, vertices % COLUMNS);
    let of = move |(y, columns, height)| {
        let place =
            wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x: 0, y, z: 0 }, ..view.texture().as_image_copy() };
        (place, wgpu::Extent3d { width: each * columns, height, depth_or_array_layers: 1 })
    };
    [(0, COLUMNS, whole), (whole, part, 1)].into_iter().filter(|&(_, columns, height)| columns * height > 0).map(of)
}

/// Where a buffer, with `each` times four bytes a vertex, has what lies at `place` when the texture begins with the vertex `start`.
fn slice<'a>(
    buffer: &'a wgpu::Buffer,
    start: u32,
    place: wgpu::TexelCopyTextureInfo<'_>,
    each: u32,
) -> wgpu::TexelCopyBufferInfo<'a> {
    let offset = 4 * u64::from(each) * u64::from(start + place.origin.y * COLUMNS);
    let layout =
        wgpu::TexelCopyBufferLayout { offset, bytes_per_row: Some(4 * each * COLUMNS), rows_per_image: Some(ROWS) };
    wgpu::TexelCopyBufferInfo { buffer, layout }
}
