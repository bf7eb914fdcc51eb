//! One Voronoi cell, cut out of the image by the bisectors of its neighbours, with exact decisions.
//!
//! Sites are pixels, so everything relative to a site is a small integer: a neighbour's offset g, the
//! squared distance |g|², and a cell vertex, which is the circumcentre of the site and two neighbours,
//! a quotient of integers below 2⁶³ for images up to 8192 px. No tolerance decides what is cut.
//!
//! The image's border needs no code of its own: the bisector between a site and its mirror image
//! across a side *is* that side, and the mirror image of a pixel is again at integer coordinates.

/// The four sides of the image as neighbours of a cell: left, right, bottom, top.
pub(crate) const SIDES: u32 = u32::MAX - 3;

/// Lattice steps per px. Cell vertices are rounded to this lattice, which is fine enough for vertices to be
/// within 4.8e-7 px of their exact place and coarse enough for neighbours to share them bit for bit.
pub(crate) const LATTICE: f64 = (1_u32 << 20) as f64;

/// An edge of the cell, and the vertex it starts at (counter-clockwise).
#[derive(Debug, Clone, Copy)]
struct Edge {
    /// Offset of the neighbour across this edge.
    g: [i64; 2],
    /// Index of the neighbour, or [`SIDES`] + side.
    neighbor: u32,
    /// Start vertex relative to the site: numerators and their common positive denominator.
    n: [i64; 2],
    d: i64,
    /// Squared distance of that vertex from the site, rounded.
    distance2: f64,
}

impl Edge {
    /// The edge across from `g`, starting where it meets the edge across from `previous`.
    #[inline]
    fn after(previous: [i64; 2], g: [i64; 2], neighbor: u32) -> Self {
        let (n, d) = circumcentre(previous, g);
        let (x, y, w) = (n[0] as f64, n[1] as f64, d as f64);
        Edge { g, neighbor, n, d, distance2: (x * x + y * y) / (w * w) }
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

/// Circumcentre of the origin and two points, the second counter-clockwise of the first.
fn circumcentre(a: [i64; 2], b: [i64; 2]) -> ([i64; 2], i64) {
    let (aa, bb) = (a[0] * a[0] + a[1] * a[1], b[0] * b[0] + b[1] * b[1]);
    ([aa * b[1] - bb * a[1], bb * a[0] - aa * b[0]], 2 * (a[0] * b[1] - a[1] * b[0]))
}

impl CellCutter {
    /// Starts with the whole image, seen from pixel (x, y).
    pub(crate) fn start(&mut self, width: u32, height: u32, x: u32, y: u32) {
        let [w, h, x, y] = [width, height, x, y].map(i64::from);
        let mirrors = [
            (SIDES + 2, [0, -2 * y - 1]),
            (SIDES + 1, [2 * (w - x) - 1, 0]),
            (SIDES + 3, [0, 2 * (h - y) - 1]),
            (SIDES, [-2 * x - 1, 0]),
        ];
        self.edges.clear();
        for k in 0..4 {
            let (neighbor, g) = mirrors[k];
            let (_, previous) = mirrors[(k + 3) % 4];
            self.edges.push(Edge::after(previous, g, neighbor));
        }
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
    pub(crate) fn cut(&mut self, g: [i64; 2], neighbor: u32) {
        let gg = g[0] * g[0] + g[1] * g[1];
        if self.is_reached_from(gg as f64) {
            // A vertex v = n / d is cut off where 2 v·g > |g|². A vertex exactly on the bisector stays.
            let is_cut = |edge: &Edge| 2 * (edge.n[0] * g[0] + edge.n[1] * g[1]) > gg * edge.d;
            if let Some(some_cut) = self.edges.iter().position(is_cut) {
                self.replace_cut_vertices(some_cut, is_cut, g, neighbor);
            }
        }
    }

    fn replace_cut_vertices(&mut self, some_cut: usize, is_cut: impl Fn(&Edge) -> bool, g: [i64; 2], neighbor: u32) {
        let count = self.edges.len();
        // The cut vertices are consecutive, cyclically: first ..= last.
        let mut first = some_cut;
        if first == 0 {
            while is_cut(&self.edges[(first + count - 1) % count]) {
                first = (first + count - 1) % count;
            }
        }
        let mut last = some_cut;
        while is_cut(&self.edges[(last + 1) % count]) {
            last = (last + 1) % count;
        }
        let before = self.edges[(first + count - 1) % count];
        let after = self.edges[last];
        self.spare.clear();
        // New vertex on the edge that leads to the first cut vertex; there the bisector begins …
        self.spare.push(Edge::after(before.g, g, neighbor));
        // … and it ends on the edge that leaves the last one.
        self.spare.push(Edge::after(g, after.g, after.neighbor));
        let kept = (first + count - last - 1) % count;
        for k in 1..=kept {
            self.spare.push(self.edges[(last + k) % count]);
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
        self.corners.extend(self.edges.iter().map(|edge| (edge.n.map(|n| to_lattice(n, edge.d)), edge.neighbor)));
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

/// n / d in lattice steps, rounded to the nearest (halves up) as if computed exactly, so that it does not
/// depend on which of a vertex's sites it was computed from.
#[inline]
fn to_lattice(n: i64, d: i64) -> f64 {
    let shifted = n as f64 / d as f64 * LATTICE + 0.5;
    let rounded = shifted.floor();
    // The quotient is off by at most 2⁻¹⁹ steps (2³⁴ steps in 53 bits); only near a boundary can that matter.
    let fraction = shifted - rounded;
    if (1.0e-5..=1.0 - 1.0e-5).contains(&fraction) { rounded } else { to_lattice_exactly(n, d) }
}

#[cold]
fn to_lattice_exactly(n: i64, d: i64) -> f64 {
    let (whole, rest) = (n.div_euclid(d), n.rem_euclid(d));
    // d is even, so d / 2 is exact; rest < 2³⁰, so the shift fits.
    let part = ((rest << 20) + d / 2).div_euclid(d);
    (whole * (1 << 20) + part) as f64
}
