//! One field on the device: its buffers, and the functions that draw it.

use std::ops::Range;

use bytemuck::Zeroable;
use glam::Vec3;

use super::buffers::{Mesh, MeshBuffers, VertexBuffers};
use super::indices::arranged;
use super::maps::{MapSets, Maps};
use super::surface::depth_attachment;
use super::{Gpu, Props, RenderError, upload};
use crate::shading::{
    Arrangement, Body, Bounds, ColorMode, FieldUniforms, Look, Sample, Sight, Stands, Turned, beam, palette,
};

/// How large the triangles of the shadow and height maps may be on the mean, texels².
const TEXELS: f32 = 12.0;

/// Lower than anything is.
const LOWEST: f32 = -1.0e9;
/// How many indices of rocks a submission of maps draws.
const PART: u32 = 300_000;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Map {
    Shadow,
    Height,
}

/// What distinguishes the rocks from each other. It is small, and kept so that they can be coloured again.
pub(crate) struct Rocks {
    /// rocks + 1 offsets into the vertices.
    pub(crate) vertex_starts: Vec<u32>,
    /// rocks + 1 offsets into the indices.
    pub(crate) index_starts: Vec<u32>,
    /// Layer id of each rock.
    pub(crate) layers: Vec<u32>,
    /// Site index of each rock.
    pub(crate) sites: Vec<u32>,
}

impl Rocks {
    /// The rocks before their vertices are known.
    fn bodies(&self) -> Vec<Body> {
        let counts =
            |starts: &'_ [u32]| -> Vec<u32> { starts.iter().zip(starts.iter().skip(1)).map(|(a, b)| b - a).collect() };
        let [vertices, indices] = [&self.vertex_starts, &self.index_starts].map(|starts| counts(starts));
        let counts = vertices.into_iter().zip(indices);
        let of = |(&layer, (vertices, indices)): (&u32, (u32, u32))| Body {
            layer,
            low: Vec3::INFINITY,
            high: Vec3::NEG_INFINITY,
            vertices,
            triangles: indices / 3,
        };
        self.layers.iter().zip(counts).map(of).collect()
    }
}

/// Buffers and bind groups of one field.
pub(crate) struct Scene {
    /// Identifies the contents of the shadow and height maps. It is unique on the device, and renewed whenever the maps
    /// have to be redrawn.
    pub(crate) number: u64,
    buffers: MeshBuffers,
    arrangement: Arrangement,
    rocks: Rocks,
    stands: Stands,
    painted: Option<ColorMode>,
    stale: bool,
    /// The direction of the sun with which the uniforms were written.
    sun: Vec3,
    props: Option<u64>,
    /// One texel of the height map, px.
    texel: f32,
    low: Vec3,
    high: Vec3,
    /// The same with the props.
    pub(crate) bounds: Bounds,
    /// Middle and radius of a sphere around everything.
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
    /// Whether insides of rocks are seen from above, because c_w turns some of them inside out.
    pub(crate) is_turned: bool,
    /// Whether rocks or props extend below the ground.
    pub(crate) is_buried: bool,
    pub(crate) image: [f32; 2],
    uniforms: wgpu::Buffer,
    /// What was written to them last.
    lit: FieldUniforms,
    pub(crate) field_group: wgpu::BindGroup,
}

impl Drop for Scene {
    /// As with the buffers of a mesh, the memory is not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        self.uniforms.destroy();
    }
}

impl Scene {
    /// Uploads the mesh of `rocks`, which were grown on an image of `image` px. Their colours follow with
    /// [`Scene::paint`], the maps with [`Scene::draw_maps`].
    pub(crate) fn new(gpu: &Gpu, image: [f32; 2], mesh: &Mesh<'_>, rocks: Rocks) -> Result<Self, RenderError> {
        if rocks.layers.len() != rocks.sites.len()
            || rocks.layers.len() + 1 != rocks.vertex_starts.len()
            || rocks.vertex_starts.last() != Some(&mesh.vertices())
            || rocks.layers.len() + 1 != rocks.index_starts.len()
            || rocks.index_starts.last() != Some(&mesh.indices.length())
            || !rocks.index_starts.is_sorted()
        {
            return Err(RenderError::Malformed("rockStarts, vertexStarts, rockLayer and selected disagree"));
        }
        let mut stands = Stands::default();
        let mut bodies = rocks.bodies();
        let mut ends = rocks.vertex_starts.iter().skip(1).peekable();
        let mut rock = 0;
        let mut count = 0;
        let vertices = VertexBuffers::new(gpu, "rock", mesh, |vertex| {
            if let Some(body) = bodies.get_mut(rock) {
                // NaN does not change these.
                body.low = vertex.min(body.low);
                body.high = vertex.max(body.high);
            }
            stands.add(vertex.to_array());
            count += 1;
            if ends.next_if_eq(&&count).is_some() {
                stands.close();
                rock += 1;
            }
            vertex
        })?;
        let (low, high) = bodies.iter().fold((Vec3::ZERO, Vec3::new(image[0], image[1], 1.0)), |(low, high), body| {
            (low.min(body.low), high.max(body.high))
        });
        let arrangement = Arrangement::of(&bodies, image);
        let (indices, highest) = arranged(gpu, mesh.indices, &rocks.index_starts, &bodies, &arrangement)?;
        let buffers = MeshBuffers::with_indices(vertices, mesh, indices, highest)?;
        let mut turned = Turned::new(&rocks.vertex_starts);
        mesh.each_vertex(|position, normal| turned.add(position, normal));
        let is_turned = turned.found();
        if !(high - low).is_finite() {
            return Err(RenderError::Malformed("a coordinate is infinite"));
        }

        let uniforms = upload::buffer(
            &gpu.device,
            "rock-field/field/uniforms",
            "uniforms",
            size_of::<FieldUniforms>() as u64,
            wgpu::BufferUsages::UNIFORM,
        )?;
        let field_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("rock-field/field/group"),
            layout: &gpu.pipelines.field_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() }],
        });
        Ok(Self {
            number: gpu.next_number(),
            buffers,
            arrangement,
            rocks,
            stands,
            painted: None,
            stale: false,
            sun: Vec3::ZERO,
            props: None,
            texel: 0.0,
            low,
            high,
            bounds: [low, high],
            center: (low + high) * 0.5,
            radius: (high - low).length() * 0.5,
            is_turned,
            is_buried: low.z < 0.0,
            image,
            uniforms,
            lit: FieldUniforms::zeroed(),
            field_group,
        })
    }

    /// Sets the sun's direction and the props, from now on.
    pub(crate) fn light(&mut self, gpu: &Gpu, sun: Vec3, props: &Props) {
        if (sun, Some(props.number)) == (self.sun, self.props) {
            return;
        }
        (self.sun, self.props) = (sun, Some(props.number));
        self.number = gpu.next_number();
        let (low, high) = props.around(self.low, self.high);
        self.center = (low + high) * 0.5;
        self.radius = (high - low).length() * 0.5;
        self.is_buried = low.z < 0.0;
        let mut uniforms = field_uniforms(sun, self.image, low, high, MapSets::side(gpu.max_side()) as f32);
        uniforms.ground[2] = if self.is_buried { 1.0 } else { 0.0 };
        uniforms.size[2] = self.high.z.max(1.0);
        let sky = gpu.sky(sun);
        uniforms.sunshine = sky.sunshine.extend(0.0).to_array();
        uniforms.sky = sky.uniforms(sun);
        if let Some(axis) = props.axis() {
            uniforms.log = [axis.middle, axis.half, axis.radius, axis.height];
            uniforms.bow = axis.bow;
        }
        self.texel = uniforms.ground[1];
        gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
        self.lit = uniforms;
        self.bounds = [low, high];
    }

    /// The uniforms of a sample of a still that shows what is in the box `lit`, and of the shadow maps of its three lights: of the
    /// sun, the sky and the ground.
    pub(crate) fn sampled(&self, sample: &Sample, lit: Bounds) -> (FieldUniforms, [FieldUniforms; 3]) {
        let beams = [sample.sun, sample.sky, sample.below].map(|way| {
            let (from_world, across) = beam(way, lit, self.bounds);
            (from_world.to_cols_array_2d(), way.extend(across).to_array())
        });
        let lights = beams.map(|(from_world, way)| {
            let mut light = FieldUniforms { sun_from_world: from_world, sun: way, ..self.lit };
            light.ground[3] = if way[2] < 0.0 { 0.0 } else { LOWEST };
            light
        });
        let [(sun_from_world, sun), (sky_from_world, sky_way), (below_from_world, below_way)] = beams;
        let field =
            FieldUniforms { sun_from_world, sun, sky_from_world, sky_way, below_from_world, below_way, ..self.lit };
        (field, lights)
    }

    /// Marks the rocks as painted with other materials, so that natural colours are painted again.
    pub(crate) fn unpaint(&mut self) {
        self.stale = true;
    }

    /// Gives every rock its colour in `mode`. Does nothing if the rocks have it already.
    pub(crate) fn paint(&mut self, gpu: &Gpu, mode: ColorMode, look: &Look) {
        if self.painted == Some(mode) && !(self.stale && mode == ColorMode::Natural) {
            return;
        }
        self.stale = false;
        // In natural colours some rocks are lowered.
        let sinks = |mode| mode == Some(ColorMode::Natural);
        if sinks(self.painted) != sinks(Some(mode)) {
            self.number = gpu.next_number();
        }
        self.painted = Some(mode);
        let Self { buffers, rocks, stands, image, high, .. } = &*self;
        let mut rock = 0;
        let mut color = 0;
        let mut end = 0;
        buffers.paint(gpu, |vertex| {
            while vertex >= end && rock < rocks.layers.len() {
                let id = |list: &[u32]| list.get(rock).copied().unwrap_or(0);
                let (layer, site) = (id(&rocks.layers), id(&rocks.sites));
                let hash = palette::hash(layer, site);
                color = match mode {
                    ColorMode::Natural => {
                        let sinks = stands.sinks(rock, *image, high.z, hash);
                        palette::natural(look.material(layer), sinks, hash)
                    }
                    _ => palette::rock(mode, layer, hash),
                };
                rock += 1;
                end = id_at(&rocks.vertex_starts, rock);
            }
            color
        });
    }

    pub(crate) fn has_edges(&self) -> bool {
        self.buffers.has_edges() || self.buffers.is_empty()
    }

    /// Makes the line list of every triangle's edges. `indices` must be those given to [`Scene::new`].
    pub(crate) fn set_edges(&mut self, gpu: &Gpu, indices: &js_sys::Uint32Array) -> Result<(), RenderError> {
        self.buffers.set_edges(gpu, indices)
    }

    /// Draws the shadow and height maps, and writes the sky's. They change only with the field, the sun and the props, so drawing them once
    /// is enough.
    pub(crate) fn draw_maps(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        maps: &Maps,
        props: &Props,
    ) {
        maps.write_sky(&gpu.queue, &gpu.sky(self.sun));
        let rocks = self.arrangement.all(TEXELS * self.texel * self.texel);
        for which in [Map::Shadow, Map::Height] {
            self.draw_map(gpu, encoder, frame_group, (which, maps), props, &rocks, true);
        }
    }

    /// The same in submissions of their own, each of a few of the rocks.
    pub(crate) fn submit_maps(&self, gpu: &Gpu, frame_group: &wgpu::BindGroup, maps: &Maps, props: &Props) {
        maps.write_sky(&gpu.queue, &gpu.sky(self.sun));
        let rocks = parts(&self.arrangement.all(TEXELS * self.texel * self.texel));
        let none = Props::default();
        for which in [Map::Shadow, Map::Height] {
            for (part, rocks) in rocks.iter().enumerate() {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                let props = if part == 0 { props } else { &none };
                self.draw_map(gpu, &mut encoder, frame_group, (which, maps), props, rocks, part == 0);
                gpu.queue.submit([encoder.finish()]);
            }
        }
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
            Map::Shadow => ("rock-field/shadow/pass", &gpu.pipelines.shadow, &maps.shadow),
            Map::Height => ("rock-field/height/pass", &gpu.pipelines.height, &maps.height_depth),
        };
        let mut depth = depth_attachment(depth, wgpu::StoreOp::Store);
        let mut load = wgpu::LoadOp::Clear(wgpu::Color::BLACK);
        if !is_first {
            load = wgpu::LoadOp::Load;
            depth.depth_ops = Some(wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store });
        }
        let colors = [Some(wgpu::RenderPassColorAttachment {
            view: &maps.height,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
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
        props.draw(&mut pass, [pipeline; 2]);
    }

    /// Draws the shadow map of a light whose uniforms are in `light`; a texel of it is so many px wide.
    pub(crate) fn draw_shadows(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        [frame, light]: [&wgpu::BindGroup; 2],
        map: &wgpu::TextureView,
        texel: f32,
        props: &Props,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/still/shadow"),
            depth_stencil_attachment: Some(depth_attachment(map, wgpu::StoreOp::Store)),
            ..Default::default()
        });
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, light, &[]);
        self.draw_rocks(&mut pass, &gpu.pipelines.shadow, &self.arrangement.all(TEXELS * texel * texel));
        props.draw(&mut pass, [&gpu.pipelines.shadow; 2]);
    }

    pub(crate) fn vertices(&self) -> u32 {
        self.buffers.vertices()
    }

    /// What has to be drawn of the rocks in a picture.
    pub(crate) fn seen(&self, sight: &Sight) -> Vec<Range<u32>> {
        self.arrangement.seen(sight)
    }

    /// The top of the highest rock, px: deeper none sinks.
    pub(crate) fn highest(&self) -> f32 {
        self.high.z
    }

    /// All rocks, with all of their triangles.
    pub(crate) fn whole(&self) -> Vec<Range<u32>> {
        self.arrangement.all(0.0)
    }

    /// Draws what `ranges` tell of the rocks.
    pub(crate) fn draw_rocks(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        ranges: &[Range<u32>],
    ) {
        self.buffers.draw_ranges(pass, pipeline, ranges);
    }

    /// Draws all edges at once, or nothing before [`Scene::set_edges`].
    pub(crate) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        self.buffers.draw_edges(pass, pipeline);
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

fn id_at(list: &[u32], at: usize) -> u32 {
    list.get(at).copied().unwrap_or(u32::MAX)
}

/// Fits the sun's orthographic camera and the height map to the box `low`…`high`.
fn field_uniforms(sun: Vec3, image: [f32; 2], low: Vec3, high: Vec3, side: f32) -> FieldUniforms {
    // There must be room on the ground for the longest shadow, so that none is cut off at the map's edge.
    let reach = high.z * (sun.truncate().length() / sun.z);
    let bounds = [low - Vec3::new(reach, reach, 0.0), high + Vec3::new(reach, reach, 0.0)];
    let (sun_from_world, across) = beam(sun, bounds, bounds);
    // With a margin of four texels, samples at the border read empty ground.
    let extent = (high - low).truncate();
    let texel = extent.max_element() / (side - 8.0);
    let corner = low.truncate() - glam::Vec2::splat(4.0 * texel);
    let scale = (extent + glam::Vec2::splat(8.0 * texel)).recip();
    FieldUniforms {
        sun_from_world: sun_from_world.to_cols_array_2d(),
        sun: sun.extend(across).to_array(),
        map: [corner.x, corner.y, scale.x, scale.y],
        size: [image[0], image[1], high.z.max(1.0), high.z.max(1.0)],
        ground: [0.36 * image[0].max(image[1]), texel, 0.0, LOWEST],
        ..FieldUniforms::zeroed()
    }
}
