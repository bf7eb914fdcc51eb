//! Stage 5: displacement, wear, and the buffers.

use glam::DVec2;

use super::cache::MeshKey;
use super::mesh::{Extent, Mesh, RockBuilder};
use super::shape::{Shapes, Swings};
use super::subdivide::Fineness;
use super::voronoi::Cells;
use super::wear::{Rock, Wearer};

/// The inputs from which a layer's rocks are made.
pub(super) struct Source<'a> {
    pub(super) seed: u32,
    /// Id of the layer.
    pub(super) layer: u32,
    pub(super) cells: &'a Cells,
    pub(super) selected: &'a [u32],
    pub(super) shapes: &'a Shapes,
}

/// Writes a layer's rocks into the mesh, some of them per step.
#[derive(Debug)]
pub(super) struct Mesher {
    pub(super) key: MeshKey,
    /// Number of the next rock; `at` is its place in the buffers.
    rock: usize,
    at: Extent,
    builder: RockBuilder,
    wearer: Wearer,
    /// Per site, whether a rock stands on it. Empty if weathering is 0.
    standing: Vec<bool>,
}

impl Mesher {
    /// `sites` is the number of sites in the layer.
    pub(super) fn new(key: MeshKey, selected: &[u32], sites: usize) -> Self {
        let mut standing = Vec::new();
        if key.wear.weathering > 0.0 {
            standing.resize(sites, false);
            for &site in selected {
                standing[site as usize] = true;
            }
        }
        let at = key.at;
        Mesher { key, rock: 0, at, builder: RockBuilder::default(), wearer: Wearer::default(), standing }
    }

    pub(super) fn progress(&self, shapes: &Shapes) -> f64 {
        self.rock as f64 / shapes.len().max(1) as f64
    }

    /// Writes at most `count` rocks, and fewer if they are worn. Returns true when all are written.
    #[inline(never)]
    pub(super) fn advance(&mut self, of: &Source<'_>, mesh: &mut Mesh, count: usize) -> bool {
        let most = (self.rock + count).min(of.shapes.len());
        if !self.key.wear.is_none() {
            let mut left = count / 8;
            while left > 0 && self.rock < most {
                let segments = self.write(of, self.rock, mesh);
                self.rock += 1;
                left = left.saturating_sub(segments * segments);
            }
            return self.rock == of.shapes.len();
        }
        let to = most;
        for from in (self.rock..to).step_by(ROCKS_AHEAD) {
            let group = from..(from + ROCKS_AHEAD).min(to);
            read_ahead(group.clone().map(|k| {
                let rim = of.cells.polygon(of.selected[k] as usize);
                (rim, of.shapes.top_of(k), of.shapes.triangles_of(k))
            }));
            for k in group {
                self.write(of, k, mesh);
            }
        }
        self.rock = to;
        to == of.shapes.len()
    }

    /// Writes a rock. Returns the number of segments into which its edges are cut.
    fn write(&mut self, of: &Source<'_>, k: usize, mesh: &mut Mesh) -> usize {
        let Mesher { key, builder, wearer, standing, at, .. } = self;
        let site = of.selected[k];
        let (rim, top) = (of.cells.polygon(site as usize), of.shapes.top_of(k));
        let mut triangles = of.shapes.triangles_of(k);
        let mut buried = 0;
        let mut segments = 1;
        builder.start(rim);
        let mut swings = Swings::new(of.seed, of.layer, site, key.swing);
        swings.displace(top, key.taper, key.height, |p| builder.points.push(p));
        if !key.wear.is_none() {
            let neighbors = of.cells.neighbors_of(site as usize);
            // A side of the image is not a site, so no rock stands behind it.
            let touches = |edge: usize| standing.get(neighbors[edge] as usize).copied().unwrap_or(false);
            segments = Fineness::new(key.wear.detail, key.height).at(of.cells, site);
            let rock = Rock { segments, rim, top, triangles, touches: &touches, seed: of.seed, layer: of.layer, site };
            wearer.wear(key.wear, &rock, builder);
            triangles = &wearer.subdivision.triangles;
            buried = if key.wear.buries_rim(segments) { wearer.subdivision.rim } else { 0 };
        }
        builder.finish(triangles, buried);
        mesh.write_rock(at, key.index as u8, builder, triangles);
        segments
    }
}

/// Number of rocks whose shapes are fetched from memory together, ahead of writing them.
const ROCKS_AHEAD: usize = 16;

/// Reads a little of each shape that is about to be used. Rocks are written in the order of the selection, which
/// scatters them over a field that may be larger than any cache. Written one by one, each rock would wait for its own
/// cache lines; read ahead as a group, their lines are fetched at the same time.
fn read_ahead<'a>(rocks: impl Iterator<Item = (&'a [DVec2], &'a [DVec2], &'a [[u16; 3]])>) {
    let touched = rocks.fold(0, |sum, (rim, top, triangles)| {
        let ends = [rim, top].map(|list| list[0].x.to_bits() ^ list[list.len() - 1].x.to_bits());
        sum ^ ends[0] ^ ends[1] ^ u64::from(triangles[0][0] ^ triangles[triangles.len() - 1][0])
    });
    core::hint::black_box(touched);
}
