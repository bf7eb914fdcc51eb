//! One Voronoi cell, cut out of the image by the bisectors of its neighbours, with exact decisions.
//!
//! Sites are pixels, so everything relative to a site is a small integer: a neighbour's offset g, the
//! squared distance |g|², and a cell vertex, which is the circumcentre of the site and two neighbours,
//! a quotient of integers. Floating point decides where its error allows, and integers of
//! 64 bits, enough for images up to 8192 px, where it does not: no tolerance decides what is cut.
//!
//! The image's border needs no code of its own: the bisector between a site and its mirror image
//! across a side *is* that side, and the mirror image of a pixel is again at integer coordinates.

use glam::DVec2;

/// The four sides of the image as neighbours of a cell: left, right, bottom, top.
pub(crate) const SIDES: u32 = u32::MAX - 3;

/// Lattice steps per px. Cell vertices are rounded to this lattice, which is fine enough for vertices to be
/// within 4.8e-7 px of their exact place and coarse enough for neighbours to share them bit for bit.
pub(crate) const LATTICE: f64 = (1_u32 << 20) as f64;

/// An edge of the cell, and the vertex it starts at (counter-clockwise). All relative to the site.
#[derive(Debug, Clone, Copy)]
struct Edge {
    /// Start vertex, rounded; its exact place is the circumcentre of the site and two neighbours, this edge's and
    /// the previous one's.
    vertex: DVec2,
    /// Its squared distance.
    distance2: f64,
    /// Offset of the neighbour across this edge: whole numbers.
    g: DVec2,
    /// Index of the neighbour, or [`SIDES`] + side.
    neighbor: u32,
}

impl Edge {
    /// The edge across from `g`, starting where it meets the edge across from `previous`.
    #[inline]
    fn after(previous: DVec2, g: DVec2, neighbor: u32) -> Self {
        let (n, d) = circumcentre(previous, g);
        let vertex = n * (1.0 / d);
        Edge { vertex, distance2: vertex.length_squared(), g, neighbor }
    }
}

/// The cell under construction; one is re-used for all sites.
#[derive(Debug, Default)]
pub(crate) struct CellCutter {
    edges: Vec<Edge>,
    spare: Vec<Edge>,
    corners: Vec<([f64; 2], u32)>,
    /// Four times the squared distance to the farthest vertex, rounded up.
    reach2: f64,
}

/// Circumcentre of the origin and two points, the second counter-clockwise of the first: numerators and denominator.
///
/// Exact: offsets are below 2¹⁴, so the numerators are below 2⁴⁴ and the denominator is below 2³⁰, and even.
#[inline]
fn circumcentre(a: DVec2, b: DVec2) -> (DVec2, f64) {
    let (aa, bb) = (a.length_squared(), b.length_squared());
    (DVec2::new(aa * b.y - bb * a.y, bb * a.x - aa * b.x), 2.0 * a.perp_dot(b))
}

impl CellCutter {
    /// Starts with the whole image, seen from pixel (x, y).
    pub(crate) fn start(&mut self, width: u32, height: u32, x: u32, y: u32) {
        let [w, h, x, y] = [width, height, x, y].map(f64::from);
        let (left, right, bottom, top) = (-x - 0.5, w - x - 0.5, -y - 0.5, h - y - 0.5);
        self.edges.clear();
        let mut side = |side, vertex: DVec2, g| {
            self.edges.push(Edge { vertex, distance2: vertex.length_squared(), g, neighbor: SIDES + side });
        };
        // The mirror image across a side is twice as far as the side.
        side(2, DVec2::new(left, bottom), DVec2::new(0.0, 2.0 * bottom));
        side(1, DVec2::new(right, bottom), DVec2::new(2.0 * right, 0.0));
        side(3, DVec2::new(right, top), DVec2::new(0.0, 2.0 * top));
        side(0, DVec2::new(left, top), DVec2::new(2.0 * left, 0.0));
        self.update_reach();
    }

    fn update_reach(&mut self) {
        let farthest = self.edges.iter().fold(0.0_f64, |far, edge| far.max(edge.distance2));
        // A bisector lies half way to its site, so at a quarter of the squared distance.
        self.reach2 = 4.0 * farthest * (1.0 + 1e-12);
    }

    /// Whether a site at a squared distance of `d2` could still cut the cell.
    #[inline]
    pub(crate) fn is_reached_from(&self, d2: f64) -> bool {
        d2 < self.reach2
    }

    /// Cuts off what is nearer to the neighbour at offset g than to the site.
    #[inline]
    pub(crate) fn cut(&mut self, g: DVec2, neighbor: u32) {
        let gg = g.length_squared();
        if !self.is_reached_from(gg) {
            return;
        }
        // A vertex v is cut off where v·g > |g|² / 2. Each side is off by a few ulp of |v| |g| ≤ (reach2 + |g|²) / 2 …
        let half = 0.5 * gg;
        let slack = 2.0e-15 * (self.reach2 + gg);
        let mut farthest = f64::NEG_INFINITY;
        let mut at = 0;
        for (k, edge) in self.edges.iter().enumerate() {
            let beyond = edge.vertex.dot(g) - half;
            if beyond > farthest {
                (farthest, at) = (beyond, k);
            }
        }
        if farthest > slack || (farthest >= -slack && self.is_cut(at, g, slack)) {
            self.replace_cut_vertices(at, g, neighbor, slack);
        }
    }

    /// Whether vertex k is strictly nearer to the neighbour at offset g. A vertex exactly on the bisector stays.
    #[inline]
    fn is_cut(&self, k: usize, g: DVec2, slack: f64) -> bool {
        let beyond = self.edges[k].vertex.dot(g) - 0.5 * g.length_squared();
        if beyond.abs() > slack { beyond > 0.0 } else { self.is_cut_exactly(k, g) }
    }

    /// … and where that leaves the sign open, integers below 2⁶³ decide.
    #[cold]
    fn is_cut_exactly(&self, k: usize, g: DVec2) -> bool {
        let previous = if k == 0 { self.edges.len() - 1 } else { k - 1 };
        let (n, d) = circumcentre(self.edges[previous].g, self.edges[k].g);
        let [nx, ny, d, gx, gy] = [n.x, n.y, d, g.x, g.y].map(|whole| whole as i64);
        2 * (nx * gx + ny * gy) > (gx * gx + gy * gy) * d
    }

    fn replace_cut_vertices(&mut self, some_cut: usize, g: DVec2, neighbor: u32, slack: f64) {
        let count = self.edges.len();
        let (previous, next) =
            (|k: usize| if k == 0 { count - 1 } else { k - 1 }, |k: usize| if k + 1 == count { 0 } else { k + 1 });
        // The cut vertices are consecutive, cyclically: first ..= last.
        let mut first = some_cut;
        while self.is_cut(previous(first), g, slack) {
            first = previous(first);
        }
        let mut last = some_cut;
        while self.is_cut(next(last), g, slack) {
            last = next(last);
        }
        let before = self.edges[previous(first)];
        let after = self.edges[last];
        self.spare.clear();
        // The new edge begins on the edge that leads to the first cut vertex …
        self.spare.push(Edge::after(before.g, g, neighbor));
        // … and ends on the edge that leaves the last one.
        self.spare.push(Edge::after(g, after.g, after.neighbor));
        let kept = next(last);
        if kept <= first {
            self.spare.extend_from_slice(&self.edges[kept..first]);
        } else {
            self.spare.extend_from_slice(&self.edges[kept..]);
            self.spare.extend_from_slice(&self.edges[..first]);
        }
        core::mem::swap(&mut self.edges, &mut self.spare);
        self.update_reach();
    }

    /// Emits the cell counter-clockwise from the lexicographically least vertex: its vertices in lattice steps relative
    /// to the site, each with the neighbour across the edge that starts there.
    ///
    /// Vertices nearer than 1e-6 px are merged (decision A8): that is one lattice step.
    pub(crate) fn emit(&mut self, mut vertex: impl FnMut([f64; 2], u32)) {
        self.corners.clear();
        let mut previous = self.edges[self.edges.len() - 1].g;
        for edge in &self.edges {
            let place = edge.vertex.to_array().map(to_lattice);
            let place = match place {
                [Some(x), Some(y)] => [x, y],
                _ => {
                    let (n, d) = circumcentre(previous, edge.g);
                    n.to_array().map(|n| to_lattice_exactly(n as i64, d as i64))
                }
            };
            self.corners.push((place, edge.neighbor));
            previous = edge.g;
        }
        let corners = &mut self.corners[..];
        let least = (0..corners.len()).min_by(|&a, &b| {
            let (a, b) = (corners[a].0, corners[b].0);
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
        });
        let Some(least) = least else { return };
        corners.rotate_left(least);
        // Where several corners share the least place, the last of them has the edge that leaves it.
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() <= 1.0;
        let wrapped = corners.iter().rev().take_while(|corner| near(corner.0, corners[0].0)).count();
        let corners = &corners[..corners.len() - wrapped.min(corners.len() - 1)];
        for (k, &(place, neighbor)) in corners.iter().enumerate() {
            match corners.get(k + 1) {
                Some(next) if near(place, next.0) => {}
                _ => vertex(place, neighbor),
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
