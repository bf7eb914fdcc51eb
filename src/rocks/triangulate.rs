//! Delaunay triangulation of one rock. A rock has about a dozen points, so small arrays serve better than a general
//! library.
//!
//! About five rocks in a thousand have points so close to one circle that wrapping in single precision cannot decide;
//! they are triangulated again with exact signs. `tests/triangulation.rs` compares both methods with the crate `spade`.

use glam::DVec2;
use robust::Coord;

use super::wrap::{Apex, WrapSet};

/// Stands for the neighbour across a rim edge, where there is no triangle.
const RIM: u16 = u16::MAX;

/// Triangulates rocks, one after the other, re-using its buffers.
#[derive(Debug, Default)]
pub(crate) struct Triangulator {
    wrapper: Wrapper,
    lawson: Lawson,
}

impl Triangulator {
    /// Triangulates a convex rim (counter-clockwise) and as many points inside it, which `draw` returns. Appends the
    /// points to `top` and the Delaunay triangles to `triangles`, as indices into rim and points. A point that rounding
    /// puts on the rim or on another point is drawn again.
    pub(crate) fn add_rock(
        &mut self,
        rim: &[DVec2],
        top: &mut Vec<DVec2>,
        triangles: &mut Vec<[u16; 3]>,
        mut draw: impl FnMut() -> DVec2,
    ) {
        let (top_start, triangles_start) = (top.len(), triangles.len());
        for _ in rim {
            top.push(draw());
        }
        if self.wrapper.wrap(rim, &top[top_start..], triangles) {
            return;
        }
        triangles.truncate(triangles_start);
        let mut drawn = top.split_off(top_start).into_iter();
        let mut next = || drawn.next().unwrap_or_else(&mut draw);
        while !self.lawson.start(rim, next()) {}
        for _ in 1..rim.len() {
            while !self.lawson.insert(next()) {}
        }
        top.extend_from_slice(&self.lawson.points[rim.len()..]);
        triangles.extend_from_slice(&self.lawson.triangles);
    }
}

/// Delaunay triangulation by gift wrapping, from the rim inward, edge by edge. It is fast, and nearly always certain.
#[derive(Debug)]
struct Wrapper {
    points: WrapSet,
    /// Directed edges that need a triangle on their left, unless they have got one in the meantime.
    open: [[u8; 2]; 3 * MOST_POINTS],
    /// Bit q of word p is set if the edge from p to q has its triangle.
    done: [u32; MOST_POINTS],
}

/// Largest number of points of a rock that is wrapped: the edges from each point are the bits of one word.
const MOST_POINTS: usize = 32;

impl Default for Wrapper {
    fn default() -> Self {
        Wrapper { points: WrapSet::default(), open: [[0; 2]; 3 * MOST_POINTS], done: [0; MOST_POINTS] }
    }
}

impl Wrapper {
    /// Appends the triangles and returns true. Returns false if two points are too close to call; anything appended is
    /// then to be discarded.
    fn wrap(&mut self, rim: &[DVec2], inner: &[DVec2], triangles: &mut Vec<[u16; 3]>) -> bool {
        let (rim_count, count) = (rim.len(), rim.len() + inner.len());
        if count > MOST_POINTS {
            return false;
        }
        // Coordinates are taken relative to a point of the rock, so that single precision keeps the most digits.
        let origin = rim[0];
        // The largest coordinate, as bits: the bits of positive floats sort like the floats, and need no branch.
        let mut extent = 0_u32;
        self.points.clear();
        for (label, &point) in (0..).zip(rim.iter().chain(inner)) {
            let point = (point - origin).as_vec2();
            extent = extent.max(point.x.abs().to_bits()).max(point.y.abs().to_bits());
            self.points.push(point, label);
            self.done[label as usize] = 0;
        }
        self.points.seal();
        // Bound of the error: ε/2 of the extent for a coordinate, hence 2ε for a difference, 10ε of the extent's square
        // for a product of two differences, and 24ε for two products and their sum.
        let extent = f32::from_bits(extent);
        let error = 27.0 * f32::EPSILON * extent * extent;

        let Wrapper { points, done, open } = self;
        let mut opened = 0;
        for k in 0..rim_count {
            let next = if k + 1 == rim_count { 0 } else { k + 1 };
            // Nothing has to be done outside the rim.
            done[next] |= 1 << k;
            open[opened] = [k as u8, next as u8];
            opened += 1;
        }
        let wanted = triangles.len() + rim_count + 2 * inner.len() - 2;
        let mut at = 0;
        while at < opened {
            let [a, b] = open[at];
            at += 1;
            let ends = [a, b].map(usize::from);
            if done[ends[0]] >> b & 1 != 0 {
                continue;
            }
            let [from, to] = ends.map(|end| points.get(end));
            let Apex::Point(apex) = points.apex(from, to, error) else { return false };
            if triangles.len() == wanted {
                return false;
            }
            let c = apex as u8;
            triangles.push([a, b, c].map(u16::from));
            done[ends[0]] |= 1 << b;
            done[ends[1]] |= 1 << c;
            done[apex] |= 1 << a;
            // Whether an edge has its triangle is unpredictable, so there is no branch on it.
            for [p, q] in [[c, b], [a, c]] {
                open[opened] = [p, q];
                opened += usize::from(done[usize::from(p)] >> q & 1 == 0);
            }
        }
        // Every inner edge has a triangle on both sides now. If there are as many triangles as the points need, they
        // cover the rock without overlap, and no edge runs through another point, which `apex` would have overlooked.
        triangles.len() == wanted
    }
}

/// Delaunay triangulation of a convex rim and points strictly inside it, for rocks where wrapping cannot decide.
///
/// Vertices 0 … n − 1 are the rim, counter-clockwise, followed by the points in the order of insertion. Rim edges are
/// never flipped, so n points inside always give exactly 3n − 2 triangles, even if rounding has bent the rim inward by
/// less than a lattice step.
///
/// Source: Lawson (1977), *Software for C1 surface interpolation*: split the triangle that holds the new point, then
/// flip edges until every circumcircle is empty. Signs are exact: a floating-point filter with an error bound fixed per
/// rock decides most of them, and Shewchuk's adaptive predicates ([`robust`]) the rest.
#[derive(Debug, Default)]
struct Lawson {
    points: Vec<DVec2>,
    /// Vertices of each triangle, counter-clockwise.
    triangles: Vec<[u16; 3]>,
    /// `neighbors[t][k]` is the triangle across the edge from vertex k to vertex k + 1 of triangle t.
    neighbors: Vec<[u16; 3]>,
    /// Pairs (triangle, edge) for which the vertex beyond the edge may lie in the triangle's circumcircle.
    suspects: Vec<(u16, u8)>,
    /// A determinant whose absolute value is larger than this has the right sign.
    orient_error: f64,
    incircle_error: f64,
    /// The triangle at which the walk to the next point starts.
    last: u16,
}

impl Lawson {
    /// Starts a triangulation by joining `first` to every rim vertex. Returns false if `first` is not strictly inside.
    fn start(&mut self, rim: &[DVec2], first: DVec2) -> bool {
        let (low, high) = rim.iter().fold((DVec2::MAX, DVec2::MIN), |(lo, hi), &v| (lo.min(v), hi.max(v)));
        let extent = (high - low).max_element();
        let squared = extent * extent;
        // Shewchuk's bounds (3 + 16ε)ε Σ|products| and (10 + 96ε)ε Σ|products|, with every difference at most `extent`.
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

    /// Inserts a point. Returns false and changes nothing if the point is not strictly inside the rim or is there
    /// already.
    fn insert(&mut self, point: DVec2) -> bool {
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

    /// Walks to a triangle that holds point `p`, possibly on an inner edge. Returns `None` if `p` is outside or
    /// coincides with a vertex.
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
                    // In a Delaunay triangulation this walk cannot return to a triangle that it has left.
                    t = beyond;
                    continue 'walk;
                }
            }
            let point = self.points[usize::from(p)];
            let is_new = triangle.iter().all(|&v| self.points[usize::from(v)] != point);
            return is_new.then_some(t);
        }
    }

    /// Flips edges until no suspect is left. With `all`, every outer edge of a flipped pair becomes a suspect, which
    /// the star of `start` needs; after an insertion, only the edges that face the new point can be.
    fn flip_suspects(&mut self, all: bool) {
        while let Some((t, k)) = self.suspects.pop() {
            let (t, k) = (usize::from(t), usize::from(k));
            let u = self.neighbors[t][k];
            if u == RIM {
                continue;
            }
            // Triangle t is (a, b, p), and u = (b, a, q) is the triangle across its edge k from a to b.
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

    /// Replaces the neighbour `old` of triangle `t` by `new`.
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

    /// Positive if c lies left of the line from a to b, negative if right of it, 0 if on it.
    #[inline]
    fn orient(&self, a: u16, b: u16, c: u16) -> f64 {
        let [a, b, c] = [a, b, c].map(|v| self.points[usize::from(v)]);
        let det = (a - c).perp_dot(b - c);
        if det.abs() > self.orient_error { det } else { robust::orient2d(coord(a), coord(b), coord(c)) }
    }

    /// Positive if d lies inside the circle through a, b, c (counter-clockwise), negative if outside, 0 if on it.
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

/// Returns the Delaunay triangles of a convex rim (counter-clockwise) and the points inside it, as indices into rim and
/// points; `None` if a point is not strictly inside.
pub fn triangulate(rim: &[DVec2], inner: &[DVec2]) -> Option<Vec<[u16; 3]>> {
    let mut triangles = Vec::new();
    if Wrapper::default().wrap(rim, inner, &mut triangles) {
        return Some(triangles);
    }
    let mut lawson = Lawson::default();
    let (first, others) = inner.split_first()?;
    let complete = lawson.start(rim, *first) && others.iter().all(|&p| lawson.insert(p));
    complete.then_some(lawson.triangles)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::rng::{Purpose, Stream};

    /// A rim of n points on an ellipse and n points inside it, somewhere in a large image.
    fn rock(n: usize, stream: &mut Stream) -> (Vec<DVec2>, Vec<DVec2>) {
        let place = 8192.0 * DVec2::new(stream.unit(), stream.unit());
        let axes = 40.0 * DVec2::new(0.3 + 0.7 * stream.unit(), 0.3 + 0.7 * stream.unit());
        let at = |angle: f64, radius: f64| place + radius * axes * DVec2::from_angle(angle);
        let turn = core::f64::consts::TAU / n as f64;
        let rim = (0..n).map(|k| at(turn * (k as f64 + 0.8 * stream.unit()), 1.0)).collect();
        // The points are well inside the rim: even a rim of three vertices must hold them if it holds the middle.
        let top = (0..n).map(|_| at(10.0 * stream.unit(), 0.4 * stream.unit().sqrt())).collect();
        (rim, top)
    }

    #[test]
    fn wrapping_makes_the_triangles_of_lawson_and_is_rarely_unsure() {
        let mut stream = Stream::new(1, Purpose::TopPoints, 0, 0);
        let (mut rocks, mut unsure) = (0, 0);
        for round in 0..3000 {
            let n = 3 + round % 13;
            let (rim, top) = rock(n, &mut stream);
            let mut lawson = Lawson::default();
            if !lawson.start(&rim, top[0]) || !top[1..].iter().all(|&point| lawson.insert(point)) {
                continue; // the rim does not hold the middle
            }
            // Rims of many vertices are nearly circles here, unlike those of real rocks.
            let is_usual = u32::from(n <= 8);
            rocks += is_usual;
            let mut wrapped = Vec::new();
            if !Wrapper::default().wrap(&rim, &top, &mut wrapped) {
                unsure += is_usual;
                continue;
            }
            let set = |triangles: &[[u16; 3]]| -> BTreeSet<[u16; 3]> {
                let from_least = |&[a, b, c]: &[u16; 3]| {
                    if a < b && a < c {
                        [a, b, c]
                    } else if b < c {
                        [b, c, a]
                    } else {
                        [c, a, b]
                    }
                };
                triangles.iter().map(from_least).collect()
            };
            assert_eq!(set(&wrapped), set(&lawson.triangles), "round {round}: {rim:?} {top:?}");
        }
        assert!(rocks > 1000 && unsure * 20 < rocks, "{unsure} of {rocks} unsure");
    }

    #[test]
    fn wrapping_gives_up_where_points_are_cocircular_or_coincide() {
        let square = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)].map(|(x, y)| DVec2::new(x, y));
        let cocircular = [(3.0, 3.0), (5.0, 3.0), (5.0, 5.0), (3.0, 5.0)].map(|(x, y)| DVec2::new(x, y));
        let double = [(3.0, 3.0), (5.0, 3.1), (5.0, 3.1), (3.0, 5.2)].map(|(x, y)| DVec2::new(x, y));
        let on_the_rim = [(3.0, 3.0), (5.0, 0.0), (5.0, 3.1), (3.0, 5.2)].map(|(x, y)| DVec2::new(x, y));
        for top in [cocircular, double, on_the_rim] {
            assert!(!Wrapper::default().wrap(&square, &top, &mut Vec::new()), "{top:?}");
        }
    }
}
