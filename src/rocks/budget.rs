//! The memory of a run. It is estimated again each time more of the run's numbers are known.

use super::cache::{LayerCache, bytes};
use super::footprint::Footprint;
use super::generator::Generator;
use crate::error::Error;
use crate::memory::{Bitmaps, Load, MemoryEstimate, Need, expected_sites, memory_estimate};
use crate::mesh::Mesh;

/// How much a run knows about the sizes of its results.
#[derive(Debug, Clone, Copy, Default, PartialEq, PartialOrd)]
pub(super) enum Known {
    #[default]
    Nothing,
    Sites,
    Rocks,
}

impl Generator {
    /// Bytes that the run needs at its peak, output included. This is the largest of the estimates made so far: one at
    /// the start and one before each stage; see [`crate::memory_estimate`].
    pub fn estimate(&self) -> u64 {
        self.estimate
    }

    /// Bytes of all results that are kept from the last run.
    pub(super) fn held(&self) -> f64 {
        let layers: usize = self.layers.iter().map(LayerCache::bytes).sum();
        let footprints = self.footprint.0.bytes() + self.next_footprint.as_ref().map_or(0, Footprint::bytes);
        let Mesh { rock_starts, vertex_starts, rock_layer, .. } = &self.mesh;
        let rest = bytes(rock_starts) + bytes(vertex_starts) + bytes(rock_layer);
        (layers + footprints + self.mesh.bytes().iter().sum::<usize>() + rest) as f64
    }

    /// Repeats the estimate with what is known now. Called before a stage allocates; returns [`Error::OverBudget`] if
    /// the new estimate is above the budget.
    #[inline(never)]
    pub(super) fn check_memory(&mut self, known: Known) -> Result<(), Error> {
        let Some(params) = &self.params else { return Ok(()) };
        if known != Known::Nothing && known <= self.checked {
            return Ok(());
        }
        let load = |cache: &LayerCache| {
            let expected = cache.layer.as_ref().map_or(0.0, |layer| expected_sites(params, layer.radius));
            cache.load(params, expected, known == Known::Rocks)
        };
        let loads: Vec<Load> = self.layers.iter().filter_map(load).collect();
        let bitmaps = Bitmaps { clear: self.clear_bytes, selects: self.selects || known != Known::Rocks };
        let of = |this: &Generator| {
            Need::of(this.held(), params, &loads, this.mesh.bytes().map(|bytes| bytes as f64), bitmaps)
        };
        let mut need = of(self);
        if need.bytes(0.0) > self.max_bytes {
            // The rocks of the previous run would be overwritten later anyway, so their memory is freed now.
            self.mesh = Mesh::default();
            self.layers.iter_mut().for_each(|cache| cache.mesh = None);
            need = of(self);
        }
        let bytes = need.bytes(0.0);
        self.peak_before = self.peak_before.max(need.until_selection);
        self.estimate = self.estimate.max(need.bytes(self.peak_before));
        if bytes > self.max_bytes {
            return MemoryEstimate { bytes, ..memory_estimate(params) }.check(self.max_bytes);
        }
        self.checked = known;
        Ok(())
    }
}
