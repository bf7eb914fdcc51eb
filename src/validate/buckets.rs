//! Neighbourhood queries for the validators. They deliberately do not use the grid of the stages that they check.

use crate::rocks::Pixel;

/// Sites sorted into square buckets.
pub(super) struct Buckets<'a> {
    pixels: &'a [Pixel],
    side: u32,
    columns: u32,
    rows: u32,
    /// The first site of every bucket, or [`NONE`]. The others follow through `next`.
    first: Vec<u32>,
    next: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl<'a> Buckets<'a> {
    /// Makes buckets with about one site each. Every pixel has to lie within the image.
    pub(super) fn new(width: u32, height: u32, pixels: &'a [Pixel]) -> Self {
        let area = f64::from(width) * f64::from(height);
        let side = ((area / pixels.len().max(1) as f64).sqrt() as u32).max(1);
        let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
        let mut first = vec![NONE; columns as usize * rows as usize];
        let mut next = vec![NONE; pixels.len()];
        for (index, &[x, y]) in pixels.iter().enumerate() {
            let bucket = &mut first[(u32::from(y) / side * columns + u32::from(x) / side) as usize];
            next[index] = core::mem::replace(bucket, index as u32);
        }
        Buckets { pixels, side, columns, rows, first, next }
    }

    /// Calls `visit` with the index and the squared distance of every site within `radius` px of pixel (x, y), and of
    /// some others.
    pub(super) fn visit_near(&self, x: u32, y: u32, radius: u32, mut visit: impl FnMut(usize, u64)) {
        let range = |centre: u32, count: u32| {
            (centre.saturating_sub(radius) / self.side)..=((centre + radius) / self.side).min(count - 1)
        };
        for row in range(y, self.rows) {
            for column in range(x, self.columns) {
                let mut site = self.first[(row * self.columns + column) as usize];
                while site != NONE {
                    visit(site as usize, distance2(self.pixels[site as usize], x, y));
                    site = self.next[site as usize];
                }
            }
        }
    }
}

/// The squared distance between the centres of two pixels, exact.
#[inline]
pub(super) fn distance2([px, py]: Pixel, x: u32, y: u32) -> u64 {
    u64::from(u32::from(px).abs_diff(x)).pow(2) + u64::from(u32::from(py).abs_diff(y)).pow(2)
}
