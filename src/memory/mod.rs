//! Estimates the memory that a run needs: before anything is allocated, and again whenever more about the run is known.

mod expect;

use crate::error::Error;
use crate::params::{Darts, Params};

pub(crate) use expect::{coarsest_first, expected_sites};

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

/// Bytes of a wasm instance before its first run: stack and static data.
const INSTANCE: f64 = 1.2e6;

/// Size of the heap relative to its contents after several runs. The memory of a wasm instance never shrinks.
const HOLES: f64 = 1.12;

/// Bytes per pixel, of a flag and of what is needed to find the clear pixels ([`crate::bitmap::ClearPixels`]).
const FLAG: f64 = 1.0 / 8.0;
const CLEAR: f64 = 0.15;

/// Largest average number of vertices of a layer's cells (Euler's formula).
const MOST_CORNERS: f64 = 6.0;

/// Sizes of one layer's results, either counted or expected.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Counts {
    pub(crate) sites: f64,
    /// Number of vertices of all cells.
    pub(crate) corners: f64,
    pub(crate) rocks: f64,
    /// Number of vertices of the cells on which rocks stand.
    pub(crate) rims: f64,
    /// Number of vertices of all rocks in the buffers.
    pub(crate) vertices: f64,
    pub(crate) triangles: f64,
}

impl Counts {
    fn without_rocks(&mut self) {
        *self = Counts { sites: self.sites, corners: self.corners, ..Counts::default() };
    }
}

/// The sizes of a layer's results, and which of them still have to be made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Load {
    pub(crate) counts: Counts,
    pub(crate) sites: bool,
    pub(crate) cells: bool,
    pub(crate) shapes: bool,
}

impl Load {
    fn all(counts: Counts) -> Self {
        Load { counts, sites: true, cells: true, shapes: true }
    }
}

/// What a run uses bitmaps for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bitmaps {
    /// Bytes needed to find the clear pixels, if darts go on until that is necessary. If few sites fill the image,
    /// chance decides whether that happens and how many pixels are clear; the run reports it then.
    pub(crate) clear: f64,
    /// Whether cells are selected and flagged.
    pub(crate) selects: bool,
}

/// Bytes that the rest of a run needs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Need {
    /// Bytes at the peak, before the buffers are copied out.
    peak: f64,
    /// Bytes at the peak of the stages before the number of rocks is known.
    pub(crate) until_selection: f64,
    /// Bytes of the copies of the buffers.
    copies: f64,
}

/// The peak is the largest of the peaks of all stages, each together with what the stages before it keep:
///
/// | bytes for | kept afterwards | in addition, while the stage runs |
/// |---|---|---|
/// | a pixel | – | 1/8 for its flag; 0.15 to find the last clear pixels |
/// | a site | 4 | 13 while they are sorted into buckets |
/// | its cell, with c vertices (under 6) | 4 + c·(16 + 4) + 8 | (6 − c)·(16 + 4) + c·16, as the lists are cut to size |
/// | a cell, while cells are selected | – | 8 + 1/8 |
/// | a rock of c corners: p_add and 3c − 2 triangles | 12 + c·16 + (3c − 2)·6 | 4, and 4 per site |
/// | its 2c vertices and 3c − 2 triangles in the buffers, more of them with detail | 24 per vertex, 12 per triangle, 9 per rock | what a buffer had before it grew |
/// | copies for the caller | 8 + 4 + c·8 per site, 4 + its buffers per rock | c·8 per site |
impl Need {
    /// Computes what is needed. `held` bytes are in the cache already; `buffers` holds how many of them positions,
    /// normals and indices take.
    #[inline(never)]
    pub(crate) fn of(held: f64, params: &Params, layers: &[Load], buffers: [f64; 3], bitmaps: Bitmaps) -> Self {
        let pixels = params.pixels() as f64;
        let mut kept = held;
        let mut peak = held;
        for Load { counts, .. } in layers.iter().filter(|load| load.sites) {
            peak = peak.max(kept + FLAG * pixels + bitmaps.clear + counts.sites * 4.0).max(kept + counts.sites * 17.0);
            kept += counts.sites * 4.0;
        }
        for Load { counts: Counts { sites, corners, .. }, .. } in layers.iter().filter(|load| load.cells) {
            peak = peak.max(kept + sites * (12.0 + 20.0 * MOST_CORNERS) + 16.0 * corners);
            kept += sites * 12.0 + corners * 20.0;
        }
        let most = |of: fn(&Counts) -> f64| layers.iter().fold(0.0_f64, |most, load| most.max(of(&load.counts)));
        if bitmaps.selects && !layers.is_empty() {
            peak = peak.max(kept + FLAG * pixels + most(|counts| counts.sites) * 8.125);
        }
        let until_selection = peak;
        for Load { counts: Counts { sites, rocks, rims, .. }, .. } in layers.iter().filter(|load| load.shapes) {
            let shapes = rocks * 12.0 + 16.0 * rims + (3.0 * rims - 2.0 * rocks) * 6.0;
            // The lists have room for slightly more than six corners per rock.
            let room = rocks * 12.0 + 6.125 * rocks * 34.0;
            peak = peak.max(kept + shapes.max(room) + sites * 4.0);
            kept += shapes;
        }
        let sum = |of: fn(&Counts) -> f64| layers.iter().map(|load| of(&load.counts)).sum::<f64>();
        let [vertices, triangles] = [sum(|counts| counts.vertices), sum(|counts| counts.triangles)];
        for (old, new) in buffers.into_iter().zip([12.0 * vertices, 12.0 * vertices, 12.0 * triangles]) {
            if new > old {
                peak = peak.max(kept + new);
                kept += new - old;
            }
        }
        kept += sum(|counts| counts.rocks) * 9.0;
        peak = peak.max(kept + most(|counts| counts.sites)).max(kept + 8.0 * most(|counts| counts.corners));
        let copies = sum(|counts| 12.0 * counts.sites + 8.0 * counts.corners + 13.0 * counts.rocks);
        Need { peak, until_selection, copies: copies + 24.0 * vertices + 12.0 * triangles }
    }

    /// The whole estimate, bytes, if the peak has been `before` bytes so far.
    pub(crate) fn bytes(&self, before: f64) -> u64 {
        (INSTANCE + HOLES * self.peak.max(before) + self.copies) as u64
    }
}
