//! Rocks of a group that lie together: what a part of a picture leaves out where it does not show them.

use std::ops::Range;

use glam::Vec3;

/// A group's cell has so many places on a side; rocks in one of them are never separated from each other.
pub(super) const FINE: usize = 8;

/// A cluster has at least so many indices of the finest level, but for the last of a group.
const LEAST: u32 = 3 * 150;

#[derive(Debug)]
pub(super) struct Cluster {
    pub(super) low: Vec3,
    pub(super) high: Vec3,
    /// Where its triangles of the finest level are, from the group's first on.
    pub(super) range: Range<u32>,
}

impl Cluster {
    /// An empty one.
    pub(super) fn at(start: u32) -> Self {
        Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY, range: start..start }
    }

    /// Adds a rock in the box `low`…`high`.
    pub(super) fn add(&mut self, low: Vec3, high: Vec3, triangles: u32) {
        self.low = self.low.min(low);
        self.high = self.high.max(high);
        self.range.end += 3 * triangles;
    }

    /// Whether the next rock may begin another one.
    pub(super) fn is_full(&self) -> bool {
        self.range.len() as u32 >= LEAST
    }
}

/// The place of a cell on a curve through all cells of a grid that seldom jumps: the bits of its column and its row by turns (Morton, 1966).
pub(super) fn morton([column, row]: [u8; 2]) -> u8 {
    (0..4).fold(0, |key, bit| key | (column >> bit & 1) << (2 * bit) | (row >> bit & 1) << (2 * bit + 1))
}
