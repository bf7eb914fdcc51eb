//! What stands in the place of `paint.rs` where the crate is built without the feature `full`: nothing is ever painted.

use super::sites::Sites;
use super::voronoi::Cells;

/// No mask and no strokes.
#[derive(Debug, Default)]
pub(super) struct Paint {}

impl Paint {
    pub(super) fn is_empty(&self) -> bool {
        true
    }

    pub(super) fn bytes(&self) -> usize {
        0
    }

    pub(super) fn share(&self, count: usize) -> usize {
        count
    }

    /// Never asked, since nothing is painted.
    pub(super) fn allows(&self, _: u32, _: &Sites, _: &Cells, _: usize, [rank, cut]: [u32; 2]) -> bool {
        rank < cut
    }
}
