//! The log as an obstacle that individuals keep out of.

use glam::{DVec3, Vec3};

use super::mesh::LogMesh;
use super::pairs::Bounds;
use super::shape::LogShape;
use super::work::tally;
use crate::params::wood_ear::Log as LogParams;

/// Distance between the places at which the radius is tabulated, cm: the spacing of the visible mesh.
const CELL: f64 = 0.8;

/// The obstacle: a grown log, or a log given by the user.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ground {
    Grown(Box<Grown>),
    Given(Given),
}

impl Ground {
    /// How far a body is lifted off the place it stands on, cm. Without this, its outer sheet would lie in the furrows
    /// of the bark.
    pub(super) fn lift(&self) -> f64 {
        match self {
            Ground::Grown(grown) => grown.margin + 0.02,
            Ground::Given(_) => GIVEN_MARGIN + 0.02,
        }
    }

    /// Whether a point is outside the log and, with `earth`, above the ground that a grown log lies on. `up` is a
    /// direction that leads out of the log near the point.
    pub(super) fn is_clear(&self, point: DVec3, up: DVec3, earth: bool) -> bool {
        tally(100);
        match self {
            Ground::Grown(grown) => (point.z > 0.0 || !earth) && grown.is_clear(point),
            Ground::Given(given) => !given.holds(point) && !given.holds(point - GIVEN_MARGIN * up),
        }
    }
}

/// Distance that bodies keep from a log given by the user, cm.
const GIVEN_MARGIN: f64 = 0.05;

/// Largest number of cells along the longer side of the grid under a log given by the user.
const MOST_CELLS: f64 = 512.0;

/// A grid in the plane under a log given by the user.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Cells {
    /// The corner of the log's box with the smallest coordinates.
    low: DVec3,
    /// Length of a cell's side, cm.
    side: f64,
    columns: usize,
    rows: usize,
}

impl Cells {
    pub(super) fn under(mesh: &LogMesh) -> Self {
        let points = mesh.positions.chunks_exact(3).map(|p| Vec3::from_slice(p).as_dvec3());
        let Bounds { min: low, max } = Bounds::of(points);
        let size = max - low;
        let side = (size.x.max(size.y) / MOST_CELLS).max(0.5);
        let [columns, rows] = [size.x, size.y].map(|length| (length / side) as usize + 1);
        Cells { low, side, columns, rows }
    }

    /// Number of bytes that [`Given::new`] allocates for this log. A long triangle may lie over very many cells.
    pub(super) fn bytes(mesh: &LogMesh) -> f64 {
        let cells = Cells::under(mesh);
        let over = mesh.triangles().map(|corners| {
            let [least, most] = cells.covered(corners.map(|p| p - cells.low));
            ((most[0] - least[0] + 1) * (most[1] - least[1] + 1)) as f64
        });
        (24 * mesh.indices.len() + 4 * cells.columns * cells.rows) as f64 + 4.0 * over.sum::<f64>()
    }

    /// The first and the last column and row that a triangle's box lies over. Its corners are relative to the lowest
    /// corner of the log.
    fn covered(&self, [a, b, c]: [DVec3; 3]) -> [[usize; 2]; 2] {
        [a.min(b).min(c), a.max(b).max(c)].map(|p| [(p.x / self.side) as usize, (p.y / self.side) as usize])
    }
}

/// A closed mesh given by the user, with its triangles sorted by the cells that they lie over.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Given {
    cells: Cells,
    starts: Vec<u32>,
    over: Vec<u32>,
    corners: Vec<[DVec3; 3]>,
}

impl Given {
    pub(super) fn new(mesh: &LogMesh) -> Self {
        let cells = Cells::under(mesh);
        let corners: Vec<[DVec3; 3]> = mesh.triangles().map(|corners| corners.map(|p| p - cells.low)).collect();
        let mut given = Given { cells, starts: vec![0; cells.columns * cells.rows + 1], over: Vec::new(), corners };
        // The triangles per cell are counted first, and then filled in from the back.
        given.visit(|starts, _, cell, _| starts[cell] += 1);
        let mut sum = 0;
        for start in &mut given.starts {
            sum += *start;
            *start = sum;
        }
        given.over = vec![0; sum as usize];
        given.visit(|starts, over, cell, triangle| {
            starts[cell] -= 1;
            over[starts[cell] as usize] = triangle;
        });
        given
    }

    fn visit(&mut self, mut each: impl FnMut(&mut [u32], &mut [u32], usize, u32)) {
        for (triangle, corners) in (0..).zip(&self.corners) {
            let [least, most] = self.cells.covered(*corners);
            for row in least[1]..=most[1] {
                for column in least[0]..=most[0] {
                    each(&mut self.starts, &mut self.over, row * self.cells.columns + column, triangle);
                }
            }
        }
    }

    /// Whether a point is inside the log: a ray upward from there leaves the log an odd number of times.
    fn holds(&self, point: DVec3) -> bool {
        // The ray is moved aside a little, so that it does not hit an edge of a modelled log.
        let Cells { low, side, columns, rows } = self.cells;
        let p = point - low + DVec3::new(1.3e-7, 2.1e-7, 0.0);
        let [x, y] = [p.x / side, p.y / side];
        if !(x >= 0.0 && y >= 0.0 && x < columns as f64 && y < rows as f64) {
            return false;
        }
        let cell = y as usize * columns + x as usize;
        let over = &self.over[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        let mut inside = false;
        for triangle in over {
            let [a, b, c] = self.corners[*triangle as usize].map(|q| q - p);
            let turn = |a: DVec3, b: DVec3| a.x * b.y - a.y * b.x;
            let [u, v, w] = [turn(b, c), turn(c, a), turn(a, b)];
            let over = (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0);
            inside ^= over && (u * a.z + v * b.z + w * c.z) * (u + v + w) > 0.0;
        }
        inside
    }
}

/// The radius of a grown log as a table, which is many times faster than computing its noise.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grown {
    shape: LogShape,
    log: LogParams,
    /// The visible mesh is flat between its vertices, so it may stand out from the table. This is an upper bound of how
    /// far, cm.
    margin: f64,
    rows: usize,
    columns: usize,
    /// The radii, cm: row by row along the log, each row once around it.
    radii: Vec<f32>,
}

impl Grown {
    pub(super) fn new(log: LogParams) -> Self {
        let shape = LogShape::new(log);
        // Broken ends extend beyond the log's length.
        let rows = ((log.length + 2.0 * log.radius) / CELL) as usize + 2;
        let columns = 4 * ((std::f64::consts::TAU * log.radius / CELL / 4.0) as usize + 2);
        Grown {
            shape,
            log,
            margin: 0.04 + 0.03 * log.bark * log.radius.sqrt(),
            rows,
            columns,
            radii: Vec::with_capacity(rows * columns),
        }
    }

    /// Computes up to `places` more places. Returns true when all are computed.
    pub(super) fn advance(&mut self, places: usize) -> bool {
        let to = (self.radii.len() + places).min(self.rows * self.columns);
        for place in self.radii.len()..to {
            let along = (place / self.columns) as f64 * CELL - self.reach();
            let turned = (place % self.columns) as f64 * 4.0 / self.columns as f64;
            self.radii.push(self.shape.radius(along, direction(turned)) as f32);
        }
        let done = to == self.rows * self.columns;
        if done {
            self.fill_furrows();
        }
        done
    }

    /// Replaces every radius by the largest one of its neighbourhood. Furrows are narrower than the visible mesh can
    /// show, and wood ears lie on the ridges.
    fn fill_furrows(&mut self) {
        for stride in [1, self.columns] {
            let radii = &self.radii;
            let around = |k: usize| {
                let row = k / self.columns * self.columns;
                let [before, after] = if stride == 1 {
                    [row + (k - row + self.columns - 1) % self.columns, row + (k - row + 1) % self.columns]
                } else {
                    [k.saturating_sub(stride), (k + stride).min(radii.len() - 1)]
                };
                radii[k].max(radii[before]).max(radii[after])
            };
            self.radii = (0..radii.len()).map(around).collect();
        }
    }

    pub(super) fn progress(&self) -> f64 {
        self.radii.len() as f64 / (self.rows * self.columns) as f64
    }

    fn reach(&self) -> f64 {
        0.5 * self.log.length + self.log.radius
    }

    fn is_clear(&self, point: DVec3) -> bool {
        self.shape.depth(point, |along, direction| self.radius(along, direction)) < -self.margin
    }

    /// The radius at a place along the axis and a direction, interpolated between the four nearest places of the table.
    fn radius(&self, along: f64, direction: [f64; 2]) -> f64 {
        let row = ((along + self.reach()) / CELL).max(0.0).min((self.rows - 2) as f64);
        let column = turned(direction) * self.columns as f64 / 4.0;
        let (r, c) = (row as usize, column as usize % self.columns);
        let next = (c + 1) % self.columns;
        let [s, t] = [row - row.floor(), column - column.floor()];
        let line = |r: usize| {
            let [a, b] = [c, next].map(|c| f64::from(self.radii[r * self.columns + c]));
            a + (b - a) * t
        };
        line(r) + (line(r + 1) - line(r)) * s
    }
}

/// Converts a direction to a number 0 … 4 that grows with its angle: where its ray leaves the square that has its
/// corners on the axes.
fn turned([cos, sin]: [f64; 2]) -> f64 {
    let a = sin / (cos.abs() + sin.abs());
    match (cos >= 0.0, sin >= 0.0) {
        (true, true) => a,
        (false, _) => 2.0 - a,
        (true, false) => 4.0 + a,
    }
}

/// Converts such a number back to a direction.
fn direction(turned: f64) -> [f64; 2] {
    let quarter = turned.floor();
    let a = turned - quarter;
    let [x, y] = match quarter as u8 {
        0 => [1.0 - a, a],
        1 => [-a, 1.0 - a],
        2 => [a - 1.0, -a],
        _ => [a, a - 1.0],
    };
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_and_their_numbers_belong_together() {
        for k in 0..4000 {
            let n = f64::from(k) * 0.001;
            assert!((turned(direction(n)) - n).abs() < 1.0e-12, "{n}");
        }
    }
}
