//! The exact input → output pairs of `tests/data/vectors.json`, which need no random numbers.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::collections::BTreeSet;

use common::{field_test, saturated, sites_at};
use glam::{DVec2, DVec3};
use rock_field::rocks::{
    Pixel, Sites, Threshold, accept_picks, cell_pixels, displace, select, target_sites, triangulate, voronoi,
};
use serde_json::Value;

const PX: f64 = 1.0e-6;

fn vectors(name: &str) -> Vec<Value> {
    let all: Value = serde_json::from_str(include_str!("data/vectors.json")).unwrap();
    all[name].as_array().unwrap().clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn whole(value: &Value) -> u64 {
    value.as_u64().unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn wholes(value: &Value) -> Vec<u32> {
    value.as_array().unwrap().iter().map(|v| whole(v) as u32).collect()
}

fn pixels(value: &Value) -> Vec<Pixel> {
    value.as_array().unwrap().iter().map(|v| [whole(&v[0]) as u16, whole(&v[1]) as u16]).collect()
}

fn points(value: &Value) -> Vec<DVec2> {
    value.as_array().unwrap().iter().map(|v| DVec2::new(number(&v[0]), number(&v[1]))).collect()
}

/// Sites as one finds them, or with the radius at which they are saturated.
fn sites_for(jammed: bool, vector: &Value, sites: &Value) -> Sites {
    let sites = sites_of(vector, sites);
    if jammed { saturated(&sites) } else { sites }
}

fn sites_of(vector: &Value, sites: &Value) -> Sites {
    sites_at(whole(&vector["W"]) as u32, whole(&vector["H"]) as u32, 6.0, pixels(sites))
}

field_test! {
    fn eq_1_gives_the_number_of_sites() {
        for vector in vectors("eq1") {
            let value = target_sites(number(&vector["A"]), number(&vector["c_d"]), number(&vector["r"]));
            assert!((value - number(&vector["value"])).abs() < PX, "{value}: {vector}");
            assert_eq!(value as u64, whole(&vector["floor"]), "{vector}");
        }
    }
}

field_test! {
    fn one_dart_flags_the_open_disc() {
        for vector in vectors("disc") {
            let side = 41;
            let (accepted, free) = accept_picks(side, side, number(&vector["r"]), &[[20, 20]]);
            assert_eq!(accepted, [0]);
            assert_eq!(u64::from(side * side) - free, whole(&vector["open"]), "{vector}");
        }
    }
}

field_test! {
    fn given_darts_are_accepted_or_refused() {
        for vector in vectors("darts") {
            let (w, h) = (whole(&vector["W"]) as u32, whole(&vector["H"]) as u32);
            let (accepted, free) = accept_picks(w, h, number(&vector["r"]), &pixels(&vector["picks"]));
            let accepted: Vec<u32> = accepted.iter().map(|&index| index as u32).collect();
            assert_eq!(accepted, wholes(&vector["accepted"]));
            assert_eq!(free, whole(&vector["free_pixels"]));
        }
    }
}

field_test! {
    fn cells_are_the_given_polygons() {
        for (vector, jammed) in vectors("voronoi").iter().flat_map(|v| [(v, true), (v, false)]) {
            let sites = sites_for(jammed, vector, &vector["sites"]);
            let cells = voronoi(&sites);
            assert_eq!(cells.len(), vector["cells"].as_array().unwrap().len());
            for (i, cell) in vector["cells"].as_array().unwrap().iter().enumerate() {
                let (ours, theirs) = (cells.polygon(i), points(&cell["poly"]));
                let place = format!("cell {i}, jammed {jammed}: {ours:?} instead of {theirs:?}");
                assert_eq!(ours.len(), theirs.len(), "{place}");
                assert!(ours.iter().zip(&theirs).all(|(a, b)| (*a - *b).abs().max_element() < PX), "{place}");
                let area: f64 =
                    (0..ours.len()).map(|k| 0.5 * ours[k].perp_dot(ours[(k + 1) % ours.len()])).sum();
                assert!((area - number(&cell["area"])).abs() < PX * 100.0, "{place}");
                assert_eq!(cells.touches_border(i), cell["border"].as_bool().unwrap(), "{place}");
            }
        }
    }
}

field_test! {
    fn pixels_go_to_the_nearest_site_and_ties_to_the_lowest_index() {
        for (vector, jammed) in vectors("voronoi").iter().flat_map(|v| [(v, true), (v, false)]) {
            let sites = sites_for(jammed, vector, &vector["sites"]);
            let cells = voronoi(&sites);
            let mut ties = 0;
            let mut without_ties = vec![0_u32; cells.len()];
            let mut owned = 0;
            for (i, unique) in without_ties.iter_mut().enumerate() {
                for [x, y] in cell_pixels(&sites, &cells, i) {
                    let d2 = |site: &Pixel| site[0].abs_diff(x) as u32 * site[0].abs_diff(x) as u32
                        + site[1].abs_diff(y) as u32 * site[1].abs_diff(y) as u32;
                    let nearest = sites.pixels.iter().map(d2).min().unwrap();
                    let all: Vec<usize> = (0..cells.len()).filter(|&j| d2(&sites.pixels[j]) == nearest).collect();
                    assert_eq!(all[0], i, "pixel {x}, {y} is as near to {all:?}");
                    owned += 1;
                    match all.len() {
                        1 => *unique += 1,
                        _ => ties += 1,
                    }
                }
            }
            assert_eq!(owned, sites.width * sites.height);
            assert_eq!(ties, whole(&vector["tie_pixels"]));
            assert_eq!(without_ties, wholes(&vector["pixels_without_ties"]));
        }
    }
}

field_test! {
    fn given_visiting_orders_take_the_given_cells() {
        for (vector, jammed) in vectors("selection").iter().flat_map(|v| [(v, true), (v, false)]) {
            let list = |key: &str| vector[key].as_array().unwrap().clone();
            let sites: Vec<Sites> = list("sites").iter().map(|s| sites_for(jammed, vector, s)).collect();
            let cells: Vec<_> = sites.iter().map(voronoi).collect();
            let layers: Vec<_> = sites.iter().zip(&cells).zip(list("orders").iter().zip(list("A_s")))
                .map(|((sites, cells), (order, area))| (sites, cells, wholes(order), Threshold::Area(number(&area))))
                .collect();
            let selections = select(&layers);
            assert_eq!(selections.len(), layers.len());
            for (k, selection) in selections.iter().enumerate() {
                let area = f64::from(sites[k].width * sites[k].height);
                let fraction = selection.pixels as f64 / area;
                assert_eq!(selection.selected, wholes(&vector["taken"][k]), "layer {k}");
                assert!((fraction - number(&vector["fraction"][k])).abs() < 1.0e-9, "layer {k}: {fraction}");
                assert_eq!(selection.saturated, fraction < number(&vector["A_s"][k]), "layer {k}");
            }
        }
    }
}

field_test! {
    fn rocks_are_triangulated_and_then_displaced() {
        for vector in vectors("rock") {
            let (rim, top) = (points(&vector["cell"]), points(&vector["p_add"]));
            let sorted = |triangle: &[u16]| {
                let mut sorted: [u16; 3] = triangle.try_into().unwrap();
                sorted.sort_unstable();
                sorted
            };
            let ours: BTreeSet<_> = triangulate(&rim, &top).unwrap().iter().map(|t| sorted(t)).collect();
            let theirs: BTreeSet<_> = vector["triangles"].as_array().unwrap().iter()
                .map(|t| sorted(&wholes(t).iter().map(|&v| v as u16).collect::<Vec<_>>()))
                .collect();
            assert_eq!(ours, theirs);

            // The conference multiplies Eq. 3 by r, and not Eq. 2 (decision A5).
            let unit = if vector["variant"] == "nicograph2010" { number(&vector["r"]) } else { 1.0 };
            let taper = numbers(&vector["c_w"]).try_into().unwrap();
            let height: [f64; 3] = numbers(&vector["c_h"]).try_into().unwrap();
            let mut j2 = numbers(&vector["j2"]).into_iter();
            let j1 = number(&vector["j1"]);
            let mut moved = Vec::new();
            let swings = || [[j1, j2.next().unwrap()]; 2];
            displace(&top, taper, height.map(|c| c * unit), swings, |p: DVec3| moved.push(p));
            let expected = vector["moved"].as_array().unwrap();
            assert_eq!(moved.len(), expected.len());
            for (ours, theirs) in moved.iter().zip(expected) {
                let theirs = DVec3::from_slice(&numbers(theirs));
                assert!((*ours - theirs).abs().max_element() < PX, "{ours} instead of {theirs}");
            }
        }
    }
}
