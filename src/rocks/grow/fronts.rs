//! The cells that grow, and which of them may meet.

use glam::DVec2;

use crate::rocks::cell::SIDES;
use crate::rocks::sites::Sites;
use crate::rocks::voronoi::Cells;

/// Where lines meet farther than this from a cell's vertex, the vertex counts, px.
const NEAR_VERTEX: f64 = 1.0e-5;

/// Rounding of places and distances, px. What touches this closely counts as touching.
pub(super) const ROUNDING: f64 = 1.0e-9;

/// An edge of a cell: the line n·x = c with the outward unit normal n, and the corner at which the edge begins.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Edge {
    pub(super) normal: DVec2,
    pub(super) c: f64,
    pub(super) corner: DVec2,
}

impl Edge {
    /// The edge between the cells of two sites. All edges on one line have the same bits, and those on its other side the
    /// opposite ones.
    fn between(site: [i32; 2], other: [i32; 2]) -> Edge {
        let offset = [other[0] - site[0], other[1] - site[1]];
        let (mut divisor, mut rest) = (offset[0].unsigned_abs(), offset[1].unsigned_abs());
        while rest > 0 {
            (divisor, rest) = (rest, divisor % rest);
        }
        let way = DVec2::from(offset.map(|n| f64::from(n / divisor.max(1) as i32)));
        // Twice the place half way between the centres of both pixels.
        let middle = DVec2::new(f64::from(site[0] + other[0] + 1), f64::from(site[1] + other[1] + 1));
        let length = way.length();
        Edge { normal: way / length, c: way.dot(middle) / (2.0 * length), corner: DVec2::ZERO }
    }

    /// The edge from one corner of an obstacle to the next.
    fn along(from: DVec2, to: DVec2) -> Edge {
        let normal = DVec2::new(to.y - from.y, from.x - to.x).normalize();
        Edge { normal, c: normal.dot(from), corner: from }
    }

    /// The distance of another edge's line from this one's if both face the same way, px.
    #[inline]
    pub(super) fn ahead(&self, other: &Edge) -> Option<f64> {
        (self.normal == other.normal).then_some(self.c - other.c)
    }

    /// A side of the image of this size, px: left, right, bottom, top. The image lies where the distance is negative.
    pub(super) fn side(side: usize, image: DVec2) -> Edge {
        let (normal, c) = [(DVec2::NEG_X, 0.0), (DVec2::X, image.x), (DVec2::NEG_Y, 0.0), (DVec2::Y, image.y)][side];
        Edge { normal, c, corner: DVec2::ZERO }
    }

    /// The distance of a place from the line, px, positive outside of the cell.
    #[inline]
    pub(super) fn at(&self, place: DVec2) -> f64 {
        self.normal.dot(place) - self.c
    }
}

/// A cell's lowest and highest corner, and how far each of these moves when the cell grows by 1 px.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extents {
    low: DVec2,
    high: DVec2,
    down: DVec2,
    up: DVec2,
}

impl Extents {
    /// The lowest and the highest corner of what the cell covers once it has grown by this distance.
    fn grown(&self, px: f64) -> [DVec2; 2] {
        [self.low + px * self.down, self.high + px * self.up]
    }

    /// Whether the cell, grown by `joint`, may meet a box that moves by `way` while the cell grows by 1 px, before it has grown by
    /// `most`. False only if it certainly does not.
    #[inline]
    pub(super) fn may_meet(&self, [low, high]: [DVec2; 2], way: DVec2, most: f64, joint: f64) -> bool {
        // Both gaps change evenly, so that each is smallest at the start or at the end.
        let [own_low, own_high] = self.grown(joint);
        let (left, right) = (own_low - high, low - own_high);
        let (left_end, right_end) = (left + (self.down - way) * most, right + (way - self.up) * most);
        left.min(left_end).max(right.min(right_end)).max_element() <= ROUNDING
    }
}

/// The cells of all rocks by (layer, site), followed by obstacles, which only stand in the way.
#[derive(Debug, Default)]
pub(super) struct Fronts {
    /// Offsets into `edges`, one more than there are cells.
    pub(super) starts: Vec<u32>,
    pub(super) edges: Vec<Edge>,
    pub(super) extents: Vec<Extents>,
    /// Number of cells on which rocks stand.
    pub(super) rocks: usize,
    pub(super) image: DVec2,
}

impl Fronts {
    pub(super) fn new([width, height]: [u32; 2], cells: usize) -> Self {
        let mut fronts = Fronts { image: DVec2::new(width.into(), height.into()), ..Fronts::default() };
        fronts.starts.reserve_exact(cells + 1);
        fronts.starts.push(0);
        fronts.edges.reserve_exact(6 * cells);
        fronts.extents.reserve_exact(cells);
        fronts
    }

    pub(super) fn len(&self) -> usize {
        self.extents.len()
    }

    /// Adds the cell of a site.
    pub(super) fn push(&mut self, sites: &Sites, cells: &Cells, site: usize) {
        let first = self.edges.len();
        let pixel = |site: usize| sites.pixels[site].map(i32::from);
        let here = pixel(site);
        for (&corner, &neighbor) in cells.polygon(site).iter().zip(cells.neighbors_of(site)) {
            let edge = match neighbor.checked_sub(SIDES) {
                Some(side) => Edge::side(side as usize, self.image),
                None => Edge::between(here, pixel(neighbor as usize)),
            };
            self.edges.push(Edge { corner, ..edge });
        }
        // Vertices are rounded, and cells that touch in one should do so exactly.
        let centre = DVec2::new(f64::from(here[0]), f64::from(here[1])) + 0.5;
        let edges = &mut self.edges[first..];
        let mut before = edges[edges.len() - 1];
        for edge in edges {
            let turn = before.normal.perp_dot(edge.normal);
            let along = edge.at(centre) * before.normal - before.at(centre) * edge.normal;
            let meet = centre + DVec2::new(along.y, -along.x) / turn;
            if meet.distance_squared(edge.corner) < NEAR_VERTEX * NEAR_VERTEX {
                edge.corner = meet;
            }
            before = *edge;
        }
        self.close(first);
    }

    /// Adds a convex obstacle, counter-clockwise.
    pub(super) fn obstruct(&mut self, polygon: &[DVec2]) {
        let first = self.edges.len();
        let mut from = polygon[polygon.len() - 1];
        for &to in polygon {
            if from != to {
                self.edges.push(Edge::along(from, to));
            }
            from = to;
        }
        self.close(first);
    }

    /// Measures the cell with the edges from `first` on.
    fn close(&mut self, first: usize) {
        let edges = &self.edges[first..];
        let [mut low, mut high] = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let [mut down, mut up] = [DVec2::ZERO; 2];
        let mut before = &edges[edges.len() - 1];
        for edge in edges {
            let way = ridge(before, edge);
            (low, high) = (low.min(edge.corner), high.max(edge.corner));
            (down, up) = (down.min(way), up.max(way));
            before = edge;
        }
        self.extents.push(Extents { low, high, down, up });
        self.starts.push(self.edges.len() as u32);
    }

    /// The edges of a cell.
    #[inline]
    pub(super) fn edges_of(&self, cell: usize) -> &[Edge] {
        &self.edges[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}

/// How the corner between two consecutive edges of a cell moves when the cell grows by 1 px.
pub(super) fn ridge(before: &Edge, after: &Edge) -> DVec2 {
    (before.normal + after.normal) / (1.0 + before.normal.dot(after.normal)).max(1.0e-9)
}

/// Square buckets over the image with the cells that reach into them once they have grown by a distance.
#[derive(Debug, Default)]
pub(super) struct Reach {
    pub(super) px: f64,
    side: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    cells: Vec<u32>,
    /// Per cell, the last one for which it was found.
    found: Vec<u32>,
}

impl Reach {
    pub(super) fn new(fronts: &Fronts, px: f64) -> Self {
        let image = fronts.image;
        let side = (2.0 * image.x * image.y / fronts.len().max(1) as f64).sqrt().max(2.0 * px).max(1.0);
        let (columns, rows) = ((image.x / side) as usize + 1, (image.y / side) as usize + 1);
        let mut reach = Reach { px, side, columns, rows, found: vec![u32::MAX; fronts.len()], ..Reach::default() };
        let mut starts = vec![0_u32; columns * rows + 1];
        for cell in 0..fronts.len() {
            reach.buckets(fronts, cell, |bucket| starts[bucket + 1] += 1);
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut next = starts.clone();
        let mut cells = vec![0; starts[starts.len() - 1] as usize];
        for cell in 0..fronts.len() {
            reach.buckets(fronts, cell, |bucket| {
                cells[next[bucket] as usize] = cell as u32;
                next[bucket] += 1;
            });
        }
        (reach.starts, reach.cells) = (starts, cells);
        reach
    }

    /// Calls `visit` with the number of every bucket that a cell reaches into.
    fn buckets(&self, fronts: &Fronts, cell: usize, mut visit: impl FnMut(usize)) {
        let [low, high] = fronts.extents[cell].grown(self.px);
        let (low, high) = (low.max(DVec2::ZERO), high.min(fronts.image));
        let at = |px: f64| (px / self.side) as usize;
        if low.x > high.x || low.y > high.y {
            return;
        }
        for row in at(low.y)..=at(high.y).min(self.rows - 1) {
            for column in at(low.x)..=at(high.x).min(self.columns - 1) {
                visit(row * self.columns + column);
            }
        }
    }

    /// Lists every other cell that this one may meet, those that are nearer by their boxes first.
    pub(super) fn near(&mut self, fronts: &Fronts, cell: usize, near: &mut Vec<(f64, u32)>) {
        near.clear();
        let own = fronts.extents[cell];
        let [low, high] = fronts.extents[cell].grown(self.px);
        let mut found = core::mem::take(&mut self.found);
        found[cell] = cell as u32;
        self.buckets(fronts, cell, |bucket| {
            for &other in &self.cells[self.starts[bucket] as usize..self.starts[bucket + 1] as usize] {
                if found[other as usize] == cell as u32 {
                    continue;
                }
                found[other as usize] = cell as u32;
                let [its_low, its_high] = fronts.extents[other as usize].grown(self.px);
                if its_low.cmple(high).all() && low.cmple(its_high).all() {
                    let its = fronts.extents[other as usize];
                    let gap = (its.low - own.high).max(own.low - its.high).max_element();
                    near.push((gap, other));
                }
            }
        });
        self.found = found;
        // An insertion sort is enough for a few cells; see `coarsest_first`.
        for k in 1..near.len() {
            let cell = near[k];
            let mut at = k;
            while at > 0 && (near[at - 1].0 > cell.0 || (near[at - 1].0 == cell.0 && near[at - 1].1 > cell.1)) {
                near[at] = near[at - 1];
                at -= 1;
            }
            near[at] = cell;
        }
    }
}
