//! The description of a pass, and the pipeline made from it.

use std::cell::{Cell, RefCell};

use super::surface::{DEPTH_FORMAT, Kind};
use crate::shading::Recipe;
use crate::shading::shaders::{Reads, Shader};

/// f32 has enough precision for a low sun over a wide field. It is filtered through a comparison sampler on both
/// backends.
pub(crate) const SHADOW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The papers' style reads the first byte only: 1/255 of the highest rock is enough there, since several samples are
/// averaged. Natural colours read both, because of pebbles beside boulders. The format can be filtered and rendered to
/// everywhere.
pub(crate) const HEIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;

/// Of what the ground and the rocks see of the sky (`open.wgsl`, `open_rock.wgsl`).
pub(crate) const OPEN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The eight bytes of a texel that `bake.wgsl` writes.
pub(crate) const BAKE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

/// Light, which may be brighter than white.
pub(crate) const SAMPLE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Of a mean of thousands of samples, half floats would lose what the later ones add.
pub(crate) const MEAN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Everything in which passes differ.
pub(crate) struct Pass<'a> {
    pub(crate) shader: Shader,
    pub(crate) buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    pub(crate) topology: wgpu::PrimitiveTopology,
    pub(crate) sides: Sides,
    pub(crate) depth: Depth,
    pub(crate) target: Target,
    /// Of a pass in natural colours.
    pub(crate) recipe: Option<Recipe>,
}

/// Which sides of a face are drawn. In the papers' style rocks need both, because c_w may turn them inside out.
pub(crate) enum Sides {
    Both,
    Out,
    In,
}

pub(crate) enum Depth {
    /// Depth is neither read nor written.
    Ignore,
    Test,
    /// Like `Test`, but pushed back, so that lines on the same faces are in front.
    TestBehind,
    /// Like `Test`, but pushed back by half a pixel, so that what ends in the same plane is in front.
    TestJustBehind,
}

pub(crate) enum Target {
    View {
        blend: bool,
    },
    /// Only the depth of the view.
    ViewDepth,
    /// As the two before, with one sample a pixel.
    Rough,
    RoughDepth,
    Shadow,
    Height,
    /// What the ground or the rocks see of the sky, without depth.
    Open,
    /// A sample of a still.
    Sample,
    /// Only its depth.
    SampleDepth,
    /// The mean of a still's samples, without depth.
    Mean,
    /// A picture out of sight, without depth, over what is in it.
    Image,
    /// A tile of an atlas, without depth.
    Bake,
}

/// Makes pipelines.
pub(crate) struct Maker {
    /// Of the groups frame, field, maps, patterns, still and vertices.
    layouts: [wgpu::BindGroupLayout; 6],
    kind: Kind,
    /// The shaders that were needed until now, by their passes' names: several pipelines have the same.
    modules: RefCell<Vec<(&'static str, wgpu::ShaderModule)>>,
    /// How many shaders and pipelines were made.
    made: Cell<u32>,
}

impl Maker {
    pub(crate) fn new(layouts: [wgpu::BindGroupLayout; 6], kind: Kind) -> Self {
        Self { layouts, kind, modules: RefCell::default(), made: Cell::default() }
    }

    pub(crate) fn made(&self) -> u32 {
        self.made.get()
    }

    pub(crate) fn make(&self, device: &wgpu::Device, pass: Pass<'_>) -> wgpu::RenderPipeline {
        let module = self.module(device, pass.shader);
        self.made.set(self.made.get() + 1);
        pipeline(device, &module, &self.layouts, self.kind, pass)
    }

    /// The shader, which is made if it is not there.
    pub(crate) fn module(&self, device: &wgpu::Device, shader: Shader) -> wgpu::ShaderModule {
        let mut modules = self.modules.borrow_mut();
        let known = modules.iter().find(|(name, _)| *name == shader.name());
        known.map(|(_, module)| module.clone()).unwrap_or_else(|| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(&shader.label()),
                source: wgpu::ShaderSource::Wgsl(shader.code().into()),
            });
            self.made.set(self.made.get() + 1);
            modules.push((shader.name(), module.clone()));
            module
        })
    }
}

/// The layouts of the groups that a pass reads, of all `layouts`.
fn groups_of(
    reads: Reads,
    [frame, field, maps, patterns, still, vertices]: &[wgpu::BindGroupLayout; 6],
) -> Vec<Option<&wgpu::BindGroupLayout>> {
    let groups: &[_] = match reads {
        Reads::Uniforms => &[frame, field],
        Reads::Maps => &[frame, field, maps],
        Reads::Patterns => &[frame, field, maps, patterns],
        Reads::Vertices => &[frame, field, vertices, patterns],
        Reads::Still => &[frame, field, still],
    };
    groups.iter().copied().map(Some).collect()
}

/// Makes the pipeline of a pass, whose shader is `module`, with the groups that the pass reads.
fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layouts: &[wgpu::BindGroupLayout; 6],
    Kind { format, samples }: Kind,
    pass: Pass<'_>,
) -> wgpu::RenderPipeline {
    let label = pass.shader.label();
    let label = Some(label.as_str());
    let groups = groups_of(pass.shader.reads(), layouts);
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    let recipe = pass.recipe.map(Recipe::constants);
    let mut constants: Vec<_> = recipe.iter().flatten().copied().collect();
    let color = |format, blend, write_mask| Some(wgpu::ColorTargetState { format, blend, write_mask });
    let all = wgpu::ColorWrites::ALL;
    if matches!(pass.target, Target::View { .. } | Target::Rough | Target::Image) {
        constants.push(("target_is_srgb", if format.is_srgb() { 1.0 } else { 0.0 }));
    }
    let (targets, depth_format, count) = match pass.target {
        Target::View { .. } | Target::Rough => {
            let blend = matches!(pass.target, Target::View { blend: true }).then_some(wgpu::BlendState::ALPHA_BLENDING);
            let samples = if matches!(pass.target, Target::Rough) { 1 } else { samples };
            (Some(color(format, blend, all)), Some(DEPTH_FORMAT), samples)
        }
        Target::ViewDepth => (Some(color(format, None, wgpu::ColorWrites::empty())), Some(DEPTH_FORMAT), samples),
        Target::RoughDepth => (Some(color(format, None, wgpu::ColorWrites::empty())), Some(DEPTH_FORMAT), 1),
        Target::Shadow => (None, Some(SHADOW_FORMAT), 1),
        Target::Height => (Some(color(HEIGHT_FORMAT, None, all)), Some(SHADOW_FORMAT), 1),
        Target::Open => (Some(color(OPEN_FORMAT, None, all)), None, 1),
        Target::Sample => (Some(color(SAMPLE_FORMAT, None, all)), Some(DEPTH_FORMAT), 1),
        Target::SampleDepth => (Some(color(SAMPLE_FORMAT, None, wgpu::ColorWrites::empty())), Some(DEPTH_FORMAT), 1),
        Target::Mean => (Some(color(MEAN_FORMAT, None, all)), None, 1),
        Target::Image => (Some(color(format, Some(wgpu::BlendState::ALPHA_BLENDING), all)), None, 1),
        Target::Bake => (Some(color(BAKE_FORMAT, None, all)), None, 1),
    };
    let (depth_compare, depth_write, bias, slope_scale) = match pass.depth {
        Depth::Ignore => (wgpu::CompareFunction::Always, false, 0, 0.0),
        Depth::Test => (wgpu::CompareFunction::LessEqual, true, 0, 0.0),
        Depth::TestBehind => (wgpu::CompareFunction::LessEqual, true, 2, 1.5),
        Depth::TestJustBehind => (wgpu::CompareFunction::LessEqual, true, 2, 0.5),
    };
    let compilation = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vs_main"),
            compilation_options: compilation.clone(),
            buffers: pass.buffers,
        },
        primitive: wgpu::PrimitiveState {
            topology: pass.topology,
            cull_mode: match pass.sides {
                Sides::Both => None,
                Sides::Out => Some(wgpu::Face::Back),
                Sides::In => Some(wgpu::Face::Front),
            },
            ..Default::default()
        },
        depth_stencil: depth_format.map(|format| wgpu::DepthStencilState {
            format,
            depth_write_enabled: Some(depth_write),
            depth_compare: Some(depth_compare),
            stencil: Default::default(),
            bias: wgpu::DepthBiasState { constant: bias, slope_scale, clamp: 0.0 },
        }),
        multisample: wgpu::MultisampleState { count, ..Default::default() },
        fragment: targets.as_ref().map(|target| wgpu::FragmentState {
            module,
            entry_point: Some("fs_main"),
            compilation_options: compilation,
            targets: std::slice::from_ref(target),
        }),
        multiview_mask: None,
        cache: None,
    })
}
