//! Logs of the user's own: where wood ears stand on them does not depend on how they are cut into triangles.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::field_test;
use common::wood_ear::{Mesh, cylinder, small};
use glam::DVec3;
use rock_field::params::wood_ear::{Collisions, Params};
use rock_field::validate::check_colony;
use rock_field::wood_ear::Generator;

fn grown(mesh: &Mesh, params: &Params) -> Generator {
    let mut generator = Generator::new();
    generator.set_log(&mesh.positions, &mesh.indices).unwrap();
    generator.start(params.clone(), u64::MAX).unwrap();
    while !generator.step().unwrap() {}
    generator
}

/// The whole of a cylinder, no wood ear left out.
fn all() -> Params {
    Params {
        density: 100.0,
        range: 200.0,
        rings: 3,
        meridians: 8,
        collisions: Collisions::Off,
        ..Params::with_defaults()
    }
}

fn feet(generator: &Generator) -> Vec<DVec3> {
    generator.spawn().individuals.iter().map(|individual| individual.foot).collect()
}

field_test! {
    fn as_many_wood_ears_grow_whatever_the_resolution_of_the_mesh() {
        let params = Params { collisions: Collisions::Off, ..Params::with_defaults() };
        let mut made = Generator::new();
        made.start(Params { log: rock_field::params::wood_ear::Log { bark: 0.0, bend: 0.0, ..params.log }, ..params.clone() }, u64::MAX).unwrap();
        while !made.step().unwrap() {}
        for vertices in [800, 3_200, 12_800, 51_200, 199_811] {
            let mesh = cylinder(vertices);
            assert!((mesh.positions.len() as f64 / 3.0 / vertices as f64 - 1.0).abs() < 0.1);
            for density in [10.0, 50.0, 100.0] {
                let [ears, of_made] = [&grown(&mesh, &Params { density, ..params.clone() }), &made].map(|g| g.mesh().individuals() as f64);
                let expected = of_made * density / 50.0;
                let noise = 2.0 * (expected * (1.0 - density / 100.0)).sqrt() / expected;
                assert!((ears / expected - 1.0).abs() < 0.1 + noise, "{vertices} vertices, density {density}: {ears} instead of {expected}");
            }
        }
    }
}

field_test! {
    fn feet_are_spread_over_the_surface_and_stand_outward() {
        for spacing in [1.5, 3.0, 6.0] {
            let mut params = all();
            params.log.spacing = spacing;
            for vertices in [60, 800, 51_200] {
                let generator = grown(&cylinder(vertices), &params);
                let individuals = &generator.spawn().individuals;
                let area = std::f64::consts::TAU * 14.0 * 214.0;
                let expected = area / (0.75_f64.sqrt() * spacing * spacing);
                assert!((individuals.len() as f64 / expected - 1.0).abs() < 0.06, "{} instead of {expected}", individuals.len());
                let mut closest = f64::INFINITY;
                for (k, one) in individuals.iter().enumerate() {
                    let side = DVec3::new(0.0, one.foot.y, one.foot.z - 14.0);
                    let is_end = one.foot.x.abs() > 99.999;
                    assert!(is_end || (side.length() / 14.0 - 1.0).abs() < 0.15, "{}", one.foot);
                    // Away from the edges of the ends, and of the coarsest mesh's triangles.
                    if !is_end && one.foot.x.abs() < 90.0 {
                        assert!(one.axes[1].dot(side.normalize()) > 0.85, "{} faces {}", one.foot, one.axes[1]);
                    }
                    for other in &individuals[..k] {
                        closest = closest.min(one.foot.distance(other.foot));
                    }
                }
                assert!(closest >= 0.65 * spacing, "{closest}");
                // Nowhere is there a hole: a point of the side has a foot within 1.5 spacings.
                for k in 0..400 {
                    let (x, angle) = (180.0 * f64::from(k) / 400.0 - 90.0, f64::from(k) * 2.399);
                    let at = DVec3::new(x, 14.0 * angle.cos(), 14.0 * angle.sin() + 14.0);
                    let nearest = feet(&generator).iter().map(|foot| foot.distance(at)).fold(f64::INFINITY, f64::min);
                    assert!(nearest < 1.5 * spacing, "{nearest} from {at}");
                }
            }
        }
    }
}

field_test! {
    fn a_foot_is_told_by_its_triangle_in_what_was_given() {
        // Triangles without an area come first, so that numbers in what is kept would be others.
        let mesh = cylinder(3_200);
        let mesh = Mesh { indices: [&[5, 5, 6, 7, 7, 7][..], &mesh.indices].concat(), ..mesh };
        for mesh in [mesh.clone(), mesh.split(), mesh.turned()] {
            let generator = grown(&mesh, &all());
            let points = mesh.points();
            for (foot, triangle) in feet(&generator).iter().zip(&generator.mesh().foot) {
                let [a, b, c] = [0, 1, 2].map(|k| points[mesh.indices[3 * *triangle as usize + k] as usize]);
                let normal = (b - a).cross(c - a);
                let parts = [(b, c), (c, a), (a, b)].map(|(p, q)| (p - foot).cross(q - foot).dot(normal));
                assert!(parts.iter().all(|part| *part > -1.0e-9 * normal.length_squared()), "{foot} is not in triangle {triangle}");
                assert!((foot - a).dot(normal.normalize()).abs() < 1.0e-9);
            }
        }
    }
}

field_test! {
    fn an_edit_of_range_base_or_density_moves_no_foot() {
        let mesh = cylinder(800);
        let everywhere = feet(&grown(&mesh, &all()));
        for params in [Params { range: 30.0, ..all() }, Params { density: 30.0, ..all() }] {
            let mut params = params;
            params.bases[0].position = [40.0, 0.0, 30.0];
            let some = feet(&grown(&mesh, &params));
            assert!(some.len() > 50 && some.len() < everywhere.len() && some.iter().all(|foot| everywhere.contains(foot)));
        }
        // Edits in a generator that has the mesh give what a fresh one gives.
        let mut generator = grown(&mesh, &all());
        for spacing in [4.0, 3.0] {
            let mut params = all();
            params.log.spacing = spacing;
            generator.start(params.clone(), u64::MAX).unwrap();
            while !generator.step().unwrap() {}
            assert_eq!(generator.mesh(), grown(&mesh, &params).mesh());
        }
    }
}

field_test! {
    fn meshes_as_they_come_carry_a_colony() {
        let log = cylinder(800);
        let far = cylinder(200).moved([0.0, 90.0, 0.0]);
        let area = |mesh: &Mesh| {
            let points = mesh.points();
            let corners = mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|v| points[v as usize]));
            corners.map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum::<f64>()
        };
        // Ten thousand needles from the middle of an end to its edge.
        let mut slivers = Mesh { positions: vec![0.0; 3], indices: Vec::new() };
        for k in 0..10_000_u32 {
            let angle = f64::from(k) / 10_000.0 * std::f64::consts::TAU;
            slivers.positions.extend([40.0 * angle.cos(), 40.0 * angle.sin(), 0.0].map(|c| c as f32));
            slivers.indices.extend([0, k + 1, (k + 1) % 10_000 + 1]);
        }
        let huge = Mesh { positions: vec![-500.0, -500.0, 0.0, 500.0, -500.0, 0.0, 0.0, 500.0, 0.0], indices: vec![0, 1, 2] };
        // Both sides of a wall that is thinner than the feet are apart.
        let plate = {
            let side = Mesh { positions: vec![0.0, 0.0, 0.0, 60.0, 0.0, 0.0, 60.0, 60.0, 0.0, 0.0, 60.0, 0.0], indices: vec![0, 1, 2, 0, 2, 3] };
            side.moved([0.0, 0.0, 0.2]).with(&side.turned())
        };
        for (name, mesh) in [
            ("duplicates", &log.split()), ("holes", &log.with_holes(5)), ("two parts", &log.with(&far)), ("slivers", &slivers),
            ("one triangle", &huge), ("a thin wall", &plate), ("inside out", &log.turned()), ("open and inside out", &log.with_holes(7).turned()),
        ] {
            let params = all();
            let generator = grown(mesh, &params);
            check_colony(&params, &generator).unwrap();
            let expected = area(mesh) / (0.75_f64.sqrt() * 9.0);
            let feet = generator.log().points.len() as f64;
            assert!((feet / expected - 1.0).abs() < 0.03, "{name}: {feet} feet instead of {expected}");
        }
        // Smaller than a wood ear: one foot.
        for scale in [1.0e-3, 1.0e-20] {
            let params = all();
            let generator = grown(&log.scaled(scale), &params);
            check_colony(&params, &generator).unwrap();
            assert_eq!(generator.mesh().individuals(), 1);
        }
    }
}

field_test! {
    fn a_closed_mesh_that_is_inside_out_is_turned_and_an_open_one_is_left() {
        let log = cylinder(800);
        let open = log.with_holes(9);
        let far = cylinder(200).moved([500.0, 300.0, 0.0]);
        let one_triangle_wrong = {
            let mut mesh = log.turned();
            mesh.indices.swap(0, 1);
            mesh
        };
        for (name, mesh, is_turned) in [
            ("as it should be", &log, false), ("inside out", &log.turned(), true), ("inside out, far away", &log.turned().moved([5000.0, -300.0, 90.0]), true),
            ("inside out, with split vertices", &log.split().turned(), true), ("two parts", &log.with(&far).turned(), true),
            ("open", &open, false), ("open, inside out", &open.turned(), false), ("not of one winding", &one_triangle_wrong, false),
        ] {
            let generator = grown(mesh, &all());
            assert_eq!(generator.log_turned(), is_turned, "{name}");
            let seen = generator.log_mesh();
            let outward: f64 = seen.indices.chunks_exact(3).map(|t| {
                let [a, b, c] = [t[0], t[1], t[2]].map(|v| DVec3::from_array([0, 1, 2].map(|k| f64::from(seen.positions[3 * v as usize + k]))));
                a.dot(b.cross(c))
            }).sum();
            let is_outward = is_turned || name == "as it should be";
            if is_outward {
                assert!(outward > 0.0, "{name}");
                let individuals = &generator.spawn().individuals;
                let middle = individuals.iter().map(|one| one.foot).sum::<DVec3>() / individuals.len() as f64;
                let outside = individuals.iter().filter(|one| one.axes[1].dot(one.foot - middle) > 0.0).count();
                assert!(name == "two parts" || outside == individuals.len(), "{name}: {outside} of {}", individuals.len());
            }
        }
        // A grown log after it has not been turned.
        let mut generator = grown(&log.turned(), &all());
        generator.clear_log();
        generator.start(small(), u64::MAX).unwrap();
        while !generator.step().unwrap() {}
        assert!(!generator.log_turned());
    }
}

field_test! {
    fn a_mesh_with_more_places_than_memory_is_refused_at_once() {
        let wall = Mesh { positions: vec![-9000.0, -9000.0, 0.0, 9000.0, -9000.0, 0.0, 0.0, 9000.0, 0.0], indices: vec![0, 1, 2] };
        let mut generator = Generator::new();
        generator.set_log(&wall.positions, &wall.indices).unwrap();
        let mut params = all();
        params.log.spacing = 1.5;
        let error = generator.start(params, 256 << 20).unwrap_err();
        assert_eq!((error.code(), error.key()), ("OverBudget", "logSpacing"));
        assert!(error.to_string().starts_with("this colony would need about"), "{error}");
    }
}
