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

/// Indices of rocks: of the field, or of the copy of this number.
type Rocks = (Option<usize>, Range<u32>);

impl Scene {
    /// Draws a part of those of the maps that are stale, from number 0, in a submission of its own that takes no device long: of the shadows, with the
    /// sky; of the heights; and, if `is_natural`, of what the ground and then the rocks see of the sky. True while there is another part. The maps
    /// change only with the field, the props and, but for the heights, the sun.
    #[allow(clippy::too_many_arguments, reason = "what is drawn, and on what")]
    pub(crate) fn draw_maps(
        &self,
        gpu: &Gpu,
        frame_group: &wgpu::BindGroup,
        maps: &Maps,
        stale: Stale,
        props: &Props,
        is_natural: bool,
        part: usize,
    ) -> bool {
        if part == 0 {
            maps.write_sky(&gpu.queue, &gpu.sky(self.sun, self.snow));
        }
        // Of the heights only what stands on the field: they know no sun.
        let shadows = if stale.shadows { self.rocks(self.sun) } else { Vec::new() };
        let heights = if stale.heights { self.rocks(Vec3::Z) } else { Vec::new() };
        let ground = if stale.heights && is_natural { OPEN_PARTS } else { 0 };
        let vertices = if is_natural { self.closed(maps) } else { 0 };
        let of_rocks = shadows.len() + heights.len();
        let of_ground = of_rocks + ground as usize;
        let last = (of_ground + vertices as usize).saturating_sub(1);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut used = None;
        if let Some(rocks) = shadows.iter().chain(&heights).nth(part) {
            let which = if part < shadows.len() { Map::Shadow } else { Map::Height };
            let is_first = part == 0 || part == shadows.len();
            let none = Props::default();
            let props = if is_first { props } else { &none };
            self.draw_map(gpu, &mut encoder, frame_group, (which, maps), props, rocks, is_first);
        } else if part < of_ground {
            self.draw_open(gpu, &mut encoder, frame_group, maps, (part - of_rocks) as u32);
        } else if part <= last {
            used = Some(self.open(gpu, &mut encoder, frame_group, maps, (part - of_ground) as u32, part == last));
        }
        gpu.queue.submit([encoder.finish()]);
        used.iter().flatten().for_each(|view| view.texture().destroy());
        part < last
    }

    /// What is drawn into the field's own maps, in parts of at most [`PART`] indices: the field, and what its copies throw into it in the light of `sun`.
    fn rocks(&self, sun: Vec3) -> Vec<Vec<Rocks>> {
        let most = TEXELS * self.texel * self.texel;
        let mut all = self.own(most);
        if self.is_surrounded {
            self.around.add_neighbours(&mut all, &self.arrangement, sun, most);
        }
        parts(all)
    }

    fn own(&self, most: f32) -> Vec<Rocks> {
        self.arrangement.all(most, self.has_sunk()).into_iter().map(|range| (None, range)).collect()
    }

    /// Whether the rocks near the field's border have sunk.
    fn has_sunk(&self) -> bool {
        self.painted == Some(ColorMode::Natural)
    }

    /// Finds what the ground sees of the sky, in one of [`OPEN_PARTS`] strips of the map.
    fn draw_open(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        maps: &Maps,
        part: u32,
    ) {
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
        rocks: &[Rocks],
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
        props.draw(&mut pass, [pipeline; 2]);
        self.draw_some(&mut pass, gpu, pipeline, rocks);
    }

    /// Draws rocks of the field and then of its copies.
    fn draw_some(&self, pass: &mut wgpu::RenderPass<'_>, gpu: &Gpu, pipeline: &wgpu::RenderPipeline, rocks: &[Rocks]) {
        let mut ranges = Vec::new();
        let mut rocks = rocks.iter().peekable();
        while let Some((copy, range)) = rocks.next() {
            ranges.push(range.clone());
            if rocks.peek().is_some_and(|(next, _)| next == copy) {
                continue;
            }
            if let Some(copy) = copy {
                self.around.bind(pass, gpu, *copy);
            }
            self.draw_rocks(pass, pipeline, &ranges);
            ranges.clear();
        }
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
        let parts = parts(self.own(TEXELS * texel * texel));
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
        self.draw_some(&mut pass, gpu, pipeline, parts.get(part).map_or(&[], Vec::as_slice));
        if part == 0 {
            props.draw(&mut pass, [pipeline; 2]);
        }
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        part + 1 < parts.len()
    }
}

/// Cuts ranges of indices into parts of at most [`PART`] indices; there is at least one.
fn parts(ranges: Vec<Rocks>) -> Vec<Vec<Rocks>> {
    let mut parts = vec![Vec::new()];
    let mut room = PART;
    for (copy, range) in ranges {
        let mut start = range.start;
        while start < range.end {
            if room == 0 {
                parts.push(Vec::new());
                room = PART;
            }
            let end = range.end.min(start + room);
            parts.last_mut().into_iter().for_each(|part| part.push((copy, start..end)));
            room -= end - start;
            start = end;
        }
    }
    parts
}
