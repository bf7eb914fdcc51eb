//! The estimate against what is really allocated.
//!
//! The only test of this file: whatever ran beside it would be counted too.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::fmt::Write;

use common::{layer, params};
use peak_alloc::PeakAlloc;
use rock_field::memory_estimate;
use rock_field::params::{Darts, Layer, Params, preset};
use rock_field::rocks::Generator;

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

/// A wasm instance before its first run: a stack of 1 MiB and static data. It is part of what a tab needs.
const INSTANCE: usize = 1_150_000;

/// Peak of a run on a fresh generator, its output copied out, and of a second run with another seed.
///
/// Usize is twice as wide here as in wasm, but all that grows with the field is of fixed width.
fn measure(params: &Params) -> [usize; 2] {
    let mut generator = Generator::new();
    let before = ALLOCATED.current_usage();
    let mut run = |params: &Params| {
        ALLOCATED.reset_peak_usage();
        generator.start(params.clone(), u64::MAX).unwrap();
        while !generator.step() {}
        // The copies of the buffers lie in JavaScript's memory; the conversions they are made from, one at a time, in wasm.
        let mesh = generator.mesh();
        let words = mesh.positions.len() + mesh.normals.len() + mesh.indices.len() + 2 * mesh.rock_starts.len();
        let mut copied = 4 * words + mesh.rock_layer.len();
        for layer in generator.layers() {
            copied += 4 * (layer.cells.starts.len() + layer.selection.selected.len());
            copied += 4 * (layer.sites.positions().len() + layer.cells.flat_vertices().len());
        }
        INSTANCE + ALLOCATED.peak_usage() - before + copied
    };
    let cold = run(params);
    [cold, run(&Params { seed: params.seed + 1, ..params.clone() })]
}

fn square(side: u32, layers: Vec<Layer>) -> Params {
    params(side, side, layers)
}

#[test]
fn the_estimate_lies_between_the_peak_and_twice_it() {
    let fig1 = |side| Params { image_width: side, image_height: side, ..Params::default() };
    let eight = (0..8).map(|k| layer(k, 200.0 / f64::from(1 << k), 0.2)).collect();
    let detailed = |detail, side| square(side, vec![Layer { detail, weathering: 0.6, ..layer(0, 30.0, 0.6) }]);
    let cases: [(&str, Params); 24] = [
        ("Fig. 1, 256²", fig1(256)),
        ("Fig. 1, 512²", fig1(512)),
        ("Fig. 1, 1024²", fig1(1024)),
        ("Fig. 1, 2048²", fig1(2048)),
        ("Fig. 1, 4096²", fig1(4096)),
        (
            "conference Fig. 1, 2048 × 500",
            Params { image_width: 2048, image_height: 500, ..preset("conference-fig1").unwrap().params() },
        ),
        ("r = 10, half", square(1024, vec![layer(0, 10.0, 0.5)])),
        ("r = 10, all", square(2048, vec![layer(0, 10.0, 1.0)])),
        ("r = 10, none", square(2048, vec![layer(0, 10.0, 0.0)])),
        ("r = 90, large image", square(4096, vec![layer(0, 90.0, 0.5)])),
        ("r = 2", square(700, vec![layer(0, 2.0, 0.7)])),
        ("r = 1.2", square(500, vec![layer(0, 1.2, 0.4)])),
        ("r = 1, unsaturated", square(300, vec![layer(0, 1.0, 0.5)])),
        ("r = 1, every pixel", Params { packing: 1.0, ..square(300, vec![layer(0, 1.0, 1.0)]) }),
        ("low packing", Params { packing: 0.3, ..square(1500, vec![layer(0, 4.0, 0.3), layer(1, 20.0, 0.2)]) }),
        ("low packing, no rocks", Params { packing: 0.3, ..square(1500, vec![layer(0, 4.0, 0.0)]) }),
        ("attempts", Params { darts: Darts::Attempts, ..square(1500, vec![layer(0, 4.0, 0.4)]) }),
        ("eight layers", square(1024, eight)),
        ("by count", square(2048, vec![Layer { cell_count: Some(3000), ..layer(0, 12.0, 1.0) }])),
        ("detail 1", detailed(1, 1400)),
        ("detail 3", detailed(3, 1024)),
        ("riverbed", preset("riverbed").unwrap().params()),
        ("lava field", preset("lava-field").unwrap().params()),
        ("a strip", params(8192, 64, vec![layer(0, 30.0, 0.4), layer(1, 3.0, 0.3)])),
    ];
    let mut report = String::new();
    let mut failures = 0;
    for (name, params) in &cases {
        let estimate = memory_estimate(params).bytes;
        let ratios = measure(params).map(|real| estimate as f64 / real as f64);
        let ok = ratios.iter().all(|ratio| (1.0..=2.0).contains(ratio));
        failures += u32::from(!ok);
        let verdict = if ok { "" } else { "  <-- FAIL" };
        let megabytes = estimate as f64 / 1.0e6;
        writeln!(report, "{name:<32}{megabytes:>8.1} MB{:>6.2}{:>6.2} times the peak{verdict}", ratios[0], ratios[1])
            .unwrap();
    }
    assert_eq!(failures, 0, "\n{report}");
}
