//! Computes the bytes that a run needs from the sizes of its results.

use crate::params::{Crossing, Params};

/// Bytes of a wasm instance before its first run: stack and static data.
const INSTANCE: f64 = 1.2e6;

/// Size of the heap relative to its contents after several runs. The memory of a wasm instance never shrinks.
const HOLES: f64 = 1.12;

/// Bytes per pixel, of a flag and of what is needed to find the clear pixels ([`super::super::bitmap::ClearPixels`]).
const FLAG: f64 = 1.0 / 8.0;
pub(super) const CLEAR: f64 = 0.15;

/// Largest average number of vertices of a layer's cells (Euler's formula).
const MOST_CORNERS: f64 = 6.0;

/// Sizes of one layer's results, either counted or expected.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::rocks) struct Counts {
    pub(in crate::rocks) sites: f64,
    /// Number of vertices of all cells.
    pub(in crate::rocks) corners: f64,
    pub(in crate::rocks) rocks: f64,
    /// Number of vertices of the cells on which rocks stand.
    pub(in crate::rocks) rims: f64,
    /// Number of vertices of all rocks in the buffers.
    pub(in crate::rocks) vertices: f64,
    pub(in crate::rocks) triangles: f64,
    /// Number of vertices of the largest rock that is cut.
    pub(in crate::rocks) largest: f64,
}

impl Counts {
    pub(super) fn without_rocks(&mut self) {
        *self = Counts { sites: self.sites, corners: self.corners, ..Counts::default() };
    }
}

/// The sizes of a layer's results, and which of them still have to be made.
#[derive(Debug, Clone, Copy)]
pub(in crate::rocks) struct Load {
    pub(in crate::rocks) counts: Counts,
    pub(in crate::rocks) sites: bool,
    pub(in crate::rocks) cells: bool,
    pub(in crate::rocks) shapes: bool,
}

impl Load {
    pub(super) fn all(counts: Counts) -> Self {
        Load { counts, sites: true, cells: true, shapes: true }
    }
}

/// What a run uses bitmaps for.
#[derive(Debug, Clone, Copy)]
pub(in crate::rocks) struct Bitmaps {
    /// Bytes needed to find the clear pixels, if darts go on until that is necessary. If few sites fill the image,
    /// chance decides whether that happens and how many pixels are clear; the run reports it then.
    pub(in crate::rocks) clear: f64,
    /// Whether cells are selected and flagged.
    pub(in crate::rocks) selects: bool,
}

/// Bytes that the rest of a run needs.
#[derive(Debug, Clone, Copy)]
pub(in crate::rocks) struct Need {
    /// Bytes at the peak, before the buffers are copied out.
    peak: f64,
    /// Bytes at the peak of the stages before the number of rocks is known.
    pub(in crate::rocks) until_selection: f64,
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
/// | a vertex of the largest rock that is cut | – | 120, as it is worn |
/// | a rock in the buffers, while rocks are drawn apart | – | 72, and 5.5 per vertex |
/// | copies for the caller | 8 + 4 + c·8 per site, 4 + its buffers per rock | c·8 per site |
impl Need {
    /// Computes what is needed. `held` bytes are in the cache already; `buffers` holds how many of them positions,
    /// normals and indices take.
    #[inline(never)]
    pub(in crate::rocks) fn of(
        held: f64,
        params: &Params,
        layers: &[Load],
        buffers: [f64; 3],
        bitmaps: Bitmaps,
    ) -> Self {
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
        let apart =
            if params.crossing == Crossing::Apart { 5.5 * vertices + 72.0 * sum(|counts| counts.rocks) } else { 0.0 };
        peak = peak.max(kept + apart + 120.0 * most(|counts| counts.largest));
        peak = peak.max(kept + most(|counts| counts.sites)).max(kept + 8.0 * most(|counts| counts.corners));
        let copies = sum(|counts| 12.0 * counts.sites + 8.0 * counts.corners + 13.0 * counts.rocks);
        Need { peak, until_selection, copies: copies + 24.0 * vertices + 12.0 * triangles }
    }

    /// The whole estimate, bytes, if the peak has been `before` bytes so far.
    pub(in crate::rocks) fn bytes(&self, before: f64) -> u64 {
        (INSTANCE + HOLES * self.peak.max(before) + self.copies) as u64
    }
}

/// Bytes that a list has allocated, whether they are filled or not.
pub(in crate::rocks) fn bytes<T>(list: &Vec<T>) -> usize {
    list.capacity() * size_of::<T>()
}
