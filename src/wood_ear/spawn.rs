//! Decides which vertices of the log carry an individual, and how it stands there \[3.2\].

use glam::DVec3;

use super::circle::turn;
use super::log::Log;
use crate::params::wood_ear::Params;
use crate::rng::{Purpose, Stream};

/// The place of one individual. In its own frame, the origin is its foot and +y is the normal of the log's vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Individual {
    /// The vertex of the log that it stands on; on a log given by the user, the number of the foot. Its random streams
    /// depend on this number.
    pub vertex: u32,
    /// Index of the nearest base within range.
    pub base: u8,
    /// Position of the foot, cm.
    pub foot: DVec3,
    /// The x, y and z axes of its own frame in the world: orthonormal and right-handed.
    pub axes: [DVec3; 3],
}

impl Individual {
    /// Converts a point from the individual's own frame to the world.
    pub(super) fn to_world(self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        p.x * x + p.y * y + p.z * z + self.foot
    }
}

/// The individuals of a colony, in ascending order of their vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spawn {
    /// At most one per vertex of the log.
    pub individuals: Vec<Individual>,
    /// Per base, the nearest vertex of the log; of equally near ones, the lowest.
    pub bases: Vec<u32>,
}

/// The log's vertex nearest to a point; of equally near ones, the lowest.
pub(super) fn nearest(log: &Log, point: DVec3) -> u32 {
    let mut best = (f64::INFINITY, 0);
    for (vertex, at) in (0..).zip(&log.points) {
        let distance = at.distance_squared(point);
        if distance < best.0 {
            best = (distance, vertex);
        }
    }
    best.1
}

/// Lets every vertex of the log within `range` of a base carry an individual with probability density / 100 (decision
/// K6).
///
/// Each vertex draws from its own random stream, so a greater density or range adds individuals and moves none.
pub fn spawn(params: &Params, log: &Log) -> Spawn {
    let bases: Vec<u32> = params.bases.iter().map(|base| nearest(log, DVec3::from_array(base.position))).collect();
    let mut individuals = Vec::new();
    for (vertex, (&foot, &normal)) in (0..).zip(log.points.iter().zip(&log.normals)) {
        let mut found: Option<(f64, u8)> = None;
        for (index, (base, &at)) in (0..).zip(params.bases.iter().zip(&bases)) {
            let distance = log.points[at as usize].distance(foot);
            if distance <= base.range.unwrap_or(params.range) && found.is_none_or(|(best, _)| distance < best) {
                found = Some((distance, index));
            }
        }
        let Some((_, base)) = found else { continue };
        if Stream::new(params.seed, Purpose::Spawn, 0, vertex).unit() < params.density / 100.0 {
            // The thesis does not mention it, but without a random turn all individuals would face the same way
            // (decision K6).
            let [cos, sin] = turn(Stream::new(params.seed, Purpose::Twist, 0, vertex).unit());
            let [t, u] = tangents(normal);
            let x = cos * t + sin * u;
            individuals.push(Individual { vertex, base, foot, axes: [x, normal, x.cross(normal)] });
        }
    }
    Spawn { individuals, bases }
}

/// Two unit directions that are perpendicular to a unit normal and to each other.
fn tangents(normal: DVec3) -> [DVec3; 2] {
    let aside = if normal.z.abs() < 0.7 { DVec3::Z } else { DVec3::X };
    let t = aside.cross(normal).normalize_or(DVec3::Y);
    [t, normal.cross(t)]
}
