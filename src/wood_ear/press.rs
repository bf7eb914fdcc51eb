//! Collisions as flesh would solve them: neighbours that would cross press flat against a plane between them. This goes
//! beyond the thesis.
//!
//! A pair that crosses gets a plane with one foot on each side, and from then on each body stays within its half-space.
//! Triangles within two half-spaces that do not meet do not meet either. Drawing a body in may make it cross a third
//! one, so sweeps are repeated until no crossing pair is found. Every pair gets at most one plane, so this ends, and no
//! pair crosses then.

use glam::{DVec3, Vec3};

use super::body::Layout;
use super::crossing::{Boxes, cross};
use super::deform::Sheet;
use super::ground::Ground;
use super::mesh::write;
use super::pairs::{Bounds, overlapping};
use super::pose::{Plane, Poser};
use super::spawn::Individual;
use super::work::{Part, swept};
use crate::params::wood_ear::Params;

/// Half the gap at a plane, cm. It is more than f32 loses within 100 m of the origin.
const GAP: f64 = 2.0e-3;

/// The tilts from upright that are tried for a plane (tangents), and the places between the feet, as shares of their
/// distance. Both are found by trial.
const TILTS: [f64; 5] = [0.0, 0.3, -0.3, 0.8, -0.8];
const PLACES: [f64; 7] = [0.5, 0.4, 0.6, 0.28, 0.72, 0.16, 0.84];

/// Least distance of the feet along a plane's normal, as a share of their distance. Steeper planes would leave the feet
/// no room.
const LEAST_ROOM: f64 = 0.3;

#[derive(Debug)]
pub(super) struct Press {
    step: usize,
    /// The bodies in their current shape, as the mesh will hold them.
    pub(super) positions: Vec<f32>,
    boxes: Vec<Boxes>,
    bounds: Vec<Bounds>,
    planes: Vec<Vec<Plane>>,
    /// When each body was last changed, counted in planes.
    changed: Vec<u32>,
    planes_set: u32,
    pairs: Option<Vec<[u32; 2]>>,
    next: usize,
    /// The value of `planes_set` when this sweep began, and when the previous one did.
    began: [u32; 2],
    pub(super) sweeps: u32,
    poser: Poser,
}

/// The inputs from which bodies are made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bodies<'a> {
    pub(super) params: &'a Params,
    pub(super) layout: &'a Layout,
    pub(super) individuals: &'a [Individual],
    pub(super) sheets: &'a [Sheet],
    pub(super) ground: Option<&'a Ground>,
}

impl Press {
    pub(super) fn new(positions: &[f32], of: Bodies) -> Self {
        let count = of.individuals.len();
        Press {
            step: 3 * usize::from(of.layout.vertices),
            positions: positions.to_vec(),
            boxes: Vec::with_capacity(count),
            bounds: Vec::with_capacity(count),
            planes: vec![Vec::new(); count],
            changed: vec![1; count],
            planes_set: 1,
            pairs: None,
            next: 0,
            began: [0, 0],
            sweeps: 0,
            poser: Poser::default(),
        }
    }

    /// Works on about `work` pairs. Returns true when no pair crosses.
    pub(super) fn advance(&mut self, of: Bodies, mut work: usize) -> bool {
        if self.boxes.len() < of.individuals.len() {
            let from = self.boxes.len();
            for (k, positions) in self.positions.chunks_exact_mut(self.step).enumerate().skip(from).take(work) {
                if of.ground.is_some() {
                    self.poser.pose(of.params, of.layout, &of.individuals[k], &of.sheets[k], &[], (of.ground, true));
                    write(positions, self.poser.points.iter().copied());
                }
                let (boxes, whole) = Boxes::of(of.layout, positions);
                self.boxes.push(boxes);
                self.bounds.push(whole);
            }
            return false;
        }
        let Some(pairs) = self.pairs.take() else {
            self.pairs = Some(overlapping(&self.bounds));
            (self.next, self.began) = (0, [self.planes_set, self.began[0]]);
            self.sweeps += 1;
            return false;
        };
        while let Some(&pair) = pairs.get(self.next) {
            if work == 0 {
                self.pairs = Some(pairs);
                return false;
            }
            work -= 1;
            self.next += 1;
            let [i, j] = pair.map(|k| k as usize);
            // Both bodies are as they were when the previous sweep looked at them.
            let known = self.changed[i].max(self.changed[j]) <= self.began[1];
            if known || self.planes[i].iter().any(|plane| plane.partner == pair[1]) {
                continue;
            }
            let body = |k: usize| (self.body(k), &self.boxes[k], &self.bounds[k]);
            if cross(of.layout, body(i), body(j)) {
                self.separate(of, pair);
                work = work.saturating_sub(40);
            }
        }
        // No crossing pair was found in a whole sweep.
        self.planes_set == self.began[0]
    }

    /// The part of the run being worked on, and the share of it that is done.
    pub(super) fn progress(&self) -> (Part, f64) {
        if self.sweeps == 0 {
            return (Part::Models, self.boxes.len() as f64 / self.changed.len().max(1) as f64);
        }
        let within = self.pairs.as_ref().map_or(1.0, |pairs| self.next as f64 / pairs.len().max(1) as f64);
        (Part::Pairs, swept(self.sweeps - 1, within))
    }

    /// Number of pairs that a plane separates.
    pub(super) fn planes_set(&self) -> u32 {
        self.planes_set - 1
    }

    /// Returns the positions, which bodies have changed, and the planes between them.
    pub(super) fn finish(self) -> (Vec<f32>, Vec<bool>, Vec<Vec<Plane>>) {
        let moved = self.planes.iter().map(|planes| !planes.is_empty()).collect();
        (self.positions, moved, self.planes)
    }

    fn body(&self, k: usize) -> &[f32] {
        &self.positions[k * self.step..(k + 1) * self.step]
    }

    /// Puts a plane between two bodies and draws both back behind it.
    fn separate(&mut self, of: Bodies, pair: [u32; 2]) {
        let [i, j] = pair.map(|k| k as usize);
        let (normal, place) = self.best_plane(of, i, j);
        let [a, b] = [i, j].map(|k| normal.dot(of.individuals[k].foot));
        let gap = GAP.min(0.1 * (b - a));
        let offset = a + place * (b - a);
        self.planes_set += 1;
        for (k, partner, side) in [(i, pair[1], 1.0), (j, pair[0], -1.0)] {
            self.planes[k].push(Plane { normal: side * normal, offset: side * offset - gap, partner });
            self.changed[k] = self.planes_set;
            self.poser.pose(
                of.params,
                of.layout,
                &of.individuals[k],
                &of.sheets[k],
                &self.planes[k],
                (of.ground, true),
            );
            let slots = &mut self.positions[k * self.step..(k + 1) * self.step];
            write(slots, self.poser.points.iter().copied());
            (self.boxes[k], self.bounds[k]) = Boxes::of(of.layout, slots);
        }
    }

    /// Returns the plane that costs the two bodies the least in their current shape: its normal, which points from the
    /// first to the second, and where it stands between the feet, as a share of their distance.
    fn best_plane(&self, of: Bodies, i: usize, j: usize) -> (DVec3, f64) {
        let [a, b] = [i, j].map(|k| of.individuals[k]);
        let between = b.foot - a.foot;
        let distance = between.length();
        let level = between.normalize_or(DVec3::X);
        let up = a.axes[1] + b.axes[1];
        let up = (up - up.dot(level) * level).normalize_or_zero();
        let [of_a, of_b] = [i, j].map(|k| self.samples(of.layout, k));
        let middle = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
        let apart = (middle(&of_b) - middle(&of_a)).normalize_or_zero();
        let tilted = TILTS.iter().map(|t| (level + *t * up).normalize_or(level));
        let [size_a, size_b] = [i, j].map(|k| of.sheets[k].size);
        let mut best = (f64::INFINITY, level, 0.5);
        for normal in tilted.chain([(level + apart).normalize_or(level), apart]) {
            let [from, to] = [a.foot, b.foot].map(|foot| normal.dot(foot));
            if to - from < LEAST_ROOM * distance {
                continue;
            }
            for place in PLACES {
                let offset = from + place * (to - from);
                let cost = loss(&of_a, 1.0, normal, offset, size_a) + loss(&of_b, -1.0, normal, offset, size_b);
                if cost < best.0 {
                    best = (cost, normal, place);
                }
            }
        }
        (best.1, best.2)
    }

    /// Every other vertex of three rings of a body's inner sheet: what a plane between two bodies is judged by.
    #[inline(never)]
    fn samples(&self, layout: &Layout, k: usize) -> Vec<DVec3> {
        let (c, d) = (usize::from(layout.meridians), usize::from(layout.rings));
        let body = self.body(k);
        let mut points = Vec::with_capacity(2 * c);
        for e in [d - 1, (2 * d) / 3, d / 3] {
            for f in (0..c).step_by(2) {
                let at = 3 * (e * c + f);
                points.push(Vec3::from_slice(&body[at..at + 3]).as_dvec3());
            }
        }
        points
    }
}

/// What a plane costs a body: how far its points are beyond the plane, on average and relative to its size. A large cost
/// for one body is worse than a small cost for both, so the square counts too, with a weight found by trial.
#[inline(never)]
fn loss(points: &[DVec3], side: f64, normal: DVec3, offset: f64, size: f64) -> f64 {
    let over = points.iter().map(|p| (side * (normal.dot(*p) - offset)).max(0.0)).sum::<f64>();
    let share = over / (points.len() as f64 * size);
    share + 4.0 * share * share
}
