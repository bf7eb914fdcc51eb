//! Growth of the selected cells over the ground that is left free, an addition to the papers. It is part of the library and not of
//! the generator yet, which has no parameter for it.
//!
//! Every selected cell grows outward at the same speed until it meets another: a place belongs to the cell with the lowest
//! f, of equal ones to the first by (layer, site), where f is the largest of the distances from the lines of the cell's edges. Each
//! cell stays whole, since there its own f is negative and that of others is not; where two overlap between the centres of
//! pixels, both do. With a joint, growth ends where another's f is not larger by at least the width of the joint.
//!
//! Of the ground of a cell only what hangs together with it counts ([`wedge`] finds it, edge by edge). A part that others cut off
//! goes to the cell that cuts it off ([`join`]), or else to the one along which its border is longest; with joints it stays free.

mod bounds;
mod fronts;
mod join;
mod wedge;

use glam::DVec2;

use fronts::{Fronts, ROUNDING, Reach};
use join::{join, tidy};
use wedge::{Grounds, Part};

use super::field::FieldLayer;
use super::shape::in_order_of_sites;

/// The outlines of a layer's rocks on the ground, in the order of the selection.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outlines {
    /// rocks + 1 offsets into `corners`.
    pub starts: Vec<u32>,
    /// Corners, px, counter-clockwise. An outline need not be convex.
    pub corners: Vec<DVec2>,
}

impl Outlines {
    /// The outline of rock `k`.
    pub fn of(&self, k: usize) -> &[DVec2] {
        &self.corners[self.starts[k] as usize..self.starts[k + 1] as usize]
    }

    /// Number of rocks.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there are no rocks.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What is left to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Surround,
    Part,
    Join,
    Finish,
}

/// Grows the cells of all layers, some of them per step.
#[derive(Debug)]
struct Grower {
    fronts: Fronts,
    reach: Reach,
    grounds: Grounds,
    phase: Phase,
    /// The cells that the phase goes through, those from `next` on; and those whose surroundings were too small.
    todo: Vec<u32>,
    next: usize,
    again: Vec<u32>,
    /// How far any cell has grown at most, px.
    farthest: f64,
    /// Per rock, its outline.
    outlines: Vec<Vec<DVec2>>,
    /// Corners of rocks at which parts may be cut off: rock, corner, and how far the cell would have to grow for it, px.
    doubtful: Vec<([u32; 2], f64)>,
    /// Parts that belong to no outline yet.
    parts: Vec<Part>,
    /// How many of them were joined in this round.
    joined: usize,
    /// Whether parts go to any cell beside them.
    insists: bool,
}

/// Grows the selected cells of a field's layers until they meet, and returns the outlines of the rocks of each layer.
///
/// Rocks do not grow into `obstacles`, triangles of which the part within the image counts. These grow, too, so that the space around
/// them is shared. With a `joint`, px, growth ends before it.
pub fn grow(image: [u32; 2], layers: &[FieldLayer], obstacles: &[[DVec2; 3]], joint: f64) -> Vec<Outlines> {
    let finest = layers.iter().fold(f64::INFINITY, |least, layer| least.min(layer.sites.radius));
    let mut grower = Grower::new(ground(image, layers, obstacles), finest, joint);
    while !grower.advance(CELLS_PER_STEP) {}
    let mut first = 0;
    let of = |layer: &FieldLayer| {
        let selected = &layer.selection.selected;
        first += selected.len();
        grower.outlines(first - selected.len(), &numbers(selected, layer.cells.len()))
    };
    layers.iter().map(of).collect()
}

/// Number of cells that one step looks at.
const CELLS_PER_STEP: usize = 1 << 7;

/// Collects what grows: the selected cells of all layers in input order, by site within a layer; and obstacles.
fn ground(image: [u32; 2], layers: &[FieldLayer], obstacles: &[[DVec2; 3]]) -> Fronts {
    let rocks: usize = layers.iter().map(|layer| layer.selection.selected.len()).sum();
    let mut fronts = Fronts::new(image, rocks + obstacles.len());
    for FieldLayer { sites, cells, selection, .. } in layers {
        for rock in in_order_of_sites(&selection.selected, cells.len()) {
            fronts.push(sites, cells, selection.selected[rock as usize] as usize);
        }
    }
    fronts.rocks = rocks;
    let corner = fronts.image;
    for &[a, b, c] in obstacles {
        let mut part = if (b - a).perp_dot(c - a) > 0.0 { vec![a, b, c] } else { vec![a, c, b] };
        part = clip(&part, |v| v.x);
        part = clip(&part, |v| corner.x - v.x);
        part = clip(&part, |v| v.y);
        part = clip(&part, |v| corner.y - v.y);
        let area: f64 = part.windows(2).map(|pair| (pair[0] - part[0]).perp_dot(pair[1] - part[0])).sum();
        if area > LEAST_OBSTACLE {
            fronts.obstruct(&part);
        }
    }
    fronts
}

/// Twice the area of the smallest obstacle, px².
const LEAST_OBSTACLE: f64 = 0.01;

/// The part of a convex polygon where `depth` is not negative.
fn clip(polygon: &[DVec2], depth: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &here) in polygon.iter().enumerate() {
        let next = polygon[(k + 1) % polygon.len()];
        let (a, b) = (depth(here), depth(next));
        if a >= 0.0 {
            kept.push(here);
        }
        if (a < 0.0) != (b < 0.0) {
            kept.push(here + (next - here) * (a / (a - b)));
        }
    }
    kept
}

/// The number of each selected cell if they are counted by site.
fn numbers(selected: &[u32], sites: usize) -> Vec<u32> {
    let mut numbers = vec![0; selected.len()];
    for (number, rock) in (0..).zip(in_order_of_sites(selected, sites)) {
        numbers[rock as usize] = number;
    }
    numbers
}

impl Grower {
    /// `reach` is a distance that cells will probably not grow farther than, and `joint` the width of joints, px.
    fn new(fronts: Fronts, reach: f64, joint: f64) -> Self {
        let rocks = fronts.rocks;
        Grower {
            reach: Reach::new(&fronts, reach.min(longest(&fronts))),
            grounds: Grounds::new(joint),
            phase: Phase::Surround,
            todo: (0..rocks as u32).collect(),
            next: 0,
            again: Vec::new(),
            farthest: 0.0,
            outlines: vec![Vec::new(); rocks],
            doubtful: Vec::new(),
            parts: Vec::new(),
            joined: 0,
            insists: false,
            fronts,
        }
    }

    /// Works on about `count` more cells. Returns true when all have grown.
    #[inline(never)]
    fn advance(&mut self, count: usize) -> bool {
        let all = match self.phase {
            Phase::Surround => self.todo.len(),
            Phase::Part => self.doubtful.len(),
            Phase::Join => self.parts.len(),
            Phase::Finish => self.outlines.len(),
        };
        let to = (self.next + count).min(all);
        while self.next < to {
            let k = self.next;
            self.next += 1;
            match self.phase {
                Phase::Surround => self.surround(self.todo[k]),
                Phase::Part => self.part(k),
                Phase::Join => self.join(k),
                Phase::Finish => tidy(&mut self.outlines[k], self.fronts.image),
            }
        }
        self.next == all && self.end_phase()
    }

    /// Goes on to what comes next. Returns true when nothing does.
    fn end_phase(&mut self) -> bool {
        self.next = 0;
        self.phase = match self.phase {
            Phase::Surround if !self.again.is_empty() => {
                self.todo = core::mem::take(&mut self.again);
                self.reach = Reach::new(&self.fronts, (2.0 * self.reach.px).min(longest(&self.fronts)));
                Phase::Surround
            }
            Phase::Surround => {
                let farthest = self.farthest;
                // Parts that are cut off stay free where there are joints.
                let keeps = self.grounds.joint == 0.0;
                self.doubtful.retain(|(_, v)| keeps && *v < farthest);
                if !self.doubtful.is_empty() {
                    self.reach = Reach::new(&self.fronts, farthest + ROUNDING);
                }
                Phase::Part
            }
            Phase::Part => Phase::Join,
            Phase::Join if self.joined > 0 || !self.insists => {
                self.parts.retain(|part| !part.outline.is_empty());
                // After each that goes elsewhere, others may go where they belong.
                self.insists = self.joined == 0;
                self.joined = 0;
                Phase::Join
            }
            Phase::Join => Phase::Finish,
            Phase::Finish => return true,
        };
        false
    }

    fn surround(&mut self, rock: u32) {
        let Grower { fronts, reach, grounds, .. } = self;
        reach.near(fronts, rock as usize, &mut grounds.near);
        grounds.reach = reach.px;
        grounds.surround(fronts, rock);
        if grounds.farthest > reach.px && reach.px < longest(fronts) {
            // What lies beyond what was looked at may come between.
            self.again.push(rock);
            return;
        }
        self.farthest = self.farthest.max(grounds.farthest);
        self.outlines[rock as usize] = grounds.outline.clone();
        self.doubtful.extend(grounds.doubtful.iter().map(|&(corner, v)| ([rock, corner], v)));
    }

    fn part(&mut self, k: usize) {
        let Grower { fronts, reach, grounds, parts, doubtful, .. } = self;
        let place = doubtful[k].0;
        if k == 0 || doubtful[k - 1].0[0] != place[0] {
            reach.near(fronts, place[0] as usize, &mut grounds.near);
            grounds.reach = reach.px;
        }
        grounds.parts(fronts, place, &mut |part| parts.push(part));
    }

    /// Joins a part to the cell that cuts it off; or, once that has been tried with all of them, to the one along which its
    /// border is longest.
    fn join(&mut self, k: usize) {
        let Grower { outlines, parts, insists, .. } = self;
        let Part { outline, cutter } = &mut parts[k];
        let cutter = *cutter as usize;
        let mut best: Option<(usize, Vec<DVec2>, f64)> = None;
        let candidates = if *insists { 0..outlines.len() } else { cutter..(cutter + 1).min(outlines.len()) };
        for cell in candidates {
            if let Some((joined, length)) = join(&outlines[cell], outline) {
                if best.as_ref().is_none_or(|(_, _, most)| length > *most) {
                    best = Some((cell, joined, length));
                }
            }
        }
        if let Some((cell, joined, _)) = best {
            outlines[cell] = joined;
            outline.clear();
            self.joined += 1;
        }
    }

    /// Returns the outlines of the rocks from number `first` on, in the given order: `order` holds numbers from 0 on.
    fn outlines(&self, first: usize, order: &[u32]) -> Outlines {
        let mut outlines = Outlines { starts: Vec::with_capacity(order.len() + 1), corners: Vec::new() };
        outlines.starts.push(0);
        let of = |rock: u32| &self.outlines[first + rock as usize];
        outlines.corners.reserve_exact(order.iter().map(|&rock| of(rock).len()).sum());
        for &rock in order {
            outlines.corners.extend_from_slice(of(rock));
            outlines.starts.push(outlines.corners.len() as u32);
        }
        outlines
    }
}

/// Farther than any cell of an image can grow, px.
fn longest(fronts: &Fronts) -> f64 {
    fronts.image.x + fronts.image.y
}
