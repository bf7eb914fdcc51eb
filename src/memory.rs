//! The memory a run needs, estimated before anything is allocated.

use crate::error::Error;
use crate::params::{Darts, Layer, Params};
use crate::rocks::{target_sites, worn_counts};

/// An estimate of the peak, with the parameter that would lower it most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryEstimate {
    /// Bytes at the peak of a run, output included.
    pub bytes: u64,
    /// The parameter to change: what saves most of halving the image's longer side and
    /// doubling the radius of one layer.
    pub key: &'static str,
}

impl MemoryEstimate {
    /// # Errors
    /// [`Error::OverBudget`] where the estimate exceeds the budget.
    pub fn check(self, budget: u64) -> Result<(), Error> {
        if self.bytes > budget {
            return Err(Error::OverBudget { key: self.key, estimate: self.bytes, budget });
        }
        Ok(())
    }
}

/// Estimates the peak memory of a run: the generator's own, and the buffers once more as they are copied out to JavaScript.
///
/// Meant to lie between the real peak and twice it, on a fresh generator as on one that has run before; `tests/memory.rs` measures
/// both. It is the largest of the stages' peaks, each with what the stages before it have left, for the numbers of sites and
/// rocks to be expected. In bytes, with 6 vertices to a cell:
///
/// | | kept | beside it, while the stage runs |
/// |---|---|---|
/// | a pixel | – | 1/8 as a flag; 0.2 in a list of the last free ones |
/// | a site | 4 | 8 while its list grows |
/// | its cell: vertices, neighbours, bucket | 4 + 6·(16 + 4) + 16 | 6·16 + 8 |
/// | a rock: p_add and 16 triangles | 8 + 6·16 + 16·6 | – |
/// | its 12 vertices and 16 triangles in the buffers, more of them with detail | 24 a vertex, 12 a triangle, 9 | 12 a vertex while a buffer grows |
/// | copied out | 8 + 4 + 6·8 a site, 4 + the buffers a rock | 6·8 a site |
pub fn memory_estimate(params: &Params) -> MemoryEstimate {
    let bytes = peak_bytes(params);
    let [width, height] = [params.image_width, params.image_height];
    // Halving the longer side.
    let (key, changed) = if height > width {
        ("imageHeight", Params { image_height: height.div_ceil(2), ..params.clone() })
    } else {
        ("imageWidth", Params { image_width: width.div_ceil(2), ..params.clone() })
    };
    let mut best = (peak_bytes(&changed), key);
    for k in 0..params.layers.len() {
        let mut changed = params.clone();
        changed.layers[k].radius *= 2.0;
        let bytes = peak_bytes(&changed);
        if bytes < best.0 {
            best = (bytes, "radius");
        }
    }
    MemoryEstimate { bytes, key: best.1 }
}

/// A wasm instance before its first run: stack and static data.
const INSTANCE: f64 = 1.2e6;

/// What a heap takes over what lies in it, after several runs: a memory of wasm never shrinks.
const HOLES: f64 = 1.12;

/// Cell vertices per site: under 6 by Euler's formula.
const VERTICES: f64 = 6.0;

const SITE: f64 = 4.0;
const CELL: f64 = 4.0 + VERTICES * (16.0 + 4.0) + 16.0;
const SHAPE: f64 = 4.0 + 4.0 + VERTICES * 16.0 + (3.0 * VERTICES - 2.0) * 6.0;
const FLAT_VERTICES: f64 = VERTICES * 8.0;

fn peak_bytes(params: &Params) -> u64 {
    let pixels = params.pixels() as f64;
    let flags = pixels / 8.0;
    let layers: Vec<Expected> = expect(params);
    let sites: f64 = layers.iter().map(|layer| layer.sites).sum();
    let sum = |bytes: fn(&Expected) -> f64| layers.iter().map(bytes).sum::<f64>();
    let rocks = sum(|layer| layer.rocks);
    let buffers = sum(|layer| layer.rocks * layer.buffers());
    let most_sites = layers.iter().fold(0.0_f64, |most, layer| most.max(layer.sites));
    // The buffers of the run before stay where they are until the new rocks are written.
    let mut kept = buffers;
    let mut peak = 0.0_f64;
    for layer in &layers {
        let list = if layer.jams { 0.2 * pixels } else { 0.0 };
        peak = peak.max(kept + flags + list + layer.sites * 3.0 * SITE);
        kept += layer.sites * SITE;
    }
    for layer in &layers {
        // Shrinking the list of vertices to what is needed may copy it.
        peak = peak.max(kept + layer.sites * (CELL + VERTICES * 16.0 + 8.0));
        kept += layer.sites * CELL;
    }
    peak = peak.max(kept + flags + most_sites * 8.0);
    kept += rocks * SHAPE;
    // Growing a buffer that the run before has left may copy it; so does what makes the cells' vertices f32.
    let grown = sum(|layer| layer.rocks * layer.vertices * 12.0);
    peak = peak.max(kept + grown).max(kept + most_sites * FLAT_VERTICES);
    let copies = sites * (12.0 + FLAT_VERTICES) + rocks * 4.0 + buffers;
    (INSTANCE + HOLES * peak + copies) as u64
}

/// How many sites and rocks a layer will have, rather more than fewer.
struct Expected {
    sites: f64,
    rocks: f64,
    /// The darts end where no pixel is free.
    jams: bool,
    /// Of one rock.
    vertices: f64,
    triangles: f64,
}

impl Expected {
    fn new(layer: &Layer, sites: f64, jams: bool) -> Self {
        // Of a hundred rocks, six vertices to a cell.
        let [vertices, triangles] = worn_counts(100, 600, 1 << layer.detail).map(|count| count as f64 / 100.0);
        Expected { sites, rocks: 0.0, jams, vertices, triangles }
    }

    /// Bytes of one rock in the buffers.
    fn buffers(&self) -> f64 {
        self.vertices * (12.0 + 12.0) + self.triangles * 12.0 + 9.0
    }
}

fn expect(params: &Params) -> Vec<Expected> {
    let mut layers: Vec<(Layer, f64, bool)> = Vec::new();
    for layer in &params.layers {
        let layer = params.layer_in_px(layer);
        let (sites, jams) = expected_sites(params, layer.radius);
        layers.push((layer, sites, jams));
    }
    // Coarser layers come first and take their share of the pixels.
    let mut order: Vec<usize> = (0..layers.len()).collect();
    order.sort_by(|&a, &b| layers[a].1.total_cmp(&layers[b].1));
    let mut expected: Vec<Expected> =
        layers.iter().map(|(layer, sites, jams)| Expected::new(layer, *sites, *jams)).collect();
    let mut free = 1.0_f64;
    // Length of the border around what is taken, per pixel of the image.
    let mut border = 0.0;
    for k in order {
        let (layer, sites, _) = &layers[k];
        let wanted = layer.cell_count.map_or(layer.area_fraction, |count| f64::from(count) / sites.max(1.0));
        if wanted == 0.0 || *sites == 0.0 {
            continue;
        }
        // Cells across the border of coarser rocks are lost; what is not reached is left for finer layers.
        let crossed = layer.radius * border / free.max(f64::MIN_POSITIVE);
        // The last cell is taken whole.
        let share = |lost: f64| (wanted + 1.0 / sites).min(free * (-lost * crossed).exp());
        expected[k].rocks = sites * share(LOST_AT_LEAST);
        let reached = share(LOST_AT_MOST);
        free -= reached;
        border += reached / layer.radius;
    }
    expected
}

/// Of the free ground, e^(−lost · r · border / free) is in cells that no border of coarser rocks crosses: as in a Poisson process
/// of borders. Fitted to Table 1's presets, which lose least (1.26 to 1.9), and to grounds of seven layers (2.1 to 2.2).
const LOST_AT_LEAST: f64 = 1.2;
const LOST_AT_MOST: f64 = 2.2;

/// The number of sites, and whether the darts end for want of free pixels.
fn expected_sites(params: &Params, radius: f64) -> (f64, bool) {
    let pixels = params.pixels() as f64;
    let target = target_sites(pixels, params.packing, radius).floor();
    // Distances on the grid are square roots of whole numbers, so r acts like the next of them.
    let apart = next_distance(radius);
    let [w, h] = [params.image_width, params.image_height].map(|side| f64::from(side) + BORDER * apart);
    let jammed = if apart > 1.0 { target_sites(w * h, JAMMED, apart).ceil() } else { pixels };
    match params.darts {
        Darts::Saturate if target < jammed => (target.min(pixels), false),
        Darts::Saturate => (jammed.min(pixels), true),
        Darts::Attempts => {
            // τ throws per place leave about τ / (1 + 2τ) of the places taken: 0.29 at τ = 0.7 (decision A1).
            let tau = target / target_sites(w * h, 1.0, apart).max(1.0);
            let hits = if apart > 1.0 { target / (1.0 + 2.0 * tau) * 1.1 } else { target };
            (hits.min(target).min(pixels), false)
        }
    }
}

/// Random discs jam at 0.547 of the area (decision A1); small ones, on a grid, a little denser.
const JAMMED: f64 = 0.57;

/// Discs of sites near the border lie partly outside: the image acts like one larger by this many radii.
const BORDER: f64 = 0.6;

/// The smallest distance between two pixels that is at least r.
fn next_distance(radius: f64) -> f64 {
    if radius > 4.0 {
        return radius;
    }
    let squares = (0..=4).flat_map(|x| (0..=4).map(move |y| f64::from(x * x + y * y)));
    squares.filter(|&d2| d2 >= radius * radius && d2 > 0.0).fold(f64::MAX, f64::min).sqrt()
}
