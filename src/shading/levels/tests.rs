//! The levels of real fields: of presets that are subdivided.

use std::collections::BTreeMap;

use glam::{Mat4, Vec3, Vec4};

use super::{Arrangement, Body, Group, LEVELS, Sight, coarser, least_of};
use crate::Mesh;
use crate::params::{PRESETS, Params};
use crate::rocks::generate;

const SIZE: u32 = 128;

fn preset(name: &str) -> Params {
    let mut params = PRESETS.iter().find(|preset| preset.name == name).expect("a preset").params();
    (params.image_width, params.image_height) = (SIZE, SIZE);
    params
}

fn mesh_of(params: &Params) -> Mesh {
    generate(params).expect("a field").mesh
}

fn positions(mesh: &Mesh) -> Vec<Vec3> {
    mesh.positions.chunks_exact(3).map(Vec3::from_slice).collect()
}

fn bodies(mesh: &Mesh) -> Vec<Body> {
    let positions = positions(mesh);
    let of = |rock: usize| {
        let vertices = &positions[mesh.vertex_starts[rock] as usize..mesh.vertex_starts[rock + 1] as usize];
        Body {
            layer: u32::from(mesh.rock_layer[rock]),
            low: vertices.iter().fold(Vec3::INFINITY, |low, at| low.min(*at)),
            high: vertices.iter().fold(Vec3::NEG_INFINITY, |high, at| high.max(*at)),
            vertices: vertices.len() as u32,
            triangles: (mesh.rock_starts[rock + 1] - mesh.rock_starts[rock]) / 3,
            is_hidden: false,
        }
    };
    (0..mesh.rock_layer.len()).map(of).collect()
}

fn triangles(mesh: &Mesh, rock: usize) -> &[u32] {
    &mesh.indices[mesh.rock_starts[rock] as usize..mesh.rock_starts[rock + 1] as usize]
}

fn level(body: &Body, level: usize, mesh: &Mesh, rock: usize) -> Vec<u32> {
    let mut out = Vec::new();
    coarser(body, level, triangles(mesh, rock), &mut out);
    out
}

#[test]
fn how_often_a_rock_is_subdivided_is_told_by_its_counts() {
    for preset in PRESETS {
        let mut params = self::preset(preset.name);
        params.layers.iter_mut().for_each(|layer| layer.detail *= 2.0);
        let field = generate(&params).expect("a field");
        let whole = field
            .layers
            .iter()
            .flat_map(|layer| (0..layer.shapes.len()).map(|rock| layer.shapes.triangles_of(rock).len() as u32));
        for (body, whole) in bodies(&field.mesh).iter().zip(whole) {
            assert_eq!(body.segments().pow(2) * whole, body.triangles, "{}", preset.name);
        }
    }
}

#[test]
fn no_other_rock_has_the_counts_of_one_that_is_subdivided() {
    for corners in 3..40 {
        for m in [1, 2, 4, 8, 16, 32] {
            let triangles = (3 * corners - 2) * m * m;
            let vertices = (triangles + corners * m) / 2 + 1;
            let body = Body { layer: 0, low: Vec3::ZERO, high: Vec3::ONE, vertices, triangles, is_hidden: false };
            assert_eq!(body.segments(), m, "{corners} corners");
        }
    }
}

#[test]
fn a_level_is_the_mesh_of_a_field_that_is_subdivided_less_often() {
    let mut fine = preset("riverbed");
    for layer in &mut fine.layers {
        // Without noise, and with nothing that depends on how often a rock is subdivided.
        (layer.detail, layer.roughness, layer.weathering) = (120.0, 0.0, 0.0);
    }
    let mesh = mesh_of(&fine);
    let most = bodies(&mesh).iter().map(Body::segments).max();
    assert!(most == Some(16) || most == Some(32), "{most:?}");
    for l in 0..LEVELS {
        let mut coarse = fine.clone();
        coarse.layers.iter_mut().for_each(|layer| layer.detail /= f64::from(1 << l));
        let expected = mesh_of(&coarse);
        let (ours, theirs) = (positions(&mesh), positions(&expected));
        for (rock, body) in bodies(&mesh).iter().enumerate() {
            let found = level(body, l, &mesh, rock);
            assert_eq!(found.len() as u32, 3 * body.triangles_at(l));
            let at: Vec<Vec3> = found.iter().map(|&v| ours[v as usize]).collect();
            let wanted: Vec<Vec3> = triangles(&expected, rock).iter().map(|&v| theirs[v as usize]).collect();
            assert_eq!(at, wanted, "level {l} of rock {rock}");
        }
    }
}

#[test]
fn no_level_has_a_crack_or_another_outline_than_its_rim() {
    let mesh = mesh_of(&preset("quarry-rubble"));
    for (rock, body) in bodies(&mesh).iter().enumerate() {
        for l in 0..LEVELS {
            let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
            for triangle in level(body, l, &mesh, rock).chunks_exact(3) {
                for k in 0..3 {
                    let [a, b] = [triangle[k], triangle[(k + 1) % 3]];
                    *sides.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                }
            }
            let open = sides.values().filter(|count| **count != 0).count() as u32;
            let rim = (body.triangles / body.segments().pow(2)).div_ceil(3) * body.segments();
            assert_eq!(open, rim / body.step(l), "rock {rock}, level {l}");
        }
    }
}

/// Looks at the middle of the field from `eye`.
fn sight(eye: Vec3, most: f32) -> Sight {
    let middle = Vec3::new(SIZE as f32 / 2.0, SIZE as f32 / 2.0, 0.0);
    let forward = (middle - eye).normalize();
    let right = forward.cross(Vec3::Z).normalize();
    let up = right.cross(forward);
    // Depth does not matter.
    let rows = [right * 1.5, up * 2.5, forward, forward];
    let column = |axis: Vec3| Vec4::from(rows.map(|row| row.dot(axis)));
    let clip_from_eye = Mat4::from_cols(column(Vec3::X), column(Vec3::Y), column(Vec3::Z), Vec4::ZERO);
    Sight { clip_from_eye, eye, sunk: 0.0, scale: 1000.0, most, least: 0.0, is_part: false }
}

#[test]
fn every_rock_is_drawn_once_and_each_at_one_level() {
    let mesh = mesh_of(&preset("riverbed"));
    let bodies = bodies(&mesh);
    let arranged = Arrangement::of(&bodies, [SIZE as f32; 2]);
    let lengths = |l: usize| bodies.iter().map(|body| 3 * body.triangles_at(l)).sum::<u32>();
    assert_eq!(arranged.length, (0..LEVELS).map(lengths).sum::<u32>());
    assert_eq!(arranged.length, Arrangement::length_of(&bodies));
    let mut order = arranged.order.clone();
    order.sort_unstable();
    assert_eq!(order, (0..bodies.len() as u32).collect::<Vec<_>>());
    let drawn = |ranges: &[std::ops::Range<u32>]| ranges.iter().map(|range| range.len() as u32).sum::<u32>();
    assert_eq!(drawn(&arranged.all(0.0, false)), lengths(0));
    assert_eq!(drawn(&arranged.all(f32::INFINITY, false)), lengths(LEVELS - 1));
    let far = Vec3::new(64.0, -400.0, 400.0);
    assert_eq!(drawn(&arranged.seen(&sight(far, 0.0))), lengths(0), "all of it is in the picture");
    let [coarse, fine] = [100.0, 1.0].map(|most| drawn(&arranged.seen(&sight(far, most))));
    assert!(lengths(LEVELS - 1) <= coarse && coarse < fine && fine <= lengths(0));
}

#[test]
fn what_is_in_the_picture_is_drawn_and_what_is_behind_the_eye_is_not() {
    let mesh = mesh_of(&preset("riverbed"));
    let bodies = bodies(&mesh);
    let positions = positions(&mesh);
    let arranged = Arrangement::of(&bodies, [SIZE as f32; 2]);
    let mut buffer = Vec::new();
    for l in 0..LEVELS {
        for &rock in &arranged.order {
            buffer.extend(level(&bodies[rock as usize], l, &mesh, rock as usize));
        }
    }
    let mut left_out = 0;
    for (x, y) in [(64.0, 20.0), (10.0, 64.0), (120.0, 120.0), (64.0, 63.0)] {
        let sight = sight(Vec3::new(x, y, 6.0), 0.0);
        let mut drawn = vec![false; positions.len()];
        for range in arranged.seen(&sight) {
            buffer[range.start as usize..range.end as usize].iter().for_each(|&v| drawn[v as usize] = true);
        }
        for (v, at) in positions.iter().enumerate() {
            let clip = sight.clip_from_eye * (*at - sight.eye).extend(1.0);
            let is_inside = clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w;
            assert!(!is_inside || drawn[v], "vertex {v} is seen from {x}, {y} and not drawn");
            left_out += u32::from(!drawn[v]);
        }
    }
    assert!(left_out > positions.len() as u32, "a quarter at least is behind the eyes");
}

#[test]
fn what_is_nearer_is_drawn_first() {
    let mesh = mesh_of(&preset("riverbed"));
    let arranged = Arrangement::of(&bodies(&mesh), [SIZE as f32; 2]);
    for (x, y) in [(64.0, -100.0), (200.0, 64.0), (-50.0, 150.0)] {
        let sight = sight(Vec3::new(x, y, 60.0), 0.0);
        let distance = |start: u32| {
            let group = arranged.groups.iter().find(|group| group.ranges[0].contains(&start)).expect("a group");
            sight.distance(group.low, group.high).expect("in the picture")
        };
        let distances: Vec<f32> = arranged.seen(&sight).iter().map(|range| distance(range.start)).collect();
        assert!(distances.len() > 3 && distances.is_sorted(), "{distances:?}");
    }
}

#[test]
fn a_rock_that_sinks_into_the_picture_is_drawn() {
    let high = Group { low: Vec3::new(60.0, 60.0, 150.0), high: Vec3::new(68.0, 68.0, 155.0), ..Group::EMPTY };
    let sight = sight(Vec3::new(64.0, -200.0, 20.0), 0.0);
    assert!(sight.distance(high.low, high.high).is_none());
    assert!(Sight { sunk: 150.0, ..sight }.distance(high.low, high.high).is_some());
}

#[test]
fn the_smaller_rocks_are_left_out_first_and_alike_near_and_afar() {
    let mesh = mesh_of(&preset("riverbed"));
    let arranged = Arrangement::of(&bodies(&mesh), [SIZE as f32; 2]);
    let far = sight(Vec3::new(64.0, -4000.0, 4000.0), 0.0);
    let indices = |ranges: Vec<std::ops::Range<u32>>| ranges.iter().map(|range| range.len()).sum::<usize>();
    let counts = [0.0, 0.5, 2.0, 1e9].map(|least| {
        let sight = Sight { least, ..far };
        let [near, afar] = [indices(arranged.seen(&sight)), indices(arranged.seen_afar(&sight))];
        assert!(near.abs_diff(afar) <= near / 5, "{least}: {near} and {afar}");
        afar
    });
    assert!(counts.is_sorted_by(|a, b| a > b) && counts[3] == 0, "{counts:?}");
    let shown = |least: f32| {
        let sight = Sight { least, ..far };
        let is_shown = |group: &&Group| sight.shows(group, 5600.0);
        arranged.groups.iter().filter(is_shown).map(|group| group.surface / group.rocks).fold(f32::INFINITY, f32::min)
    };
    assert!(shown(2.0) > shown(0.5));
}

#[test]
fn a_copy_reaches_into_the_field_where_it_lies_over_it_or_throws_its_shadow_there() {
    let mesh = mesh_of(&preset("riverbed"));
    let image = [SIZE as f32; 2];
    let arranged = Arrangement::of(&bodies(&mesh), image);
    let indices = |shift: Vec3, sun: Vec3| {
        arranged.reaching(shift, sun.normalize(), image, 0.0).iter().map(|range| range.len()).sum::<usize>()
    };
    let side = SIZE as f32;
    let beside = Vec3::X * 1.3 * side;
    assert_eq!(indices(beside, Vec3::Z), 0, "it is beside the field");
    assert!(indices(beside, Vec3::new(1.0, 0.0, 0.05)) > 0, "the sun is behind it");
    assert_eq!(indices(beside, Vec3::new(-1.0, 0.0, 0.05)), 0, "the field is between it and the sun");
    let over = indices(Vec3::X * 0.83 * side, Vec3::Z);
    let all = indices(Vec3::ZERO, Vec3::Z);
    assert!(0 < over && over < all / 2, "{over} of {all}");
}

#[test]
fn rocks_are_left_out_by_size_as_soon_as_all_do_not_fit_and_hardly_more_than_have_to_be() {
    for smallest in [0.0, 6.0, 24.0] {
        assert_eq!(least_of(smallest, 2000.0, &|_| true), smallest);
        assert_eq!(least_of(smallest, 2000.0, &|_| false), 2000.0);
        for fitting in (1..190).map(|step| smallest + 0.1 + step as f32 * 10.0) {
            let found = least_of(smallest, 2000.0, &|least| least >= fitting);
            assert!(found >= fitting && found <= (1.04 * fitting).max(1.5), "{found} where {fitting} fits");
        }
    }
}

#[test]
fn a_part_of_a_picture_shows_the_same_and_draws_less_of_what_it_does_not_show() {
    let mesh = mesh_of(&preset("riverbed"));
    let bodies = bodies(&mesh);
    let positions = positions(&mesh);
    let arranged = Arrangement::of(&bodies, [SIZE as f32; 2]);
    let buffer: Vec<u32> = (0..LEVELS)
        .flat_map(|l| arranged.order.iter().map(move |&rock| (l, rock as usize)))
        .flat_map(|(l, rock)| level(&bodies[rock], l, &mesh, rock))
        .collect();
    for most in [0.0, 400.0] {
        let whole = sight(Vec3::new(64.0, -200.0, 200.0), most);
        let (mut in_parts, mut in_wholes) = (0, 0);
        for (column, row) in (0..36).map(|k| (k % 6, k / 6)) {
            // A sixth of the picture across and down.
            let at = [column, row].map(|k| 5.0 - 2.0 * k as f32);
            let shift = Mat4::from_cols(Vec4::X * 6.0, Vec4::Y * 6.0, Vec4::Z, Vec4::new(at[0], at[1], 0.0, 1.0));
            let part = Sight { clip_from_eye: shift * whole.clip_from_eye, is_part: true, ..whole };
            for (drawn, without) in [
                (arranged.seen(&part), arranged.seen(&Sight { is_part: false, ..part })),
                (arranged.seen_afar(&part), arranged.seen_afar(&Sight { is_part: false, ..part })),
            ] {
                let triangles = |ranges: &[std::ops::Range<u32>]| -> Vec<[u32; 3]> {
                    let indices = ranges.iter().flat_map(|range| &buffer[range.start as usize..range.end as usize]);
                    let indices: Vec<u32> = indices.copied().collect();
                    indices.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect()
                };
                let [drawn, without] = [drawn, without].map(|ranges| {
                    let mut all = triangles(&ranges);
                    all.sort_unstable();
                    all
                });
                assert!(drawn.iter().all(|three| without.binary_search(three).is_ok()), "triangles of another level");
                for three in &without {
                    let corners = three.map(|v| part.clip_from_eye * (positions[v as usize] - part.eye).extend(1.0));
                    let is_seen = corners.iter().any(|at| at.x.abs() < at.w && at.y.abs() < at.w);
                    assert!(!is_seen || drawn.binary_search(three).is_ok(), "{corners:?} is not drawn");
                }
                in_parts += drawn.len();
                in_wholes += without.len();
            }
        }
        assert!(3 * in_parts < in_wholes, "{in_parts} of {in_wholes}");
    }
}

#[test]
fn rocks_that_have_sunk_out_of_sight_are_drawn_only_where_none_sinks() {
    let mesh = mesh_of(&preset("riverbed"));
    let mut bodies = bodies(&mesh);
    bodies.iter_mut().step_by(3).for_each(|body| body.is_hidden = true);
    let arranged = Arrangement::of(&bodies, [SIZE as f32; 2]);
    let drawn = |ranges: Vec<std::ops::Range<u32>>| ranges.iter().map(|range| range.len() as u32).sum::<u32>();
    let count =
        |is_wanted: fn(&&Body) -> bool| bodies.iter().filter(is_wanted).map(|body| 3 * body.triangles).sum::<u32>();
    let (all, left) = (count(|_| true), count(|body| !body.is_hidden));
    let far = sight(Vec3::new(64.0, -400.0, 400.0), 0.0);
    let sunk = Sight { sunk: 1.0, ..far };
    assert_eq!(
        [drawn(arranged.all(0.0, false)), drawn(arranged.seen(&far)), drawn(arranged.seen_afar(&far))],
        [all; 3]
    );
    assert_eq!(
        [drawn(arranged.all(0.0, true)), drawn(arranged.seen(&sunk)), drawn(arranged.seen_afar(&sunk))],
        [left; 3]
    );
    assert_eq!(
        drawn(arranged.reaching(Vec3::ZERO, Vec3::Z, [SIZE as f32; 2], 0.0)),
        left,
        "copies are drawn in natural colours alone"
    );
}
