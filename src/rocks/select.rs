//! Stage 3: exclusive selection (journal §3.2, Fig. 7).

use super::cell::SIDES;
use super::sites::{Pixel, Sites};
use super::voronoi::Cells;
use crate::bitmap::Bitmap;
use crate::rng::{Purpose, Stream};

/// When a layer has enough (decision A7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// The selected cells own this share of the image's pixels: A_s.
    Area(f64),
    /// So many cells are selected.
    Count(u32),
}

/// The cells of one layer that were granted to rocks.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Selection {
    /// Site indices in the order granted.
    pub selected: Vec<u32>,
    /// Pixels they own.
    pub pixels: u64,
    /// The cells ended before the threshold was reached.
    pub saturated: bool,
}

/// The pixels of a cell, row by row.
///
/// A pixel belongs to the cell of the nearest site, ties to the lowest site index (decision A9). Per row, each edge
/// bounds x by an exact integer inequality: relative to the site, pixel p is not nearer to the neighbour at
/// offset g exactly if p·g ≤ ⌊|g|² / 2⌋, or ⌊(|g|² − 1) / 2⌋ where a tie goes to the neighbour.
#[derive(Debug, Default)]
pub(crate) struct PixelSpans {
    /// Lowest row.
    bottom: i32,
    /// First and last column per row, relative to the site; empty where first > last.
    rows: Vec<[i32; 2]>,
}

impl PixelSpans {
    /// Computes the spans of cell `i`.
    pub(crate) fn compute(&mut self, sites: &Sites, cells: &Cells, i: usize) {
        let here = sites.pixels[i];
        let [x, y] = here.map(i32::from);
        let centre = here.map(|c| f64::from(c) + 0.5);
        let polygon = cells.polygon(i);
        let neighbors = cells.neighbors_of(i);
        let (low, high) = polygon.iter().fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v.y), hi.max(v.y)));
        self.bottom = first_row(low - centre[1]).max(-y);
        let top = last_row(high - centre[1]).min(sites.height as i32 - 1 - y);
        self.rows.clear();
        self.rows.resize((top - self.bottom + 1).max(0) as usize, [-x, sites.width as i32 - 1 - x]);

        let mut previous = polygon[polygon.len() - 1].y - centre[1];
        let mut previous_neighbor = neighbors[neighbors.len() - 1];
        for (vertex, &next_neighbor) in polygon.iter().zip(neighbors) {
            let end = vertex.y - centre[1];
            let (start, neighbor) = (previous, previous_neighbor);
            (previous, previous_neighbor) = (end, next_neighbor);
            if neighbor >= SIDES {
                continue; // rows and columns are within the image already
            }
            let [gx, gy] = {
                let [ox, oy] = sites.pixels[neighbor as usize].map(i32::from);
                [ox - x, oy - y]
            };
            let tie_is_lost = i32::from((neighbor as usize) < i);
            let bound = (gx * gx + gy * gy - tie_is_lost) >> 1;
            let from = (first_row(start.min(end)).max(self.bottom) - self.bottom) as usize;
            let to = (last_row(start.max(end)).min(top) - self.bottom + 1).max(0) as usize;
            let Some(rows) = self.rows.get_mut(from..to) else { continue };
            let mut room = bound - (self.bottom + from as i32) * gy;
            if gx == 0 {
                // A horizontal edge: it admits or refuses whole rows.
                for row in rows {
                    if room < 0 {
                        *row = [1, 0];
                    }
                    room -= gy;
                }
            } else {
                // ⌊room / |gx|⌋: the half keeps the quotient clear of whole numbers, so that rounding cannot tip it.
                let inverse = 1.0 / f64::from(gx.abs());
                if gx > 0 {
                    for row in rows {
                        row[1] = row[1].min(((f64::from(room) + 0.5) * inverse).floor() as i32);
                        room -= gy;
                    }
                } else {
                    for row in rows {
                        row[0] = row[0].max(-((f64::from(room) + 0.5) * inverse).floor() as i32);
                        room -= gy;
                    }
                }
            }
        }
        self.settle_ties_at_vertices(sites, cells, i);
    }

    /// Where a cell vertex lies on a pixel's centre, the pixel may also be claimed by a cell that touches this one in
    /// that vertex only, across no edge; there the owner is looked up.
    fn settle_ties_at_vertices(&mut self, sites: &Sites, cells: &Cells, i: usize) {
        let [x, y] = sites.pixels[i].map(i32::from);
        for vertex in cells.polygon(i) {
            // The pixel that holds the vertex, and how far its centre is.
            let pixel = vertex.floor();
            if (*vertex - pixel - 0.5).abs().max_element() > VERTEX_SLACK {
                continue;
            }
            let (column, row) = (pixel.x as i32, pixel.y as i32);
            let Some(span) = self.rows.get_mut((row - y - self.bottom) as usize) else { continue };
            let here = column - x;
            if (span[0]..=span[1]).contains(&here)
                && cells.grid.owner(&sites.pixels, column as u32, row as u32) != Some(i as u32)
            {
                // A vertex is a corner of the cell, so the pixel ends its row.
                if here == span[0] {
                    span[0] += 1;
                } else {
                    span[1] = here - 1;
                }
            }
        }
    }

    /// Number of pixels.
    pub(crate) fn count(&self) -> u64 {
        self.rows.iter().map(|&[first, last]| (last - first + 1).max(0) as u64).sum()
    }

    /// Rows with at least one pixel: (row, first column, last column) in the image.
    pub(crate) fn spans(&self, [x, y]: Pixel) -> impl Iterator<Item = (u32, u32, u32)> + '_ {
        let (x, y) = (i32::from(x), i32::from(y));
        (y + self.bottom..)
            .zip(&self.rows)
            .filter(|(_, [first, last])| first <= last)
            .map(move |(row, &[first, last])| (row as u32, (x + first) as u32, (x + last) as u32))
    }
}

/// Cell vertices are rounded to 2⁻²¹ px and merged within 1e-6 px.
const VERTEX_SLACK: f64 = 2.0e-6;

/// First row whose pixel centres are not below y.
fn first_row(y: f64) -> i32 {
    (y - VERTEX_SLACK).ceil() as i32
}

/// Last row whose pixel centres are not above y.
fn last_row(y: f64) -> i32 {
    (y + VERTEX_SLACK).floor() as i32
}

/// Selects cells of one layer whose pixels are all free, in random order, until the threshold is reached.
///
/// Within a layer cells share no pixel, so whether a cell is free does not depend on the visiting order: one scan in
/// memory order finds the free cells, and the order only decides where the threshold cuts.
#[derive(Debug)]
pub(crate) struct Selector {
    order: Vec<u32>,
    threshold: Threshold,
    drop_border: bool,
    spans: PixelSpans,
    /// Pixels of every cell, 0 where it is not free.
    free_pixels: Vec<u32>,
}

impl Selector {
    pub(crate) fn new(cells: &Cells, threshold: Threshold, drop_border: bool, seed: u32, layer: u32) -> Self {
        Selector::with_order(cells, threshold, drop_border, visiting_order(cells.len() as u32, seed, layer))
    }

    pub(crate) fn with_order(cells: &Cells, threshold: Threshold, drop_border: bool, order: Vec<u32>) -> Self {
        let free_pixels = Vec::with_capacity(cells.len());
        Selector { order, threshold, drop_border, spans: PixelSpans::default(), free_pixels }
    }

    /// Looks at about `count` more cells. True when all have been looked at.
    pub(crate) fn advance(&mut self, sites: &Sites, cells: &Cells, taken: &Bitmap, count: usize) -> bool {
        let from = self.free_pixels.len();
        let to = (from + count).min(cells.len());
        for i in from..to {
            let pixels = self.free_pixels_of(sites, cells, taken, i);
            self.free_pixels.push(pixels);
        }
        to == cells.len()
    }

    fn free_pixels_of(&mut self, sites: &Sites, cells: &Cells, taken: &Bitmap, i: usize) -> u32 {
        let pixel = sites.pixels[i];
        // The site's own pixel is always the cell's: most cells under a coarser rock end here.
        if taken.get(pixel[0].into(), pixel[1].into()) || (self.drop_border && cells.touches_border(i)) {
            return 0;
        }
        self.spans.compute(sites, cells, i);
        if self.spans.spans(pixel).any(|(row, first, last)| taken.any_in_span(row, first, last)) {
            return 0;
        }
        self.spans.count() as u32
    }

    pub(crate) fn progress(&self) -> f64 {
        self.free_pixels.len() as f64 / self.order.len().max(1) as f64
    }

    /// Cuts at the threshold.
    pub(crate) fn finish(self, sites: &Sites) -> Selection {
        let area = f64::from(sites.width) * f64::from(sites.height);
        let mut selection = Selection::default();
        let is_reached = |selection: &Selection| match self.threshold {
            Threshold::Area(fraction) => selection.pixels as f64 >= fraction * area,
            Threshold::Count(count) => selection.selected.len() as u64 >= u64::from(count),
        };
        // The test comes before each cell and the last one is taken whole (decision A7).
        for &site in &self.order {
            if is_reached(&selection) {
                break;
            }
            let pixels = self.free_pixels[site as usize];
            if pixels > 0 {
                selection.selected.push(site);
                selection.pixels += u64::from(pixels);
            }
        }
        selection.saturated = !is_reached(&selection);
        selection
    }
}

/// Flags the pixels of selected cells.
pub(crate) fn flag(sites: &Sites, cells: &Cells, selected: &[u32], taken: &mut Bitmap) {
    let mut spans = PixelSpans::default();
    for &site in selected {
        spans.compute(sites, cells, site as usize);
        for (row, first, last) in spans.spans(sites.pixels[site as usize]) {
            taken.fill_span(row, first, last);
        }
    }
}

/// A random permutation of the cells (decision A7: the order of creation would favour large cells).
fn visiting_order(count: u32, seed: u32, layer: u32) -> Vec<u32> {
    let mut stream = Stream::new(seed, Purpose::VisitingOrder, layer, 0);
    let mut order: Vec<u32> = (0..count).collect();
    for last in (1..count).rev() {
        order.swap(last as usize, stream.below(last + 1) as usize);
    }
    order
}

/// Selects from several layers, given in descending order of mean cell area, with given visiting orders.
pub fn select(layers: &[(&Sites, &Cells, Vec<u32>, Threshold)]) -> Vec<Selection> {
    let Some((first, ..)) = layers.first() else { return Vec::new() };
    let mut taken = Bitmap::new(first.width, first.height);
    layers
        .iter()
        .map(|(sites, cells, order, threshold)| {
            let mut selector = Selector::with_order(cells, *threshold, false, order.clone());
            selector.advance(sites, cells, &taken, usize::MAX / 2);
            let selection = selector.finish(sites);
            flag(sites, cells, &selection.selected, &mut taken);
            selection
        })
        .collect()
}

/// Pixels (column, row) that cell `i` owns, row by row.
pub fn cell_pixels(sites: &Sites, cells: &Cells, i: usize) -> Vec<Pixel> {
    let mut spans = PixelSpans::default();
    spans.compute(sites, cells, i);
    spans
        .spans(sites.pixels[i])
        .flat_map(|(row, first, last)| (first..=last).map(move |column| [column as u16, row as u16]))
        .collect()
}
