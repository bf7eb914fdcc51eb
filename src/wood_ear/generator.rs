//! The generator: runs the stages in small steps and caches their results.
//!
//! Every result is stored with a key: the inputs that it depends on. An edit re-runs the stages from the first one that
//! it affects, and a run that is replaced leaves its finished stages behind. The colony is written before its
//! collisions are solved, so that there is something to show early.

use glam::DVec3;

use super::body::{Bend, Layout};
use super::bowl::bowl;
use super::crossing::Count;
use super::deform::{Sheet, deform};
use super::feet::Feet;
use super::ground::{Given, Ground, Grown};
use super::log::{Log, Sweep, counts};
use super::memory::Memory;
use super::mesh::{ColonyMesh, LogMesh, shade, write};
use super::pose::Poser;
use super::press::{Bodies, Press};
use super::settle::{Settle, Stats};
use super::spawn::{Individual, Spawn, spawn};
use super::thesis::Thesis;
use super::user_log::{LogError, Surface, user_log};
use super::work::{Part, Work};
use crate::error::Error;
use crate::params::wood_ear::{Base, Collisions, Log as LogParams, Params, Stage};

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
    /// A log given by the user, and its number, which identifies it in keys.
    given: Option<(u32, Box<Surface>)>,
    logs_given: u32,
    log_key: Option<LogKey>,
    /// The points that individuals stand on: the coarse mesh of a grown log, or the feet drawn on a log given by the
    /// user.
    log: Log,
    /// Per foot, the number of its triangle in the mesh as it was given. Empty for a grown log.
    foot_triangles: Vec<u32>,
    log_mesh: LogMesh,
    log_version: u32,
    spawn_key: Option<SpawnKey>,
    spawn: Spawn,
    deform_key: Option<DeformKey>,
    layout: Layout,
    sheets: Vec<Sheet>,
    ground: Option<Ground>,
    /// The collision rule that the mesh is the result of. `None` while the mesh holds the colony before its collisions
    /// are solved.
    collide_key: Option<Collisions>,
    mesh: ColonyMesh,
    stats: Stats,
    /// The estimated work that is left after the preview.
    work: Work,
    /// True if the mesh was written by this run or is still valid for it.
    preview: bool,
    task: Option<Task>,
    memory: Memory,
    /// The error that ends the run, until [`Generator::step`] returns it.
    refused: Option<Error>,
}

#[derive(Debug, Clone, PartialEq)]
enum LogKey {
    /// The number of the log given by the user, and the spacing of its feet.
    Given(u32, f64),
    Grown(LogParams),
}

#[derive(Debug, Clone, PartialEq)]
struct SpawnKey {
    seed: u32,
    density: f64,
    range: f64,
    bases: Vec<Base>,
}

/// The values of all parameters that a body's shape depends on. A new shape parameter has to be added in
/// [`DeformKey::new`].
#[derive(Debug, Clone, PartialEq)]
struct DeformKey([f64; 12]);

#[derive(Debug)]
enum Task {
    Coarse(Box<Sweep>),
    Fine(Box<Sweep>),
    Feet(Box<Feet>),
    Spawn,
    Ground(Box<Grown>),
    /// Deforms individuals, from this one on.
    Deform(usize),
    Thesis(Box<Thesis>),
    Press(Box<Press>),
    Settle(Box<Settle>),
    /// Nothing has moved, so only the crossing pairs have to be counted.
    Count(Box<Count>),
}

impl SpawnKey {
    fn new(params: &Params) -> Self {
        let Params { seed, density, range, ref bases, .. } = *params;
        SpawnKey { seed, density, range, bases: bases.clone() }
    }
}

impl DeformKey {
    fn new(p: &Params) -> Self {
        let [rings, meridians] = [p.rings, p.meridians].map(f64::from);
        let clear = f64::from(u8::from(p.clear_log));
        DeformKey([
            f64::from(p.seed),
            p.moisture,
            p.wrinkles,
            p.size,
            p.size_spread,
            rings,
            meridians,
            p.per_individual,
            p.droop,
            p.thickness,
            p.foot,
            clear,
        ])
    }
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
        let surface = user_log(positions, indices)?;
        self.task = None;
        self.memory.note_given(&surface);
        self.logs_given += 1;
        self.log_mesh = LogMesh::from(&surface.log);
        self.log_version += 1;
        self.given = Some((self.logs_given, Box::new(surface)));
        self.log_key = None;
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
        let surface = self.given.as_ref().map(|(_, surface)| &**surface);
        let is_stale = self.log_key.as_ref() != Some(&self.key_of_log(&params));
        if self.memory.check_log(&params, surface, is_stale, max_bytes)? {
            self.forget_colony();
        }
        self.params = Some(params);
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
        self.spawn_key = None;
        self.sheets = Vec::new();
        self.mesh = ColonyMesh::default();
    }

    /// The stage that the next step works on. [`Stage::Mesh`] when the run is finished.
    pub fn stage(&self) -> Stage {
        match self.task {
            Some(Task::Coarse(_) | Task::Fine(_) | Task::Feet(_) | Task::Ground(_)) => Stage::Log,
            Some(Task::Spawn) => Stage::Spawn,
            Some(Task::Deform(_)) => Stage::Deform,
            Some(Task::Thesis(_) | Task::Press(_)) => Stage::Collide,
            Some(Task::Settle(_) | Task::Count(_)) | None => Stage::Mesh,
        }
    }

    /// Progress of the run, 0 … 1.
    pub fn progress(&self) -> f64 {
        match &self.task {
            Some(Task::Coarse(sweep)) => 0.05 * sweep.progress(),
            Some(Task::Fine(sweep)) => 0.05 + 0.15 * sweep.progress(),
            Some(Task::Feet(feet)) => 0.2 * feet.progress(),
            Some(Task::Spawn) => 0.2,
            Some(Task::Ground(ground)) => 0.2 + 0.05 * ground.progress(),
            Some(Task::Deform(k)) => 0.25 + 0.05 * *k as f64 / self.spawn.individuals.len().max(1) as f64,
            Some(Task::Thesis(thesis)) => self.after_preview(thesis.progress()),
            Some(Task::Press(press)) => self.after_preview(press.progress()),
            Some(Task::Settle(settle)) => self.after_preview(settle.progress()),
            Some(Task::Count(count)) => 0.3 + 0.7 * count.progress(),
            None => 1.0,
        }
    }

    fn after_preview(&self, (part, share): (Part, f64)) -> f64 {
        0.3 + 0.7 * self.work.done(part, share)
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
        &self.log
    }

    /// The individuals, with the places they stand on.
    pub fn spawn(&self) -> &Spawn {
        &self.spawn
    }

    /// The individuals' sheets before collisions, in the order of the individuals.
    pub fn sheets(&self) -> &[Sheet] {
        &self.sheets
    }

    /// The structure that all bodies share.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Positions of the bases, 3 numbers each, cm. Each base stands on the log's vertex nearest to where it was wanted.
    pub fn bases(&self) -> Vec<f64> {
        self.spawn.bases.iter().flat_map(|v| self.log.points[*v as usize].to_array()).collect()
    }

    /// Figures of the run. They are complete once [`Generator::step`] has returned true.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// Bytes that the run needs at its peak, output included, as far as that is known: the larger of the estimate made
    /// at the start and the one made when the individuals were counted.
    pub fn estimate(&self) -> u64 {
        self.memory.estimate()
    }

    /// The next piece of work: the first stage whose result is not in the cache. `None` when the run is finished.
    fn next_task(&mut self) -> Option<Task> {
        let params = &self.params.clone()?;
        let key = self.key_of_log(params);
        if self.ground().is_none() {
            // It belongs to another log, or nothing has to keep clear of the log.
            self.ground = None;
        }
        if self.log_key.as_ref() != Some(&key) {
            self.spawn_key = None;
            if let Some((_, surface)) = &self.given {
                return Some(Task::Feet(Box::new(Feet::new(surface, params.log.spacing))));
            }
            return Some(Task::Coarse(Box::new(Sweep::new(&params.log, 1))));
        }
        if self.spawn_key.as_ref() != Some(&SpawnKey::new(params)) {
            self.deform_key = None;
            return Some(Task::Spawn);
        }
        let stale = self.deform_key.as_ref() != Some(&DeformKey::new(params));
        let stale = stale || self.collide_key.is_some_and(|rule| rule != params.collisions);
        let collides = stale || self.collide_key.is_none();
        if let Err(error) = self.memory.check_colony(params, self.spawn.individuals.len(), collides) {
            self.refused = Some(error);
            return None;
        }
        if params.clear_log && self.ground().is_none() {
            let Some((number, surface)) = &self.given else {
                return Some(Task::Ground(Box::new(Grown::new(params.log))));
            };
            self.ground = Some(Ground::Given(Given::new(*number, &surface.log, &surface.cells)));
        }
        if stale {
            self.deform_key = None;
            self.collide_key = None;
            self.layout = Layout::new(params);
            self.sheets.clear();
            self.mesh.resize(self.spawn.individuals.len(), &self.layout);
            return Some(Task::Deform(0));
        }
        self.preview = true;
        if self.collide_key.is_some() {
            return None;
        }
        self.stats = Stats::of(&self.mesh);
        self.work = Work::of(params, self.sheets.len());
        Some(match params.collisions {
            Collisions::Off if !params.clear_log => Task::Count(Box::default()),
            Collisions::Off => {
                let all = vec![true; self.sheets.len()];
                Task::Settle(Box::new(Settle::sheets(&self.mesh, self.sheets.clone(), all)))
            }
            Collisions::Thesis => Task::Thesis(Box::new(Thesis::new(&self.layout, self.bends()))),
            Collisions::Pressed => Task::Press(Box::new(Press::new(&self.mesh.positions, self.bodies()?))),
        })
    }

    fn key_of_log(&self, params: &Params) -> LogKey {
        match &self.given {
            Some((number, _)) => LogKey::Given(*number, params.log.spacing),
            None => LogKey::Grown(params.log),
        }
    }

    fn bends(&self) -> Vec<Bend> {
        let Some(params) = &self.params else { return Vec::new() };
        let each = self.spawn.individuals.iter().zip(&self.sheets);
        each.map(|(individual, sheet)| Bend::new(params, individual, sheet.size)).collect()
    }

    /// The obstacle that individuals keep out of. `None` if they need not, or if it has not been made yet.
    fn ground(&self) -> Option<&Ground> {
        let params = self.params.as_ref().filter(|params| params.clear_log)?;
        self.ground.as_ref().filter(|ground| match ground {
            Ground::Grown(grown) => self.given.is_none() && grown.is_of(&params.log),
            Ground::Given(given) => self.given.as_ref().is_some_and(|(number, _)| *number == given.number),
        })
    }

    fn bodies(&self) -> Option<Bodies<'_>> {
        let (params, ground) = (self.params.as_ref()?, self.ground());
        let (individuals, sheets) = (&self.spawn.individuals, &self.sheets);
        Some(Bodies { params, layout: &self.layout, individuals, sheets, ground })
    }

    /// Works on a task for a while. Returns the next task.
    fn advance(&mut self, task: Task) -> Option<Task> {
        match task {
            Task::Coarse(mut sweep) => {
                if !sweep.advance(LOG_VERTICES_PER_STEP) {
                    return Some(Task::Coarse(sweep));
                }
                let params = self.params.as_ref()?;
                self.log = sweep.finish();
                self.foot_triangles = Vec::new();
                self.log_key = None;
                let (fineness, _) = counts(&params.log);
                return Some(Task::Fine(Box::new(Sweep::new(&params.log, fineness))));
            }
            Task::Fine(mut sweep) => {
                if !sweep.advance(LOG_VERTICES_PER_STEP) {
                    return Some(Task::Fine(sweep));
                }
                self.log_mesh = LogMesh::from(&sweep.finish());
                self.log_version += 1;
                self.log_key = Some(LogKey::Grown(self.params.as_ref()?.log));
            }
            Task::Feet(mut feet) => {
                let (number, surface) = self.given.as_ref()?;
                if !feet.advance(surface, DARTS_PER_STEP) {
                    return Some(Task::Feet(feet));
                }
                self.log_key = Some(LogKey::Given(*number, feet.spacing));
                let (log, triangles) = feet.finish();
                self.log = log;
                self.foot_triangles = triangles.iter().map(|t| surface.numbers[*t as usize]).collect();
            }
            Task::Spawn => {
                let params = self.params.as_ref()?;
                self.spawn = spawn(params, &self.log);
                self.spawn_key = Some(SpawnKey::new(params));
            }
            Task::Ground(mut ground) => {
                if !ground.advance(GROUND_PER_STEP) {
                    return Some(Task::Ground(ground));
                }
                self.ground = Some(Ground::Grown(ground));
            }
            Task::Deform(from) => {
                let to = self.deform(from)?;
                if to < self.spawn.individuals.len() {
                    return Some(Task::Deform(to));
                }
                self.deform_key = self.params.as_ref().map(DeformKey::new);
            }
            Task::Thesis(mut thesis) => {
                if !thesis.advance(&self.spawn.individuals, &self.sheets, ROUNDS_PER_STEP) {
                    return Some(Task::Thesis(thesis));
                }
                [self.stats.sweeps, self.stats.rounds] = [thesis.sweeps, thesis.rounds];
                let (sheets, mut moved) = thesis.finish();
                if self.ground().is_some() {
                    moved.fill(true);
                }
                return Some(Task::Settle(Box::new(Settle::sheets(&self.mesh, sheets, moved))));
            }
            Task::Press(mut press) => {
                if !press.advance(self.bodies()?, PAIRS_PER_STEP) {
                    return Some(Task::Press(press));
                }
                self.stats.sweeps = press.sweeps;
                self.stats.rounds = press.planes_set();
                let (positions, mut moved, planes) = press.finish();
                if self.ground().is_some() {
                    moved.fill(true);
                }
                return Some(Task::Settle(Box::new(Settle::positions(positions, moved, planes))));
            }
            Task::Settle(mut settle) => {
                let bodies = BODY_VERTICES_PER_STEP / usize::from(self.layout.vertices).max(1) + 1;
                let of = self.bodies()?;
                if !settle.advance(of, &self.mesh, bodies, PAIRS_PER_STEP) {
                    return Some(Task::Settle(settle));
                }
                settle.finish(&mut self.mesh, &mut self.stats);
                self.collide_key = self.params.as_ref().map(|params| params.collisions);
            }
            Task::Count(mut count) => {
                if !count.advance(&self.layout, &self.mesh.positions, PAIRS_PER_STEP, PAIRS_PER_STEP) {
                    return Some(Task::Count(count));
                }
                self.stats.crossing_pairs = count.crossing.len() as u32;
                self.collide_key = self.params.as_ref().map(|params| params.collisions);
            }
        }
        self.next_task()
    }

    /// Deforms some individuals, starting at `from`, and writes them as they are before collisions. Returns the number
    /// of the first one that is left.
    fn deform(&mut self, from: usize) -> Option<usize> {
        let params = self.params.as_ref()?;
        let unit = bowl(params.rings, params.meridians);
        let count = BODY_VERTICES_PER_STEP / usize::from(self.layout.vertices).max(1) + 1;
        let to = (from + count).min(self.spawn.individuals.len());
        let (mut poser, mut sums) = (Poser::default(), Vec::<DVec3>::new());
        let step = 3 * usize::from(self.layout.vertices);
        for k in from..to {
            let individual: Individual = self.spawn.individuals[k];
            let sheet = deform(params, &individual, &unit);
            poser.pose(params, &self.layout, &individual, &sheet, &[], (self.ground(), false));
            let range = k * step..(k + 1) * step;
            write(&mut self.mesh.positions[range.clone()], poser.points.iter().copied());
            shade(&self.layout, &self.mesh.positions[range.clone()], &mut self.mesh.normals[range], &mut sums);
            self.mesh.foot[k] =
                self.foot_triangles.get(individual.vertex as usize).copied().unwrap_or(individual.vertex);
            self.mesh.size[k] = sheet.size as f32;
            self.mesh.base[k] = individual.base;
            self.sheets.push(sheet);
        }
        Some(to)
    }
}
