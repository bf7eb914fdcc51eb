//! Stage 3: exclusive selection (journal §3.2, Fig. 7).

use super::bitmap::Bitmap;
use super::paint::Paint;
use super::sites::Sites;
use super::spans::PixelSpans;
use super::voronoi::Cells;
use crate::rng::{Purpose, Stream};

/// How much of a layer is selected (decision A7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// Select until the cells own this share of the image's pixels: A_s, 0 … 1.
    Area(f64),
    /// Select this number of cells.
    Count(u32),
}

/// The cells of one layer on which rocks will stand.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Selection {
    /// Site indices of the selected cells, in the order in which they were granted.
    pub selected: Vec<u32>,
    /// Number of pixels that these cells own.
    pub pixels: u64,
    /// True if the layer ran out of cells before the threshold was reached.
    pub saturated: bool,
}

impl Selection {
    /// Share of the image's pixels that the selected cells own, 0 … 1 (decision A9).
    pub(super) fn area_reached(&self, sites: &Sites) -> f64 {
        // Until a run reaches the layer, the image has no pixels; `max(1.0)` avoids dividing by 0.
        self.pixels as f64 / (f64::from(sites.width) * f64::from(sites.height)).max(1.0)
    }
}

/// Selects cells of one layer whose pixels are all free, in random order, until the threshold is reached.
///
/// Cells of a layer share no pixel, so whether a cell is free does not depend on the visiting order. The order only
/// decides where the threshold cuts. Therefore cells are examined in batches, each in the order in which they lie in
/// memory.
#[derive(Debug)]
pub(crate) struct Selector {
    order: Vec<u32>,
    threshold: Threshold,
    drop_border: bool,
    spans: PixelSpans,
    /// Number of cells of the visiting order that have been granted or refused.
    decided: usize,
    /// End of the current batch in the visiting order.
    batch_end: usize,
    /// One bit per cell, set if the cell is to be examined in the current batch.
    batch: Vec<u64>,
    word: usize,
    /// Per cell, its number of pixels once it has been examined, or 0 if one of them is not free.
    free_pixels: Vec<u32>,
    /// How many cells of the visiting order are granted where nothing is painted. `None` if nothing is.
    cut: Option<u32>,
    selection: Selection,
}

impl Selector {
    pub(crate) fn new(cells: &Cells, threshold: Threshold, drop_border: bool, seed: u32, layer: u32) -> Self {
        Selector::with_order(cells, threshold, drop_border, visiting_order(cells.len() as u32, seed, layer))
    }

    pub(crate) fn with_order(cells: &Cells, threshold: Threshold, drop_border: bool, order: Vec<u32>) -> Self {
        let words = cells.len().div_ceil(64);
        Selector {
            order,
            threshold,
            drop_border,
            spans: PixelSpans::default(),
            decided: 0,
            batch_end: 0,
            batch: vec![0; words],
            word: words,
            free_pixels: vec![0; cells.len()],
            cut: None,
            selection: Selection::default(),
        }
    }

    /// Selects what paint allows, where `open` is selected without it: every cell of the visiting order is decided
    /// about, so that no cell depends on what is painted far away.
    pub(crate) fn paint_over(&mut self, open: &Selection) {
        self.threshold = Threshold::Count(u32::MAX);
        // Until a cell has been examined, its place in the order stands where its number of pixels will.
        for (rank, &site) in (0..).zip(&self.order) {
            self.free_pixels[site as usize] = rank;
        }
        let last = open.selected.last().map_or(0, |&site| 1 + self.free_pixels[site as usize]);
        self.cut = Some(if open.saturated { self.order.len() as u32 } else { last });
    }

    /// Marks the next batch of cells: first an eighth of all, then as many as will probably be needed.
    fn mark_batch(&mut self, area: f64) {
        let (all, left) = (self.order.len(), self.order.len() - self.decided);
        let wanted = if self.decided == 0 {
            all.div_ceil(8)
        } else {
            let per_cell = self.granted() / self.decided as f64;
            // The quotient is infinite if nothing has been granted yet.
            ((1.02 * (self.wanted(area) - self.granted()) / per_cell) as usize).saturating_add(16)
        };
        self.batch_end = self.decided + wanted.min(left);
        for &site in &self.order[self.decided..self.batch_end] {
            self.batch[site as usize / 64] |= 1 << (site % 64);
        }
        self.word = 0;
    }

    /// The threshold as a number: of pixels, or of cells.
    fn wanted(&self, area: f64) -> f64 {
        match self.threshold {
            Threshold::Area(fraction) => fraction * area,
            Threshold::Count(count) => f64::from(count),
        }
    }

    /// What has been granted so far, in the same unit as [`Selector::wanted`].
    fn granted(&self) -> f64 {
        match self.threshold {
            Threshold::Area(_) => self.selection.pixels as f64,
            Threshold::Count(_) => self.selection.selected.len() as f64,
        }
    }

    /// Examines about `count` more cells. Returns true when all have been examined or the threshold is reached.
    #[inline(never)]
    pub(crate) fn advance(
        &mut self,
        sites: &Sites,
        cells: &Cells,
        taken: &Bitmap,
        count: usize,
        (paint, layer): (&Paint, u32),
    ) -> bool {
        let mut looked_at = 0;
        loop {
            while let Some(&bits) = self.batch.get(self.word) {
                if looked_at >= count {
                    return false;
                }
                let mut bits = bits;
                looked_at += bits.count_ones() as usize;
                while bits != 0 {
                    let site = 64 * self.word + bits.trailing_zeros() as usize;
                    bits &= bits - 1;
                    let is_allowed = self
                        .cut
                        .is_none_or(|cut| paint.allows(layer, sites, cells, site, [self.free_pixels[site], cut]));
                    self.free_pixels[site] =
                        if is_allowed { self.free_pixels_of(sites, cells, taken, site) } else { 0 };
                }
                self.batch[self.word] = 0;
                self.word += 1;
            }
            let area = f64::from(sites.width) * f64::from(sites.height);
            if self.decide(area) {
                return true;
            }
            self.mark_batch(area);
        }
    }

    fn free_pixels_of(&mut self, sites: &Sites, cells: &Cells, taken: &Bitmap, i: usize) -> u32 {
        let pixel = sites.pixels[i];
        // The site's own pixel always belongs to its cell. For most cells under a coarser rock, this test is enough.
        if taken.get(pixel[0].into(), pixel[1].into()) || (self.drop_border && cells.touches_border(i)) {
            return 0;
        }
        self.spans.compute(sites, cells, i);
        self.spans.free_pixels(pixel, taken)
    }

    /// Grants the cells that have been examined, in visiting order. Returns true when the selection is complete.
    fn decide(&mut self, area: f64) -> bool {
        loop {
            // The threshold is tested before each cell, and the last cell is taken whole (decision A7).
            if self.granted() >= self.wanted(area) {
                return true;
            }
            if self.decided == self.order.len() {
                self.selection.saturated = true;
                return true;
            }
            if self.decided == self.batch_end {
                return false;
            }
            let site = self.order[self.decided];
            self.decided += 1;
            let pixels = self.free_pixels[site as usize];
            if pixels > 0 {
                self.selection.selected.push(site);
                self.selection.pixels += u64::from(pixels);
            }
        }
    }

    pub(crate) fn progress(&self) -> f64 {
        self.decided as f64 / self.order.len().max(1) as f64
    }

    pub(crate) fn finish(mut self) -> Selection {
        self.selection.selected.shrink_to_fit();
        self.selection
    }
}

/// Flags the pixels of the selected cells in `taken`.
pub(crate) fn flag(sites: &Sites, cells: &Cells, selected: &[u32], taken: &mut Bitmap) {
    let mut spans = PixelSpans::default();
    for &site in selected {
        spans.compute(sites, cells, site as usize);
        for (row, first, last) in spans.spans(sites.pixels[site as usize]) {
            taken.fill_span(row, first, last);
        }
    }
}

/// A random permutation of the cells (decision A7). The order of creation would favour large cells.
fn visiting_order(count: u32, seed: u32, layer: u32) -> Vec<u32> {
    let mut stream = Stream::new(seed, Purpose::VisitingOrder, layer, 0);
    let mut order: Vec<u32> = (0..count).collect();
    for last in (1..count).rev() {
        order.swap(last as usize, stream.below(last + 1) as usize);
    }
    order
}

/// Selects from several layers with given visiting orders. The layers must be in descending order of mean cell area;
/// the result has one selection per layer, in the same order.
pub fn select(layers: &[(&Sites, &Cells, Vec<u32>, Threshold)]) -> Vec<Selection> {
    let Some((first, ..)) = layers.first() else { return Vec::new() };
    let mut taken = Bitmap::new(first.width, first.height);
    layers
        .iter()
        .map(|(sites, cells, order, threshold)| {
            let mut selector = Selector::with_order(cells, *threshold, false, order.clone());
            selector.advance(sites, cells, &taken, usize::MAX / 2, (&Paint::default(), 0));
            let selection = selector.finish();
            flag(sites, cells, &selection.selected, &mut taken);
            selection
        })
        .collect()
}
