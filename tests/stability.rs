//! What stays still when a parameter moves (decision A21): every random choice hangs on the seed, its purpose, the layer's id and
//! the site, on nothing else.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::collections::BTreeMap;

use common::field_test;
use glam::Vec3;
use rock_field::params::{Border, Params, Swing};
use rock_field::rocks::{Field, FieldLayer, generate};

fn fig1() -> Params {
    Params { seed: 5, image_width: 600, image_height: 500, ..Params::default() }
}

fn field(params: &Params) -> Field {
    generate(params).unwrap()
}

/// Fig. 1 with one thing changed.
fn changed(change: impl Fn(&mut Params)) -> Field {
    let mut params = fig1();
    change(&mut params);
    field(&params)
}

fn same_sites(a: &FieldLayer, b: &FieldLayer) -> bool {
    a.sites.pixels == b.sites.pixels && a.cells.starts == b.cells.starts && a.cells.vertices == b.cells.vertices
}

fn same_shapes(a: &FieldLayer, b: &FieldLayer) -> bool {
    a.selection == b.selection && a.shapes == b.shapes
}

/// Position of every vertex of every rock of a layer, by site.
fn rocks_of(field: &Field, k: usize) -> BTreeMap<u32, Vec<Vec3>> {
    let before: usize = field.layers[..k].iter().map(|layer| layer.selection.selected.len()).sum();
    let mesh = &field.mesh;
    (before..)
        .zip(&field.layers[k].selection.selected)
        .map(|(rock, &site)| {
            let vertices = mesh.vertex_starts[rock] as usize..mesh.vertex_starts[rock + 1] as usize;
            (site, vertices.map(|v| Vec3::from_slice(&mesh.positions[3 * v..])).collect())
        })
        .collect()
}

field_test! {
    fn taper_and_height_move_no_site_cell_selection_or_shape() {
        let before = field(&fig1());
        for part in 0..3 {
            for after in [
                changed(|params| params.layers.iter_mut().for_each(|layer| layer.taper[part] = -17.25)),
                changed(|params| params.layers.iter_mut().for_each(|layer| layer.height[part] = 31.5)),
            ] {
                for (a, b) in before.layers.iter().zip(&after.layers) {
                    assert!(same_sites(a, b) && same_shapes(a, b));
                }
                assert_eq!(before.mesh.indices, after.mesh.indices);
                assert_ne!(before.mesh.positions, after.mesh.positions);
            }
        }
    }
}

field_test! {
    fn j1_and_j2_are_drawn_even_where_their_factors_are_zero() {
        let steps = |field: &Field| -> Vec<[f32; 2]> {
            field.mesh.positions.chunks_exact(3).map(|p| [p[0], p[1]]).collect()
        };
        let before = field(&fig1());
        let after = changed(|params| params.layers.iter_mut().for_each(|layer| layer.height = [3.0, 0.0, 0.0]));
        assert_eq!(steps(&before), steps(&after));
    }
}

field_test! {
    fn separate_swings_keep_the_outline_and_move_only_heights() {
        let before = field(&fig1());
        let after = changed(|params| params.swing = Swing::Separate);
        for (a, b) in before.mesh.positions.chunks_exact(3).zip(after.mesh.positions.chunks_exact(3)) {
            assert_eq!(a[..2], b[..2]);
        }
        assert_ne!(before.mesh.positions, after.mesh.positions);
    }
}

field_test! {
    fn raising_an_area_appends_rocks_of_that_layer() {
        for k in 0..3 {
            let less = changed(|params| params.layers[k].area_fraction = 0.1);
            let more = changed(|params| params.layers[k].area_fraction = 0.17);
            let [less_layer, more_layer] = [&less, &more].map(|field| &field.layers[k]);
            let (few, many) = (&less_layer.selection.selected, &more_layer.selection.selected);
            assert!(few.len() < many.len());
            assert_eq!(few[..], many[..few.len()]);
            // The rocks that stood there stand there still.
            let (less_rocks, more_rocks) = (rocks_of(&less, k), rocks_of(&more, k));
            assert!(less_rocks.iter().all(|(site, rock)| more_rocks.get(site) == Some(rock)));
            // Coarser layers are chosen before, finer ones may lose some; no site moves.
            for other in 0..3 {
                assert!(same_sites(&less.layers[other], &more.layers[other]));
                assert!(other >= k || same_shapes(&less.layers[other], &more.layers[other]));
            }
        }
    }
}

field_test! {
    fn a_count_takes_the_same_cells_as_an_area() {
        let by_area = field(&fig1());
        let count = by_area.layers[1].selection.selected.len() as u32;
        let by_count = changed(|params| params.layers[1].cell_count = Some(count));
        assert_eq!(by_area.mesh, by_count.mesh);
    }
}

field_test! {
    fn a_radius_leaves_the_sites_of_the_other_layers_alone() {
        let before = field(&fig1());
        for k in 0..3 {
            let after = changed(|params| params.layers[k].radius *= 1.3);
            for other in 0..3 {
                assert_eq!(same_sites(&before.layers[other], &after.layers[other]), other != k);
            }
        }
    }
}

field_test! {
    fn streams_hang_on_the_id_and_not_on_the_place() {
        let before = field(&fig1());
        let turned = changed(|params| params.layers.rotate_left(1));
        for (k, layer) in before.layers.iter().enumerate() {
            let other = &turned.layers[(k + 2) % 3];
            assert!(layer.layer.id == other.layer.id && same_sites(layer, other) && same_shapes(layer, other));
            assert_eq!(rocks_of(&before, k), rocks_of(&turned, (k + 2) % 3));
        }
        // Equal radii in two layers are two diagrams; another id is another diagram.
        let equal = changed(|params| params.layers[1].radius = params.layers[0].radius);
        assert_ne!(equal.layers[0].sites.pixels, equal.layers[1].sites.pixels);
        let renamed = changed(|params| params.layers[1].id = 77);
        assert_ne!(before.layers[1].sites.pixels, renamed.layers[1].sites.pixels);
        assert!(same_sites(&before.layers[2], &renamed.layers[2]));
    }
}

field_test! {
    fn removing_a_layer_keeps_the_sites_of_the_others() {
        let before = field(&fig1());
        for k in 0..3 {
            let after = changed(|params| {
                params.layers.remove(k);
            });
            let others = before.layers.iter().enumerate().filter(|&(index, _)| index != k);
            for ((index, a), b) in others.zip(&after.layers) {
                assert!(same_sites(a, b));
                // What was chosen before the removed layer is untouched.
                assert!(index > k || same_shapes(a, b));
            }
        }
    }
}

field_test! {
    fn a_rock_depends_on_its_own_site_alone() {
        // Refusing border cells, filling other areas and adding a coarser layer change which rocks there are, and none of those
        // that remain.
        let before = field(&fig1());
        let others = [
            changed(|params| params.border = Border::Drop),
            changed(|params| params.layers[0].area_fraction = 0.45),
            changed(|params| {
                let extra = rock_field::params::Layer { id: 9, radius: 150.0, ..params.layers[0].clone() };
                params.layers.insert(0, extra);
            }),
        ];
        for after in others {
            let mut kept = 0;
            for (k, layer) in before.layers.iter().enumerate() {
                let there = after.layers.iter().position(|other| other.layer.id == layer.layer.id).unwrap();
                let rocks = rocks_of(&after, there);
                for (site, rock) in rocks_of(&before, k) {
                    if let Some(other) = rocks.get(&site) {
                        assert_eq!(rock, *other, "site {site} of layer {k}");
                        kept += 1;
                    }
                }
            }
            assert!(kept > 100 && kept < before.mesh.rocks(), "{kept} of {} rocks", before.mesh.rocks());
        }
    }
}

field_test! {
    fn another_seed_is_another_field() {
        let [a, b] = [6, 7].map(|seed| changed(|params| params.seed = seed));
        for (a, b) in a.layers.iter().zip(&b.layers) {
            assert_ne!(a.sites.pixels, b.sites.pixels);
        }
    }
}
