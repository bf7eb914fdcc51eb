//! Value noise in space, with the same bits on every platform.

use glam::DVec3;

/// Returns smooth noise, −1 … 1, with features about one unit wide: random values on the integer lattice, blended by
/// quintics (the blend is from Perlin 2002, *Improving noise*).
#[inline(never)]
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

/// Returns how high a point lies on a surface of scars, 0 … 1: bowls with crisp ridges between them, about one unit wide, as
/// flakes leave where they break off. In each cell of the lattice is the middle of one bowl (Worley 1996, *A cellular texture
/// basis function*).
#[inline(never)]
pub(crate) fn scars(at: DVec3) -> f64 {
    let low = (at - 0.5).floor();
    let [x0, y0, z0] = low.to_array().map(|c| c as i32 as u32);
    let from = at - low - 0.5;
    let mut nearest = SCAR_DEPTH;
    for corner in 0..8_u32 {
        let [x, y, z] = [corner & 1, corner >> 1 & 1, corner >> 2];
        let bits = hash([x0.wrapping_add(x), y0.wrapping_add(y), z0.wrapping_add(z)]);
        let part = |shift: u32| f64::from(bits >> shift & 0x3ff) * (2.0 * SCATTER / 1023.0) - SCATTER;
        let middle = DVec3::new(f64::from(x) + part(0), f64::from(y) + part(10), f64::from(z) + part(20));
        nearest = nearest.min((middle - from).length_squared());
    }
    nearest * (1.0 / SCAR_DEPTH)
}

/// How far the middles of bowls are from the middles of their cells. Those of other cells than the nearest eight are farther
/// away than 1 − `SCATTER`, so bowls that end there have no jumps.
const SCATTER: f64 = 0.32;
const SCAR_DEPTH: f64 = (1.0 - SCATTER) * (1.0 - SCATTER);

fn lattice(cell: [u32; 3]) -> f64 {
    f64::from(hash(cell) as i32) * (1.0 / 2_147_483_648.0)
}

fn hash([x, y, z]: [u32; 3]) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ z.wrapping_mul(0xc2b2_ae35);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scars_fill_their_range_and_have_no_jumps() {
        let (mut least, mut most) = (1.0_f64, 0.0_f64);
        for k in 0..20_000 {
            let t = f64::from(k);
            let at = DVec3::new(t * 0.137, t * -0.211, t * 0.05);
            let here = scars(at);
            (least, most) = (least.min(here), most.max(here));
            assert!((scars(at + 1.0e-6) - here).abs() < 1.0e-5, "{at}");
        }
        assert!(least < 0.02 && most == 1.0, "{least} {most}");
    }

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
