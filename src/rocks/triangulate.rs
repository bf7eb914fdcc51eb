//! Delaunay triangulation of one rock: a dozen points, so small arrays and Lawson flips instead of a
//! general library. `tests/triangulation.rs` holds it equal to spade.

use glam::DVec2;
use robust::Coord;

/// No triangle beyond: a rim edge.
const RIM: u16 = u16::MAX;

/// Delaunay triangulation of a convex rim and points strictly inside it.
///
/// Vertices 0 … n − 1 are the rim, counter-clockwise; the points follow in the order of insertion.
/// Rim edges are never flipped, so with n points inside there are exactly 3n − 2 triangles, also where
/// rounding has bent the rim inward by less than a lattice step.
///
/// Source: Lawson (1977), *Software for C1 surface interpolation*: split the triangle that holds the new
/// point, then flip edges until every circumcircle is empty. Signs are exact: a floating-point
/// filter whose error bound is fixed per rock, and Shewchuk's adaptive predicates ([`robust`]) within it.
#[derive(Debug, Default)]
pub(crate) struct Triangulator {
    points: Vec<DVec2>,
    /// Counter-clockwise.
    triangles: Vec<[u16; 3]>,
    /// `neighbors[t][k]` lies across the edge from vertex k to vertex k + 1 of triangle t.
    neighbors: Vec<[u16; 3]>,
    /// (triangle, edge) whose far vertex may lie in the triangle's circumcircle.
    suspects: Vec<(u16, u8)>,
    /// A determinant larger than this has the right sign.
    orient_error: f64,
    incircle_error: f64,
    /// Where the walk to the next point starts.
    last: u16,
}

impl Triangulator {
    /// Starts with the star of `first` over the rim. False where `first` is not strictly inside.
    pub(crate) fn start(&mut self, rim: &[DVec2], first: DVec2) -> bool {
        let (low, high) = rim.iter().fold((DVec2::MAX, DVec2::MIN), |(lo, hi), &v| (lo.min(v), hi.max(v)));
        let extent = (high - low).max_element();
        let squared = extent * extent;
        // Shewchuk's bounds (3 + 16ε)ε Σ|products| and (10 + 96ε)ε Σ|products| with every difference at most `extent`.
        self.orient_error = 1.0e-15 * squared;
        self.incircle_error = 2.0e-14 * squared * squared;
        self.last = 0;
        self.points.clear();
        self.points.extend_from_slice(rim);
        self.points.push(first);
        let count = rim.len() as u16;
        self.triangles.clear();
        self.neighbors.clear();
        self.suspects.clear();
        for k in 0..count {
            let next = if k + 1 == count { 0 } else { k + 1 };
            let previous = if k == 0 { count - 1 } else { k - 1 };
            if self.orient(k, next, count) <= 0.0 {
                return false;
            }
            self.triangles.push([k, next, count]);
            self.neighbors.push([RIM, next, previous]);
            self.suspects.push((k, 1));
        }
        self.flip_suspects(true);
        true
    }

    /// Inserts a point. False, and nothing changed, where it is not strictly inside the rim or is there already.
    pub(crate) fn insert(&mut self, point: DVec2) -> bool {
        let p = self.points.len() as u16;
        self.points.push(point);
        let Some(t) = self.locate(p) else {
            self.points.pop();
            return false;
        };
        let [a, b, c] = self.triangles[usize::from(t)];
        let [ab, bc, ca] = self.neighbors[usize::from(t)];
        let u = self.triangles.len() as u16;
        let v = u + 1;
        // (a, b, c) becomes (a, b, p), (b, c, p), (c, a, p).
        self.triangles[usize::from(t)] = [a, b, p];
        self.neighbors[usize::from(t)] = [ab, u, v];
        self.triangles.push([b, c, p]);
        self.neighbors.push([bc, v, t]);
        self.triangles.push([c, a, p]);
        self.neighbors.push([ca, t, u]);
        self.relink(bc, t, u);
        self.relink(ca, t, v);
        self.suspects.extend([(t, 0), (u, 0), (v, 0)]);
        self.flip_suspects(false);
        self.last = t;
        true
    }

    /// The triangles so far, counter-clockwise.
    pub(crate) fn triangles(&self) -> &[[u16; 3]] {
        &self.triangles
    }

    /// The points inserted so far, in order.
    pub(crate) fn inner(&self, rim: usize) -> &[DVec2] {
        &self.points[rim..]
    }

    /// Walks to a triangle that holds point `p`, possibly on an inner edge.
    fn locate(&self, p: u16) -> Option<u16> {
        let mut t = self.last;
        'walk: loop {
            let triangle = self.triangles[usize::from(t)];
            for k in 0..3 {
                let side = self.orient(triangle[k], triangle[(k + 1) % 3], p);
                let beyond = self.neighbors[usize::from(t)][k];
                if beyond == RIM && side <= 0.0 {
                    return None;
                }
                if side < 0.0 {
                    // In a Delaunay triangulation such a walk cannot return to a triangle it has left.
                    t = beyond;
                    continue 'walk;
                }
            }
            let point = self.points[usize::from(p)];
            let is_new = triangle.iter().all(|&v| self.points[usize::from(v)] != point);
            return is_new.then_some(t);
        }
    }

    /// Flips edges until no suspect is left. `all`: every outer edge of a flipped pair becomes a suspect, as the star
    /// of `start` asks for; after an insertion only those that face the new point can be.
    fn flip_suspects(&mut self, all: bool) {
        while let Some((t, k)) = self.suspects.pop() {
            let (t, k) = (usize::from(t), usize::from(k));
            let u = self.neighbors[t][k];
            if u == RIM {
                continue;
            }
            // Triangle t = (a, b, p) and, across its edge k from a to b, u = (b, a, q).
            let (a, b, p) = (self.triangles[t][k], self.triangles[t][(k + 1) % 3], self.triangles[t][(k + 2) % 3]);
            let across = &self.neighbors[usize::from(u)];
            let j = if across[0] == t as u16 {
                0
            } else if across[1] == t as u16 {
                1
            } else {
                2
            };
            let q = self.triangles[usize::from(u)][(j + 2) % 3];
            if self.incircle(a, b, p, q) <= 0.0 {
                continue;
            }
            let (bp, pa) = (self.neighbors[t][(k + 1) % 3], self.neighbors[t][(k + 2) % 3]);
            let (aq, qb) = (across[(j + 1) % 3], across[(j + 2) % 3]);
            // (a, b, p) + (b, a, q) become (a, q, p) + (q, b, p).
            self.triangles[t] = [a, q, p];
            self.neighbors[t] = [aq, u, pa];
            self.triangles[usize::from(u)] = [q, b, p];
            self.neighbors[usize::from(u)] = [qb, bp, t as u16];
            self.relink(aq, u, t as u16);
            self.relink(bp, t as u16, u);
            self.suspects.extend([(t as u16, 0), (u, 0)]);
            if all {
                self.suspects.extend([(t as u16, 2), (u, 1)]);
            }
        }
    }

    /// Triangle `t` had `old` for a neighbour and now has `new`.
    #[inline]
    fn relink(&mut self, t: u16, old: u16, new: u16) {
        if t != RIM {
            for neighbor in &mut self.neighbors[usize::from(t)] {
                if *neighbor == old {
                    *neighbor = new;
                }
            }
        }
    }

    /// Positive where c lies left of the line from a to b.
    #[inline]
    fn orient(&self, a: u16, b: u16, c: u16) -> f64 {
        let [a, b, c] = [a, b, c].map(|v| self.points[usize::from(v)]);
        let det = (a - c).perp_dot(b - c);
        if det.abs() > self.orient_error { det } else { robust::orient2d(coord(a), coord(b), coord(c)) }
    }

    /// Positive where d lies in the circle through a, b, c (counter-clockwise).
    #[inline]
    fn incircle(&self, a: u16, b: u16, c: u16, d: u16) -> f64 {
        let [a, b, c, d] = [a, b, c, d].map(|v| self.points[usize::from(v)]);
        let (u, v, w) = (a - d, b - d, c - d);
        let det = u.length_squared() * v.perp_dot(w)
            + v.length_squared() * w.perp_dot(u)
            + w.length_squared() * u.perp_dot(v);
        if det.abs() > self.incircle_error { det } else { robust::incircle(coord(a), coord(b), coord(c), coord(d)) }
    }
}

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Delaunay triangles of a convex rim (counter-clockwise) and points inside it; `None` if a point is not strictly inside.
pub fn triangulate(rim: &[DVec2], inner: &[DVec2]) -> Option<Vec<[u16; 3]>> {
    let mut triangulator = Triangulator::default();
    let (first, others) = inner.split_first()?;
    let complete = triangulator.start(rim, *first) && others.iter().all(|&p| triangulator.insert(p));
    complete.then(|| triangulator.triangles.clone())
}
