//! Stage 1: dart throwing on a bitmap (journal §3.1, Fig. 4, Eq. 1).

use super::bitmap::{Bitmap, ClearPixels, Disc, Pixel};
use super::grid::Grid;
use crate::rng::{Purpose, Stream};

/// The sites of one layer.
#[derive(Debug, Clone, Default)]
pub struct Sites {
    /// W, px.
    pub width: u32,
    /// H, px.
    pub height: u32,
    /// Disc radius r, px.
    pub radius: f64,
    /// One pixel per site. They are sorted into buckets row by row, so that sites next to each other on the ground are
    /// close together in memory.
    pub pixels: Vec<Pixel>,
    /// N_p of Eq. 1, rounded down (decision A2).
    pub target: u64,
    /// True if no free pixel was left: every pixel of the image is nearer than r to a site.
    pub saturated: bool,
}

impl Sites {
    /// The largest distance of a site's neighbours, px, in a saturated layer: every pixel's centre is nearer than r to
    /// a site, so every point of the image is nearer than r + √½, and a neighbour is at most twice as far away as a
    /// cell vertex.
    pub(crate) fn neighbor_reach(&self) -> f64 {
        2.0 * (self.radius + 0.71)
    }

    /// Sorts the sites into buckets so large that the bucket of a site and the ring around it hold all of the site's
    /// neighbours, in a saturated layer.
    pub(crate) fn grid(&self) -> Grid {
        let side = self.neighbor_reach().ceil().min(f64::from(self.width.max(self.height)));
        Grid::new(self.width, self.height, side as u32, &self.pixels)
    }

    /// Positions as x, y, x, y …, px. They are exact, because they are multiples of ½ below 2¹⁴.
    pub fn positions(&self) -> Vec<f32> {
        self.pixels.iter().flatten().map(|&c| f32::from(c) + 0.5).collect()
    }
}

/// N_p = A·c_d / (π (0.5 r)²) of Eq. 1, before rounding. `area` is in px², `radius` in px.
pub fn target_sites(area: f64, packing: f64, radius: f64) -> f64 {
    let half = 0.5 * radius;
    area * packing / (core::f64::consts::PI * half * half)
}

/// Number of picks in one batch.
const BATCH: u32 = 1024;

/// If a batch has fewer hits than this (about 1.5 %), listing the free pixels and picking among them is cheaper than
/// missing.
const FEW_HITS: u32 = 16;

/// Number of pixels that can be listed in the time of one miss.
const LIST_COST: u64 = 1024;

/// Throws darts at a bitmap until N_p sites stand or no pixel is free.
///
/// Source: journal §3.1, Fig. 4, in reading b of decision A1: the pick is repeated until the number is reached. At c_d
/// = 0.7 that is impossible, so running out of free pixels also ends it. At first, pixels are picked at random and
/// flagged ones are discarded; later, pixels are drawn from a list of the clear ones. Both have the same distribution
/// as picking among the clear pixels all along. With `attempts`, exactly N_p picks are made.
///
/// Cost: O(n·r²/64) bit writes and one pass over the bitmap. The list is never larger than the bitmap.
#[derive(Debug)]
pub(crate) struct DartThrower {
    sites: Sites,
    bitmap: Bitmap,
    disc: Disc,
    stream: Stream,
    /// Number of picks still allowed. `None` unless Fig. 4 is taken literally.
    picks_left: Option<u64>,
    /// The list of clear pixels, present from the second phase on. Some of its entries may have been taken since it was
    /// made.
    free: Option<ClearPixels>,
    /// True if the clear pixels have to be listed, or listed again, before more darts are thrown.
    is_list_due: bool,
    /// Set by the caller to allow listing. While it is false, [`DartThrower::advance`] returns when a list is due.
    pub(crate) may_list: bool,
    /// Number of picks that missed since the clear pixels were listed.
    misses: u32,
    batch: Batch,
}

/// The picks of one batch whose pixels were free when the batch was drawn.
#[derive(Debug)]
struct Batch {
    pixels: [Pixel; BATCH as usize],
    count: usize,
}

impl Batch {
    /// Draws up to `limit` pixels and keeps the free ones, without branching on whether a pixel is free, which is
    /// unpredictable.
    #[inline]
    fn sift(&mut self, bitmap: &Bitmap, stream: &mut Stream, limit: u32, mut draw: impl FnMut(&mut Stream) -> Pixel) {
        // A local copy can be kept in registers.
        let mut own = stream.clone();
        let mut count = 0;
        for _ in 0..limit.min(BATCH) {
            let pixel = draw(&mut own);
            let [x, y] = pixel.map(u32::from);
            self.pixels[count] = pixel;
            count += usize::from(!bitmap.get(x, y));
        }
        self.count = count;
        *stream = own;
    }
}

impl DartThrower {
    /// Prepares to throw darts at an image of this size. `expected` is roughly the number of sites and sets the initial
    /// capacity.
    pub(crate) fn new(
        [width, height]: [u32; 2],
        radius: f64,
        packing: f64,
        attempts: bool,
        [seed, layer]: [u32; 2],
        expected: usize,
    ) -> Self {
        let target = target_sites(f64::from(width) * f64::from(height), packing, radius) as u64;
        let pixels = Vec::with_capacity(expected);
        DartThrower {
            sites: Sites { width, height, radius, pixels, target, saturated: false },
            bitmap: Bitmap::new(width, height),
            disc: Disc::new(radius, width.max(height)),
            stream: Stream::new(seed, Purpose::Darts, layer, 0),
            picks_left: attempts.then_some(target),
            free: None,
            is_list_due: false,
            may_list: false,
            misses: 0,
            batch: Batch { pixels: [[0; 2]; BATCH as usize], count: 0 },
        }
    }

    /// Makes about `picks` picks, at least one. Returns true when the layer is finished, and false when more picks are
    /// needed or a list is due.
    ///
    /// Picks are drawn and filtered in batches: a pixel that is taken when the batch is drawn stays taken, and looking
    /// up many scattered flags at once lets the memory accesses overlap.
    #[inline(never)]
    pub(crate) fn advance(&mut self, mut picks: u32) -> bool {
        while !self.is_finished() {
            if picks == 0 || (self.is_list_due && !self.may_list) {
                return false;
            }
            if core::mem::take(&mut self.is_list_due) {
                self.free = None;
                self.free = Some(self.bitmap.clear_pixels());
                self.misses = 0;
            }
            let limit = self.picks_left.map_or(BATCH, |left| left.min(u64::from(BATCH)) as u32);
            let drawn = match &mut self.free {
                None => {
                    self.batch.sift(&self.bitmap, &mut self.stream, limit, |stream| {
                        stream.pixel(self.sites.width, self.sites.height)
                    });
                    limit
                }
                Some(free) if free.len() == 0 => {
                    self.sites.saturated = true;
                    continue;
                }
                // Every entry of the list is drawn at most once, so this ends.
                Some(free) => {
                    let drawn = limit.min(free.len());
                    self.batch.sift(&self.bitmap, &mut self.stream, drawn, |stream| {
                        let index = stream.below(free.len());
                        free.swap_remove(index)
                    });
                    drawn
                }
            };
            let mut hits = 0;
            for k in 0..core::mem::take(&mut self.batch.count) {
                let pixel = self.batch.pixels[k];
                hits += u32::from(self.try_place(pixel));
                if self.is_finished() {
                    break;
                }
            }
            picks = picks.saturating_sub(drawn);
            match &mut self.picks_left {
                Some(left) => {
                    *left -= u64::from(drawn);
                    // For radii below a pixel N_p grows without bound. Once every pixel is a site, no pick can hit any
                    // more.
                    self.sites.saturated = self.sites.pixels.len() as u64 == self.bitmap.pixels();
                }
                None => {
                    self.misses += drawn - hits;
                    self.is_list_due = match self.free {
                        None => hits < FEW_HITS,
                        Some(_) => 2 * hits < drawn && u64::from(self.misses) > self.bitmap.pixels() / LIST_COST,
                    };
                }
            }
        }
        true
    }

    /// Places a site if the pixel is free, and returns whether it did. Tests call it with given picks.
    #[inline]
    fn try_place(&mut self, pixel: Pixel) -> bool {
        let [x, y] = pixel.map(u32::from);
        if self.bitmap.get(x, y) {
            return false;
        }
        self.sites.pixels.push(pixel);
        self.bitmap.stamp(&self.disc, x, y);
        true
    }

    /// Whether it cannot go on until the caller sets `may_list`.
    pub(crate) fn waits_for_list(&self) -> bool {
        self.is_list_due && !self.may_list
    }

    /// Bytes that the list of clear pixels will take.
    pub(crate) fn clear_bytes(&self) -> f64 {
        self.bitmap.clear_bytes()
    }

    fn is_finished(&self) -> bool {
        self.sites.saturated || self.sites.pixels.len() as u64 >= self.sites.target || self.picks_left == Some(0)
    }

    /// Progress, 0 … 1, estimated from the number of sites: random discs jam at 0.547 of the area (decision A1).
    pub(crate) fn progress(&self) -> f64 {
        let jammed = target_sites(f64::from(self.sites.width) * f64::from(self.sites.height), 0.547, self.sites.radius);
        let expected = jammed.min(self.sites.target as f64).max(1.0);
        (self.sites.pixels.len() as f64 / expected).min(1.0)
    }

    pub(crate) fn finish(self) -> Sites {
        // The bitmap and the list are freed before the sites are sorted.
        let DartThrower { mut sites, bitmap, free, .. } = self;
        drop((bitmap, free));
        sort_by_bucket(&mut sites);
        sites
    }
}

/// Sorts the sites into the square buckets of [`Sites::grid`], row by row, and within a bucket in the order of
/// acceptance.
///
/// A site's index is its place in this order. Sites next to each other on the ground are therefore close together in
/// memory, and a later stage that goes through all sites goes through the image once.
fn sort_by_bucket(sites: &mut Sites) {
    let grid = sites.grid();
    sites.pixels = grid.order().iter().map(|&index| sites.pixels[index as usize]).collect();
}

/// Throws darts at given pixels. Returns the indices of the accepted picks and the number of pixels that stay free.
pub fn accept_picks(width: u32, height: u32, radius: f64, picks: &[Pixel]) -> (Vec<usize>, u64) {
    let mut thrower = DartThrower::new([width, height], radius, 1.0, true, [0, 0], 0);
    let accepted =
        picks.iter().enumerate().filter(|&(_, &pick)| thrower.try_place(pick)).map(|(index, _)| index).collect();
    let mut clear = Vec::new();
    thrower.bitmap.push_clear(&mut clear);
    (accepted, clear.len() as u64)
}
