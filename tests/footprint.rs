//! Where something else stands, no rock grows (an addition to Fig. 7).
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::field_test;
use rock_field::params::{Params, preset};
use rock_field::rocks::{Field, Generator, cell_pixels};

/// A bar across the image, aslant, as two triangles; and a far smaller one in a corner.
const BAR: [f64; 18] = [
    -20.0, 60.0, 300.0, 150.0, 300.0, 190.0, -20.0, 60.0, 300.0, 190.0, -20.0, 100.0, // the bar
    1.5, 1.5, 9.0, 2.0, 3.0, 8.0,
];

fn params() -> Params {
    let mut params = preset("journal-fig1").unwrap().params();
    (params.image_width, params.image_height, params.seed) = (256, 256, 3);
    params
}

fn run(generator: &mut Generator, params: &Params) {
    generator.start(params.clone(), u64::MAX).unwrap();
    while !generator.step().unwrap() {}
}

fn grow(footprint: &[f64]) -> Field {
    let mut generator = Generator::new();
    generator.set_footprint(footprint).unwrap();
    run(&mut generator, &params());
    generator.into_field()
}

/// Whether the middle of a pixel lies in one of the triangles.
fn is_covered([x, y]: [f64; 2]) -> bool {
    BAR.chunks_exact(6).any(|t| {
        let side = |i: usize, j: usize| (t[j] - t[i]) * (y - t[i + 1]) - (t[j + 1] - t[i + 1]) * (x - t[i]);
        let sides = [side(0, 2), side(2, 4), side(4, 0)];
        sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
    })
}

field_test! {
    fn no_selected_cell_has_a_pixel_that_the_footprint_covers() {
        let (free, kept) = (grow(&[]), grow(&BAR));
        let covered = |field: &Field| {
            let pixels = field.layers.iter().flat_map(|layer| {
                let cells = layer.selection.selected.iter();
                cells.flat_map(|&cell| cell_pixels(&layer.sites, &layer.cells, cell as usize)).collect::<Vec<_>>()
            });
            pixels.filter(|&[x, y]| is_covered([f64::from(x) + 0.5, f64::from(y) + 0.5])).count()
        };
        assert!(covered(&free) > 1000, "the bar is where rocks would be");
        assert_eq!(covered(&kept), 0);
        assert!(kept.mesh.rocks() > free.mesh.rocks() / 2, "{} of {} rocks", kept.mesh.rocks(), free.mesh.rocks());
    }
}

field_test! {
    fn a_footprint_put_down_and_taken_away_gives_what_a_fresh_run_gives() {
        let mut generator = Generator::new();
        run(&mut generator, &params());
        generator.set_footprint(&BAR).unwrap();
        assert_eq!(generator.mesh(), &grow(&[]).mesh, "it counts from the next start on");
        run(&mut generator, &params());
        assert_eq!(generator.mesh(), &grow(&BAR).mesh);
        generator.set_footprint(&[]).unwrap();
        run(&mut generator, &params());
        assert_eq!(generator.mesh(), &grow(&[]).mesh);
    }
}

field_test! {
    fn a_refused_footprint_changes_nothing() {
        let mut generator = Generator::new();
        generator.set_footprint(&BAR).unwrap();
        let error = generator.set_footprint(&[f64::NAN; 6]).unwrap_err();
        assert_eq!((error.key(), error.code()), ("footprint", "OutOfRange"));
        run(&mut generator, &params());
        assert_eq!(generator.mesh(), &grow(&BAR).mesh);
    }
}

field_test! {
    fn an_image_covered_whole_has_no_rocks() {
        let field = grow(&[-1.0, -1.0, 600.0, -1.0, -1.0, 600.0]);
        assert_eq!(field.mesh.rocks(), 0);
    }
}
