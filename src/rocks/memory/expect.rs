//! Estimates from the parameters alone how many sites and rocks the layers of a field will have.

use super::super::sites::target_sites;
use super::super::subdivide::{Fineness, counts as worn_counts};
use super::need::Counts;
use crate::params::{Border, Darts, Layer, Params};

/// Returns, per layer, the number of sites that is likely, and the number of rocks that will certainly fit.
pub(super) fn expect(params: &Params) -> Vec<Counts> {
    let layers: Vec<(Layer, f64)> = params
        .layers
        .iter()
        .map(|layer| {
            let layer = params.layer_in_px(layer);
            let sites = expected_sites(params, layer.radius);
            (layer, sites)
        })
        .collect();
    // Coarser layers come first and take their share of the pixels.
    let order = coarsest_first(layers.len(), |k| layers[k].1);
    let mut rocks = vec![0.0; layers.len()];
    let mut free = 1.0_f64;
    // Length of the border around taken pixels, per pixel of the image.
    let mut border = 0.0;
    for k in order {
        let (layer, sites) = &layers[k];
        let wanted = layer.cell_count.map_or(layer.area_fraction, |count| f64::from(count) / sites.max(1.0));
        if wanted == 0.0 || *sites == 0.0 {
            continue;
        }
        // Cells that cross the border of coarser rocks are lost. Ground that a layer does not fill is left for finer
        // layers.
        let crossed = layer.radius * border / free.max(f64::MIN_POSITIVE);
        let inner = if params.border == Border::Drop { inner_share(params, *sites) } else { 1.0 };
        // The last cell is taken whole.
        let share = |lost: f64| (wanted + 1.0 / sites).min(inner * free * (-lost * crossed).exp());
        rocks[k] = sites * share(LOST);
        let reached = share(LOST_AT_LEAST);
        free = (free - reached).max(0.0);
        border += reached / layer.radius;
    }
    let counts = |(layer, sites): &(Layer, f64), rocks: f64| {
        let rims = 6.0 * rocks;
        let [vertices, triangles] = cut_counts(layer, params.pixels() as f64 / sites.max(1.0)).map(|n| n * rocks);
        let largest = if layer.detail > 0.0 { vertices / rocks.max(1.0) } else { 0.0 };
        Counts { sites: *sites, corners: 6.0 * sites, rocks, rims, vertices, triangles, largest }
    };
    layers.iter().zip(rocks).map(|(layer, rocks)| counts(layer, rocks)).collect()
}

/// Mean number of vertices and of triangles of a rock in a layer whose cells have this mean area, px².
fn cut_counts(layer: &Layer, mean: f64) -> [f64; 2] {
    let fineness = Fineness::new(layer.detail, layer.height);
    let sum = CELL_AREAS.iter().fold([0.0, 0.0], |[vertices, triangles], share| {
        let area = share * mean;
        let segments = fineness.segments_of(6, area, CELL_AROUND * area.sqrt());
        let [more_vertices, more_triangles] = worn_counts(1, 6, segments);
        [vertices + more_vertices as f64, triangles + more_triangles as f64]
    });
    let spare = if layer.detail > 0.0 { SPARE } else { 1.0 };
    sum.map(|n| spare * n / CELL_AREAS.len() as f64)
}

/// Areas of cells relative to the mean of their layer: equally many cells are near each. Measured, as is the circumference of a cell
/// over the root of its area.
const CELL_AREAS: [f64; 8] = [0.79, 0.86, 0.92, 0.97, 1.01, 1.07, 1.14, 1.25];
const CELL_AROUND: f64 = 3.88;

/// Where rocks are cut, a few large ones decide, and which those are is up to chance.
const SPARE: f64 = 1.15;

/// The layers' indices by ascending number of sites, equal ones in input order. An insertion sort is enough for a few
/// layers, whereas the sort of the standard library takes 3 kB of the wasm file.
pub(crate) fn coarsest_first(layers: usize, sites: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut order = Vec::with_capacity(layers);
    for k in 0..layers {
        let before = order.iter().take_while(|&&other| sites(other) <= sites(k)).count();
        order.insert(before, k);
    }
    order
}

/// The share of a layer's cells that do not touch the image's border.
fn inner_share(params: &Params, sites: f64) -> f64 {
    let [w, h] = [params.image_width, params.image_height].map(f64::from);
    let width = (w * h / sites).sqrt();
    ((1.0 - 2.0 * width / w).max(0.0)) * ((1.0 - 2.0 * width / h).max(0.0))
}

/// A share of e^(−lost · r · border / free) of the free ground lies in cells that no border of coarser rocks crosses,
/// as in a Poisson process of borders. Fitted to the presets of Table 1, which lose least (1.26 to 1.9), and to grounds
/// of seven layers (2.1 to 2.2).
const LOST: f64 = 1.4;
const LOST_AT_LEAST: f64 = 1.2;

/// The expected number of sites, rather too many than too few.
pub(crate) fn expected_sites(params: &Params, radius: f64) -> f64 {
    let pixels = params.pixels() as f64;
    let target = target_sites(pixels, params.packing, radius).floor();
    // Distances on the grid are square roots of whole numbers, so r has the same effect as the next one of them.
    let apart = next_distance(radius);
    let [w, h] = [params.image_width, params.image_height].map(|side| f64::from(side) + BORDER * apart);
    let sites = match params.darts {
        Darts::Saturate if apart > 1.0 => target_sites(w * h, JAMMED, apart).ceil(),
        Darts::Saturate => target,
        Darts::Attempts => {
            // τ throws per place fill about τ / (1 + 2τ) of the places: 0.29 at τ = 0.7 (decision A1).
            let tau = target / target_sites(w * h, 1.0, apart).max(1.0);
            // For radii below a pixel, a pixel is taken only by a site of its own.
            if apart > 1.0 { target / (1.0 + 2.0 * tau) * 1.1 } else { pixels * (1.0 - (-target / pixels).exp()) }
        }
    };
    sites.min(target).min(pixels)
}

/// Whether darts may go on until clear pixels have to be found. That is not the case if N_p of them are placed long
/// before.
pub(super) fn may_jam(params: &Params, radius: f64) -> bool {
    let dense = Params { packing: 1.0, ..params.clone() };
    let target = target_sites(params.pixels() as f64, params.packing, radius).floor();
    params.darts == Darts::Saturate && target >= 0.8 * expected_sites(&dense, radius)
}

/// Coverage at which darts jam. Random discs jam at 0.547 of the area (decision A1); small ones on a grid are a little
/// denser.
const JAMMED: f64 = 0.57;

/// Discs of sites near the border lie partly outside, so the image acts like one that is larger by this many radii.
const BORDER: f64 = 0.6;

/// The smallest distance between two pixels that is at least `radius`, px.
fn next_distance(radius: f64) -> f64 {
    if radius > 4.0 {
        return radius;
    }
    let squares = (0..=4).flat_map(|x| (0..=4).map(move |y| f64::from(x * x + y * y)));
    squares.filter(|&d2| d2 >= radius * radius && d2 > 0.0).fold(f64::MAX, f64::min).sqrt()
}
