//! The memory a colony needs, estimated before anything is allocated.

use super::body::Layout;
use super::log::counts;
use crate::error::Error;
use crate::params::wood_ear::Params;

/// A wasm instance before its first run: stack and static data.
const INSTANCE: f64 = 1.2e6;

/// Vertices and corners are numbered in 32 bits, whatever the budget.
const MOST_CORNERS: f64 = 2_147_483_648.0;

/// # Errors
/// [`Error::OverBudget`] where the estimate exceeds the budget; `vertices` are those of a log of the user's own.
pub(super) fn check(params: &Params, vertices: Option<usize>, budget: u64) -> Result<(), Error> {
    let layout = Layout::new(params);
    let (_, [coarse, fine]) = counts(&params.log);
    let (coarse, fine) = vertices.map_or((coarse as f64, fine as f64), |n| (n as f64, n as f64));
    let individuals = expected(params, coarse, vertices.is_some());
    let [v, t] = [f64::from(layout.vertices), layout.triangles.len() as f64];
    // Positions, normals and indices, once in the generator and once copied out; positions again while collisions run; the sheets.
    let sheet = f64::from(params.rings * params.meridians) * 24.0 * 2.0 + 64.0;
    let each = 2.0 * (24.0 * v + 12.0 * t) + 12.0 * v + sheet + 400.0;
    let log = 2.0 * (33.0 * fine + 24.0 * fine) + 48.0 * fine + 90.0 * coarse;
    let bytes = INSTANCE + individuals * each + log;
    if bytes > budget as f64 || individuals * 3.0 * t > MOST_CORNERS {
        let key = if individuals * each > log { "density" } else { "logSpacing" };
        return Err(Error::OverBudget { key, estimate: bytes as u64, budget });
    }
    Ok(())
}

/// Individuals to be expected, rather more than fewer.
fn expected(params: &Params, vertices: f64, given: bool) -> f64 {
    let share = params.density / 100.0;
    let reach: f64 = params.bases.iter().map(|base| 2.0 * base.range.unwrap_or(params.range)).sum();
    // Of a log of the user's own it is not known how much lies within range.
    let within = if given { 1.0 } else { (reach / params.log.length * 1.15).min(1.0) };
    let mean = vertices * within * share;
    (mean + 4.0 * mean.sqrt()).min(vertices).ceil()
}
