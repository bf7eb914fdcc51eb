//! A log of the user's own: checked, welded, and given normals.

use std::fmt;

use glam::DVec3;

use super::log::{Log, normals};

/// Vertices and triangles a log may have: it is searched through for every base.
pub const MOST_VERTICES: usize = 200_000;
/// See [`MOST_VERTICES`].
pub const MOST_TRIANGLES: usize = 400_000;
/// cm; beyond it f32 no longer resolves a wood ear.
const REACH: f64 = 10_000.0;

/// Why a mesh cannot be a log. Nothing was changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LogError {
    /// Positions or indices do not come in threes.
    NotInThrees,
    /// More than a log may have.
    TooLarge {
        /// Vertices or triangles given.
        value: usize,
        /// Allowed.
        max: usize,
    },
    /// A coordinate is not finite, or farther than 100 m from the origin.
    BadPosition {
        /// The vertex.
        vertex: usize,
    },
    /// A triangle names a vertex that is not there.
    BadIndex {
        /// The triangle.
        triangle: usize,
    },
    /// No triangle has an area.
    NoArea,
}

impl LogError {
    /// Machine-readable name, stable across versions.
    pub fn code(&self) -> &'static str {
        match self {
            LogError::NotInThrees => "LogNotInThrees",
            LogError::TooLarge { .. } => "LogTooLarge",
            LogError::BadPosition { .. } => "LogBadPosition",
            LogError::BadIndex { .. } => "LogBadIndex",
            LogError::NoArea => "LogNoArea",
        }
    }
}

impl LogError {
    /// The message for people; `number` writes a number, as JavaScript can: Rust's way takes 1 kB of the wasm file.
    pub(crate) fn message(&self, number: impl Fn(f64) -> String) -> String {
        let (before, value, after) = match *self {
            LogError::NotInThrees => ("the log's positions and indices have to come in threes", None, ""),
            LogError::TooLarge { value, .. } => ("the log has ", Some(value), " vertices or triangles; at most "),
            LogError::BadPosition { vertex } => {
                ("vertex ", Some(vertex), " of the log is not finite, or over 100 m from the origin")
            }
            LogError::BadIndex { triangle } => {
                ("triangle ", Some(triangle), " of the log names a vertex that is not there")
            }
            LogError::NoArea => ("no triangle of the log has an area", None, ""),
        };
        let most = if let LogError::TooLarge { max, .. } = *self { Some(max) } else { None };
        let [value, most] = [value, most].map(|n| n.map_or_else(String::new, |n| number(n as f64)));
        [before, &value, after, &most].concat()
    }
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(|n| n.to_string()))
    }
}

impl std::error::Error for LogError {}

/// Checks, and welds vertices at the same place, as formats have them that split vertices for their normals. Vertices that no triangle with an area uses are dropped: nothing could tell which way they face.
pub(super) fn user_log(positions: &[f32], indices: &[u32]) -> Result<Log, LogError> {
    if !positions.len().is_multiple_of(3) || !indices.len().is_multiple_of(3) {
        return Err(LogError::NotInThrees);
    }
    for (count, max) in [(positions.len() / 3, MOST_VERTICES), (indices.len() / 3, MOST_TRIANGLES)] {
        if count > max {
            return Err(LogError::TooLarge { value: count, max });
        }
    }
    let given: Vec<DVec3> =
        positions.chunks_exact(3).map(|p| DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]))).collect();
    if let Some(vertex) = given.iter().position(|p| !p.is_finite() || p.abs().max_element() > REACH) {
        return Err(LogError::BadPosition { vertex });
    }
    if let Some(corner) = indices.iter().position(|v| *v as usize >= given.len()) {
        return Err(LogError::BadIndex { triangle: corner / 3 });
    }
    let welded = weld(&given);
    let mut number = vec![u32::MAX; given.len()];
    let mut log = Log::default();
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(|v| welded[v as usize]);
        let [p, q, r] = [a, b, c].map(|v| given[v as usize]);
        if a == b || b == c || c == a || (q - p).cross(r - p) == DVec3::ZERO {
            continue;
        }
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
    log.normals = normals(&log.points, &log.triangles);
    log.kinds = vec![0; log.points.len()];
    log.coords = vec![[0.0; 2]; log.points.len()];
    Ok(log)
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
