//! The estimate of a run against what is really allocated, for parameters as a user could ask for them.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::memory::{Meter, TINY, ten_thousand_seeds};
use common::{Random, link};
use peak_alloc::PeakAlloc;
use rock_field::Error;
use rock_field::params::{Notation, Params};
use rock_field::rocks::Generator;

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

/// Triangles of rocks are cut 1 to 12 times, or not at all.
fn random_detail(random: &mut Random, radius: f64) -> f64 {
    if random.chance(0.25) { 0.0 } else { (random.log_between(0.8, 12.0) * 140.0 / radius).min(1000.0) }
}

/// Parameters of every kind, on images whose sites and pixels take a test no more than about a second.
fn random_params(random: &mut Random) -> Params {
    loop {
        let side = random.pick(&[200.0, 1000.0, 1000.0, 2000.0, 8192.0]);
        let mut params = common::random_params(random, side);
        let notation = params.notation;
        for layer in &mut params.layers {
            if random.chance(0.4) {
                layer.detail = random_detail(random, layer.radius);
            }
            if random.chance(0.05) {
                layer.radius = random.log_between(if notation == Notation::Px { 1.0 } else { 0.01 }, 8192.0);
            }
            if random.chance(0.05) {
                layer.cell_count = Some(random.log_between(1.0, 4.0e9) as u32);
            }
        }
        let pixels = params.pixels() as f64;
        if pixels < 1.0e5 && random.chance(0.9) {
            continue;
        }
        let sites = |layer| pixels / params.layer_in_px(layer).radius.max(1.0).powi(2);
        // A disc of large radius is stamped word by word.
        if params.layers.iter().map(sites).sum::<f64>() < 4.0e5 && pixels * (params.layers.len() as f64) < 7.0e7 {
            return params;
        }
    }
}

/// Another edit of a field: what stays in the cache is another each time.
fn edit(random: &mut Random, params: &mut Params) {
    match random.below(8) {
        0 => params.seed = params.seed.wrapping_add(1),
        1 => *params = random_params(random),
        2 if !params.layers.is_empty() => {
            let index = random.below(params.layers.len());
            params.layers.remove(index);
        }
        kind if !params.layers.is_empty() => {
            let index = random.below(params.layers.len());
            let layer = &mut params.layers[index];
            match kind {
                3 => layer.detail = random_detail(random, layer.radius),
                4 => layer.area_fraction = random.unit(),
                5 => layer.weathering = random.unit(),
                6 => layer.height[0] = 3.0,
                _ => layer.cell_count = random.chance(0.5).then(|| random.log_between(1.0, 1.0e4) as u32),
            }
        }
        _ => {}
    }
}

/// A triangle or none, in flat numbers.
fn footprint(random: &mut Random, params: &Params) -> Vec<f64> {
    if random.chance(0.8) {
        return Vec::new();
    }
    let [w, h] = [params.image_width, params.image_height].map(f64::from);
    let reach = random.pick(&[1.0, 3.0]);
    (0..3).flat_map(|_| [w * reach * (random.unit() - 0.2), h * reach * (random.unit() - 0.2)]).collect()
}

/// Estimate over real peak of a case's runs that were not tiny; what went wrong, if anything did.
fn ratios(case: u64, budget: u64) -> Result<Vec<f64>, String> {
    let random = &mut Random(case);
    let mut params = random_params(random);
    let mut generator = Generator::new();
    let meter = Meter::new(&ALLOCATED);
    let mut ratios = Vec::new();
    for run in 0..3 {
        generator.set_footprint(&footprint(random, &params)).unwrap();
        let (real, outcome) = meter.measure(&mut generator, &params, budget);
        let estimate = match outcome {
            Ok(estimate) => estimate,
            Err(Error::OverBudget { estimate, .. }) => estimate,
            Err(error) => return Err(format!("{error}")),
        };
        let told = |what: &str| {
            format!("case {case}, run {run}: {what}: estimate {estimate}, real {real}\n  {}", link(&params))
        };
        if outcome.is_err() {
            if estimate <= budget || real as u64 > budget {
                return Err(told("refused too late, or for nothing"));
            }
        } else if real >= TINY || estimate >= TINY as u64 {
            let ratio = estimate as f64 / real as f64;
            ratios.push(ratio);
            if !(1.0..=2.0).contains(&ratio) {
                return Err(told("untrue"));
            }
        }
        edit(random, &mut params);
    }
    Ok(ratios)
}

/// Prints the distribution; panics with what went wrong.
fn check(cases: impl Iterator<Item = u64>, budget: u64) {
    let (mut all, mut wrong) = (Vec::new(), Vec::new());
    for case in cases {
        match ratios(case, budget) {
            Ok(ratios) => all.extend(ratios),
            Err(text) => wrong.push(text),
        }
    }
    all.sort_by(f64::total_cmp);
    let at = |share: f64| all[((all.len() - 1) as f64 * share) as usize];
    let [min, p1, median, p99, max] = [0.0, 0.01, 0.5, 0.99, 1.0].map(at);
    let distribution = format!("{} runs: {min:.3} {p1:.3} {median:.3} {p99:.3} {max:.3}", all.len());
    println!("{distribution}");
    assert!(wrong.is_empty(), "{} wrong, {distribution}\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn the_estimate_lies_between_the_peak_and_twice_it_for_any_parameters() {
    // Behind the first ones, those that once were untrue: few sites that stand before clear pixels are listed; runs that select nothing;
    // a cache that is dropped, or sites and selections that took most, before many rocks are copied out.
    let once_untrue = [338, 2231, 2560, 4620, 6200, 7498, 7887, 7944, 8935, 22944, 23833, 25481, 27076, 29805];
    check((0..300).chain(once_untrue), 100 << 20);
}

#[test]
#[ignore = "takes about half an hour; run it after changing what a stage allocates"]
fn the_estimate_lies_between_the_peak_and_twice_it_for_ten_thousand_parameters() {
    check(ten_thousand_seeds(0), 1 << 30);
}
