//! Everything that lists parameters is generated from the one table; this test regenerates it.
//! `UPDATE=1 cargo test --test params` writes the files instead of comparing them.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::BTreeMap;
use std::fmt::Write;

use rock_field::params::{
    self, Kind, Layer, MAX_LAYERS, Notation, PARAMS, PRESETS, ParamSpec, Params, Range, Scope, Slider, TEXTS, preset,
    wood_ear,
};

fn json(text: &str) -> String {
    serde_json::to_string(text).unwrap()
}

fn number(value: f64) -> String {
    if value.is_nan() { "null".into() } else { format!("{value}") }
}

fn pair([en, ja]: [&str; 2]) -> String {
    format!("{{ en: {}, ja: {} }}", json(en), json(ja))
}

fn bounds(range: Range, slider: Slider) -> String {
    format!(
        "min: {}, max: {}, step: {}, default: {}, slider: {{ min: {}, max: {}, logarithmic: {} }}",
        number(range.min),
        number(range.max),
        number(slider.step),
        number(range.default),
        number(slider.min),
        number(slider.max),
        slider.logarithmic
    )
}

/// The rows of a table, whichever it is.
macro_rules! rows {
    ($out:ident, $table:ident, $item:literal) => {
        for (spec, text) in $table::PARAMS.iter().zip($table::TEXTS) {
            let scope = if matches!(spec.scope, $table::Scope::Field(..)) { "field" } else { $item };
            let (kind, choices) = kind_of(spec.kind);
            writeln!($out, "  {{").unwrap();
            let component = text.component.map_or("null".into(), |c| c.to_string());
            writeln!(
                $out,
                "    key: {}, component: {component}, url: {}, scope: '{scope}', kind: '{kind}', stage: '{}',",
                json(spec.key),
                json(text.url),
                format!("{:?}", spec.stage).to_lowercase()
            )
            .unwrap();
            writeln!($out, "    {},", bounds(spec.range, text.slider)).unwrap();
            match spec.relative.zip(text.relative) {
                Some((range, slider)) => writeln!($out, "    relative: {{ {} }},", bounds(range, slider)).unwrap(),
                None => writeln!($out, "    relative: null,").unwrap(),
            }
            writeln!($out, "    unit: {{ px: {}, relative: {} }},", json(text.unit[0]), json(text.unit[1])).unwrap();
            writeln!($out, "    label: {},", json(text.label[0])).unwrap();
            let words: Vec<String> = choices
                .unwrap_or_default()
                .iter()
                .zip(text.choices)
                .map(|(word, label)| format!("{{ value: {}, label: {} }}", json(word), json(label[0])))
                .collect();
            writeln!($out, "    choices: [{}],", words.join(", ")).unwrap();
            writeln!($out, "  }},").unwrap();
        }
    };
}

/// What every parameter does, by its URL key: not needed before somebody asks.
macro_rules! docs {
    ($out:ident, $table:ident, $name:literal) => {
        writeln!($out, "export const {}: Readonly<Record<string, Words>> = {{", $name).unwrap();
        for text in $table::TEXTS {
            writeln!($out, "  {}: {},", text.url, pair(text.doc)).unwrap();
        }
        $out.push_str("};\n");
    };
}

fn kind_of(kind: Kind) -> (&'static str, Option<&'static [&'static str]>) {
    match kind {
        Kind::Real => ("real", None),
        Kind::Integer => ("integer", None),
        Kind::OptionalReal => ("optional-real", None),
        Kind::OptionalInteger => ("optional-integer", None),
        Kind::Choice(words) => ("choice", Some(words)),
    }
}

fn typescript_table() -> String {
    let mut out = String::from(
        "// Generated from src/params/rocks/table.rs by `UPDATE=1 cargo test --test params`; never edited.\n\n\
         import type { ParamSpec, Preset, Triple } from './spec.ts';\n\n",
    );
    writeln!(out, "export const MAX_LAYERS = {MAX_LAYERS};\n").unwrap();
    out.push_str("/** Every parameter, in the order of the flat form. */\nexport const PARAMS = [\n");
    rows!(out, params, "layer");
    out.push_str("] as const satisfies readonly ParamSpec[];\n\n");
    out.push_str(
        "/** Table 1 of both papers, then natural grounds. A row per layer, in the order of the layer's rows without the count; a\n \
         * choice is the index of its word. The first is the default. */\n",
    );
    out.push_str("export const PRESETS = [\n");
    for preset in PRESETS {
        let notation = if preset.notation == Notation::Px { "px" } else { "relative" };
        // In the order of the table, and as far as the preset gives values.
        let columns: Vec<_> = PARAMS.iter().filter(|spec| spec.is_column()).collect();
        let given = columns.iter().rposition(|spec| preset.columns.contains(&spec.key)).map_or(0, |last| last + 1);
        let value = |layer: &Layer, spec: &ParamSpec| match spec.scope {
            Scope::Item(get, _) => number(get(layer)),
            Scope::Field(..) => unreachable!("a column belongs to a layer"),
        };
        let row = |layer: &Layer| columns[..given].iter().map(|spec| value(layer, spec)).collect::<Vec<_>>().join(", ");
        let rows: Vec<String> = preset.params().layers.iter().map(|layer| format!("[{}]", row(layer))).collect();
        let fields: Vec<String> =
            preset.fields.iter().map(|&(key, value)| format!("{key}: {}", field(key, value))).collect();
        let natural = if preset.natural { ", natural: true" } else { "" };
        let fields = if fields.is_empty() { String::new() } else { format!(", fields: {{ {} }}", fields.join(", ")) };
        writeln!(
            out,
            "  {{ name: '{}'{natural}, notation: '{notation}'{fields}, layers: [{}] }},",
            preset.name,
            rows.join(", ")
        )
        .unwrap();
    }
    out.push_str("] as const satisfies readonly Preset[];\n\n");
    out.push_str(
        "/** The parameters of a layer. Its lengths are in the field's `notation`. */\nexport interface Layer {\n",
    );
    out.push_str("  /** Stable identity: the layer's random numbers depend on it and not on its place in the list. */\n  id: number;\n");
    out.push_str(&members(|spec| matches!(spec.scope, Scope::Item(..))));
    out.push_str("}\n\n/** All parameters of a field. */\nexport interface Params {\n");
    out.push_str(&members(|spec| matches!(spec.scope, Scope::Field(..))));
    out.push_str("  layers: Layer[];\n}\n");
    out
}

/// The parameters in these rows as members of a TypeScript interface.
fn members(has: impl Fn(&ParamSpec) -> bool) -> String {
    let mut out = String::new();
    for (spec, text) in PARAMS.iter().zip(TEXTS).filter(|(spec, text)| has(spec) && text.component.unwrap_or(0) == 0) {
        let of = match spec.kind {
            _ if text.component.is_some() => "Triple".to_string(),
            Kind::Real | Kind::Integer => "number".to_string(),
            Kind::OptionalReal | Kind::OptionalInteger => "number | null".to_string(),
            Kind::Choice(words) => words.iter().map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" | "),
        };
        writeln!(out, "  {}: {of};", spec.key).unwrap();
    }
    out
}

/// A value of a field's parameter as code writes it.
fn field(key: &str, value: f64) -> String {
    match PARAMS.iter().find(|spec| spec.key == key).unwrap().kind {
        Kind::Choice(words) => json(words[value as usize]),
        _ => number(value),
    }
}

fn assert_generated(path: &str, content: &str) {
    let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, content).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(found == content, "{path} differs from the table; run `UPDATE=1 cargo test --test params`");
}

#[test]
fn typescript_is_generated_from_the_table() {
    assert_generated("www/rocks/params.gen.ts", &typescript_table());
    assert_generated("www/wood-ear/params.gen.ts", &wood_ear_table());
    let mut rocks = String::from(DOCS_HEAD);
    docs!(rocks, params, "PARAM_DOCS");
    assert_generated("www/rocks/param-docs.gen.ts", &rocks);
    let mut ears = String::from(DOCS_HEAD);
    docs!(ears, wood_ear, "WOOD_EAR_DOCS");
    assert_generated("www/wood-ear/param-docs.gen.ts", &ears);
    assert_generated("www/controls/labels.ja.gen.ts", &japanese_labels());
}

/// The Japanese label of every parameter and choice, by the English one.
fn japanese_labels() -> String {
    let rocks = TEXTS.iter().flat_map(|text| std::iter::once(&text.label).chain(text.choices));
    let ears = wood_ear::TEXTS.iter().flat_map(|text| std::iter::once(&text.label).chain(text.choices));
    let mut labels = BTreeMap::new();
    for [en, ja] in rocks.chain(ears) {
        let former = labels.insert(en, ja);
        assert!(former.is_none_or(|other| other == ja), "{en} has two Japanese labels");
    }
    let mut out = String::from(
        "// Generated from src/params/ by `UPDATE=1 cargo test --test params`; never edited.\n\n\
         /** The Japanese label of every parameter and choice, by the English one; apart from the tables, since few read Japanese. */\n\
         export const LABELS_JA: Readonly<Record<string, string>> = {\n",
    );
    for (en, ja) in labels {
        writeln!(out, "  {}: {},", json(en), json(ja)).unwrap();
    }
    out.push_str("};\n");
    out
}

const DOCS_HEAD: &str = "// Generated from src/params/ by `UPDATE=1 cargo test --test params`; never edited.\n\n\
     import type { Words } from '../base/language.ts';\n\n\
     /** What every parameter does, by its key in links; apart from the table, so that no first picture waits for it. */\n";

fn wood_ear_table() -> String {
    let mut out = String::from(
        "// Generated from src/params/wood_ear/ by `UPDATE=1 cargo test --test params`; never edited.\n\n\
         import type { WoodEarPreset, WoodEarSpec } from './spec.ts';\n\n",
    );
    writeln!(out, "export const MAX_BASES = {};\n", wood_ear::MAX_BASES).unwrap();
    out.push_str("/** Every parameter of a wood-ear colony, in the order of the flat form. */\nexport const WOOD_EAR_PARAMS = [\n");
    rows!(out, wood_ear, "base");
    out.push_str("] as const satisfies readonly WoodEarSpec[];\n\n");
    out.push_str(
        "/** Scenes of the thesis, then colonies as they are found. A row per base: x, y, z, range; without one, a base at the default.\n \
         * The first is the default. */\n",
    );
    out.push_str("export const WOOD_EAR_PRESETS = [\n");
    for preset in wood_ear::PRESETS {
        let written = |&(key, value): &(&str, f64)| {
            let spec = wood_ear::PARAMS.iter().find(|spec| spec.key == key).unwrap();
            let value = match spec.kind {
                Kind::Choice(words) => json(words[value as usize]),
                _ => number(value),
            };
            format!("{key}: {value}")
        };
        let fields: Vec<String> = preset.fields.iter().map(written).collect();
        let row = |row: &[f64; 4]| format!("[{}]", row.map(number).join(", "));
        let bases: Vec<String> = preset.bases.iter().map(row).collect();
        let natural = if preset.natural { ", natural: true" } else { "" };
        let fields = if fields.is_empty() { String::new() } else { format!(", fields: {{ {} }}", fields.join(", ")) };
        let bases = if bases.is_empty() { String::new() } else { format!(", bases: [{}]", bases.join(", ")) };
        writeln!(out, "  {{ name: '{}'{natural}{fields}{bases} }},", preset.name).unwrap();
    }
    out.push_str("] as const satisfies readonly WoodEarPreset[];\n");
    out
}

fn readme_table() -> String {
    let mut out = String::from("| key | in links | range | default | |\n|---|---|---|---|---|\n");
    for (spec, text) in PARAMS.iter().zip(TEXTS) {
        let key = text.component.map_or(format!("`{}`", spec.key), |c| format!("`{}[{c}]`", spec.key));
        let range = match spec.kind {
            Kind::Choice(words) => words.iter().map(|w| format!("`{w}`")).collect::<Vec<_>>().join(", "),
            _ => format!("{} – {} {}", spec.range.min, spec.range.max, text.unit[0]),
        };
        let default = match spec.kind {
            Kind::Choice(words) => format!("`{}`", words[spec.range.default as usize]),
            _ if spec.range.default.is_nan() => "none".into(),
            _ => spec.range.default.to_string(),
        };
        writeln!(out, "| {key} | `{}` | {} | {default} | {} |", text.url, range.trim(), text.doc[0]).unwrap();
    }
    out
}

#[test]
fn the_readme_lists_every_parameter() {
    let path = format!("{}/README.md", env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(path).unwrap().replace("\r\n", "\n");
    let (before, rest) = readme.split_once("--test params` -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- /parameters -->").unwrap();
    let content = format!("{before}--test params` -->\n{}<!-- /parameters -->{after}", readme_table());
    assert_generated("README.md", &content);
}

#[test]
fn every_row_has_words_and_a_default_within_its_bounds() {
    assert_eq!(PARAMS.len(), TEXTS.len());
    for (spec, text) in PARAMS.iter().zip(TEXTS) {
        for words in [text.label, text.doc] {
            assert!(words.iter().all(|w| !w.is_empty()), "{}", spec.key);
        }
        for notation in [Notation::Px, Notation::Relative] {
            let range = spec.range(notation);
            assert!(range.min < range.max);
            assert!(range.default.is_nan() || (range.min..=range.max).contains(&range.default), "{}", spec.key);
        }
        if let Kind::Choice(words) = spec.kind {
            assert_eq!(words.len(), text.choices.len());
            assert_eq!(spec.range.max, (words.len() - 1) as f64);
        }
    }
    let mut urls: Vec<_> = TEXTS.iter().map(|text| text.url).collect();
    urls.sort_unstable();
    urls.dedup();
    assert_eq!(urls.len(), PARAMS.len(), "two rows share a key in links");
}

#[test]
fn flat_form_round_trips_every_preset() {
    for preset in PRESETS {
        let params = preset.params();
        assert_eq!(Params::from_flat(&params.to_flat()).unwrap(), params);
    }
}

#[test]
fn presets_are_table_1_of_both_papers() {
    let papers: serde_json::Value = serde_json::from_str(include_str!("data/presets.json")).unwrap();
    let mut count = 0;
    for (book, prefix, notation) in
        [("journal2011", "journal", Notation::Px), ("nicograph2010", "conference", Notation::Relative)]
    {
        for (name, column) in papers[book]["presets"].as_object().unwrap() {
            let ours = preset(&format!("{prefix}-{name}")).unwrap();
            assert_eq!(ours.notation, notation);
            assert_eq!(ours.layers.len() as u64, column["N"].as_u64().unwrap());
            for (index, row) in ours.layers.iter().enumerate() {
                for (value, key) in row.iter().zip(["r", "A_s", "c_w1", "c_w2", "c_w3", "c_h1", "c_h2", "c_h3"]) {
                    assert_eq!(*value, column[key][index].as_f64().unwrap(), "{name} {key} {index}");
                }
            }
            count += 1;
        }
    }
    assert_eq!(count, PRESETS.iter().filter(|preset| !preset.natural).count());
    assert!(PRESETS.iter().skip(count).all(|preset| preset.natural), "the papers come first");
}

#[test]
fn every_preset_names_known_parameters_and_is_legal() {
    for preset in PRESETS {
        for (key, _) in preset.fields {
            assert!(PARAMS.iter().any(|spec| spec.key == *key && matches!(spec.scope, Scope::Field(..))), "{key}");
        }
        for key in preset.columns {
            let numbers = PARAMS.iter().filter(|spec| spec.key == *key && spec.is_column()).count();
            let columns = preset.columns.iter().filter(|other| *other == key).count();
            assert_eq!(columns, numbers, "{}: {key}", preset.name);
        }
        for row in preset.layers {
            assert_eq!(row.len(), preset.columns.len(), "{}", preset.name);
        }
        preset.params().validate().unwrap();
    }
}

#[test]
fn a_value_out_of_range_is_named_with_its_bounds() {
    for (row, spec) in PARAMS.iter().enumerate().filter(|(_, s)| matches!(s.scope, Scope::Field(..))) {
        for bad in [spec.range.max + 1.0, spec.range.min - 1.0, f64::NAN, f64::INFINITY] {
            let mut flat = Params::default().to_flat();
            flat[row] = bad;
            let error = Params::from_flat(&flat).unwrap_err();
            assert_eq!(error.key(), spec.key);
            assert_eq!(error.numbers()[1..], [spec.range.min, spec.range.max]);
            assert!(error.to_string().contains(spec.key));
        }
    }
}

#[test]
fn the_wood_ears_table_is_as_sound_as_the_rocks() {
    use wood_ear::{PARAMS, PRESETS, Params, Scope, TEXTS};
    assert_eq!(PARAMS.len(), TEXTS.len());
    for (spec, text) in PARAMS.iter().zip(TEXTS) {
        assert!([text.label, text.doc].iter().flatten().all(|words| !words.is_empty()), "{}", spec.key);
        let range = spec.range;
        assert!(range.min < range.max && range.min <= text.slider.min && text.slider.max <= range.max, "{}", spec.key);
        let none = range.default.is_nan() && spec.kind.is_optional();
        assert!(none || (range.min..=range.max).contains(&range.default), "{}", spec.key);
        if let Kind::Choice(words) = spec.kind {
            assert_eq!((words.len(), range.max), (text.choices.len(), (words.len() - 1) as f64));
        }
    }
    let mut urls: Vec<_> = TEXTS.iter().map(|text| text.url).collect();
    urls.sort_unstable();
    urls.dedup();
    assert_eq!(urls.len(), PARAMS.len(), "two rows share a key in links");
    for preset in PRESETS {
        for (key, _) in preset.fields {
            assert!(PARAMS.iter().any(|spec| spec.key == *key && matches!(spec.scope, Scope::Field(..))), "{key}");
        }
        let params = preset.params();
        assert_eq!(Params::from_flat(&params.to_flat()).unwrap(), params);
    }
    // Table 4.2 of the thesis.
    for (key, bounds) in [
        ("density", [0.0, 50.0, 100.0]),
        ("range", [20.0, 50.0, 200.0]),
        ("moisture", [0.0, 50.0, 100.0]),
        ("wrinkles", [0.0, 50.0, 100.0]),
        ("size", [1.0, 2.0, 3.0]),
        ("sizeSpread", [1.0, 1.5, 2.0]),
    ] {
        let range = PARAMS.iter().find(|spec| spec.key == key).unwrap().range;
        assert_eq!([range.min, range.default, range.max], bounds, "{key}");
    }
    let rows = PARAMS.iter().filter(|spec| matches!(spec.scope, Scope::Field(..)));
    for (row, spec) in rows.enumerate() {
        for bad in [spec.range.max + 1.0, spec.range.min - 1.0, f64::NAN, f64::INFINITY] {
            let mut flat = Params::default().to_flat();
            flat[row] = bad;
            assert_eq!(Params::from_flat(&flat).unwrap_err().key(), spec.key);
        }
    }
    let flat = Params::default().to_flat();
    assert_eq!(Params::from_flat(&flat[..flat.len() - 1]).unwrap_err().code(), "MalformedRequest");
}
