//! The generator: runs the stages in small steps and caches their results.
//!
//! Every result is stored with a key: the inputs that it depends on. An edit re-runs the stages from the first one that
//! it affects, and a run that is replaced leaves its finished stages behind. The colony is written before its
//! collisions are solved, so that there is something to show early.

use glam::DVec3;

use super::body::{Bend, Layout};
use super::bowl::bowl;
use super::deform::{Sheet, deform};
use super::feet::Feet;
use super::ground::{Given, Ground, Grown};
use super::keys::{BodiesKey, Keys, LogKey, SpawnKey};
use super::log::{Log, Sweep, counts};
use super::memory::Memory;
use super::mesh::{ColonyMesh, LogMesh, shade, write};
use super::pose::Poser;
use super::press::{Bodies, Press};
use super::settle::{Settle, Stats};
use super::spawn::{Individual, Spawn, spawn};
use super::task::Task;
use super::thesis::Thesis;
use super::user_log::{LogError, Surface, user_log};
use super::work::Work;
use crate::cached::Cached;
use crate::error::Error;
use crate::params::wood_ear::{Collisions, Params, Stage};

/// Amounts of work that one step does, which takes one to five milliseconds in wasm.
const LOG_VERTICES_PER_STEP: usize = 1 << 13;
const DARTS_PER_STEP: usize = 1 << 13;
const GROUND_PER_STEP: usize = 1 << 14;
const BODY_VERTICES_PER_STEP: usize = 1 << 15;
const ROUNDS_PER_STEP: u32 = 150;
const PAIRS_PER_STEP: usize = 100;

/// Grows colonies. The results of the last run are kept and re-used as far as they are still valid.
#[derive(Debug, Default)]
pub struct Generator {
    params: Option<Params>,
    keys: Option<Keys>,
    /// What is known of a log given by the user, and its number, which identifies it in keys. Its mesh is `log_mesh`.
    given: Option<(u32, Box<Surface>)>,
    logs_given: u32,
    /// The points that individuals stand on: the coarse mesh of a grown log, or the feet drawn on a log given by the
    /// user.
    log: Cached<LogKey, Log>,
    /// Per foot, the number of its triangle in the mesh as it was given. Empty for a grown log.
    foot_triangles: Vec<u32>,
    log_mesh: LogMesh,
    log_version: u32,
    /// With the version of the log.
    spawn: Cached<(u64, SpawnKey), Spawn>,
    layout: Layout,
    /// With the version of the individuals' places.
    sheets: Cached<(u64, BodiesKey), Vec<Sheet>>,
    /// The obstacle that individuals keep out of. `None` if they need not, or if it has not been made yet.
    ground: Cached<LogKey, Option<Ground>>,
    mesh: ColonyMesh,
    /// The figures of the run. They have no key while the mesh holds the colony before its collisions are solved.
    stats: Cached<Collisions, Stats>,
    /// The estimated work that is left after the preview.
    work: Work,
    /// True if the mesh was written by this run or is still valid for it.
    preview: bool,
    task: Option<Task>,
    memory: Memory,
    /// The error that ends the run, until [`Generator::step`] returns it.
    refused: Option<Error>,
}

impl Generator {
    /// Makes a generator without cached results.
    pub fn new() -> Self {
        Generator::default()
    }

    /// Sets a mesh that is used as the log from the next [`Generator::start`] on, instead of a grown one: 3 numbers per
    /// vertex (cm, z up) and 3 indices per triangle (counter-clockwise seen from outside). Vertices at the same place
    /// are welded, and a closed mesh that is inside out is turned (see [`Generator::log_turned`]). Individuals stand
    /// anywhere on its surface, as densely as `log.spacing` says, however it is divided into triangles.
    ///
    /// # Errors
    /// Returns what is wrong with the mesh, and changes nothing.
    pub fn set_log(&mut self, positions: &[f32], indices: &[u32]) -> Result<(), LogError> {
        let (surface, mesh) = user_log(positions, indices)?;
        self.task = None;
        self.memory.note_given(&surface);
        self.logs_given += 1;
        self.log_mesh = mesh;
        self.log_version += 1;
        self.given = Some((self.logs_given, Box::new(surface)));
        self.log.key = None;
        Ok(())
    }

    /// Returns to the grown log, from the next [`Generator::start`] on.
    pub fn clear_log(&mut self) {
        self.task = None;
        self.given = None;
    }

    /// Whether the log given by the user was inside out and has been turned.
    pub fn log_turned(&self) -> bool {
        self.given.as_ref().is_some_and(|(_, surface)| surface.is_turned)
    }

    /// Begins a run. A run in progress is abandoned, but its finished stages are kept.
    ///
    /// # Errors
    /// Returns an error, and changes nothing, if a parameter is out of range or the estimated memory is above
    /// `max_bytes`.
    pub fn start(&mut self, params: Params, max_bytes: u64) -> Result<(), Error> {
        params.validate()?;
        self.begin(params, max_bytes)
    }

    /// Like [`Generator::start`], for parameters that have been checked already.
    pub(crate) fn begin(&mut self, params: Params, max_bytes: u64) -> Result<(), Error> {
        let keys = Keys::new(&params, self.given.as_ref().map(|(number, _)| *number));
        let surface = self.given.as_ref().map(|(_, surface)| &**surface);
        let is_stale = !self.log.is_current(&keys.log);
        if self.memory.check_log(&params, surface, &self.log_mesh, is_stale, max_bytes)? {
            self.forget_colony();
        }
        self.params = Some(params);
        self.keys = Some(keys);
        self.preview = false;
        self.refused = None;
        self.task = self.next_task();
        Ok(())
    }

    /// Does a limited amount of work. Returns true when the run is finished.
    ///
    /// # Errors
    /// Returns [`Error::OverBudget`] if the memory estimate exceeds the budget once the individuals are counted; see
    /// [`Generator::estimate`]. The run has then ended before any individual was made, and the log is kept.
    pub fn step(&mut self) -> Result<bool, Error> {
        if let Some(task) = self.task.take() {
            self.task = self.advance(task);
        }
        self.refused.take().map_or(Ok(self.task.is_none()), Err)
    }

    /// Frees the colony, which has to be made again in any case.
    fn forget_colony(&mut self) {
        self.spawn.clear();
        self.sheets.clear();
        self.mesh = ColonyMesh::default();
    }

    /// The stage that the next step works on. [`Stage::Mesh`] when the run is finished.
    pub fn stage(&self) -> Stage {
        self.task.as_ref().map_or(Stage::Mesh, Task::stage)
    }

    /// Progress of the run, 0 … 1.
    pub fn progress(&self) -> f64 {
        let individuals = self.spawn.value.individuals.len();
        self.task.as_ref().map_or(1.0, |task| task.progress(individuals, &self.work))
    }

    /// Whether the buffers, including those of the log, hold this run's colony, with or without its collisions solved.
    /// True at the latest when [`Generator::step`] returns true. If it is true before that, the buffers are a complete
    /// colony whose individuals may cross.
    pub fn preview_ready(&self) -> bool {
        self.preview
    }

    /// The colony's mesh; see [`Generator::preview_ready`] for when it is valid.
    pub fn mesh(&self) -> &ColonyMesh {
        &self.mesh
    }

    /// The visible log. It is complete when [`Generator::preview_ready`] returns true.
    pub fn log_mesh(&self) -> &LogMesh {
        &self.log_mesh
    }

    /// A number that grows whenever [`Generator::log_mesh`] changes.
    pub fn log_version(&self) -> u32 {
        self.log_version
    }

    /// The points that individuals stand on: the vertices of the grown log's coarse mesh, or the feet drawn on a log
    /// given by the user.
    pub fn log(&self) -> &Log {
        &self.log.value
    }

    /// The individuals, with the places they stand on.
    pub fn spawn(&self) -> &Spawn {
        &self.spawn.value
    }

    /// The individuals' sheets before collisions, in the order of the individuals.
    pub fn sheets(&self) -> &[Sheet] {
        &self.sheets.value
    }

    /// The structure that all bodies share.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Positions of the bases, 3 numbers each, cm. Each base stands on the log's vertex nearest to where it was wanted.
    pub fn bases(&self) -> Vec<f64> {
        self.spawn.value.bases.iter().flat_map(|v| self.log.value.points[*v as usize].to_array()).collect()
    }

    /// Figures of the run. They are complete once [`Generator::step`] has returned true.
    pub fn stats(&self) -> Stats {
        self.stats.value
    }

    /// Bytes that the run needs at its peak, output included, as far as that is known: the larger of the estimate made
    /// at the start and the one made when the individuals were counted.
    pub fn estimate(&self) -> u64 {
        self.memory.estimate()
    }

    /// The next piece of work: the first stage whose result is not in the cache. `None` when the run is finished.
    fn next_task(&mut self) -> Option<Task> {
        let (params, keys) = (self.params.as_ref()?, self.keys.as_ref()?);
        if self.ground.key != keys.ground {
            // It belongs to another log, or nothing has to keep clear of the log.
            self.ground.clear();
        }
        if !self.log.is_current(&keys.log) {
            if let Some((_, surface)) = &self.given {
                return Some(Task::Feet(Box::new(Feet::new(surface, params.log.spacing))));
            }
            return Some(Task::Coarse(Box::new(Sweep::new(&params.log, 1))));
        }
        if !is_current(&self.spawn, self.log.version, &keys.spawn) {
            return Some(Task::Spawn);
        }
        let solved = self.stats.key;
        // What the collisions have moved is not moved back, so another rule begins with new bodies.
        let stale = !is_current(&self.sheets, self.spawn.version, &keys.bodies)
            || solved.is_some_and(|rule| rule != keys.collisions);
        let individuals = self.spawn.value.individuals.len();
        if let Err(error) = self.memory.check_colony(params, individuals, stale || solved.is_none()) {
            self.refused = Some(error);
            if self.ground.value.is_none() {
                self.memory.note_counted(individuals);
            }
            return None;
        }
        if params.clear_log && self.ground.value.is_none() {
            if self.given.is_none() {
                return Some(Task::Ground(Box::new(Grown::new(params.log))));
            }
            let given = Ground::Given(Given::new(&self.log_mesh));
            self.ground.store(keys.ground.clone()?, Some(given));
        }
        if stale {
            self.stats.key = None;
            self.sheets.key = None;
            self.sheets.value.clear();
            self.layout = Layout::new(params);
            self.mesh.resize(individuals, &self.layout);
            return Some(Task::Deform(0));
        }
        self.preview = true;
        if solved.is_some() {
            return None;
        }
        self.stats.value = Stats::of(&self.mesh);
        self.work = Work::of(params, individuals);
        Some(match params.collisions {
            Collisions::Off if !params.clear_log => Task::Count(Box::default()),
            Collisions::Off => {
                let all = vec![true; individuals];
                Task::Settle(Box::new(Settle::sheets(&self.mesh, self.sheets.value.clone(), all)))
            }
            Collisions::Thesis => Task::Thesis(Box::new(Thesis::new(&self.layout, self.bends()))),
            Collisions::Pressed => Task::Press(Box::new(Press::new(&self.mesh.positions, self.bodies()?))),
        })
    }

    fn bends(&self) -> Vec<Bend> {
        let Some(params) = &self.params else { return Vec::new() };
        let each = self.spawn.value.individuals.iter().zip(&self.sheets.value);
        each.map(|(individual, sheet)| Bend::new(params, individual, sheet.size)).collect()
    }

    fn bodies(&self) -> Option<Bodies<'_>> {
        let (params, ground) = (self.params.as_ref()?, self.ground.value.as_ref());
        let (individuals, sheets) = (&self.spawn.value.individuals, &self.sheets.value);
        Some(Bodies { params, layout: &self.layout, individuals, sheets, ground })
    }

    /// Works on a task for a while. Returns the next task.
    fn advance(&mut self, task: Task) -> Option<Task> {
        match task {
            Task::Coarse(sweep) => return self.advance_coarse(sweep),
            Task::Thesis(thesis) => return self.advance_thesis(thesis),
            Task::Press(press) => return self.advance_press(press),
            Task::Fine(mut sweep) => {
                if !sweep.advance(LOG_VERTICES_PER_STEP) {
                    return Some(Task::Fine(sweep));
                }
                self.log_mesh = LogMesh::from(&sweep.finish());
                self.log_version += 1;
                self.log.key = Some(self.keys.as_ref()?.log.clone());
            }
            Task::Feet(mut feet) => {
                let (_, surface) = self.given.as_ref()?;
                if !feet.advance(surface, &self.log_mesh, DARTS_PER_STEP) {
                    return Some(Task::Feet(feet));
                }
                let (log, triangles) = feet.finish();
                self.foot_triangles = triangles.iter().map(|t| surface.numbers[*t as usize]).collect();
                self.log.store(self.keys.as_ref()?.log.clone(), log);
            }
            Task::Spawn => {
                let params = self.params.as_ref()?;
                let key = (self.log.version, self.keys.as_ref()?.spawn.clone());
                self.spawn.store(key, spawn(params, &self.log.value));
            }
            Task::Ground(mut ground) => {
                if !ground.advance(GROUND_PER_STEP) {
                    return Some(Task::Ground(ground));
                }
                self.ground.store(self.keys.as_ref()?.ground.clone()?, Some(Ground::Grown(ground)));
            }
            Task::Deform(from) => {
                let to = self.deform(from)?;
                if to < self.spawn.value.individuals.len() {
                    return Some(Task::Deform(to));
                }
                self.sheets.key = Some((self.spawn.version, self.keys.as_ref()?.bodies.clone()));
            }
            Task::Settle(mut settle) => {
                let bodies = BODY_VERTICES_PER_STEP / usize::from(self.layout.vertices).max(1) + 1;
                if !settle.advance(self.bodies()?, &self.mesh, bodies, PAIRS_PER_STEP) {
                    return Some(Task::Settle(settle));
                }
                settle.finish(&mut self.mesh, &mut self.stats.value);
                self.stats.key = self.params.as_ref().map(|params| params.collisions);
            }
            Task::Count(mut count) => {
                if !count.advance(&self.layout, &self.mesh.positions, PAIRS_PER_STEP, PAIRS_PER_STEP) {
                    return Some(Task::Count(count));
                }
                self.stats.value.crossing_pairs = count.crossing.len() as u32;
                self.stats.key = self.params.as_ref().map(|params| params.collisions);
            }
        }
        self.next_task()
    }

    fn advance_coarse(&mut self, mut sweep: Box<Sweep>) -> Option<Task> {
        if !sweep.advance(LOG_VERTICES_PER_STEP) {
            return Some(Task::Coarse(sweep));
        }
        let (fineness, _) = counts(&self.params.as_ref()?.log);
        let fine = Sweep::new(&self.params.as_ref()?.log, fineness);
        // The log has its key when its fine mesh is done.
        self.log.clear();
        self.log.value = sweep.finish();
        self.log.version += 1;
        self.foot_triangles = Vec::new();
        Some(Task::Fine(Box::new(fine)))
    }

    fn advance_thesis(&mut self, mut thesis: Box<Thesis>) -> Option<Task> {
        if !thesis.advance(&self.spawn.value.individuals, &self.sheets.value, ROUNDS_PER_STEP) {
            return Some(Task::Thesis(thesis));
        }
        [self.stats.value.sweeps, self.stats.value.rounds] = [thesis.sweeps, thesis.rounds];
        let (sheets, moved) = thesis.finish();
        let moved = self.also_cleared(moved);
        Some(Task::Settle(Box::new(Settle::sheets(&self.mesh, sheets, moved))))
    }

    fn advance_press(&mut self, mut press: Box<Press>) -> Option<Task> {
        if !press.advance(self.bodies()?, PAIRS_PER_STEP) {
            return Some(Task::Press(press));
        }
        [self.stats.value.sweeps, self.stats.value.rounds] = [press.sweeps, press.planes_set()];
        let (positions, moved, planes) = press.finish();
        let moved = self.also_cleared(moved);
        Some(Task::Settle(Box::new(Settle::positions(positions, moved, planes))))
    }

    /// Which individuals have moved: all of them, if they are kept out of the log.
    fn also_cleared(&self, mut moved: Vec<bool>) -> Vec<bool> {
        if self.ground.value.is_some() {
            moved.fill(true);
        }
        moved
    }

    /// Deforms some individuals, starting at `from`, and writes them as they are before collisions. Returns the number
    /// of the first one that is left.
    fn deform(&mut self, from: usize) -> Option<usize> {
        let params = self.params.as_ref()?;
        let unit = bowl(params.rings, params.meridians);
        let count = BODY_VERTICES_PER_STEP / usize::from(self.layout.vertices).max(1) + 1;
        let to = (from + count).min(self.spawn.value.individuals.len());
        let (mut poser, mut sums) = (Poser::default(), Vec::<DVec3>::new());
        let step = 3 * usize::from(self.layout.vertices);
        for k in from..to {
            let individual: Individual = self.spawn.value.individuals[k];
            let sheet = deform(params, &individual, &unit);
            poser.pose(params, &self.layout, &individual, &sheet, &[], (self.ground.value.as_ref(), false));
            let range = k * step..(k + 1) * step;
            write(&mut self.mesh.positions[range.clone()], poser.points.iter().copied());
            shade(&self.layout, &self.mesh.positions[range.clone()], &mut self.mesh.normals[range], &mut sums);
            self.mesh.foot[k] =
                self.foot_triangles.get(individual.vertex as usize).copied().unwrap_or(individual.vertex);
            self.mesh.size[k] = sheet.size as f32;
            self.mesh.base[k] = individual.base;
            self.sheets.value.push(sheet);
        }
        Some(to)
    }
}

/// Whether a result was made from these inputs and from this `version` of an earlier result.
fn is_current<K: PartialEq, V>(cached: &Cached<(u64, K), V>, version: u64, key: &K) -> bool {
    cached.key.as_ref().is_some_and(|(made_from, inputs)| *made_from == version && inputs == key)
}
