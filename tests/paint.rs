//! A mask and painted strokes (decision A24): what they let stand, and that they reach no farther than they say.
#![cfg(feature = "full")]
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::collections::BTreeMap;

use common::field_test;
use rock_field::params::{Crossing, Params, preset};
use rock_field::rocks::{Field, Generator};

const SIDE: u32 = 300;

fn params(name: &str) -> Params {
    let mut params = preset(name).unwrap().params();
    (params.image_width, params.image_height, params.seed) = (SIDE, SIDE, 3);
    let largest = params.layers.iter().map(|layer| layer.radius).fold(0.0, f64::max);
    for layer in &mut params.layers {
        (layer.radius, layer.detail) = (layer.radius * 24.0 / largest, 0.0);
    }
    // A layer that asks for less than all that is free.
    params.layers[0].area_fraction = 0.2;
    params
}

/// A mask: its rows, and its width.
type Mask<'a> = (&'a [u8], usize);
const NONE: Mask = (&[], 0);

fn run(generator: &mut Generator, params: &Params, mask: Mask, strokes: &[f64]) {
    generator.set_paint(mask.0.to_vec(), mask.1, strokes.to_vec()).unwrap();
    generator.start(params.clone(), u64::MAX).unwrap();
    while !generator.step().unwrap() {}
}

fn grow(params: &Params, mask: Mask, strokes: &[f64]) -> Field {
    let mut generator = Generator::new();
    run(&mut generator, params, mask, strokes);
    generator.into_field()
}

const ADD: u64 = 0;
const ERASE: u64 = 1;
const PATH: u64 = 2;
const RESTORE: u64 = 3;

/// A stroke: what it does, in which layer (every one if `None`), how wide it is and where it goes, in px.
#[derive(Clone)]
struct Stroke(u64, Option<u64>, f64, Vec<[f64; 2]>);

impl Stroke {
    fn numbers(&self) -> Vec<f64> {
        let Stroke(mode, layer, width, points) = self;
        let units = |px: f64| (px * 4096.0 / f64::from(SIDE)).round();
        let head = [*mode, layer.map_or(0, |id| id + 1)].map(|n| n as f64);
        let points = points.as_flattened().iter().copied().map(units);
        head.into_iter().chain([units(*width) / 2.0, points.len() as f64 / 2.0]).chain(points).collect()
    }

    /// How far a place is from the middle of the stroke, px.
    fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let Stroke(_, _, _, points) = self;
        let lines = points.windows(2.min(points.len()));
        let distances = lines.map(|ends| {
            let (from, to) = (ends[0], ends[ends.len() - 1]);
            let line = [to[0] - from[0], to[1] - from[1]];
            let squared = line[0] * line[0] + line[1] * line[1];
            let along = ((x - from[0]) * line[0] + (y - from[1]) * line[1]) / squared;
            let along = if squared > 0.0 { along.clamp(0.0, 1.0) } else { 0.0 };
            (from[0] + along * line[0] - x).hypot(from[1] + along * line[1] - y)
        });
        distances.fold(f64::INFINITY, f64::min)
    }
}

fn numbers(strokes: &[Stroke]) -> Vec<f64> {
    strokes.iter().flat_map(Stroke::numbers).collect()
}

/// The bytes of every rock, by its layer and its site's place.
type Rocks = BTreeMap<(usize, [u16; 2]), Vec<u32>>;

fn rocks(field: &Field) -> Rocks {
    let mut rocks = BTreeMap::new();
    let mut rock = 0;
    for (k, layer) in field.layers.iter().enumerate() {
        for &site in &layer.selection.selected {
            let mesh = &field.mesh;
            let [from, to] = [mesh.vertex_starts[rock], mesh.vertex_starts[rock + 1]].map(|v| 3 * v as usize);
            let bits = mesh.positions[from..to].iter().chain(&mesh.normals[from..to]).map(|v| v.to_bits());
            let [first, last] = [mesh.rock_starts[rock], mesh.rock_starts[rock + 1]].map(|v| v as usize);
            let corners = mesh.indices[first..last].iter().map(|index| index - mesh.vertex_starts[rock]);
            rocks.insert((k, layer.sites.pixels[site as usize]), bits.chain(corners).collect());
            rock += 1;
        }
    }
    rocks
}

fn middle([x, y]: [u16; 2]) -> [f64; 2] {
    [f64::from(x) + 0.5, f64::from(y) + 0.5]
}

/// How far beyond its edge an edit of a stroke may change rocks, px: a stroke decides about a cell that it touches, a
/// cell about those of finer layers that it touches. In saturated layers every point of a cell is nearer than r + √½ to
/// its site. Rocks that are drawn apart depend on those that they could meet, which lie within twice their cells' reach.
fn reach(params: &Params, field: &Field) -> f64 {
    let across = |radius: f64| 2.0 * (radius + 0.71);
    let chain: f64 = field.layers.iter().map(|layer| across(layer.sites.radius)).sum();
    let largest = field.layers.iter().map(|layer| layer.sites.radius).fold(0.0, f64::max);
    if params.crossing == Crossing::Apart { chain + 2.0 * across(largest) } else { chain }
}

const PRESETS: [&str; 3] = ["journal-fig1", "forest-floor", "riverbed"];

/// How many rocks differ, all of which have to be within `most` of the stroke.
fn differences(stroke: &Stroke, most: f64, before: &Field, after: &Field) -> usize {
    let (old, new) = (rocks(before), rocks(after));
    let differ = |one: &Rocks, other: &Rocks| {
        let places = one.iter().filter(|(place, rock)| other.get(place) != Some(rock)).map(|(place, _)| *place);
        places.collect::<Vec<_>>()
    };
    let places = [differ(&old, &new), differ(&new, &old)].concat();
    for (_, site) in &places {
        let away = stroke.distance(middle(*site));
        assert!(away <= most, "{:?}, {:?}: {site:?} is {away} px away, not {most}", stroke.0, stroke.1);
    }
    places.len()
}

field_test! {
    fn an_edit_of_one_stroke_changes_no_rock_outside_its_reach() {
        let line = vec![[40.0, 50.0], [90.0, 70.0], [130.0, 40.0]];
        let others = [
            Stroke(ERASE, None, 60.0, vec![[220.0, 30.0], [240.0, 260.0]]),
            Stroke(PATH, None, 12.0, vec![[0.0, 200.0], [150.0, 180.0], [320.0, 230.0]]),
        ];
        let mut all: Vec<Params> = PRESETS.map(params).into();
        all.push(Params { crossing: Crossing::Apart, ..params("journal-fig1") });
        for params in all {
            let before = grow(&params, NONE, &numbers(&others));
            for mode in [ADD, ERASE, PATH, RESTORE] {
                for layer in [None, Some(0), Some(1)] {
                    let edited = Stroke(mode, layer, 25.0, line.clone());
                    let after = grow(&params, NONE, &numbers(&[&others[..], std::slice::from_ref(&edited)].concat()));
                    let count = differences(&edited, 12.5 + reach(&params, &before), &before, &after);
                    assert!(count > 0 || mode == RESTORE || mode == ADD, "{mode} {layer:?} changes nothing");
                }
            }
        }
    }
}

field_test! {
    fn a_stroke_does_what_its_kind_says() {
        for name in PRESETS {
            let params = params(name);
            let free = grow(&params, NONE, &[]);
            let line = vec![[40.0, 50.0], [200.0, 250.0]];
            let of = |mode, layer| {
                let stroke = Stroke(mode, layer, 40.0, line.clone());
                let field = grow(&params, NONE, &stroke.numbers());
                let on = rocks(&field).into_keys().filter(|(_, site)| stroke.distance(middle(*site)) < 19.9);
                (on.filter(|(k, _)| layer.is_none_or(|id| id == *k as u64)).count(), field)
            };
            let (plain, _) = of(RESTORE, None);
            assert!(plain > 10, "{name}");
            assert_eq!(of(ERASE, None).0, 0);
            assert_eq!(of(ERASE, Some(0)).0, 0);
            assert_eq!(of(RESTORE, None).1.mesh, free.mesh);
            // What lies on it are the largest rocks that find room, more of them than the layer asks for.
            assert!(of(ADD, Some(0)).0 > of(RESTORE, Some(0)).0, "{name}");
            let (_, path) = of(PATH, None);
            let stroke = Stroke(PATH, None, 40.0, line.clone());
            for layer in &path.layers {
                for &site in &layer.selection.selected {
                    let corners = layer.cells.polygon(site as usize);
                    // A little less than half the width, since strokes are told in 4096ths of the image's width.
                    assert!(corners.iter().all(|v| stroke.distance([v.x, v.y]) > 19.9), "{name}");
                }
            }
            assert!(path.mesh.rocks() > free.mesh.rocks() / 3, "{name}");
        }
    }
}

field_test! {
    fn the_last_stroke_that_reaches_a_place_decides() {
        let params = params("journal-fig1");
        let everything = vec![[-50.0, 150.0], [350.0, 150.0]];
        let whole = |mode| Stroke(mode, None, 900.0, everything.clone());
        let mesh = |strokes: &[Stroke]| grow(&params, (&[0], 1), &numbers(strokes)).mesh;
        assert_eq!(mesh(&[whole(ADD), whole(ERASE)]).rocks(), 0);
        assert_eq!(mesh(&[whole(ERASE), whole(RESTORE)]), grow(&params, NONE, &[]).mesh);
        assert_eq!(mesh(&[whole(PATH), whole(ADD)]), mesh(&[whole(ADD)]));
    }
}

field_test! {
    fn without_a_thin_path_across_a_large_cell_the_cell_stands() {
        let params = params("journal-fig1");
        let free = grow(&params, NONE, &[]);
        let layer = &free.layers[0];
        let cell = layer.selection.selected[0] as usize;
        let corners = layer.cells.polygon(cell);
        let [x, y] = middle(layer.sites.pixels[cell]);
        // Halfway between the site and each corner, so that it passes both at some distance.
        let inside = |k: usize| [0.5 * (x + corners[k].x), 0.5 * (y + corners[k].y)];
        for points in [vec![inside(0)], vec![inside(0), inside(1)], vec![[x - 400.0, y + 3.0], [x + 400.0, y + 3.0]]] {
            let field = grow(&params, NONE, &Stroke(PATH, Some(0), 0.1, points).numbers());
            assert!(!rocks(&field).contains_key(&(0, layer.sites.pixels[cell])));
        }
    }
}

field_test! {
    fn a_bright_mask_changes_nothing_and_under_a_dark_one_nothing_stands() {
        for name in PRESETS {
            let params = params(name);
            let free = grow(&params, NONE, &[]);
            assert_eq!(grow(&params, (&[255], 1), &[]).mesh, free.mesh);
            assert_eq!(grow(&params, (&[0; 6], 2), &[]).mesh.rocks(), 0);
            // Dark above, bright below, with as many rows as the image.
            let mut rows = vec![0; 50 * 300];
            rows[50 * 150..].fill(255);
            let half = rocks(&grow(&params, (&rows, 50), &[]));
            assert!(half.len() > 10 && half.keys().all(|(_, [_, y])| *y < 150), "row 0 of the image is the lowest");
        }
    }
}

field_test! {
    fn a_brighter_mask_keeps_all_rocks_of_the_largest_layer_and_as_many_as_it_is_bright() {
        let mut params = params("journal-fig1");
        params.layers.truncate(1);
        params.layers[0].radius = 12.0;
        params.layers[0].cell_count = Some(100);
        let of = |level: u8| {
            let field = grow(&params, (&[level], 1), &[]);
            field.layers[0].selection.selected.clone()
        };
        let all = of(255);
        assert_eq!(all.len(), 100);
        let mut last = Vec::new();
        for level in [0, 1, 50, 128, 200, 254, 255] {
            let selected = of(level);
            assert!(selected.starts_with(&last), "{level}");
            assert_eq!(selected, all[..selected.len()], "{level}: the layer's own order");
            let expected = 100.0 * f64::from(level) / 255.0;
            assert!((selected.len() as f64 - expected).abs() <= 1.0, "{level}: {}", selected.len());
            last = selected;
        }
    }
}

field_test! {
    fn a_mask_is_read_between_its_pixels() {
        let mut params = params("journal-fig1");
        params.layers.truncate(1);
        (params.layers[0].radius, params.layers[0].area_fraction) = (3.0, 1.0);
        let field = grow(&params, (&[0, 255], 2), &[]);
        let counts: Vec<usize> = (0..3)
            .map(|third| rocks(&field).into_keys().filter(|(_, [x, _])| u32::from(*x) / 100 == third).count())
            .collect();
        assert!(counts[0] < counts[1] && counts[1] < counts[2], "{counts:?}");
        assert!((counts[1] as f64 / (counts[2] as f64) - 0.53).abs() < 0.1, "half as many in the middle: {counts:?}");
    }
}

field_test! {
    fn a_run_after_others_gives_what_a_fresh_one_gives() {
        let mut params = params("journal-fig1");
        let mut generator = Generator::new();
        let erase = Stroke(ERASE, None, 50.0, vec![[100.0, 100.0], [200.0, 150.0]]).numbers();
        let add = Stroke(ADD, Some(1), 50.0, vec![[100.0, 100.0]]).numbers();
        let painted: [(Mask, &[f64]); 5] =
            [(NONE, &[]), (NONE, &erase), ((&[200; 4], 2), &add), (NONE, &add), (NONE, &[])];
        for (mask, strokes) in painted {
            for share in [0.2, 0.4] {
                params.layers[0].area_fraction = share;
                run(&mut generator, &params, mask, strokes);
                let fresh = grow(&params, mask, strokes);
                assert_eq!(generator.mesh(), &fresh.mesh, "{strokes:?}");
                for (ours, layer) in generator.layers().zip(&fresh.layers) {
                    assert_eq!(ours.selection, &layer.selection);
                }
            }
        }
    }
}

field_test! {
    fn what_is_painted_is_read_like_this_on_every_target() {
        // Hashes would say as much; these numbers can be read.
        let mut gradient: Vec<u8> = (0..=255).collect();
        gradient.rotate_left(128);
        let strokes = [
            Stroke(PATH, None, 20.0, vec![[10.0, 20.0], [140.0, 170.0], [290.0, 120.0]]),
            Stroke(ADD, Some(0), 80.0, vec![[60.0, 220.0]]),
            Stroke(ERASE, Some(2), 30.0, vec![[-40.0, 20.0], [400.0, 60.0]]),
        ];
        let fields: Vec<[usize; 2]> = PRESETS
            .iter()
            .map(|name| {
                let field = grow(&params(name), (&gradient, 16), &numbers(&strokes));
                let places = rocks(&field).into_keys().flat_map(|(layer, [x, y])| [layer as u64, x.into(), y.into()]);
                let sum = places.fold(0_u64, |sum, n| (sum ^ n).wrapping_mul(0x0100_0000_01b3).rotate_left(17));
                [field.mesh.rocks(), (sum >> 40) as usize]
            })
            .collect();
        assert_eq!(fields, GOLDEN);
    }
}

/// Numbers of rocks, and a checksum of their places.
const GOLDEN: [[usize; 2]; 3] = [[2005, 10_918_219], [7638, 6_970_412], [1023, 500_860]];

field_test! {
    fn what_is_malformed_is_refused_and_changes_nothing() {
        let mut generator = Generator::new();
        let good = Stroke(ERASE, None, 50.0, vec![[100.0, 100.0]]).numbers();
        generator.set_paint(vec![255], 1, good.clone()).unwrap();
        let bad: [(Mask, &[f64]); 6] = [
            ((&[1; 5], 2), &[]),
            ((&[1; 5], 0), &[]),
            (NONE, &[1.0, 0.0, 5.0]),
            (NONE, &[1.0, 0.0, 5.0, 0.0]),
            (NONE, &[1.0, 0.0, 5.0, 2.0, 7.0, 7.0, 8.0]),
            (NONE, &[1.0, 0.0, 5.0, f64::NAN, 7.0, 7.0]),
        ];
        for (mask, strokes) in bad {
            let error = generator.set_paint(mask.0.to_vec(), mask.1, strokes.to_vec()).unwrap_err();
            assert_eq!((error.code(), error.key()), ("MalformedRequest", "params"), "{mask:?} {strokes:?}");
        }
        let params = params("journal-fig1");
        generator.start(params.clone(), u64::MAX).unwrap();
        while !generator.step().unwrap() {}
        assert_eq!(generator.mesh(), &grow(&params, (&[255], 1), &good).mesh);
    }
}

field_test! {
    fn strokes_that_lie_far_outside_or_have_many_points_are_strokes_like_others() {
        let params = params("journal-fig1");
        let free = grow(&params, NONE, &[]).mesh;
        let outside = Stroke(ERASE, None, 10.0, vec![[-9000.0, -9000.0], [9000.0, -9000.0]]);
        assert_eq!(grow(&params, NONE, &outside.numbers()).mesh, free);
        let many = Stroke(PATH, None, 1.0, (0..6000).map(|k| [f64::from(k % 2), -30.0]).collect());
        assert_eq!(grow(&params, NONE, &many.numbers()).mesh, free);
        // Numbers that are none reach nothing.
        assert_eq!(grow(&params, NONE, &[7.0, 0.0, f64::NAN, 1.0, f64::INFINITY, f64::NAN]).mesh, free);
    }
}
