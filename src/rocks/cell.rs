//! One Voronoi cell of the image, wrapped around its site from neighbour to neighbour, with exact decisions.
//!
//! Sites are pixels, so everything relative to a site is a small integer: a neighbour's offset g, the
//! squared distance |g|², and a cell vertex, which is the circumcentre of the site and two neighbours,
//! a quotient of integers. Floating point decides where its error allows, and integers of
//! 64 bits, enough for images up to 8192 px, where it does not: no tolerance decides who is a neighbour.
//!
//! The image's border needs no code of its own: the bisector between a site and its mirror image
//! across a side *is* that side, and the mirror image of a pixel is again at integer coordinates.

use glam::{DVec2, Vec2};

use super::sites::Sites;
use super::wrap::{Apex, WrapSet};

/// The four sides of the image as neighbours of a cell: left, right, bottom, top.
pub(crate) const SIDES: u32 = u32::MAX - 3;

/// Lattice steps per px. Cell vertices are rounded to this lattice, which is fine enough for vertices to be
/// within 4.8e-7 px of their exact place and coarse enough for neighbours to share them bit for bit.
pub(crate) const LATTICE: f64 = (1_u32 << 20) as f64;

/// The cell under construction; re-used from site to site.
#[derive(Debug, Default)]
pub(crate) struct CellWrapper {
    /// Offsets of the sites that may be neighbours: whole numbers below 2¹⁴ + 1, exact in single precision.
    candidates: WrapSet,
    /// Cell vertices in lattice steps relative to the site, each with the neighbour across the edge that starts there.
    corners: Vec<([f64; 2], u32)>,
}

/// Circumcentre of the origin and two points, the second counter-clockwise of the first: numerators and denominator.
///
/// Exact: offsets are below 2¹⁴, so the numerators are below 2⁴⁴ and the denominator is below 2³⁰, and even.
#[inline]
fn circumcentre(a: DVec2, b: DVec2) -> (DVec2, f64) {
    let (aa, bb) = (a.length_squared(), b.length_squared());
    (DVec2::new(aa * b.y - bb * a.y, bb * a.x - aa * b.x), 2.0 * a.perp_dot(b))
}

impl CellWrapper {
    /// Wraps the cell of a site with those of the sites around, and of the image's sides as mirrored sites, that are nearer
    /// than `reach`. False where others might have a part in the cell.
    pub(crate) fn wrap(&mut self, sites: &Sites, site: usize, around: &WrapSet, reach: f64) -> bool {
        let reach2 = (reach * reach) as f32;
        self.gather(sites, site, around, reach2);
        // Sums of two products of at most 2·reach²: in single precision, whole numbers below 2²⁴ are exact.
        let is_exact = reach2 <= (1 << 22) as f32;
        self.corners.clear();
        // Positive numbers sort like their bits, and those without a branch.
        let mut farthest2 = 0_u64;
        // The nearest neighbour's edge always has a length.
        let start = self.nearest();
        let mut base = start;
        // A cell has at most as many edges as there are candidates.
        for _ in 0..self.candidates.len() {
            // The vertex at the end of the edge across from g is the circumcentre of the site, g and the next neighbour.
            let g = self.candidates.get(base);
            let apex = if is_exact { self.candidates.apex_of_whole(g) } else { Apex::Unsure };
            let next = match apex {
                Apex::Point(next) => next,
                // Cocircular sites come out equal or nearly so.
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
                // A neighbour is at most twice as far as a vertex.
                return 4.0 * f64::from_bits(farthest2) * (1.0 + 1e-6) <= f64::from(reach2);
            }
            base = next;
        }
        false
    }

    fn gather(&mut self, sites: &Sites, site: usize, around: &WrapSet, reach2: f32) {
        let [x, y] = sites.pixels[site].map(f32::from);
        let [w, h] = [sites.width, sites.height].map(|side| side as f32);
        // The mirror image across a side is twice as far as the side.
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

    /// The candidate nearest to the site, without a branch: positive numbers sort like their bits, and squares of whole
    /// distances, being below 2³¹, leave the lowest 22 of them to the index.
    fn nearest(&self) -> usize {
        const INDEX: u64 = (1 << 22) - 1;
        let distance2 = |k| self.candidates.get(k).as_dvec2().length_squared();
        let keys = (0..self.candidates.len()).map(|k| distance2(k).to_bits() | k as u64);
        keys.min().map_or(0, |key| (key & INDEX) as usize)
    }

    /// The next neighbour after `base` in integers below 2⁶². Of several on one circle the walk takes the last, so that
    /// no edge has length zero, but never goes past its start.
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
                    // Equal: the start before all others, then the more counter-clockwise one.
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

    /// The lexicographically least corner: by x, without a branch, and by y where several have that x.
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

    /// Emits the cell counter-clockwise from the lexicographically least vertex: its vertices in lattice steps relative
    /// to the site, each with the neighbour across the edge that starts there.
    ///
    /// Vertices nearer than 1e-6 px are merged (decision A8): that is one lattice step.
    pub(crate) fn emit(&self, mut vertex: impl FnMut([f64; 2], u32)) {
        let corners = &self.corners[..];
        let least = self.least_corner();
        let at = |k: usize| corners[if least + k < corners.len() { least + k } else { least + k - corners.len() }];
        // Where several corners share a place, the last of them has the edge that leaves it; of those that lead up to the
        // first, none.
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

/// A cell vertex, which is n / d, in lattice steps, rounded to the nearest.
#[inline]
fn to_lattice(vertex: DVec2, n: DVec2, d: f64) -> [f64; 2] {
    // Between 2⁵² and 2⁵³ there are only whole numbers.
    const SHIFT: f64 = 1.5 * (1_u64 << 52) as f64;
    let exact = vertex * LATTICE;
    let rounded = (exact + SHIFT) - SHIFT;
    // A coordinate is off by at most two ulp: 2⁻¹⁸ of a step, for it is below 2¹³ px from its site. Can that tip it?
    let doubt = (exact - rounded).abs() - (0.5 - 1.0e-5);
    if (doubt.x > 0.0) | (doubt.y > 0.0) {
        return n.to_array().map(|n| to_lattice_exactly(n as i64, d as i64));
    }
    rounded.to_array()
}

/// n / d in lattice steps, rounded to the nearest (halves up), so that it does not depend on which of a vertex's
/// sites it was computed from.
#[cold]
fn to_lattice_exactly(n: i64, d: i64) -> f64 {
    let (whole, rest) = (n.div_euclid(d), n.rem_euclid(d));
    // d is even, so d / 2 is exact; rest < 2³⁰, so the shift fits.
    let part = ((rest << 20) + d / 2).div_euclid(d);
    (whole * (1 << 20) + part) as f64
}
