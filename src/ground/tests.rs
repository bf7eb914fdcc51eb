//! The ground against what is known about it without a triangulation.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::{BTreeMap, BTreeSet};

use super::outlines::{Outlines, Point};
use super::{Ground, Sheet};
use crate::params::{Layer, Notation, PRESETS, Params};
use crate::rng::{Purpose, Stream};
use crate::rocks::generate;

/// The ground of a field; its rocks are added in several pieces, as exports do.
fn ground_of(params: &Params) -> Ground {
    let mesh = generate(params).unwrap().mesh;
    let mut ground = Ground::new(params.image_width, params.image_height);
    let rocks = mesh.rock_starts.len() - 1;
    for from in (0..rocks).step_by(50) {
        let to = (from + 50).min(rocks);
        let [vertices, corners] = [&mesh.vertex_starts, &mesh.rock_starts].map(|starts| &starts[from..=to]);
        let [v, c] = [vertices, corners].map(|starts| starts[0] as usize..starts[to - from] as usize);
        ground.add(&mesh.positions[3 * v.start..3 * v.end], &mesh.indices[c], vertices, corners);
    }
    ground
}

/// Intervals of a line.
type Spans = Vec<[f64; 2]>;

/// Where a horizontal line is inside of at least one outline, within the image.
fn covered(outlines: &Outlines, width: f64, y: f64) -> Spans {
    let spans = outlines.rocks().flat_map(|rock| {
        let mut ends: Vec<(f64, i32)> = rock.iter().filter_map(|segment| crossing(*segment, y)).collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut turns = 0;
        let mut spans = Vec::new();
        for pair in ends.windows(2) {
            turns += pair[0].1;
            if turns != 0 {
                spans.push([pair[0].0.clamp(0.0, width), pair[1].0.clamp(0.0, width)]);
            }
        }
        spans
    });
    let mut spans: Spans = spans.collect();
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut merged: Spans = Vec::new();
    for [from, to] in spans {
        match merged.last_mut() {
            Some(last) if from <= last[1] => last[1] = last[1].max(to),
            _ => merged.push([from, to]),
        }
    }
    merged
}

fn crossing([from, to]: [Point; 2], y: f64) -> Option<(f64, i32)> {
    let [[ax, ay], [bx, by]] = [from, to].map(|end| end.map(f64::from));
    ((ay <= y) != (by <= y)).then(|| (ax + (bx - ax) * (y - ay) / (by - ay), if ay <= y { 1 } else { -1 }))
}

fn triangles(sheet: &Sheet) -> impl Iterator<Item = [Point; 3]> {
    sheet.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| vertex(sheet, corners[k])))
}

fn vertex(sheet: &Sheet, v: u32) -> Point {
    [sheet.positions[2 * v as usize], sheet.positions[2 * v as usize + 1]]
}

fn length(spans: &Spans) -> f64 {
    spans.iter().map(|[from, to]| to - from).sum()
}

/// The sum of all triangles, and that of those which are turned over.
fn areas(sheet: &Sheet) -> [f64; 2] {
    let doubled = |corners: [Point; 3]| {
        let [a, b, c] = corners.map(|corner| corner.map(f64::from));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    triangles(sheet)
        .map(doubled)
        .fold([0.0; 2], |[all, over], doubled| [all + doubled / 2.0, over - doubled.min(0.0) / 2.0])
}

fn area(sheet: &Sheet) -> f64 {
    areas(sheet)[0]
}

/// The area inside of at least one outline, within the image. Between two heights at which anything begins, ends or
/// crosses it grows linearly.
fn covered_area(outlines: &Outlines, [width, height]: [f64; 2]) -> f64 {
    let mut heights = vec![0.0, height];
    let ends = |[from, to]: [Point; 2]| [from, to].map(|end| end.map(f64::from));
    for (k, &segment) in outlines.segments.iter().enumerate() {
        let [a, b] = ends(segment);
        heights.extend([a[1], b[1]]);
        for x in [0.0, width] {
            if (a[0] < x) != (b[0] < x) {
                heights.push(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]));
            }
        }
        for &other in &outlines.segments[..k] {
            let [c, d] = ends(other);
            let apart = (0..2)
                .any(|axis| a[axis].max(b[axis]) < c[axis].min(d[axis]) || c[axis].max(d[axis]) < a[axis].min(b[axis]));
            if apart {
                continue;
            }
            let (u, v, w) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]], [c[0] - a[0], c[1] - a[1]]);
            let across = u[0] * v[1] - u[1] * v[0];
            let share = (w[0] * v[1] - w[1] * v[0]) / across;
            if (0.0..=1.0).contains(&share) {
                heights.push(a[1] + share * u[1]);
            }
        }
    }
    heights.retain(|y| (0.0..=height).contains(y));
    heights.sort_by(f64::total_cmp);
    let slabs = heights.windows(2).filter(|ends| ends[1] > ends[0]);
    slabs.map(|ends| (ends[1] - ends[0]) * length(&covered(outlines, width, (ends[0] + ends[1]) / 2.0))).sum()
}

/// Everything that has to hold of the ground of a field.
fn check(params: &Params, what: &str) {
    let ground = ground_of(params);
    let [width, height] = ground.size.map(f64::from);
    let (cut, whole) = (ground.sheet(true), ground.sheet(false));
    let image = width * height;
    let expected = image - covered_area(&ground.outlines, [width, height]);
    assert!(
        (area(&cut) - expected).abs() < 1.0e-6 * image,
        "{what}: an area of {} px² instead of {expected}",
        area(&cut)
    );
    assert!(
        (area(&whole) - image).abs() < 1.0e-6 * image,
        "{what}: an area of {} px² instead of {image}",
        area(&whole)
    );
    for sheet in [&cut, &whole] {
        // Where outlines cross at a point that single precision does not have.
        let over = areas(sheet)[1];
        assert!(over < 1.0e-7 * image, "{what}: triangles of {over} px² are turned over");
        check_edges(sheet, what);
        check_points(&ground, sheet, std::ptr::eq(sheet, &cut), what);
    }
    check_vertices(&ground, &cut, &whole, what);
}

/// Every edge belongs to one triangle, or to two that agree on which side is up; every vertex is used.
fn check_edges(sheet: &Sheet, what: &str) {
    let mut edges = BTreeSet::new();
    for corners in sheet.indices.chunks_exact(3) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            assert!(edges.insert((corners[a], corners[b])), "{what}: two triangles on one side of an edge");
        }
    }
    let places: BTreeSet<_> = sheet.positions.chunks_exact(2).map(|at| [at[0].to_bits(), at[1].to_bits()]).collect();
    assert_eq!(places.len(), sheet.positions.len() / 2, "{what}: two vertices at one place");
    let used: BTreeSet<_> = sheet.indices.iter().collect();
    assert_eq!(used.len(), sheet.positions.len() / 2, "{what}: vertices that nothing uses");
    // An edge that only one triangle has is at the border of the sheet. Around each vertex it comes and goes as often.
    let mut balance = BTreeMap::new();
    for &(a, b) in edges.iter().filter(|(a, b)| !edges.contains(&(*b, *a))) {
        *balance.entry(a).or_insert(0) += 1;
        *balance.entry(b).or_insert(0) -= 1;
    }
    assert!(balance.values().all(|sum| *sum == 0), "{what}: a border that does not close");
}

/// A random point is in one triangle if it is outside of all outlines, or with the whole ground in any case, and in none otherwise.
fn check_points(ground: &Ground, sheet: &Sheet, cut: bool, what: &str) {
    let [width, height] = ground.size.map(f64::from);
    let mut stream = Stream::new(3, Purpose::Darts, 0, 0);
    for _ in 0..100 {
        let at = [width * stream.unit(), height * stream.unit()];
        let is_covered = cut && ground.outlines.rocks().any(|rock| turns(rock, at) != 0);
        let found = triangles(sheet).filter(|[a, b, c]| turns(&[[*a, *b], [*b, *c], [*c, *a]], at) != 0).count();
        assert_eq!(found, usize::from(!is_covered), "{what}: triangles at {at:?}");
    }
}

/// How often directed segments that close go around a point.
fn turns(segments: &[[Point; 2]], [x, y]: [f64; 2]) -> i32 {
    let ends = segments.iter().filter_map(|segment| crossing(*segment, y));
    ends.filter(|(at, _)| *at <= x).map(|(_, turn)| turn).sum()
}

/// The ends of the outlines are vertices, bit for bit; of the cut ground those with ground beside them.
fn check_vertices(ground: &Ground, cut: &Sheet, whole: &Sheet, what: &str) {
    let [width, height] = ground.size.map(f64::from);
    let bits = |at: Point| at.map(|x| (x + 0.0).to_bits());
    let vertices =
        |sheet: &Sheet| -> BTreeSet<_> { sheet.positions.chunks_exact(2).map(|at| bits([at[0], at[1]])).collect() };
    let (cut, whole) = (vertices(cut), vertices(whole));
    let is_inside = |[x, y]: [f64; 2]| 0.0 <= x && x <= width && 0.0 <= y && y <= height;
    let ends: BTreeMap<_, _> = ground.outlines.segments.iter().flatten().map(|&at| (bits(at), at)).collect();
    for (key, end) in ends {
        let at = end.map(f64::from);
        if !is_inside(at) {
            continue;
        }
        assert!(whole.contains(&key), "{what}: {end:?} is no vertex of the whole ground");
        let own = |rock: &[[Point; 2]]| rock.iter().flatten().any(|other| bits(*other) == key);
        // What another edge passes nearer than this may be on a spike that is too thin to be there.
        let others = |edge: &&[Point; 2]| edge.iter().all(|other| bits(*other) != key);
        let is_passed = |rock: &[[Point; 2]]| rock.iter().filter(others).any(|edge| distance(edge, at) < 1.0e-3);
        let is_alone = ground.outlines.rocks().all(|rock| !is_passed(rock) && (own(rock) || turns(rock, at) == 0));
        let free = |dx: i32, dy: i32| {
            let beside = [at[0] + 1.0e-3 * (f64::from(dx) + 0.37), at[1] + 1.0e-3 * (f64::from(dy) + 0.41)];
            is_inside(beside) && ground.outlines.rocks().all(|rock| turns(rock, beside) == 0)
        };
        if is_alone && (-3..=3).any(|dx| (-3..=3).any(|dy| free(dx, dy))) {
            assert!(cut.contains(&key), "{what}: {end:?} is no vertex of the cut ground");
        }
    }
}

/// From a point to the nearest one of an edge, px.
fn distance(edge: &[Point; 2], at: [f64; 2]) -> f64 {
    let [from, to] = edge.map(|end| end.map(f64::from));
    let (along, away) = ([to[0] - from[0], to[1] - from[1]], [at[0] - from[0], at[1] - from[1]]);
    let length = along[0] * along[0] + along[1] * along[1];
    let share = if length > 0.0 { ((along[0] * away[0] + along[1] * away[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (away[0] - share * along[0]).hypot(away[1] - share * along[1])
}

#[test]
fn the_ground_of_every_preset_is_the_image_without_its_rocks() {
    for preset in PRESETS {
        let params = Params { image_width: 90, image_height: 70, seed: 4, ..preset.params() };
        check(&params, preset.name);
    }
}

#[test]
fn the_ground_of_random_fields_is_the_image_without_their_rocks() {
    for round in 0..100 {
        let mut stream = Stream::new(round, Purpose::Darts, 1, 0);
        let mut pick = |from: f64, to: f64| from + (to - from) * stream.unit();
        let layers = (0..1 + round % 4).map(|id| Layer {
            radius: pick(2.0, 24.0),
            area_fraction: pick(0.05, 0.9),
            taper: [pick(0.0, 2.0), pick(0.0, 1.0), pick(0.0, 1.0)],
            height: [pick(0.1, 3.0), pick(0.0, 1.0), pick(0.0, 1.0)],
            weathering: pick(-1.0, 1.0).max(0.0),
            roughness: pick(-1.0, 1.0).max(0.0),
            embedding: pick(-0.5, 0.9).max(0.0),
            detail: pick(-30.0, 60.0).max(0.0),
            ..Layer::with_defaults(id, Notation::Px)
        });
        let layers = layers.collect();
        let [image_width, image_height] = [pick(1.0, 90.0), pick(1.0, 90.0)].map(|side| side as u32);
        check(
            &Params { image_width, image_height, seed: round, layers, ..Params::default() },
            &format!("round {round}"),
        );
    }
}

#[test]
fn without_rocks_the_ground_is_two_triangles() {
    for cut in [true, false] {
        let sheet = Ground::new(30, 20).sheet(cut);
        assert_eq!((sheet.positions.len(), sheet.indices.len()), (8, 6));
        assert_eq!(area(&sheet), 600.0);
    }
}

/// A pyramid over these corners, whose rim is at `depth` below the ground.
fn add_pyramid(ground: &mut Ground, rim: &[[f32; 2]], depth: f32) {
    let corners = rim.len() as u32;
    let middle = [0, 1].map(|axis| rim.iter().map(|at| at[axis]).sum::<f32>() / corners as f32);
    let mut positions: Vec<f32> = rim.iter().flat_map(|at| [at[0], at[1], -depth]).collect();
    positions.extend([middle[0], middle[1], 4.0 - depth]);
    let indices: Vec<u32> = (0..corners).flat_map(|k| [k, (k + 1) % corners, corners]).collect();
    ground.add(&positions, &indices, &[0, corners + 1], &[0, 3 * corners]);
}

#[test]
fn a_sunken_rock_is_cut_where_its_surface_leaves_the_ground() {
    let square = [[2.0, 2.0], [10.0, 2.0], [10.0, 10.0], [2.0, 10.0]];
    for (depth, expected) in [(0.0, 64.0), (1.0, 36.0), (2.0, 16.0), (5.0, 0.0)] {
        let mut ground = Ground::new(12, 12);
        add_pyramid(&mut ground, &square, depth);
        assert_eq!(area(&ground.sheet(true)), 144.0 - expected, "at {depth} px");
    }
}

#[test]
fn rocks_that_cross_touch_coincide_and_leave_the_image_leave_what_none_of_them_covers() {
    let squares: &[([f32; 2], f32)] = &[
        ([1.0, 1.0], 4.0),
        ([3.0, 3.0], 4.0),
        ([3.0, 3.0], 4.0),
        ([7.0, 3.0], 2.0),
        ([-2.0, 8.0], 4.0),
        ([7.0, 5.0], 2.0),
    ];
    let mut ground = Ground::new(12, 12);
    for &([x, y], side) in squares {
        add_pyramid(&mut ground, &[[x, y], [x + side, y], [x + side, y + side], [x, y + side]], 0.0);
    }
    let expected = 144.0 - (16.0 + 16.0 - 4.0 + 4.0 + 8.0 + 4.0);
    assert_eq!(area(&ground.sheet(true)), expected);
    assert_eq!(area(&ground.sheet(false)), 144.0);
}
