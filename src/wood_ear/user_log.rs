//! A log of the user's own: checked, welded, turned the right way out, and given normals.

use std::fmt;

use glam::DVec3;

use super::log::{Log, normals};
use crate::error::fill;
use crate::rng::Stream;

/// Vertices and triangles a log may have.
pub const MOST_VERTICES: usize = 200_000;
/// See [`MOST_VERTICES`].
pub const MOST_TRIANGLES: usize = 400_000;
/// cm; beyond it f32 no longer resolves a wood ear.
const REACH: f64 = 10_000.0;

/// Why a mesh cannot be a log. Nothing was changed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum LogError {
    /// Positions or indices do not come in threes.
    NotInThrees {
        /// How many numbers were given.
        value: usize,
    },
    /// More vertices or triangles than a log may have.
    TooLarge {
        /// How many were given.
        value: usize,
        /// How many are allowed.
        max: usize,
    },
    /// A coordinate is not finite, or farther than 100 m from the origin.
    BadPosition {
        /// The vertex.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// A triangle names a vertex that is not there.
    BadIndex {
        /// The triangle.
        triangle: usize,
        /// The index.
        value: u32,
        /// The largest index there could be; −1 where there is no vertex.
        max: f64,
    },
    /// No triangle has an area.
    NoArea,
}

impl LogError {
    /// Machine-readable name, stable across versions.
    pub fn code(&self) -> &'static str {
        match self {
            LogError::NotInThrees { .. } => "LogNotInThrees",
            LogError::TooLarge { .. } => "LogTooLarge",
            LogError::BadPosition { .. } => "LogBadPosition",
            LogError::BadIndex { .. } => "LogBadIndex",
            LogError::NoArea => "LogNoArea",
        }
    }

    /// Value, smallest and largest legal value; NaN where there is none.
    pub fn numbers(&self) -> [f64; 3] {
        match *self {
            LogError::NotInThrees { value } => [value as f64, f64::NAN, f64::NAN],
            LogError::TooLarge { value, max } => [value as f64, 0.0, max as f64],
            LogError::BadPosition { value, .. } => [value, -REACH, REACH],
            LogError::BadIndex { value, max, .. } => [f64::from(value), 0.0, max],
            LogError::NoArea => [f64::NAN; 3],
        }
    }

    /// The message for people; `number` writes a number, as JavaScript can: Rust's way takes 1 kB of the wasm file.
    pub(crate) fn message(&self, number: &dyn Fn(f64) -> String) -> String {
        let [value, _, max] = self.numbers();
        let (text, numbers) = match *self {
            LogError::NotInThrees { .. } => {
                ("the log's positions and its indices must come in threes; there are #", [value, max])
            }
            LogError::TooLarge { .. } => ("the log has # vertices or triangles; it may have at most #", [value, max]),
            LogError::BadPosition { vertex, .. } => {
                ("vertex # of the log has the coordinate #, not within 100 m of the origin", [vertex as f64, value])
            }
            LogError::BadIndex { triangle, .. } => {
                ("triangle # of the log names vertex #, which is not there", [triangle as f64, value])
            }
            LogError::NoArea => ("no triangle of the log has an area", [value, max]),
        };
        fill(text, &[], &numbers, number)
    }
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(&|n| n.to_string()))
    }
}

impl std::error::Error for LogError {}

/// A log of the user's own, and what feet are drawn with.
#[derive(Debug, Clone, Default)]
pub(super) struct Surface {
    pub(super) log: Log,
    /// Per triangle its number in the mesh that was given.
    pub(super) numbers: Vec<u32>,
    /// Whether the mesh was closed and inside out, and has been turned.
    pub(super) is_turned: bool,
    /// How many vertices were given.
    pub(super) given: usize,
    /// Per triangle the area of all up to it, cm².
    areas: Vec<f64>,
}

impl Surface {
    /// cm²
    pub(super) fn area(&self) -> f64 {
        self.areas.last().copied().unwrap_or_default()
    }

    /// A point of the surface, uniform by area: its triangle, where it is, and the triangle's normal.
    pub(super) fn dart(&self, stream: &mut Stream) -> (u32, DVec3, DVec3) {
        let at = stream.unit() * self.area();
        let triangle = self.areas.partition_point(|sum| *sum <= at).min(self.areas.len() - 1);
        let [a, b, c] = self.log.triangles[triangle].map(|v| self.log.points[v as usize]);
        let [u, v] = [stream.unit().sqrt(), stream.unit()];
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Z);
        (triangle as u32, a + u * ((1.0 - v) * (b - a) + v * (c - a)), normal)
    }
}

/// Checks a mesh, and welds vertices at the same place, as formats have them that split vertices for their normals. Vertices that no triangle
/// with an area uses are dropped.
pub(super) fn user_log(positions: &[f32], indices: &[u32]) -> Result<Surface, LogError> {
    if let Some(value) = [positions.len(), indices.len()].into_iter().find(|n| !n.is_multiple_of(3)) {
        return Err(LogError::NotInThrees { value });
    }
    for (value, max) in [(positions.len() / 3, MOST_VERTICES), (indices.len() / 3, MOST_TRIANGLES)] {
        if value > max {
            return Err(LogError::TooLarge { value, max });
        }
    }
    if let Some(at) = positions.iter().position(|c| !(-REACH..=REACH).contains(&f64::from(*c))) {
        return Err(LogError::BadPosition { vertex: at / 3, value: f64::from(positions[at]) });
    }
    let given: Vec<DVec3> =
        positions.chunks_exact(3).map(|p| DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]))).collect();
    if let Some(corner) = indices.iter().position(|v| *v as usize >= given.len()) {
        let max = given.len() as f64 - 1.0;
        return Err(LogError::BadIndex { triangle: corner / 3, value: indices[corner], max });
    }
    let welded = weld(&given);
    let mut number = vec![u32::MAX; given.len()];
    let triangles = indices.len() / 3;
    let (mut numbers, mut areas, mut area) = (Vec::with_capacity(triangles), Vec::with_capacity(triangles), 0.0);
    let mut log = Log::with_capacity(given.len(), triangles);
    for (triangle, corners) in (0..).zip(indices.chunks_exact(3)) {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(|v| welded[v as usize]);
        let [p, q, r] = [a, b, c].map(|v| given[v as usize]);
        let across = (q - p).cross(r - p);
        if a == b || b == c || c == a || across == DVec3::ZERO {
            continue;
        }
        area += 0.5 * across.length();
        areas.push(area);
        numbers.push(triangle);
        log.triangles.push([a, b, c].map(|v| {
            let slot = &mut number[v as usize];
            if *slot == u32::MAX {
                *slot = log.points.len() as u32;
                log.points.push(given[v as usize]);
            }
            *slot
        }));
    }
    if log.triangles.is_empty() {
        return Err(LogError::NoArea);
    }
    let is_turned = is_inside_out(&log);
    if is_turned {
        log.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    log.points.shrink_to_fit();
    log.normals = normals(&log.points, &log.triangles);
    log.kinds = vec![0; log.points.len()];
    log.coords = vec![[0.0; 2]; log.points.len()];
    Ok(Surface { log, numbers, is_turned, given: given.len(), areas })
}

/// Whether a mesh is closed and encloses a negative volume. What is open has no inside.
fn is_inside_out(log: &Log) -> bool {
    // Closed: every edge is there as often in one direction as in the other. The sum of hashes of the edges less those of the edges reversed is
    // then 0, and otherwise by chance alone, once in 2⁶⁴ meshes.
    let hash = |a: u32, b: u32| {
        let h = ((u64::from(a) << 32) | u64::from(b)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (h ^ (h >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9)
    };
    // From a vertex of its own: far from the origin the differences would be lost.
    let origin = log.points[0];
    let (mut sum, mut volume) = (0_u64, 0.0);
    for &[a, b, c] in &log.triangles {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            sum = sum.wrapping_add(hash(p, q)).wrapping_sub(hash(q, p));
        }
        let [p, q, r] = [a, b, c].map(|v| log.points[v as usize] - origin);
        volume += p.dot(q.cross(r));
    }
    sum == 0 && volume < 0.0
}

/// Per vertex the first one at the same place, found through a table of places with open addressing.
fn weld(points: &[DVec3]) -> Vec<u32> {
    let slots = (2 * points.len()).next_power_of_two();
    let mut table = vec![u32::MAX; slots];
    (0..points.len() as u32)
        .map(|v| {
            let at = points[v as usize];
            // + 0.0: −0 and 0 are one place.
            let mix =
                |hash: u64, c: f64| (hash ^ (c + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
            let mut slot = mix(mix(mix(0, at.x), at.y), at.z) as usize & (slots - 1);
            loop {
                match table[slot] {
                    u32::MAX => {
                        table[slot] = v;
                        return v;
                    }
                    w if points[w as usize] == at => return w,
                    _ => slot = (slot + 1) & (slots - 1),
                }
            }
        })
        .collect()
}
