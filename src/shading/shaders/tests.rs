//! The shaders without a GPU: they parse, they validate, they keep the rules that old devices impose, and their uniform
//! blocks are as large as ours.

use std::path::PathBuf;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Binding, Expression, Module, ShaderStage, TypeInner};

use super::super::uniforms;
use super::{ALL, Shader};

#[path = "../../../build.rs"]
#[allow(dead_code, reason = "what only cargo runs")]
mod build;

fn module(shader: Shader) -> Module {
    parsed(shader.name, &shader.code())
}

pub(super) fn parsed(name: &str, source: &str) -> Module {
    let parsed = naga::front::wgsl::parse_str(source);
    parsed.unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)))
}

/// No capability beyond plain WebGPU.
pub(super) fn validate(name: &str, module: &Module) -> ModuleInfo {
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(module)
        .unwrap_or_else(|error| panic!("{name}: {error:?}"))
}

fn each(check: impl Fn(&str, &Module)) {
    for &shader in ALL {
        check(shader.name, &module(shader));
    }
}

/// Bytes and members of a named uniform struct.
fn layout(module: &Module, name: &str) -> Option<(u32, Vec<(String, u32)>)> {
    module.types.iter().find_map(|(_, ty)| match &ty.inner {
        TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => {
            let of = |member: &naga::StructMember| (member.name.clone().unwrap_or_default(), member.offset);
            Some((*span, members.iter().map(of).collect()))
        }
        _ => None,
    })
}

#[test]
fn every_shader_file_belongs_to_a_pass() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src/shading/shaders");
    let files = std::fs::read_dir(folder).expect("the shaders' folder").map(|entry| entry.expect("an entry").path());
    for path in files.filter(|path| path.extension().is_some_and(|extension| extension == "wgsl")) {
        let name = path.file_name().expect("a file");
        let built = PathBuf::from(env!("OUT_DIR")).join(name);
        let source = std::fs::read_to_string(built).expect("the shader without its comments");
        let used = source == super::PRESENT || ALL.iter().any(|shader| shader.code().contains(&source));
        assert!(used, "{} is tested by no pass", path.display());
    }
}

#[test]
fn every_pass_parses_and_validates() {
    each(|name, module| {
        validate(name, module);
    });
    // It stands alone.
    let present = naga::front::wgsl::parse_str(super::PRESENT).expect("present.wgsl");
    validate("present", &present);
}

/// What is built into wasm.
#[test]
fn shaders_with_short_names_are_the_same_to_who_uses_them() {
    let all: String = ALL.iter().map(|shader| shader.code()).collect();
    let names = build::short_names(&build::tokens(&all));
    assert!(names.len() > 300, "{}", names.len());
    each(|name, module| {
        let shader = ALL.iter().find(|shader| shader.name == name).expect("itself");
        let short = parsed(name, &build::shortened(&build::tokens(&shader.code()), &names));
        validate(name, &short);
        let used = |module: &Module| {
            let overrides = module.overrides.iter().map(|(_, constant)| constant.name.clone());
            let bindings = module.global_variables.iter().map(|(_, global)| format!("{:?}", global.binding));
            let entries = module.entry_points.iter().map(|entry| Some(entry.name.clone()));
            (overrides.chain(entries).collect::<Vec<_>>(), bindings.collect::<Vec<_>>(), functions(module).count())
        };
        assert_eq!(used(&short), used(module), "{name}");
        let offsets = |module: &Module| {
            let (span, members) = layout(module, "FieldUniforms").expect("every pass has it");
            (span, members.into_iter().map(|(_, offset)| offset).collect::<Vec<_>>())
        };
        assert_eq!(offsets(&short), offsets(module), "{name}");
    });
    let signs = build::tokens("a - -0.50 + 1.0; i--;");
    assert_eq!(build::shortened(&signs, &names), "a- -.50+1.;i--;\n");
}

#[test]
fn entry_points_have_the_house_names() {
    each(|name, module| {
        for entry in &module.entry_points {
            let expected = match entry.stage {
                ShaderStage::Vertex => "vs_main",
                _ => "fs_main",
            };
            assert_eq!(entry.name, expected, "{name}");
        }
    });
}

/// Field for field: the sizes, and that every member starts where Rust puts it.
#[test]
fn uniform_blocks_match_rust() {
    let common = module(super::SHADOW);
    let rust = [("Globals", size_of::<uniforms::Globals>()), ("FieldUniforms", size_of::<uniforms::FieldUniforms>())];
    for (name, size) in rust {
        let (span, _) = layout(&common, name).unwrap_or_else(|| panic!("{name} is missing"));
        assert_eq!(span as usize, size, "{name}");
    }
    macro_rules! offsets_match {
        ($name:ident: $($member:ident),+) => {
            let (_, members) = layout(&common, stringify!($name)).expect("checked above");
            let ours = [$((
                stringify!($member).to_string(),
                std::mem::offset_of!(uniforms::$name, $member) as u32,
            )),+];
            assert_eq!(members, ours, stringify!($name));
        };
    }
    offsets_match!(Globals: clip_from_eye, eye, ray_right, ray_up, ray_forward, plan, tile, backdrop_low, backdrop_high, soil,
        dust, weather, waters, scene, flesh);
    offsets_match!(FieldUniforms: sun_from_world, sun, map, size, ground, log, bow, sunshine, sky, sky_from_world, sky_way,
        below_from_world, below_way, shadow, shift, bricks);
}

/// WebGL2's std140 pads everything to 16 bytes: members that fill 16-byte groups lie the same in both.
#[test]
fn uniform_members_fill_groups_of_sixteen_bytes() {
    each(|name, module| {
        for (_, global) in module.global_variables.iter() {
            if global.space != AddressSpace::Uniform {
                continue;
            }
            let TypeInner::Struct { members, span } = &module.types[global.ty].inner else {
                panic!("{name}: a uniform that is no struct");
            };
            let bounds = members.iter().map(|member| member.offset).chain([*span]);
            for offset in bounds {
                assert_eq!(offset % 16, 0, "{name}: {:?}", global.name);
            }
        }
    });
}

/// WebGL2 has neither storage buffers nor storage textures nor compute.
#[test]
fn no_storage_and_no_compute() {
    each(|name, module| {
        for (_, global) in module.global_variables.iter() {
            let allowed = matches!(global.space, AddressSpace::Uniform | AddressSpace::Handle | AddressSpace::Private);
            assert!(allowed, "{name}: {:?}", global.name);
        }
        for (_, ty) in module.types.iter() {
            let storage = matches!(ty.inner, TypeInner::Image { class: naga::ImageClass::Storage { .. }, .. });
            assert!(!storage, "{name}: {:?}", ty.name);
        }
        for entry in &module.entry_points {
            assert_ne!(entry.stage, ShaderStage::Compute, "{name}");
        }
    });
}

fn functions(module: &Module) -> impl Iterator<Item = &naga::Function> {
    let helpers = module.functions.iter().map(|(_, function)| function);
    helpers.chain(module.entry_points.iter().map(|entry| &entry.function))
}

/// Some Mali and Adreno compilers spill or miscompile dynamically indexed arrays (vello's lint).
#[test]
fn no_dynamic_indexing() {
    each(|name, module| {
        for function in functions(module) {
            for (_, expression) in function.expressions.iter() {
                let dynamic = matches!(expression, Expression::Access { .. });
                assert!(!dynamic, "{name}: {:?}", function.name);
            }
        }
    });
}

/// Older Adreno drivers silently drop user structs in fragment code to 16 bits (vello's
/// `no_structs_in_fragment`). Uniforms and what a vertex shader returns are structs of the interface.
#[test]
fn fragment_code_passes_no_structs() {
    each(|name, module| {
        let is_struct = |ty: naga::Handle<naga::Type>| matches!(module.types[ty].inner, TypeInner::Struct { .. });
        let helpers = module.functions.iter().map(|(_, function)| function);
        let fragments = module
            .entry_points
            .iter()
            .filter(|entry| entry.stage == ShaderStage::Fragment)
            .map(|entry| &entry.function);
        for function in helpers.chain(fragments) {
            for argument in &function.arguments {
                assert!(!is_struct(argument.ty), "{name}: {:?}", function.name);
            }
            for (_, local) in function.local_variables.iter() {
                assert!(!is_struct(local.ty), "{name}: {:?}", function.name);
            }
            let result = function.result.as_ref();
            assert!(!result.is_some_and(|result| is_struct(result.ty)), "{name}");
        }
    });
}

/// Outside uniform control flow an implicit level of detail is undefined; we have no mip levels anyway.
#[test]
fn textures_are_sampled_at_level_zero() {
    each(|name, module| {
        for function in functions(module) {
            for (_, expression) in function.expressions.iter() {
                if let Expression::ImageSample { level, .. } = expression {
                    let explicit = matches!(level, naga::SampleLevel::Zero | naga::SampleLevel::Exact(_));
                    assert!(explicit, "{name}: {:?}", function.name);
                }
            }
        }
    });
}

/// The provoking vertex of flat interpolation differs on WebGL2.
#[test]
fn nothing_is_interpolated_flat() {
    each(|name, module| {
        for (_, ty) in module.types.iter() {
            let TypeInner::Struct { members, .. } = &ty.inner else {
                continue;
            };
            for member in members {
                let flat = matches!(
                    member.binding,
                    Some(Binding::Location { interpolation: Some(naga::Interpolation::Flat), .. })
                );
                assert!(!flat, "{name}: {:?}", member.name);
            }
        }
    });
}

/// WebGL2 has them only by emulation that some drivers get wrong.
#[test]
fn no_bit_scanning_built_ins() {
    use naga::MathFunction as F;
    let refused = [
        F::FirstLeadingBit,
        F::FirstTrailingBit,
        F::CountLeadingZeros,
        F::CountTrailingZeros,
        F::ReverseBits,
        F::ExtractBits,
        F::InsertBits,
    ];
    each(|name, module| {
        for function in functions(module) {
            for (_, expression) in function.expressions.iter() {
                if let Expression::Math { fun, .. } = expression {
                    assert!(!refused.contains(fun), "{name}: {fun:?}");
                }
            }
        }
    });
}
