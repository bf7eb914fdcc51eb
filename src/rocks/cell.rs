//! Builds one Voronoi cell of the image by walking around its site from neighbour to neighbour. All decisions are
//! exact.
//!
//! Sites are pixels, so everything relative to a site is a small integer: the offset g of a neighbour and the squared
//! distance |g|². A cell vertex is the circumcentre of the site and two neighbours, so it is a quotient of integers.
//! Floating point decides where its error is small enough, and 64-bit integers, which suffice for images up to 8192 px,
//! decide everywhere else. No tolerance is involved in choosing a neighbour.
//!
//! The image's border needs no code of its own: the bisector between a site and its mirror image across a side *is*
//! that side, and the mirror image of a pixel also has integer coordinates.

use glam::{DVec2, Vec2};

use super::sites::Sites;
use super::wrap::{Apex, WrapSet};

/// The first of four numbers that stand for the image's sides as neighbours of a cell: left, right, bottom, top.
pub(crate) const SIDES: u32 = u32::MAX - 3;

/// Lattice steps per px. Cell vertices are rounded to this lattice. It is fine enough for vertices to be within 4.8e-7
/// px of their exact place, and coarse enough for neighbouring cells to compute the same bits for a shared vertex.
pub(crate) const LATTICE: f64 = (1_u32 << 20) as f64;

/// The cell being built. Re-used from site to site to avoid allocations.
#[derive(Debug, Default)]
pub(crate) struct CellWrapper {
    /// Offsets of the sites that may be neighbours. They are whole numbers below 2¹⁴ + 1, hence exact in single
    /// precision.
    candidates: WrapSet,
    /// The cell's vertices in lattice steps relative to the site, each with the neighbour across the edge that starts
    /// there.
    corners: Vec<([f64; 2], u32)>,
}

/// Circumcentre of the origin, `a` and `b`, where `b` is counter-clockwise of `a`. Returns the two numerators and the
/// common denominator.
///
/// The result is exact: offsets are below 2¹⁴, so the numerators are below 2⁴⁴, and the denominator is even and below
/// 2³⁰.
#[inline]
fn circumcentre(a: DVec2, b: DVec2) -> (DVec2, f64) {
    let (aa, bb) = (a.length_squared(), b.length_squared());
    (DVec2::new(aa * b.y - bb * a.y, bb * a.x - aa * b.x), 2.0 * a.perp_dot(b))
}

impl CellWrapper {
    /// Builds the cell of a site. Candidates for its neighbours are the sites in `around` and the mirror images across
    /// the image's sides, as far as they are nearer than `reach` px. Returns false if sites beyond the reach might also
    /// bound the cell.
    pub(crate) fn wrap(&mut self, sites: &Sites, site: usize, around: &WrapSet, reach: f64) -> bool {
        let reach2 = (reach * reach) as f32;
        self.gather(sites, site, around, reach2);
        // The sums are of two products of at most 2·reach² each. Whole numbers below 2²⁴ are exact in single precision.
        let is_exact = reach2 <= (1 << 22) as f32;
        self.corners.clear();
        // The bits of positive floats sort like the floats, and comparing integers needs no branch.
        let mut farthest2 = 0_u64;
        // The edge towards the nearest site always has a length, so the walk can start there.
        let start = self.nearest();
        let mut base = start;
        // A cell has at most as many edges as there are candidates.
        for _ in 0..self.candidates.len() {
            // The vertex at the end of the edge across from g is the circumcentre of the site, g and the next
            // neighbour.
            let g = self.candidates.get(base);
            let apex = if is_exact { self.candidates.apex_of_whole(g) } else { Apex::Unsure };
            let next = match apex {
                Apex::Point(next) => next,
                // For cocircular sites, several candidates are equal or nearly so.
                Apex::Unsure => match self.next_exactly(base, start) {
                    Some(next) => next,
                    None => return false,
                },
                Apex::Missing => return false,
            };
            let (n, d) = circumcentre(g.as_dvec2(), self.candidates.get(next).as_dvec2());
            let vertex = n * (1.0 / d);
            self.corners.push((to_lattice(vertex, n, d), self.candidates.label(next)));
            farthest2 = farthest2.max(vertex.length_squared().to_bits());
            if next == start {
                // A neighbour is at most twice as far away as the farthest vertex.
                return 4.0 * f64::from_bits(farthest2) * (1.0 + 1e-6) <= f64::from(reach2);
            }
            base = next;
        }
        false
    }

    fn gather(&mut self, sites: &Sites, site: usize, around: &WrapSet, reach2: f32) {
        let [x, y] = sites.pixels[site].map(f32::from);
        let [w, h] = [sites.width, sites.height].map(|side| side as f32);
        // The mirror image across a side is twice as far away as the side.
        let mirrors = [
            Vec2::new(-2.0 * x - 1.0, 0.0),
            Vec2::new(2.0 * (w - x) - 1.0, 0.0),
            Vec2::new(0.0, -2.0 * y - 1.0),
            Vec2::new(0.0, 2.0 * (h - y) - 1.0),
        ];
        self.candidates.clear();
        for (side, g) in (0..).zip(mirrors) {
            if g.length_squared() <= reach2 {
                self.candidates.push(g, SIDES + side);
            }
        }
        self.candidates.extend_near(around, Vec2::new(x, y), reach2);
        self.candidates.seal();
    }

    /// The candidate nearest to the site, found without a branch: the bits of positive floats sort like the floats.
    /// Squares of whole distances are below 2³¹, so the lowest 22 bits are free to hold the index.
    fn nearest(&self) -> usize {
        const INDEX: u64 = (1 << 22) - 1;
        let distance2 = |k| self.candidates.get(k).as_dvec2().length_squared();
        let keys = (0..self.candidates.len()).map(|k| distance2(k).to_bits() | k as u64);
        keys.min().map_or(0, |key| (key & INDEX) as usize)
    }

    /// The next neighbour after `base`, decided in integers below 2⁶². Of several on one circle it returns the last, so
    /// that no edge has length zero, but it never goes past `start`. Returns `None` if no candidate lies on the left.
    #[cold]
    fn next_exactly(&self, base: usize, start: usize) -> Option<usize> {
        let whole = |k| self.candidates.get(k).to_array().map(|c| c as i64);
        let [gx, gy] = whole(base);
        let mut best: Option<(i64, i64, [i64; 2], usize)> = None;
        for k in 0..self.candidates.len() {
            let [cx, cy] = whole(k);
            let d = gx * cy - gy * cx;
            if d <= 0 {
                continue;
            }
            let n = cx * cx + cy * cy - (gx * cx + gy * cy);
            let is_better = best.is_none_or(|(best_n, best_d, [bx, by], b)| {
                (n * best_d).cmp(&(best_n * d)).then_with(|| {
                    // If they are equal, `start` wins over all others, and otherwise the more counter-clockwise one.
                    let is_later = k == start || (b != start && bx * cy - by * cx > 0);
                    if is_later { core::cmp::Ordering::Less } else { core::cmp::Ordering::Greater }
                }) == core::cmp::Ordering::Less
            });
            if is_better {
                best = Some((n, d, [cx, cy], k));
            }
        }
        best.map(|(.., k)| k)
    }

    /// Index of the lexicographically smallest corner. It is found by x without a branch, and by y only if several
    /// corners share the smallest x.
    fn least_corner(&self) -> usize {
        let (mut least, mut least_x, mut ties) = (0, i64::MAX, 0);
        for (k, &([x, _], _)) in self.corners.iter().enumerate() {
            let x = x as i64;
            ties = if x < least_x { 0 } else { ties + u32::from(x == least_x) };
            least = if x < least_x { k } else { least };
            least_x = least_x.min(x);
        }
        if ties > 0 {
            let place = |k: usize| self.corners[k].0;
            least = (0..self.corners.len()).fold(0, |least, k| if place(k) < place(least) { k } else { least });
        }
        least
    }

    /// Calls `vertex` for each vertex of the cell, counter-clockwise from the lexicographically smallest one: with its
    /// place in lattice steps relative to the site, and the neighbour across the edge that starts there.
    ///
    /// Vertices nearer than 1e-6 px, which is one lattice step, are merged (decision A8).
    pub(crate) fn emit(&self, mut vertex: impl FnMut([f64; 2], u32)) {
        let corners = &self.corners[..];
        let least = self.least_corner();
        let at = |k: usize| corners[if least + k < corners.len() { least + k } else { least + k - corners.len() }];
        // Of several corners at one place, only the last is kept, because the edge that leaves the place starts there.
        // Corners at the end of the list that lie at the first corner's place are dropped for the same reason.
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() <= 1.0;
        let mut count = corners.len();
        while count > 1 && near(at(count - 1).0, at(0).0) {
            count -= 1;
        }
        for k in 0..count {
            let (place, neighbor) = at(k);
            if k + 1 == count || !near(place, at(k + 1).0) {
                vertex(place, neighbor);
            }
        }
    }
}

/// Converts the cell vertex n / d to lattice steps, rounded to the nearest.
#[inline]
fn to_lattice(vertex: DVec2, n: DVec2, d: f64) -> [f64; 2] {
    // Between 2⁵² and 2⁵³ all floats are whole numbers, so adding and subtracting this rounds.
    const SHIFT: f64 = 1.5 * (1_u64 << 52) as f64;
    let exact = vertex * LATTICE;
    let rounded = (exact + SHIFT) - SHIFT;
    // A coordinate is off by at most two ulp, which is 2⁻¹⁸ of a step, because it is less than 2¹³ px from its site. If
    // the error could change the rounding, the exact version decides.
    let doubt = (exact - rounded).abs() - (0.5 - 1.0e-5);
    if (doubt.x > 0.0) | (doubt.y > 0.0) {
        return n.to_array().map(|n| to_lattice_exactly(n as i64, d as i64));
    }
    rounded.to_array()
}

/// n / d in lattice steps, rounded to the nearest with halves rounded up, in integers. The result therefore does not
/// depend on which of the vertex's sites it was computed from.
#[cold]
fn to_lattice_exactly(n: i64, d: i64) -> f64 {
    let (whole, rest) = (n.div_euclid(d), n.rem_euclid(d));
    // d is even, so d / 2 is exact. rest is below 2³⁰, so the shifted value fits in 64 bits.
    let part = ((rest << 20) + d / 2).div_euclid(d);
    (whole * (1 << 20) + part) as f64
}
