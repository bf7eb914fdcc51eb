//! Value noise in space, with the same bits on every platform.

use glam::DVec3;

/// Returns smooth noise, −1 … 1, with features about one unit wide: random values on the integer lattice, blended by
/// quintics (the blend is from Perlin 2002, *Improving noise*).
pub(crate) fn noise(at: DVec3) -> f64 {
    let cell = at.floor();
    let f = at - cell;
    let blend = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let [x0, y0, z0] = cell.to_array().map(|c| c as i32 as u32);
    let value = |x, y, z| lattice([x0.wrapping_add(x), y0.wrapping_add(y), z0.wrapping_add(z)]);
    let row = |y, z| value(0, y, z) + (value(1, y, z) - value(0, y, z)) * blend.x;
    let plane = |z| row(0, z) + (row(1, z) - row(0, z)) * blend.y;
    plane(0) + (plane(1) - plane(0)) * blend.z
}

fn lattice([x, y, z]: [u32; 3]) -> f64 {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ z.wrapping_mul(0xc2b2_ae35);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    f64::from((h ^ (h >> 16)) as i32) * (1.0 / 2_147_483_648.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_stays_within_one_and_has_no_jumps() {
        let mut most = 0.0_f64;
        for k in 0..4000 {
            let t = f64::from(k);
            let at = DVec3::new(t * 0.37, t * -0.211, t * 0.05);
            most = most.max(noise(at).abs());
            assert!((noise(at + 1.0e-6) - noise(at)).abs() < 2.0e-5);
        }
        assert!((0.6..=1.0).contains(&most), "{most}");
    }
}
