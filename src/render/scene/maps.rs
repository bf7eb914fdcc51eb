//! The maps of a field: how they are drawn.

use std::ops::Range;

use super::super::maps::{Maps, Stale, group};
use super::super::pipelines::Fixed;
use super::super::surface::{depth_attachment, kept};
use super::super::{Gpu, Props};
use super::Scene;
use crate::shading::ColorMode;
use glam::Vec3;

/// How large the triangles of the shadow and height maps may be on the mean, texels².
const TEXELS: f32 = 12.0;

/// How many indices of rocks a submission of maps draws.
const PART: u32 = 300_000;

/// Into how many strips the map of what the ground sees is cut.
const OPEN_PARTS: u32 = 4;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Map {
    Shadow,
    Height,
}

impl Scene {
    /// Draws those of the maps that are stale, in submissions each of a few of the rocks: the shadows with the sky, the heights with what the ground
    /// sees of the sky. They change only with the field, the props and, but for the heights, the sun.
    pub(crate) fn draw_maps(&self, gpu: &Gpu, frame_group: &wgpu::BindGroup, maps: &Maps, stale: Stale, props: &Props) {
        maps.write_sky(&gpu.queue, &gpu.sky(self.sun));
        let rocks = parts(&self.arrangement.all(TEXELS * self.texel * self.texel));
        let none = Props::default();
        for (which, is_stale) in [(Map::Shadow, stale.shadows), (Map::Height, stale.heights)] {
            for (part, rocks) in rocks.iter().enumerate().filter(|_| is_stale) {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                let props = if part == 0 { props } else { &none };
                self.draw_map(gpu, &mut encoder, frame_group, (which, maps), props, rocks, part == 0);
                gpu.queue.submit([encoder.finish()]);
            }
        }
        for part in if stale.heights { 0..OPEN_PARTS } else { 0..0 } {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            self.draw_open(gpu, &mut encoder, frame_group, maps, part);
            gpu.queue.submit([encoder.finish()]);
        }
    }

    /// Finds what the ground sees of the sky, in one of [`OPEN_PARTS`] strips of the map. The other styles do not ask for it.
    fn draw_open(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        maps: &Maps,
        part: u32,
    ) {
        if self.painted != Some(ColorMode::Natural) {
            return;
        }
        let side = maps.open.texture().width();
        let rows = side / OPEN_PARTS;
        let load = if part == 0 { wgpu::LoadOp::Clear(wgpu::Color::BLACK) } else { wgpu::LoadOp::Load };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/open/pass"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &maps.open,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        // Without the map itself, which cannot be read while it is drawn.
        let views = [&maps.height, &maps.sky, &maps.hills, &maps.hills];
        let maps = group(&gpu.device, &gpu.pipelines.maps_layout, [&maps.shadow; 3], views);
        for (index, group) in (0..).zip([frame_group, &self.field_group, &maps]) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.set_scissor_rect(0, part * rows, side, rows);
        pass.set_pipeline(gpu.pipelines.fixed(&gpu.device, Fixed::Open));
        pass.draw(0..3, 0..1);
    }

    /// Draws props and some rocks into a map, which is empty if these are the first.
    #[allow(clippy::too_many_arguments, reason = "what is drawn, and on what")]
    fn draw_map(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        (which, maps): (Map, &Maps),
        props: &Props,
        rocks: &[Range<u32>],
        is_first: bool,
    ) {
        let (label, pipeline, depth) = match which {
            Map::Shadow => ("rock-field/shadow/pass", gpu.pipelines.fixed(&gpu.device, Fixed::Shadow), &maps.shadow),
            Map::Height => {
                ("rock-field/height/pass", gpu.pipelines.fixed(&gpu.device, Fixed::Height), &maps.height_depth)
            }
        };
        let mut depth = depth_attachment(depth, wgpu::StoreOp::Store);
        let mut ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store };
        if !is_first {
            ops = kept();
            depth.depth_ops = Some(kept());
        }
        let colors = [Some(wgpu::RenderPassColorAttachment {
            view: &maps.height,
            depth_slice: None,
            resolve_target: None,
            ops,
        })];
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: if which == Map::Height { &colors } else { &[] },
            depth_stencil_attachment: Some(depth),
            ..Default::default()
        });
        pass.set_bind_group(0, frame_group, &[]);
        pass.set_bind_group(1, &self.field_group, &[]);
        self.draw_rocks(&mut pass, pipeline, rocks);
        if is_first && self.is_surrounded {
            let most = TEXELS * self.texel * self.texel;
            // For the heights only what stands on the field: they know no sun.
            let sun = if which == Map::Shadow { self.sun } else { Vec3::Z };
            self.around.draw_neighbours(&mut pass, gpu, pipeline, &self.field(), sun, most);
            pass.set_bind_group(1, &self.field_group, &[]);
        }
        props.draw(&mut pass, [pipeline; 2]);
    }

    /// Draws a part of the shadow map of a light whose uniforms are in `light`, from number 0; a texel of it is so many px wide. Whether there is another
    /// part.
    pub(crate) fn draw_shadows(
        &self,
        gpu: &Gpu,
        [frame, light]: [&wgpu::BindGroup; 2],
        map: &wgpu::TextureView,
        texel: f32,
        props: &Props,
        part: usize,
    ) -> bool {
        let parts = parts(&self.arrangement.all(TEXELS * texel * texel));
        let mut depth = depth_attachment(map, wgpu::StoreOp::Store);
        if part > 0 {
            depth.depth_ops = Some(kept());
        }
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/still/shadow"),
            depth_stencil_attachment: Some(depth),
            ..Default::default()
        });
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, light, &[]);
        let pipeline = gpu.pipelines.fixed(&gpu.device, Fixed::Shadow);
        self.draw_rocks(&mut pass, pipeline, parts.get(part).map_or(&[], Vec::as_slice));
        if part == 0 {
            props.draw(&mut pass, [pipeline; 2]);
        }
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        part + 1 < parts.len()
    }
}

/// Cuts ranges of indices into parts of at most [`PART`] indices; there is at least one.
fn parts(ranges: &[Range<u32>]) -> Vec<Vec<Range<u32>>> {
    let mut parts = vec![Vec::new()];
    let mut room = PART;
    for range in ranges {
        let mut start = range.start;
        while start < range.end {
            if room == 0 {
                parts.push(Vec::new());
                room = PART;
            }
            let end = range.end.min(start + room);
            parts.last_mut().into_iter().for_each(|part| part.push(start..end));
            room -= end - start;
            start = end;
        }
    }
    parts
}
