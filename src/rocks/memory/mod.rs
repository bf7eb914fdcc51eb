//! Estimates the memory that a run needs: before anything is allocated, and again whenever more about the run is known.

mod expect;
mod need;

use crate::error::Error;
use crate::params::{Darts, Params};

pub(super) use expect::{coarsest_first, expected_sites};
use need::CLEAR;
pub(super) use need::{Bitmaps, Counts, Load, Need, bytes};

/// An estimate of a run's peak memory, and the parameter that would lower it most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryEstimate {
    /// Bytes at the peak of a run, output included.
    pub bytes: u64,
    /// The parameter that would save most: either the image's longer side, by halving it, or the radius of one layer,
    /// by doubling it.
    pub key: &'static str,
}

impl MemoryEstimate {
    /// # Errors
    /// Returns [`Error::OverBudget`] if the estimate exceeds the budget.
    pub fn check(self, budget: u64) -> Result<(), Error> {
        if self.bytes > budget {
            return Err(Error::OverBudget { key: self.key, estimate: self.bytes, budget });
        }
        Ok(())
    }
}

/// Estimates the peak memory of a run from its parameters alone: the generator's own memory, and a second copy of the
/// buffers, because they are copied to JavaScript.
///
/// For usual fields the estimate lies between the real peak and twice the peak (`tests/memory.rs`). But the number of
/// rocks that fit between coarser ones is only an expected value, and if a few cells decide about much ground, the real
/// number may be different. A run therefore repeats the estimate before its stages allocate, with the numbers known by
/// then and the memory already held: before clear pixels are listed, when the sites are known, and when the rocks are
/// known. [`crate::rocks::Generator::estimate`] is the largest of these estimates. It lies between the real peak and
/// twice the peak for any parameters, whether the generator is fresh or has run before, unless both are below 4 MiB
/// (`tests/memory_random.rs`). If an estimate exceeds the budget, the run ends with [`Error::OverBudget`] before the
/// stage in question has allocated anything.
pub fn memory_estimate(params: &Params) -> MemoryEstimate {
    estimate_before(params, true)
}

/// Refuses, before a run begins, what would exceed the budget whatever is cached. `open` says that nothing stands on
/// the ground that could keep rocks away.
///
/// # Errors
/// Returns [`Error::OverBudget`] if the estimate exceeds the budget.
pub(crate) fn check_before(params: &Params, open: bool, budget: u64) -> Result<(), Error> {
    estimate_before(params, open && is_usual(params)).check(budget)
}

/// Whether the expected number of rocks can be relied on: the layers are few, dense, and coarser than pixels.
fn is_usual(params: &Params) -> bool {
    let side = params.image_width.min(params.image_height);
    let is_coarse = |layer| params.layer_in_px(layer).radius >= 2.0;
    let is_dense = params.packing >= 0.5 && params.darts == Darts::Saturate;
    is_dense && side >= 100 && params.layers.len() <= 4 && params.layers.iter().all(is_coarse)
}

/// Estimates the memory of a whole run, with its rocks if `rocks` is true, and otherwise without them.
fn estimate_before(params: &Params, rocks: bool) -> MemoryEstimate {
    let bytes = |params: &Params| {
        let mut counts = expect::expect(params);
        if !rocks {
            counts.iter_mut().for_each(Counts::without_rocks);
        }
        let layers: Vec<Load> = counts.into_iter().map(Load::all).collect();
        let jams = params.layers.iter().any(|layer| expect::may_jam(params, params.layer_in_px(layer).radius));
        let clear = if jams { CLEAR * params.pixels() as f64 } else { 0.0 };
        Need::of(0.0, params, &layers, [0.0; 3], Bitmaps { clear, selects: true }).bytes(0.0)
    };
    let [width, height] = [params.image_width, params.image_height];
    // First candidate: half the longer side.
    let (key, changed) = if height > width {
        ("imageHeight", Params { image_height: height.div_ceil(2), ..params.clone() })
    } else {
        ("imageWidth", Params { image_width: width.div_ceil(2), ..params.clone() })
    };
    let mut best = (bytes(&changed), key);
    for k in 0..params.layers.len() {
        let mut changed = params.clone();
        changed.layers[k].radius *= 2.0;
        let bytes = bytes(&changed);
        if bytes < best.0 {
            best = (bytes, "radius");
        }
    }
    MemoryEstimate { bytes: bytes(params), key: best.1 }
}
