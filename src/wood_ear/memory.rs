//! The memory a colony needs, estimated before anything is allocated.

use super::body::Layout;
use super::feet::wanted;
use super::log::counts;
use super::user_log::Surface;
use crate::error::Error;
use crate::params::wood_ear::Params;

/// A wasm instance before its first run: stack and static data.
const INSTANCE: f64 = 1.2e6;

/// Vertices and corners are numbered in 32 bits, whatever the budget.
const MOST_CORNERS: f64 = 2_147_483_648.0;

/// # Errors
/// [`Error::OverBudget`] where the estimate exceeds the budget; `given` is a log of the user's own.
pub(super) fn check(params: &Params, given: Option<&Surface>, budget: u64) -> Result<(), Error> {
    let layout = Layout::new(params);
    let (places, vertices) = match given {
        Some(surface) => (wanted(surface.area(), params.log.spacing), surface.log.points.len() as f64),
        None => {
            let (_, [coarse, fine]) = counts(&params.log);
            (coarse as f64, fine as f64)
        }
    };
    let individuals = expected(params, places, given);
    let [v, t] = [f64::from(layout.vertices), layout.triangles.len() as f64];
    // Positions, normals and indices, once in the generator and once copied out; positions again while collisions run; the sheets.
    let sheet = f64::from(params.rings * params.meridians) * 24.0 * 2.0 + 64.0;
    let each = 2.0 * (24.0 * v + 12.0 * t) + 12.0 * v + sheet + 400.0;
    let log = 2.0 * (33.0 * vertices + 24.0 * vertices) + 48.0 * vertices + 90.0 * places;
    let bytes = INSTANCE + individuals * each + log;
    if bytes > budget as f64 || individuals * 3.0 * t > MOST_CORNERS {
        let key = if individuals * each > log { "density" } else { "logSpacing" };
        return Err(Error::OverBudget { key, estimate: bytes as u64, budget });
    }
    Ok(())
}

/// Individuals to be expected, rather more than fewer.
fn expected(params: &Params, places: f64, given: Option<&Surface>) -> f64 {
    let share = params.density / 100.0;
    let within = match given {
        Some(surface) => surface.share_within(params),
        None => {
            let reach: f64 = params.bases.iter().map(|base| 2.0 * base.range.unwrap_or(params.range)).sum();
            reach / params.log.length
        }
    };
    let mean = places * (within * 1.15).min(1.0) * share;
    (mean + 4.0 * mean.sqrt()).min(places).ceil()
}
