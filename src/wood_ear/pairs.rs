//! Finds the pairs of individuals that could touch, by comparing boxes on a grid. No touching pair is missed (decision
//! K10).

use glam::DVec3;

use super::grid::Grid;

/// An axis-aligned box. It is empty if `min` is greater than `max`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) min: DVec3,
    pub(super) max: DVec3,
}

impl Bounds {
    pub(super) const EMPTY: Bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    pub(super) fn of(points: impl Iterator<Item = DVec3>) -> Self {
        points.fold(Bounds::EMPTY, |bounds, p| bounds.with(p))
    }

    #[inline]
    pub(super) fn with(self, p: DVec3) -> Self {
        Bounds { min: self.min.min(p), max: self.max.max(p) }
    }

    #[inline]
    pub(super) fn overlaps(&self, other: &Bounds) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

/// Returns every pair i < j whose boxes overlap, in ascending order of j.
///
/// The grid's cells are as wide as the widest box, so the middles of two overlapping boxes lie in the same cell or in
/// neighbouring ones.
pub(super) fn overlapping(bounds: &[Bounds]) -> Vec<[u32; 2]> {
    let width = bounds.iter().fold(1.0e-3_f64, |most, b| most.max((b.max - b.min).max_element()));
    let mut grid = Grid::new(width, bounds.len());
    let mut pairs = Vec::new();
    for (j, b) in (0_u32..).zip(bounds) {
        let middle = (b.min + b.max) * 0.5;
        grid.near(middle, |i| {
            if bounds[i as usize].overlaps(b) {
                pairs.push([i, j]);
            }
        });
        grid.add(middle);
    }
    pairs
}
