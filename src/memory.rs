//! The memory a run needs, estimated before anything is allocated.

use crate::error::Error;
use crate::params::{Darts, Params};
use crate::rocks::target_sites;

/// An estimate of the peak, with the parameter that would lower it most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryEstimate {
    /// Bytes at the peak of a run, output included.
    pub bytes: u64,
    /// The parameter to change.
    pub key: &'static str,
}

/// Random discs jam at 0.547 of the area (decision A1); the finest pixel grids pack a little denser.
const JAMMED: f64 = 0.56;

/// Estimates the peak memory of a full run, output included.
///
/// Per layer, with n sites and m ≤ n rocks of about six cell vertices each: 12 bytes a site and 6·20 a cell stay
/// cached, and 20 a cell for looking neighbours up and selecting; a rock keeps 6·16 bytes of p_add and 16 triangles of
/// 6 bytes, and has 12 vertices of 24 bytes and 16 triangles of 12 bytes in the buffers, once in wasm and once as
/// copied out. The image costs one bit per pixel, and while darts are thrown about 3 % of its pixels as a list.
pub fn memory_estimate(params: &Params) -> MemoryEstimate {
    let pixels = params.pixels() as f64;
    let mut bytes = pixels / 8.0;
    let mut list = 0.0_f64;
    let mut free = 1.0_f64;
    for layer in &params.layers {
        let layer = params.layer_in_px(layer);
        let target = target_sites(pixels, params.packing, layer.radius);
        // Sites near the border count their disc only partly: the band of r/2 around the image helps to hold them.
        let [w, h] = [params.image_width, params.image_height].map(|side| f64::from(side) + 0.6 * layer.radius);
        let jammed = target_sites(w * h, JAMMED, layer.radius.max(1.2));
        let sites = match params.darts {
            Darts::Attempts => target.min(jammed),
            Darts::Saturate => target.min(jammed),
        }
        .min(pixels);
        let share = layer.cell_count.map_or(layer.area_fraction, |count| f64::from(count) / sites.max(1.0)).min(free);
        free = (free - share).max(0.0);
        let rocks = sites * share;
        bytes += sites * (12.0 + 6.0 * 20.0 + 24.0) + rocks * (6.0 * 16.0 + 16.0 * 6.0 + 12.0 * 24.0 + 16.0 * 12.0);
        list = list.max(0.03 * pixels * 4.0);
    }
    let bytes = (bytes + list) as u64 + (2 << 20);
    let key = if params.layers.is_empty() { "imageWidth" } else { "radius" };
    MemoryEstimate { bytes, key }
}

impl MemoryEstimate {
    /// # Errors
    /// [`Error::OverBudget`] where the estimate exceeds the budget.
    pub fn check(self, budget: u64) -> Result<(), Error> {
        if self.bytes > budget {
            return Err(Error::OverBudget { key: self.key, estimate: self.bytes, budget });
        }
        Ok(())
    }
}
