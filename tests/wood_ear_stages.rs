//! Wood ears before their collisions: bowls, drying, wrinkles, places and the log, natively and in wasm.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::field_test;
use common::wood_ear::{own, run, small};
use glam::DVec3;
use rock_field::params::wood_ear::{Collisions, Params};
use rock_field::validate::check_closed;
use rock_field::wood_ear::{bowl, deform, drying, spawn};

/// Without deformation, collisions or additions.
fn bare() -> Params {
    Params { moisture: 100.0, wrinkles: 0.0, collisions: Collisions::Off, ..small() }
}

field_test! {
    fn the_unit_bowl_is_equation_3_1() {
        for (d, c) in [(10_u32, 30_u32), (3, 8), (24, 64)] {
            let points = bowl(d, c);
            assert_eq!(points.len() as u32, c * d);
            for (v, p) in (0..).zip(&points) {
                let (e, theta) = (f64::from(v / c + 1), f64::from(v % c) / f64::from(c) * std::f64::consts::TAU);
                let scale = f64::from(d * d);
                let raw = DVec3::new(e * f64::from(d) * theta.sin(), (e - 1.0) * (e - 1.0), e * f64::from(d) * theta.cos());
                assert!(p.distance(raw / scale) < 1.0e-14, "{v}: {p} instead of {}", raw / scale);
            }
        }
    }
}

field_test! {
    fn wet_and_unwrinkled_is_exactly_the_bowl_whatever_the_seed() {
        for seed in [0, 7] {
            let params = Params { seed, ..bare() };
            let run = run(&params);
            let unit = bowl(params.rings, params.meridians);
            for (k, sheet) in run.generator.sheets().iter().enumerate() {
                assert_eq!(sheet.points, unit);
                for (p, q) in own(&run, &run.generator.mesh().positions, k).iter().zip(&unit) {
                    assert!(p.distance(*q * sheet.size) < 2.0e-5);
                }
            }
            let layout = run.generator.layout();
            assert_eq!(u32::from(layout.vertices), params.rings * params.meridians);
            assert_eq!(layout.triangles.len() as u32, 2 * params.meridians * (params.rings - 1));
        }
    }
}

/// Sheets of some individuals with these moistures and wrinkles.
fn sheets(change: impl Fn(&mut Params)) -> Vec<Vec<DVec3>> {
    let mut params = bare();
    change(&mut params);
    let run = run(&bare());
    let unit = bowl(params.rings, params.meridians);
    let of = run.generator.spawn().individuals.iter().take(40);
    of.map(|individual| deform(&params, individual, &unit).points).collect()
}

field_test! {
    fn displacements_fall_with_moisture_and_rise_with_wrinkles() {
        let unit = bowl(bare().rings, bare().meridians);
        let moved = |all: &[Vec<DVec3>]| -> Vec<f64> {
            all.iter().flat_map(|points| points.iter().zip(&unit).map(|(p, q)| p.distance(*q))).collect()
        };
        let dry = [0.0, 30.0, 50.0, 70.0, 100.0].map(|moisture| moved(&sheets(|p| p.moisture = moisture)));
        assert!(dry.windows(2).all(|pair| pair[0].iter().zip(&pair[1]).all(|(a, b)| a >= b)));
        assert!(dry[4].iter().all(|d| *d == 0.0) && dry[0].iter().sum::<f64>() > 0.0);
        let folds = [0.0, 20.0, 50.0, 100.0].map(|wrinkles| moved(&sheets(|p| p.wrinkles = wrinkles)));
        assert!(folds.windows(2).all(|pair| pair[0].iter().zip(&pair[1]).all(|(a, b)| a <= b)));
    }
}

field_test! {
    fn drying_keeps_directions_and_is_even_along_a_meridian() {
        let (c, d) = (bare().meridians as usize, f64::from(bare().rings));
        let unit = bowl(bare().rings, bare().meridians);
        for points in sheets(|p| p.moisture = 0.0) {
            for f in 0..c {
                let mut share = None;
                for (e, v) in (1..).zip((f..points.len()).step_by(c)) {
                    let scale = points[v].length() / unit[v].length();
                    assert!(points[v].distance(unit[v] * scale) < 1.0e-12, "a vertex left its direction from the foot");
                    let o = (1.0 - scale) / (f64::from(e) / d);
                    if scale > 0.1 + 1.0e-9 {
                        assert!((o - *share.get_or_insert(o)).abs() < 1.0e-9);
                    }
                    assert!((0.1 - 1.0e-12..=1.0 + 1.0e-12).contains(&scale));
                }
            }
        }
    }
}

field_test! {
    fn wrinkling_leaves_heights_alone_and_moves_nothing_outward() {
        let unit = bowl(bare().rings, bare().meridians);
        let mut folded = 0;
        for points in sheets(|p| p.wrinkles = 100.0) {
            for (p, q) in points.iter().zip(&unit) {
                let [r, s] = [p, q].map(|p| (p.x * p.x + p.z * p.z).sqrt());
                assert!(p.y == q.y && r <= s + 1.0e-15 && r >= 0.1 * s - 1.0e-15);
                folded += usize::from(r < s);
            }
        }
        assert!(folded > 0);
    }
}

field_test! {
    fn noise_has_no_seam_and_is_smooth_around_the_ring() {
        let params = Params { rings: 10, meridians: 30, ..Params::with_defaults() };
        let unit = bowl(10, 30);
        let (mut seam, mut steps, mut size) = (0.0, 0.0, 0.0);
        for vertex in 0..300 {
            let n = drying(&params, vertex, &unit);
            seam += (n[29] - n[0]).abs();
            steps += n.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>() / 29.0;
            size += n.iter().map(|n| n.abs()).sum::<f64>() / 30.0;
        }
        assert!((0.5..1.5).contains(&(seam / steps)), "seam {}", seam / steps);
        assert!(steps / size < 0.7, "neighbours differ by {} of the mean", steps / size);
        assert!((0.2..0.7).contains(&(size / 300.0)), "mean |n| {}", size / 300.0);
    }
}

field_test! {
    fn the_number_of_individuals_is_binomial_and_grows_with_density() {
        let all = run(&Params { density: 100.0, ..bare() });
        let n = all.generator.spawn().individuals.len() as f64;
        assert_eq!(run(&Params { density: 0.0, ..bare() }).generator.spawn().individuals.len(), 0);
        let log = all.generator.log();
        let base = log.points[all.generator.spawn().bases[0] as usize];
        let within = log.points.iter().filter(|p| p.distance(base) <= bare().range).count();
        assert_eq!(n as usize, within);
        let mut sum = 0.0;
        for seed in 0..60 {
            sum += spawn(&Params { seed, density: 30.0, ..bare() }, log).individuals.len() as f64;
        }
        let (mean, deviation) = (60.0 * 0.3 * n, (60.0 * n * 0.3 * 0.7).sqrt());
        assert!((sum - mean).abs() < 4.0 * deviation, "{sum} instead of {mean} ± {deviation}");
        // A greater density adds individuals and moves none.
        let [few, many] = [30.0, 60.0].map(|density| spawn(&Params { density, ..bare() }, log).individuals);
        assert!(few.iter().all(|one| many.contains(one)) && few.len() < many.len());
    }
}

field_test! {
    fn sizes_lie_within_the_spread() {
        for v in [1.0, 1.5, 2.0] {
            let params = Params { size: 2.0, size_spread: v, density: 100.0, ..bare() };
            let run = run(&params);
            let sizes: Vec<f64> = run.generator.sheets().iter().map(|sheet| sheet.size / 2.0).collect();
            assert!(sizes.iter().all(|s| *s >= 1.0 / v - 1.0e-9 && *s <= v + 1.0e-9));
            if v == 1.0 {
                assert!(sizes.iter().all(|s| *s == 1.0));
            } else {
                let mean_log = sizes.iter().map(|s| s.ln() / v.ln()).sum::<f64>() / sizes.len() as f64;
                assert!(mean_log.abs() < 3.0 * (1.0 / 3.0 / sizes.len() as f64).sqrt(), "{mean_log}");
            }
        }
    }
}

field_test! {
    fn the_log_is_closed_and_its_vertices_evenly_spaced_whatever_the_sliders() {
        let mut spacings = Vec::new();
        for (length, radius, bend, bark) in [(200.0, 14.0, 0.3, 0.5), (60.0, 8.0, 1.0, 1.0), (40.0, 5.0, 0.0, 0.0), (120.0, 30.0, 0.6, 0.2)] {
            let mut params = bare();
            params.log = rock_field::params::wood_ear::Log { length, radius, bend, bark, spacing: 3.0, seed: 5 };
            let run = run(&params);
            let (log, fine) = (run.generator.log(), run.generator.log_mesh());
            check_closed(log.points.len(), log.triangles.as_flattened()).unwrap();
            check_closed(fine.positions.len() / 3, &fine.indices).unwrap();
            let volume: f64 = log.triangles.iter().map(|t| {
                let [a, b, c] = t.map(|v| log.points[v as usize]);
                a.dot(b.cross(c)) / 6.0
            }).sum();
            let cylinder = std::f64::consts::PI * radius * radius * length;
            assert!((0.8..1.25).contains(&(volume / cylinder)), "volume {volume}, cylinder {cylinder}");
            let mut edges: Vec<f64> = log.triangles.iter().flat_map(|t| {
                (0..3).map(|k| log.points[t[k] as usize].distance(log.points[t[(k + 1) % 3] as usize])).collect::<Vec<f64>>()
            }).collect();
            edges.sort_by(f64::total_cmp);
            let at = |share: f64| edges[(share * (edges.len() - 1) as f64) as usize];
            assert!(at(0.95) / at(0.05) < 1.9, "edges {} to {}", at(0.05), at(0.95));
            spacings.push(at(0.5));
            // The bark's vertices are vertices of what is seen.
            let seen: std::collections::BTreeSet<[u32; 3]> =
                fine.positions.chunks_exact(3).map(|p| [p[0], p[1], p[2]].map(f32::to_bits)).collect();
            let bark = log.points.iter().zip(&log.kinds).filter(|(_, kind)| **kind == 0);
            assert!(bark.clone().count() > 50);
            for (p, _) in bark {
                assert!(seen.contains(&p.as_vec3().to_array().map(f32::to_bits)), "{p}");
            }
        }
        assert!(spacings.iter().all(|s| (s / 3.0 - 1.0).abs() < 0.12), "{spacings:?}");
    }
}

field_test! {
    fn five_thousand_vertices_are_within_reach() {
        let mut params = Params { density: 0.0, ..Params::with_defaults() };
        (params.log.spacing, params.log.length) = (2.8, 400.0);
        assert!(run(&params).generator.log().points.len() >= 5000);
    }
}
