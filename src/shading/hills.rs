//! The hills round a field: a panorama of a land of noise, seen from the field. It is made once, and holds shapes and not colours, so that any sun can
//! light it.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

/// Columns of the panorama, once round the horizon from −x over −y, x and y.
pub(crate) const COLUMNS: usize = 1024;
pub(crate) const ROWS: usize = 48;
/// How high above the horizon the panorama reaches, radians. `HILLS_TOP` of sky.wgsl is the same number.
const TOP: f32 = 0.08;

/// Where the hills begin and end, km. Between them so many points of a line of sight are looked at.
const NEAR: f32 = 0.9;
const FAR: f32 = 24.0;
const STEPS: usize = 72;

/// Four bytes a texel, row after row from the horizon up: x and y of the normal; the square root of the distance, as a share of [`FAR`]'s; how far
/// the texel lies below the skyline, in steps of 1/32 of a row, plus 128.
pub(crate) fn panorama() -> Vec<[u8; 4]> {
    let mut texels = vec![[128, 128, 255, 0]; COLUMNS * ROWS];
    for column in 0..COLUMNS {
        let azimuth = TAU * (column as f32 + 0.5) / COLUMNS as f32 - PI;
        let towards = Vec2::from_angle(azimuth);
        let mut row = 0;
        let mut skyline = 0.0;
        let mut last = [128, 128, 0];
        for step in 0..STEPS {
            let distance = NEAR * (FAR / NEAR).powf(step as f32 / (STEPS - 1) as f32);
            let at = towards * distance;
            // From the horizon, in rows.
            let rise = height(at) / distance / TOP * ROWS as f32;
            if rise <= skyline {
                continue;
            }
            skyline = rise;
            last = seen(at, distance);
            while row < ROWS && (row as f32) + 0.5 <= rise {
                if let Some(texel) = texels.get_mut(row * COLUMNS + column) {
                    *texel = [last[0], last[1], last[2], 0];
                }
                row += 1;
            }
        }
        for row in 0..ROWS {
            if let Some(texel) = texels.get_mut(row * COLUMNS + column) {
                let below = skyline - (row as f32 + 0.5);
                // Above the skyline goes on what is below it, so that nothing else is mixed in along it.
                if below < 0.0 {
                    *texel = [last[0], last[1], last[2], 0];
                }
                texel[3] = (below * 32.0 + 128.0).clamp(0.0, 255.0) as u8;
            }
        }
    }
    texels
}

/// What a texel holds of the land at a place.
fn seen(at: Vec2, distance: f32) -> [u8; 3] {
    let step = 0.02 * distance.max(1.0);
    let here = height(at);
    let slope = Vec2::new(height(at + Vec2::X * step) - here, height(at + Vec2::Y * step) - here) / step;
    // Steeper than it is: what is small is not in the land, but would be seen.
    let normal = Vec3::new(-2.2 * slope.x, -2.2 * slope.y, 1.0).normalize();
    let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    [byte(0.5 + 0.5 * normal.x), byte(0.5 + 0.5 * normal.y), byte((distance / FAR).sqrt())]
}

/// Height of the land, km: plain at first, then low hills, and far away mountains.
fn height(at: Vec2) -> f32 {
    let distance = at.length();
    let hills = 0.5 + 0.5 * layered(at / 1.7, 4);
    let ridge = 1.0 - layered(at / 6.5 + Vec2::splat(31.7), 5).abs();
    let massif = 0.5 + 0.5 * noise(at / 11.0 + Vec2::splat(7.3));
    let low = smooth(0.9, 3.2, distance) * 0.11 * hills * hills;
    let high = smooth(3.0, 15.0, distance) * 0.95 * ridge * ridge * ridge * massif;
    low + high
}

fn smooth(from: f32, to: f32, value: f32) -> f32 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Octaves of noise, about −1…1.
fn layered(mut at: Vec2, octaves: usize) -> f32 {
    let mut sum = 0.0;
    let mut share = 0.55;
    for _ in 0..octaves {
        sum += share * noise(at);
        share *= 0.48;
        // Turned, so that the grids of the octaves do not agree.
        at = Vec2::new(1.6 * at.x - 1.2 * at.y, 1.2 * at.x + 1.6 * at.y) + Vec2::splat(17.1);
    }
    sum
}

/// Value noise, −1…1.
fn noise(at: Vec2) -> f32 {
    let cell = at.floor();
    let f = at - cell;
    let u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |x: i32, y: i32| {
        let (x, y) = (cell.x as i32 + x, cell.y as i32 + y);
        let bits = (x as u32).wrapping_mul(0x9e37_79b9) ^ (y as u32).wrapping_mul(0x85eb_ca6b);
        let bits = (bits ^ bits >> 16).wrapping_mul(0x7feb_352d);
        let bits = (bits ^ bits >> 15).wrapping_mul(0x846c_a68b);
        (bits >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * u.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * u.x;
    low + (high - low) * u.y
}

#[cfg(test)]
mod tests {
    use super::*;

    fn skyline(texels: &[[u8; 4]], column: usize) -> f32 {
        let rows = (0..ROWS).filter(|row| texels[row * COLUMNS + column][3] >= 128).count();
        // Between the two rows around it.
        let below = |row: usize| f32::from(texels[row * COLUMNS + column][3]) - 128.0;
        if rows == 0 { 0.0 } else { rows as f32 - 0.5 + below(rows - 1) / 32.0 }
    }

    #[test]
    fn below_the_skyline_is_land_and_above_it_sky_and_no_hill_is_cut_off() {
        let texels = panorama();
        assert_eq!(texels.len(), COLUMNS * ROWS);
        for column in 0..COLUMNS {
            let below: Vec<u8> = (0..ROWS).map(|row| texels[row * COLUMNS + column][3]).collect();
            assert!(below.is_sorted_by(|a, b| a >= b), "column {column}");
            assert!(below[ROWS - 1] < 128, "column {column}");
        }
        let highest = (0..COLUMNS).map(|column| skyline(&texels, column)).fold(0.0, f32::max);
        assert!((ROWS as f32 / 4.0..ROWS as f32).contains(&highest), "{highest}");
    }

    #[test]
    fn the_panorama_closes_and_what_is_higher_is_farther_away() {
        let texels = panorama();
        let step = |column: usize| (skyline(&texels, column) - skyline(&texels, (column + 1) % COLUMNS)).abs();
        let most = (0..COLUMNS - 1).map(step).fold(0.0, f32::max);
        assert!(step(COLUMNS - 1) <= most, "{} and {most}", step(COLUMNS - 1));
        for column in 0..COLUMNS {
            let distances: Vec<u8> = (0..ROWS).map(|row| texels[row * COLUMNS + column][2]).collect();
            assert!(distances.is_sorted(), "column {column}");
        }
    }

    #[test]
    fn the_shader_has_the_same_measures() {
        let shader = include_str!("shaders/sky.wgsl");
        for line in [
            format!("const HILLS_TOP = {TOP};"),
            format!("const HILLS_ROWS = {ROWS}.0;"),
            format!("const HILLS_FAR = {FAR:.1};"),
        ] {
            assert!(shader.contains(&line), "{line}");
        }
    }
}
