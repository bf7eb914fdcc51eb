//! The last stages beyond the papers: what weathering, roughness, detail and embedding promise.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::collections::BTreeMap;

use common::checked;
use rock_field::params::{Layer, Notation, PRESETS, Params};
use rock_field::rocks::{Field, Generator, generate};

/// Fig. 1 on a smaller image, every layer with these.
fn fig1(weathering: f64, roughness: f64, detail: f64, embedding: f64) -> Params {
    let mut params = Params { image_width: 512, image_height: 512, ..Params::default() };
    for layer in &mut params.layers {
        *layer = Layer { weathering, roughness, detail, embedding, ..layer.clone() };
    }
    params
}

fn corner(field: &Field, index: u32) -> [f64; 3] {
    let at = 3 * index as usize;
    [at, at + 1, at + 2].map(|k| f64::from(field.mesh.positions[k]))
}

/// Twice the area vector of every triangle.
fn faces(field: &Field) -> impl Iterator<Item = ([[f64; 3]; 3], [f64; 3])> {
    field.mesh.indices.chunks_exact(3).map(|face| {
        let [a, b, c] = [face[0], face[1], face[2]].map(|index| corner(field, index));
        let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        ([a, b, c], [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
    })
}

fn slivers(field: &Field) -> f64 {
    let small = faces(field).filter(|(_, n)| 0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt() < 1.0e-6).count();
    small as f64 / field.mesh.triangles().max(1) as f64
}

#[test]
fn wear_makes_hardly_a_sliver_that_the_papers_mesh_has_not() {
    let before = slivers(&generate(&fig1(0.0, 0.0, 0.0, 0.0)).unwrap());
    for weathering in [0.0, 0.1, 0.2, 0.6, 1.0] {
        for (roughness, detail, embedding) in [(0.0, 10.0, 0.3), (1.0, 20.0, 0.0), (0.5, 40.0, 0.8)] {
            let params = fig1(weathering, roughness, detail, embedding);
            let more = slivers(&checked(&params).unwrap()) - before;
            assert!(more < 1.0e-3, "{more} at {weathering} {roughness} {detail} {embedding}");
        }
    }
}

/// Triangles of each rock, by layer.
fn triangles_of(field: &Field, layer: usize) -> Vec<u32> {
    let mesh = &field.mesh;
    let of = |rock: usize| (mesh.rock_starts[rock + 1] - mesh.rock_starts[rock]) / 3;
    (0..mesh.rocks()).filter(|&rock| usize::from(mesh.rock_layer[rock]) == layer).map(of).collect()
}

#[test]
fn one_detail_gives_boulders_thousands_of_triangles_and_pebbles_a_few() {
    let field = checked(&fig1(0.5, 0.3, 50.0, 0.1)).unwrap();
    let mean = |layer| {
        let all = triangles_of(&field, layer);
        f64::from(all.iter().sum::<u32>()) / all.len() as f64
    };
    let [boulders, stones, pebbles] = [0, 1, 2].map(mean);
    assert!(boulders > 6000.0 && pebbles < 300.0, "{boulders} {stones} {pebbles}");
    // Radii are 90, 30 and 10: areas are in proportion, up to the powers of two.
    for ratio in [boulders / stones, stones / pebbles] {
        assert!((3.5..17.0).contains(&ratio), "{ratio}");
    }
}

#[test]
fn edges_are_about_as_long_as_detail_says() {
    for detail in [13.0, 30.0, 77.0] {
        let field = checked(&fig1(0.0, 0.0, detail, 0.0)).unwrap();
        let area: f64 = faces(&field).map(|(_, n)| 0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()).sum();
        let edge = (area / field.mesh.triangles() as f64 * 4.0 / 3.0_f64.sqrt()).sqrt();
        assert!((0.75..1.33).contains(&(edge * detail / 100.0)), "{edge} px at {detail}");
    }
}

#[test]
fn a_relative_field_is_cut_as_the_same_field_in_pixels() {
    let px = fig1(0.6, 0.4, 40.0, 0.2);
    let unit = f64::from(px.image_width) / 100.0;
    let mut relative = Params { notation: Notation::Relative, ..px.clone() };
    for layer in &mut relative.layers {
        let radius = layer.radius;
        layer.radius /= unit;
        layer.taper = layer.taper.map(|c| c / unit);
        layer.height = layer.height.map(|c| c / radius);
        layer.detail *= unit;
    }
    let [ours, theirs] = [&px, &relative].map(|params| generate(params).unwrap());
    for layer in 0..3 {
        assert_eq!(triangles_of(&ours, layer), triangles_of(&theirs, layer));
    }
}

#[test]
fn a_rounded_stone_lies_on_its_flat_side_however_tall_its_layer_is() {
    let mut params = fig1(1.0, 0.0, 20.0, 0.0);
    for layer in &mut params.layers {
        layer.height = [3.0 * layer.radius, 0.0, 0.0];
    }
    let field = checked(&params).unwrap();
    let mesh = &field.mesh;
    let mut flatness = 0.0;
    for rock in 0..mesh.rocks() {
        let vertices = (mesh.vertex_starts[rock]..mesh.vertex_starts[rock + 1]).map(|v| corner(&field, v));
        let above: Vec<_> = vertices.filter(|at| at[2] > 0.0).collect();
        let extent = |along: &dyn Fn(&[f64; 3]) -> f64| {
            let at = above.iter().map(along);
            at.clone().fold(f64::MIN, f64::max) - at.fold(f64::MAX, f64::min)
        };
        let high = above.iter().fold(0.0_f64, |most, at| most.max(at[2]));
        let turns = [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8], [0.6, -0.8], [0.8, 0.6], [0.8, -0.6]];
        let wide = turns.map(|[x, y]| extent(&|at| x * at[0] + y * at[1])).into_iter().fold(f64::MAX, f64::min);
        assert!(high < 1.4 * wide, "rock {rock} is {high} high and {wide} wide");
        flatness += high / wide / mesh.rocks() as f64;
    }
    assert!(flatness < 0.75, "{flatness}");
}

/// The angles at the edges between triangles that stand above the ground, in degrees.
fn bends(field: &Field) -> Vec<f64> {
    let mut at_edge: BTreeMap<[u32; 2], ([f64; 3], f64)> = BTreeMap::new();
    let mut angles = Vec::new();
    for (face, (corners, normal)) in field.mesh.indices.chunks_exact(3).zip(faces(field)) {
        if corners.iter().any(|at| at[2] <= 0.0) {
            continue;
        }
        let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
        for k in 0..3 {
            let [a, b] = [face[k], face[(k + 1) % 3]];
            match at_edge.remove(&[b, a]) {
                Some((other, its)) => {
                    let cos = (0..3).map(|k| normal[k] * other[k]).sum::<f64>() / (length * its);
                    angles.push(f64::clamp(cos, -1.0, 1.0).acos().to_degrees());
                }
                None => drop(at_edge.insert([a, b], (normal, length))),
            }
        }
    }
    angles
}

fn share(all: &[f64], is_one: impl Fn(f64) -> bool) -> f64 {
    all.iter().filter(|&&angle| is_one(angle)).count() as f64 / all.len() as f64
}

#[test]
fn a_broken_stone_has_flats_and_crisp_edges_and_a_rounded_one_neither() {
    let boulders = |weathering| {
        let mut params = fig1(weathering, 0.0, 50.0, 0.0);
        params.layers.truncate(1);
        params.layers[0].height = [50.0, 20.0, 10.0];
        bends(&checked(&params).unwrap())
    };
    let [broken, chipped, round] = [0.2, 0.5, 1.0].map(boulders);
    let flat = |all: &[f64]| share(all, |angle| angle < 0.5);
    let crisp = |all: &[f64]| share(all, |angle| angle > 15.0);
    let report = [&broken, &chipped, &round].map(|all| [flat(all), crisp(all)]);
    assert!(flat(&broken) > 0.4 && crisp(&broken) > 0.02, "{report:?}");
    assert!(crisp(&chipped) < crisp(&broken), "{report:?}");
    assert!(flat(&round) < 0.25 && crisp(&round) < 0.25 * crisp(&broken), "{report:?}");
}

/// The share of the surface above the ground whose triangles lie in one plane with a neighbour.
fn in_flats(field: &Field) -> f64 {
    let mut at_edge: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let all: Vec<_> = faces(field).collect();
    let unit = |normal: [f64; 3]| normal.map(|n| n / normal.iter().map(|n| n * n).sum::<f64>().sqrt());
    let mut is_flat = vec![false; all.len()];
    for (k, face) in field.mesh.indices.chunks_exact(3).enumerate() {
        for [a, b] in [[face[0], face[1]], [face[1], face[2]], [face[2], face[0]]] {
            if let Some(other) = at_edge.remove(&[b, a]) {
                let [own, its] = [all[k].1, all[other].1].map(unit);
                if (0..3).map(|c| own[c] * its[c]).sum::<f64>() > 2.0_f64.to_radians().cos() {
                    (is_flat[k], is_flat[other]) = (true, true);
                }
            } else {
                at_edge.insert([a, b], k);
            }
        }
    }
    let area = |k: usize| all[k].1.iter().map(|n| n * n).sum::<f64>().sqrt();
    let seen: Vec<usize> = (0..all.len()).filter(|&k| all[k].0.iter().all(|at| at[2] > 0.0)).collect();
    let flat = seen.iter().filter(|&&k| is_flat[k]).map(|&k| area(k)).sum::<f64>();
    flat / seen.iter().map(|&k| area(k)).sum::<f64>()
}

#[test]
fn vertices_stand_on_the_edges_of_broken_stone_so_that_no_triangle_lies_across_one() {
    let mut params = fig1(0.2, 0.0, 12.0, 0.0);
    params.layers.truncate(1);
    params.layers[0].height = [50.0, 20.0, 10.0];
    let flats = in_flats(&checked(&params).unwrap());
    assert!(flats > 0.8, "{flats}");
}

#[test]
fn a_rough_boulder_has_structure_at_every_scale_down_to_its_triangles() {
    let boulders = |roughness, detail| {
        let mut params = fig1(0.3, roughness, detail, 0.0);
        params.layers.truncate(1);
        params.layers[0].height = [60.0, 0.0, 0.0];
        checked(&params).unwrap()
    };
    // How much less neighbours among the vertices differ than vertices anywhere on a rock.
    let ratio = |detail| {
        let [smooth, rough] = [0.0, 0.7].map(|roughness| boulders(roughness, detail));
        let mesh = &rough.mesh;
        let moved = |v: u32| {
            let [a, b] = [corner(&smooth, v), corner(&rough, v)];
            (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt()
        };
        let edges: Vec<f64> =
            mesh.indices.chunks_exact(3).map(|face| (moved(face[0]) - moved(face[1])).abs()).collect();
        let largest = (0..mesh.rocks())
            .map(|rock| (mesh.vertex_starts[rock]..mesh.vertex_starts[rock + 1]).map(moved).fold(0.0_f64, f64::max));
        let largest = largest.sum::<f64>() / mesh.rocks() as f64;
        edges.iter().sum::<f64>() / edges.len() as f64 / largest
    };
    let [coarse, fine] = [20.0, 80.0].map(ratio);
    // Four times as many edges across a smooth surface: a quarter of the differences.
    assert!(fine > 0.35 * coarse && fine > 0.015, "{fine} {coarse}");
}

/// The share of the triangles above the ground, of rocks that are cut, of which an angle is below 10°.
fn pointed(field: &Field) -> f64 {
    let mesh = &field.mesh;
    let (mut count, mut pointed) = (0, 0);
    let all: Vec<_> = faces(field).collect();
    for rock in 0..mesh.rocks() {
        // An uncut rock has 3n − 2 triangles and 2n vertices.
        let of = mesh.rock_starts[rock] as usize / 3..mesh.rock_starts[rock + 1] as usize / 3;
        let vertices = (mesh.vertex_starts[rock + 1] - mesh.vertex_starts[rock]) as usize;
        if 2 * of.len() < 3 * vertices {
            continue;
        }
        for (corners, normal) in all[of].iter().filter(|(corners, _)| corners.iter().all(|at| at[2] > 0.0)) {
            let square = |a: usize, b: usize| (0..3).map(|c| (corners[a][c] - corners[b][c]).powi(2)).sum::<f64>();
            let mut squares = [square(0, 1), square(1, 2), square(2, 0)];
            squares.sort_by(f64::total_cmp);
            // Opposite the shortest edge is the smallest angle.
            let sine = normal.iter().map(|n| n * n).sum::<f64>().sqrt() / (squares[1] * squares[2]).sqrt();
            count += 1;
            pointed += u32::from(sine < 10.0_f64.to_radians().sin());
        }
    }
    f64::from(pointed) / f64::from(count)
}

#[test]
fn natural_presets_keep_every_promise_and_hardly_a_triangle_is_pointed() {
    for preset in PRESETS.iter().filter(|preset| preset.natural) {
        let field = checked(&preset.params()).unwrap();
        assert!(slivers(&field) < 1.0e-3, "{}", preset.name);
        let pointed = pointed(&field);
        assert!(pointed < 0.01, "{} {pointed}", preset.name);
    }
}

#[test]
fn wear_that_is_taken_back_leaves_the_papers_mesh_bit_for_bit() {
    let papers = fig1(0.0, 0.0, 0.0, 0.0);
    let mut generator = Generator::new();
    for params in [fig1(1.0, 1.0, 20.0, 0.3), papers.clone()] {
        generator.start(params, u64::MAX).unwrap();
        while !generator.step().unwrap() {}
    }
    assert_eq!(generator.into_field().mesh, generate(&papers).unwrap().mesh);
}

#[test]
fn a_worn_stone_is_seen_from_its_middle_in_every_direction_once() {
    let mut params = fig1(1.0, 1.0, 20.0, 0.3);
    for layer in &mut params.layers {
        layer.taper = [0.0; 3];
    }
    let field = generate(&params).unwrap();
    let mesh = &field.mesh;
    let (mut inverted, mut count) = (0, 0);
    let all: Vec<_> = faces(&field).collect();
    for rock in 0..mesh.rocks() {
        let vertices = mesh.vertex_starts[rock]..mesh.vertex_starts[rock + 1];
        let n = f64::from(vertices.end - vertices.start);
        let sum = vertices.map(|v| corner(&field, v)).fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
        let middle = sum.map(|s| s / n);
        for (corners, normal) in &all[mesh.rock_starts[rock] as usize / 3..mesh.rock_starts[rock + 1] as usize / 3] {
            if corners.iter().any(|p| p[2] <= 0.0) {
                continue;
            }
            let a = corners[0];
            let outward = (0..3).map(|k| (a[k] - middle[k]) * normal[k]).sum::<f64>();
            inverted += u32::from(outward <= 0.0);
            count += 1;
        }
    }
    assert!(count > 10_000 && f64::from(inverted) < 3.0e-4 * f64::from(count), "{inverted} of {count}");
}

#[test]
fn embedding_buries_the_share_it_says() {
    for share in [0.0, 0.25, 1.0] {
        let highest = |field: &Field| field.mesh.positions.chunks_exact(3).fold(f32::MIN, |most, p| most.max(p[2]));
        let mut params = fig1(0.0, 0.0, 0.0, share);
        params.layers.truncate(1);
        params.layers[0].height = [40.0, 0.0, 0.0];
        let field = generate(&params).unwrap();
        assert!((f64::from(highest(&field)) - 40.0 * (1.0 - share)).abs() < 1.0e-4);
    }
}
