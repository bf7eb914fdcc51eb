//! What the renderer paints of wood ears, against the layout of their vertices, and where it finds a log's axis.

use glam::Vec3;

use super::super::wood;
use crate::params::wood_ear::{Log as LogParams, Params};
use crate::wood_ear::{Generator, Log};

const RINGS: u32 = 4;
const MERIDIANS: u32 = 8;

fn grown(params: Params) -> Generator {
    let mut generator = Generator::new();
    generator.start(params, u64::MAX).expect("valid parameters");
    while !generator.step().expect("no budget") {}
    generator
}

fn colony(thickness: f64, foot: f64) -> Generator {
    let (rings, meridians) = (RINGS, MERIDIANS);
    grown(Params { rings, meridians, thickness, foot, range: 20.0, density: 20.0, ..Params::with_defaults() })
}

/// Ring share, random bytes, side.
fn parts(painted: u32) -> (u32, u32, u32) {
    (painted & 0xff, painted >> 8 & 0xffff, painted >> 24)
}

/// What the parts of an individual are painted, as (share of the rim, side) and how many vertices are so, in their order.
fn runs(thickness: f64, foot: f64) -> Vec<(u32, u32, u32)> {
    let each = u32::from(colony(thickness, foot).layout().vertices);
    let ears = wood::Ears { rings: RINGS, meridians: MERIDIANS, keys: vec![7] };
    let mut runs: Vec<(u32, u32, u32)> = Vec::new();
    for vertex in 0..each {
        let (ring, _, side) = parts(ears.painted(vertex, each));
        match runs.last_mut() {
            Some((last, of, count)) if (*last, *of) == (ring, side) => *count += 1,
            _ => runs.push((ring, side, 1)),
        }
    }
    runs
}

fn sheet(side: wood::Side) -> impl Iterator<Item = (u32, u32, u32)> {
    (1..=RINGS).map(move |ring| (ring * 255 / RINGS, side as u32, MERIDIANS))
}

#[test]
fn every_part_of_a_wood_ear_is_painted_as_what_it_is() {
    let inner = || sheet(wood::Side::Inner);
    let outer = || sheet(wood::Side::Outer);
    let rim = || std::iter::once((255, wood::Side::Rim as u32, 2 * MERIDIANS));
    let stalk = || std::iter::once((0, wood::Side::Foot as u32, MERIDIANS + 1));
    let floor = || std::iter::once((0, wood::Side::Inner as u32, 1));
    assert_eq!(runs(0.0, 0.0), inner().collect::<Vec<_>>());
    assert_eq!(runs(0.0, 0.5), inner().chain(stalk()).collect::<Vec<_>>());
    assert_eq!(runs(0.2, 0.0), inner().chain(rim()).chain(outer()).collect::<Vec<_>>());
    assert_eq!(runs(0.2, 0.5), inner().chain(rim()).chain(outer()).chain(stalk()).chain(floor()).collect::<Vec<_>>());
}

#[test]
fn the_sides_are_those_of_the_mesh() {
    let generator = colony(0.2, 0.5);
    let each = u32::from(generator.layout().vertices);
    let ears = wood::Ears { rings: RINGS, meridians: MERIDIANS, keys: vec![7] };
    // Across the rim the mesh runs from the inner sheet to the outer one, and only the outer one has the stalk.
    for triangle in &generator.layout().triangles {
        let sides = triangle.map(|vertex| parts(ears.painted(u32::from(vertex), each)).2);
        let [least, most] = [sides.iter().min(), sides.iter().max()].map(|side| side.copied().unwrap_or(0));
        assert!(most - least <= 1, "{sides:?}");
    }
}

#[test]
fn random_bytes_belong_to_the_key_wherever_it_stands() {
    let ears = |keys: &[u32]| wood::Ears { rings: RINGS, meridians: MERIDIANS, keys: keys.to_vec() };
    let each = RINGS * MERIDIANS;
    let random = |ears: &wood::Ears, individual: u32| {
        let found: Vec<_> = (0..each).map(|v| parts(ears.painted(individual * each + v, each)).1).collect();
        assert!(found.iter().all(|bytes| *bytes == found[0]), "one individual, one colour");
        found[0]
    };
    let before = ears(&[11, 42, 90]);
    let after = ears(&[42, 90]);
    assert_eq!([random(&before, 1), random(&before, 2)], [random(&after, 0), random(&after, 1)]);
    assert_ne!(random(&after, 0), random(&after, 1));
}

#[test]
fn wood_is_told_from_flesh_by_its_lower_bytes() {
    assert_eq!([0, 1, 2].map(wood::painted), [0, 1 << 24, 2 << 24]);
    let ears = wood::Ears { rings: 1, meridians: 3, keys: (0..1000).collect() };
    let flesh = (0..1000).filter(|individual| parts(ears.painted(3 * individual, 3)).1 != 0).count();
    assert!(flesh >= 999, "{flesh} of 1000 have random bytes");
}

fn log(params: LogParams) -> (Log, wood::Axis) {
    let generator = grown(Params { log: params, density: 0.0, ..Params::with_defaults() });
    let mesh = generator.log_mesh();
    (generator.log().clone(), wood::Axis::of(&mesh.positions, &mesh.kinds))
}

fn y(axis: &wood::Axis, x: f32) -> f32 {
    let t = (x - axis.middle) / axis.half;
    axis.bow[0] + t * (axis.bow[1] + t * (axis.bow[2] + t * axis.bow[3]))
}

#[test]
fn the_axis_runs_through_the_middle_of_bowed_logs() {
    for (length, radius, bend) in [(200.0, 14.0, 0.0), (260.0, 14.0, 0.9), (90.0, 20.0, 0.5)] {
        let (log, axis) = log(LogParams { length, radius, bend, bark: 0.5, spacing: 3.0, seed: 3 });
        // The middles of the ends are nearly on it, which knots pull aside, and the mesh says how far all else is from it.
        for (point, &[_, distance]) in log.points.iter().zip(&log.coords) {
            let point = point.as_vec3();
            if distance == 0.0 {
                let off = Vec3::new(0.0, point.y - y(&axis, point.x), point.z - axis.height).length();
                assert!(off < 0.1 * radius as f32, "an end's middle is {off} cm off the axis of {length}");
            }
        }
        let mean = log.coords.iter().zip(&log.kinds).filter(|(_, kind)| **kind == 0).map(|([_, distance], _)| distance);
        let mean = mean.clone().sum::<f32>() / mean.count() as f32;
        assert!((axis.radius / mean - 1.0).abs() < 0.05, "radius {} instead of {mean}", axis.radius);
        let (half, broken) = (0.5 * length as f32, 0.5 * radius as f32);
        assert!((0.95 * half..half + broken).contains(&axis.half), "{} instead of {half}", axis.half);
    }
}

#[test]
fn placing_a_log_moves_its_axis_with_it() {
    let (_, axis) = log(LogParams { length: 120.0, radius: 12.0, bend: 0.7, bark: 0.4, spacing: 4.0, seed: 0 });
    let placed = axis.placed(Vec3::new(300.0, 200.0, -2.0), 1.5);
    for x in [-50.0, 0.0, 31.0] {
        let there = y(&placed, 1.5 * x + 300.0);
        assert!((there - (1.5 * y(&axis, x) + 200.0)).abs() < 1e-3, "{there} at {x}");
    }
    assert!((placed.height - (1.5 * axis.height - 2.0)).abs() < 1e-3);
}

#[test]
fn what_is_no_log_has_an_axis_of_numbers() {
    let point = [1.0, 2.0, 3.0];
    assert_eq!(wood::Axis::of(&[], &[]), wood::Axis::default());
    assert_eq!(wood::Axis::of(&point, &[0]), wood::Axis::default());
    // A board across: where it stands along x says nothing of a bow.
    let board = [-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -9.0, 0.0, 0.0, 9.0, 0.0];
    let axis = wood::Axis::of(&board, &[0; 4]);
    assert_eq!((axis.middle, axis.half, axis.radius, axis.height), (0.0, 1.0, 9.0, 0.0));
    assert_eq!(axis.bow, [0.0; 4]);
}
