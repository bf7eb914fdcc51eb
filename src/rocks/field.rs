//! A finished field.

use super::mesh::Mesh;
use super::select::Selection;
use super::shape::Shapes;
use super::sites::Sites;
use super::voronoi::Cells;
use crate::params::Layer;

/// The result of a run, including the intermediate results of every stage.
#[derive(Debug, Clone, Default)]
pub struct Field {
    /// Results per layer, in input order.
    pub layers: Vec<FieldLayer>,
    /// All rocks: layers in input order, and within a layer in the order of the selection.
    pub mesh: Mesh,
}

/// The results of all stages for one layer.
#[derive(Debug, Clone)]
pub struct FieldLayer {
    /// The layer's parameters, with lengths in px.
    pub layer: Layer,
    /// Result of stage 1.
    pub sites: Sites,
    /// Result of stage 2.
    pub cells: Cells,
    /// Result of stage 3.
    pub selection: Selection,
    /// Result of stage 4, before displacement.
    pub shapes: Shapes,
}

impl Field {
    /// Share of the image's pixels that the selected cells of all layers own, 0 … 1 (decision A9).
    pub fn covered_fraction(&self) -> f64 {
        // Folded by hand, because `sum()` of an empty iterator of floats is −0.
        self.layers.iter().fold(0.0, |sum, layer| sum + layer.area_reached())
    }
}

impl FieldLayer {
    /// Share of the image's pixels that this layer's selected cells own, 0 … 1 (decision A9).
    pub fn area_reached(&self) -> f64 {
        self.selection.area_reached(&self.sites)
    }
}
