//! A finished field.

use super::generator::Generator;
use super::select::Selection;
use super::shape::Shapes;
use super::sites::Sites;
use super::voronoi::Cells;
use crate::error::Error;
use crate::mesh::Mesh;
use crate::params::{Layer, Params};

/// Everything a run made, with the intermediate results of every stage.
#[derive(Debug, Clone, Default)]
pub struct Field {
    /// In input order.
    pub layers: Vec<FieldLayer>,
    /// Rocks in layer order, within a layer in the order of the selection.
    pub mesh: Mesh,
}

/// The stages of one layer.
#[derive(Debug, Clone)]
pub struct FieldLayer {
    /// What was asked for, lengths in px.
    pub layer: Layer,
    /// Stage 1.
    pub sites: Sites,
    /// Stage 2.
    pub cells: Cells,
    /// Stage 3.
    pub selection: Selection,
    /// Stage 4, before displacement.
    pub shapes: Shapes,
}

impl Field {
    /// Share of the image's pixels that the selected cells own (decision A9).
    pub fn covered_fraction(&self) -> f64 {
        // Not sum(): that of nothing is −0.
        self.layers.iter().fold(0.0, |sum, layer| sum + layer.area_reached())
    }
}

impl FieldLayer {
    /// Share of the image's pixels that this layer's selected cells own (decision A9).
    pub fn area_reached(&self) -> f64 {
        area_reached(&self.sites, &self.selection)
    }
}

pub(crate) fn area_reached(sites: &Sites, selection: &Selection) -> f64 {
    // Before a run has reached the layer there is no image yet, and no pixel.
    selection.pixels as f64 / (f64::from(sites.width) * f64::from(sites.height)).max(1.0)
}

/// Grows a field: a pure function of the parameters.
///
/// # Errors
/// The first parameter out of range. There is no budget here; see [`Generator::start`].
pub fn generate(params: &Params) -> Result<Field, Error> {
    let mut generator = Generator::new();
    generator.start(params.clone(), u64::MAX)?;
    while !generator.step()? {}
    Ok(generator.into_field())
}
