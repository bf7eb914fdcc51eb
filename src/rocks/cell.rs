//! One Voronoi cell of the image, wrapped around its site from neighbour to neighbour, with exact decisions.
//!
//! Sites are pixels, so everything relative to a site is a small integer: a neighbour's offset g, the
//! squared distance |g|², and a cell vertex, which is the circumcentre of the site and two neighbours,
//! a quotient of integers. Floating point decides where its error allows, and integers of
//! 64 bits, enough for images up to 8192 px, where it does not: no tolerance decides who is a neighbour.
//!
//! The image's border needs no code of its own: the bisector between a site and its mirror image
//! across a side *is* that side, and the mirror image of a pixel is again at integer coordinates.

use glam::DVec2;

/// The four sides of the image as neighbours of a cell: left, right, bottom, top.
pub(crate) const SIDES: u32 = u32::MAX - 3;

/// Lattice steps per px. Cell vertices are rounded to this lattice, which is fine enough for vertices to be
/// within 4.8e-7 px of their exact place and coarse enough for neighbours to share them bit for bit.
pub(crate) const LATTICE: f64 = (1_u32 << 20) as f64;

/// The cell under construction; one is re-used for all sites.
#[derive(Debug, Default)]
pub(crate) struct CellWrapper {
    /// Offsets of the sites that may be neighbours: whole numbers.
    candidates: Vec<Candidate>,
    /// Cell vertices in lattice steps relative to the site, each with the neighbour across the edge that starts there.
    corners: Vec<([f64; 2], u32)>,
    /// Squared distance of the farthest one.
    farthest2: f64,
}

#[derive(Debug, Clone, Copy)]
struct Candidate {
    g: DVec2,
    distance2: f64,
    neighbor: u32,
}

/// Circumcentre of the origin and two points, the second counter-clockwise of the first: numerators and denominator.
///
/// Exact: offsets are below 2¹⁴, so the numerators are below 2⁴⁴ and the denominator is below 2³⁰, and even.
#[inline]
fn circumcentre(a: DVec2, b: DVec2) -> (DVec2, f64) {
    let (aa, bb) = (a.length_squared(), b.length_squared());
    (DVec2::new(aa * b.y - bb * a.y, bb * a.x - aa * b.x), 2.0 * a.perp_dot(b))
}

/// An integer that sorts like the number.
#[inline]
fn sortable(number: f64) -> i64 {
    let bits = number.to_bits() as i64;
    bits ^ ((bits >> 63) & i64::MAX)
}

/// The number again; of `i64::MAX`, not a number.
#[inline]
fn from_sortable(key: i64) -> f64 {
    f64::from_bits((key ^ ((key >> 63) & i64::MAX)) as u64)
}

impl CellWrapper {
    /// Starts a cell that only the image bounds, seen from pixel (x, y). Sides farther than half of √`reach2` are left out.
    pub(crate) fn start(&mut self, width: u32, height: u32, x: u32, y: u32, reach2: f64) {
        let [w, h, x, y] = [width, height, x, y].map(f64::from);
        self.candidates.clear();
        // The mirror image across a side is twice as far as the side.
        let mirrors = [
            DVec2::new(-2.0 * x - 1.0, 0.0),
            DVec2::new(2.0 * (w - x) - 1.0, 0.0),
            DVec2::new(0.0, -2.0 * y - 1.0),
            DVec2::new(0.0, 2.0 * (h - y) - 1.0),
        ];
        for (side, g) in (0..).zip(mirrors) {
            self.consider(g, SIDES + side, reach2);
        }
    }

    /// Adds a site at offset g unless it is farther than √`reach2`.
    #[inline]
    pub(crate) fn consider(&mut self, g: DVec2, neighbor: u32, reach2: f64) {
        let distance2 = g.length_squared();
        if distance2 <= reach2 {
            self.candidates.push(Candidate { g, distance2, neighbor });
        }
    }

    /// Walks around the cell counter-clockwise, beginning at the nearest neighbour, whose edge always has a length.
    /// False where the candidates leave the cell open.
    ///
    /// The vertex at the end of the edge across from g is the circumcentre of the site, g and the next neighbour c: the
    /// candidate to the left of g whose circumcentre comes first along the bisector, at
    /// t = c·(c − g) / (g × c), in half lengths of g from the middle.
    pub(crate) fn wrap(&mut self) -> bool {
        self.corners.clear();
        self.farthest2 = 0.0;
        let nearest = |best: usize, k: usize| {
            if self.candidates[k].distance2 < self.candidates[best].distance2 { k } else { best }
        };
        let start = (0..self.candidates.len()).fold(0, nearest);
        let mut base = start;
        // A cell has at most as many edges as there are candidates.
        for _ in 0..self.candidates.len() {
            let g = self.candidates[base].g;
            let (mut best, mut second, mut next) = (i64::MAX, i64::MAX, start);
            for (k, candidate) in self.candidates.iter().enumerate() {
                let left = g.perp_dot(candidate.g);
                let t = (candidate.distance2 - g.dot(candidate.g)) / left;
                // Which side a candidate lies on is a coin toss: as integers, the choice takes no branch to mispredict.
                let to_the_right = i64::from(left > 0.0) - 1;
                let key = (sortable(t) & !to_the_right) | (i64::MAX & to_the_right);
                second = second.min(best.max(key));
                next = if key < best { k } else { next };
                best = best.min(key);
            }
            if best == i64::MAX {
                return false;
            }
            // t is off by less than 2 ulp; cocircular sites come out equal or nearly so.
            let [best, second] = [best, second].map(from_sortable);
            if second - best <= 1e-12 * (1.0 + best.abs()) {
                next = self.next_exactly(base, start);
            }
            let Candidate { g: c, neighbor, .. } = self.candidates[next];
            let (n, d) = circumcentre(g, c);
            let vertex = n * (1.0 / d);
            let place = match vertex.to_array().map(to_lattice) {
                [Some(x), Some(y)] => [x, y],
                _ => n.to_array().map(|n| to_lattice_exactly(n as i64, d as i64)),
            };
            self.corners.push((place, neighbor));
            self.farthest2 = self.farthest2.max(vertex.length_squared());
            if next == start {
                return true;
            }
            base = next;
        }
        false
    }

    /// Whether no site farther than √`reach2` can have a part in the cell: a neighbour is at most twice as far as a vertex.
    pub(crate) fn is_within(&self, reach2: f64) -> bool {
        4.0 * self.farthest2 * (1.0 + 1e-9) <= reach2
    }

    /// The next neighbour after `base` in integers below 2⁶². Of several on one circle the walk takes the last, so that
    /// no edge has length zero, but never goes past its start.
    #[cold]
    fn next_exactly(&self, base: usize, start: usize) -> usize {
        let whole = |v: DVec2| [v.x as i64, v.y as i64];
        let [gx, gy] = whole(self.candidates[base].g);
        let mut best: Option<(i64, i64, [i64; 2], usize)> = None;
        for (k, candidate) in self.candidates.iter().enumerate() {
            let [cx, cy] = whole(candidate.g);
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
        best.map_or(start, |(.., k)| k)
    }

    /// Emits the cell counter-clockwise from the lexicographically least vertex: its vertices in lattice steps relative
    /// to the site, each with the neighbour across the edge that starts there.
    ///
    /// Vertices nearer than 1e-6 px are merged (decision A8): that is one lattice step.
    pub(crate) fn emit(&self, mut vertex: impl FnMut([f64; 2], u32)) {
        let corners = &self.corners[..];
        let least = (0..corners.len()).fold(0, |least, k| if corners[k].0 < corners[least].0 { k } else { least });
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

/// A coordinate in lattice steps, rounded to the nearest, halves up; `None` where its own rounding could tip that.
#[inline]
fn to_lattice(coordinate: f64) -> Option<f64> {
    let shifted = coordinate * LATTICE + 0.5;
    let rounded = shifted.floor();
    // The coordinate is off by at most two ulp: 2⁻¹⁸ of a step, for it is below 2¹³ px from its site.
    let fraction = shifted - rounded;
    (1.0e-5..=1.0 - 1.0e-5).contains(&fraction).then_some(rounded)
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
