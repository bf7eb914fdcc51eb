//! Stage 2: one Voronoi diagram per layer, clipped to the image (journal §3.1).
//!
//! Every cell is wrapped around its site from a list of possible neighbours ([`CellWrapper`]); the two ways below only
//! differ in how that list comes about, so they give the same bytes:
//!
//! * In a *saturated* layer all neighbours lie within [`Sites::neighbor_reach`]: the buckets of a grid around the site
//!   hold them, and the cost per cell is constant.
//! * Otherwise the Delaunay triangulation of all sites ([`spade`]) names them.

use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{DelaunayTriangulation, Point2, Triangulation};

use super::cell::{CellWrapper, LATTICE, SIDES};
use super::grid::Grid;
use super::sites::Sites;

/// The Voronoi diagram of one layer, clipped to the image.
///
/// Cell i owns the vertices `starts[i] .. starts[i + 1]`, counter-clockwise from the lexicographically least one.
#[derive(Debug, Clone, Default)]
pub struct Cells {
    /// n + 1 offsets into the two lists below.
    pub starts: Vec<u32>,
    /// Cell vertices in px.
    pub vertices: Vec<DVec2>,
    /// For every vertex the neighbour across the edge that starts there: a site index, or one of the image's sides.
    pub(crate) neighbors: Vec<u32>,
    pub(crate) grid: Grid,
}

impl Cells {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Vertices of cell `i`.
    pub fn polygon(&self, i: usize) -> &[DVec2] {
        &self.vertices[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// Vertices as x, y, x, y …, px, rounded to f32.
    pub fn flat_vertices(&self) -> Vec<f32> {
        self.vertices.iter().flat_map(|v| v.as_vec2().to_array()).collect()
    }

    /// Whether cell `i` has an edge on the image's border.
    pub fn touches_border(&self, i: usize) -> bool {
        self.neighbors_of(i).iter().any(|&neighbor| neighbor >= SIDES)
    }

    pub(crate) fn neighbors_of(&self, i: usize) -> &[u32] {
        &self.neighbors[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}

/// How the neighbours of a site are found.
#[derive(Debug)]
enum Neighborhood {
    /// The sites within reach.
    Local,
    /// By a Delaunay triangulation of all sites, under construction until it holds all of them.
    Global(Box<DelaunayTriangulation<Point2<f64>>>),
}

/// Builds a layer's diagram in pieces.
#[derive(Debug)]
pub(crate) struct VoronoiBuilder {
    cells: Cells,
    wrapper: CellWrapper,
    neighborhood: Neighborhood,
    /// Square of how far a neighbour can be.
    reach2: f64,
    /// And in buckets.
    rings: u32,
}

impl VoronoiBuilder {
    /// `local`: look no farther than [`Sites::neighbor_reach`], which is right for saturated layers.
    pub(crate) fn new(sites: &Sites, local: bool) -> Self {
        let count = sites.pixels.len();
        let reach = if local { sites.neighbor_reach() } else { f64::INFINITY };
        let grid = sites.grid();
        let rings = if local { (reach / f64::from(grid.side)) as u32 + 1 } else { 0 };
        let mut cells = Cells {
            starts: Vec::with_capacity(count + 1),
            // Fewer than six vertices per cell on average (Euler), and four corners.
            vertices: Vec::with_capacity(6 * count + 4),
            neighbors: Vec::with_capacity(6 * count + 4),
            grid,
        };
        cells.starts.push(0);
        let neighborhood =
            if local { Neighborhood::Local } else { Neighborhood::Global(Box::new(DelaunayTriangulation::new())) };
        VoronoiBuilder { cells, wrapper: CellWrapper::default(), neighborhood, reach2: reach * reach, rings }
    }

    /// Works on about `count` sites. True when the diagram is finished.
    pub(crate) fn advance(&mut self, sites: &Sites, count: usize) -> bool {
        if let Neighborhood::Global(triangulation) = &mut self.neighborhood {
            let done = triangulation.num_vertices();
            if done < sites.pixels.len() {
                for &[x, y] in sites.pixels.iter().skip(done).take(count) {
                    // Sites are distinct pixels with coordinates far from spade's limits: insertion cannot fail.
                    let _ = triangulation.insert(Point2::new(f64::from(x), f64::from(y)));
                }
                return false;
            }
        }
        let from = self.cells.len();
        let to = (from + count).min(sites.pixels.len());
        for site in from..to {
            self.wrap_cell(sites, site);
        }
        to == sites.pixels.len()
    }

    fn wrap_cell(&mut self, sites: &Sites, site: usize) {
        let here = sites.pixels[site];
        let [x, y] = here.map(u32::from);
        let origin = DVec2::new(f64::from(x), f64::from(y));
        let (wrapper, grid) = (&mut self.wrapper, &self.cells.grid);
        wrapper.start(sites.width, sites.height, x, y, self.reach2);
        let mut consider = |other: u32| {
            let [ox, oy] = sites.pixels[other as usize].map(f64::from);
            wrapper.consider(DVec2::new(ox, oy) - origin, other, self.reach2);
        };
        match &self.neighborhood {
            Neighborhood::Local => {
                let (column, row) = (x / grid.side, y / grid.side);
                grid.block(column, row, self.rings, |other| {
                    if other as usize != site {
                        consider(other);
                    }
                });
            }
            Neighborhood::Global(triangulation) => {
                let vertex = triangulation.vertex(FixedVertexHandle::from_index(site));
                vertex.out_edges().for_each(|edge| consider(edge.to().fix().index() as u32));
            }
        }
        wrapper.wrap();
        let (vertices, neighbors) = (&mut self.cells.vertices, &mut self.cells.neighbors);
        let centre = origin + 0.5;
        wrapper.emit(|[dx, dy], neighbor| {
            // Exact: a multiple of 2⁻²⁰ below 2¹⁴.
            vertices.push(centre + DVec2::new(dx, dy) / LATTICE);
            neighbors.push(neighbor);
        });
        self.cells.starts.push(vertices.len() as u32);
    }

    /// 0 … 1.
    pub(crate) fn progress(&self, sites: &Sites) -> f64 {
        let total = sites.pixels.len().max(1) as f64;
        match &self.neighborhood {
            Neighborhood::Local => self.cells.len() as f64 / total,
            Neighborhood::Global(t) => (t.num_vertices() + self.cells.len()) as f64 / (2.0 * total),
        }
    }

    pub(crate) fn finish(mut self) -> Cells {
        self.cells.vertices.shrink_to_fit();
        self.cells.neighbors.shrink_to_fit();
        self.cells
    }
}

/// The diagram of given sites. `local` looks for neighbours only as far as a saturated layer has any, and needs one; it
/// gives the same bytes.
pub fn voronoi(sites: &Sites, local: bool) -> Cells {
    let mut builder = VoronoiBuilder::new(sites, local);
    while !builder.advance(sites, usize::MAX / 2) {}
    builder.finish()
}
