//! Estimates the memory that a run needs: of the log before the run begins, and of the colony as soon as its
//! individuals are counted.

use super::body::Layout;
use super::feet::wanted;
use super::ground::Cells;
use super::log::counts;
use super::mesh::LogMesh;
use super::user_log::Surface;
use super::work::pairs_each;
use crate::error::Error;
use crate::params::wood_ear::{Collisions, Params};

/// Bytes of a wasm instance before its first run: stack and static data.
const INSTANCE: f64 = 1.2e6;

/// Size of the heap relative to its contents after several runs. The memory of a wasm instance never shrinks.
const HOLES: f64 = 1.12;

/// Largest number of corners of triangles: they are numbered with 32 bits, whatever the budget.
const MOST_CORNERS: f64 = 2_147_483_648.0;

/// Memory of a log or a colony, bytes.
#[derive(Debug, Clone, Copy, Default)]
struct Need {
    /// Bytes kept after the run.
    kept: f64,
    /// Bytes needed in addition while it is made.
    beside: f64,
    /// Bytes of the copies handed to the caller.
    copies: f64,
}

/// The state of a run's memory estimate, bytes.
#[derive(Debug, Default)]
pub(super) struct Memory {
    budget: f64,
    /// The largest estimate of the run.
    estimate: f64,
    log: Need,
    /// What [`ground`] gives, which is part of what the log keeps.
    ground: f64,
    colony: Need,
    /// The most that is held at once: in the run (`peak`), and while a log given by the user was read since the
    /// previous run (`read`).
    peak: f64,
    read: f64,
}

/// Bytes per vertex of the visible log, which is kept as f32 with its kinds and coordinates (`SEEN`), and of the mesh
/// that individuals stand on, which is kept as f64 (`STOOD_ON`).
const SEEN: f64 = 57.0;
const STOOD_ON: f64 = 81.0;

/// Memory of a log given by the user, while it is read and afterwards.
fn given(surface: &Surface) -> Need {
    let [vertices, kept, triangles] = [surface.given, surface.kept, surface.numbers.len()].map(|n| n as f64);
    Need { kept: 33.0 * kept + 24.0 * triangles, beside: 44.0 * vertices, copies: 33.0 * kept + 12.0 * triangles }
}

/// Memory of a log. `ground` is what [`ground`] gives for it; it is kept with the log.
fn log(params: &Params, surface: Option<&Surface>, ground: f64) -> Need {
    let mut need = match surface {
        Some(surface) => {
            let places = wanted(surface.area(), params.log.spacing);
            let need = given(surface);
            Need { kept: need.kept + 52.0 * places, beside: 88.0 * places, ..need }
        }
        None => {
            let (_, [coarse, fine]) = counts(&params.log);
            let [coarse, fine] = [coarse as f64, fine as f64];
            Need { kept: STOOD_ON * coarse + SEEN * fine, beside: STOOD_ON * fine, copies: SEEN * fine }
        }
    };
    need.kept += ground;
    need
}

/// Bytes of the tables that keep individuals out of the log; 0 if the log is not to be kept clear.
fn ground(params: &Params, given: Option<&LogMesh>) -> f64 {
    match given {
        _ if !params.clear_log => 0.0,
        Some(mesh) => Cells::bytes(mesh),
        // An f32 per 0.8 cm along and around the log is about 40 bytes per cm². The table is copied when its furrows are
        // filled, so it is counted twice.
        None => 2.0 * 10.0 * (params.log.length + 2.0 * params.log.radius) * params.log.radius * 4.0,
    }
}

/// Memory of a colony. `collides` says that the collisions have to be solved and are not only kept from before.
fn colony(params: &Params, individuals: f64, collides: bool) -> Need {
    let layout = Layout::new(params);
    let [v, t] = [f64::from(layout.vertices), layout.triangles.len() as f64];
    let s = f64::from(params.rings * params.meridians);
    let buffers = 24.0 * v + 12.0 * t + 17.0;
    let pairs = pairs_each(params, individuals);
    let settled = 24.0 * v + 4.0 * t + 100.0;
    if individuals * 3.0 * t > MOST_CORNERS {
        return Need { kept: f64::INFINITY, ..Need::default() };
    }
    let beside = match params.collisions {
        Collisions::Off if !params.clear_log => 4.0 * t + 100.0,
        Collisions::Off => 24.0 * s + settled,
        Collisions::Thesis => (104.0 * s + 330.0).max(24.0 * s + settled) + 100.0,
        Collisions::Pressed => settled + 300.0,
    };
    let each = Need {
        kept: buffers + 24.0 * s + 250.0,
        beside: if collides { beside + 24.0 * pairs } else { 0.0 },
        copies: buffers,
    };
    Need { kept: individuals * each.kept, beside: individuals * each.beside, copies: individuals * each.copies }
}

impl Memory {
    /// The largest estimate of the run, bytes.
    pub(super) fn estimate(&self) -> u64 {
        self.estimate as u64
    }

    /// Estimates the memory of the log before a run begins. `mesh` is that of `surface`, if there is one. `is_stale` says
    /// that the log has to be made. Returns whether the old colony is in the way and has to be freed, or [`Error::OverBudget`] if the estimate exceeds the budget.
    pub(super) fn check_log(
        &mut self,
        params: &Params,
        surface: Option<&Surface>,
        mesh: &LogMesh,
        is_stale: bool,
        budget: u64,
    ) -> Result<bool, Error> {
        let ground = ground(params, surface.map(|_| mesh));
        let log = log(params, surface, ground);
        // A log given by the user is held already; only feet are drawn on it.
        let kept = surface.map_or(0.0, |surface| given(surface).kept);
        let making = if is_stale { log.kept - kept + log.beside } else { ground };
        let mut held = self.held();
        let peak = |held: f64| (held + making).max(log.kept);
        let bytes = |held: f64| INSTANCE + HOLES * peak(held) + log.copies;
        let budget = budget as f64;
        let in_the_way = bytes(held) > budget;
        if in_the_way {
            over(if ground > 0.5 * making { "clearLog" } else { "logSpacing" }, bytes(0.0), budget)?;
            held = 0.0;
        }
        *self = Memory { budget, estimate: bytes(held), log, ground, colony: self.colony, peak: peak(held), read: 0.0 };
        Ok(in_the_way)
    }

    /// Estimates the memory of the colony once its individuals are counted and before they are made. Returns
    /// [`Error::OverBudget`] if it exceeds the budget.
    pub(super) fn check_colony(&mut self, params: &Params, individuals: usize, collides: bool) -> Result<(), Error> {
        let Memory { budget, log, peak, .. } = *self;
        let colony = colony(params, individuals as f64, collides);
        let peak = peak.max(log.kept + colony.kept + colony.beside);
        let bytes = INSTANCE + HOLES * peak + log.copies + colony.copies;
        over("density", bytes, budget)?;
        self.estimate = self.estimate.max(bytes);
        (self.colony, self.peak) = (colony, peak);
        Ok(())
    }

    /// Records that the run has ended when its individuals were counted: they are kept, in a list that grew by doubling,
    /// but the tables of [`ground`] have not been made.
    pub(super) fn note_counted(&mut self, individuals: usize) {
        self.log.kept += 208.0 * individuals as f64 - self.ground;
    }

    /// Records that a log given by the user was read while the previous log was still held.
    pub(super) fn note_given(&mut self, surface: &Surface) {
        let need = given(surface);
        self.read = self.held() + need.kept + need.beside;
    }

    /// Bytes that are held from the previous run, or the most that were held since.
    fn held(&self) -> f64 {
        self.read.max(self.log.kept + self.colony.kept)
    }
}

fn over(key: &'static str, bytes: f64, budget: f64) -> Result<(), Error> {
    if bytes > budget { Err(Error::OverBudget { key, estimate: bytes as u64, budget: budget as u64 }) } else { Ok(()) }
}
