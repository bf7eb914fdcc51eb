//! Puts a body's vertices into the world, within the planes that the body shares with its neighbours and outside the
//! log.

use glam::DVec3;

use super::body::{Bend, Layout, RIM_RINGS, Rib, build};
use super::deform::Sheet;
use super::ground::Ground;
use super::spawn::Individual;
use super::work::tally;
use crate::params::wood_ear::Params;

/// A half-space n·p ≤ offset that a body stays in, to leave room for a neighbour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
    /// Number of the neighbour.
    pub(super) partner: u32,
}

/// The spine keeps this share of the foot's distance from every plane. With 0, a body that leans over would end in a
/// needle at the plane.
const AXIS_KEEPS: f64 = 0.3;

/// Poses bodies, one after the other, re-using its buffers.
#[derive(Debug, Default)]
pub(super) struct Poser {
    ribs: Vec<Rib>,
    lengths: Vec<f64>,
    pub(super) points: Vec<DVec3>,
}

impl Poser {
    /// Poses a body; its vertices in the world are then in `points`. It is kept out of the log only if `last` is true,
    /// because that takes longer than everything else.
    ///
    /// Every vertex is a point of the body's spine plus an offset, its rib. If the spine leaves a half-space, it is
    /// drawn towards the foot; if a vertex does, it moves along its rib towards the spine. Half-spaces are convex and
    /// hold the foot, so both always end inside.
    pub(super) fn pose(
        &mut self,
        params: &Params,
        layout: &Layout,
        individual: &Individual,
        sheet: &Sheet,
        planes: &[Plane],
        (ground, last): (Option<&Ground>, bool),
    ) {
        tally(80 * usize::from(layout.vertices));
        let bend = Bend::new(params, individual, sheet.size);
        build(params, layout, sheet, &bend, ground.map_or(0.0, Ground::lift), &mut self.ribs);
        self.points.clear();
        if planes.is_empty() {
            self.points.extend(self.ribs.iter().map(|rib| individual.to_world(rib.point())));
        } else {
            self.press(layout, individual, planes);
        }
        if let (Some(ground), true) = (ground, last) {
            self.clear(layout, individual, ground, &bend, sheet, planes);
        }
    }

    fn press(&mut self, layout: &Layout, individual: &Individual, planes: &[Plane]) {
        let foot = individual.foot;
        let [x, y, z] = individual.axes;
        let turned = |p: DVec3| p.x * x + p.y * y + p.z * z;
        let c = usize::from(layout.meridians);
        let sheet = usize::from(layout.rings) * c;
        let outer = if layout.thick { sheet + usize::from(RIM_RINGS) * c } else { 0 };
        // Both sheets move by the same amount, or they would pass through each other.
        let twin = |v: usize| if layout.thick && v < sheet { Some(v + outer) } else { None };
        for rib in &mut self.ribs {
            *rib = Rib { spine: turned(rib.spine), offset: turned(rib.offset) };
        }
        for v in 0..self.ribs.len() {
            if layout.thick && (outer..outer + sheet).contains(&v) {
                // The vertex has been moved together with its twin on the inner sheet.
                continue;
            }
            let keep = |w: usize| keep_spine(foot, self.ribs[w].spine, planes);
            let share = twin(v).map_or(1.0, keep).min(keep(v));
            for w in [Some(v), twin(v)].into_iter().flatten() {
                self.ribs[w].spine = foot + share * self.ribs[w].spine;
            }
        }
        self.lengths.clear();
        self.lengths.extend(self.ribs.iter().map(|rib| keep_offset(*rib, planes)));
        for v in 0..sheet {
            if let Some(w) = twin(v) {
                let least = self.lengths[v].min(self.lengths[w]);
                (self.lengths[v], self.lengths[w]) = (least, least);
            }
        }
        // Flesh does not bend around sharp corners, so a vertex follows its neighbours inward.
        for ring in (0..sheet).step_by(c) {
            let sharp: Vec<f64> = self.lengths[ring..ring + c].to_vec();
            for f in 0..c {
                let around = 0.5 * (sharp[(f + 1) % c] + sharp[(f + c - 1) % c]);
                let length = sharp[f].min(0.5 * (sharp[f] + around));
                self.lengths[ring + f] = length;
                if let Some(w) = twin(ring + f) {
                    self.lengths[w] = length;
                }
            }
        }
        if layout.thick {
            let rim = sheet - c;
            for v in sheet..outer {
                self.lengths[v] = self.lengths[v].min(self.lengths[rim + (v - sheet) % c]);
            }
        }
        self.points.extend(self.ribs.iter().zip(&self.lengths).map(|(rib, length)| rib.spine + *length * rib.offset));
    }

    /// Draws the vertices that are inside the log towards a point of the spine above it.
    fn clear(
        &mut self,
        layout: &Layout,
        individual: &Individual,
        ground: &Ground,
        bend: &Bend,
        sheet: &Sheet,
        planes: &[Plane],
    ) {
        let c = usize::from(layout.meridians);
        let sheets = usize::from(layout.rings) * c;
        let visible = if layout.thick { 2 * sheets + usize::from(RIM_RINGS) * c } else { sheets };
        let floor = visible + c + 1;
        let haven = |earth: bool| {
            [0.35, 0.6, 0.9, 1.4, 2.0, 3.0].into_iter().find_map(|height| {
                let spine = bend.rib(DVec3::new(0.0, height * sheet.size, 0.0), 0.5).spine;
                let spine = individual.to_world(spine) - individual.foot;
                let at = individual.foot + keep_spine(individual.foot, spine, planes) * spine;
                ground.is_clear(at, individual.axes[1], earth).then_some((at, earth))
            })
        };
        // If no such point is above the earth, the body is kept out of the log only.
        let Some((haven, earth)) = haven(true).or_else(|| haven(false)) else { return };
        let outer = sheets + usize::from(RIM_RINGS) * c;
        for v in (0..visible).chain(floor..self.points.len().max(floor)) {
            let share = way_out(|p| ground.is_clear(p, individual.axes[1], earth), self.points[v], haven);
            if share > 0.0 {
                self.points[v] = self.points[v].lerp(haven, share);
                // The inner sheet is moved too, or the outer one would pass through it.
                if layout.thick && v >= outer && v < outer + sheets {
                    let inner = self.points[v - outer].lerp(haven, share);
                    if ground.is_clear(inner, individual.axes[1], earth) {
                        self.points[v - outer] = inner;
                    }
                }
            }
        }
    }
}

/// The share of the way to the clear point `haven` that a point has to move to be clear itself, 0 … 1, found by
/// bisection.
fn way_out(is_clear: impl Fn(DVec3) -> bool, from: DVec3, haven: DVec3) -> f64 {
    if is_clear(from) {
        return 0.0;
    }
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..7 {
        let middle = 0.5 * (inside + outside);
        if is_clear(from.lerp(haven, middle)) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    outside
}

/// The share of its distance from the foot that a point of the spine keeps, 0 … 1. `spine` is relative to the foot.
fn keep_spine(foot: DVec3, spine: DVec3, planes: &[Plane]) -> f64 {
    planes.iter().fold(1.0_f64, |share, plane| {
        let room = plane.offset - plane.normal.dot(foot);
        let taken = plane.normal.dot(spine);
        if taken > (1.0 - AXIS_KEEPS) * room { share.min((1.0 - AXIS_KEEPS) * room / taken) } else { share }
    })
}

/// The share of its rib that a vertex keeps, 0 … 1.
fn keep_offset(rib: Rib, planes: &[Plane]) -> f64 {
    planes.iter().fold(1.0_f64, |share, plane| {
        let room = plane.offset - plane.normal.dot(rib.spine);
        let taken = plane.normal.dot(rib.offset);
        if taken > room { share.min(room.max(0.0) / taken) } else { share }
    })
}
