//! Whether film.wgsl, which needs half as many steps, gives the picture of what it stands in for.

const CURVE: [f64; 7] = [0.0014327, -0.1515847, 3.239357, -20.50378, 58.06634, -61.37358, 21.71865];
const INSET_GREY: [f64; 3] = [0.0423, 0.0784, 0.0792];
const OUTSET_GREY: [f64; 3] = [0.0928, 0.2321, 0.1126];

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Sobotka's AgX with Wrensch's polynomial, step by step: both matrices by their rows, contrast and colour.
fn expected(light: [f64; 3]) -> [f64; 3] {
    const INSET: [[f64; 3]; 3] = [
        [0.842479062, 0.0784336, 0.079223745],
        [0.042328242, 0.878468636, 0.079166127],
        [0.042375655, 0.0784336, 0.879142974],
    ];
    const OUTSET: [[f64; 3]; 3] = [
        [1.196879005, -0.098020881, -0.099029744],
        [-0.052896852, 1.151903130, -0.098961177],
        [-0.052971636, -0.098043450, 1.151073673],
    ];
    let steps = INSET.map(|row| ((dot(row, light).max(1e-6).log2() + 12.47393) / 16.5).clamp(0.0, 1.0));
    let film =
        steps.map(|x| -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5))))));
    let punch = OUTSET.map(|row| dot(row, film).max(0.0).powf(1.22));
    let grey = dot([0.2126, 0.7152, 0.0722], punch);
    punch.map(|value| (grey + 1.15 * (value - grey)).clamp(0.0, 1.0))
}

/// As the shader does it.
fn found(light: [f64; 3]) -> [f64; 3] {
    let film = light.map(|value| 0.8 * value + dot(INSET_GREY, light));
    let curve = film.map(|value| {
        let x = (value.max(1e-6).log2() * 0.060606061 + 0.75599576).clamp(0.0, 1.0);
        CURVE.iter().rev().fold(0.0, |sum, factor| sum * x + factor).max(0.0)
    });
    curve.map(|value| (1.4375 * value - dot(OUTSET_GREY, curve)).clamp(0.0, 1.0))
}

#[test]
fn the_short_tone_curve_gives_the_picture_of_the_long_one() {
    let numbers = CURVE.iter().chain(&INSET_GREY).chain(&OUTSET_GREY);
    for number in numbers.map(|number| number.abs().to_string()) {
        assert!(super::FILM.contains(&number), "film.wgsl has not {number}");
    }
    // Grey, stone, moss, rust, flesh, and what lies in the light of the sky alone.
    let colors = [
        [1.0, 1.0, 1.0],
        [1.0, 0.95, 0.88],
        [0.135, 0.126, 0.042],
        [0.34, 0.235, 0.135],
        [0.115, 0.046, 0.019],
        [0.1, 0.2, 0.5],
    ];
    for color in colors {
        for step in -90..50 {
            let light = color.map(|value: f64| value * (0.1 * f64::from(step)).exp2());
            for (expected, found) in expected(light).into_iter().zip(found(light)) {
                assert!((expected - found).abs() < 1.2 / 255.0, "{light:?}: {expected}, {found}");
            }
        }
    }
}
