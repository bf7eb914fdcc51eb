//! What the generator keeps of a field: the result of every stage, together with the key of the inputs it was made
//! from.

use super::field::{Field, FieldLayer};
use super::memory::{Counts, Load, bytes};
use super::mesh::{Extent, Mesh};
use super::select::{Selection, Threshold};
use super::shape::Shapes;
use super::sites::Sites;
use super::subdivide::Fineness;
use super::voronoi::Cells;
use super::wear::Wear;
use crate::cached::Cached;
use crate::params::{Border, Darts, Layer, Params, Swing};

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
    /// Versions of the paint and of the layer's selection without it; zeros for the selection without it.
    pub(super) paint: [u64; 2],
    /// How many coarser layers there are, and the sum of the versions of their selections. Every new version is greater
    /// than all before it, so another selection among as many is another sum.
    pub(super) coarser: [u64; 2],
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
    /// The selection without paint, if anything is painted.
    pub(super) open: Cached<SelectionKey, Selection>,
    /// Number of vertices of all selected cells together.
    pub(super) rims: usize,
    pub(super) shapes: Cached<u64, Shapes>,
    pub(super) mesh: Option<MeshKey>,
}

/// Everything that is kept from run to run.
#[derive(Debug, Default)]
pub(super) struct Results {
    /// The results of the layers, in input order.
    pub(super) layers: Vec<LayerCache>,
    pub(super) mesh: Mesh,
    pub(super) separation: Separation,
}

/// Whether the rocks in the buffers have been drawn apart.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Separation {
    #[default]
    None,
    /// Some of them have been: the buffers are of no use.
    Begun,
    /// They have been; there are so many of them.
    Done(Extent),
}

impl Results {
    /// Bytes of memory that all results use.
    pub(super) fn bytes(&self) -> f64 {
        let layers: usize = self.layers.iter().map(LayerCache::bytes).sum();
        let Mesh { rock_starts, vertex_starts, rock_layer, .. } = &self.mesh;
        let rest = bytes(rock_starts) + bytes(vertex_starts) + bytes(rock_layer);
        (layers + self.mesh.bytes().iter().sum::<usize>() + rest) as f64
    }

    /// Frees the rocks, which then have to be written again.
    pub(super) fn forget_mesh(&mut self) {
        self.mesh = Mesh::default();
        self.layers.iter_mut().for_each(|cache| cache.mesh = None);
    }

    /// Gives the buffers the size of `total`.
    pub(super) fn make_room(&mut self, total: Extent) {
        let Mesh { rock_starts, positions, indices, .. } = &self.mesh;
        let sizes = [rock_starts.len(), positions.len(), indices.len()];
        if sizes == [total.rocks + 1, 3 * total.vertices, 3 * total.triangles] {
            return;
        }
        // Without this, a generator that once made a large field would keep that memory for good.
        if self.mesh.bytes().iter().sum::<usize>() > 2 * (24 * total.vertices + 12 * total.triangles) {
            self.forget_mesh();
        }
        self.mesh.resize(total);
    }

    pub(super) fn views(&self) -> impl ExactSizeIterator<Item = LayerView<'_>> {
        self.layers.iter().map(|cache| LayerView {
            layer: cache.layer.as_ref().unwrap_or(&Layer::EMPTY),
            sites: &cache.sites.value,
            cells: &cache.cells.value,
            selection: &cache.selection.value,
        })
    }

    pub(super) fn into_field(self) -> Field {
        let layers = self.layers.into_iter().filter_map(|cache| {
            Some(FieldLayer {
                layer: cache.layer?,
                sites: cache.sites.value,
                cells: cache.cells.value,
                selection: cache.selection.value,
                shapes: cache.shapes.value,
            })
        });
        Field { layers: layers.collect(), mesh: self.mesh }
    }
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
            + bytes(&self.open.value.selected)
            + self.shapes.value.bytes()
    }

    /// Stores a finished selection. One that is the same as before keeps its version, so everything built on it stays
    /// valid.
    pub(super) fn keep_selection(&mut self, open: bool, key: SelectionKey, version: u64, mut value: Selection) {
        if key.paint[0] > 0 {
            value.saturated = self.open.value.saturated;
        }
        let kept = if open { &mut self.open } else { &mut self.selection };
        let same = kept.key.as_ref().is_some_and(|old| old.cells == key.cells) && kept.value == value;
        let version = if same { kept.version } else { version };
        *kept = Cached { key: Some(key), version, value };
        if open {
            return;
        }
        if !same {
            // The shapes belong to rocks that no longer exist.
            self.shapes.clear();
        }
        let selected = self.selection.value.selected.iter();
        self.rims = selected.map(|&site| self.cells.value.polygon(site as usize).len()).sum();
    }

    /// Number of vertices and of triangles in the buffers, once the rocks are selected; and of vertices of the largest rock that is cut.
    pub(super) fn counts(&self, layer: &Layer) -> [usize; 3] {
        let selected = &self.selection.value.selected;
        Fineness::new(layer.detail, layer.height).counts(&self.cells.value, selected, self.rims)
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
            [counts.rocks, counts.rims] = [rocks as f64, self.rims as f64];
            [counts.vertices, counts.triangles, counts.largest] = self.counts(layer).map(|n| n as f64);
        }
        Some(Load { counts, sites, cells, shapes })
    }
}

impl SitesKey {
    pub(super) fn new(params: &Params, layer: &Layer) -> Self {
        // Without `..`, so that a new parameter does not compile before it is known which stages depend on it.
        let Params {
            seed,
            image_width,
            image_height,
            packing,
            darts,
            // The layers' lengths are in px here.
            notation: _,
            // In the key of the selection.
            border: _,
            // In the key of the mesh.
            swing: _,
            // Decides what becomes of the finished mesh.
            crossing: _,
            look: _,
            layers: _,
        } = *params;
        SitesKey { seed, image: [image_width, image_height], packing, darts, radius: layer.radius }
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
        self.selection.area_reached(self.sites)
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
