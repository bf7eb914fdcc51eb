//! The sky as people know it, and its two forms as each other.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::{COLUMNS, ROWS, Sky, half, luminance};

/// Every elevation that a sun can have, degrees.
const ELEVATIONS: [f32; 6] = [5.0, 8.0, 20.0, 35.0, 70.0, 90.0];

/// A sky and the direction of its sun, whose azimuth is not that of an axis.
fn sky(elevation: f32) -> (Sky, Vec3) {
    let elevation = elevation.to_radians();
    let azimuth = Vec2::new(-0.6, 0.8);
    (Sky::new(elevation, 0.0), (azimuth * elevation.cos()).extend(elevation.sin()))
}

/// How much more red than blue.
fn warmth(light: Vec3) -> f32 {
    light.x / light.z
}

#[test]
fn a_lower_sun_is_warmer_and_its_shade_is_always_bluer_than_it() {
    let skies = ELEVATIONS.map(|elevation| sky(elevation).0);
    for pair in skies.windows(2) {
        assert!(warmth(pair[0].sunshine) > warmth(pair[1].sunshine));
    }
    for sky in &skies {
        assert!(warmth(sky.on_level_ground()) < 0.9 && 1.1 < warmth(sky.sunshine));
    }
    // White under a high sun stays white; sunset is not.
    let white = |elevation: f32| {
        let (sky, sun) = sky(elevation);
        warmth(sky.sunshine * sun.z + sky.on_level_ground())
    };
    assert!((0.9..1.15).contains(&white(70.0)), "{}", white(70.0));
    assert!(white(5.0) < 2.5);
}

#[test]
fn the_sun_gives_several_times_as_much_as_the_sky_and_less_the_lower_it_is() {
    let share = |elevation: f32| {
        let (sky, sun) = sky(elevation);
        luminance(sky.on_level_ground()) / luminance(sky.sunshine * sun.z)
    };
    assert!((0.08..0.3).contains(&share(35.0)), "{}", share(35.0));
    assert!(share(70.0) < share(35.0) && share(35.0) < share(8.0));
}

#[test]
fn the_sky_is_brightest_round_the_sun_and_paler_at_the_horizon() {
    for elevation in ELEVATIONS {
        let (sky, sun) = sky(elevation);
        let opposite = Vec3::new(-sun.x, -sun.y, sun.z);
        let brightness = |direction: Vec3| luminance(sky.radiance(direction.normalize(), sun));
        assert!(elevation > 80.0 || brightness(sun) > 1.5 * brightness(opposite), "{elevation}");
        let low = sky.radiance(opposite.with_z(0.03).normalize(), sun);
        let high = sky.radiance((opposite.with_z(0.0).normalize_or(Vec3::X) + Vec3::Z).normalize(), sun);
        assert!(luminance(low) > luminance(high), "{elevation}");
        assert!(warmth(low) > warmth(high), "{elevation}");
    }
}

#[test]
fn every_light_is_finite_and_none_is_negative() {
    for elevation in ELEVATIONS {
        let (sky, _) = sky(elevation);
        let lights = sky.map.iter().chain([&sky.sunshine]);
        assert!(lights.into_iter().all(|light| light.is_finite() && light.min_element() >= 0.0), "{elevation}");
    }
}

/// Against sums over directions, which know nothing of harmonics.
#[test]
fn the_diffuse_light_is_that_of_the_map() {
    for elevation in [8.0, 35.0, 70.0] {
        let (sky, sun) = sky(elevation);
        let rows = sky.uniforms(sun);
        let azimuth = Vec2::new(rows[0][3], rows[1][3]);
        assert!(azimuth.abs_diff_eq(sun.truncate().normalize(), 1e-5));
        for normal in [Vec3::Z, Vec3::X, Vec3::Y, -Vec3::X, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.48, -0.64, 0.6)] {
            let mut sum = Vec3::ZERO;
            let (around, up) = (180, 90);
            for step in 0..around * up {
                let angle = 2.0 * PI * ((step % around) as f32 + 0.5) / around as f32;
                let z = ((step / around) as f32 + 0.5) / up as f32;
                let direction = Vec3::new(angle.cos() * (1.0 - z * z).sqrt(), angle.sin() * (1.0 - z * z).sqrt(), z);
                sum += sky.radiance(direction, sun) * normal.dot(direction).max(0.0);
            }
            let wanted = sum * 2.0 / (around * up) as f32;
            let (x, y) = (azimuth.dot(normal.truncate()), azimuth.perp_dot(normal.truncate()));
            let basis = [1.0, normal.z, x, normal.z * normal.z, x * normal.z, x * x - y * y];
            let found: Vec3 = sky.diffuse.iter().zip(basis).map(|(&light, value)| light * value).sum();
            let most = 0.12 * luminance(sky.on_level_ground());
            assert!((luminance(found) - luminance(wanted)).abs() < most, "{elevation} {normal}: {found} for {wanted}");
        }
    }
}

#[test]
fn half_floats_are_the_nearest() {
    let value = |bits: u16| {
        let (exponent, fraction) = (i32::from(bits >> 10), f32::from(bits & 0x3ff) / 1024.0);
        if exponent == 0 { fraction * 2_f32.powi(-14) } else { (1.0 + fraction) * 2_f32.powi(exponent - 15) }
    };
    for bits in 0..0x7c00 {
        assert_eq!(half(value(bits)), bits);
        let between = 0.5 * (value(bits) + value((bits + 1).min(0x7bff)));
        assert!(half(between * 1.0001).abs_diff(bits) <= 1 && half(between * 0.9999) == bits, "{bits}");
    }
    assert_eq!([half(-1.0), half(f32::MAX)], [0, 0x7bff]);
    let (sky, _) = sky(35.0);
    assert_eq!(sky.texels().len(), COLUMNS * ROWS);
}

#[test]
fn the_camera_takes_snow_darker_the_higher_the_sun_stands_and_in_the_same_colours() {
    let darker = |degrees: f32| {
        let [bare, snowy] = [0.0, 1.0].map(|snow| Sky::new(degrees.to_radians(), snow));
        let share = snowy.sunshine / bare.sunshine;
        assert!((share - snowy.on_level_ground() / bare.on_level_ground()).abs().max_element() < 1e-4);
        assert!((share - share.x).abs().max_element() < 1e-4);
        share.x
    };
    assert!(darker(60.0) < darker(16.0) && darker(16.0) < 1.0);
}
