//! The complete shader of every pipeline, with its constants put in, for compilers that know nothing of wgpu.
//! `npm run bench -- --shaders DIR` runs this test to have them written.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::super::recipe::{Recipe, Sort};
use super::super::{Look, Quality};
use super::{ALL, NATURAL_GROUND, RECIPE, Shader, tests};

/// Names the folder to write to.
const FOLDER: &str = "ROCK_FIELD_SHADERS";

const QUALITIES: [(&str, Quality); 3] = [("low", Quality::Low), ("medium", Quality::Medium), ("high", Quality::High)];

const GROUNDS: [&str; 3] = ["soil", "sand", "gravel"];

/// The code of each file, by its name without the ending.
fn files() -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for &shader in ALL {
        if !shader.before.contains(&RECIPE) {
            files.insert(shader.name.to_string(), with_constants(shader, &[]));
            continue;
        }
        for (level, quality) in QUALITIES {
            for (kind, recipe) in recipes(shader, quality) {
                files.insert(format!("{}{kind}-{level}", shader.name), with_constants(shader, &recipe.constants()));
            }
        }
    }
    files
}

/// The recipes that a pass is written for, with what is added to its name: with moss and water, with neither, with snow and a lake, and for the
/// samples of a still.
fn recipes(shader: Shader, quality: Quality) -> Vec<(String, Recipe)> {
    let dry = Look { weather: [0.5, 0.0, 0.0, 0.2], ..Look::default() };
    let mossy = Look { weather: [0.5, 0.4, 0.4, 0.2], ..Look::default() };
    let snowy = Look { snow: 0.5, water: 0.3, ..dry.clone() };
    if shader.name != NATURAL_GROUND.name {
        return vec![
            (String::new(), Recipe::of_bodies(quality, &mossy)),
            ("-dry".into(), Recipe::of_bodies(quality, &dry)),
            ("-snow".into(), Recipe::of_bodies(quality, &snowy)),
            ("-sampled".into(), Recipe::of_bodies(quality, &mossy).of(Sort::Sample)),
        ];
    }
    let mut recipes = Vec::new();
    for (ground, name) in (0_u8..).zip(GROUNDS) {
        for (look, weather) in [(&mossy, ""), (&dry, "-dry"), (&snowy, "-snow")] {
            let look = Look { ground: f32::from(ground), ..look.clone() };
            recipes.push((format!("-{name}{weather}"), Recipe::of_ground(quality, &look, false)));
            recipes.push((format!("-{name}{weather}-log"), Recipe::of_ground(quality, &look, true)));
            recipes
                .push((format!("-{name}{weather}-sampled"), Recipe::of_ground(quality, &look, false).of(Sort::Sample)));
        }
    }
    recipes
}

/// The code of a pass in which the overrides are constants: those that are not given have their defaults.
fn with_constants(shader: Shader, constants: &[(&str, f64)]) -> String {
    let line = |line: &str| {
        let Some((declared, default)) = line.strip_prefix("override ").and_then(|rest| rest.split_once(" = ")) else {
            return format!("{line}\n");
        };
        let given =
            constants.iter().find(|(name, _)| declared.split(':').next() == Some(name)).map(|&(_, value)| value);
        match given {
            Some(value) if declared.ends_with("bool") => format!("const {declared} = {};\n", value != 0.0),
            Some(value) => format!("const {declared} = {value:?};\n"),
            None => format!("const {declared} = {default}\n"),
        }
    };
    shader.code().lines().map(line).collect()
}

#[test]
fn every_pipeline_has_a_complete_shader_that_says_what_it_is_made_for() {
    let files = files();
    let folder = std::env::var_os(FOLDER).map(PathBuf::from);
    for (name, code) in &files {
        let module = tests::parsed(name, code);
        tests::validate(name, &module);
        assert!(module.overrides.is_empty(), "{name}");
        if let Some(folder) = &folder {
            std::fs::write(folder.join(name).with_extension("wgsl"), code).expect("a folder to write to");
        }
    }
    assert!(files["natural_rock-low"].contains("const quality: f32 = 0.0;"));
    assert!(files["natural_ground-gravel-dry-log-high"].contains("const ground_kind: f32 = 2.0;"));
    assert!(files["natural_ground-gravel-dry-log-high"].contains("const has_moss: bool = false;"));
    assert!(files["rock"].contains("const target_is_srgb: bool = false;"));
}
