//! The pieces of work that a run consists of.

use super::crossing::Count;
use super::feet::Feet;
use super::ground::Grown;
use super::log::Sweep;
use super::press::Press;
use super::settle::Settle;
use super::thesis::Thesis;
use super::work::Work;
use crate::params::wood_ear::Stage;

/// A piece of work, with what it has done so far.
#[derive(Debug)]
pub(super) enum Task {
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

impl Task {
    /// The stage that it belongs to.
    pub(super) fn stage(&self) -> Stage {
        match self {
            Task::Coarse(_) | Task::Fine(_) | Task::Feet(_) | Task::Ground(_) => Stage::Log,
            Task::Spawn => Stage::Spawn,
            Task::Deform(_) => Stage::Deform,
            Task::Thesis(_) | Task::Press(_) => Stage::Collide,
            Task::Settle(_) | Task::Count(_) => Stage::Mesh,
        }
    }

    /// Progress of the whole run, 0 … 1, for this number of individuals and this work after the preview.
    pub(super) fn progress(&self, individuals: usize, work: &Work) -> f64 {
        let after_preview = |(part, share)| 0.3 + 0.7 * work.done(part, share);
        match self {
            Task::Coarse(sweep) => 0.05 * sweep.progress(),
            Task::Fine(sweep) => 0.05 + 0.15 * sweep.progress(),
            Task::Feet(feet) => 0.2 * feet.progress(),
            Task::Spawn => 0.2,
            Task::Ground(ground) => 0.2 + 0.05 * ground.progress(),
            Task::Deform(k) => 0.25 + 0.05 * *k as f64 / individuals.max(1) as f64,
            Task::Thesis(thesis) => after_preview(thesis.progress()),
            Task::Press(press) => after_preview(press.progress()),
            Task::Settle(settle) => after_preview(settle.progress()),
            Task::Count(count) => 0.3 + 0.7 * count.progress(),
        }
    }
}
