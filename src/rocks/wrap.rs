//! Gift wrapping in the plane: finds the point that completes the Delaunay triangle on the left of an edge.
//!
//! It is used to build Voronoi cells around their sites and to triangulate rocks from edge to edge. The sets have about
//! a dozen points, and which of them wins is practically random, so the cost is in mispredicted branches and not in
//! arithmetic. Therefore all points are scanned, four at a time, without a branch, in single precision with error
//! bounds: an answer is either certain or [`Apex::Unsure`], and then the caller decides exactly.
//!
//! Source: the "empty circle" form of gift wrapping, as in Dwyer (1991), *Higher-dimensional Voronoi diagrams in linear
//! expected time*; the interval filter is after Burnikel, Funke & Seel (2001), *Exact geometric computation using cascading*.

use glam::{Vec2, Vec4};

/// Number of points per SIMD vector.
const LANES: usize = 4;

/// A set of points in single precision, read four at a time. Each has a label chosen by the caller.
#[derive(Debug, Default)]
pub(crate) struct WrapSet {
    // Longer than `len`, all three by the same number; the points behind `len` are padding.
    x: Vec<f32>,
    y: Vec<f32>,
    labels: Vec<u32>,
    len: usize,
    /// Buffer for the lower bounds of large sets.
    lowest: Vec<Vec4>,
}

/// The answer to which point completes the triangle on the left of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Apex {
    /// This point, with certainty.
    Point(usize),
    /// No point lies on the left of the edge.
    Missing,
    /// Two points are too close to call, or a point is too close to the edge's line.
    Unsure,
}

impl WrapSet {
    /// Removes all points.
    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    /// Adds a point.
    #[inline]
    pub(crate) fn push(&mut self, point: Vec2, label: u32) {
        self.reserve(1);
        self.x[self.len] = point.x;
        self.y[self.len] = point.y;
        self.labels[self.len] = label;
        self.len += 1;
    }

    /// Adds one point per label, at the place that `point` returns for it.
    #[inline]
    pub(crate) fn extend(&mut self, labels: &[u32], point: impl Fn(u32) -> Vec2) {
        self.reserve(labels.len());
        let new = self.len..self.len + labels.len();
        let slots = self.x[new.clone()].iter_mut().zip(&mut self.y[new.clone()]).zip(&mut self.labels[new]);
        for (((x, y), slot), &label) in slots.zip(labels) {
            [*x, *y] = point(label).to_array();
            *slot = label;
        }
        self.len += labels.len();
    }

    /// Adds the points of the sealed set `all` that are within √`reach2` of `origin` but not at it, as offsets from
    /// `origin`.
    #[inline]
    pub(crate) fn extend_near(&mut self, all: &WrapSet, origin: Vec2, reach2: f32) {
        let [ox, oy, reach2] = [origin.x, origin.y, reach2].map(Vec4::splat);
        // Number of points looked at together: one per bit of a word.
        const WORD: usize = 64;
        for from in (0..all.len).step_by(WORD) {
            let to = (from + WORD).min(all.len.next_multiple_of(LANES));
            let (x, y, labels) = (&all.x[from..to], &all.y[from..to], &all.labels[from..to]);
            let mut near = 0_u64;
            for (k, (x, y)) in x.chunks_exact(LANES).zip(y.chunks_exact(LANES)).enumerate() {
                let (dx, dy) = (Vec4::from_slice(x) - ox, Vec4::from_slice(y) - oy);
                let distance2 = dx * dx + dy * dy;
                let inside = distance2.cmple(reach2) & distance2.cmpgt(Vec4::ZERO);
                near |= u64::from(inside.bitmask()) << (LANES * k);
            }
            self.reserve(near.count_ones() as usize);
            while near != 0 {
                let k = near.trailing_zeros() as usize;
                near &= near - 1;
                self.x[self.len] = x[k] - origin.x;
                self.y[self.len] = y[k] - origin.y;
                self.labels[self.len] = labels[k];
                self.len += 1;
            }
        }
    }

    /// Makes room for `more` points and for the padding behind them.
    #[inline]
    fn reserve(&mut self, more: usize) {
        if self.len + more + LANES > self.x.len() {
            self.grow(more);
        }
    }

    #[cold]
    fn grow(&mut self, more: usize) {
        let room = (2 * (self.len + more + LANES)).next_multiple_of(32);
        self.x.resize(room, 0.0);
        self.y.resize(room, 0.0);
        self.labels.resize(room, 0);
    }

    pub(crate) fn label(&self, k: usize) -> u32 {
        self.labels[k]
    }

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    #[inline]
    pub(crate) fn get(&self, k: usize) -> Vec2 {
        Vec2::new(self.x[k], self.y[k])
    }

    /// Fills the last vector with padding: points so far away that they are never chosen.
    pub(crate) fn seal(&mut self) {
        self.reserve(0);
        for k in self.len..self.len.next_multiple_of(LANES) {
            self.x[k] = NOWHERE;
            self.y[k] = NOWHERE;
        }
    }

    /// Finds the point c on the left of the edge from a to b whose circumcircle through a and b holds no other point on
    /// that side.
    ///
    /// It is the point whose circumcentre comes first along the edge's bisector, at t = (c − a)·(c − b) / ((b − a) × (c
    /// − a)), measured in half edge lengths from the edge's middle. `error` must bound the rounding errors of the
    /// numerator and of the denominator, with an eighth to spare for that of the quotient.
    ///
    /// a and b may be in the set themselves: a point that is computed to lie exactly on their line is taken for one of
    /// them.
    #[inline(always)]
    pub(crate) fn apex(&mut self, a: Vec2, b: Vec2, error: f32) -> Apex {
        // With a length known at compile time the loop is unrolled: it has no branch at its end and keeps everything in
        // registers. Rocks have five to eight rim vertices and as many points, so these lengths are the common ones.
        match self.len.div_ceil(LANES) {
            3 => self.apex_among([Vec4::ZERO; 3], a, b, error),
            4 => self.apex_among([Vec4::ZERO; 4], a, b, error),
            vectors => self.with_room(vectors, |set, lowest| set.apex_among(lowest, a, b, error)),
        }
    }

    /// Like [`WrapSet::apex`], for an edge from the origin to `b`, in a set of whole numbers so small that both
    /// products of t are exact.
    #[inline(always)]
    pub(crate) fn apex_of_whole(&mut self, b: Vec2) -> Apex {
        // In a saturated layer a site has about nine others within reach.
        match self.len.div_ceil(LANES) {
            2 => self.apex_among_whole([Vec4::ZERO; 2], b),
            3 => self.apex_among_whole([Vec4::ZERO; 3], b),
            vectors => self.with_room(vectors, |set, lowest| set.apex_among_whole(lowest, b)),
        }
    }

    fn with_room(&mut self, vectors: usize, apex: impl Fn(&Self, &mut [Vec4]) -> Apex) -> Apex {
        let mut lowest = core::mem::take(&mut self.lowest);
        lowest.resize(vectors, Vec4::ZERO);
        let found = apex(self, &mut lowest);
        self.lowest = lowest;
        found
    }

    /// `lowest` must have one element per vector.
    #[inline(always)]
    fn apex_among(&self, mut lowest: impl AsMut<[Vec4]>, a: Vec2, b: Vec2, error: f32) -> Apex {
        let lowest = lowest.as_mut();
        let [ax, ay, bx, by, margin] = [a.x, a.y, b.x, b.y, 2.0 * error].map(Vec4::splat);
        let (ex, ey) = (bx - ax, by - ay);
        let mut highest = Vec4::INFINITY;
        for ((x, y), low) in self.vectors(lowest.len()).zip(lowest.iter_mut()) {
            let (cax, cay) = (x - ax, y - ay);
            let left = ex * cay - ey * cax;
            let along = cax * (x - bx) + cay * (y - by);
            // A point too close to the line to tell its side might have any t, so its interval is made to cover all of
            // them.
            let inverse = Vec4::ONE / left.max(margin);
            let t = along * inverse;
            let slack = margin * inverse * (Vec4::ONE + t.abs());
            let may_be_left = left.cmpgt(-margin) & left.cmpne(Vec4::ZERO);
            *low = t - slack + Vec4::select(may_be_left, Vec4::ZERO, Vec4::INFINITY);
            highest = highest.min(t + slack + Vec4::select(left.cmpgt(margin), Vec4::ZERO, Vec4::INFINITY));
        }
        only_below(lowest, highest.min_element())
    }

    #[inline(always)]
    fn apex_among_whole(&self, mut lowest: impl AsMut<[Vec4]>, b: Vec2) -> Apex {
        let lowest = lowest.as_mut();
        let [bx, by] = [b.x, b.y].map(Vec4::splat);
        let mut least = Vec4::INFINITY;
        for ((x, y), low) in self.vectors(lowest.len()).zip(lowest.iter_mut()) {
            let left = bx * y - by * x;
            let along = x * (x - bx) + y * (y - by);
            // A point on the left has a cross product of at least one, because all numbers are whole.
            let t = along / left.max(Vec4::ONE);
            *low = t + Vec4::select(left.cmpgt(Vec4::ZERO), Vec4::ZERO, Vec4::INFINITY);
            least = least.min(*low);
        }
        // Only the quotients are rounded, so the margin can be small.
        let least = least.min_element();
        only_below(lowest, least + 4.0 * f32::EPSILON * least.abs())
    }

    #[inline(always)]
    fn vectors(&self, count: usize) -> impl Iterator<Item = (Vec4, Vec4)> {
        let [x, y] = [&self.x, &self.y].map(|list| list[..LANES * count].chunks_exact(LANES).map(Vec4::from_slice));
        x.zip(y)
    }
}

/// The point with the smallest t, if it is certain: `bound` is the most that the smallest t can be, `lowest` holds the
/// least that each point's t can be, and exactly one of those must be below the bound.
#[inline(always)]
fn only_below(lowest: &[Vec4], bound: f32) -> Apex {
    if bound > FAR {
        let nobody = lowest.iter().all(|low| !low.cmplt(Vec4::splat(FAR)).any());
        return if nobody { Apex::Missing } else { Apex::Unsure };
    }
    let bound = Vec4::splat(bound);
    let (mut found, mut rivals) = (0, 0);
    for (k, low) in (0..).step_by(32).zip(lowest.chunks(8)) {
        let bits = low.iter().rev().fold(0, |bits, low| (bits << LANES) | low.cmple(bound).bitmask());
        rivals += bits.count_ones();
        if bits != 0 {
            found = k + bits.trailing_zeros() as usize;
        }
    }
    if rivals == 1 { Apex::Point(found) } else { Apex::Unsure }
}

/// Coordinates of padding points. They are so far away that for edges of up to 2¹⁵ their t is more than [`FAR`], which
/// no real point's t can be, and so near that their square is finite.
const NOWHERE: f32 = 1.0e15;
const FAR: f32 = 1.0e9;
