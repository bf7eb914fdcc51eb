//! The places where individuals can stand on a mesh given by the user: points drawn over its surface, however it is
//! divided into triangles.
//!
//! Darts are thrown at the surface, uniformly by area. A dart that lands too near an earlier foot is refused. This ends
//! when there are as many feet as a grown log of the same area has vertices (decision K6: `spacing` sets how dense a
//! colony can be). A foot's normal is the mean over the darts that fell around it, so it follows the log and not the
//! finest bumps of a scan.

use glam::DVec3;

use super::grid::Grid;
use super::log::Log;
use super::mesh::LogMesh;
use super::user_log::Surface;
use crate::rng::{Purpose, Stream};

/// No two feet on one side of the surface are closer than this share of the spacing. Discs at this distance jam at 0.55
/// of the area, and the feet wanted take 0.38 of it, so about four darts per foot are enough.
const APART: f64 = 0.65;
/// Two feet whose normals have a smaller cosine than this stand on the two sides of a thin wall.
const SAME_SIDE: f64 = -0.5;
/// Largest number of darts per foot wanted. A rough surface has more area than room for feet.
const MOST_DARTS: f64 = 20.0;

/// Number of feet wanted: as many as a grown log of this area (cm²) and spacing (cm) has vertices.
pub(super) fn wanted(area: f64, spacing: f64) -> f64 {
    (area / (0.75_f64.sqrt() * spacing * spacing)).round().max(1.0)
}

/// Draws feet, some darts per step.
#[derive(Debug)]
pub(super) struct Feet {
    pub(super) spacing: f64,
    stream: Stream,
    wanted: f64,
    thrown: f64,
    grid: Grid,
    points: Vec<DVec3>,
    /// Per foot, the normal of its triangle, and the sum of the normals of the darts around it.
    faces: Vec<DVec3>,
    sums: Vec<DVec3>,
    triangles: Vec<u32>,
}

impl Feet {
    pub(super) fn new(surface: &Surface, spacing: f64) -> Self {
        let wanted = wanted(surface.area(), spacing);
        Feet {
            spacing,
            stream: Stream::new(0, Purpose::Feet, 0, 0),
            wanted,
            thrown: 0.0,
            grid: Grid::new(APART * spacing, wanted as usize),
            points: Vec::with_capacity(wanted as usize),
            faces: Vec::with_capacity(wanted as usize),
            sums: Vec::with_capacity(wanted as usize),
            triangles: Vec::with_capacity(wanted as usize),
        }
    }

    /// Throws up to `darts` darts. Returns true when all feet are drawn.
    pub(super) fn advance(&mut self, surface: &Surface, mesh: &LogMesh, darts: usize) -> bool {
        let apart = APART * self.spacing;
        for _ in 0..darts {
            if self.points.len() as f64 >= self.wanted || self.thrown >= MOST_DARTS * self.wanted {
                return true;
            }
            self.thrown += 1.0;
            let (triangle, point, normal) = surface.dart(mesh, &mut self.stream);
            let mut is_free = true;
            let (points, faces, sums) = (&self.points, &self.faces, &mut self.sums);
            self.grid.near(point, |foot| {
                let foot = foot as usize;
                if points[foot].distance_squared(point) < apart * apart && faces[foot].dot(normal) > SAME_SIDE {
                    is_free = false;
                    sums[foot] += normal;
                }
            });
            if is_free {
                self.grid.add(point);
                self.points.push(point);
                self.faces.push(normal);
                self.sums.push(normal);
                self.triangles.push(triangle);
            }
        }
        false
    }

    pub(super) fn progress(&self) -> f64 {
        (self.points.len() as f64 / self.wanted).max(self.thrown / (MOST_DARTS * self.wanted))
    }

    /// Returns the feet as the vertices of a log, and for each foot the triangle that it is on.
    pub(super) fn finish(self) -> (Log, Vec<u32>) {
        let normals = self.sums.iter().zip(&self.faces).map(|(sum, face)| sum.normalize_or(*face)).collect();
        (Log { points: self.points, normals, ..Log::default() }, self.triangles)
    }
}
