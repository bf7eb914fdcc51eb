//! Cuts every triangle of a rock into m² equal ones. Each new vertex is a weighted mean of the rock's corners, so any
//! value given at the corners can be carried over to it. m is chosen per rock, so that all rocks of a layer have triangles
//! of about one size.

use glam::DVec2;

use super::voronoi::Cells;

/// The largest number of segments into which an edge is cut.
pub(crate) const MOST_SEGMENTS: usize = 32;

/// How finely the rocks of a layer are cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fineness {
    /// Triangles per px²: those of an equilateral mesh whose edges have the length that was asked for. 0 if rocks are not cut.
    density: f64,
    /// Mean height of the layer's top vertices, px.
    height: f64,
}

impl Fineness {
    /// `detail` is the number of edges along 100 px, and `height` holds c_h1, c_h2 and c_h3 of Eq. 3, px.
    pub(crate) fn new(detail: f64, height: [f64; 3]) -> Self {
        let per_px = detail * 0.01;
        // An equilateral triangle of edge e has the area e²·√3/4.
        Fineness { density: per_px * per_px * 4.0 / 3.0_f64.sqrt(), height: height[0] + 0.5 * (height[1] + height[2]) }
    }

    /// The number of segments, a power of two, into which every edge of the rock on this cell is cut.
    #[inline(never)]
    pub(super) fn segments(self, cell: &[DVec2]) -> usize {
        if self.density == 0.0 {
            return 1;
        }
        let (mut double_area, mut around) = (0.0, 0.0);
        let mut last = cell[cell.len() - 1];
        for &corner in cell {
            double_area += (last - cell[0]).perp_dot(corner - cell[0]);
            around += (corner - last).length();
            last = corner;
        }
        self.segments_of(cell.len(), 0.5 * double_area, around)
    }

    /// The same for a cell with this number of corners, this area and this circumference.
    pub(crate) fn segments_of(self, corners: usize, area: f64, around: f64) -> usize {
        // The papers' mesh is about as large as a prism without its base.
        let surface = area + around * self.height;
        // How many parts each of its triangles should be cut into.
        let wanted = surface * self.density / (3 * corners - 2) as f64;
        let fits = |segments: usize| counts(1, corners, segments)[0] <= usize::from(u16::MAX);
        let mut segments = 1;
        // Twice as many segments make four times as many parts; twice as many parts are half way.
        while segments < MOST_SEGMENTS && wanted > 2.0 * (segments * segments) as f64 && fits(2 * segments) {
            segments *= 2;
        }
        segments
    }

    /// The number of segments for the rock on cell `site`.
    pub(super) fn at(self, cells: &Cells, site: u32) -> usize {
        self.segments(cells.polygon(site as usize))
    }

    /// Number of vertices and of triangles of the rocks on the cells `selected`, which have `rims` rim vertices in all before they
    /// are cut; and number of vertices of the largest of them, 0 if none is cut.
    pub(super) fn counts(self, cells: &Cells, selected: &[u32], rims: usize) -> [usize; 3] {
        if self.density == 0.0 {
            let [vertices, triangles] = counts(selected.len(), rims, 1);
            return [vertices, triangles, 0];
        }
        selected.iter().fold([0, 0, 0], |[vertices, triangles, largest], &site| {
            let cell = cells.polygon(site as usize);
            let [more_vertices, more_triangles] = counts(1, cell.len(), self.segments(cell));
            [vertices + more_vertices, triangles + more_triangles, largest.max(more_vertices)]
        })
    }
}

/// A vertex as a weighted mean of three corners of the rock: the numbers of the corners and their weights, in units of
/// 1/`segments`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Blend {
    corners: [u16; 3],
    shares: [u8; 3],
}

impl Blend {
    /// The weighted mean of the values that `values` holds for the corners.
    #[inline]
    pub(super) fn of<T>(&self, values: &[T], segments: usize) -> T
    where
        T: Copy + core::ops::Add<Output = T> + core::ops::Mul<f64, Output = T>,
    {
        // `segments` is a power of two, so this is exact.
        let unit = 1.0 / segments as f64;
        let [a, b, c] = self.corners.map(|corner| values[usize::from(corner)]);
        let [i, j, k] = self.shares.map(|share| f64::from(share) * unit);
        a * i + b * j + c * k
    }
}

impl Blend {
    /// The share that the rim's corners have, 0 … 1; the first `rim` corners are the rim's.
    pub(super) fn rim_share(&self, rim: usize, segments: usize) -> f64 {
        let shares = self.corners.iter().zip(&self.shares).filter(|(corner, _)| usize::from(**corner) < rim);
        shares.map(|(_, share)| f64::from(*share)).sum::<f64>() / segments as f64
    }
}

/// The subdivided triangles of one rock. Re-used from rock to rock to avoid allocations.
///
/// The rim's vertices come first, in order around the cell, m for each of the cell's edges; then the top vertices; then
/// all others.
#[derive(Debug, Default)]
pub(super) struct Subdivision {
    pub(super) segments: usize,
    pub(super) rim: usize,
    pub(super) blends: Vec<Blend>,
    pub(super) triangles: Vec<[u16; 3]>,
    /// The first vertex inside the edge between two corners, counted from the lower corner on; a square table of
    /// `corners` × `corners`.
    edges: Vec<u16>,
    /// Vertices of the triangle being cut, row by row.
    lattice: Vec<u16>,
}

const NONE: u16 = u16::MAX;

impl Subdivision {
    /// Cuts `triangles`, which have `rim` rim vertices and as many top vertices. Every edge is cut into `segments`
    /// parts, a power of two up to [`MOST_SEGMENTS`].
    pub(super) fn cut(&mut self, rim: usize, triangles: &[[u16; 3]], segments: usize) {
        let corners = 2 * rim;
        self.segments = segments;
        self.rim = rim * segments;
        self.blends.clear();
        self.triangles.clear();
        let [vertices, parts] = counts(1, rim, segments);
        self.blends.reserve_exact(vertices);
        self.triangles.reserve_exact(parts);
        self.edges.clear();
        self.edges.resize(corners * corners, NONE);
        for edge in 0..rim {
            let next = (edge + 1) % rim;
            self.edges[edge.min(next) * corners + edge.max(next)] = self.blends.len() as u16 + 1;
            for step in 0..segments {
                self.push([edge, next, edge], [segments - step, step, 0]);
            }
        }
        for top in rim..corners {
            self.push([top; 3], [segments, 0, 0]);
        }
        for triangle in triangles {
            self.add_triangle(triangle.map(usize::from), rim);
        }
    }

    fn push(&mut self, corners: [usize; 3], shares: [usize; 3]) {
        let blend = Blend { corners: corners.map(|c| c as u16), shares: shares.map(|share| share as u8) };
        self.blends.push(blend);
    }

    /// The number of the vertex at a corner.
    fn corner(&self, corner: usize, rim: usize) -> u16 {
        (if corner < rim { corner * self.segments } else { self.rim + corner - rim }) as u16
    }

    /// The number of the vertex `step` segments from corner `a` towards corner `b`. Creates the edge's vertices if they
    /// do not exist yet.
    fn on_edge(&mut self, [a, b]: [usize; 2], step: usize, rim: usize) -> u16 {
        if step == 0 || step == self.segments {
            return self.corner(if step == 0 { a } else { b }, rim);
        }
        let [low, high] = [a.min(b), a.max(b)];
        let slot = low * 2 * rim + high;
        if self.edges[slot] == NONE {
            self.edges[slot] = self.blends.len() as u16;
            for step in 1..self.segments {
                self.push([low, high, low], [self.segments - step, step, 0]);
            }
        }
        // The rim's last edge runs from its last corner to its first. It is the only edge stored from its higher corner
        // on.
        let wraps = low == 0 && high + 1 == rim;
        let from_start = if (a == low) != wraps { step } else { self.segments - step };
        self.edges[slot] + from_start as u16 - 1
    }

    fn add_triangle(&mut self, [a, b, c]: [usize; 3], rim: usize) {
        let m = self.segments;
        let mut lattice = core::mem::take(&mut self.lattice);
        lattice.clear();
        // Row r runs parallel to the edge from a to b, r segments towards c.
        for row in 0..=m {
            for column in 0..=m - row {
                let vertex = if row == 0 {
                    self.on_edge([a, b], column, rim)
                } else if column == 0 {
                    self.on_edge([a, c], row, rim)
                } else if column == m - row {
                    self.on_edge([b, c], row, rim)
                } else {
                    self.push([a, b, c], [m - row - column, column, row]);
                    self.blends.len() as u16 - 1
                };
                lattice.push(vertex);
            }
        }
        let mut start = 0;
        for row in 0..m {
            let above = start + m - row + 1;
            for column in 0..m - row {
                let [here, right, up] = [start + column, start + column + 1, above + column];
                self.triangles.push([lattice[here], lattice[right], lattice[up]]);
                if column + 1 < m - row {
                    self.triangles.push([lattice[right], lattice[up + 1], lattice[up]]);
                }
            }
            start = above;
        }
        self.lattice = lattice;
    }
}

/// Number of vertices and of triangles of `rocks` rocks that have `top` top vertices in all, with every edge cut into
/// `segments`.
pub(crate) fn counts(rocks: usize, top: usize, segments: usize) -> [usize; 2] {
    // A rock with n rim vertices has 2n corners, 5n − 3 edges and 3n − 2 triangles (decision A12).
    let [corners, edges, triangles] = [2 * top, 5 * top - 3 * rocks, 3 * top - 2 * rocks];
    let inside = segments - 1;
    [corners + edges * inside + triangles * (inside * segments.saturating_sub(2) / 2), triangles * segments * segments]
}
