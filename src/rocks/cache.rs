//! What the generator keeps of a field: every stage's result with the key of what it is a function of.

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

/// The result of a stage and what it is a function of.
#[derive(Debug)]
pub(super) struct Cached<K, V> {
    pub(super) key: Option<K>,
    /// Changes exactly when the value does: the key of what is built on it.
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

/// What the sites of a layer are a function of, besides its id. Floats compare as numbers: none of them is NaN.
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
    /// Versions of the selections that went before.
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
    /// Lengths in px.
    pub(super) layer: Option<Layer>,
    pub(super) sites: Cached<SitesKey, Sites>,
    pub(super) cells: Cached<u64, Cells>,
    pub(super) selection: Cached<SelectionKey, Selection>,
    /// Vertices of the selected cells, all together.
    pub(super) rims: usize,
    pub(super) shapes: Cached<u64, Shapes>,
    pub(super) mesh: Option<MeshKey>,
}

impl LayerCache {
    /// Bytes of the stages' results.
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

    /// What is known of the layer, and what is still to be made for it; `expected` sites where they are not known.
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

/// What a list takes, filled or not.
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

/// One layer's results, borrowed.
#[derive(Debug, Clone, Copy)]
pub struct LayerView<'a> {
    /// What was asked for, lengths in px.
    pub layer: &'a Layer,
    /// Stage 1.
    pub sites: &'a Sites,
    /// Stage 2.
    pub cells: &'a Cells,
    /// Stage 3.
    pub selection: &'a Selection,
}

impl LayerView<'_> {
    /// Share of the image's pixels that the selected cells own.
    pub fn area_reached(&self) -> f64 {
        area_reached(self.sites, self.selection)
    }

    /// Id, radius (px), N_p, sites saturated, A_s asked and reached, selection saturated.
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
