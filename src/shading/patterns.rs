//! The small textures that natural colours take their randomness from (`shaders/noise.wgsl`): a volume of gradient noise, a plane
//! of random values, and a lattice of random points.
//!
//! They are computed here, not drawn, so that every device has the same bytes: only + − × and integers, 20 ms in all.

/// Side of the volume, texels.
pub(crate) const VOLUME_SIDE: u32 = 64;

/// Texels per cell of the noise in the volume: it repeats after 16 cells.
const STEPS: u32 = 4;

const CELLS: u32 = VOLUME_SIDE / STEPS;

/// What 127 stands for in the volume: of a slope, per cell, and of a value.
const SLOPE_RANGE: f32 = 2.5;
const VALUE_RANGE: f32 = 1.0;

/// Side of the plane, texels, one per cell.
pub(crate) const PLANE_SIDE: u32 = 256;

/// Side of the lattice of points, cells.
pub(crate) const POINTS_SIDE: u32 = 32;

/// Eight corners of a cell, by the bits of their number.
const CORNERS: u32 = 8;

/// Gradient noise (Perlin, Improving noise, 2002), the same beyond each of its faces: four signed bytes per texel, the slope along x,
/// y and z and the value.
pub(crate) fn volume() -> Vec<u8> {
    let values = volume_values();
    let side = VOLUME_SIDE;
    let place = |x: u32, y: u32, z: u32| (((z % side) * side + y % side) * side + x % side) as usize;
    let at = |x, y, z| values.get(place(x, y, z)).copied().unwrap_or(0.0);
    let mut bytes = Vec::with_capacity(4 * values.len());
    let slope = |after: f32, before: f32| signed((after - before) * (0.5 * STEPS as f32 / SLOPE_RANGE));
    let back = side - 1;
    for z in 0..side {
        for y in 0..side {
            for x in 0..side {
                bytes.extend_from_slice(&[
                    slope(at(x + 1, y, z), at(x + back, y, z)),
                    slope(at(x, y + 1, z), at(x, y + back, z)),
                    slope(at(x, y, z + 1), at(x, y, z + back)),
                    signed(at(x, y, z) / VALUE_RANGE),
                ]);
            }
        }
    }
    bytes
}

/// The value of every texel of the volume.
fn volume_values() -> Vec<f32> {
    let side = VOLUME_SIDE as usize;
    let mut values = vec![0.0; side * side * side];
    let weights = corner_weights();
    for cell in 0..CELLS * CELLS * CELLS {
        let [x, y, z] = [cell % CELLS, cell / CELLS % CELLS, cell / (CELLS * CELLS)];
        let slopes: [[f32; 3]; CORNERS as usize] = std::array::from_fn(|corner| {
            let corner = corner as u32;
            let h = hash([(x + (corner & 1)) % CELLS, (y + (corner >> 1 & 1)) % CELLS, (z + (corner >> 2)) % CELLS]);
            let [a, b, c, _] = h.to_le_bytes();
            [a, b, c].map(|byte| f32::from(byte) * (2.0 / 255.0) - 1.0)
        });
        for (step, weights) in (0..).zip(&weights) {
            let value: f32 = slopes.iter().zip(weights).map(|(s, w)| s[0] * w[0] + s[1] * w[1] + s[2] * w[2]).sum();
            let [i, j, k] = [step % STEPS, step / STEPS % STEPS, step / (STEPS * STEPS)];
            let row = ((z * STEPS + k) * VOLUME_SIDE + y * STEPS + j) * VOLUME_SIDE + x * STEPS + i;
            if let Some(texel) = values.get_mut(row as usize) {
                *texel = value;
            }
        }
    }
    values
}

/// How much the slope at each corner of a cell adds to the value, along each axis, for every texel of the cell.
fn corner_weights() -> Vec<[[f32; 3]; CORNERS as usize]> {
    let of = |step: u32| {
        let f = [step % STEPS, step / STEPS % STEPS, step / (STEPS * STEPS)].map(|k| k as f32 / STEPS as f32);
        std::array::from_fn(|corner| {
            let side = [corner & 1, corner >> 1 & 1, corner >> 2].map(|bit| bit as f32);
            let share: f32 = (0..3).map(|axis| 1.0 - (side[axis] - eased(f[axis])).abs()).product();
            std::array::from_fn(|axis| share * (f[axis] - side[axis]))
        })
    };
    (0..STEPS * STEPS * STEPS).map(of).collect()
}

fn eased(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Random values, four signed bytes per texel that have nothing to do with each other.
pub(crate) fn plane() -> Vec<u8> {
    random_bytes(PLANE_SIDE * PLANE_SIDE, 1)
}

/// Four random bytes for each cell of a lattice.
pub(crate) fn points() -> Vec<u8> {
    random_bytes(POINTS_SIDE * POINTS_SIDE * POINTS_SIDE, 2)
}

fn random_bytes(texels: u32, which: u32) -> Vec<u8> {
    (0..texels).flat_map(|texel| hash([texel, which, 0]).to_le_bytes()).collect()
}

/// A signed byte, where 127 stands for 1.
fn signed(value: f32) -> u8 {
    let scaled = value.clamp(-1.0, 1.0) * 127.0;
    // Rounded to the nearest, whatever the sign.
    ((scaled + 128.5) as i32 - 128) as i8 as u8
}

fn hash([x, y, z]: [u32; 3]) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ z.wrapping_mul(0xc2b2_ae35);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(texel: &[u8]) -> [f32; 4] {
        let [x, y, z, w] = [0, 1, 2, 3].map(|k| f32::from(texel[k] as i8) / 127.0);
        [x * SLOPE_RANGE, y * SLOPE_RANGE, z * SLOPE_RANGE, w * VALUE_RANGE]
    }

    /// A value that was cut off would show as a flat spot.
    #[test]
    fn the_volume_uses_its_range_and_does_not_leave_it() {
        let most = volume_values().into_iter().fold(0.0_f32, |most, value| most.max(value.abs()));
        assert!((0.7..=VALUE_RANGE).contains(&most), "{most}");
        let bytes = volume();
        let cut = bytes.iter().filter(|&&byte| (byte as i8).unsigned_abs() == 127).count();
        assert!(cut < bytes.len() / 2000, "{cut} of {}", bytes.len());
    }

    /// The slope that is stored is the one that the stored values have, across the seams as well.
    #[test]
    fn slopes_of_the_volume_are_those_of_its_values() {
        let bytes = volume();
        let side = VOLUME_SIDE as usize;
        let texel = |x: usize, y: usize, z: usize| value(&bytes[4 * ((z * side + y) * side + x)..][..4]);
        for k in 0..4000 {
            let [x, y, z] = [k * 37 % side, k * 11 % side, k * 5 / 3 % side];
            let [dx, .., dz, _] = texel(x, y, z);
            let found = (texel((x + 1) % side, y, z)[3] - texel((x + side - 1) % side, y, z)[3]) * 2.0;
            assert!((found - dx).abs() < 0.06, "{found} {dx}");
            let found = (texel(x, y, (z + 1) % side)[3] - texel(x, y, (z + side - 1) % side)[3]) * 2.0;
            assert!((found - dz).abs() < 0.06, "{found} {dz}");
        }
    }

    /// The tuning of every stone rests on it.
    #[test]
    fn the_noise_spreads_as_evenly_as_ever() {
        let values = volume_values();
        let count = values.len() as f32;
        let mean = values.iter().sum::<f32>() / count;
        let spread = (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>() / count).sqrt();
        assert!(mean.abs() < 0.02 && (0.17..0.21).contains(&spread), "{mean} ± {spread}");
    }

    #[test]
    fn random_bytes_fill_their_range_evenly() {
        for bytes in [plane(), points()] {
            for channel in 0..4 {
                let mean = bytes.iter().skip(channel).step_by(4).map(|&b| f64::from(b)).sum::<f64>()
                    / (bytes.len() / 4) as f64;
                assert!((mean - 127.5).abs() < 1.5, "{channel}: {mean}");
            }
        }
    }
}
