//! All bindings and all pipelines, in this one file.
//!
//! | group | how often | bindings |
//! |---|---|---|
//! | 0 `frame` | frame and view | 0 `Globals` |
//! | 1 `field` | field | 0 `FieldUniforms` |
//! | 2 `maps` | field | 0 shadow map, 1 its comparison sampler, 2 height map, 3 its sampler, 4 shadow map, 5 its sampler |

use std::cell::OnceCell;

use super::pass::{Depth, Pass, Sides, Target, pipeline};
use super::surface::Kind;
use crate::shading::shaders::{self, Shader};
use crate::shading::{FieldUniforms, Globals};

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

/// All pipelines. Those that not every visit needs are made when they are first used, because linking a program takes
/// WebGL2 tens of milliseconds.
pub(crate) struct Pipelines {
    pub(crate) frame_layout: wgpu::BindGroupLayout,
    pub(crate) field_layout: wgpu::BindGroupLayout,
    pub(crate) maps_layout: wgpu::BindGroupLayout,
    kind: Kind,
    pub(crate) shadow: wgpu::RenderPipeline,
    pub(crate) height: wgpu::RenderPipeline,
    pub(crate) ground: wgpu::RenderPipeline,
    floor: OnceCell<wgpu::RenderPipeline>,
    /// For outsides, then for insides.
    pub(crate) rock: [wgpu::RenderPipeline; 2],
    natural: OnceCell<[wgpu::RenderPipeline; 4]>,
    bake: OnceCell<wgpu::RenderPipeline>,
    log: OnceCell<wgpu::RenderPipeline>,
    /// For single sheets, then for closed bodies.
    ears: [OnceCell<wgpu::RenderPipeline>; 2],
    plain_wood: OnceCell<wgpu::RenderPipeline>,
    wire: OnceCell<[wgpu::RenderPipeline; 2]>,
    wood_wire: OnceCell<[wgpu::RenderPipeline; 2]>,
    plan: OnceCell<[wgpu::RenderPipeline; 2]>,
}

impl Pipelines {
    pub(crate) fn new(device: &wgpu::Device, kind: Kind) -> Self {
        let frame_layout = uniform_layout::<Globals>(device, "rock-field/layout/frame");
        let field_layout = uniform_layout::<FieldUniforms>(device, "rock-field/layout/field");
        let maps_layout = maps_layout(device);
        let layouts = [&frame_layout, &field_layout, &maps_layout];
        let make = |pass| pipeline(device, layouts, kind, pass);
        let shadow = make(Pass {
            shader: shaders::SHADOW,
            buffers: &[Some(POSITION), Some(COLOR)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            sides: Sides::Both,
            depth: Depth::Test,
            target: Target::Shadow,
        });
        let height = make(Pass {
            shader: shaders::HEIGHT,
            buffers: &[Some(POSITION), Some(COLOR)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            sides: Sides::Both,
            depth: Depth::Test,
            target: Target::Height,
        });
        let ground = make(Pass {
            shader: shaders::GROUND,
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            sides: Sides::Both,
            depth: Depth::Ignore,
            target: Target::View { blend: false },
        });
        // At the outline of a rock, a front face and the hidden face behind it share an edge, and with it their depth.
        // Drawn together, specks of the hidden face would show along the ridges. Insides are therefore drawn second,
        // and pushed back.
        let rock = [make(rock_pass(Sides::Out, Depth::Test)), make(rock_pass(Sides::In, Depth::TestBehind))];
        Self {
            frame_layout,
            field_layout,
            maps_layout,
            kind,
            shadow,
            height,
            ground,
            floor: OnceCell::new(),
            rock,
            natural: OnceCell::new(),
            bake: OnceCell::new(),
            log: OnceCell::new(),
            ears: [OnceCell::new(), OnceCell::new()],
            plain_wood: OnceCell::new(),
            wire: OnceCell::new(),
            wood_wire: OnceCell::new(),
            plan: OnceCell::new(),
        }
    }

    fn make(&self, device: &wgpu::Device, pass: Pass<'_>) -> wgpu::RenderPipeline {
        let layouts = [&self.frame_layout, &self.field_layout, &self.maps_layout];
        pipeline(device, layouts, self.kind, pass)
    }

    /// Draws the ground's depth in the papers' style, for scenes that extend below it.
    pub(crate) fn floor(&self, device: &wgpu::Device) -> &wgpu::RenderPipeline {
        self.floor.get_or_init(|| {
            let floor = Pass {
                shader: shaders::FLOOR,
                buffers: &[],
                topology: wgpu::PrimitiveTopology::TriangleList,
                sides: Sides::Both,
                depth: Depth::TestJustBehind,
                target: Target::ViewDepth,
            };
            self.make(device, floor)
        })
    }

    /// Pipelines for natural colours: outsides of the rocks; insides; both at once, for half the vertices; and the
    /// ground, pushed back.
    pub(crate) fn natural(&self, device: &wgpu::Device) -> &[wgpu::RenderPipeline; 4] {
        self.natural.get_or_init(|| {
            let rock = |sides, depth| Pass {
                shader: shaders::NATURAL_ROCK,
                buffers: &[Some(POSITION), Some(COLOR), Some(NORMAL)],
                topology: wgpu::PrimitiveTopology::TriangleList,
                sides,
                depth,
                target: Target::View { blend: false },
            };
            // Pushed behind the rims of the rocks, many of which lie exactly in the ground's plane.
            let ground = Pass {
                shader: shaders::NATURAL_GROUND,
                buffers: &[],
                topology: wgpu::PrimitiveTopology::TriangleList,
                sides: Sides::Both,
                depth: Depth::TestBehind,
                target: Target::View { blend: false },
            };
            let passes = [
                rock(Sides::Out, Depth::Test),
                rock(Sides::In, Depth::TestBehind),
                rock(Sides::Both, Depth::Test),
                ground,
            ];
            passes.map(|pass| self.make(device, pass))
        })
    }

    /// Pipeline for the rocks' surface, spread out as an atlas has it.
    pub(crate) fn bake(&self, device: &wgpu::Device) -> &wgpu::RenderPipeline {
        self.bake.get_or_init(|| {
            let bake = Pass {
                shader: shaders::BAKE,
                buffers: &[Some(POSITION), Some(COLOR), Some(NORMAL), Some(ATLAS)],
                topology: wgpu::PrimitiveTopology::TriangleList,
                sides: Sides::Both,
                depth: Depth::Ignore,
                target: Target::Bake,
            };
            self.make(device, bake)
        })
    }

    /// Pipelines for a log and for wood ears in natural colours. Wood ears are either closed bodies or single sheets.
    pub(crate) fn wood(&self, device: &wgpu::Device, closed: bool) -> [&wgpu::RenderPipeline; 2] {
        let make = |shader, sides| self.make(device, Pass { sides, ..wood_pass(shader, Depth::Test) });
        let [sheets, bodies] = &self.ears;
        let log = self.log.get_or_init(|| make(shaders::LOG, Sides::Both));
        // The far faces of a closed body would show as specks along its rim, as those of a rock would.
        let (ears, sides) = if closed { (bodies, Sides::Out) } else { (sheets, Sides::Both) };
        [log, ears.get_or_init(|| make(shaders::EAR, sides))]
    }

    /// Pipeline for a log and wood ears in the papers' style: both alike, matte.
    pub(crate) fn plain_wood(&self, device: &wgpu::Device) -> &wgpu::RenderPipeline {
        self.plain_wood.get_or_init(|| self.make(device, wood_pass(shaders::PLAIN_WOOD, Depth::Test)))
    }

    /// Pipelines for a log and wood ears in the wireframe: the fill, pushed back, and the edges.
    pub(crate) fn wood_wire(&self, device: &wgpu::Device) -> &[wgpu::RenderPipeline; 2] {
        self.wood_wire.get_or_init(|| {
            let edges = Pass {
                shader: shaders::WOOD_WIRE,
                topology: wgpu::PrimitiveTopology::LineList,
                buffers: &[Some(POSITION), Some(COLOR)],
                ..wood_pass(shaders::PLAIN_WOOD, Depth::Test)
            };
            [self.make(device, wood_pass(shaders::PLAIN_WOOD, Depth::TestBehind)), self.make(device, edges)]
        })
    }

    /// Pipelines for rocks in the wireframe: the fill, pushed back, and the edges.
    pub(crate) fn wire(&self, device: &wgpu::Device) -> &[wgpu::RenderPipeline; 2] {
        self.wire.get_or_init(|| {
            let edges = Pass {
                shader: shaders::WIRE,
                buffers: &[Some(POSITION), Some(COLOR)],
                topology: wgpu::PrimitiveTopology::LineList,
                sides: Sides::Both,
                depth: Depth::Test,
                target: Target::View { blend: false },
            };
            [self.make(device, rock_pass(Sides::Both, Depth::TestBehind)), self.make(device, edges)]
        })
    }

    /// Pipelines for plans: fills and strokes.
    pub(crate) fn plan(&self, device: &wgpu::Device) -> &[wgpu::RenderPipeline; 2] {
        self.plan.get_or_init(|| {
            let fills = Pass {
                shader: shaders::PLAN,
                buffers: &[Some(FILL)],
                topology: wgpu::PrimitiveTopology::TriangleList,
                sides: Sides::Both,
                depth: Depth::Ignore,
                target: Target::View { blend: false },
            };
            let strokes = Pass {
                shader: shaders::STROKE,
                buffers: &[Some(STROKE)],
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                sides: Sides::Both,
                depth: Depth::Ignore,
                target: Target::View { blend: true },
            };
            [self.make(device, fills), self.make(device, strokes)]
        })
    }
}

fn rock_pass(sides: Sides, depth: Depth) -> Pass<'static> {
    Pass {
        shader: shaders::ROCK,
        buffers: &[Some(POSITION), Some(COLOR)],
        topology: wgpu::PrimitiveTopology::TriangleList,
        sides,
        depth,
        target: Target::View { blend: false },
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
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let texture = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = |kind| wgpu::BindingType::Sampler(kind);
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("rock-field/layout/maps"),
        entries: &[
            entry(0, texture(wgpu::TextureSampleType::Depth)),
            entry(1, sampler(wgpu::SamplerBindingType::Comparison)),
            entry(2, texture(wgpu::TextureSampleType::Float { filterable: true })),
            entry(3, sampler(wgpu::SamplerBindingType::Filtering)),
            entry(4, texture(wgpu::TextureSampleType::Float { filterable: false })),
            entry(5, sampler(wgpu::SamplerBindingType::NonFiltering)),
        ],
    })
}
