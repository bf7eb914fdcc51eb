//! What the rocks see of the sky, and where moss likes to grow: found once for each vertex, since all pictures of a field ask for it.
//!
//! WebGL2 computes for pixels only. So some vertices at a time are copied to textures, a texel is drawn for each of them, and these are copied back. Points
//! for the vertices would do as well, and take a device without a GPU three times as long.

use super::super::Gpu;
use super::super::buffers::ROW;
use super::super::maps::{Maps, linear};
use super::super::pass::OPEN_FORMAT;
use super::super::pipelines::Fixed;
use super::super::surface::texture;
use super::Scene;

/// Rows of vertices in a submission, which takes a device without a GPU some 15 ms.
const ROWS: u32 = 128;

impl Scene {
    /// In how many parts it is to be found what the rocks see of the sky, as `maps` have the heights: none if it is known.
    pub(super) fn closed(&self, maps: &Maps) -> u32 {
        let is_known = self.opened.get() == (self.drawn.heights, maps.height.texture().width());
        if is_known { 0 } else { self.vertices().div_ceil(ROW * ROWS) }
    }

    /// Finds what some of the rocks see of the sky: in a part that [`Scene::closed`] counts, which may be the last. In natural colours, `frame_group`
    /// being that of a picture and `maps` drawn. Returns what can be freed when it is submitted.
    pub(super) fn open(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        maps: &Maps,
        part: u32,
        is_last: bool,
    ) -> [wgpu::TextureView; 4] {
        let make = |each, format, usage| {
            texture(&gpu.device, "rock-field/open/vertices", (each * ROW, ROWS), 1, format, usage)
        };
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let seen = make(1, OPEN_FORMAT, drawn);
        let buffers = self.buffers.each();
        // Positions, normals and colours.
        let views = buffers.map(|(_, each)| make(each, wgpu::TextureFormat::R32Uint, read));
        let group = group(gpu, maps, &views);
        let patterns = gpu.pipelines.patterns(&gpu.device, &gpu.queue);
        let start = part * ROWS;
        let height = ROWS.min(self.vertices().div_ceil(ROW) - start);
        let size = |each| wgpu::Extent3d { width: each * ROW, height, depth_or_array_layers: 1 };
        let part = |buffer, each| {
            let row = 4 * each * ROW;
            let offset = u64::from(row) * u64::from(start);
            let layout = wgpu::TexelCopyBufferLayout { offset, bytes_per_row: Some(row), rows_per_image: Some(height) };
            wgpu::TexelCopyBufferInfo { buffer, layout }
        };
        for ((buffer, each), view) in buffers.into_iter().zip(&views) {
            encoder.copy_buffer_to_texture(part(buffer, each), view.texture().as_image_copy(), size(each));
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/open/rocks"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &seen,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        for (index, group) in (0..).zip([frame_group, &self.field_group, &group, patterns]) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.set_scissor_rect(0, 0, ROW, height);
        pass.set_pipeline(gpu.pipelines.fixed(&gpu.device, Fixed::OpenRocks));
        pass.draw(0..3, 0..1);
        drop(pass);
        if let Some(open) = self.buffers.open() {
            encoder.copy_texture_to_buffer(seen.texture().as_image_copy(), part(open, 1), size(1));
        }
        if is_last {
            self.opened.set((self.drawn.heights, maps.height.texture().width()));
        }
        let [positions, normals, colors] = views;
        [positions, normals, colors, seen]
    }
}

/// The group `vertices`.
fn group(gpu: &Gpu, maps: &Maps, [positions, normals, colors]: &[wgpu::TextureView; 3]) -> wgpu::BindGroup {
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    let view = |binding, view| entry(binding, wgpu::BindingResource::TextureView(view));
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("rock-field/open/group"),
        layout: &gpu.pipelines.vertices_layout,
        entries: &[
            view(2, &maps.height),
            entry(3, wgpu::BindingResource::Sampler(&linear(&gpu.device, None))),
            view(12, positions),
            view(13, normals),
            view(14, colors),
        ],
    })
}
