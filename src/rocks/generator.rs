//! The generator: runs the stages in small steps and caches their results.
//!
//! Every result is stored with a key: the inputs that it depends on. A run repeatedly finds the first stage whose key
//! differs from the wanted one, and works on it. An edit therefore re-runs the stages from the first one that it
//! affects, a run that is replaced leaves its finished stages behind, and a cached result always equals a newly
//! computed one.

mod selecting;

use super::apart::Separator;
use super::budget::{Budget, Known};
use super::cache::{LayerCache, LayerView, MeshKey, Results, Separation, SitesKey};
use super::field::Field;
use super::footprint::Footprint;
use super::given::Given;
use super::memory::{check_before, expected_sites};
use super::mesh::{Extent, Mesh};
use super::mesher::Mesher;
use super::paint::Paint;
use super::shape::Shaper;
use super::sites::DartThrower;
use super::voronoi::VoronoiBuilder;
use super::wear::Wear;
use super::work::{Taken, VERTICES_PER_STEP, Work};
use crate::cached::Cached;
use crate::error::Error;
use crate::params::{Crossing, Darts, Params, Stage};

/// Grows fields. The results of the last run are kept and re-used as far as they are still valid.
#[derive(Debug, Default)]
pub struct Generator {
    params: Option<Params>,
    footprint: Given<Footprint>,
    paint: Given<Paint>,
    results: Results,
    task: Option<Task>,
    /// The pixels taken by coarser layers, kept while selections run.
    taken: Option<Taken>,
    versions: u64,
    budget: Budget,
    /// The error that ends the run, until [`Generator::step`] returns it.
    refused: Option<Error>,
}

/// The piece of work in progress, on one layer.
#[derive(Debug)]
struct Task {
    layer: usize,
    work: Work,
}

impl Generator {
    /// Makes a generator without cached results.
    pub fn new() -> Self {
        Generator::default()
    }

    /// Sets the ground on which something else stands: from the next [`Generator::start`] on, no cell that touches it
    /// is selected. This is an addition to Fig. 7: the footprint's pixels are flagged before the cells of the first
    /// layer are examined, just as the pixels of larger rocks are flagged before those of smaller ones.
    ///
    /// `triangles` holds x and y (px) of three corners per triangle, in any orientation; triangles may overlap. An
    /// empty slice removes the footprint. A rock stays within its cell at the ground, but its top may lean out of it
    /// (decision A14).
    ///
    /// # Errors
    /// Returns an error, and changes nothing, if there are not six numbers per triangle, more than 2¹⁶ triangles, or a
    /// number beyond ±65,536.
    pub fn set_footprint(&mut self, triangles: &[f64]) -> Result<(), Error> {
        self.footprint.set(Footprint::new(triangles)?);
        Ok(())
    }

    /// Sets how dense the rocks stand where, from the next [`Generator::start`] on (decision A24).
    ///
    /// `mask` holds the rows of a picture of this width, from the top of the picture (the image's last row) to its
    /// bottom, and covers the whole image: where it is 255, rocks stand as the layers ask; where it is 0, none has its
    /// site.
    ///
    /// `strokes` holds, for each stroke: 0 (rocks are added), 1 (erased), 2 (a path that is free of them) or 3 (as if
    /// nothing had been painted there); 0 for all layers, or the id of one + 1; half the stroke's width; its number of
    /// points; and x and y of each. Lengths are in 4096ths of the image's width. Where strokes overlap, the last one
    /// counts. With both empty, nothing is painted.
    ///
    /// # Errors
    /// Returns an error, and changes nothing, if the mask is no rectangle, or a stroke has no point or too few numbers.
    #[cfg(feature = "full")]
    pub fn set_paint(&mut self, mask: Vec<u8>, width: usize, strokes: Vec<f64>) -> Result<(), Error> {
        self.paint.set(Paint::new(mask, width, strokes)?);
        Ok(())
    }

    /// Begins a run. A run in progress is abandoned, but its finished stages are kept.
    ///
    /// # Errors
    /// Returns an error, and changes nothing, if a parameter is out of range or the estimated memory is above
    /// `max_bytes`.
    pub fn start(&mut self, params: Params, max_bytes: u64) -> Result<(), Error> {
        params.validate()?;
        check_before(&params, self.footprint.wanted().is_empty() && self.paint.wanted().is_empty(), max_bytes)?;
        // The results of the previous run are freed before new ones are made, but they count for the peak.
        self.budget = Budget::new(max_bytes, self.results.bytes() + self.given_bytes() as f64);
        self.refused = None;
        self.task = None;
        self.taken = None;
        self.footprint.take_over(&mut self.versions);
        self.paint.take_over(&mut self.versions);
        let is_painted = !self.paint.value.is_empty();
        let mut old = core::mem::take(&mut self.results.layers);
        self.results.layers = params
            .layers
            .iter()
            .map(|layer| {
                let layer = params.layer_in_px(layer);
                let known = old.iter().position(|cache| cache.layer.as_ref().is_some_and(|l| l.id == layer.id));
                let mut cache = known.map(|k| core::mem::take(&mut old[k])).unwrap_or_default();
                if !cache.sites.is_current(&SitesKey::new(&params, &layer)) {
                    // Outdated results are freed before new ones are made, so that the peak is the memory of one field
                    // and not of two.
                    cache.sites.clear();
                    cache.cells.clear();
                    cache.selection.clear();
                    cache.open.clear();
                    cache.shapes.clear();
                    cache.rims = 0;
                }
                if !is_painted {
                    cache.open.clear();
                }
                cache.layer = Some(layer);
                cache
            })
            .collect();
        if self.results.layers.iter().all(|cache| cache.sites.key.is_none()) {
            // Nothing of the old rocks will be used again, and the gaps that they would leave fragment the heap.
            self.results.mesh = Mesh::default();
        }
        drop(old);
        self.params = Some(params);
        self.go_on();
        Ok(())
    }

    /// Does a limited amount of work. Returns true when the run is finished.
    ///
    /// # Errors
    /// Returns [`Error::OverBudget`] if the memory estimate exceeds the budget with what is known by now; see
    /// [`Generator::estimate`]. The run has then ended, and its finished stages are kept.
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

    /// Repeats the memory estimate before a dart thrower lists the clear pixels. Not every layer has to list them.
    fn allow(&mut self, task: &mut Task) -> Result<(), Error> {
        let Work::Sites(_, thrower) = &mut task.work else { return Ok(()) };
        if thrower.waits_for_list() {
            self.budget.clear_bytes = self.budget.clear_bytes.max(thrower.clear_bytes());
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

    /// The stage that the next step works on. [`Stage::Mesh`] when the run is finished.
    pub fn stage(&self) -> Stage {
        self.task.as_ref().map_or(Stage::Mesh, |task| task.work.stage())
    }

    /// Progress, 0 … 1: the finished stages and the fraction of the current one, with layers weighted by their number
    /// of sites.
    pub fn progress(&self) -> f64 {
        let Some(task) = &self.task else { return 1.0 };
        let weight = |cache: &LayerCache| cache.layer.as_ref().map_or(0.0, |l| 1.0 / (l.radius * l.radius).max(1.0));
        let total: f64 = self.results.layers.iter().map(weight).sum();
        let before: f64 = self.results.layers[..task.layer].iter().map(weight).sum();
        let cache = &self.results.layers[task.layer];
        /// Where each stage begins and ends on the progress bar, according to its share of the time for Fig. 1.
        const SHARE: [f64; 6] = [0.0, 0.15, 0.5, 0.65, 0.9, 1.0];
        let stage = self.stage() as usize;
        let done = (before + weight(cache) * task.work.progress(cache)) / total.max(f64::MIN_POSITIVE);
        SHARE[stage] + (SHARE[stage + 1] - SHARE[stage]) * done.min(1.0)
    }

    /// The results of the layers, in input order. They are complete once [`Generator::step`] has returned true.
    pub fn layers(&self) -> impl ExactSizeIterator<Item = LayerView<'_>> {
        self.results.views()
    }

    /// The mesh. It is complete once [`Generator::step`] has returned true.
    pub fn mesh(&self) -> &Mesh {
        &self.results.mesh
    }

    /// The numbers of rocks and triangles, the covered fraction (0 … 1), and the number of layers.
    pub fn summary(&self) -> [f64; 4] {
        let covered = self.layers().fold(0.0, |sum, layer| sum + layer.area_reached());
        let mesh = self.mesh();
        [mesh.rocks() as f64, mesh.triangles() as f64, covered, self.results.layers.len() as f64]
    }

    /// Turns the generator into the finished field.
    pub fn into_field(self) -> Field {
        self.results.into_field()
    }

    /// Bytes that the run needs at its peak, output included. This is the largest of the estimates made so far: one at
    /// the start and one before each stage; see [`crate::memory_estimate`].
    pub fn estimate(&self) -> u64 {
        self.budget.estimate
    }

    fn given_bytes(&self) -> usize {
        self.footprint.sum(Footprint::bytes) + self.paint.sum(Paint::bytes)
    }

    /// Repeats the memory estimate with what is `known`, before a stage allocates.
    fn check_memory(&mut self, known: Known) -> Result<(), Error> {
        let given = self.given_bytes();
        let Some(params) = &self.params else { return Ok(()) };
        self.budget.check(known, params, &mut self.results, given)
    }

    /// The next piece of work: the first stage whose result is not in the cache. `None` when the run is finished.
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
            let builder = VoronoiBuilder::new(&self.results.layers[k].sites.value);
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

    /// The first layer for which `is_stale` returns true.
    fn first(&self, is_stale: impl Fn(&LayerCache, &Params) -> bool) -> Option<usize> {
        let params = self.params.as_ref()?;
        self.results.layers.iter().position(|cache| is_stale(cache, params))
    }

    fn new_sites(&self, k: usize) -> Option<Task> {
        let (params, layer) = (self.params.as_ref()?, self.results.layers[k].layer.as_ref()?);
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
        let (seed, cache) = (self.params.as_ref()?.seed, &self.results.layers[k]);
        let shaper =
            Shaper::new(&cache.selection.value.selected, cache.cells.value.len(), seed, cache.layer.as_ref()?.id);
        Some(Task { layer: k, work: Work::Shapes(Box::new(shaper)) })
    }

    fn next_mesh(&mut self) -> Option<Task> {
        let swing = self.params.as_ref()?.swing;
        let mut at = Extent::default();
        let mut keys = Vec::with_capacity(self.results.layers.len());
        for (index, cache) in self.results.layers.iter_mut().enumerate() {
            let layer = cache.layer.as_ref()?;
            let sizes = cache.counts(layer);
            let shapes = &cache.shapes.value;
            let wear = Wear::of(layer);
            let (taper, height) = (layer.taper, layer.height);
            let key = MeshKey { shapes: cache.shapes.version, taper, height, swing, wear, index, at };
            // Rocks whose place in the buffers has changed may be overwritten by another layer from here on.
            if cache.mesh.as_ref() != Some(&key) {
                cache.mesh = None;
            }
            keys.push(key);
            let [vertices, triangles, _] = sizes;
            at.rocks += shapes.len();
            at.vertices += vertices;
            at.triangles += triangles;
        }
        self.results.make_room(at);
        let apart = self.params.as_ref()?.crossing == Crossing::Apart;
        let is_stale = |cache: &LayerCache| cache.mesh.is_none();
        // Rocks are drawn apart from those of all layers, so that none can be kept when one changes.
        let keeps =
            apart && self.results.separation == Separation::Done(at) && !self.results.layers.iter().any(is_stale);
        if self.results.separation != Separation::None && !keeps {
            self.results.layers.iter_mut().for_each(|cache| cache.mesh = None);
            self.results.separation = Separation::None;
        }
        let Some(stale) = self.results.layers.iter().position(is_stale) else {
            return (apart && !keeps && at.rocks > 0).then(|| self.new_separation(at));
        };
        let key = keys.swap_remove(stale);
        let cache = &self.results.layers[stale];
        let mesher = Mesher::new(key, &cache.selection.value.selected, cache.cells.value.len());
        Some(Task { layer: stale, work: Work::Mesh(Box::new(mesher)) })
    }

    /// The task that draws the finished rocks apart.
    fn new_separation(&mut self, of: Extent) -> Task {
        let Results { layers, separation, .. } = &mut self.results;
        *separation = Separation::Begun;
        let longer = self.params.as_ref().map_or(0, |params| params.image_width.max(params.image_height));
        Task { layer: layers.len().saturating_sub(1), work: Work::Apart(Box::new(Separator::new(layers, of, longer))) }
    }

    /// Works on a task for a while. Returns true when it is done.
    fn advance(&mut self, task: &mut Task) -> bool {
        let Results { layers, mesh, .. } = &mut self.results;
        if let Work::Apart(separator) = &mut task.work {
            return separator.advance(layers, mesh, VERTICES_PER_STEP);
        }
        let (Some(cache), Some(params)) = (layers.get(task.layer), &self.params) else { return true };
        task.work.advance(cache, params, &self.paint.value, &mut self.taken, mesh)
    }

    /// Stores the result of a finished task in the cache.
    fn complete(&mut self, task: Task) {
        self.versions += 1;
        let version = self.versions;
        let cache = &mut self.results.layers[task.layer];
        match task.work {
            Work::Sites(key, thrower) => {
                cache.sites = Cached { key: Some(key), version, value: thrower.finish() };
            }
            Work::Cells(builder) => {
                cache.cells = Cached { key: Some(cache.sites.version), version, value: builder.finish() };
            }
            Work::Flag(_) => {
                if let Some(taken) = &mut self.taken {
                    taken.flagged += 1;
                }
            }
            Work::Selection(key, selector) => {
                let open = key.paint[0] == 0 && !self.paint.value.is_empty();
                cache.keep_selection(open, key, version, selector.finish());
            }
            Work::Shapes(shaper) => {
                cache.shapes = Cached { key: Some(cache.selection.version), version, value: shaper.finish() };
            }
            Work::Mesh(mesher) => cache.mesh = Some(mesher.key),
            Work::Apart(separator) => self.results.separation = Separation::Done(separator.of),
        }
    }
}

/// Grows a field and returns it. The result depends on the parameters alone.
///
/// # Errors
/// Returns the first parameter that is out of range. Memory is not limited here; see [`Generator::start`] for a budget.
pub fn generate(params: &Params) -> Result<Field, Error> {
    let mut generator = Generator::new();
    generator.start(params.clone(), u64::MAX)?;
    while !generator.step()? {}
    Ok(generator.into_field())
}
