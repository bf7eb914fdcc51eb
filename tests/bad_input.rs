//! Degenerate but legal input has a defined result; illegal input a named error, and nothing changes.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{checked, field_test, layer, link, params};
use rock_field::params::{Border, Darts, Layer, MAX_LAYERS, Notation, PARAMS, PRESETS, Params, Scope, Swing};
use rock_field::rocks::{Field, Generator, generate};
use rock_field::{Error, memory_estimate};

/// Bytes a page may ask for; 512 MiB on devices that report 4 GB or less.
const DEFAULT_BUDGET: u64 = 3 << 29;

/// A checked field; checked means finite, too.
fn field(params: &Params) -> Field {
    checked(params).unwrap_or_else(|violation| panic!("{violation}"))
}

fn assert_empty(field: &Field) {
    let mesh = &field.mesh;
    assert_eq!((mesh.rocks(), mesh.triangles(), field.covered_fraction()), (0, 0, 0.0));
    assert!(mesh.positions.is_empty() && mesh.normals.is_empty());
    assert_eq!((&mesh.rock_starts[..], &mesh.vertex_starts[..]), (&[0][..], &[0][..]));
}

field_test! {
    fn zero_layers_are_an_empty_field() {
        for (width, height) in [(1, 1), (300, 200)] {
            let field = field(&params(width, height, Vec::new()));
            assert_eq!(field.layers.len(), 0);
            assert_empty(&field);
        }
    }
}

field_test! {
    fn a_radius_beyond_the_image_has_no_site_or_one() {
        // N_p = 0: Eq. 1 asks for no site at all.
        let none = field(&params(100, 80, vec![layer(0, 500.0, 1.0)]));
        assert_eq!(none.layers[0].sites.target, 0);
        assert_eq!(none.layers[0].cells.len(), 0);
        assert!(none.layers[0].selection.saturated);
        assert_empty(&none);
        // N_p = 1: one cell, the image.
        let one = field(&Params { packing: 1.0, ..params(100, 80, vec![layer(0, 100.0, 1.0)]) });
        assert_eq!((one.layers[0].sites.target, one.layers[0].cells.len()), (1, 1));
        assert_eq!((one.mesh.rocks(), one.mesh.triangles()), (1, 10));
        assert_eq!(one.covered_fraction(), 1.0);
        // N_p above one, but the first disc covers everything.
        let full = field(&Params { packing: 1.0, ..params(100, 80, vec![layer(0, 70.0, 1.0)]) });
        assert!(full.layers[0].sites.target > 1);
        for radius in [8192.0, 8191.999] {
            assert_empty(&field(&params(64, 64, vec![layer(0, radius, 1.0)])));
        }
    }
}

field_test! {
    fn a_radius_of_one_pixel_puts_sites_on_pixels() {
        for packing in [0.0, 0.3, 0.7, 1.0] {
            for darts in [Darts::Saturate, Darts::Attempts] {
                let field = field(&Params { packing, darts, ..params(60, 40, vec![layer(0, 1.0, 0.5)]) });
                assert_eq!(field.layers[0].sites.saturated, packing == 1.0 && darts == Darts::Saturate);
            }
        }
        let full = field(&Params { packing: 1.0, ..params(60, 40, vec![layer(0, 1.0, 1.0)]) });
        assert_eq!((full.layers[0].cells.len(), full.mesh.rocks()), (60 * 40, 60 * 40));
    }
}

field_test! {
    fn a_radius_below_a_pixel_ends_although_eq_1_asks_for_billions_of_sites() {
        // The conference's notation on a narrow image: a hundredth of a hundredth of its width.
        let tiny = Layer { radius: 0.01, area_fraction: 1.0, ..Layer::with_defaults(0, Notation::Relative) };
        for darts in [Darts::Saturate, Darts::Attempts] {
            for (width, height) in [(1, 1), (1, 300), (7, 36)] {
                let narrow = params(width, height, vec![tiny.clone()]);
                let field = field(&Params { notation: Notation::Relative, darts, ..narrow });
                assert!(field.layers[0].sites.target > 10_000_000);
                assert_eq!(field.mesh.rocks() as u32, width * height);
            }
        }
    }
}

field_test! {
    fn no_area_is_no_rock_and_other_layers_go_on() {
        let field = field(&params(300, 200, vec![layer(0, 40.0, 0.0), layer(1, 12.0, 0.5)]));
        let [none, some] = &field.layers[..] else { panic!("two layers") };
        assert!(none.selection.selected.is_empty() && !none.selection.saturated);
        assert!(some.area_reached() >= 0.5);
        let counted = Layer { cell_count: Some(0), ..layer(0, 40.0, 1.0) };
        assert_empty(&self::field(&params(300, 200, vec![counted])));
    }
}

field_test! {
    fn areas_that_sum_above_one_saturate() {
        let field = field(&params(300, 200, vec![layer(0, 40.0, 1.0), layer(1, 30.0, 1.0), layer(2, 5.0, 1.0)]));
        assert_eq!(field.covered_fraction(), 1.0);
        assert!(field.layers[1].selection.saturated && field.layers[2].selection.saturated);
        assert!(!field.layers[0].selection.saturated);
        assert_eq!(field.layers[1].selection.selected.len(), 0);
        let counted = Layer { cell_count: Some(u32::MAX), ..layer(0, 40.0, 0.0) };
        let all = self::field(&params(300, 200, vec![counted]));
        assert_eq!(all.mesh.rocks(), all.layers[0].cells.len());
    }
}

field_test! {
    fn one_row_and_one_column_of_pixels() {
        for (width, height) in [(1, 1), (2, 1), (300, 1), (1, 300), (8192, 1), (1, 8192)] {
            for radius in [1.0, 3.5, 30.0] {
                let field = field(&Params { packing: 1.0, ..params(width, height, vec![layer(0, radius, 0.6)]) });
                let drop = Params { border: Border::Drop, ..params(width, height, vec![layer(0, radius, 0.6)]) };
                // Every cell of a single row touches the border.
                assert_empty(&self::field(&drop));
                if field.layers[0].sites.target > 0 {
                    assert!(field.mesh.rocks() > 0, "{width} × {height}, r {radius}");
                }
            }
        }
    }
}

field_test! {
    fn a_taper_that_turns_rocks_inside_out_stays_literal() {
        for taper in [[-500.0, -500.0, -500.0], [500.0, 500.0, 500.0], [-36.0, 0.0, 0.0], [0.0, 500.0, -500.0]] {
            for swing in [Swing::Shared, Swing::Separate] {
                let rocks = Layer { taper, height: [500.0, 500.0, 500.0], ..layer(0, 12.0, 0.7) };
                let field = field(&Params { swing, ..params(200, 150, vec![rocks]) });
                assert!(field.mesh.rocks() > 50);
                assert!(field.mesh.positions.iter().chain(&field.mesh.normals).all(|v| v.is_finite()));
            }
        }
    }
}

field_test! {
    fn flat_rocks_have_normals() {
        let flat = Layer { taper: [0.0; 3], height: [0.0; 3], ..layer(0, 12.0, 0.7) };
        let field = field(&params(200, 150, vec![flat]));
        assert!(field.mesh.normals.chunks_exact(3).all(|n| n == [0.0, 0.0, 1.0]));
    }
}

/// What start() must leave alone.
fn state(generator: &Generator) -> impl PartialEq + std::fmt::Debug + use<> {
    let layers: Vec<_> = generator
        .layers()
        .map(|view| {
            let cells: Vec<_> = view.cells.vertices.iter().map(|v| v.to_array().map(f64::to_bits)).collect();
            (view.summary(), view.sites.pixels.clone(), cells, view.selection.clone())
        })
        .collect();
    (layers, generator.mesh().clone(), generator.summary(), generator.stage(), generator.progress())
}

/// Starts a run that must be refused with this error, on a finished generator, on one at work and on a new one.
fn assert_refused(bad: &Params, max_bytes: u64, is_right: impl Fn(&Error) -> bool) {
    let good = params(200, 150, vec![layer(0, 12.0, 0.4), layer(1, 5.0, 0.4)]);
    let expected = generate(&good).unwrap();
    for steps in [0, 3, usize::MAX] {
        let mut generator = Generator::new();
        generator.start(good.clone(), u64::MAX).unwrap();
        (0..steps).find(|_| generator.step().unwrap());
        let before = state(&generator);
        let error = generator.start(bad.clone(), max_bytes).unwrap_err();
        assert!(is_right(&error), "{error:?}\n  {}", link(bad));
        assert!(error.to_string().contains(error.key()), "{error}");
        assert_eq!(before, state(&generator), "{error}");
        // The run goes on where it was.
        while !generator.step().unwrap() {}
        assert_eq!(common::difference(&generator.into_field(), &expected), None);
    }
    assert!(Generator::new().start(bad.clone(), max_bytes).is_err());
}

field_test! {
    fn a_number_out_of_range_is_refused_with_its_key_value_and_bounds() {
        for spec in PARAMS {
            let range = spec.range;
            for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, range.max * 1.5 + 1.0, range.min - 1.0] {
                let mut bad = params(200, 150, vec![layer(0, 12.0, 0.4), layer(1, 5.0, 0.4)]);
                let (layer_at, given) = match spec.scope {
                    Scope::Field(get, set) => {
                        set(&mut bad, wrong);
                        (None, get(&bad))
                    }
                    Scope::Item(get, set) => {
                        set(&mut bad.layers[1], wrong);
                        (Some(1), get(&bad.layers[1]))
                    }
                };
                // Whole numbers and choices live in types that cannot hold most wrong values; NaN is "no count".
                if (range.min..=range.max).contains(&given) || (given.is_nan() && range.default.is_nan()) {
                    continue;
                }
                assert_refused(&bad, u64::MAX, |error| {
                    let [value, min, max] = error.numbers();
                    error.code() == "OutOfRange"
                        && (error.key(), error.layer()) == (spec.key, layer_at)
                        && (value == given || (value.is_nan() && given.is_nan()))
                        && [min, max] == [range.min, range.max]
                });
            }
        }
    }
}

field_test! {
    fn too_many_layers_and_repeated_ids_are_refused() {
        let many = params(200, 150, (0..=MAX_LAYERS as u32).map(|id| layer(id, 20.0, 0.1)).collect());
        assert_refused(&many, u64::MAX, |error| *error == Error::TooManyLayers { value: MAX_LAYERS + 1, max: MAX_LAYERS });
        let twice = params(200, 150, vec![layer(4, 20.0, 0.1), layer(1, 20.0, 0.1), layer(4, 9.0, 0.1)]);
        assert_refused(&twice, u64::MAX, |error| *error == Error::DuplicateLayerId { value: 4 });
    }
}

field_test! {
    fn a_request_over_the_budget_is_refused_with_the_numbers_and_what_saves_most() {
        let dense = params(8192, 8192, vec![layer(0, 2.0, 1.0), layer(1, 90.0, 0.2)]);
        let wide = params(8192, 64, vec![layer(0, 8000.0, 0.0)]);
        let high = params(64, 8192, Vec::new());
        for (params, key) in [(dense, "radius"), (wide, "imageWidth"), (high, "imageHeight")] {
            let needed = memory_estimate(&params);
            let budget = needed.bytes - 1;
            let expected = Error::OverBudget { key, estimate: needed.bytes, budget };
            assert_refused(&params, budget, |error| *error == expected);
            assert_eq!(expected.numbers(), [needed.bytes as f64, 0.0, budget as f64]);
            assert!(Generator::new().start(params, needed.bytes).is_ok());
        }
    }
}

field_test! {
    fn a_run_that_turns_out_too_large_ends_before_its_rocks_are_made_and_the_next_one_is_as_on_a_new_generator() {
        let good = params(200, 150, vec![layer(0, 12.0, 0.4), layer(1, 5.0, 0.4)]);
        // Nobody can know beforehand how many rocks stand beside a footprint.
        let large = params(600, 600, vec![layer(0, 2.0, 1.0)]);
        let budget = 22 << 20;
        let mut generator = Generator::new();
        generator.set_footprint(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]).unwrap();
        generator.start(large, budget).unwrap();
        let error = loop {
            match generator.step() {
                Ok(done) => assert!(!done),
                Err(error) => break error,
            }
        };
        let Error::OverBudget { key: "radius", estimate, budget: told } = error else { panic!("{error:?}") };
        assert!(estimate > budget && told == budget && generator.mesh().rocks() == 0);
        assert_eq!(generator.step(), Ok(true));
        generator.set_footprint(&[]).unwrap();
        generator.start(good.clone(), budget).unwrap();
        while !generator.step().unwrap() {}
        assert_eq!(common::difference(&generator.into_field(), &generate(&good).unwrap()), None);
    }
}

field_test! {
    fn every_preset_of_the_papers_at_8192_fits_the_default_budget() {
        for preset in PRESETS.iter().filter(|preset| !preset.natural) {
            let large = Params { image_width: 8192, image_height: 8192, ..preset.params() };
            let estimate = memory_estimate(&large);
            assert_eq!(estimate.check(DEFAULT_BUDGET), Ok(()), "{}", preset.name);
        }
    }
}

field_test! {
    fn progress_begins_at_nothing_and_never_goes_back() {
        let mut generator = Generator::new();
        generator.start(Params { image_width: 300, image_height: 300, ..Params::default() }, u64::MAX).unwrap();
        let mut last = generator.progress();
        assert_eq!(last, 0.0);
        while !generator.step().unwrap() {
            let now = generator.progress();
            assert!((last..=1.0).contains(&now), "{last} → {now}");
            last = now;
        }
        assert_eq!(generator.progress(), 1.0);
    }
}
