//! Stage 4: p_add and their triangulation (journal §3.3, Fig. 10), and the displacement (Eqs 2, 3).

use glam::{DVec2, DVec3};

use super::memory::bytes;
use super::triangulate::Triangulator;
use super::voronoi::Cells;
use crate::params::Swing;
use crate::rng::{Purpose, Stream};

/// The undisplaced rocks of one layer.
///
/// Rock k of the selection has n rim vertices, which are the cell's, and as many top vertices. Its 3n − 2 triangles
/// hold indices into the rim (0 … n − 1) and the top (n … 2n − 1), counter-clockwise seen from above. The lists below
/// are sorted by the rocks' sites, so that rocks next to each other on the ground are close together in memory.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shapes {
    /// Per rock of the selection, its place in the sorted lists.
    places: Vec<u32>,
    /// rocks + 1 offsets into `top`. The triangles of a place start at 3 × its offset − 2 × the place.
    starts: Vec<u32>,
    top: Vec<DVec2>,
    triangles: Vec<[u16; 3]>,
}

impl Shapes {
    /// Number of rocks.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are no rocks.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of top vertices of all rocks together.
    pub fn top_vertices(&self) -> usize {
        self.top.len()
    }

    /// Number of triangles of all rocks together.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Bytes of memory that the shapes use.
    pub(super) fn bytes(&self) -> usize {
        bytes(&self.places) + bytes(&self.starts) + bytes(&self.top) + bytes(&self.triangles)
    }

    /// The points p_add of rock `k` before displacement, px.
    pub fn top_of(&self, k: usize) -> &[DVec2] {
        let place = self.places[k] as usize;
        &self.top[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// The triangles of rock `k`.
    pub fn triangles_of(&self, k: usize) -> &[[u16; 3]] {
        let place = self.places[k] as usize;
        let first = |place: usize| 3 * self.starts[place] as usize - 2 * place;
        &self.triangles[first(place)..first(place + 1)]
    }
}

/// Builds a layer's shapes, some rocks per step.
#[derive(Debug)]
pub(crate) struct Shaper {
    shapes: Shapes,
    /// The rocks' numbers in the selection, sorted by ascending site.
    rocks: Vec<u32>,
    triangulator: Triangulator,
    sampler: PolygonSampler,
    seed: u32,
    layer: u32,
}

impl Shaper {
    /// `selected` holds the selected sites, `sites` is the number of sites in the layer, and `layer` is the layer's id.
    pub(crate) fn new(selected: &[u32], sites: usize, seed: u32, layer: u32) -> Self {
        // Cells have six vertices on average; an eighth is added for safety. Counting them would need a pass over all
        // cells.
        let rim_vertices = 6 * selected.len() + selected.len() / 8;
        let mut shapes = Shapes {
            places: Vec::new(),
            starts: Vec::with_capacity(selected.len() + 1),
            top: Vec::with_capacity(rim_vertices),
            triangles: Vec::with_capacity(3 * rim_vertices),
        };
        shapes.starts.push(0);
        let rocks = in_order_of_sites(selected, sites);
        Shaper { shapes, rocks, triangulator: Triangulator::default(), sampler: PolygonSampler::default(), seed, layer }
    }

    /// Shapes up to `count` more rocks. Returns true when all are done.
    #[inline(never)]
    pub(crate) fn advance(&mut self, cells: &Cells, selected: &[u32], count: usize) -> bool {
        let from = self.shapes.starts.len() - 1;
        let to = (from + count).min(selected.len());
        for place in from..to {
            let site = selected[self.rocks[place] as usize];
            self.add_rock(cells.polygon(site as usize), site);
        }
        to == selected.len()
    }

    fn add_rock(&mut self, rim: &[DVec2], site: u32) {
        let mut stream = Stream::new(self.seed, Purpose::TopPoints, self.layer, site);
        let Shaper { shapes: Shapes { top, triangles, .. }, triangulator, sampler, .. } = self;
        sampler.start(rim);
        triangulator.add_rock(rim, top, triangles, || sampler.draw(&mut stream));
        self.shapes.starts.push(self.shapes.top.len() as u32);
    }

    pub(crate) fn progress(&self) -> f64 {
        (self.shapes.starts.len() - 1) as f64 / self.rocks.len().max(1) as f64
    }

    pub(crate) fn finish(mut self) -> Shapes {
        self.shapes.places = vec![0; self.rocks.len()];
        for (place, &rock) in (0..).zip(&self.rocks) {
            self.shapes.places[rock as usize] = place;
        }
        self.shapes.top.shrink_to_fit();
        self.shapes.triangles.shrink_to_fit();
        self.shapes
    }
}

/// The numbers 0 … n − 1 of the selected cells, sorted by ascending site. A site is selected at most once, so a
/// counting sort is enough.
pub(super) fn in_order_of_sites(selected: &[u32], sites: usize) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut rock_of = vec![NONE; sites];
    for (rock, &site) in (0..).zip(selected) {
        rock_of[site as usize] = rock;
    }
    rock_of.retain(|&rock| rock != NONE);
    rock_of.shrink_to_fit();
    rock_of
}

/// Draws points uniformly by area from a convex polygon (decision A12), which is split into a fan of triangles.
#[derive(Debug, Default)]
struct PolygonSampler {
    origin: DVec2,
    /// Per triangle of the fan: its two edge vectors, the sum of the parallelograms' areas before it, and the
    /// reciprocal of its own parallelogram's area.
    fan: Vec<(DVec2, DVec2, f64, f64)>,
    bounds: Vec<f64>,
    double_area: f64,
}

impl PolygonSampler {
    fn start(&mut self, polygon: &[DVec2]) {
        self.origin = polygon[0];
        self.fan.clear();
        self.bounds.clear();
        self.double_area = 0.0;
        let mut u = polygon[1] - self.origin;
        for &vertex in &polygon[2..] {
            let v = vertex - self.origin;
            let area = u.perp_dot(v);
            self.fan.push((u, v, self.double_area, 1.0 / area));
            self.double_area += area;
            self.bounds.push(self.double_area);
            u = v;
        }
        self.bounds.pop();
    }

    /// Draws a point: chooses a triangle by area, then a point of its parallelogram; a point in the far half is folded
    /// back.
    #[inline]
    fn draw(&self, stream: &mut Stream) -> DVec2 {
        // Each draw would take a different branch, so arithmetic is used instead.
        let place = stream.unit() * self.double_area;
        let t = stream.unit();
        let passed: usize = self.bounds.iter().map(|&bound| usize::from(place >= bound)).sum();
        let (u, v, start, scale) = self.fan[passed];
        // The remainder of the first number within the chosen triangle is uniform too, so it is used again.
        let s = (place - start) * scale;
        let beyond = f64::from(u8::from(s + t > 1.0));
        let (s, t) = (s + beyond * (1.0 - 2.0 * s), t + beyond * (1.0 - 2.0 * t));
        self.origin + u * s + v * t
    }
}

/// The random numbers j1 and j2 of Eqs 2 and 3 for one rock.
#[derive(Debug)]
pub(crate) struct Swings {
    rock: [f64; 2],
    vertex: [Stream; 2],
    shared: bool,
}

impl Swings {
    pub(crate) fn new(seed: u32, layer: u32, site: u32, swing: Swing) -> Self {
        let stream = |purpose| Stream::new(seed, purpose, layer, site);
        let j1 = stream(Purpose::RockSwing).unit();
        let j2 = stream(Purpose::VertexSwing);
        match swing {
            Swing::Shared => Swings { rock: [j1, j1], vertex: [j2.clone(), j2], shared: true },
            Swing::Separate => Swings {
                rock: [j1, stream(Purpose::RockSwingHeight).unit()],
                vertex: [j2, stream(Purpose::VertexSwingHeight)],
                shared: false,
            },
        }
    }

    /// Draws the next vertex's numbers: (j1, j2) for Eq. 2, then (j1, j2) for Eq. 3.
    fn next(&mut self) -> [[f64; 2]; 2] {
        let width = self.vertex[0].unit();
        let height = if self.shared { width } else { self.vertex[1].unit() };
        [[self.rock[0], width], [self.rock[1], height]]
    }
}

/// Displaces the p_add of one rock (Eqs 2 and 3): each moves outward from their mean g_add by a step, and up. Calls
/// `moved` with each displaced point, px.
///
/// `swings` must return (j1, j2) for Eq. 2 and (j1, j2) for Eq. 3, once per vertex. A p_add that equals g_add has no
/// direction and stays (decision A15). A negative step moves inward, and through g_add if it is longer than the
/// distance.
pub fn displace(
    top: &[DVec2],
    taper: [f64; 3],
    height: [f64; 3],
    mut swings: impl FnMut() -> [[f64; 2]; 2],
    mut moved: impl FnMut(DVec3),
) {
    let g_add = top.iter().sum::<DVec2>() / top.len() as f64;
    for &p_add in top {
        let [[j1, j2], [j1_height, j2_height]] = swings();
        let step = taper[0] + taper[1] * j1 + taper[2] * j2;
        let z = height[0] + height[1] * j1_height + height[2] * j2_height;
        let direction = p_add - g_add;
        let distance = direction.length();
        let shift = if distance > 0.0 { direction * (step / distance) } else { DVec2::ZERO };
        moved((p_add + shift).extend(z));
    }
}

impl Swings {
    /// Displaces one rock's p_add with the random numbers of this rock; see [`displace`].
    pub(crate) fn displace(&mut self, top: &[DVec2], taper: [f64; 3], height: [f64; 3], moved: impl FnMut(DVec3)) {
        displace(top, taper, height, || self.next(), moved);
    }
}
