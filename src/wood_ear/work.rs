//! Estimates how much of a run is done after its preview, from what its parts cost relative to each other, so that
//! progress grows evenly with time.

use crate::params::wood_ear::{Collisions, Params};

/// The parts of a run that are left after the preview, in the order in which they are done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Part {
    /// The individuals' models or boxes are made.
    Models,
    /// Pairs are solved until none crosses.
    Pairs,
    /// Bodies are posed and shaded after their collisions.
    Bodies,
    /// The pairs that cross in the buffers are counted.
    Count,
}

/// The cost of every [`Part`], in ms on a desktop computer. Only their ratios matter.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Work([f64; 4]);

/// Costs of an individual: its model with its boxes (the thesis's rule); its boxes alone (our rule); its body posed,
/// shaded and boxed; its body shaded and boxed, if it is posed already; and posing it outside the log.
const MODEL: f64 = 0.03;
const BOXES: f64 = 0.016;
const BODY: f64 = 0.04;
const SHADED: f64 = 0.027;
const CLEARED: f64 = 0.11;
/// Costs of a pair: testing it once; solving it by the thesis's rule, for each pair of the individual, because sheets
/// that overlap deeper take more rounds; and solving it by our rule. `PARTED` is the share of pairs whose two bodies
/// our rule poses again.
const TESTED: f64 = 0.004;
const SOLVED: f64 = 0.0125;
const PRESSED: f64 = 0.022;
const PARTED: f64 = 0.15;

/// Expected number of pairs of an individual whose boxes overlap, each pair counted once: its neighbours within the
/// width of a wood ear.
pub(super) fn pairs_each(params: &Params, individuals: f64) -> f64 {
    let near = 16.0 * params.size * params.size * params.density / (87.0 * params.log.spacing * params.log.spacing);
    0.5 * near.min(individuals)
}

impl Work {
    pub(super) fn of(params: &Params, individuals: usize) -> Self {
        let individuals = individuals as f64;
        let each = pairs_each(params, individuals);
        let pairs = individuals * each;
        let cleared = if params.clear_log { CLEARED } else { 0.0 };
        let (model, pair, body, tested) = match params.collisions {
            Collisions::Off => (0.0, 0.0, BODY + cleared, TESTED),
            Collisions::Thesis => (MODEL, SOLVED * each, BODY + cleared, TESTED),
            // A pair that is separated by a plane needs no further test.
            Collisions::Pressed => (BOXES + cleared, PRESSED + 2.0 * PARTED * cleared, SHADED, 0.0),
        };
        // This is never 0, because a share of it is computed even if there are no individuals.
        Work([individuals * model, pairs * pair, individuals * body + f64::MIN_POSITIVE, pairs * tested])
    }

    /// The share of all work, 0 … 1, that is done when `share` of `part` is done.
    pub(super) fn done(&self, part: Part, share: f64) -> f64 {
        let at = part as usize;
        let before: f64 = self.0[..at].iter().sum();
        (before + share * self.0[at]) / self.0.iter().sum::<f64>()
    }
}

/// Share of the pairs' work that is done in the first sweep. Later sweeps only look again at bodies that have moved.
const FIRST_SWEEP: f64 = 0.98;

/// The share of the pairs' work that is done after `sweeps` whole sweeps and the share `within` of the next one.
pub(super) fn swept(sweeps: u32, within: f64) -> f64 {
    1.0 - (1.0 - FIRST_SWEEP * within) * (1.0 - FIRST_SWEEP).powi(sweeps as i32)
}

/// Counts operations in tests, weighted by the nanoseconds they take, so that progress can be compared with them
/// without a clock.
#[inline(always)]
pub(super) fn tally(_nanoseconds: usize) {
    #[cfg(test)]
    tests::TALLY.set(tests::TALLY.get() + _nanoseconds as u64);
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use std::cell::Cell;

    use super::super::Generator;
    use crate::params::wood_ear::{Collisions, Params, Stage};

    thread_local! {
        pub(super) static TALLY: Cell<u64> = const { Cell::new(0) };
    }

    /// What a run reports at one moment: its stage; the operations since the stage began, still to come, and in all
    /// from the stage's start on; and the operations still to come as foretold from the pace of the stage so far, in
    /// the way of www/generator/estimate.ts.
    struct Told {
        stage: Stage,
        done: f64,
        left: f64,
        all: f64,
        foretold: f64,
    }

    fn run(params: &Params) -> Vec<Told> {
        let mut generator = Generator::new();
        generator.start(params.clone(), u64::MAX).unwrap();
        TALLY.set(0);
        let mut reports = vec![(generator.stage(), generator.progress(), 0)];
        while !generator.step().unwrap() {
            reports.push((generator.stage(), generator.progress(), TALLY.get()));
        }
        let total = TALLY.get();
        let mut began = reports[0];
        let told = reports.iter().map(|&(stage, fraction, at)| {
            assert!(fraction >= began.1 && fraction <= 1.0, "{params:?}: {fraction} after {}", began.1);
            if stage != began.0 {
                began = (stage, fraction, at);
            }
            let [done, left, all] = [at - began.2, total - at, total - began.2].map(|n| n as f64);
            Told { stage, done, left, all, foretold: (1.0 - fraction) * done / (fraction - began.1).max(1.0e-12) }
        });
        told.collect()
    }

    /// Small colonies with the densities of the default, of the maximum and of the slowest settings.
    fn settings() -> Vec<Params> {
        let mut all = Vec::new();
        for collisions in [Collisions::Thesis, Collisions::Pressed] {
            for clear_log in [false, true] {
                for (spacing, density, size, size_spread) in
                    [(3.0, 50.0, 2.0, 1.5), (3.0, 100.0, 3.0, 2.0), (1.5, 50.0, 3.0, 2.0)]
                {
                    let mut params =
                        Params { collisions, clear_log, density, size, size_spread, ..Params::with_defaults() };
                    params.range = if spacing < 2.0 { 20.0 } else { 32.0 };
                    params.log.spacing = spacing;
                    all.push(params);
                }
            }
        }
        all
    }

    #[test]
    fn what_a_run_foretells_is_within_half_of_what_comes() {
        std::thread::scope(|scope| {
            for params in settings() {
                scope.spawn(move || check(&params));
            }
        });
    }

    fn check(params: &Params) {
        let mut worst = (0.0, String::new());
        for Told { stage, done, left, all, foretold } in run(params) {
            // In the first tenth of the work the forecast may be off by a factor of two, later by half. A difference of
            // less than a twentieth of all work is a second or two, and is accepted.
            let bound: f64 = if done < 0.1 * all { 2.0 } else { 1.5 };
            if stage != Stage::Collide || done < 0.05 * all || (foretold - left).abs() < 0.05 * all {
                continue;
            }
            let off = (foretold / left).ln().abs() / bound.ln();
            if off > worst.0 {
                worst = (off, format!("foretold {foretold:.0}, came {left:.0} after {done:.0} of {all:.0}"));
            }
        }
        assert!(worst.0 <= 1.0, "{}, {params:?}", worst.1);
    }
}
