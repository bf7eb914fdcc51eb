//! All bindings and all pipelines, in this one file.
//!
//! | group | how often | bindings |
//! |---|---|---|
//! | 0 `frame` | frame and view | 0 `Globals` |
//! | 1 `field` | field | 0 `FieldUniforms` |
//! | 2 `maps` | field | 0 shadow map, 1 its comparison sampler, 2 height map, 3 its sampler, 4 shadow map, 5 its sampler, 6 sky, 7 its sampler, 8 and 9 more shadow maps of a still, 10 hills, 11 what the ground sees of the sky |
//! | 3 `patterns` | device | 0 volume of noise, 1 plane of noise, 2 lattice of points, 3 the sampler of the first two |
//! | 2 `vertices` | field | 2 height map, 3 its sampler, 12 positions, 13 normals, 14 colours of some vertices, as textures |
//! | 2 `still` | sample | 0 mean of the samples, 1 the newest one |

use std::cell::{OnceCell, RefCell};

use super::pass::{Depth, Maker, Pass, Sides, Target};
use super::patterns;
use super::surface::Kind;
use crate::shading::shaders::{self, Shader};
use crate::shading::{FieldUniforms, Globals, Recipe, Sort};

/// Position, three f32.
const POSITION: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 12,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
};

/// Colour, four sRGB bytes.
const COLOR: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 4,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![1 => Unorm8x4],
};

/// Normal, octahedral.
const NORMAL: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 4,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![2 => Snorm16x2],
};

/// What a vertex sees of the sky, as `open_rock.wgsl` writes it.
const OPEN: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 4,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![3 => Unorm8x4],
};

/// Bytes per vertex of an atlas: its place, texels, and its tangent.
pub(crate) const ATLAS_STRIDE: u64 = 20;

const ATLAS: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: ATLAS_STRIDE,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![3 => Float32x2, 4 => Float32x3],
};

/// Bytes per vertex of a plan's fills: x, y, colour.
pub(crate) const FILL_STRIDE: u64 = 12;

const FILL: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: FILL_STRIDE,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Unorm8x4],
};

/// Bytes per stroke: both ends, colour, width and cell size.
pub(crate) const STROKE_STRIDE: u64 = 28;

const STROKE: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: STROKE_STRIDE,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Unorm8x4, 2 => Float32x2],
};

/// All pipelines, each made when it is first used: linking a program takes WebGL2 tens of milliseconds.
pub(crate) struct Pipelines {
    pub(crate) frame_layout: wgpu::BindGroupLayout,
    pub(crate) field_layout: wgpu::BindGroupLayout,
    pub(crate) maps_layout: wgpu::BindGroupLayout,
    patterns_layout: wgpu::BindGroupLayout,
    patterns: OnceCell<wgpu::BindGroup>,
    pub(crate) still_layout: wgpu::BindGroupLayout,
    pub(crate) vertices_layout: wgpu::BindGroupLayout,
    maker: Maker,
    fixed: [OnceCell<wgpu::RenderPipeline>; FIXED],
    natural: RefCell<Vec<(Natural, Recipe, wgpu::RenderPipeline)>>,
}

impl Pipelines {
    /// None yet.
    pub(crate) fn new(device: &wgpu::Device, kind: Kind) -> Self {
        let frame_layout = uniform_layout::<Globals>(device, "rock-field/layout/frame");
        let field_layout = uniform_layout::<FieldUniforms>(device, "rock-field/layout/field");
        let maps_layout = maps_layout(device);
        let patterns_layout = patterns_layout(device);
        let still_layout = still_layout(device);
        let vertices_layout = vertices_layout(device);
        let layouts = [&frame_layout, &field_layout, &maps_layout, &patterns_layout, &still_layout, &vertices_layout];
        let maker = Maker::new(layouts.map(Clone::clone), kind);
        Self {
            frame_layout,
            field_layout,
            maps_layout,
            patterns_layout,
            patterns: OnceCell::new(),
            still_layout,
            vertices_layout,
            fixed: [const { OnceCell::new() }; FIXED],
            natural: RefCell::default(),
            maker,
        }
    }

    /// The pipeline of a pass that is the same in every picture.
    pub(crate) fn fixed(&self, device: &wgpu::Device, what: Fixed) -> &wgpu::RenderPipeline {
        self.fixed[what as usize].get_or_init(|| self.maker.make(device, what.pass()))
    }

    /// Makes the pipeline of a pass that is the same in every picture, or first its shader: either takes long. False if both were there.
    pub(crate) fn makes_fixed(&self, device: &wgpu::Device, what: Fixed) -> bool {
        self.makes_shader(device, what.pass().shader) || self.makes(|| _ = self.fixed(device, what))
    }

    /// The same of a pass in natural colours.
    pub(crate) fn makes_natural(&self, device: &wgpu::Device, what: Natural, recipe: Recipe) -> bool {
        self.makes_shader(device, what.pass(recipe.sort()).shader)
            || self.makes(|| _ = self.natural(device, what, recipe))
    }

    fn makes_shader(&self, device: &wgpu::Device, shader: Shader) -> bool {
        self.makes(|| _ = self.maker.module(device, shader))
    }

    /// Whether this made anything.
    fn makes(&self, make: impl FnOnce()) -> bool {
        let before = self.maker.made();
        make();
        self.maker.made() > before
    }

    /// The textures that all passes in natural colours share. They are made when the first of these passes is drawn.
    pub(crate) fn patterns(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> &wgpu::BindGroup {
        self.patterns.get_or_init(|| patterns::group(device, queue, &self.patterns_layout))
    }

    /// Makes the patterns. False if they were there.
    pub(crate) fn makes_patterns(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> bool {
        let is_new = self.patterns.get().is_none();
        self.patterns(device, queue);
        is_new
    }

    /// The pipeline of a pass in natural colours that is made for `recipe`.
    pub(crate) fn natural(&self, device: &wgpu::Device, what: Natural, recipe: Recipe) -> wgpu::RenderPipeline {
        let mut made = self.natural.borrow_mut();
        let known = made.iter().find(|(other, its, _)| (*other, *its) == (what, recipe));
        known.map(|(.., pipeline)| pipeline.clone()).unwrap_or_else(|| {
            let sort = recipe.sort();
            let mut pass = Pass { recipe: Some(recipe), ..what.pass(sort) };
            match sort {
                Sort::Frame => {}
                Sort::Rough => pass.target = Target::Rough,
                Sort::Sample => pass.target = Target::Sample,
            }
            let pipeline = self.maker.make(device, pass);
            made.push((what, recipe, pipeline.clone()));
            pipeline
        })
    }
}

/// A pass that is the same in every picture.
#[derive(Clone, Copy)]
pub(crate) enum Fixed {
    Shadow,
    Height,
    /// What the ground sees of the sky, which natural colours read.
    Open,
    /// The same of the rocks' vertices.
    OpenRocks,
    /// The backdrop and the ground in the papers' style.
    Ground,
    /// The ground's depth in the papers' style, for scenes that extend below it.
    Floor,
    /// The outsides of rocks in the papers' style, then their insides.
    ///
    /// At the outline of a rock, a front face and the hidden face behind it share an edge, and with it their depth. Drawn together, specks of the
    /// hidden face would show along the ridges. Insides are therefore drawn second, and pushed back.
    Outsides,
    Insides,
    /// A log and wood ears in the papers' style: both alike, matte.
    Wood,
    /// Rocks in the wireframe: the fill, pushed back, and the edges.
    WireFill,
    WireEdges,
    /// The same of a log and wood ears.
    WoodFill,
    WoodEdges,
    /// Plans.
    PlanFills,
    PlanStrokes,
    /// The ground's depth before anything else in natural colours: what it hides is not shaded. For a picture, a rough one and a sample.
    FrameFloor,
    RoughFloor,
    SampleFloor,
    /// Adds a sample of a still to the mean.
    Gather,
    /// Makes a picture of the mean.
    Develop,
}

const FIXED: usize = Fixed::Develop as usize + 1;

impl Fixed {
    /// The ground's depth in natural colours.
    pub(crate) fn floor(sort: Sort) -> Self {
        match sort {
            Sort::Frame => Self::FrameFloor,
            Sort::Rough => Self::RoughFloor,
            Sort::Sample => Self::SampleFloor,
        }
    }

    fn pass(self) -> Pass<'static> {
        let view = |blend| Target::View { blend };
        let plain = |shader, target| Pass { shader, ..floor_pass(Depth::Ignore, target) };
        let edges = |shader| Pass {
            shader,
            topology: wgpu::PrimitiveTopology::LineList,
            ..rock_pass(Sides::Both, Depth::Test)
        };
        match self {
            Self::Shadow => map_pass(shaders::SHADOW, Target::Shadow),
            Self::Height => map_pass(shaders::HEIGHT, Target::Height),
            Self::Open => plain(shaders::OPEN, Target::Open),
            Self::OpenRocks => plain(shaders::OPEN_ROCK, Target::Open),
            Self::Ground => plain(shaders::GROUND, view(false)),
            Self::Floor => floor_pass(Depth::TestJustBehind, Target::ViewDepth),
            Self::Outsides => rock_pass(Sides::Out, Depth::Test),
            Self::Insides => rock_pass(Sides::In, Depth::TestBehind),
            Self::Wood => wood_pass(shaders::PLAIN_WOOD, Depth::Test),
            Self::WireFill => rock_pass(Sides::Both, Depth::TestBehind),
            Self::WireEdges => edges(shaders::WIRE),
            Self::WoodFill => wood_pass(shaders::PLAIN_WOOD, Depth::TestBehind),
            Self::WoodEdges => edges(shaders::WOOD_WIRE),
            Self::PlanFills => {
                Pass { shader: shaders::PLAN, buffers: &[Some(FILL)], ..floor_pass(Depth::Ignore, view(false)) }
            }
            Self::PlanStrokes => Pass {
                shader: shaders::STROKE,
                buffers: &[Some(STROKE)],
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..floor_pass(Depth::Ignore, view(true))
            },
            Self::FrameFloor => floor_pass(natural_floor(Sort::Frame), Target::ViewDepth),
            Self::RoughFloor => floor_pass(natural_floor(Sort::Rough), Target::RoughDepth),
            Self::SampleFloor => floor_pass(natural_floor(Sort::Sample), Target::SampleDepth),
            Self::Gather => plain(shaders::GATHER, Target::Mean),
            Self::Develop => plain(shaders::DEVELOP, Target::Image),
        }
    }
}

/// A pass in natural colours.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Natural {
    /// The outsides of rocks.
    Rocks,
    /// Their insides, which are seen only if a rock is turned inside out. They are pushed back, as in the papers' style.
    Insides,
    /// The backdrop and the ground.
    Ground,
    Log,
    /// Wood ears that are single sheets.
    Sheets,
    /// Wood ears that are closed bodies. Their far faces would show as specks along their rims, as those of a rock would.
    Bodies,
    /// The rocks' surface, spread out as an atlas has it.
    Bake,
}

/// The ground is pushed behind the rims of the rocks, many of which lie exactly in its plane. In a picture that is half a pixel: so far what lies
/// lower than the ground is seen around the foot of each rock. In samples a rim that comes and goes is as it should be on the mean.
fn natural_floor(sort: Sort) -> Depth {
    if sort == Sort::Sample { Depth::Test } else { Depth::TestJustBehind }
}

impl Natural {
    fn pass(self, sort: Sort) -> Pass<'static> {
        let body = |shader, sides| Pass { sides, ..wood_pass(shader, Depth::Test) };
        let rocks = |sides| Pass {
            buffers: &[Some(POSITION), Some(COLOR), Some(NORMAL), Some(OPEN)],
            ..body(shaders::NATURAL_ROCK, sides)
        };
        match self {
            Self::Rocks => rocks(Sides::Out),
            Self::Insides => Pass { depth: Depth::TestBehind, ..rocks(Sides::In) },
            Self::Log => body(shaders::LOG, Sides::Both),
            Self::Sheets => body(shaders::EAR, Sides::Both),
            Self::Bodies => body(shaders::EAR, Sides::Out),
            Self::Ground => Pass { buffers: &[], ..wood_pass(shaders::NATURAL_GROUND, natural_floor(sort)) },
            Self::Bake => Pass {
                buffers: &[Some(POSITION), Some(COLOR), Some(NORMAL), None, Some(ATLAS)],
                target: Target::Bake,
                ..wood_pass(shaders::BAKE, Depth::Ignore)
            },
        }
    }
}

fn floor_pass(depth: Depth, target: Target) -> Pass<'static> {
    Pass {
        shader: shaders::FLOOR,
        buffers: &[],
        topology: wgpu::PrimitiveTopology::TriangleList,
        sides: Sides::Both,
        depth,
        target,
        recipe: None,
    }
}

/// Both sides are drawn, since c_w turns some rocks inside out.
fn map_pass(shader: Shader, target: Target) -> Pass<'static> {
    Pass { shader, target, ..rock_pass(Sides::Both, Depth::Test) }
}

fn rock_pass(sides: Sides, depth: Depth) -> Pass<'static> {
    Pass {
        shader: shaders::ROCK,
        buffers: &[Some(POSITION), Some(COLOR)],
        topology: wgpu::PrimitiveTopology::TriangleList,
        sides,
        depth,
        target: Target::View { blend: false },
        recipe: None,
    }
}

/// Both sides are drawn, because a wood ear may be a single sheet.
fn wood_pass(shader: Shader, depth: Depth) -> Pass<'static> {
    Pass {
        shader,
        buffers: &[Some(POSITION), Some(COLOR), Some(NORMAL)],
        topology: wgpu::PrimitiveTopology::TriangleList,
        sides: Sides::Both,
        depth,
        target: Target::View { blend: false },
        recipe: None,
    }
}

fn uniform_layout<T>(device: &wgpu::Device, label: &'static str) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: wgpu::BufferSize::new(size_of::<T>() as u64),
            },
            count: None,
        }],
    })
}

fn maps_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use wgpu::TextureSampleType::{Depth, Float};
    let texture = |sample_type| texture(sample_type, wgpu::TextureViewDimension::D2);
    let sampler = wgpu::BindingType::Sampler;
    // Rocks ask how much of the sky they see where their vertices are.
    layout(
        device,
        "rock-field/layout/maps",
        wgpu::ShaderStages::VERTEX_FRAGMENT,
        numbered(&[
            texture(Depth),
            sampler(wgpu::SamplerBindingType::Comparison),
            texture(Float { filterable: true }),
            sampler(wgpu::SamplerBindingType::Filtering),
            texture(Float { filterable: false }),
            sampler(wgpu::SamplerBindingType::NonFiltering),
            texture(Float { filterable: true }),
            sampler(wgpu::SamplerBindingType::Filtering),
            texture(Depth),
            texture(Depth),
            texture(Float { filterable: true }),
            texture(Float { filterable: true }),
        ]),
    )
}

fn patterns_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use wgpu::TextureViewDimension::{D2, D3};
    let texture = |dimension| texture(wgpu::TextureSampleType::Float { filterable: true }, dimension);
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    // Rocks of copies ask where moss grows at their vertices.
    let types = [texture(D3), texture(D2), texture(D3), sampler];
    layout(device, "rock-field/layout/patterns", wgpu::ShaderStages::VERTEX_FRAGMENT, numbered(&types))
}

fn texture(sample_type: wgpu::TextureSampleType, view_dimension: wgpu::TextureViewDimension) -> wgpu::BindingType {
    wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false }
}

/// A layout of what fragment shaders read, in the order of its bindings.
fn fragment_layout(device: &wgpu::Device, label: &str, types: &[wgpu::BindingType]) -> wgpu::BindGroupLayout {
    layout(device, label, wgpu::ShaderStages::FRAGMENT, numbered(types))
}

fn numbered(types: &[wgpu::BindingType]) -> impl Iterator<Item = (u32, wgpu::BindingType)> {
    (0..).zip(types.iter().copied())
}

fn layout(
    device: &wgpu::Device,
    label: &str,
    visibility: wgpu::ShaderStages,
    types: impl IntoIterator<Item = (u32, wgpu::BindingType)>,
) -> wgpu::BindGroupLayout {
    let entry = |(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let entries: Vec<_> = types.into_iter().map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

fn still_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let texture = texture(wgpu::TextureSampleType::Float { filterable: false }, wgpu::TextureViewDimension::D2);
    fragment_layout(device, "rock-field/layout/still", &[texture, texture])
}

fn vertices_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use wgpu::TextureSampleType::{Float, Uint};
    let texture = |sample_type| texture(sample_type, wgpu::TextureViewDimension::D2);
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let vertices = [12, 13, 14].map(|binding| (binding, texture(Uint)));
    let types = [(2, texture(Float { filterable: true })), (3, sampler)].into_iter().chain(vertices);
    layout(device, "rock-field/layout/vertices", wgpu::ShaderStages::FRAGMENT, types)
}
