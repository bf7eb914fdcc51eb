//! Oracles: functions that check what the output of every stage has to satisfy.
//!
//! Each `check_…` takes the f64 output of a stage and recomputes what it can in a way different from the stage's:
//! distances in integers, areas by compensated sums, owners of pixels by comparing squared distances, positions from
//! Eqs 2 and 3. The first error found is returned as a [`Violation`] that holds all the numbers. Tests and debug builds
//! use these functions; they cost about as much as the stages themselves.

mod apart;
mod buckets;
mod cells;
mod colony;
mod crossing;
mod grown;
mod mesh;
mod selection;
mod shapes;
mod sites;
mod worn;

use std::fmt;

pub use apart::check_apart;
pub use cells::{check_cells, check_ownership};
pub use colony::{check_closed, check_colony};
pub use crossing::crossing_pairs;
pub use grown::check_grown;
pub use mesh::check_mesh;
pub use selection::check_selection;
pub use shapes::check_shapes;
pub use sites::check_sites;

use crate::params::{Crossing, Darts, Params};
use crate::rocks::{Field, target_sites};

/// A property that the output of a stage should have and does not have.
#[derive(Debug, Clone, PartialEq)]
pub struct Violation(String);

impl Violation {
    /// Returns the violation with the place where it was found in front of it.
    fn within(self, place: impl fmt::Display) -> Self {
        Violation(format!("{place}: {}", self.0))
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Violation {}

fn ensure(holds: bool, message: impl FnOnce() -> String) -> Result<(), Violation> {
    if holds { Ok(()) } else { Err(Violation(message())) }
}

/// Checks every stage of a field, and that the field was made from `params`.
///
/// Cost: O(pixels · layers) time and memory, besides the size of the field.
///
/// # Errors
/// Returns the first violation, and the layer it is in.
pub fn check_field(params: &Params, field: &Field) -> Result<(), Violation> {
    ensure(field.layers.len() == params.layers.len(), || {
        format!("{} layers instead of {}", field.layers.len(), params.layers.len())
    })?;
    let mut owners = Vec::with_capacity(field.layers.len());
    for (index, (layer, asked)) in field.layers.iter().zip(&params.layers).enumerate() {
        let place = format!("layer {index} (id {}, r {})", layer.layer.id, layer.layer.radius);
        let check = || {
            ensure(layer.layer == params.layer_in_px(asked), || format!("{:?} is not {asked:?}", layer.layer))?;
            let sites = &layer.sites;
            ensure(
                [sites.width, sites.height] == [params.image_width, params.image_height]
                    && sites.radius == layer.layer.radius,
                || format!("sites for r {} on {} × {}", sites.radius, sites.width, sites.height),
            )?;
            let target = target_sites(params.pixels() as f64, params.packing, sites.radius);
            ensure(sites.target == target as u64, || format!("N_p {} instead of {target}", sites.target))?;
            let ended = sites.saturated || sites.pixels.len() as u64 == sites.target;
            ensure(ended || params.darts == Darts::Attempts, || {
                format!("{} of {} sites, yet not saturated", sites.pixels.len(), sites.target)
            })?;
            check_sites(sites)?;
            check_cells(sites, &layer.cells)?;
            let owner = check_ownership(sites, &layer.cells)?;
            check_shapes(&layer.cells, &layer.selection.selected, &layer.shapes)?;
            Ok(owner)
        };
        owners.push(check().map_err(|violation: Violation| violation.within(place))?);
    }
    check_selection(params.border, &field.layers, &owners).map_err(|violation| violation.within("selection"))?;
    let check = if params.crossing == Crossing::Apart { check_apart } else { check_mesh };
    check(params, field).map_err(|violation| violation.within("mesh"))
}
