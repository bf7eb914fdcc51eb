//! The net of triangles that a worn stone is covered with.
//!
//! The papers' triangulation has corners at random places. Cut finely and stretched over a stone, it has parts where triangles are slivers, on
//! which relief becomes combs and stairs. A stone of which nothing of the papers' mesh is seen gets a net of as many corners and triangles
//! instead, whose corners stand at even distances: one on top, a ring around it, and the rim. Cut into m segments, that is 2m rings of vertices:
//! each has a ring's worth more than the one inside it, until they are as wide as the stone.

use core::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::subdivide::Blend;

/// How much of their own directions the rim's corners keep, relative to even ones. The less, the more the triangles between the last ring and
/// the rim, which lie below the ground, are twisted.
const OWN: f64 = 0.5;

/// A net has at least so many corners at the rim, so that those of the ring are around the one on top.
const LEAST_CORNERS: usize = 4;

/// A net for the cells of the layer's rocks, one after the other.
#[derive(Debug, Default)]
pub(super) struct Net {
    /// Per corner, first those of the rim, its direction and its place from the top down: 0 on top, ½ on the ring, 1 at the rim.
    corners: Vec<DVec3>,
    pub(super) triangles: Vec<[u16; 3]>,
    /// The length of a triangle's edge along the rings inside the ring of corners, in segments.
    edge: f64,
}

impl Net {
    /// Lays the net over a stone on a cell that has these corners, whose middle is at `middle`. Returns whether it can be done.
    #[inline(never)]
    pub(super) fn lay(&mut self, rim: &[DVec2], middle: DVec2) -> bool {
        let (n, ring) = (rim.len(), rim.len() - 1);
        self.corners.clear();
        self.triangles.clear();
        if n < LEAST_CORNERS {
            return false;
        }
        let even = |k: f64, of: usize| turn(k / of as f64);
        // The net is turned so that it is twisted as little as possible.
        let turned = rim.iter().enumerate().fold(DVec2::ZERO, |sum, (k, corner)| {
            let back = even(k as f64, n) * DVec2::new(1.0, -1.0);
            sum + back.rotate((*corner - middle).normalize_or(DVec2::X))
        });
        let turned = turned.normalize_or(DVec2::X);
        // Where the ring's corners are, between those of the rim.
        let place = |k: usize| (k as f64 + 0.5) * n as f64 / ring as f64;
        self.corners.extend(rim.iter().enumerate().map(|(k, corner)| {
            let own = (*corner - middle).normalize_or(DVec2::X);
            (turned.rotate(even(k as f64, n)) + own * OWN).normalize_or(own).extend(1.0)
        }));
        self.corners.extend((0..ring).map(|k| turned.rotate(even(k as f64 + 0.5, ring)).extend(0.5)));
        self.corners.push(DVec3::ZERO);
        let [top, first] = [2 * n - 1, n].map(|corner| corner as u16);
        let (mut outer, mut inner) = (0, 0);
        let of_ring = |k: usize| first + (k % ring) as u16;
        while outer < n || inner < ring {
            let [last, next] = [of_ring(inner + ring - 1), of_ring(inner)];
            let [here, beyond] = [outer % n, (outer + 1) % n].map(|corner| corner as u16);
            if inner < ring && place(inner) <= (outer + 1) as f64 {
                self.triangles.push([last, here, next]);
                self.triangles.push([top, last, next]);
                inner += 1;
            } else {
                self.triangles.push([here, beyond, last]);
                outer += 1;
            }
        }
        self.edge = TAU / ring as f64;
        true
    }

    /// Where a vertex is on the disc: its distance from the middle is 0 on top, ½ on the ring of corners, 1 at the rim.
    #[inline(never)]
    pub(super) fn place(&self, vertex: &Blend, segments: usize) -> DVec2 {
        let at = vertex.of(&self.corners, segments);
        at.truncate().normalize_or_zero() * at.z
    }

    /// The ways from a place on the disc to its neighbours if these were straight outward and straight around it.
    pub(super) fn steps(&self, at: DVec2, segments: usize) -> [DVec2; 2] {
        let outward = at.normalize_or(DVec2::X);
        let segment = 0.5 / segments as f64;
        // The rows of a lattice of triangles are closer than its vertices.
        let row = segment * (4.0 / 3.0_f64).sqrt();
        [outward * row, outward.perp() * (segment * self.edge * (2.0 * at.length()).max(1.0))]
    }
}

/// The direction that is this share of a turn from the x axis, nearly: Bhaskara's sine, which is off by less than 0.2 % and has the same bits
/// everywhere.
fn turn(share: f64) -> DVec2 {
    let sine = |share: f64| {
        let half = 2.0 * (share - share.floor());
        let (half, sign) = if half < 1.0 { (half, 1.0) } else { (half - 1.0, -1.0) };
        let hill = half * (1.0 - half);
        sign * 16.0 * hill / (5.0 - 4.0 * hill)
    };
    DVec2::new(sine(share + 0.25), sine(share)).normalize_or(DVec2::X)
}
