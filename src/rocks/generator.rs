//! The stages, run in pieces and cached.
//!
//! Every stage of every layer is keyed by what it is a function of. A run is nothing but: find the first stage
//! whose key differs from the wanted one, and work on it. So an edit re-runs from the first stage it touches, a
//! superseded run leaves its finished stages behind, and a cached result is the full result by construction.

use super::budget::Known;
use super::cache::{Cached, LayerCache, LayerView, MeshKey, SelectionKey, SitesKey};
use super::field::{Field, FieldLayer};
use super::footprint::Footprint;
use super::mesher::{Mesher, Source};
use super::select::{Selector, Threshold, flag};
use super::shape::Shaper;
use super::sites::DartThrower;
use super::subdivide::counts;
use super::voronoi::VoronoiBuilder;
use super::wear::Wear;
use crate::bitmap::Bitmap;
use crate::error::Error;
use crate::memory::{check_before, coarsest_first, expected_sites};
use crate::mesh::{Extent, Mesh};
use crate::params::{Border, Darts, Layer, Params, Stage};

/// Picks, cells or rocks that one step works on: one to three milliseconds in wasm.
const PICKS_PER_STEP: u32 = 1 << 15;
const CELLS_PER_STEP: usize = 1 << 11;
const ROCKS_PER_STEP: usize = 1 << 10;

/// Grows fields, keeping the stages of the last one.
#[derive(Debug, Default)]
pub struct Generator {
    pub(super) params: Option<Params>,
    /// With its version.
    pub(super) footprint: (Footprint, u64),
    /// The footprint from the next start on, where it is another.
    pub(super) next_footprint: Option<Footprint>,
    /// In input order.
    pub(super) layers: Vec<LayerCache>,
    pub(super) mesh: Mesh,
    task: Option<Task>,
    /// Pixels taken by the coarser layers while a selection runs.
    taken: Option<Taken>,
    versions: u64,
    pub(super) max_bytes: u64,
    /// What was known when the memory was last estimated.
    pub(super) checked: Known,
    /// Bytes at the peak so far: of what the run before has left, and of the run's stages up to the selection.
    pub(super) peak_before: f64,
    /// The run has made a selection.
    pub(super) selects: bool,
    /// Most bytes that the run has taken to find clear pixels.
    pub(super) clear_bytes: f64,
    /// The largest estimate of the run.
    pub(super) estimate: u64,
    /// Why the run cannot go on.
    refused: Option<Error>,
}

#[derive(Debug)]
struct Taken {
    bitmap: Bitmap,
    /// Versions of the selections already flagged, coarsest first.
    flagged: Vec<u64>,
}

/// The piece of work in progress, on one layer.
#[derive(Debug)]
struct Task {
    layer: usize,
    work: Work,
}

#[derive(Debug)]
enum Work {
    Sites(SitesKey, Box<DartThrower>),
    Cells(Box<VoronoiBuilder>),
    /// Flags the cells of a coarser layer, from this one on.
    Flag(usize),
    Selection(SelectionKey, Box<Selector>),
    Shapes(Box<Shaper>),
    Mesh(Box<Mesher>),
}

impl Generator {
    /// An empty cache.
    pub fn new() -> Self {
        Generator::default()
    }

    /// Ground that something else stands on: from the next [`Generator::start`] on, no cell that touches it is selected. An addition to
    /// Fig. 7: its pixels are flagged before the first layer's cells are looked at, as those of larger rocks are before the smaller ones'.
    ///
    /// `triangles` has x, y (px) of three corners each, in any orientation, overlapping or not; none takes the footprint away. A rock
    /// stays within its cell at the ground; its top may lean out of it (decision A14).
    ///
    /// # Errors
    /// Not six numbers per triangle, more than 2¹⁶ of them, or a number beyond ±65,536; then nothing has changed.
    pub fn set_footprint(&mut self, triangles: &[f64]) -> Result<(), Error> {
        let footprint = Footprint::new(triangles)?;
        self.next_footprint = (footprint != self.footprint.0).then_some(footprint);
        Ok(())
    }

    /// Begins a run, dropping the one in progress but not the stages it has finished.
    ///
    /// # Errors
    /// A parameter out of range, or an estimate over `max_bytes`; then nothing has changed.
    pub fn start(&mut self, params: Params, max_bytes: u64) -> Result<(), Error> {
        params.validate()?;
        let footprint = self.next_footprint.as_ref().unwrap_or(&self.footprint.0);
        check_before(&params, footprint.is_empty(), max_bytes)?;
        // What the run before has left goes before anything comes, but it was there.
        self.peak_before = self.held();
        self.checked = Known::Nothing;
        (self.selects, self.clear_bytes) = (false, 0.0);
        (self.max_bytes, self.estimate, self.refused) = (max_bytes, 0, None);
        self.task = None;
        self.taken = None;
        if let Some(footprint) = self.next_footprint.take() {
            self.versions += 1;
            self.footprint = (footprint, self.versions);
        }
        let mut old = core::mem::take(&mut self.layers);
        self.layers = params
            .layers
            .iter()
            .map(|layer| {
                let layer = params.layer_in_px(layer);
                let known = old.iter().position(|cache| cache.layer.as_ref().is_some_and(|l| l.id == layer.id));
                let mut cache = known.map(|k| core::mem::take(&mut old[k])).unwrap_or_default();
                if !cache.sites.is_current(&SitesKey::new(&params, &layer)) {
                    // Stale stages go before new ones come: the peak is one field, not two.
                    cache.sites.clear();
                    cache.cells.clear();
                    cache.selection.clear();
                    cache.shapes.clear();
                    cache.rims = 0;
                }
                cache.layer = Some(layer);
                cache
            })
            .collect();
        if self.layers.iter().all(|cache| cache.sites.key.is_none()) {
            // Nothing of the old rocks will be used again, and holes where they stood would only fragment the heap.
            self.mesh = Mesh::default();
        }
        drop(old);
        self.params = Some(params);
        self.go_on();
        Ok(())
    }

    /// Does a bounded piece of work. True when the run is finished.
    ///
    /// # Errors
    /// [`Error::OverBudget`], now that more is known than at the start; see [`Generator::estimate`]. The run has ended, and the stages
    /// that are finished are kept.
    pub fn step(&mut self) -> Result<bool, Error> {
        if let Some(mut task) = self.task.take() {
            if self.advance(&mut task) {
                self.complete(task);
                self.go_on();
            } else {
                match self.allow(&mut task) {
                    Ok(()) => self.task = Some(task),
                    Err(error) => self.refused = Some(error),
                }
            }
        }
        self.refused.take().map_or(Ok(self.task.is_none()), Err)
    }

    /// Estimates again before darts list the clear pixels, which not all have to.
    fn allow(&mut self, task: &mut Task) -> Result<(), Error> {
        let Work::Sites(_, thrower) = &mut task.work else { return Ok(()) };
        if thrower.waits_for_list() {
            self.clear_bytes = self.clear_bytes.max(thrower.clear_bytes());
            self.check_memory(Known::Nothing)?;
            thrower.may_list = true;
        }
        Ok(())
    }

    fn go_on(&mut self) {
        match self.next_task() {
            Ok(task) => self.task = task,
            Err(error) => {
                self.taken = None;
                self.refused = Some(error);
            }
        }
    }

    /// The stage that the next step works on; [`Stage::Mesh`] when the run is finished.
    pub fn stage(&self) -> Stage {
        match self.task.as_ref().map(|task| &task.work) {
            Some(Work::Sites(..)) => Stage::Sites,
            Some(Work::Cells(..)) => Stage::Cells,
            Some(Work::Flag(..) | Work::Selection(..)) => Stage::Selection,
            Some(Work::Shapes(..)) => Stage::Shape,
            Some(Work::Mesh(..)) => Stage::Mesh,
            None => Stage::Mesh,
        }
    }

    /// 0 … 1: finished stages and the fraction of the one at work, layers weighted by their number of sites.
    pub fn progress(&self) -> f64 {
        let Some(task) = &self.task else { return 1.0 };
        let weight = |cache: &LayerCache| cache.layer.as_ref().map_or(0.0, |l| 1.0 / (l.radius * l.radius).max(1.0));
        let total: f64 = self.layers.iter().map(weight).sum();
        let before: f64 = self.layers[..task.layer].iter().map(weight).sum();
        let cache = &self.layers[task.layer];
        let fraction = match &task.work {
            Work::Sites(_, thrower) => thrower.progress(),
            Work::Cells(builder) => builder.progress(&cache.sites.value),
            Work::Flag(_) => 0.0,
            Work::Selection(_, selector) => selector.progress(),
            Work::Shapes(shaper) => shaper.progress(),
            Work::Mesh(mesher) => mesher.progress(&cache.shapes.value),
        };
        /// Where each stage begins and ends on the bar: its share of the time for Fig. 1.
        const SHARE: [f64; 6] = [0.0, 0.15, 0.5, 0.65, 0.9, 1.0];
        let stage = self.stage() as usize;
        let done = (before + weight(cache) * fraction) / total.max(f64::MIN_POSITIVE);
        SHARE[stage] + (SHARE[stage + 1] - SHARE[stage]) * done.min(1.0)
    }

    /// The layers' results in input order. Complete once [`Generator::step`] has returned true.
    pub fn layers(&self) -> impl ExactSizeIterator<Item = LayerView<'_>> {
        self.layers.iter().map(|cache| LayerView {
            layer: cache.layer.as_ref().unwrap_or(&Layer::EMPTY),
            sites: &cache.sites.value,
            cells: &cache.cells.value,
            selection: &cache.selection.value,
        })
    }

    /// The buffers. Complete once [`Generator::step`] has returned true.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Rocks, triangles, covered fraction, layers.
    pub fn summary(&self) -> [f64; 4] {
        let covered = self.layers().fold(0.0, |sum, layer| sum + layer.area_reached());
        [self.mesh.rocks() as f64, self.mesh.triangles() as f64, covered, self.layers.len() as f64]
    }

    /// The field as a value of its own.
    pub fn into_field(self) -> Field {
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

    /// The first piece of work whose result is not in the cache.
    fn next_task(&mut self) -> Result<Option<Task>, Error> {
        if let Some(k) = self.first(|cache, params| {
            let key = cache.layer.as_ref().map(|layer| SitesKey::new(params, layer));
            key.is_some_and(|key| !cache.sites.is_current(&key))
        }) {
            self.check_memory(Known::Nothing)?;
            return Ok(self.new_sites(k));
        }
        if let Some(k) = self.first(|cache, _| !cache.cells.is_current(&cache.sites.version)) {
            self.check_memory(Known::Sites)?;
            let builder = VoronoiBuilder::new(&self.layers[k].sites.value);
            return Ok(Some(Task { layer: k, work: Work::Cells(Box::new(builder)) }));
        }
        if let Some(task) = self.next_selection()? {
            return Ok(Some(task));
        }
        self.taken = None;
        self.check_memory(Known::Rocks)?;
        if let Some(k) = self.first(|cache, _| !cache.shapes.is_current(&cache.selection.version)) {
            return Ok(self.new_shapes(k));
        }
        Ok(self.next_mesh())
    }

    /// The first layer with a stage that is to be made.
    fn first(&self, is_stale: impl Fn(&LayerCache, &Params) -> bool) -> Option<usize> {
        let params = self.params.as_ref()?;
        self.layers.iter().position(|cache| is_stale(cache, params))
    }

    fn new_sites(&self, k: usize) -> Option<Task> {
        let (params, layer) = (self.params.as_ref()?, self.layers[k].layer.as_ref()?);
        let key = SitesKey::new(params, layer);
        let thrower = DartThrower::new(
            key.image,
            layer.radius,
            params.packing,
            params.darts == Darts::Attempts,
            [params.seed, layer.id],
            expected_sites(params, layer.radius) as usize,
        );
        Some(Task { layer: k, work: Work::Sites(key, Box::new(thrower)) })
    }

    fn new_shapes(&mut self, k: usize) -> Option<Task> {
        let (seed, cache) = (self.params.as_ref()?.seed, &self.layers[k]);
        let shaper =
            Shaper::new(&cache.selection.value.selected, cache.cells.value.len(), seed, cache.layer.as_ref()?.id);
        Some(Task { layer: k, work: Work::Shapes(Box::new(shaper)) })
    }

    /// Layers by descending mean cell area W·H / n, equal ones in input order (decision A7).
    fn selection_order(&self) -> Vec<usize> {
        coarsest_first(self.layers.len(), |k| self.layers[k].sites.value.pixels.len() as f64)
    }

    /// The coarsest layer whose selection is to be made.
    fn stale_selection(&self) -> Option<(usize, SelectionKey)> {
        let params = self.params.as_ref()?;
        let mut coarser = Vec::new();
        for k in self.selection_order() {
            let cache = &self.layers[k];
            let layer = cache.layer.as_ref()?;
            let key = SelectionKey {
                cells: cache.cells.version,
                threshold: layer.cell_count.map_or(Threshold::Area(layer.area_fraction), Threshold::Count),
                border: params.border,
                footprint: self.footprint.1,
                coarser: coarser.clone(),
            };
            if !cache.selection.is_current(&key) {
                return Some((k, key));
            }
            coarser.push(cache.selection.version);
        }
        None
    }

    fn next_selection(&mut self) -> Result<Option<Task>, Error> {
        let Some((k, key)) = self.stale_selection() else { return Ok(None) };
        self.check_memory(Known::Sites)?;
        self.selects = true;
        Ok(self.new_selection(k, key))
    }

    /// Selects from layer `k`, once the cells of all coarser layers are flagged.
    fn new_selection(&mut self, k: usize, key: SelectionKey) -> Option<Task> {
        let order = self.selection_order();
        let params = self.params.as_ref()?;
        let taken = self.taken.get_or_insert_with(|| {
            let image = [params.image_width, params.image_height];
            let mut bitmap = Bitmap::new(image[0], image[1]);
            self.footprint.0.flag(image, &mut bitmap);
            Taken { bitmap, flagged: Vec::new() }
        });
        let flagged = taken.flagged.len();
        if flagged < key.coarser.len() {
            return Some(Task { layer: order[flagged], work: Work::Flag(0) });
        }
        let cache = &self.layers[k];
        let layer = cache.layer.as_ref()?;
        let drop_border = params.border == Border::Drop;
        let selector = Selector::new(&cache.cells.value, key.threshold, drop_border, params.seed, layer.id);
        Some(Task { layer: k, work: Work::Selection(key, Box::new(selector)) })
    }

    fn next_mesh(&mut self) -> Option<Task> {
        let swing = self.params.as_ref()?.swing;
        let mut at = Extent::default();
        let mut keys = Vec::with_capacity(self.layers.len());
        for (index, cache) in self.layers.iter_mut().enumerate() {
            let layer = cache.layer.as_ref()?;
            let shapes = &cache.shapes.value;
            let wear = Wear::of(layer);
            let Layer { taper, height, .. } = *layer;
            let key = MeshKey { shapes: cache.shapes.version, taper, height, swing, wear, index, at };
            // What stood elsewhere in the buffers may be overwritten by another layer from here on.
            if cache.mesh.as_ref() != Some(&key) {
                cache.mesh = None;
            }
            keys.push(key);
            let [vertices, triangles] = counts(shapes.len(), shapes.top_vertices(), wear.segments());
            at.rocks += shapes.len();
            at.vertices += vertices;
            at.triangles += triangles;
        }
        if self.mesh.rock_starts.len() != at.rocks + 1
            || self.mesh.positions.len() != 3 * at.vertices
            || self.mesh.indices.len() != 3 * at.triangles
        {
            // A field that once was large would keep its memory for good.
            if self.mesh.bytes().iter().sum::<usize>() > 2 * (24 * at.vertices + 12 * at.triangles) {
                self.mesh = Mesh::default();
                self.layers.iter_mut().for_each(|cache| cache.mesh = None);
            }
            self.mesh.resize(at);
        }
        let stale = self.layers.iter().position(|cache| cache.mesh.is_none())?;
        let key = keys.swap_remove(stale);
        let cache = &self.layers[stale];
        let mesher = Mesher::new(key, &cache.selection.value.selected, cache.cells.value.len());
        Some(Task { layer: stale, work: Work::Mesh(Box::new(mesher)) })
    }

    /// Works on a task for a while. True when it is done.
    ///
    /// The stages are functions of their own, never inlined here: V8 makes a third slower code of very large functions.
    fn advance(&mut self, task: &mut Task) -> bool {
        let (Some(cache), Some(params)) = (self.layers.get(task.layer), &self.params) else { return true };
        let (sites, cells) = (&cache.sites.value, &cache.cells.value);
        let selected = &cache.selection.value.selected;
        match (&mut task.work, &mut self.taken) {
            (Work::Sites(_, thrower), _) => thrower.advance(PICKS_PER_STEP),
            (Work::Cells(builder), _) => builder.advance(sites, CELLS_PER_STEP),
            (Work::Flag(from), Some(taken)) => {
                let to = (*from + CELLS_PER_STEP).min(selected.len());
                flag(sites, cells, &selected[*from..to], &mut taken.bitmap);
                *from = to;
                to == selected.len()
            }
            (Work::Selection(_, selector), Some(taken)) => {
                selector.advance(sites, cells, &taken.bitmap, CELLS_PER_STEP)
            }
            (Work::Flag(_) | Work::Selection(..), None) => true,
            (Work::Shapes(shaper), _) => shaper.advance(cells, selected, ROCKS_PER_STEP),
            (Work::Mesh(mesher), _) => {
                let Some(layer) = &cache.layer else { return true };
                let of = Source { seed: params.seed, layer: layer.id, cells, selected, shapes: &cache.shapes.value };
                mesher.advance(&of, &mut self.mesh, ROCKS_PER_STEP)
            }
        }
    }

    /// Puts a finished task's result into the cache.
    fn complete(&mut self, task: Task) {
        self.versions += 1;
        let version = self.versions;
        let cache = &mut self.layers[task.layer];
        match task.work {
            Work::Sites(key, thrower) => {
                cache.sites = Cached { key: Some(key), version, value: thrower.finish() };
            }
            Work::Cells(builder) => {
                cache.cells = Cached { key: Some(cache.sites.version), version, value: builder.finish() };
            }
            Work::Flag(_) => {
                if let Some(taken) = &mut self.taken {
                    taken.flagged.push(cache.selection.version);
                }
            }
            Work::Selection(key, selector) => {
                let value = selector.finish();
                // A selection that came out the same keeps its version, and with it all that is built on it.
                let same = cache.selection.key.as_ref().is_some_and(|old| old.cells == key.cells)
                    && cache.selection.value == value;
                let version = if same { cache.selection.version } else { version };
                if !same {
                    // Shapes of rocks that stand no longer.
                    cache.shapes.clear();
                }
                cache.rims = value.selected.iter().map(|&site| cache.cells.value.polygon(site as usize).len()).sum();
                cache.selection = Cached { key: Some(key), version, value };
            }
            Work::Shapes(shaper) => {
                cache.shapes = Cached { key: Some(cache.selection.version), version, value: shaper.finish() };
            }
            Work::Mesh(mesher) => cache.mesh = Some(mesher.key),
        }
    }
}
