//! The same seed gives the same bytes everywhere: SHA-256 of all buffers of every preset (seed 0), natively and in wasm.
//!
//! `tests/e2e/golden.mjs` computes the same from JavaScript. The bytes, little-endian and without separators: per layer in input order `sites`
//! (f32), `cellStarts` (u32), `cellVertices` (f32), `selected` (u32); then `positions`, `normals` (f32), `indices`, `rockStarts`,
//! `vertexStarts` (u32), `rockLayer` (u8).
//!
//! A difference means that old links show other rocks. Where that is meant, `UPDATE=1 cargo test --test golden` rewrites the
//! file, and commit and changelog say "same seed, new output".
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::field_test;
use rock_field::params::PRESETS;
use rock_field::rocks::{Field, generate};
use sha2::{Digest, Sha256};

fn hash(field: &Field) -> String {
    let mut sha = Sha256::new();
    let mut words = |words: &mut dyn Iterator<Item = u32>| words.for_each(|word| sha.update(word.to_le_bytes()));
    let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    for layer in &field.layers {
        words(&mut bits(&layer.sites.positions()).into_iter());
        words(&mut layer.cells.starts.iter().copied());
        words(&mut bits(&layer.cells.flat_vertices()).into_iter());
        words(&mut layer.selection.selected.iter().copied());
    }
    let mesh = &field.mesh;
    words(&mut bits(&mesh.positions).into_iter());
    words(&mut bits(&mesh.normals).into_iter());
    words(&mut mesh.indices.iter().chain(&mesh.rock_starts).chain(&mesh.vertex_starts).copied());
    sha.update(&mesh.rock_layer);
    sha.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

field_test! {
    fn every_preset_has_its_golden_hash() {
        let ours: Vec<(&str, String)> =
            PRESETS.iter().map(|preset| (preset.name, hash(&generate(&preset.params()).unwrap()))).collect();
        #[cfg(not(target_arch = "wasm32"))]
        if std::env::var_os("UPDATE").is_some() {
            let rows: Vec<String> = ours.iter().map(|(name, hash)| format!("  \"{name}\": \"{hash}\"")).collect();
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/golden.json");
            std::fs::write(path, format!("{{\n{}\n}}\n", rows.join(",\n"))).unwrap();
            return;
        }
        let golden: serde_json::Value = serde_json::from_str(include_str!("data/golden.json")).unwrap();
        let changed: Vec<&str> =
            ours.iter().filter(|(name, hash)| golden[name] != hash.as_str()).map(|(name, _)| *name).collect();
        assert!(changed.is_empty(), "same seed, new output: {changed:?}. On purpose? UPDATE=1 cargo test --test golden");
        assert_eq!(golden.as_object().unwrap().len(), PRESETS.len());
    }
}
