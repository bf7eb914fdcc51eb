//! The log as something that individuals keep out of.

use glam::DVec3;

use super::log::Log as LogMesh;
use super::shape::LogShape;
use super::work::tally;
use crate::params::wood_ear::Log;

/// cm between the places whose radius is tabulated: as fine as the mesh that is seen.
const CELL: f64 = 0.8;

/// A grown log, or one of the user's own.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ground {
    Grown(Box<Grown>),
    Given(Given),
}

impl Ground {
    /// How far a body is lifted off the place it stands on: its outer sheet would lie in the furrows otherwise.
    pub(super) fn lift(&self) -> f64 {
        match self {
            Ground::Grown(grown) => grown.margin + 0.02,
            Ground::Given(_) => GIVEN_MARGIN + 0.02,
        }
    }

    /// Whether a point is outside the log and, with `earth`, above the earth that a grown log lies on; `up` leads out of the log nearby.
    pub(super) fn is_clear(&self, point: DVec3, up: DVec3, earth: bool) -> bool {
        tally(100);
        match self {
            Ground::Grown(grown) => (point.z > 0.0 || !earth) && grown.is_clear(point),
            Ground::Given(given) => !given.holds(point) && !given.holds(point - GIVEN_MARGIN * up),
        }
    }
}

/// cm that bodies keep from a log of the user's own.
const GIVEN_MARGIN: f64 = 0.05;

/// Cells that the plane below a log of the user's own is cut into along its longer side, at most.
const MOST_CELLS: f64 = 512.0;

/// A closed mesh, its triangles by the cell of the plane they lie over.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Given {
    /// Which log it is.
    pub(super) number: u32,
    low: DVec3,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    over: Vec<u32>,
    corners: Vec<[DVec3; 3]>,
}

impl Given {
    pub(super) fn new(number: u32, log: &LogMesh) -> Self {
        let low = log.points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let size = log.points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max) - low;
        let cell = (size.x.max(size.y) / MOST_CELLS).max(0.5);
        let [columns, rows] = [size.x, size.y].map(|side| (side / cell) as usize + 1);
        let corners: Vec<[DVec3; 3]> = log.triangles.iter().map(|t| t.map(|v| log.points[v as usize] - low)).collect();
        let mut given =
            Given { number, low, cell, columns, rows, starts: vec![0; columns * rows + 1], over: Vec::new(), corners };
        // Counted, then filled in from the back.
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
        for (triangle, [a, b, c]) in (0..).zip(&self.corners) {
            let [least, most] = [a.min(*b).min(*c), a.max(*b).max(*c)].map(|p| [p.x / self.cell, p.y / self.cell]);
            for row in least[1] as usize..=most[1] as usize {
                for column in least[0] as usize..=most[0] as usize {
                    each(&mut self.starts, &mut self.over, row * self.columns + column, triangle);
                }
            }
        }
    }

    /// Whether a point is inside: a ray upward leaves the log an odd number of times.
    fn holds(&self, point: DVec3) -> bool {
        // A little aside, where no edge of a modelled log stands.
        let p = point - self.low + DVec3::new(1.3e-7, 2.1e-7, 0.0);
        let [x, y] = [p.x / self.cell, p.y / self.cell];
        if !(x >= 0.0 && y >= 0.0 && x < self.columns as f64 && y < self.rows as f64) {
            return false;
        }
        let cell = y as usize * self.columns + x as usize;
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

/// The grown log's radius as a table, many times faster than its noise.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grown {
    shape: LogShape,
    log: Log,
    /// The mesh that is seen is flat between its vertices: it stands out from the table by less than this, cm.
    margin: f64,
    rows: usize,
    columns: usize,
    /// Row by row along the log, each once around it.
    radii: Vec<f32>,
}

impl Grown {
    pub(super) fn new(log: Log) -> Self {
        let shape = LogShape::new(log);
        // The ends reach out by as much as they are broken.
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

    /// Whether it is the ground of this log.
    pub(super) fn is_of(&self, log: &Log) -> bool {
        self.log == *log && self.radii.len() == self.rows * self.columns
    }

    /// Fills in about so many places. True when all are.
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

    /// Every place takes the highest of its neighbourhood: furrows are narrower than the mesh that is seen can show, and wood ears lie
    /// on the ridges.
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

    /// Between the four nearest places.
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

/// A direction as a number 0 … 4 that grows with its angle: where its ray leaves the square with corners on the axes.
fn turned([cos, sin]: [f64; 2]) -> f64 {
    let a = sin / (cos.abs() + sin.abs());
    match (cos >= 0.0, sin >= 0.0) {
        (true, true) => a,
        (false, _) => 2.0 - a,
        (true, false) => 4.0 + a,
    }
}

/// The direction of such a number.
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
