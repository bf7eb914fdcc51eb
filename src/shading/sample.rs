//! What the samples of a still are: for each a point of the pixel, of the lens, of the sun's disc, of the sky, and of the ground.
//!
//! All are drawn from sequences that fill their ranges evenly however many are taken, so that the error of the mean falls faster than
//! that of random numbers. The same sample is the same everywhere.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

/// Angular radius of the sun, radians: 0.53° across.
const SUN_RADIUS: f32 = 0.004_65;

/// The directions and places of one sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// From the middle of a pixel, px.
    pub(crate) pixel: Vec2,
    /// In a lens of radius 1, to the right and up. It follows the sequence of the pixel, and not that of the light: each part of a blurred
    /// spot would have a light of its own.
    pub(crate) lens: Vec2,
    /// Unit vectors towards a point of the sun's disc, and to points of the sky and of the ground. The density of the last two over
    /// the sphere is (|z| + 1/2) / 2π: `drawn` in `shaders/sampled.wgsl` divides by it.
    pub(crate) sun: Vec3,
    pub(crate) sky: Vec3,
    pub(crate) below: Vec3,
}

impl Sample {
    /// The sample of this number, from 0, for a sun in the direction `sun`.
    pub(crate) fn new(number: u32, sun: Vec3) -> Self {
        let square = Vec2::new(radical_inverse(2, number), radical_inverse(3, number));
        // Each adds its light to that of the others, so they may follow the same sequence. Sky and ground are on opposite sides: a wall
        // that one of them is behind has the other before it. From here even the first sixteen fill the sphere evenly.
        let starts = [Vec2::splat(0.25), Vec2::new(0.0625, 0.375), Vec2::new(0.0625, 0.875)];
        let [disc, sky, below] = starts.map(|start| plastic(number, start));
        let right = Vec3::Z.cross(sun).try_normalize().unwrap_or(Vec3::X);
        let disc = in_disc(disc) * SUN_RADIUS;
        Self {
            pixel: square - 0.5,
            lens: in_disc(square),
            sun: (sun + right * disc.x + sun.cross(right) * disc.y).normalize(),
            sky: towards(sky),
            below: towards(below) * Vec3::new(1.0, 1.0, -1.0),
        }
    }
}

/// A point of the disc of radius 1, as even as `at` is in the unit square.
fn in_disc(at: Vec2) -> Vec2 {
    Vec2::from_angle(TAU * at.y) * at.x.sqrt()
}

/// A direction to the upper half of the sphere.
fn towards(at: Vec2) -> Vec3 {
    // The inverse of z² / 2 + z / 2; not quite the horizon, where a map would have no end.
    let z = (((1.0 + 8.0 * at.x).sqrt() - 1.0) * 0.5).max(0.02);
    let (sin, cos) = (TAU * at.y - PI).sin_cos();
    let flat = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(cos * flat, sin * flat, z)
}

/// Van der Corput's sequence, 0…1.
fn radical_inverse(base: u32, mut number: u32) -> f32 {
    let (mut sum, mut share) = (0.0, 1.0 / base as f32);
    while number > 0 {
        sum += (number % base) as f32 * share;
        number /= base;
        share /= base as f32;
    }
    sum
}

/// Roberts' sequence in two dimensions (*The unreasonable effectiveness of quasirandom sequences*, 2018), each 0…1.
fn plastic(number: u32, start: Vec2) -> Vec2 {
    // In integers, so that it stays exact: 2³² over the plastic number and over its square.
    let step = |by: u32| number.wrapping_mul(by) as f64 / 4_294_967_296.0;
    (Vec2::new(step(3_242_174_889) as f32, step(2_447_445_414) as f32) + start).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SUN: Vec3 = Vec3::new(0.36, -0.48, 0.8);

    fn samples(count: u32) -> impl Iterator<Item = Sample> {
        (0..count).map(|number| Sample::new(number, SUN))
    }

    #[test]
    fn directions_have_length_one_and_keep_to_their_halves() {
        for Sample { sun, sky, below, pixel, lens } in samples(5000) {
            for way in [sun, sky, below] {
                assert!((way.length() - 1.0).abs() < 1.0e-5, "{way}");
            }
            assert!(sky.z > 0.0 && below.z < 0.0, "{sky} {below}");
            assert!(sun.dot(SUN) >= (1.01 * SUN_RADIUS).cos(), "{sun} is beside the sun");
            assert!(pixel.abs().max_element() <= 0.5, "{pixel}");
            assert!(lens.length() < 1.0, "{lens} is outside the lens");
        }
    }

    /// In surroundings that are white all around, a white surface sends on as much as falls on it, whichever way it faces.
    #[test]
    fn a_white_surface_in_white_surroundings_is_white_whichever_way_it_faces() {
        let drawn = |cosine: f32, height: f32| 2.0 * cosine.max(0.0) / (height + 0.5);
        for (x, y, z) in [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (-0.6, 0.8, 0.0), (0.48, 0.64, 0.6), (0.3, -0.4, -0.866)] {
            let normal = Vec3::new(x, y, z);
            for (count, most) in [(16, 0.12), (64, 0.04), (1024, 0.01)] {
                let sum: f32 = samples(count)
                    .map(|Sample { sky, below, .. }| drawn(normal.dot(sky), sky.z) + drawn(normal.dot(below), -below.z))
                    .sum();
                let mean = sum / count as f32;
                assert!((mean - 1.0).abs() < most, "{normal}: {mean} after {count}");
            }
        }
    }

    #[test]
    fn few_samples_already_fill_the_pixel() {
        let mut cells = [[false; 4]; 4];
        for Sample { pixel, .. } in samples(36) {
            let [x, y] = (pixel + 0.5).to_array().map(|at| (at * 4.0) as usize);
            cells[x.min(3)][y.min(3)] = true;
        }
        assert!(cells.iter().flatten().all(|&hit| hit), "{cells:?}");
    }

    /// A spot out of focus has as much light on each side, in each half of its radius, and on the mean the light of all parts of the sky.
    #[test]
    fn the_lens_is_filled_evenly_and_each_part_of_it_sees_all_of_the_light() {
        let all: Vec<Sample> = samples(64).collect();
        let middle = all.iter().map(|sample| sample.lens).sum::<Vec2>() / 64.0;
        assert!(middle.length() < 0.05, "the spot is shifted by {middle}");
        let inner = all.iter().filter(|sample| sample.lens.length_squared() < 0.5).count();
        assert!((28..=36).contains(&inner), "{inner} of 64 in the inner half");
        for side in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
            let half: Vec<Vec3> =
                all.iter().filter(|sample| sample.lens.dot(side) > 0.0).map(|sample| sample.sky).collect();
            let mean = half.iter().sum::<Vec3>() / half.len() as f32;
            assert!(mean.truncate().length() < 0.2, "{side}: its light comes from {mean}");
        }
    }
}
