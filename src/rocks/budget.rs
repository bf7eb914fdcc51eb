//! The memory of a run. It is estimated again each time more of the run's numbers are known.

use super::cache::{LayerCache, Results};
use super::memory::{Bitmaps, Load, MemoryEstimate, Need, expected_sites, memory_estimate};
use crate::error::Error;
use crate::params::Params;

/// How much a run knows about the sizes of its results.
#[derive(Debug, Clone, Copy, Default, PartialEq, PartialOrd)]
pub(super) enum Known {
    #[default]
    Nothing,
    Sites,
    Rocks,
}

/// The budget of a run, and its memory estimate so far.
#[derive(Debug, Default)]
pub(super) struct Budget {
    max_bytes: u64,
    /// What was known about the run when its memory was last estimated.
    checked: Known,
    /// Peak memory so far, bytes: of what the previous run left behind, and of this run's stages up to the selection.
    peak_before: f64,
    /// True once this run has made a selection.
    pub(super) selects: bool,
    /// The most bytes that this run has used to list clear pixels.
    pub(super) clear_bytes: f64,
    /// The largest memory estimate of this run, bytes.
    pub(super) estimate: u64,
}

impl Budget {
    /// Begins the budget of a run that starts with `held` bytes of older results.
    pub(super) fn new(max_bytes: u64, held: f64) -> Self {
        Budget { max_bytes, peak_before: held, ..Budget::default() }
    }

    /// Repeats the estimate with what is known now. Called before a stage allocates; `given` is the memory of what
    /// was given beside the parameters, bytes. Returns [`Error::OverBudget`] if the new estimate is above the budget.
    #[inline(never)]
    pub(super) fn check(
        &mut self,
        known: Known,
        params: &Params,
        results: &mut Results,
        given: usize,
    ) -> Result<(), Error> {
        if known != Known::Nothing && known <= self.checked {
            return Ok(());
        }
        let load = |cache: &LayerCache| {
            let expected = cache.layer.as_ref().map_or(0.0, |layer| expected_sites(params, layer.radius));
            cache.load(params, expected, known == Known::Rocks)
        };
        let loads: Vec<Load> = results.layers.iter().filter_map(load).collect();
        let bitmaps = Bitmaps { clear: self.clear_bytes, selects: self.selects || known != Known::Rocks };
        let of = |results: &Results| {
            let held = results.bytes() + given as f64;
            Need::of(held, params, &loads, results.mesh.bytes().map(|bytes| bytes as f64), bitmaps)
        };
        let mut need = of(results);
        if need.bytes(0.0) > self.max_bytes {
            // The rocks of the previous run would be overwritten later anyway, so their memory is freed now.
            results.forget_mesh();
            need = of(results);
        }
        let bytes = need.bytes(0.0);
        self.peak_before = self.peak_before.max(need.until_selection);
        self.estimate = self.estimate.max(need.bytes(self.peak_before));
        if bytes > self.max_bytes {
            return MemoryEstimate { bytes, ..memory_estimate(params) }.check(self.max_bytes);
        }
        self.checked = known;
        Ok(())
    }
}
