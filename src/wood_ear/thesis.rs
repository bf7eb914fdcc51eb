//! Collisions as the thesis solves them (Eqs 3.6 to 3.10, decisions K8 to K11).
//!
//! In each round, every segment of one sheet of a pair is tested against every triangle of the other, in both
//! directions. If a segment pierces a triangle, the meridians of Q (the segment's farther vertex) and of A (the
//! triangle's farthest vertex) step inward. The rounds end when nothing is pierced. Only tests that cannot change the
//! outcome are skipped: those of parts whose boxes are apart, and those where both meridians are already known to step.

use glam::DVec3;

use super::body::{Bend, Layout};
use super::deform::Sheet;
use super::pairs::{Bounds, overlapping};
use super::spawn::Individual;
use super::work::{Part, swept, tally};

/// The step of Eq. 3.10, one unit, relative to the individual's size: 1/d² of the raw rim radius at the thesis's d = 10
/// (decision K1).
const STEP: f64 = 0.01;
/// Smallest radius of a vertex, relative to the size. Below it, meridians would pass through the axis (decision K9).
const LEAST: f64 = 0.01;
/// Largest number of rounds per pair, and of sweeps over all pairs (decision K9).
const MOST_ROUNDS: u32 = 200;
const MOST_SWEEPS: u32 = 10;

/// One sheet in the world, with everything the rounds need.
#[derive(Debug, Clone)]
struct Model {
    /// The vertices, ring by ring.
    points: Vec<DVec3>,
    /// The squared distance of every vertex from the foot.
    reach: Vec<f64>,
    /// Boxes around the quads, meridian by meridian, and around the whole strips between meridians f and f + 1.
    quads: Vec<Bounds>,
    strips: Vec<Bounds>,
    whole: Bounds,
    /// Counts up whenever the shape changes.
    version: u32,
}

/// Runs the sweeps over all pairs, some rounds per step.
#[derive(Debug)]
pub(super) struct Thesis {
    rings: usize,
    meridians: usize,
    models: Vec<Model>,
    /// The sheets in their current shape.
    sheets: Vec<Sheet>,
    bends: Vec<Bend>,
    /// Per sheet, a box around every shape it may take. Emptied once the pairs are known.
    bounds: Vec<Bounds>,
    pairs: Vec<[u32; 2]>,
    /// Per pair, the versions of its two models when it was last found free.
    free: Vec<[u32; 2]>,
    next: usize,
    moved: bool,
    pub(super) sweeps: u32,
    pub(super) rounds: u32,
}

impl Thesis {
    pub(super) fn new(layout: &Layout, bends: Vec<Bend>) -> Self {
        let [rings, meridians] = [layout.rings, layout.meridians].map(usize::from);
        Thesis {
            rings,
            meridians,
            models: Vec::with_capacity(bends.len()),
            sheets: Vec::with_capacity(bends.len()),
            bounds: Vec::with_capacity(bends.len()),
            bends,
            pairs: Vec::new(),
            free: Vec::new(),
            next: 0,
            moved: false,
            sweeps: 0,
            rounds: 0,
        }
    }

    /// Adds the model of the next individual.
    fn add(&mut self, individual: &Individual, sheet: &Sheet) {
        let (d, c) = (self.rings, self.meridians);
        let bend = self.bends[self.models.len()];
        let count = sheet.points.len();
        tally(60 * count);
        let mut model = Model {
            points: vec![DVec3::ZERO; count],
            reach: vec![0.0; count],
            quads: vec![Bounds::EMPTY; (d - 1) * c],
            strips: vec![Bounds::EMPTY; c],
            whole: Bounds::EMPTY,
            version: 1,
        };
        for f in 0..c {
            model.place(f, d, c, individual, sheet, &bend);
        }
        for f in 0..c {
            model.bound(f, d, c);
        }
        model.enclose();
        // Stepping inward leads towards the axis, so a box that includes the points of the axis holds every shape the
        // sheet may take.
        let axis = sheet.points.iter().enumerate().map(|(v, p)| {
            let on_axis = DVec3::new(0.0, p.y, 0.0);
            individual.to_world(bend.rib(on_axis * sheet.size, (v / c + 1) as f64 / d as f64).point())
        });
        self.bounds.push(axis.fold(model.whole, Bounds::with));
        self.models.push(model);
        self.sheets.push(sheet.clone());
    }

    /// Works on pairs for about `rounds` rounds. Returns true after a sweep that moved nothing, or after the last one.
    pub(super) fn advance(&mut self, individuals: &[Individual], sheets: &[Sheet], rounds: u32) -> bool {
        if self.models.len() < individuals.len() {
            let to = (self.models.len() + rounds as usize / 4).min(individuals.len());
            for k in self.models.len()..to {
                self.add(&individuals[k], &sheets[k]);
            }
            return false;
        }
        if self.bounds.len() == individuals.len() {
            self.pairs = overlapping(&self.bounds);
            self.free = vec![[0; 2]; self.pairs.len()];
            self.bounds = Vec::new();
        }
        let mut done = 0;
        while done < rounds {
            if self.next == self.pairs.len() {
                self.sweeps += 1;
                if !self.moved || self.sweeps == MOST_SWEEPS {
                    return true;
                }
                (self.next, self.moved) = (0, false);
            }
            let Some(&pair) = self.pairs.get(self.next) else { continue };
            let [a, b] = pair.map(|k| k as usize);
            let versions = [self.models[a].version, self.models[b].version];
            if self.free[self.next] != versions {
                let spent = self.solve([a, b], individuals);
                self.rounds = self.rounds.max(spent);
                self.moved |= spent > 0;
                // A pair that ran out of rounds is tried again in the next sweep.
                let solved = spent < MOST_ROUNDS;
                self.free[self.next] = if solved { [self.models[a].version, self.models[b].version] } else { [0; 2] };
                done += spent + 1;
            }
            self.next += 1;
        }
        false
    }

    /// The part of the run being worked on, and the share of it that is done.
    pub(super) fn progress(&self) -> (Part, f64) {
        if self.pairs.is_empty() {
            return (Part::Models, self.models.len() as f64 / self.bends.len().max(1) as f64);
        }
        (Part::Pairs, swept(self.sweeps, self.next as f64 / self.pairs.len() as f64))
    }

    /// Returns the sheets, and which of them have changed.
    pub(super) fn finish(self) -> (Vec<Sheet>, Vec<bool>) {
        let moved = self.models.iter().map(|model| model.version > 1).collect();
        (self.sheets, moved)
    }

    /// Works on a pair until it is free or out of rounds. Returns the number of rounds that moved something.
    fn solve(&mut self, [a, b]: [usize; 2], individuals: &[Individual]) -> u32 {
        let (c, d) = (self.meridians, self.rings);
        // Pairs are ascending, so a < b.
        let (before, after) = self.models.split_at_mut(b);
        let (first, second) = (&mut before[a], &mut after[0]);
        let (mut hits_a, mut hits_b) = (vec![false; c], vec![false; c]);
        for round in 0..MOST_ROUNDS {
            if !first.whole.overlaps(&second.whole) {
                return round;
            }
            hits_a.fill(false);
            hits_b.fill(false);
            find(first, second, &mut hits_a, &mut hits_b, d, c);
            let mut moved = false;
            for (model, k, hits) in [(&mut *first, a, &hits_a), (&mut *second, b, &hits_b)] {
                let mut own = false;
                for f in (0..c).filter(|f| hits[*f]) {
                    if step_inward(&mut self.sheets[k].points, f, c) {
                        model.place(f, d, c, &individuals[k], &self.sheets[k], &self.bends[k]);
                        own = true;
                    }
                }
                if own {
                    for f in (0..c).filter(|f| hits[*f] || hits[(*f + 1) % c]) {
                        model.bound(f, d, c);
                    }
                    model.enclose();
                    model.version += 1;
                    moved = true;
                }
            }
            if !moved {
                return round;
            }
        }
        MOST_ROUNDS
    }
}

/// Applies Eq. 3.10 to all vertices of a meridian, in the individual's own frame. Returns false if none of them could
/// move.
fn step_inward(points: &mut [DVec3], f: usize, c: usize) -> bool {
    let mut moved = false;
    for p in points.iter_mut().skip(f).step_by(c) {
        let radius = (p.x * p.x + p.z * p.z).sqrt();
        if radius > LEAST {
            let scale = (radius - STEP).max(LEAST) / radius;
            p.x *= scale;
            p.z *= scale;
            moved = true;
        }
    }
    moved
}

impl Model {
    /// Computes where the vertices of a meridian are in the world.
    fn place(&mut self, f: usize, d: usize, c: usize, individual: &Individual, sheet: &Sheet, bend: &Bend) {
        for e in 0..d {
            let v = e * c + f;
            let at = individual.to_world(bend.rib(sheet.points[v] * sheet.size, (e + 1) as f64 / d as f64).point());
            self.points[v] = at;
            self.reach[v] = at.distance_squared(individual.foot);
        }
    }

    /// Computes the boxes between meridians f and f + 1.
    fn bound(&mut self, f: usize, d: usize, c: usize) {
        let g = (f + 1) % c;
        let mut strip = Bounds::EMPTY;
        let edge = |e: usize| Bounds::of([self.points[e * c + f], self.points[e * c + g]].into_iter());
        let mut below = edge(0);
        for e in 0..d - 1 {
            let above = edge(e + 1);
            let quad = Bounds { min: below.min.min(above.min), max: below.max.max(above.max) };
            self.quads[f * (d - 1) + e] = quad;
            strip = Bounds { min: strip.min.min(quad.min), max: strip.max.max(quad.max) };
            below = above;
        }
        self.strips[f] = strip;
    }

    fn enclose(&mut self) {
        let all = self
            .strips
            .iter()
            .fold(Bounds::EMPTY, |sum, b| Bounds { min: sum.min.min(b.min), max: sum.max.max(b.max) });
        self.whole = all;
    }
}

/// One round: marks the meridians of both sheets that a hit in either direction moves.
fn find(a: &Model, b: &Model, hits_a: &mut [bool], hits_b: &mut [bool], d: usize, c: usize) {
    for f in 0..c {
        if !a.strips[f].overlaps(&b.whole) {
            continue;
        }
        tally(5 * c);
        for g in 0..c {
            let known = hits_a[f] && hits_a[(f + 1) % c] && hits_b[g] && hits_b[(g + 1) % c];
            if known || !a.strips[f].overlaps(&b.strips[g]) {
                continue;
            }
            for e in 0..d - 1 {
                let quad = &a.quads[f * (d - 1) + e];
                if !quad.overlaps(&b.strips[g]) {
                    continue;
                }
                tally(3 * d);
                for h in 0..d - 1 {
                    if quad.overlaps(&b.quads[g * (d - 1) + h]) {
                        tally(150);
                        pierce((a, [e, f]), (b, [h, g]), hits_a, hits_b, d, c);
                        pierce((b, [h, g]), (a, [e, f]), hits_b, hits_a, d, c);
                    }
                }
            }
        }
    }
}

/// Tests the segments of one quad against the triangles of another, and marks the meridians that a hit moves.
fn pierce(
    (a, [e, f]): (&Model, [usize; 2]),
    (b, [h, g]): (&Model, [usize; 2]),
    hits_a: &mut [bool],
    hits_b: &mut [bool],
    d: usize,
    c: usize,
) {
    let corners = |e: usize, f: usize| {
        let next = (f + 1) % c;
        [e * c + f, (e + 1) * c + f, (e + 1) * c + next, e * c + next]
    };
    let [p00, p10, p11, p01] = corners(e, f);
    let [q00, q10, q11, q01] = corners(h, g);
    // Each quad owns the lower of its ring edges, its first meridian edge and its diagonal. The last quad of a meridian
    // also owns the edge on the rim.
    let segments = [[p00, p01], [p00, p10], [p00, p11], [p10, p11]];
    let count = if e + 2 == d { 4 } else { 3 };
    for triangle in [[q00, q10, q11], [q00, q11, q01]] {
        let far = farthest(b, triangle);
        let corner = triangle[far];
        let at = b.points[corner];
        let l = b.points[triangle[(far + 1) % 3]] - at;
        let m = b.points[triangle[(far + 2) % 3]] - at;
        let normal = l.cross(m);
        for [s, t] in &segments[..count] {
            let (near, far) = if farther(a, *s, *t) { (*t, *s) } else { (*s, *t) };
            let [of_q, of_a] = [far % c, corner % c];
            if hits_a[of_q] && hits_b[of_a] {
                continue;
            }
            // Eq. 3.8: u L + v M + t (P − Q) = P − A, by Cramer's rule.
            let (p, q) = (a.points[near], a.points[far]);
            let (back, from) = (p - q, p - at);
            let det = normal.dot(back);
            let (det, sign) = (det.abs(), if det < 0.0 { -1.0 } else { 1.0 });
            let along = sign * normal.dot(from);
            if !(along >= 0.0 && along <= det) {
                continue;
            }
            let size = l.length_squared() * m.length_squared() * back.length_squared();
            if det * det < 1.0e-24 * size {
                continue;
            }
            let aside = from.cross(back) * sign;
            let [u, v] = [-m.dot(aside), l.dot(aside)];
            if u > 0.0 && v > 0.0 && u + v < det {
                hits_a[of_q] = true;
                hits_b[of_a] = true;
            }
        }
    }
}

/// Whether vertex s is farther from the foot than t. Of two equally far ones, the one with the larger e, then with the
/// larger f, counts as farther (decision K5).
fn farther(model: &Model, s: usize, t: usize) -> bool {
    let [of_s, of_t] = [model.reach[s], model.reach[t]];
    of_s > of_t || (of_s == of_t && s > t)
}

fn farthest(model: &Model, [a, b, c]: [usize; 3]) -> usize {
    let best = if farther(model, b, a) { (b, 1) } else { (a, 0) };
    if farther(model, c, best.0) { 2 } else { best.1 }
}
