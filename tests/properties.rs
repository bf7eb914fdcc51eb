//! What holds for every field: the exact invariants, and that a cached result is the full result.
//!
//! 10,000 random parameter sets from a fixed seed, and 12 large ones. A failure names the parameters as a link.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::ops::Range;

use common::{
    Random, add_random_layer, checked, difference, field_test, layer, link, params, random_layer, random_packing,
    random_params, random_value, saturated,
};
use rock_field::params::{Border, Darts, Notation, PARAMS, ParamSpec, Params, Scope, Stage, Swing};
use rock_field::rocks::{Cells, Field, Generator, generate, voronoi};

/// Headless Node runs one of them at a time, and wasm is there to prove that it is the same code, not to search: a hundredth of the random
/// cases and every third of the large ones.
const CASES: usize = if cfg!(target_arch = "wasm32") { 100 } else { 10_000 };
const LARGE_STEP: usize = if cfg!(target_arch = "wasm32") { 3 } else { 1 };

/// Largest side of the random images, px.
const SIDE: f64 = 384.0;

field_test! {
    fn invariants_hold_and_cached_is_full_for_random_parameters() {
        for_all(0..CASES, random_case);
    }
}

#[test]
#[cfg(not(target_arch = "wasm32"))]
#[ignore = "takes ten minutes"]
fn invariants_hold_and_cached_is_full_for_100_000_more() {
    for_all(CASES..CASES + 100_000, random_case);
}

field_test! {
    fn invariants_hold_for_large_fields() {
        let cases = large_cases();
        for_all(0..cases.len().div_ceil(LARGE_STEP), |case| {
            let params = &cases[case * LARGE_STEP];
            let field = checked(params)?;
            reach_does_not_matter(params, &field)
        });
    }
}

fn random_case(case: usize) -> Result<(), String> {
    // Each case has random numbers of its own, whatever the order in which cases are run.
    let mut random = Random(0x726f_636b_0000_0000 + case as u64);
    let params = random_params(&mut random, SIDE);
    let field = checked(&params)?;
    if case.is_multiple_of(4) {
        reach_does_not_matter(&params, &field)?;
    }
    drop(field);
    cached_is_full(&mut random, params)
}

/// How far neighbours are looked for makes no difference, bit for bit.
fn reach_does_not_matter(params: &Params, field: &Field) -> Result<(), String> {
    for (k, layer) in field.layers.iter().enumerate() {
        let global = voronoi(&layer.sites);
        let local = voronoi(&saturated(&layer.sites));
        let bits = |cells: &Cells| -> Vec<[u64; 2]> {
            cells.vertices.iter().map(|v| v.to_array().map(f64::to_bits)).collect()
        };
        if local.starts != global.starts || bits(&local) != bits(&global) {
            return Err(format!("the diagrams found with two reaches differ in layer {k}\n  {}", link(params)));
        }
    }
    Ok(())
}

/// A chain of random edits on one generator, some of them overtaken half-way by the next.
fn cached_is_full(random: &mut Random, mut params: Params) -> Result<(), String> {
    let mut generator = Generator::new();
    let mut chain = vec![link(&params)];
    let start = |generator: &mut Generator, params: &Params| {
        generator.start(params.clone(), u64::MAX).map_err(|error| format!("{error}\n  {}", link(params)))
    };
    start(&mut generator, &params)?;
    if random.chance(0.7) {
        while !generator.step().unwrap() {}
    }
    let edits = 2 + random.below(4);
    for edit in 1..=edits {
        change(random, &mut params);
        chain.push(link(&params));
        start(&mut generator, &params)?;
        if edit == edits || random.chance(0.3) {
            while !generator.step().unwrap() {}
        } else {
            for _ in 0..random.below(12) {
                generator.step().unwrap();
            }
        }
    }
    let full = generate(&params).map_err(|error| error.to_string())?;
    match difference(&generator.into_field(), &full) {
        None => Ok(()),
        Some(what) => Err(format!("{what}: cached is not full after this chain of edits\n  {}", chain.join("\n  "))),
    }
}

/// One edit, as a control of the page makes it: of any parameter in the table that a stage depends on, or of the list of
/// layers.
fn change(random: &mut Random, params: &mut Params) {
    let count = params.layers.len();
    let rows = |is_item| PARAMS.iter().filter(move |spec| spec.stage != Stage::Look && is_item == is_of_layer(spec));
    let items: Vec<_> = rows(true).collect();
    if count > 0 && random.chance(0.6) {
        let k = random.below(count);
        let fresh = random_layer(random, params, params.layers[k].id);
        match items.get(random.below(items.len() + 2)).map(|spec| &spec.scope) {
            Some(Scope::Item(get, set)) => set(&mut params.layers[k], get(&fresh)),
            _ => renumber(random, params, k),
        }
        return;
    }
    // In the other notation, the same numbers are other lengths, and images of thousands of pixels take long.
    let fields: Vec<_> = rows(false).filter(|spec| spec.key != "notation").collect();
    match random.below(fields.len() + 5) {
        0 | 1 if count < 8 => add_random_layer(random, params),
        2 if count > 0 => {
            params.layers.remove(random.below(count));
        }
        3 if count > 1 => {
            let layer = params.layers.remove(random.below(count));
            params.layers.insert(random.below(count), layer);
        }
        4 if count > 1 => params.layers.swap(0, count - 1),
        at => {
            let Some(spec) = at.checked_sub(5).and_then(|at| fields.get(at)) else { return };
            let value = match spec.key {
                "imageWidth" | "imageHeight" => random.log_between(1.0, SIDE + 0.999).floor(),
                "packing" => random_packing(random),
                _ => random_value(random, spec),
            };
            if let Scope::Field(_, set) = spec.scope {
                set(params, value);
            }
        }
    }
}

fn is_of_layer(spec: &ParamSpec) -> bool {
    matches!(spec.scope, Scope::Item(..))
}

/// Gives a layer another id: other random streams in the same place.
fn renumber(random: &mut Random, params: &mut Params, k: usize) {
    let id = random.bits() as u32;
    if params.layers.iter().all(|layer| layer.id != id) {
        params.layers[k].id = id;
    }
}

fn large_cases() -> [Params; 12] {
    let fig1 = Params::default();
    let three = |radii: [f64; 3]| [0, 1, 2].map(|k| layer(k, radii[k as usize], 0.4)).to_vec();
    [
        Params { seed: 1, ..params(8192, 1, three([90.0, 3.0, 1.0])) },
        Params { seed: 2, packing: 1.0, ..params(1, 8192, three([500.0, 7.5, 1.0])) },
        Params { seed: 3, image_width: 2048, image_height: 2048, ..fig1.clone() },
        Params { seed: 4, image_width: 4096, image_height: 64, ..fig1.clone() },
        Params { seed: 5, packing: 1.0, ..params(700, 500, vec![layer(0, 1.0, 1.0), layer(1, 1.5, 1.0)]) },
        Params { seed: 6, packing: 1.0, ..params(1500, 1200, vec![layer(0, 8192.0, 1.0), layer(1, 1400.0, 0.5)]) },
        Params { seed: 7, packing: 0.2, ..params(1200, 1000, three([2.0, 40.0, 5.0])) },
        Params { seed: 8, darts: Darts::Attempts, ..params(2000, 1000, three([60.0, 20.0, 4.0])) },
        Params { seed: 9, packing: 0.54, border: Border::Drop, ..params(1024, 768, three([3.0, 3.0, 3.0])) },
        Params {
            seed: 10,
            notation: Notation::Relative,
            image_width: 3000,
            image_height: 500,
            ..rock_field::params::preset("conference-fig1").unwrap().params()
        },
        Params {
            seed: 11,
            ..params(1024, 1024, (0..8).map(|k| layer(k, 256.0 / f64::from(1 << k) + 1.0, 0.3)).collect())
        },
        Params {
            seed: 12,
            border: Border::Drop,
            swing: Swing::Separate,
            ..params(
                8192,
                128,
                vec![
                    rock_field::params::Layer {
                        cell_count: Some(40),
                        taper: [-500.0, 400.0, 300.0],
                        ..layer(7, 60.0, 0.0)
                    },
                    rock_field::params::Layer { cell_count: Some(u32::MAX), height: [0.0; 3], ..layer(3, 12.0, 0.0) },
                ],
            )
        },
    ]
}

/// Runs the cases, natively on all cores, and panics with the first that fails.
fn for_all(cases: Range<usize>, check: impl Fn(usize) -> Result<(), String> + Sync) {
    #[cfg(not(target_arch = "wasm32"))]
    let failures = {
        use std::panic::{AssertUnwindSafe, catch_unwind};
        use std::sync::Mutex;
        use std::sync::atomic::{AtomicUsize, Ordering};
        let (next, failures) = (AtomicUsize::new(cases.start), Mutex::new(Vec::new()));
        let work = || {
            loop {
                let case = next.fetch_add(1, Ordering::Relaxed);
                if case >= cases.end || !failures.lock().unwrap().is_empty() {
                    break;
                }
                let result = catch_unwind(AssertUnwindSafe(|| check(case)))
                    .unwrap_or_else(|_| Err("panicked; see above".to_string()));
                if let Err(message) = result {
                    failures.lock().unwrap().push((case, message));
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
                scope.spawn(work);
            }
        });
        failures.into_inner().unwrap()
    };
    #[cfg(target_arch = "wasm32")]
    let failures: Vec<_> = cases.filter_map(|case| check(case).err().map(|message| (case, message))).take(1).collect();
    if let Some((case, message)) = failures.iter().min() {
        panic!("case {case}: {message}");
    }
}
