//! Sites sorted into square buckets, for the neighbourhood queries of the Voronoi stage and for finding the owner of a
//! pixel.

use super::bitmap::Pixel;

/// Square buckets over the image. Bucket k holds the sites `order[starts[k]] .. order[starts[k + 1]]`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Grid {
    pub(crate) side: u32,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    starts: Vec<u32>,
    order: Vec<u32>,
}

impl Grid {
    /// Sorts the sites into buckets of `side` px. The side is raised where there would be more buckets than sites.
    #[inline(never)]
    pub(crate) fn new(width: u32, height: u32, side: u32, pixels: &[Pixel]) -> Self {
        // More buckets than sites would only cost memory and visits to empty buckets.
        let roomy = (2.0 * f64::from(width) * f64::from(height) / pixels.len().max(1) as f64).sqrt() as u32;
        let side = side.max(roomy).max(1);
        let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
        let mut starts = vec![0_u32; (columns * rows) as usize + 1];
        let bucket = |&[x, y]: &Pixel| (u32::from(y) / side * columns + u32::from(x) / side) as usize;
        for pixel in pixels {
            starts[bucket(pixel) + 1] += 1;
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut order = vec![0_u32; pixels.len()];
        let mut next = starts.clone();
        for (index, pixel) in pixels.iter().enumerate() {
            let slot = &mut next[bucket(pixel)];
            order[*slot as usize] = index as u32;
            *slot += 1;
        }
        Grid { side, columns, rows, starts, order }
    }

    /// Bytes of memory that the grid uses.
    pub(crate) fn bytes(&self) -> usize {
        4 * (self.starts.capacity() + self.order.capacity())
    }

    /// All sites, in the order of the buckets.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    /// The sites in the buckets `column0 ..= column1` of a row. They are one contiguous slice. The caller clamps the
    /// columns.
    #[inline]
    pub(crate) fn run(&self, row: u32, column0: u32, column1: u32) -> &[u32] {
        let base = row * self.columns;
        let from = self.starts[(base + column0) as usize] as usize;
        let to = self.starts[(base + column1) as usize + 1] as usize;
        &self.order[from..to]
    }

    /// Calls `visit` with the sites in all buckets at most `rings` buckets away from bucket (column, row), one row of
    /// buckets at a time.
    #[inline]
    pub(crate) fn block(&self, column: u32, row: u32, rings: u32, mut visit: impl FnMut(&[u32])) {
        let (left, right) = (column.saturating_sub(rings), (column + rings).min(self.columns - 1));
        for r in row.saturating_sub(rings)..=(row + rings).min(self.rows - 1) {
            visit(self.run(r, left, right));
        }
    }

    /// The site that owns a pixel, that is the nearest one; of equally near sites, the one with the lowest index
    /// (decision A9). `None` if there are no sites.
    pub(crate) fn owner(&self, pixels: &[Pixel], x: u32, y: u32) -> Option<u32> {
        let (column, row) = (x / self.side, y / self.side);
        let mut best: Option<(u64, u32)> = None;
        let mut rings = 1;
        loop {
            self.block(column, row, rings, |sites| {
                for &site in sites {
                    let [sx, sy] = pixels[site as usize].map(u32::from);
                    let d2 = u64::from(sx.abs_diff(x)).pow(2) + u64::from(sy.abs_diff(y)).pow(2);
                    if best.is_none_or(|nearest| (d2, site) < nearest) {
                        best = Some((d2, site));
                    }
                }
            });
            // Every site outside this block is farther than `rings` bucket sides.
            let clear = u64::from(rings) * u64::from(self.side);
            if best.is_some_and(|(d2, _)| d2 <= clear * clear) || rings >= self.columns.max(self.rows) {
                break;
            }
            rings *= 2;
        }
        best.map(|(_, site)| site)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, Stream};

    #[test]
    fn owner_is_the_nearest_site_and_the_lowest_index_among_equals() {
        for (width, height, count) in [(40, 30, 12), (64, 64, 200), (5, 90, 3), (33, 7, 1)] {
            let mut stream = Stream::new(3, Purpose::Darts, 0, count);
            let mut pixels: Vec<Pixel> = (0..count).map(|_| stream.pixel(width, height)).collect();
            pixels.sort_unstable();
            pixels.dedup();
            for side in [1, 4, 50] {
                let grid = Grid::new(width, height, side, &pixels);
                for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
                    let distance = |p: &Pixel| u32::from(p[0]).abs_diff(x).pow(2) + u32::from(p[1]).abs_diff(y).pow(2);
                    let expected = (0..pixels.len()).min_by_key(|&i| (distance(&pixels[i]), i));
                    assert_eq!(grid.owner(&pixels, x, y).map(|i| i as usize), expected);
                }
            }
        }
    }
}
