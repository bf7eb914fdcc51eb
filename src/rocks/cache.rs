//! What the generator keeps of a field: the result of every stage, together with the key of the inputs it was made
//! from.

use super::field::area_reached;
use super::select::{Selection, Threshold};
use super::shape::Shapes;
use super::sites::Sites;
use super::subdivide::counts as counts_of;
use super::voronoi::Cells;
use super::wear::Wear;
use crate::memory::{Counts, Load};
use crate::mesh::Extent;
use crate::params::{Border, Darts, Layer, Params, Swing};

/// The result of a stage and the key of the inputs it was made from.
#[derive(Debug)]
pub(super) struct Cached<K, V> {
    pub(super) key: Option<K>,
    /// Changes exactly when the value does. Later stages use it as part of their key.
    pub(super) version: u64,
    pub(super) value: V,
}

impl<K, V: Default> Default for Cached<K, V> {
    fn default() -> Self {
        Cached { key: None, version: 0, value: V::default() }
    }
}

impl<K: PartialEq, V: Default> Cached<K, V> {
    pub(super) fn is_current(&self, key: &K) -> bool {
        self.key.as_ref() == Some(key)
    }

    pub(super) fn clear(&mut self) {
        *self = Cached::default();
    }
}

/// The inputs of a layer's sites, besides the layer's id. Floats are compared as numbers, which is safe because none of
/// them is NaN.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SitesKey {
    pub(super) seed: u32,
    pub(super) image: [u32; 2],
    pub(super) packing: f64,
    pub(super) darts: Darts,
    pub(super) radius: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct SelectionKey {
    pub(super) cells: u64,
    pub(super) threshold: Threshold,
    pub(super) border: Border,
    /// Version of the footprint.
    pub(super) footprint: u64,
    /// Versions of the selections of all coarser layers.
    pub(super) coarser: Vec<u64>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct MeshKey {
    pub(super) shapes: u64,
    pub(super) taper: [f64; 3],
    pub(super) height: [f64; 3],
    pub(super) swing: Swing,
    pub(super) wear: Wear,
    pub(super) index: usize,
    pub(super) at: Extent,
}

#[derive(Debug, Default)]
pub(super) struct LayerCache {
    /// The layer's parameters, with lengths in px.
    pub(super) layer: Option<Layer>,
    pub(super) sites: Cached<SitesKey, Sites>,
    pub(super) cells: Cached<u64, Cells>,
    pub(super) selection: Cached<SelectionKey, Selection>,
    /// Number of vertices of all selected cells together.
    pub(super) rims: usize,
    pub(super) shapes: Cached<u64, Shapes>,
    pub(super) mesh: Option<MeshKey>,
}

impl LayerCache {
    /// Bytes of memory that the results of all stages use.
    pub(super) fn bytes(&self) -> usize {
        let Cells { starts, vertices, neighbors, grid } = &self.cells.value;
        bytes(&self.sites.value.pixels)
            + bytes(starts)
            + bytes(vertices)
            + bytes(neighbors)
            + grid.bytes()
            + bytes(&self.selection.value.selected)
            + self.shapes.value.bytes()
    }

    /// The sizes of the layer's results, and which of them still have to be made. `expected` is used as the number of
    /// sites while it is not known; `selected` says that the selection is known.
    pub(super) fn load(&self, params: &Params, expected: f64, selected: bool) -> Option<Load> {
        let layer = self.layer.as_ref()?;
        let sites = !self.sites.is_current(&SitesKey::new(params, layer));
        let cells = sites || !self.cells.is_current(&self.sites.version);
        let shapes = !self.shapes.is_current(&self.selection.version);
        let count = if sites { expected } else { self.sites.value.pixels.len() as f64 };
        let corners = if cells { 6.0 * count + 4.0 } else { self.cells.value.vertices.len() as f64 };
        let mut counts = Counts { sites: count, corners, ..Counts::default() };
        if selected {
            let rocks = self.selection.value.selected.len();
            let [vertices, triangles] = counts_of(rocks, self.rims, Wear::of(layer).segments());
            [counts.rocks, counts.rims] = [rocks as f64, self.rims as f64];
            [counts.vertices, counts.triangles] = [vertices as f64, triangles as f64];
        }
        Some(Load { counts, sites, cells, shapes })
    }
}

/// Bytes that a list has allocated, whether they are filled or not.
pub(super) fn bytes<T>(list: &Vec<T>) -> usize {
    list.capacity() * size_of::<T>()
}

impl SitesKey {
    pub(super) fn new(params: &Params, layer: &Layer) -> Self {
        SitesKey {
            seed: params.seed,
            image: [params.image_width, params.image_height],
            packing: params.packing,
            darts: params.darts,
            radius: layer.radius,
        }
    }
}

/// The results of one layer, borrowed from the generator.
#[derive(Debug, Clone, Copy)]
pub struct LayerView<'a> {
    /// The layer's parameters, with lengths in px.
    pub layer: &'a Layer,
    /// Result of stage 1.
    pub sites: &'a Sites,
    /// Result of stage 2.
    pub cells: &'a Cells,
    /// Result of stage 3.
    pub selection: &'a Selection,
}

impl LayerView<'_> {
    /// Share of the image's pixels that the layer's selected cells own, 0 … 1.
    pub fn area_reached(&self) -> f64 {
        area_reached(self.sites, self.selection)
    }

    /// The layer's id, radius (px), N_p, whether the sites are saturated (0 or 1), A_s as asked and as reached, and
    /// whether the selection is saturated (0 or 1).
    pub fn summary(&self) -> [f64; 7] {
        [
            f64::from(self.layer.id),
            self.layer.radius,
            self.sites.target as f64,
            f64::from(self.sites.saturated),
            self.layer.area_fraction,
            self.area_reached(),
            f64::from(self.selection.saturated),
        ]
    }
}
