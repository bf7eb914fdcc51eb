//! A log given by the user: it is checked, welded, turned the right way out, and given normals.

use std::fmt;

use glam::DVec3;

use super::mesh::{LogMesh, place, write};
use crate::error::fill;
use crate::rng::Stream;

/// Largest number of vertices of a log.
pub const MOST_VERTICES: usize = 200_000;
/// Largest number of triangles of a log.
pub const MOST_TRIANGLES: usize = 400_000;
/// Largest absolute value of a coordinate, cm. Beyond it, f32 cannot resolve a wood ear.
const REACH: f64 = 10_000.0;

/// Why a mesh cannot be used as a log. Nothing was changed.
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
        /// Number of the vertex.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// A triangle names a vertex that is not there.
    BadIndex {
        /// Number of the triangle.
        triangle: usize,
        /// The index.
        value: u32,
        /// The largest index possible; −1 if there is no vertex.
        max: f64,
    },
    /// No triangle has an area.
    NoArea,
}

impl LogError {
    /// Machine-readable name of the error, stable across versions.
    pub fn code(&self) -> &'static str {
        match self {
            LogError::NotInThrees { .. } => "LogNotInThrees",
            LogError::TooLarge { .. } => "LogTooLarge",
            LogError::BadPosition { .. } => "LogBadPosition",
            LogError::BadIndex { .. } => "LogBadIndex",
            LogError::NoArea => "LogNoArea",
        }
    }

    /// The value, the smallest and the largest legal value. NaN if there is none.
    pub fn numbers(&self) -> [f64; 3] {
        match *self {
            LogError::NotInThrees { value } => [value as f64, f64::NAN, f64::NAN],
            LogError::TooLarge { value, max } => [value as f64, 0.0, max as f64],
            LogError::BadPosition { value, .. } => [value, -REACH, REACH],
            LogError::BadIndex { value, max, .. } => [f64::from(value), 0.0, max],
            LogError::NoArea => [f64::NAN; 3],
        }
    }

    /// The message for people. `number` converts a number to text in the way of JavaScript, because Rust's way takes 1
    /// kB of the wasm file.
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

/// What is needed to draw feet on a log given by the user, besides its mesh.
#[derive(Debug, Clone, Default)]
pub(super) struct Surface {
    /// Per triangle, its number in the mesh as it was given.
    pub(super) numbers: Vec<u32>,
    /// Whether the mesh was closed and inside out, and has been turned.
    pub(super) is_turned: bool,
    /// Number of vertices that were given.
    pub(super) given: usize,
    /// Number of vertices that are left of them.
    pub(super) kept: usize,
    /// Per triangle, the summed area of all triangles up to and including it, cm².
    areas: Vec<f64>,
}

impl Surface {
    /// Area of the surface, cm².
    pub(super) fn area(&self) -> f64 {
        self.areas.last().copied().unwrap_or_default()
    }

    /// Draws a point of the surface, uniformly by area. Returns its triangle, its position (cm), and the triangle's
    /// normal.
    pub(super) fn dart(&self, mesh: &LogMesh, stream: &mut Stream) -> (u32, DVec3, DVec3) {
        let at = stream.unit() * self.area();
        let triangle = self.areas.partition_point(|sum| *sum <= at).min(self.areas.len() - 1);
        let [a, b, c] = mesh.corners(triangle);
        let [u, v] = [stream.unit().sqrt(), stream.unit()];
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Z);
        (triangle as u32, a + u * ((1.0 - v) * (b - a) + v * (c - a)), normal)
    }
}

/// Checks a mesh and welds vertices at the same place, since some file formats split vertices for their normals.
/// Vertices that are not used by any triangle with an area are dropped. Returns what is wrong with the mesh, if
/// anything.
pub(super) fn user_log(positions: &[f32], indices: &[u32]) -> Result<(Surface, LogMesh), LogError> {
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
    let [given, triangles] = [positions.len() / 3, indices.len() / 3];
    let welded = weld(positions);
    let mut number = vec![u32::MAX; given];
    let (mut numbers, mut areas) = (Vec::with_capacity(triangles), Vec::with_capacity(triangles));
    let mut mesh = LogMesh::default();
    mesh.positions.reserve_exact(positions.len());
    mesh.indices.reserve_exact(indices.len());
    // Per vertex, the sum of the area vectors of its triangles.
    let mut sums = Vec::with_capacity(given);
    let (mut area, mut volume) = (0.0, 0.0);
    let mut origin = None;
    for (triangle, corners) in (0..).zip(indices.chunks_exact(3)) {
        if let Some(&value) = corners.iter().find(|v| **v as usize >= given) {
            return Err(LogError::BadIndex { triangle, value, max: given as f64 - 1.0 });
        }
        let corners = [corners[0], corners[1], corners[2]].map(|v| welded[v as usize]);
        let [p, q, r] = corners.map(|v| place(positions, v).as_dvec3());
        let across = (q - p).cross(r - p);
        if across == DVec3::ZERO {
            continue;
        }
        area += 0.5 * across.length();
        areas.push(area);
        numbers.push(triangle as u32);
        let corners = corners.map(|v| {
            let slot = &mut number[v as usize];
            if *slot == u32::MAX {
                *slot = sums.len() as u32;
                mesh.positions.extend(place(positions, v).to_array());
                sums.push(DVec3::ZERO);
            }
            sums[*slot as usize] += across;
            *slot
        });
        mesh.indices.extend(corners);
        // Coordinates are taken relative to one of the mesh's vertices, because far from the origin their differences
        // would be lost.
        volume += across.dot(p - *origin.get_or_insert(p));
    }
    if areas.is_empty() {
        return Err(LogError::NoArea);
    }
    let is_turned = volume < 0.0 && is_closed(&mesh.indices);
    if is_turned {
        mesh.indices.chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
    }
    let sign = if is_turned { -1.0 } else { 1.0 };
    let kept = sums.len();
    mesh.positions.shrink_to_fit();
    mesh.normals = vec![0.0; 3 * kept];
    write(&mut mesh.normals, sums.iter().map(|sum| (sign * *sum).normalize_or(DVec3::Z)));
    mesh.kinds = vec![0; kept];
    mesh.coords = vec![0.0; 2 * kept];
    Ok((Surface { numbers, is_turned, given, kept, areas }, mesh))
}

/// Whether every edge of a mesh occurs equally often in both directions. A mesh that is not closed has no inside.
fn is_closed(indices: &[u32]) -> bool {
    // With a random number for each vertex, a b (b − a) of an edge is minus that of the reversed edge. The three edges of
    // a triangle add up to the product below, so all products add up to 0 for a closed mesh, and for another one only by
    // chance, one time in 2⁶⁰.
    let edges = indices.chunks_exact(3).fold(0_u64, |edges, corners| {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(random);
        edges.wrapping_add(b.wrapping_sub(a).wrapping_mul(c.wrapping_sub(b)).wrapping_mul(c.wrapping_sub(a)))
    });
    edges == 0
}

/// A random number that belongs to a vertex.
fn random(vertex: u32) -> u64 {
    let h = (u64::from(vertex) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (h ^ (h >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}

/// Returns, for each vertex, the first one at the same place. Places are found in a hash table with open addressing.
fn weld(positions: &[f32]) -> Vec<u32> {
    let vertices = positions.len() / 3;
    let slots = (2 * vertices).next_power_of_two();
    let mut table = vec![u32::MAX; slots];
    (0..vertices as u32)
        .map(|v| {
            let at = place(positions, v);
            // Adding 0.0 turns −0 into 0, since both are the same place.
            let mix = |hash: u64, c: f32| {
                (hash ^ u64::from((c + 0.0).to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
            };
            let mut slot = mix(mix(mix(0, at.x), at.y), at.z) as usize & (slots - 1);
            loop {
                match table[slot] {
                    u32::MAX => {
                        table[slot] = v;
                        return v;
                    }
                    w if place(positions, w) == at => return w,
                    _ => slot = (slot + 1) & (slots - 1),
                }
            }
        })
        .collect()
}
