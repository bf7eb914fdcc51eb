//! Stage 2: one Voronoi diagram per layer, clipped to the image (journal §3.1).
//!
//! A cell is built around its site from a list of possible neighbours ([`CellWrapper`]): all sites within a certain
//! reach. A neighbour is at most twice as far away as the farthest vertex of the cell, so a cell whose vertices all lie
//! within half the reach is final; for any other cell the reach is doubled. In a saturated layer every point is nearer
//! than r + √½ px to a site, so the first reach is always enough and the cost per cell is constant. If the darts
//! stopped at N_p, a few cells are larger and need more. `tests/voronoi.rs` compares the diagrams with those of the
//! crate `spade`.

use glam::{DVec2, Vec2};

use super::cell::{CellWrapper, LATTICE, SIDES};
use super::grid::Grid;
use super::sites::Sites;
use super::wrap::WrapSet;

/// The Voronoi diagram of one layer, clipped to the image.
///
/// Cell i owns the vertices `starts[i] .. starts[i + 1]`, in counter-clockwise order from the lexicographically
/// smallest one.
#[derive(Debug, Clone, Default)]
pub struct Cells {
    /// n + 1 offsets into `vertices` and `neighbors`.
    pub starts: Vec<u32>,
    /// Vertices of all cells, px.
    pub vertices: Vec<DVec2>,
    /// For every vertex, the neighbour across the edge that starts there: a site's index, or one of the image's sides
    /// (see [`SIDES`]).
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

    /// The vertices of cell `i`, px, counter-clockwise.
    pub fn polygon(&self, i: usize) -> &[DVec2] {
        &self.vertices[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// All vertices as x, y, x, y …, px, rounded to f32.
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

/// The sites around one bucket. They are gathered once and used for all cells of the bucket, because consecutive sites
/// mostly lie in the same bucket.
#[derive(Debug, Default)]
struct Surroundings {
    sites: WrapSet,
    /// Column and row of the bucket, and the number of rings of buckets gathered around it.
    bucket: Option<[u32; 3]>,
}

impl Surroundings {
    /// Gathers all sites within `reach` px of a site, and possibly some that are farther away.
    fn look(&mut self, grid: &Grid, sites: &Sites, site: usize, reach: f64) {
        // A site more than `rings` buckets away is farther away than `rings` bucket sides.
        let rings = (reach / f64::from(grid.side)).ceil() as u32;
        let [column, row] = sites.pixels[site].map(|c| u32::from(c) / grid.side);
        if self.bucket != Some([column, row, rings]) {
            self.bucket = Some([column, row, rings]);
            self.sites.clear();
            grid.block(column, row, rings, |others| {
                self.sites.extend(others, |other| Vec2::from(sites.pixels[other as usize].map(f32::from)));
            });
            self.sites.seal();
        }
    }
}

/// Builds a layer's diagram, some of its cells per step.
#[derive(Debug)]
pub(crate) struct VoronoiBuilder {
    cells: Cells,
    surroundings: Surroundings,
    wrapper: CellWrapper,
    /// Distance within which neighbours are looked for at first, px.
    reach: f64,
}

impl VoronoiBuilder {
    pub(crate) fn new(sites: &Sites) -> Self {
        let count = sites.pixels.len();
        let grid = sites.grid();
        // If the darts stopped early, the sites are sparser than r suggests, and the buckets are larger.
        let sparse = if sites.saturated { 0.0 } else { f64::from(grid.side) };
        let reach = sites.neighbor_reach().max(sparse);
        let mut cells = Cells {
            starts: Vec::with_capacity(count + 1),
            // Cells have fewer than six vertices on average (Euler's formula); the image's corners add four in all.
            vertices: Vec::with_capacity(6 * count + 4),
            neighbors: Vec::with_capacity(6 * count + 4),
            grid,
        };
        cells.starts.push(0);
        VoronoiBuilder { cells, surroundings: Surroundings::default(), wrapper: CellWrapper::default(), reach }
    }

    /// Builds about `count` more cells. Returns true when the diagram is finished.
    #[inline(never)]
    pub(crate) fn advance(&mut self, sites: &Sites, count: usize) -> bool {
        let from = self.cells.len();
        let to = (from + count).min(sites.pixels.len());
        for site in from..to {
            self.push_cell(sites, site);
        }
        to == sites.pixels.len()
    }

    fn push_cell(&mut self, sites: &Sites, site: usize) {
        let mut reach = self.reach;
        loop {
            self.surroundings.look(&self.cells.grid, sites, site, reach);
            // The loop ends at the latest when the sides of the image close the cell.
            if self.wrapper.wrap(sites, site, &self.surroundings.sites, reach) {
                break;
            }
            reach *= 2.0;
        }
        let Cells { starts, vertices, neighbors, .. } = &mut self.cells;
        let centre = DVec2::from(sites.pixels[site].map(f64::from)) + 0.5;
        self.wrapper.emit(|[dx, dy], neighbor| {
            // This is exact: the result is a multiple of 2⁻²⁰ below 2¹⁴.
            vertices.push(centre + DVec2::new(dx, dy) / LATTICE);
            neighbors.push(neighbor);
        });
        starts.push(vertices.len() as u32);
    }

    /// Share of the cells that are finished, 0 … 1.
    pub(crate) fn progress(&self, sites: &Sites) -> f64 {
        self.cells.len() as f64 / sites.pixels.len().max(1) as f64
    }

    pub(crate) fn finish(mut self) -> Cells {
        self.cells.vertices.shrink_to_fit();
        self.cells.neighbors.shrink_to_fit();
        self.cells
    }
}

/// Builds the Voronoi diagram of the given sites.
pub fn voronoi(sites: &Sites) -> Cells {
    let mut builder = VoronoiBuilder::new(sites);
    while !builder.advance(sites, usize::MAX / 2) {}
    builder.finish()
}
