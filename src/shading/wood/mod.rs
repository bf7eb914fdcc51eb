//! What the shaders read about a log and wood ears: the paint of each vertex, and where the log's axis runs.
//!
//! The paint has the same format as the rocks', so that the shadow and height passes draw everything alike. For a log
//! it holds three zeros and the kind of wood. For a wood ear it holds how far the vertex is from the middle (0) to the
//! rim (255), two random bytes of the individual, and its [`Side`].

use glam::Vec3;

use super::palette;

/// The paint of a log's vertex. `kind`: 0 bark, 1 end grain, 2 splinter; larger numbers count as splinters too.
pub(crate) fn painted(kind: u8) -> u32 {
    u32::from(kind.min(2)) << 24
}

/// The sides of a wood ear, as `shaders/ear.wgsl` reads them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Inner,
    Rim,
    Outer,
    Foot,
}

/// The order of a wood ear's vertices, which is the same for all individuals of a colony.
#[derive(Clone, Debug)]
pub(crate) struct Ears {
    pub(crate) rings: u32,
    pub(crate) meridians: u32,
    /// Per individual, a number that does not change when others come and go.
    pub(crate) keys: Vec<u32>,
}

impl Ears {
    /// Whether an individual of `each` vertices has a thickness, and with it two sheets.
    pub(crate) fn is_closed(&self, each: u32) -> bool {
        each >= 2 * (self.rings.max(1) + 1) * self.meridians.max(1)
    }

    /// The paint of `vertex`, where every individual has `each` vertices.
    pub(crate) fn painted(&self, vertex: u32, each: u32) -> u32 {
        let (d, c) = (self.rings.max(1), self.meridians.max(1));
        let (individual, at) = (vertex / each, vertex % each);
        let hash = palette::hash(0, self.keys.get(individual as usize).copied().unwrap_or(individual));
        let sheet = d * c;
        let closed = self.is_closed(each);
        let (ring, side) = match at {
            at if at < sheet => (at / c + 1, Side::Inner),
            at if closed && at < sheet + 2 * c => (d, Side::Rim),
            at if closed && at < 2 * sheet + 2 * c => ((at - sheet - 2 * c) / c + 1, Side::Outer),
            // The floor above a stalk is seen from inside.
            at if closed && at > 2 * sheet + 3 * c => (0, Side::Inner),
            _ => (0, Side::Foot),
        };
        (ring * 255 / d) | hash << 8 & 0x00ff_ff00 | (side as u32) << 24
    }
}

/// The axis of a log that lies along x: at a constant height, and bowed in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Axis {
    /// Middle of the log's extent along x, and half of that extent.
    pub(crate) middle: f32,
    pub(crate) half: f32,
    /// Mean distance of the bark from the axis.
    pub(crate) radius: f32,
    pub(crate) height: f32,
    /// Coefficients of 1, t, t² and t³ of a polynomial for y; t is −1…1 from end to end.
    pub(crate) bow: [f32; 4],
}

impl Axis {
    /// Fits the axis through the middle of the bark by least squares. Bark near the ends is ignored, because it may be
    /// broken off on one side. `points` holds three coordinates per vertex.
    pub(crate) fn of(points: &[f32], kinds: &[u8]) -> Self {
        let vertices = || points.chunks_exact(3).map(Vec3::from_slice);
        let (low, high) =
            vertices().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), p| (low.min(p.x), high.max(p.x)));
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        const WHOLE: f64 = 0.8;
        let bark = || {
            let of_bark = vertices().zip(kinds).filter(|(_, kind)| **kind == 0);
            of_bark.map(|(p, _)| (f64::from((p.x - middle) / half), p)).filter(|(t, _)| t.abs() <= WHOLE)
        };
        let count = bark().count() as f64;
        if count == 0.0 || !(half > 0.0 && half.is_finite()) {
            return Self::default();
        }
        let mut rows = [[0.0; 5]; 4];
        for (t, p) in bark() {
            let powers = [1.0, t, t * t, t * t * t];
            for (row, power) in rows.iter_mut().zip(powers) {
                for (sum, value) in row.iter_mut().zip(powers.into_iter().chain([f64::from(p.y)])) {
                    *sum += power * value;
                }
            }
        }
        let bow = solved(rows).map(|value| value as f32);
        let height = (bark().map(|(_, p)| f64::from(p.z)).sum::<f64>() / count) as f32;
        let flat = Self { middle, half, radius: 0.0, height, bow };
        let radius = bark().map(|(t, p)| f64::from((p.y - flat.y(t as f32)).hypot(p.z - height))).sum::<f64>() / count;
        Self { radius: radius as f32, ..flat }
    }

    fn y(&self, t: f32) -> f32 {
        self.bow.iter().rev().fold(0.0, |sum, factor| sum * t + factor)
    }

    /// The axis after the log is scaled by `scale` and moved to `origin`.
    pub(crate) fn placed(self, origin: Vec3, scale: f32) -> Self {
        let mut bow = self.bow.map(|factor| factor * scale);
        bow[0] += origin.y;
        Self {
            middle: self.middle * scale + origin.x,
            half: self.half * scale,
            radius: self.radius * scale,
            height: self.height * scale + origin.z,
            bow,
        }
    }
}

/// Solves the equations by Gaussian elimination. An unknown that they do not determine is 0. No pivoting is needed,
/// because the matrix of sums is positive.
fn solved(mut rows: [[f64; 5]; 4]) -> [f64; 4] {
    let least = 1.0e-9 * rows[0][0];
    for k in 0..4 {
        let row = rows[k];
        let scale = if row[k] > least { 1.0 / row[k] } else { 0.0 };
        rows[k] = row.map(|value| value * scale);
        let unit = rows[k];
        for (_, other) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let share = other[k];
            for (value, part) in other.iter_mut().zip(unit) {
                *value -= share * part;
            }
        }
    }
    rows.map(|row| row[4])
}

#[cfg(test)]
mod tests;
