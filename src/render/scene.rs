//! One field on the device: its buffers, and the functions that draw it.

mod fill;
mod maps;
mod open;

use std::cell::Cell;
use std::ops::Range;

use bytemuck::Zeroable;
use glam::Vec3;

use super::around::{Around, Field};
use super::buffers::{Mesh, MeshBuffers, VertexBuffers};
use super::fill::Fill;
use super::maps::Drawn;
use super::{Gpu, Props, RenderError, upload};
use crate::shading::{Arrangement, Body, Bounds, ColorMode, FieldUniforms, Look, Sample, Sight, Stands, beam, palette};

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
            is_hidden: false,
        };
        self.layers.iter().zip(counts).map(of).collect()
    }
}

/// How deep snow lies where as much has fallen as can, px.
const SNOW_DEEP: f32 = 6.0;

/// Buffers and bind groups of one field.
pub(crate) struct Scene {
    /// Identifies the contents of the shadow and height maps by numbers that are unique on the device, each renewed whenever its maps have to be
    /// redrawn.
    pub(crate) drawn: Drawn,
    /// The heights for which it was found what the rocks see of the sky, and the side of the map that had them.
    opened: Cell<(u64, u32)>,
    buffers: MeshBuffers,
    arrangement: Arrangement,
    rocks: Rocks,
    stands: Stands,
    /// What is still to be put into the buffers.
    fill: Option<Fill>,
    /// What was found out then, and why it cannot be drawn.
    fault: Option<RenderError>,
    painted: Option<ColorMode>,
    stale: bool,
    /// The direction of the sun with which the uniforms were written.
    sun: Vec3,
    /// How much snow had fallen then, 0…1.
    snow: f32,
    props: Option<u64>,
    /// The copies of the field round it, and whether they are shown.
    around: Around,
    is_surrounded: bool,
    /// Whether the maps are right for copies, too.
    is_repeated: bool,
    /// Whether the copies are lit as in a still's sample.
    is_sampled: bool,
    /// Side of the maps that the uniforms are for, and one texel of the height map, px.
    side: u32,
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
    /// Makes room for the mesh of `rocks`, which were grown on an image of `image` px. What is in it, and what is known by it, follows with
    /// [`Scene::fill`], their colours with [`Scene::paint`], the maps with [`Scene::draw_maps`].
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
        let bodies = rocks.bodies();
        let vertices = VertexBuffers::empty(gpu, "rock", mesh)?;
        let indices = MeshBuffers::index_buffer(gpu, "rock", Arrangement::length_of(&bodies))?;
        let mut buffers = MeshBuffers::with_indices(vertices, mesh, indices, 0)?;
        buffers.add_open(gpu)?;
        let (low, high) = (Vec3::ZERO, Vec3::new(image[0], image[1], 1.0));

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
            drawn: Drawn { shadows: gpu.next_number(), heights: gpu.next_number() },
            opened: Cell::new((0, 0)),
            side: 0,
            buffers,
            arrangement: Arrangement::of(&[], image),
            rocks,
            stands: Stands::default(),
            fill: Some(Fill::new(mesh, bodies)),
            fault: None,
            painted: None,
            stale: false,
            sun: Vec3::ZERO,
            snow: 0.0,
            props: None,
            around: Around::new(gpu, image)?,
            is_surrounded: false,
            is_repeated: false,
            is_sampled: false,
            texel: 0.0,
            low,
            high,
            bounds: [low, high],
            center: (low + high) * 0.5,
            radius: (high - low).length() * 0.5,
            is_turned: false,
            is_buried: false,
            image,
            uniforms,
            lit: FieldUniforms::zeroed(),
            field_group,
        })
    }

    /// Sets the sun's direction and the snow of `look`, the props, whether the ground goes on beyond the field, and the side of the maps, from now on.
    /// False where they were so.
    pub(crate) fn light(&mut self, gpu: &Gpu, look: &Look, props: &Props, is_surrounded: bool, side: u32) -> bool {
        while self.fill(gpu) {}
        let sun = look.sun;
        if look.snow != self.snow {
            // As with other props: no map is right any more.
            (self.snow, self.props) = (look.snow, None);
        }
        let is_same = (sun, Some(props.number), is_surrounded) == (self.sun, self.props, self.is_surrounded);
        if is_same && side == self.side {
            if self.is_sampled {
                self.light_around(gpu, &self.lit.clone(), false);
            }
            return false;
        }
        self.side = side;
        if !is_same {
            self.drawn.shadows = gpu.next_number();
        }
        if (self.props, self.is_surrounded) != (Some(props.number), is_surrounded) {
            self.drawn.heights = gpu.next_number();
        }
        (self.sun, self.props, self.is_surrounded) = (sun, Some(props.number), is_surrounded);
        let (low, high) = props.around(self.low, self.high);
        self.center = (low + high) * 0.5;
        self.radius = (high - low).length() * 0.5;
        self.is_buried = low.z < 0.0;
        let mut uniforms = FieldUniforms::fitted(sun, self.image, low, high, side as f32);
        uniforms.ground[2] = if self.is_buried { 1.0 } else { 0.0 };
        uniforms.size[2] = self.high.z.max(1.0);
        let sky = gpu.sky(sun, look.snow);
        uniforms.sunshine = sky.sunshine.extend(0.0).to_array();
        // What stands on the rocks would not sink with them.
        uniforms.sunshine[3] = if props.is_empty() { SNOW_DEEP * look.snow } else { 0.0 };
        uniforms.sky = sky.uniforms(sun);
        [uniforms.sky[2][3], uniforms.sky[3][3]] = self.hills_turned();
        uniforms.bricks = self.around.bricks().uniform();
        // What stands on the field stands on none of its copies, and would throw its shadow there.
        self.is_repeated = is_surrounded && props.is_empty();
        uniforms.bricks[3] = if self.is_repeated { 1.0 } else { 0.0 };
        if let Some(axis) = props.axis() {
            uniforms.log = [axis.middle, axis.half, axis.radius, axis.height];
            uniforms.bow = axis.bow;
        }
        self.texel = uniforms.ground[1];
        gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
        self.lit = uniforms;
        self.bounds = [low, high];
        self.light_around(gpu, &uniforms, false);
        true
    }

    /// Cosine and sine of how far the hills are turned: by what stays the same while most parameters change.
    fn hills_turned(&self) -> [f32; 2] {
        let layers = self.rocks.layers.iter().max().copied().unwrap_or(0);
        let sides = self.image[0] as u32 ^ (self.image[1] as u32) << 16;
        let angle = std::f32::consts::TAU * palette::share(palette::hash(layers, sides), 0);
        [angle.cos(), angle.sin()]
    }

    /// Lights the copies of the field as it is lit by `uniforms`, for what is submitted next: `is_sampled` if they are those of a sample, until
    /// the field is drawn in its own light again.
    pub(crate) fn light_around(&mut self, gpu: &Gpu, uniforms: &FieldUniforms, is_sampled: bool) {
        self.is_sampled = is_sampled;
        if self.is_surrounded {
            self.around.write(gpu, uniforms);
        }
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
            light.ground[3] = if way[2] < 0.0 { 0.0 } else { FieldUniforms::LOWEST };
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

    /// Gives every rock its colour in `mode`. False if the rocks have it already.
    pub(crate) fn paint(&mut self, gpu: &Gpu, mode: ColorMode, look: &Look) -> bool {
        if self.painted == Some(mode) && !(self.stale && mode == ColorMode::Natural) {
            return false;
        }
        self.stale = false;
        // In natural colours some rocks are lowered.
        let sinks = |mode| mode == Some(ColorMode::Natural);
        if sinks(self.painted) != sinks(Some(mode)) {
            self.drawn = Drawn { shadows: gpu.next_number(), heights: gpu.next_number() };
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
        true
    }

    /// Why it cannot be drawn, if that was found out after it was made.
    pub(crate) fn fault(&self) -> Option<&RenderError> {
        self.fault.as_ref()
    }

    /// Side of the maps that it is lit for; 0 before it is.
    pub(crate) fn side(&self) -> u32 {
        self.side
    }

    pub(crate) fn has_edges(&self) -> bool {
        self.buffers.has_edges() || self.buffers.is_empty()
    }

    /// Makes the line list of every triangle's edges. `indices` must be those given to [`Scene::new`].
    pub(crate) fn set_edges(&mut self, gpu: &Gpu, indices: &js_sys::Uint32Array) -> Result<(), RenderError> {
        self.buffers.set_edges(gpu, indices)
    }

    pub(crate) fn vertices(&self) -> u32 {
        self.buffers.vertices()
    }

    /// What has to be drawn of the rocks in a picture.
    pub(crate) fn seen(&self, sight: &Sight) -> Vec<Range<u32>> {
        self.arrangement.seen(sight)
    }

    /// Draws the copies of the field round it that a picture shows, if there are to be any, with about so many triangles.
    pub(crate) fn draw_around(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        gpu: &Gpu,
        pipeline: &wgpu::RenderPipeline,
        sight: &Sight,
        most: u32,
    ) {
        if self.is_surrounded {
            self.around.draw(pass, gpu, pipeline, &self.field(), sight, most);
        }
    }

    /// Whether a picture shows copies of the field.
    pub(crate) fn shows_around(&self, sight: &Sight) -> bool {
        self.is_surrounded && self.around.is_seen(&self.field(), sight)
    }

    fn field(&self) -> Field<'_> {
        Field { arrangement: &self.arrangement, buffers: &self.buffers }
    }

    /// Whether the ground's shader can show what is not drawn of the rocks.
    pub(crate) fn is_repeated(&self) -> bool {
        self.is_repeated
    }

    /// The top of the highest rock, px: deeper none sinks.
    pub(crate) fn highest(&self) -> f32 {
        self.high.z
    }

    /// All rocks, with all of their triangles.
    pub(crate) fn whole(&self) -> Vec<Range<u32>> {
        self.arrangement.all(0.0, false)
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

fn id_at(list: &[u32], at: usize) -> u32 {
    list.get(at).copied().unwrap_or(u32::MAX)
}
