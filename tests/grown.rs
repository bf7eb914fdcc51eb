//! Cells that grow until they meet: outlines, compared pixel by pixel with the rule that they follow.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{Random, layer, link, params, random_params};
use glam::DVec2;
use rock_field::params::{Border, Layer, PRESETS, Params};
use rock_field::rocks::{Field, Generator, Outlines, generate, grow};
use rock_field::validate::check_grown;

fn grown(params: &Params, obstacles: &[[DVec2; 3]], joint: f64) -> (Field, Vec<Outlines>) {
    let mut generator = Generator::new();
    let footprint: Vec<f64> = obstacles.iter().flatten().flat_map(|corner| corner.to_array()).collect();
    generator.set_footprint(&footprint).unwrap();
    generator.start(params.clone(), u64::MAX).unwrap();
    while !generator.step().unwrap() {}
    let field = generator.into_field();
    let outlines = grow(image(params), &field.layers, obstacles, joint);
    (field, outlines)
}

fn image(params: &Params) -> [u32; 2] {
    [params.image_width, params.image_height]
}

fn assert_grown(params: &Params) {
    let (field, outlines) = grown(params, &[], 0.0);
    assert_eq!(check_grown(image(params), &field.layers, &outlines, &[]), Ok(()), "{}", link(params));
}

/// One of the random sets: few or many layers, dense or sparse, of radii from 3 px on, where cells often touch in a single corner.
fn random_set(case: u64) -> Params {
    let mut random = Random(0x6772_6f77_0000_0000 + case);
    if case.is_multiple_of(2) {
        return random_params(&mut random, 160.0);
    }
    let side = |random: &mut Random| 40 + (140.0 * random.unit()) as u32;
    let [width, height] = [side(&mut random), side(&mut random)];
    let count = 1 + (4.0 * random.unit()) as u32;
    let layers: Vec<Layer> =
        (0..count).map(|id| layer(id, 3.0 + 60.0 * random.unit() * random.unit(), random.unit())).collect();
    let border = if random.unit() < 0.5 { Border::Drop } else { Border::Clip };
    Params { seed: case as u32, packing: 0.1 + 0.9 * random.unit(), border, ..params(width, height, layers) }
}

#[test]
fn every_pixel_of_every_preset_belongs_to_the_cell_that_reaches_it_first() {
    for preset in PRESETS {
        // Relative lengths need the width that the preset has for radii of more than two pixels.
        assert_grown(&Params { seed: 3, image_width: 260, image_height: 100, ..preset.params() });
    }
}

#[test]
fn every_pixel_of_random_fields_belongs_to_the_cell_that_reaches_it_first() {
    // One of each kind of 32.
    (0..1000).filter(|case| case % 32 < 2).for_each(|case| assert_grown(&random_set(case)));
}

#[test]
#[ignore = "takes half an hour"]
fn every_pixel_of_whole_presets_and_1_000_random_fields_belongs_to_the_cell_that_reaches_it_first() {
    (0..1000).for_each(|case| assert_grown(&random_set(case)));
    PRESETS.iter().for_each(|preset| assert_grown(&Params { seed: 3, ..preset.params() }));
}

#[test]
fn nothing_grows_into_obstacles() {
    let corners = [[20.0, 30.0], [120.0, 50.0], [60.0, 110.0], [150.0, 130.0], [190.0, 120.0], [180.0, 150.0]];
    let obstacles: Vec<[DVec2; 3]> = corners.map(DVec2::from).chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    let params = Params { seed: 5, ..params(200, 160, vec![layer(0, 24.0, 0.4), layer(1, 8.0, 1.0)]) };
    let (field, outlines) = grown(&params, &obstacles, 0.0);
    assert_eq!(check_grown([200, 160], &field.layers, &outlines, &obstacles), Ok(()));
    // Without them, what they took is shared out.
    let all = grow([200, 160], &field.layers, &[], 0.0);
    assert!(area(&all) > 31_999.0 && area(&outlines) < 28_000.0, "{} {}", area(&all), area(&outlines));
}

#[test]
fn joints_leave_every_cell_whole_and_are_the_wider_the_less_is_grown() {
    let params = Params { seed: 5, ..params(200, 160, vec![layer(0, 24.0, 0.4), layer(1, 8.0, 0.5)]) };
    let field = generate(&params).unwrap();
    let cells: f64 = field.layers.iter().map(|layer| layer.area_reached() * 32_000.0).sum();
    let areas = [0.0, 0.5, 1.0, 2.0, 1000.0].map(|joint| area(&grow([200, 160], &field.layers, &[], joint)));
    assert!(areas.windows(2).all(|pair| pair[0] > pair[1]), "{areas:?}");
    assert!((areas[4] - cells).abs() < 0.01 * cells, "{areas:?} {cells}");
}

#[test]
fn the_only_cell_takes_the_whole_image_and_no_cell_takes_nothing() {
    let one = Layer { cell_count: Some(1), ..layer(0, 20.0, 0.0) };
    let field = generate(&params(160, 120, vec![one, layer(1, 5.0, 0.0)])).unwrap();
    let outlines = grow([160, 120], &field.layers, &[], 0.0);
    assert_eq!(outlines.iter().map(Outlines::len).collect::<Vec<_>>(), [1, 0]);
    assert!((area(&outlines) - 160.0 * 120.0).abs() < 1.0e-6);
}

fn area(outlines: &[Outlines]) -> f64 {
    let of = |outline: &[DVec2]| {
        let first = outline[0];
        0.5 * outline.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum::<f64>()
    };
    outlines.iter().flat_map(|outlines| (0..outlines.len()).map(move |k| of(outlines.of(k)))).sum()
}
