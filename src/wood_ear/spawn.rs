//! Which vertices of the log carry an individual, and how it stands there \[3.2\].

use glam::DVec3;

use super::circle::turn;
use super::log::Log;
use crate::params::wood_ear::Params;
use crate::rng::{Purpose, Stream};

/// One individual's place: +y of its own frame is the vertex normal, the origin its foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Individual {
    /// Vertex of the log it stands on, or foot on one of the user's own; its random streams hang on it.
    pub vertex: u32,
    /// The nearest base within range.
    pub base: u8,
    /// Foot, cm.
    pub foot: DVec3,
    /// Its own x, y and z in the world, orthonormal and right-handed.
    pub axes: [DVec3; 3],
}

impl Individual {
    /// From its own frame to the world.
    pub(super) fn to_world(self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        p.x * x + p.y * y + p.z * z + self.foot
    }
}

/// Vertices that carry individuals, ascending.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spawn {
    /// One per vertex at most.
    pub individuals: Vec<Individual>,
    /// Per base the nearest vertex of the log, the lower one of equals.
    pub bases: Vec<u32>,
}

/// The vertex nearest to a point, the lowest of equals.
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

/// Every vertex of the log within `range` of a base carries an individual with probability density / 100 (decision K6).
///
/// Each vertex draws from its own stream: a greater density or range adds individuals and moves none.
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
            // The thesis does not mention it, but without a turn of its own each would face the same way (decision K6).
            let [cos, sin] = turn(Stream::new(params.seed, Purpose::Twist, 0, vertex).unit());
            let [t, u] = tangents(normal);
            let x = cos * t + sin * u;
            individuals.push(Individual { vertex, base, foot, axes: [x, normal, x.cross(normal)] });
        }
    }
    Spawn { individuals, bases }
}

/// Two directions that are orthonormal with a unit normal.
fn tangents(normal: DVec3) -> [DVec3; 2] {
    let aside = if normal.z.abs() < 0.7 { DVec3::Z } else { DVec3::X };
    let t = aside.cross(normal).normalize_or(DVec3::Y);
    [t, normal.cross(t)]
}
