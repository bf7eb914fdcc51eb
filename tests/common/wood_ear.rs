//! What the tests of wood ears share.

use glam::DVec3;
use rock_field::params::wood_ear::{Collisions, Log, Params};
use rock_field::wood_ear::Generator;

use super::Random;

/// A finished run, and the positions that it showed before its collisions.
pub struct Run {
    pub generator: Generator,
    pub preview: Vec<f32>,
}

pub fn run(params: &Params) -> Run {
    let mut generator = Generator::new();
    generator.start(params.clone(), u64::MAX).unwrap();
    let mut preview = None;
    loop {
        if preview.is_none() && generator.preview_ready() {
            preview = Some(generator.mesh().positions.clone());
        }
        if generator.step().unwrap() {
            break;
        }
    }
    let preview = preview.unwrap_or_else(|| generator.mesh().positions.clone());
    Run { generator, preview }
}

/// 0 … 1, and both ends often.
pub fn unit_or_end(random: &mut Random) -> f64 {
    if random.chance(0.3) { random.pick(&[0.0, 1.0]) } else { random.unit() }
}

/// Individuals of any shape and rule, with rings and meridians as `fineness` draws them; everything else at its default.
pub fn random_individuals(random: &mut Random, fineness: impl Fn(&mut Random) -> [u32; 2]) -> Params {
    let off = |random: &mut Random, most: f64| if random.chance(0.5) { 0.0 } else { most * random.unit() };
    let (moisture, wrinkles) = (100.0 * unit_or_end(random), 100.0 * unit_or_end(random));
    let (size, size_spread) = (random.between(1.0, 3.0), random.between(1.0, 2.0));
    let [rings, meridians] = fineness(random);
    Params {
        moisture,
        wrinkles,
        size,
        size_spread,
        rings,
        meridians,
        per_individual: unit_or_end(random),
        collisions: random.pick(&Collisions::ALL),
        droop: off(random, 1.0),
        thickness: off(random, 0.4),
        foot: off(random, 1.0),
        clear_log: random.chance(0.3),
        ..Params::with_defaults()
    }
}

/// A short log with some hundred individuals.
pub fn small() -> Params {
    let mut params = Params { range: 26.0, ..Params::with_defaults() };
    params.log = Log { length: 60.0, radius: 9.0, bend: 0.3, bark: 0.5, spacing: 3.0, seed: 1 };
    params.bases[0].position = [2.0, -6.0, 14.0];
    params
}

/// Vertices above the ground, other than those of stalks, that are inside the log that is seen: a ray upward leaves it an odd
/// number of times.
pub fn vertices_in_log(generator: &Generator) -> Vec<DVec3> {
    let (log, mesh, layout) = (generator.log_mesh(), generator.mesh(), generator.layout());
    let at = |positions: &[f32], v: u32| {
        let k = 3 * v as usize;
        DVec3::new(positions[k].into(), positions[k + 1].into(), positions[k + 2].into())
    };
    // Triangles by the cells of the plane they lie over.
    const CELL: f64 = 1.0;
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for v in 0..log.positions.len() as u32 / 3 {
        (low, high) = (low.min(at(&log.positions, v)), high.max(at(&log.positions, v)));
    }
    let columns = ((high.x - low.x) / CELL) as usize + 1;
    let rows = ((high.y - low.y) / CELL) as usize + 1;
    let mut cells = vec![Vec::new(); columns * rows];
    let cell = |p: DVec3| [((p.x - low.x) / CELL) as usize, ((p.y - low.y) / CELL) as usize];
    for t in log.indices.chunks_exact(3) {
        let corners = [t[0], t[1], t[2]].map(|v| at(&log.positions, v));
        let [least, most] =
            [corners.into_iter().reduce(DVec3::min).unwrap(), corners.into_iter().reduce(DVec3::max).unwrap()]
                .map(cell);
        for y in least[1]..=most[1] {
            for x in least[0]..=most[0] {
                cells[y * columns + x].push(corners);
            }
        }
    }
    let body = usize::from(layout.vertices);
    let c = usize::from(layout.meridians);
    let sheets = usize::from(layout.rings) * c;
    let visible = if layout.thick { 2 * (sheets + c) } else { sheets };
    let mut inside = Vec::new();
    for v in 0..mesh.positions.len() / 3 {
        // An angle that no edge of the log has.
        let p = at(&mesh.positions, v as u32) + DVec3::new(1.234e-7, 2.345e-7, 0.0);
        let outside = p.x <= low.x || p.y <= low.y || p.x >= high.x || p.y >= high.y;
        if v % body >= visible && v % body != visible + c + 1 || outside || p.z <= 0.0 {
            continue;
        }
        let [x, y] = cell(p);
        let above = cells[y * columns + x].iter().filter(|corners| {
            let [a, b, c] = corners.map(|q| q - p);
            let turn = |a: DVec3, b: DVec3| a.x * b.y - a.y * b.x;
            let turns = [turn(a, b), turn(b, c), turn(c, a)];
            let over = turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0);
            over && (turns[0] * c.z + turns[1] * a.z + turns[2] * b.z) / turns.iter().sum::<f64>() > 0.0
        });
        if above.count() % 2 == 1 {
            inside.push(p);
        }
    }
    inside
}

/// A log of the user's own.
#[derive(Clone, Default)]
pub struct Mesh {
    pub positions: Vec<f32>,
    pub indices: Vec<u32>,
}

impl Mesh {
    pub fn points(&self) -> Vec<DVec3> {
        self.positions.chunks_exact(3).map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into())).collect()
    }

    pub fn turned(&self) -> Mesh {
        let indices = self.indices.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]]).collect();
        Mesh { indices, ..self.clone() }
    }

    pub fn scaled(&self, scale: f32) -> Mesh {
        Mesh { positions: self.positions.iter().map(|c| c * scale).collect(), ..self.clone() }
    }

    pub fn moved(&self, by: [f32; 3]) -> Mesh {
        let positions = self.positions.chunks_exact(3).flat_map(|p| [0, 1, 2].map(|k| p[k] + by[k])).collect();
        Mesh { positions, ..self.clone() }
    }

    pub fn with(&self, other: &Mesh) -> Mesh {
        let first = self.positions.len() as u32 / 3;
        Mesh {
            positions: [&self.positions[..], &other.positions].concat(),
            indices: self.indices.iter().copied().chain(other.indices.iter().map(|i| i + first)).collect(),
        }
    }

    /// Without every n-th triangle.
    pub fn with_holes(&self, n: usize) -> Mesh {
        let kept = self.indices.chunks_exact(3).enumerate().filter(|(k, _)| k % n != 0);
        Mesh { indices: kept.flat_map(|(_, t)| t.to_vec()).collect(), ..self.clone() }
    }

    /// Every triangle with vertices of its own.
    pub fn split(&self) -> Mesh {
        let corner = |i: &u32| self.positions[3 * *i as usize..3 * *i as usize + 3].to_vec();
        Mesh {
            positions: self.indices.iter().flat_map(corner).collect(),
            indices: (0..self.indices.len() as u32).collect(),
        }
    }
}

/// A closed cylinder along x, 2 m long and of radius 14 cm, of about so many vertices.
pub fn cylinder(vertices: usize) -> Mesh {
    // Squares along the side, a fan at each end.
    let around = ((vertices as f64 * 88.0 / 200.0).sqrt().round() as usize).max(6);
    let rows = (vertices - 2) / around;
    let mut mesh = Mesh::default();
    for row in 0..rows {
        for k in 0..around {
            let angle = k as f64 / around as f64 * std::f64::consts::TAU;
            let x = 200.0 * row as f64 / (rows - 1) as f64 - 100.0;
            mesh.positions.extend([x, 14.0 * angle.cos(), 14.0 * angle.sin() + 14.0].map(|c| c as f32));
        }
    }
    let at = |row: usize, k: usize| (row * around + k % around) as u32;
    for row in 0..rows - 1 {
        for k in 0..around {
            let [a, b, c, d] = [at(row, k), at(row + 1, k), at(row + 1, k + 1), at(row, k + 1)];
            mesh.indices.extend([a, c, b, a, d, c]);
        }
    }
    let ends = (rows * around) as u32;
    mesh.positions.extend([-100.0, 0.0, 14.0, 100.0, 0.0, 14.0]);
    for k in 0..around {
        mesh.indices.extend([ends, at(0, k + 1), at(0, k), ends + 1, at(rows - 1, k), at(rows - 1, k + 1)]);
    }
    mesh
}

/// The vertices of individual k in its own frame.
pub fn own(run: &Run, positions: &[f32], k: usize) -> Vec<DVec3> {
    let individual = run.generator.spawn().individuals[k];
    let step = 3 * usize::from(run.generator.layout().vertices);
    let points = positions[k * step..(k + 1) * step].chunks_exact(3);
    points
        .map(|p| {
            let p = DVec3::new(p[0].into(), p[1].into(), p[2].into()) - individual.foot;
            DVec3::from_array(individual.axes.map(|axis| axis.dot(p)))
        })
        .collect()
}
