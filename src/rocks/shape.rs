//! Stage 4: p_add and their triangulation (journal §3.3, Fig. 10), and the displacement (Eqs 2, 3).

use glam::{DVec2, DVec3};

use super::triangulate::Triangulator;
use super::voronoi::Cells;
use crate::params::Swing;
use crate::rng::{Purpose, Stream};

/// The undisplaced rocks of one layer, in the order of the selection.
///
/// Rock k has n = `starts[k + 1] - starts[k]` rim vertices (the cell's) and as many top vertices,
/// `top[starts[k] .. starts[k + 1]]`. Its 3n − 2 triangles begin at triangle 3·`starts[k]` − 2·k, as indices
/// into rim (0 … n − 1) and top (n … 2n − 1), counter-clockwise seen from above.
#[derive(Debug, Clone, Default)]
pub struct Shapes {
    /// rocks + 1 offsets.
    pub starts: Vec<u32>,
    /// p_add, px.
    pub top: Vec<DVec2>,
    /// Local indices.
    pub triangles: Vec<[u16; 3]>,
}

impl Shapes {
    /// Number of rocks.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is no rock.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// p_add of rock `k`.
    pub fn top_of(&self, k: usize) -> &[DVec2] {
        &self.top[self.starts[k] as usize..self.starts[k + 1] as usize]
    }

    /// Triangles of rock `k`.
    pub fn triangles_of(&self, k: usize) -> &[[u16; 3]] {
        let first = |k: usize| 3 * self.starts[k] as usize - 2 * k;
        &self.triangles[first(k)..first(k + 1)]
    }
}

/// Builds a layer's shapes in pieces.
#[derive(Debug)]
pub(crate) struct Shaper {
    shapes: Shapes,
    triangulator: Triangulator,
    sampler: PolygonSampler,
    seed: u32,
    layer: u32,
}

impl Shaper {
    pub(crate) fn new(selected: &[u32], seed: u32, layer: u32) -> Self {
        // Six cell vertices on average, and a little room; counting them would be a walk through all cells.
        let rim_vertices = 6 * selected.len() + selected.len() / 8;
        let mut shapes = Shapes {
            starts: Vec::with_capacity(selected.len() + 1),
            top: Vec::with_capacity(rim_vertices),
            triangles: Vec::with_capacity(3 * rim_vertices),
        };
        shapes.starts.push(0);
        Shaper { shapes, triangulator: Triangulator::default(), sampler: PolygonSampler::default(), seed, layer }
    }

    /// Shapes about `count` more rocks. True when all are done.
    pub(crate) fn advance(&mut self, cells: &Cells, selected: &[u32], count: usize) -> bool {
        let from = self.shapes.len();
        let to = (from + count).min(selected.len());
        for &site in &selected[from..to] {
            self.add_rock(cells.polygon(site as usize), site);
        }
        to == selected.len()
    }

    fn add_rock(&mut self, rim: &[DVec2], site: u32) {
        let mut stream = Stream::new(self.seed, Purpose::TopPoints, self.layer, site);
        let sampler = &mut self.sampler;
        sampler.start(rim);
        // A draw that rounding puts on the rim or on another point is drawn again; chances are below 1e-9.
        while !self.triangulator.start(rim, sampler.draw(&mut stream)) {}
        for _ in 1..rim.len() {
            while !self.triangulator.insert(sampler.draw(&mut stream)) {}
        }
        self.shapes.top.extend_from_slice(self.triangulator.inner(rim.len()));
        self.shapes.triangles.extend_from_slice(self.triangulator.triangles());
        self.shapes.starts.push(self.shapes.top.len() as u32);
    }

    pub(crate) fn progress(&self, selected: &[u32]) -> f64 {
        self.shapes.len() as f64 / selected.len().max(1) as f64
    }

    pub(crate) fn finish(mut self) -> Shapes {
        self.shapes.top.shrink_to_fit();
        self.shapes.triangles.shrink_to_fit();
        self.shapes
    }
}

/// Draws points uniformly by area from a convex polygon (decision A12), as a fan of triangles.
#[derive(Debug, Default)]
struct PolygonSampler {
    origin: DVec2,
    /// Per triangle of the fan: two edge vectors, and the parallelogram's area.
    fan: Vec<(DVec2, DVec2, f64)>,
    double_area: f64,
}

impl PolygonSampler {
    fn start(&mut self, polygon: &[DVec2]) {
        self.origin = polygon[0];
        self.fan.clear();
        self.double_area = 0.0;
        let mut u = polygon[1] - self.origin;
        for &vertex in &polygon[2..] {
            let v = vertex - self.origin;
            let area = u.perp_dot(v);
            self.fan.push((u, v, area));
            self.double_area += area;
            u = v;
        }
    }

    /// A triangle by area, then a point of it: of a parallelogram's two halves, the far one is folded back.
    #[inline]
    fn draw(&self, stream: &mut Stream) -> DVec2 {
        let mut rest = stream.unit() * self.double_area;
        let mut t = stream.unit();
        let mut chosen = self.fan[0];
        for &triangle in &self.fan {
            chosen = triangle;
            if rest < triangle.2 {
                break;
            }
            rest -= triangle.2;
        }
        let (u, v, area) = chosen;
        // What is left of the first number is uniform too; at the very end rounding can leave more than the area.
        let mut s = (rest / area).min(1.0);
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        self.origin + u * s + v * t
    }
}

/// The random numbers of Eqs 2 and 3 for one rock.
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

    /// (j1, j2) of Eq. 2 and of Eq. 3 for the next vertex.
    fn next(&mut self) -> [[f64; 2]; 2] {
        let width = self.vertex[0].unit();
        let height = if self.shared { width } else { self.vertex[1].unit() };
        [[self.rock[0], width], [self.rock[1], height]]
    }
}

/// Moves the p_add of one rock (Eqs 2 and 3): outward from their mean g_add by a step, and up.
///
/// `swings` gives (j1, j2) of Eq. 2 and of Eq. 3 per vertex. A p_add that equals g_add has no direction and stays
/// (decision A15); a negative step moves inward, and through g_add where it is longer than the distance.
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
    /// Displaces one rock with this rock's own numbers.
    pub(crate) fn displace(&mut self, top: &[DVec2], taper: [f64; 3], height: [f64; 3], moved: impl FnMut(DVec3)) {
        displace(top, taper, height, || self.next(), moved);
    }
}
