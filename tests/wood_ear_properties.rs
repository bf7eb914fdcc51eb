//! Random colonies: whatever the settings, a run ends, is finite, and reports the pairs that cross; and equal seeds give equal bytes.
//!
//! The golden hashes are SHA-256 of, little-endian and without separators: `positions`, `normals` (f32), `indices`, `individual_starts`,
//! `vertex_starts`, `foot` (u32), `size` (f32), `base` (u8), then the log's `positions`, `normals` (f32), `indices` (u32), `kinds` (u8). A
//! difference means that old links show other colonies. Where that is meant, `UPDATE=1 cargo test --test wood_ear_properties` rewrites
//! the file, and commit and changelog say "same seed, new output".
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::wood_ear::{random_individuals, run, unit_or_end};
use common::{Random, field_test};
use rock_field::params::wood_ear::{Base, Collisions, Log, PRESETS, Params};
use rock_field::validate::check_colony;
use rock_field::wood_ear::Generator;
use sha2::{Digest, Sha256};

fn random_params(random: &mut Random) -> Params {
    let log = Log {
        length: random.between(40.0, 55.0),
        radius: random.between(5.0, 7.0),
        bend: unit_or_end(random),
        bark: unit_or_end(random),
        spacing: random.between(4.0, 6.0),
        seed: random.bits() as u32,
    };
    let count = 1 + random.below(3);
    let bases: Vec<Base> = (0..count)
        .map(|_| Base {
            position: [random.between(-30.0, 30.0), random.between(-20.0, 20.0), random.between(-5.0, 30.0)],
            range: random.chance(0.5).then(|| random.between(20.0, 60.0)),
        })
        .collect();
    Params {
        seed: random.bits() as u32,
        density: 100.0 * unit_or_end(random) * unit_or_end(random),
        range: random.between(20.0, 40.0),
        log,
        bases,
        ..random_individuals(random, |random| [3 + random.below(5) as u32, 8 + random.below(8) as u32])
    }
}

fn check(case: u64) {
    let params = random_params(&mut Random(case));
    let run = run(&params);
    check_colony(&params, &run.generator).unwrap_or_else(|violation| panic!("case {case}: {violation}\n{params:?}"));
    let stats = run.generator.stats();
    assert!(stats.rounds <= 200 || params.collisions != Collisions::Thesis, "case {case}: {stats:?}");
    assert!(stats.sweeps <= 10 || params.collisions != Collisions::Thesis, "case {case}: {stats:?}");
    assert!(
        stats.crossing_pairs == 0 || params.collisions != Collisions::Pressed,
        "case {case}: {stats:?}\n{params:?}"
    );
    assert!((0.0..=1.0).contains(&stats.kept_p10) && stats.kept_p10 <= stats.kept_median, "case {case}: {stats:?}");
}

#[cfg(not(target_arch = "wasm32"))]
#[test]
fn ten_thousand_random_colonies_keep_every_promise() {
    use std::sync::atomic::{AtomicU64, Ordering};
    let next = AtomicU64::new(0);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let case = next.fetch_add(1, Ordering::Relaxed);
                    if case >= 10_000 {
                        break;
                    }
                    check(case);
                }
            });
        }
    });
}

#[cfg(target_arch = "wasm32")]
field_test! {
    fn random_colonies_keep_every_promise() {
        (0..100).for_each(check);
    }
}

fn hash(generator: &Generator) -> String {
    let mut sha = Sha256::new();
    let (mesh, log) = (generator.mesh(), generator.log_mesh());
    let mut floats = |values: &[f32]| values.iter().for_each(|v| sha.update(v.to_bits().to_le_bytes()));
    floats(&mesh.positions);
    floats(&mesh.normals);
    for words in [&mesh.indices, &mesh.individual_starts, &mesh.vertex_starts, &mesh.foot] {
        words.iter().for_each(|word| sha.update(word.to_le_bytes()));
    }
    let mut floats = |values: &[f32]| values.iter().for_each(|v| sha.update(v.to_bits().to_le_bytes()));
    floats(&mesh.size);
    sha.update(&mesh.base);
    let mut floats = |values: &[f32]| values.iter().for_each(|v| sha.update(v.to_bits().to_le_bytes()));
    floats(&log.positions);
    floats(&log.normals);
    log.indices.iter().for_each(|word| sha.update(word.to_le_bytes()));
    sha.update(&log.kinds);
    sha.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

field_test! {
    fn every_preset_has_its_golden_hash() {
        let ours: Vec<(&str, String)> =
            PRESETS.iter().map(|preset| (preset.name, hash(&run(&preset.params()).generator))).collect();
        #[cfg(not(target_arch = "wasm32"))]
        if std::env::var_os("UPDATE").is_some() {
            let rows: Vec<String> = ours.iter().map(|(name, hash)| format!("  \"{name}\": \"{hash}\"")).collect();
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/wood-ear-golden.json");
            std::fs::write(path, format!("{{\n{}\n}}\n", rows.join(",\n"))).unwrap();
            return;
        }
        let golden: serde_json::Value = serde_json::from_str(include_str!("data/wood-ear-golden.json")).unwrap();
        let changed: Vec<&str> =
            ours.iter().filter(|(name, hash)| golden[name] != hash.as_str()).map(|(name, _)| *name).collect();
        assert!(changed.is_empty(), "same seed, new output: {changed:?}. On purpose? UPDATE=1 cargo test --test wood_ear_properties");
        assert_eq!(golden.as_object().unwrap().len(), PRESETS.len());
    }
}
