//! Sines and cosines computed with + − × only, so that every platform gives the same bits.

use std::f64::consts::TAU;

/// Returns (cos, sin) of `turns` full turns. The result is exact at whole quarters.
///
/// The angle is reduced to within an eighth of a turn of the nearest quarter. There, the Taylor series up to the
/// seventeenth power are off by less than 2⁻⁵⁴.
pub(super) fn turn(turns: f64) -> [f64; 2] {
    let quarter = (4.0 * turns + 0.5).floor();
    let a = (turns - 0.25 * quarter) * TAU;
    let q = a * a;
    let series = |n: f64| {
        // Evaluates 1 − q / (n (n + 1)) (1 − q / ((n + 2) (n + 3)) (…)): the cosine for n = 1, and the sine divided by
        // its angle for n = 2.
        (0..8).rev().fold(1.0, |sum, k| {
            let m = n + 2.0 * f64::from(k);
            1.0 - q / (m * (m + 1.0)) * sum
        })
    };
    let [cos, sin] = [series(1.0), a * series(2.0)];
    match quarter.rem_euclid(4.0) as u8 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// Returns (cos, sin) of an angle in radians.
pub(super) fn radians(angle: f64) -> [f64; 2] {
    turn(angle * (1.0 / TAU))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_agrees_with_the_system_library() {
        for k in -3000..3000 {
            let turns = f64::from(k) * 0.001_37;
            let [cos, sin] = turn(turns);
            assert!((cos - (turns * TAU).cos()).abs() < 1.0e-14 && (sin - (turns * TAU).sin()).abs() < 1.0e-14);
        }
        assert_eq!(
            [turn(0.0), turn(0.25), turn(0.5), turn(0.75)].map(|[c, s]| [c + 0.0, s + 0.0]),
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]
        );
    }
}
