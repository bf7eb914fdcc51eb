//! Where a body's vertices come to stand in the world: within the planes it shares with its neighbours, and outside the log.

use glam::DVec3;

use super::body::{Bend, Layout, RIM_RINGS, Rib, build};
use super::deform::Sheet;
use super::ground::Ground;
use super::spawn::Individual;
use super::work::tally;
use crate::params::wood_ear::Params;

/// A half-space n·p ≤ offset that a body keeps to, for the sake of a neighbour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
    /// The neighbour.
    pub(super) partner: u32,
}

/// The spine keeps this share of the foot's distance from every plane: with 0, what leans over would end in a needle at the plane.
const AXIS_KEEPS: f64 = 0.3;

/// Poses bodies, re-using its buffers.
#[derive(Debug, Default)]
pub(super) struct Poser {
    ribs: Vec<Rib>,
    lengths: Vec<f64>,
    pub(super) points: Vec<DVec3>,
}

impl Poser {
    /// The body in the world, in `points`; kept out of the log only where it is `last`, which takes longer than all the rest.
    ///
    /// A vertex stands off from a point of the body's spine. Where the spine leaves a half-space, it is drawn towards the foot; where a
    /// vertex does, it moves along its rib towards the spine. A half-space is convex and holds the foot, so both always end inside.
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
        // Both sheets move alike, or they would pass through each other.
        let twin = |v: usize| if layout.thick && v < sheet { Some(v + outer) } else { None };
        for rib in &mut self.ribs {
            *rib = Rib { spine: turned(rib.spine), offset: turned(rib.offset) };
        }
        for v in 0..self.ribs.len() {
            if layout.thick && (outer..outer + sheet).contains(&v) {
                // Done with its twin.
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
        // Flesh bends around no sharp corner: a vertex follows its neighbours inward.
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

    /// Draws what is in the log towards a point of the spine above it.
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
        // What grows into the earth is kept out of the log alone.
        let Some((haven, earth)) = haven(true).or_else(|| haven(false)) else { return };
        let outer = sheets + usize::from(RIM_RINGS) * c;
        for v in (0..visible).chain(floor..self.points.len().max(floor)) {
            let share = way_out(|p| ground.is_clear(p, individual.axes[1], earth), self.points[v], haven);
            if share > 0.0 {
                self.points[v] = self.points[v].lerp(haven, share);
                // The inner sheet goes along, or the outer one would come through it.
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

/// The share of its way to a clear point that a point has to go to be clear too.
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

/// The share of its way from the foot that a point of the spine keeps; given relative to the foot.
fn keep_spine(foot: DVec3, spine: DVec3, planes: &[Plane]) -> f64 {
    planes.iter().fold(1.0_f64, |share, plane| {
        let room = plane.offset - plane.normal.dot(foot);
        let taken = plane.normal.dot(spine);
        if taken > (1.0 - AXIS_KEEPS) * room { share.min((1.0 - AXIS_KEEPS) * room / taken) } else { share }
    })
}

/// The share of its rib that a vertex keeps.
fn keep_offset(rib: Rib, planes: &[Plane]) -> f64 {
    planes.iter().fold(1.0_f64, |share, plane| {
        let room = plane.offset - plane.normal.dot(rib.spine);
        let taken = plane.normal.dot(rib.offset);
        if taken > room { share.min(room.max(0.0) / taken) } else { share }
    })
}
