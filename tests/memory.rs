//! The estimate before a run against what is really allocated, for fields as they are usually asked for. `memory_random.rs` measures
//! the estimate of a run for all others.
//!
//! The only test of this file: whatever ran beside it would be counted too.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::fmt::Write;

use common::{layer, memory::Meter, params};
use peak_alloc::PeakAlloc;
use rock_field::memory_estimate;
use rock_field::params::{Border, Darts, Layer, Params, preset};
use rock_field::rocks::Generator;

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

/// The peak of a run on a fresh generator, and of a second run with another seed.
fn measure(params: &Params) -> [usize; 2] {
    let mut generator = Generator::new();
    let meter = Meter::new(&ALLOCATED);
    let mut run = |params: &Params| meter.measure(&mut generator, params, u64::MAX).0;
    [run(params), run(&Params { seed: params.seed + 1, ..params.clone() })]
}

fn square(side: u32, layers: Vec<Layer>) -> Params {
    params(side, side, layers)
}

#[test]
fn the_estimate_lies_between_the_peak_and_twice_it() {
    let fig1 = |side| Params { image_width: side, image_height: side, ..Params::default() };
    let eight = (0..8).map(|k| layer(k, 200.0 / f64::from(1 << k), 0.2)).collect();
    let detailed = |detail, side| square(side, vec![Layer { detail, weathering: 0.6, ..layer(0, 30.0, 0.6) }]);
    let cases: [(&str, Params); 27] = [
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
        ("detail 10", detailed(10.0, 1400)),
        ("detail 37", detailed(37.0, 1024)),
        ("detail 52", detailed(52.0, 700)),
        ("riverbed", preset("riverbed").unwrap().params()),
        ("lava field", preset("lava-field").unwrap().params()),
        (
            "cells that all touch the border",
            Params {
                border: Border::Drop,
                ..square(800, vec![layer(0, 300.0, 1.0), Layer { detail: 180.0, ..layer(1, 3.0, 1.0) }])
            },
        ),
        ("a disc over half of the image", Params { packing: 0.55, ..square(8192, vec![layer(0, 5315.0, 0.5)]) }),
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
