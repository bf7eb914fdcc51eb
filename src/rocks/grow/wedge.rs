//! The ground of one cell, found edge by edge.
//!
//! Let l be the distance of a place from the line of an edge, and f the largest of a cell's distances: where the cell has
//! grown by t, f ≤ t. The places that an edge reaches, where its own l is the cell's largest, are a wedge: it stands on the
//! edge, and ends at the ridges along which the cell's corners move. With u along the edge and v = l away from it, whatever
//! another cell takes of the wedge is convex, and goes on for ever towards larger v, since no distance grows faster than v.
//! So the other cell begins at v = g(u), a convex function made of one line for each of its edges, and what is left
//! to the wedge lies below the lowest of these functions. At the ends, the ground of the wedge begins
//! above the ridge: it hangs together with the cell as far as the ridge does, and what lies above a later stretch of the ridge is a
//! part that is cut off. A side of the image that leans over the wedge goes on in the place of the ridge.

use glam::DVec2;

use super::bounds::Bounds;
use super::fronts::{Edge, Fronts, ROUNDING, ridge};

/// Stretches of a ridge that are shorter than this are no ground, px.
const SHORTEST: f64 = 1.0e-6;

/// How steeply a side of the image may stand in a wedge and still be a bound of v.
const UPRIGHT: f64 = 1.0e-12;

/// A ray along which a cell's f grows evenly from `v` on: a ridge, or a side of the image.
#[derive(Debug, Clone, Copy)]
struct Ray {
    from: DVec2,
    way: DVec2,
    v: f64,
    rise: f64,
}

impl Ray {
    fn at(&self, s: f64) -> DVec2 {
        self.from + self.way * s
    }
}

/// A stretch of a ray that is not taken by another cell, and the cell that takes what lies before it: `None` at the cell itself.
#[derive(Debug, Clone, Copy)]
struct Free {
    from: f64,
    to: f64,
    cutter: Option<u32>,
}

/// Where the wedges on both sides of a corner of the cell end, and what lies between.
#[derive(Debug, Clone, Copy, Default)]
struct End {
    /// The end of the ground of the wedge before the corner, of the stretch along the ridge, and of the wedge after it.
    before: DVec2,
    ridge: DVec2,
    after: DVec2,
    /// How far the cell has grown there at most, px.
    v: f64,
}

/// A part of a cell's ground that others cut off.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub(super) outline: Vec<DVec2>,
    /// The cell whose ground lies between the part and its cell.
    pub(super) cutter: u32,
}

/// Finds the ground of cells, one after the other.
#[derive(Debug, Default)]
pub(super) struct Grounds {
    /// The cells that may be met, with how near they are.
    pub(super) near: Vec<(f64, u32)>,
    /// How far the cell may grow before others matter that are not in the list, px.
    pub(super) reach: f64,
    /// Width of joints, px.
    pub(super) joint: f64,
    cell: u32,
    bounds: Bounds,
    ends: Vec<End>,
    pub(super) outline: Vec<DVec2>,
    /// How far the cell has grown at most, px.
    pub(super) farthest: f64,
    /// The corners at which parts may be cut off from the cell, each with how far the cell would have to grow for it at least, px.
    pub(super) doubtful: Vec<(u32, f64)>,
    rejoins: f64,
}

impl Grounds {
    pub(super) fn new(joint: f64) -> Self {
        Grounds { joint, ..Grounds::default() }
    }

    /// Finds the outline of the ground that hangs together with a cell. `near` holds the other cells that matter.
    pub(super) fn surround(&mut self, fronts: &Fronts, cell: u32) {
        self.cell = cell;
        self.outline.clear();
        self.farthest = 0.0;
        self.doubtful.clear();
        let edges = fronts.edges_of(cell as usize);
        let count = edges.len();
        self.ends.clear();
        for corner in 0..count {
            self.rejoins = f64::INFINITY;
            let end = self.end(fronts, [&edges[(corner + count - 1) % count], &edges[corner]]);
            if self.rejoins < f64::INFINITY {
                self.doubtful.push((corner as u32, self.rejoins));
            }
            self.farthest = self.farthest.max(end.v);
            self.ends.push(end);
        }
        for (k, edge) in edges.iter().enumerate() {
            let next = (k + 1) % count;
            let End { ridge, after, .. } = self.ends[k];
            self.outline.extend([ridge, after]);
            self.rim(fronts, edge, [after, self.ends[next].before]);
            self.outline.push(self.ends[next].before);
        }
    }

    /// Finds the parts of a cell's ground at a corner that do not hang together with it, as far as the cell has grown by at most
    /// its reach.
    pub(super) fn parts(&mut self, fronts: &Fronts, [cell, corner]: [u32; 2], visit: &mut impl FnMut(Part)) {
        self.cell = cell;
        let (edges, corner) = (fronts.edges_of(cell as usize), corner as usize);
        let pair = [&edges[(corner + edges.len() - 1) % edges.len()], &edges[corner]];
        let [before, after] = pair;
        let ray = Ray { from: after.corner, way: ridge(before, after), v: 0.0, rise: 1.0 };
        let (leaves, side) = exit(fronts, &ray);
        let mut free = self.free_stretches(fronts, &ray, pair, leaves);
        // The wedge that goes on along a side of the image, and the stretches there.
        let over = pair.into_iter().position(|edge| leaves < self.reach && side.normal.dot(edge.normal) <= UPRIGHT);
        let along = over.map(|k| (k, along_side(&ray, leaves, &side, pair[k])));
        let mut beyond = match &along {
            Some((k, along)) => self.free_stretches(fronts, along, [pair[*k]; 2], exit(fronts, along).0),
            None => Vec::new(),
        };
        // What begins where the ridge leaves the image hangs together with what ends there.
        let first = beyond.first().copied().filter(|first| first.cutter.is_none());
        beyond.retain(|stretch| stretch.cutter.is_some());
        free.retain(|stretch| stretch.cutter.is_some());
        for Free { from, to, cutter } in free {
            let top = ray.at(to);
            let mut ends = [top; 2];
            if let (Some((k, along)), Some(first), true) = (&along, first, to >= leaves) {
                ends[*k] = along.at(first.to);
            }
            let foot = ray.at(from);
            self.outline.clear();
            self.outline.push(foot);
            self.rim(fronts, before, [foot, ends[0]]);
            self.outline.extend([ends[0], top, ends[1]]);
            self.rim(fronts, after, [ends[1], foot]);
            visit(Part { outline: self.outline.clone(), cutter: cutter.unwrap_or_default() });
        }
        let Some((k, along)) = along else { return };
        for Free { from, to, cutter } in beyond {
            let mut ends = [along.at(from), along.at(to)];
            if k == 1 {
                ends.swap(0, 1);
            }
            self.outline.clear();
            self.outline.push(ends[0]);
            self.rim(fronts, pair[k], ends);
            self.outline.push(ends[1]);
            visit(Part { outline: self.outline.clone(), cutter: cutter.unwrap_or_default() });
        }
    }

    /// Where the wedges on both sides of a corner end.
    fn end(&mut self, fronts: &Fronts, [before, after]: [&Edge; 2]) -> End {
        let ray = Ray { from: after.corner, way: ridge(before, after), v: 0.0, rise: 1.0 };
        let (leaves, side) = exit(fronts, &ray);
        let blocked = self.first_block(fronts, &ray, [before, after]);
        self.rejoins = self.rejoins.min(leaves);
        let v = blocked.min(leaves);
        let ridge = ray.at(v);
        let end = End { before: ridge, ridge, after: ridge, v };
        if blocked <= leaves + ROUNDING {
            return end;
        }
        for (edge, is_before) in [(before, true), (after, false)] {
            if side.normal.dot(edge.normal) > UPRIGHT {
                continue;
            }
            let along = along_side(&ray, v, &side, edge);
            let s = self.first_block(fronts, &along, [edge, edge]).min(exit(fronts, &along).0);
            let (place, v) = (along.at(s), v + along.rise * s);
            return if is_before { End { before: place, v, ..end } } else { End { after: place, v, ..end } };
        }
        end
    }

    /// Where another cell first takes a ray that starts at the cell's own ground. `edges` are those that reach the ray.
    fn first_block(&mut self, fronts: &Fronts, ray: &Ray, edges: [&Edge; 2]) -> f64 {
        let (mut first, mut end) = ((self.reach - ray.v) / ray.rise, f64::INFINITY);
        let mut found = false;
        for &(_, other) in &self.near {
            if let Some((low, high)) = self.block(fronts, ray, edges, other, first) {
                // What is cut off at the start by several begins where the last of them ends.
                end = if found && first == 0.0 { high.max(end) } else { high };
                (first, found) = (low.max(0.0), true);
            }
        }
        if !found {
            return f64::INFINITY;
        }
        self.rejoins = self.rejoins.min(ray.v + ray.rise * end);
        first
    }

    /// The stretches of a ray that no other cell takes, of those that end at `leaves` or before the cell has grown by its reach.
    fn free_stretches(&self, fronts: &Fronts, ray: &Ray, edges: [&Edge; 2], leaves: f64) -> Vec<Free> {
        let limit = leaves.min((self.reach - ray.v) / ray.rise);
        let block = |&(_, other): &(f64, u32)| {
            self.block(fronts, ray, edges, other, limit).map(|(low, high)| (low, high, other))
        };
        let blocks: Vec<(f64, f64, u32)> = self.near.iter().filter_map(block).collect();
        let mut free = Vec::new();
        let (mut from, mut cutter) = (0.0, None);
        // Each round either takes one more block or ends a stretch before one.
        for _ in 0..=2 * blocks.len() {
            // What is taken from here on, and where the next block begins.
            let mut to = limit;
            let mut goes_on = false;
            for &(low, high, cell) in &blocks {
                if low > from + ROUNDING {
                    to = to.min(low);
                } else if high > from || cutter.is_none() {
                    goes_on |= high > from;
                    (from, cutter) = (high.max(from), Some(cell));
                }
            }
            if from >= limit {
                break;
            }
            if goes_on {
                continue;
            }
            let is_closed = to < limit || limit == leaves;
            if is_closed && to - from >= SHORTEST {
                free.push(Free { from, to, cutter });
            }
            if to >= limit {
                break;
            }
            from = to;
        }
        free
    }

    /// Where along a ray, from its start on and before `most`, another cell is at least as near as this one.
    fn block(&self, fronts: &Fronts, ray: &Ray, [edge, twin]: [&Edge; 2], other: u32, most: f64) -> Option<(f64, f64)> {
        let way = ray.way / ray.rise;
        let from = ray.from - way * ray.v;
        if !fronts.extents[other as usize].may_meet([from; 2], way, ray.v + ray.rise * most, self.joint) {
            return None;
        }
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for line in fronts.edges_of(other as usize) {
            if let Some(ahead) = edge.ahead(line).or_else(|| twin.ahead(line)) {
                if is_beyond(ahead - self.joint, other, self.cell) {
                    return None;
                }
                continue;
            }
            // By how much the other is farther away, at the start and for each step.
            let start = line.at(ray.from) - ray.v - self.joint;
            let slope = line.normal.dot(ray.way) - ray.rise;
            if start > ROUNDING && start + slope * most > ROUNDING {
                return None;
            }
            if slope < 0.0 {
                low = low.max(start / -slope);
            } else if slope > 0.0 {
                high = high.min(-start / slope);
            } else if start > 0.0 {
                return None;
            }
            if high < -ROUNDING || low > high + ROUNDING || low > most {
                return None;
            }
        }
        // Away from the start, what only touches the ray leaves it whole.
        let touches = if low <= ROUNDING { -ROUNDING } else { SHORTEST };
        (high - low >= touches).then_some((low, high))
    }

    /// Appends the corners of the outline over an edge, strictly between two places of its wedge.
    fn rim(&mut self, fronts: &Fronts, edge: &Edge, ends: [DVec2; 2]) {
        let along = DVec2::new(-edge.normal.y, edge.normal.x);
        let [from, to] = ends.map(|end| along.dot(end - edge.corner));
        if to - from < ROUNDING {
            return;
        }
        self.bound(fronts, edge, along, [from, to]);
        let place = |u: f64, v: f64| edge.corner + along * u + edge.normal * v;
        let mut u = from;
        let Some(mut lowest) = self.bounds.lowest(from) else {
            // Nothing was found that the wedge ends at.
            self.farthest = f64::INFINITY;
            return;
        };
        let start = self.bounds.value(lowest.line, u);
        // Beyond its reach, bounds have been left out.
        let most = self.reach + ROUNDING;
        let mut farthest = if start > most { f64::INFINITY } else { self.farthest };
        let mut is_below = start < 0.0;
        // More corners than this can only come from rounding.
        for _ in 0..4 * self.bounds.lines() {
            let (at, next) = self.bounds.next(u, to, lowest);
            let v = self.bounds.value(lowest.line, at);
            // Where cells overlap between the centres of pixels, both are kept whole: the outline runs along the edge.
            if (v < 0.0) != is_below {
                is_below = !is_below;
                self.outline.extend(self.bounds.root(lowest.line).map(|root| place(root.max(u).min(at), 0.0)));
            }
            let Some(next) = next else {
                farthest = if v > most { f64::INFINITY } else { farthest };
                break;
            };
            farthest = farthest.max(v);
            self.outline.push(place(at, v.max(0.0)));
            (u, lowest) = (at, next);
        }
        self.farthest = farthest;
    }

    /// Lists the bounds of a wedge that may count between two places along its edge.
    fn bound(&mut self, fronts: &Fronts, edge: &Edge, along: DVec2, [from, to]: [f64; 2]) {
        let bounds = &mut self.bounds;
        bounds.start([from, to], self.reach.max(0.0));
        let (base, far) = (edge.corner + along * from, edge.corner + along * to);
        let whole = [base.min(far), base.max(far)];
        for side in 0..4 {
            let side = Edge::side(side, fronts.image);
            let lean = side.normal.dot(edge.normal);
            if lean > UPRIGHT {
                bounds.push(-side.normal.dot(along) / lean, -side.at(edge.corner) / lean);
                bounds.close();
            }
        }
        for &(_, other) in &self.near {
            let lines = fronts.edges_of(other as usize);
            if !fronts.extents[other as usize].may_meet(whole, edge.normal, bounds.most, self.joint) {
                continue;
            }
            // By how much the other is farther away: at the corner, for each step along the edge, and less for each away from it.
            let gap = |line: &Edge| {
                let drop = 0.5 * (edge.normal - line.normal).length_squared();
                (line.at(edge.corner) - self.joint, line.normal.dot(along), drop)
            };
            // A line that keeps the other cell away from all that is left of the wedge.
            let separates = |line: &Edge| {
                let (start, slope, drop) = gap(line);
                let top = start - drop * bounds.most;
                top + slope * from > ROUNDING && top + slope * to > ROUNDING
            };
            let faces =
                |line: &Edge| edge.ahead(line).is_some_and(|ahead| is_beyond(ahead - self.joint, other, self.cell));
            if lines.iter().any(|line| separates(line) || faces(line)) {
                continue;
            }
            for line in lines.iter().filter(|line| edge.ahead(line).is_none()) {
                let (start, slope, drop) = gap(line);
                bounds.push(slope / drop, start / drop);
            }
            bounds.close();
        }
        bounds.finish();
    }
}

/// Whether another cell is farther away everywhere, of which an edge faces the same way as one of this cell and is this much
/// farther away. At the same distance, the first cell is the nearer one.
fn is_beyond(gap: f64, other: u32, cell: u32) -> bool {
    gap > 0.0 || (gap == 0.0 && other > cell)
}

/// Where a ray leaves the image, and the side through which it does.
fn exit(fronts: &Fronts, ray: &Ray) -> (f64, Edge) {
    let mut first = (f64::INFINITY, Edge::side(0, fronts.image));
    for side in 0..4 {
        let side = Edge::side(side, fronts.image);
        let gain = side.normal.dot(ray.way);
        if gain > UPRIGHT {
            let s = (-side.at(ray.from) / gain).max(0.0);
            if s < first.0 {
                first = (s, side);
            }
        }
    }
    first
}

/// The ray along a side of the image from where a ridge leaves it, towards larger distances from an edge.
fn along_side(ridge: &Ray, leaves: f64, side: &Edge, edge: &Edge) -> Ray {
    let along = DVec2::new(-side.normal.y, side.normal.x);
    let way = if along.dot(edge.normal) < 0.0 { -along } else { along };
    Ray { from: ridge.at(leaves), way, v: ridge.v + ridge.rise * leaves, rise: way.dot(edge.normal) }
}
