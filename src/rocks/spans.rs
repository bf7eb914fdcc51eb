//! The pixels that a cell owns.

use glam::Vec4;

use super::bitmap::{Bitmap, Pixel};
use super::cell::SIDES;
use super::sites::Sites;
use super::voronoi::Cells;

/// The pixels of a cell, row by row.
///
/// A pixel belongs to the cell of the nearest site, or of the one with the lowest index if several are equally near
/// (decision A9). Relative to the site, pixel p is not nearer to the neighbour at offset g exactly if p·g ≤ ⌊|g|² / 2⌋,
/// or ⌊(|g|² − 1) / 2⌋ if ties go to the neighbour. In every row, each neighbour therefore bounds x by an exact
/// inequality of integers. The cell is convex, so every neighbour's bound may be applied to every row, four rows at a
/// time.
#[derive(Debug, Default)]
pub(crate) struct PixelSpans {
    /// Lowest row of the cell, relative to the site.
    bottom: i32,
    rows: usize,
    /// First and last column per row, relative to the site, as whole numbers; a row is empty if first > last. Padded to
    /// whole vectors.
    first: Vec<[f32; LANES]>,
    last: Vec<[f32; LANES]>,
}

/// Number of rows per SIMD vector.
const LANES: usize = 4;

impl PixelSpans {
    /// Computes the spans of cell `i`.
    pub(crate) fn compute(&mut self, sites: &Sites, cells: &Cells, i: usize) {
        let here = sites.pixels[i];
        let [x, y] = here.map(i32::from);
        // The bits of positive floats sort like the floats, and comparing integers needs no branch.
        let heights = cells.polygon(i).iter().map(|vertex| vertex.y.to_bits());
        let (low, high) = heights.fold((u64::MAX, 0), |(low, high), bits| (low.min(bits), high.max(bits)));
        let centre = f64::from(here[1]) + 0.5;
        self.bottom = round(f64::from_bits(low) - VERTEX_SLACK + 0.5 - centre).max(-y);
        let top = round(f64::from_bits(high) + VERTEX_SLACK - 0.5 - centre).min(sites.height as i32 - 1 - y);
        self.rows = (top - self.bottom + 1).max(0) as usize;
        let vectors = self.rows.div_ceil(LANES);
        self.first.clear();
        self.first.resize(vectors, [-x as f32; LANES]);
        self.last.clear();
        self.last.resize(vectors, [(sites.width as i32 - 1 - x) as f32; LANES]);

        for &neighbor in cells.neighbors_of(i) {
            if neighbor >= SIDES {
                continue; // rows and columns are limited to the image already
            }
            let [ox, oy] = sites.pixels[neighbor as usize].map(i32::from);
            let (gx, gy) = (ox - x, oy - y);
            let tie_is_lost = i32::from((neighbor as usize) < i);
            let bound = (gx * gx + gy * gy - tie_is_lost) >> 1;
            // The most that x·gx may be in the cell's lowest row.
            let room = bound - self.bottom * gy;
            let largest = room.abs().max((room - (self.rows as i32 + LANES as i32) * gy).abs());
            if largest < EXACT_ROOM {
                self.bound_rows(gx as f32, gy as f32, room as f32);
            } else {
                self.bound_rows_exactly(gx, gy, room);
            }
        }
        self.settle_ties_at_vertices(sites, cells, i);
    }

    /// Applies the bound x·gx ≤ room − row·gy to every row.
    #[inline]
    fn bound_rows(&mut self, gx: f32, gy: f32, room: f32) {
        let mut room = Vec4::splat(room) - Vec4::new(0.0, 1.0, 2.0, 3.0) * gy;
        let step = Vec4::splat(LANES as f32 * gy);
        if gx == 0.0 {
            // The edge is horizontal, so it admits or refuses whole rows.
            for last in &mut self.last {
                let refused = Vec4::select(room.cmplt(Vec4::ZERO), Vec4::NEG_INFINITY, Vec4::INFINITY);
                *last = Vec4::from(*last).min(refused).to_array();
                room -= step;
            }
            return;
        }
        // Computes ⌊room / |gx|⌋. Adding a half keeps the quotient clear of whole numbers, so that rounding cannot
        // change the result.
        let inverse = Vec4::splat(1.0 / gx.abs());
        let half = Vec4::splat(0.5);
        if gx > 0.0 {
            for last in &mut self.last {
                *last = Vec4::from(*last).min(((room + half) * inverse).floor()).to_array();
                room -= step;
            }
        } else {
            for first in &mut self.first {
                *first = Vec4::from(*first).max(-((room + half) * inverse).floor()).to_array();
                room -= step;
            }
        }
    }

    /// Like [`PixelSpans::bound_rows`], for numbers that single precision cannot hold exactly.
    fn bound_rows_exactly(&mut self, gx: i32, gy: i32, room: i32) {
        let rows = self.first.as_flattened_mut().iter_mut().zip(self.last.as_flattened_mut());
        for (row, (first, last)) in (0..).zip(rows) {
            let room = room - row * gy;
            match gx.signum() {
                1 => *last = last.min(room.div_euclid(gx) as f32),
                -1 => *first = first.max(-room.div_euclid(-gx) as f32),
                _ if room < 0 => *last = f32::NEG_INFINITY,
                _ => {}
            }
        }
    }

    /// If a cell vertex lies on a pixel's centre, a cell that touches this one only at that vertex, and not along an
    /// edge, may also claim the pixel. In that case the pixel's owner is looked up, and the pixel is removed if it
    /// belongs to another cell.
    fn settle_ties_at_vertices(&mut self, sites: &Sites, cells: &Cells, i: usize) {
        let [x, y] = sites.pixels[i].map(i32::from);
        for vertex in cells.polygon(i) {
            // The vertex is skipped unless it lies at the centre of the pixel that holds it.
            let pixel = vertex.floor();
            if (*vertex - pixel - 0.5).abs().max_element() > VERTEX_SLACK {
                continue;
            }
            let (column, row) = (pixel.x as i32, pixel.y as i32);
            let here = column - x;
            let Some(k) = usize::try_from(row - y - self.bottom).ok().filter(|&k| k < self.rows) else { continue };
            let (first, last) = self.span(k);
            if (first..=last).contains(&here)
                && cells.grid.owner(&sites.pixels, column as u32, row as u32) != Some(i as u32)
            {
                // A vertex is a corner of the cell, so the pixel is the first or the last of its row.
                if here == first {
                    self.first[k / LANES][k % LANES] += 1.0;
                } else {
                    self.last[k / LANES][k % LANES] = (here - 1) as f32;
                }
            }
        }
    }

    /// First and last column of row `k`, relative to the site.
    fn span(&self, k: usize) -> (i32, i32) {
        (self.first[k / LANES][k % LANES] as i32, self.last[k / LANES][k % LANES] as i32)
    }

    /// Number of pixels of the cell, or 0 if one of them is taken.
    pub(crate) fn free_pixels(&self, site: Pixel, taken: &Bitmap) -> u32 {
        let mut count = 0;
        for (row, first, last) in self.spans(site) {
            if taken.any_in_span(row, first, last) {
                return 0;
            }
            count += last - first + 1;
        }
        count
    }

    /// Yields (row, first column, last column), in image coordinates, for every row that has at least one pixel.
    pub(crate) fn spans(&self, [x, y]: Pixel) -> impl Iterator<Item = (u32, u32, u32)> + '_ {
        let (x, y) = (i32::from(x), i32::from(y));
        let (first, last) = (self.first.as_flattened(), self.last.as_flattened());
        let rows = (y + self.bottom..).zip(first.iter().zip(last)).take(self.rows);
        rows.filter(|(_, (first, last))| first <= last)
            .map(move |(row, (&first, &last))| (row as u32, (x + first as i32) as u32, (x + last as i32) as u32))
    }
}

/// Below this, x·gx and its half are exact in single precision, and the error of a quotient is too small to change its
/// floor.
const EXACT_ROOM: i32 = 1 << 20;

/// Margin for cell vertices, px: they are rounded to 2⁻²¹ px and merged within 1e-6 px.
const VERTEX_SLACK: f64 = 2.0e-6;

/// Rounds to the nearest whole number, for values below 2³¹: adding 1.5·2⁵² leaves it in the lowest bits. The values
/// used here are never near a half.
#[inline]
fn round(value: f64) -> i32 {
    (value + 1.5 * (1_u64 << 52) as f64).to_bits() as i32
}

/// Returns the pixels (column, row) that cell `i` owns, row by row.
pub fn cell_pixels(sites: &Sites, cells: &Cells, i: usize) -> Vec<Pixel> {
    let mut spans = PixelSpans::default();
    spans.compute(sites, cells, i);
    spans
        .spans(sites.pixels[i])
        .flat_map(|(row, first, last)| (first..=last).map(move |column| [column as u16, row as u16]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, Stream};

    #[test]
    fn rows_bounded_in_single_precision_equal_those_bounded_in_integers() {
        let mut stream = Stream::new(2, Purpose::Darts, 0, 0);
        let mut compared = 0;
        for round in 0..20_000 {
            let reach = 1 << (2 + round % 9);
            let mut offset = || stream.below(2 * reach + 1) as i32 - reach as i32;
            let (gx, gy) = (offset(), if round % 7 == 0 { 0 } else { offset() });
            let vectors = 1 + round as usize % 9;
            let room = ((gx * gx + gy * gy) >> 1) + offset() * gy;
            if room.abs().max((room - gy * (LANES * vectors) as i32).abs()) >= EXACT_ROOM {
                continue;
            }
            compared += 1;
            let blank = || PixelSpans {
                rows: LANES * vectors,
                first: vec![[-9000.0; LANES]; vectors],
                last: vec![[9000.0; LANES]; vectors],
                ..PixelSpans::default()
            };
            let (mut fast, mut exact) = (blank(), blank());
            fast.bound_rows(gx as f32, gy as f32, room as f32);
            exact.bound_rows_exactly(gx, gy, room);
            assert_eq!((&fast.first, &fast.last), (&exact.first, &exact.last), "g {gx}, {gy}, room {room}");
        }
        assert!(compared > 15_000, "{compared}");
    }
}
