//! What the tests share: one test on two targets, random parameters, links that reproduce a failure.
#![allow(dead_code, unused_macros, unused_imports, reason = "every test takes its share")]
#![allow(clippy::unwrap_used, reason = "tests")]

#[cfg(not(target_arch = "wasm32"))]
pub mod memory;
pub mod wood_ear;

use rock_field::params::{
    Border, Crossing, Darts, Kind, Layer, Notation, PARAMS, ParamSpec, Params, Range, Scope, Stage, Swing, TEXTS,
};
use rock_field::rocks::{Field, Pixel, Sites, generate, voronoi};
use rock_field::validate::check_field;

/// Makes a function a native test and, for wasm32, one that runs in headless Node.
macro_rules! field_test {
    ($(#[$meta:meta])* fn $name:ident() $body:block) => {
        $(#[$meta])*
        #[cfg_attr(not(target_arch = "wasm32"), test)]
        #[cfg_attr(target_arch = "wasm32", wasm_bindgen_test::wasm_bindgen_test)]
        fn $name() $body
    };
}
pub(crate) use field_test;

/// The end of the address that shows these parameters on the page.
pub fn link(params: &Params) -> String {
    let mut link = String::from("#v=1");
    for (spec, text) in PARAMS.iter().zip(TEXTS) {
        let written = |value: f64| match spec.kind {
            Kind::Choice(words) => words[value as usize].to_string(),
            _ if value.is_nan() => "-".to_string(),
            _ => value.to_string(),
        };
        let values = match spec.scope {
            Scope::Field(get, _) => written(get(params)),
            Scope::Item(get, _) => list(params, |layer| written(get(layer))),
        };
        link += &format!("&{}={values}", text.url);
    }
    if params.layers.iter().enumerate().any(|(index, layer)| layer.id != index as u32) {
        link += &format!("&id={}", list(params, |layer| layer.id.to_string()));
    }
    link
}

fn list(params: &Params, written: impl Fn(&Layer) -> String) -> String {
    params.layers.iter().map(written).collect::<Vec<_>>().join(",")
}

/// Generates and checks a field.
pub fn checked(params: &Params) -> Result<Field, String> {
    let field = generate(params).map_err(|error| format!("{error}\n  {}", link(params)))?;
    check_field(params, &field).map_err(|violation| format!("{violation}\n  {}", link(params)))?;
    Ok(field)
}

/// Parameters with these layers and the defaults for the rest.
pub fn params(width: u32, height: u32, layers: Vec<Layer>) -> Params {
    Params { image_width: width, image_height: height, layers, ..Params::default() }
}

/// A layer of radius r that may fill a share of the ground.
pub fn layer(id: u32, radius: f64, area_fraction: f64) -> Layer {
    Layer { radius, area_fraction, ..Layer::with_defaults(id, Notation::Px) }
}

/// Sites at given pixels, without a claim to be saturated.
pub fn sites_at(width: u32, height: u32, radius: f64, pixels: Vec<Pixel>) -> Sites {
    Sites { width, height, radius, target: pixels.len() as u64, pixels, saturated: false }
}

/// The same sites with the radius at which they are saturated: the diagram is the same, but found with another reach and on
/// another grid.
pub fn saturated(sites: &Sites) -> Sites {
    let cells = voronoi(sites);
    let farthest = |i: usize| {
        let [x, y] = sites.pixels[i].map(|c| f64::from(c) + 0.5);
        let distances = cells.polygon(i).iter().map(move |v| v.distance(glam::DVec2::new(x, y)));
        distances.fold(1.0, f64::max)
    };
    // No pixel is farther from its site than the cell's farthest vertex.
    let radius = (0..cells.len()).map(farthest).fold(1.0, f64::max) + 1.0e-3;
    Sites { radius, saturated: true, ..sites.clone() }
}

/// What two fields that ought to be equal differ in, bit for bit.
pub fn difference(ours: &Field, theirs: &Field) -> Option<String> {
    if ours.layers.len() != theirs.layers.len() {
        return Some(format!("{} layers and {}", ours.layers.len(), theirs.layers.len()));
    }
    for (k, (a, b)) in ours.layers.iter().zip(&theirs.layers).enumerate() {
        let bits = |values: &[glam::DVec2]| -> Vec<[u64; 2]> {
            values.iter().map(|v| v.to_array().map(f64::to_bits)).collect()
        };
        let what = if a.layer != b.layer {
            "layer"
        } else if (&a.sites.pixels, a.sites.target, a.sites.saturated)
            != (&b.sites.pixels, b.sites.target, b.sites.saturated)
        {
            "sites"
        } else if a.cells.starts != b.cells.starts || bits(&a.cells.vertices) != bits(&b.cells.vertices) {
            "cells"
        } else if (0..a.cells.len()).any(|i| a.cells.touches_border(i) != b.cells.touches_border(i)) {
            "cells at the border"
        } else if a.selection != b.selection {
            "selection"
        } else if a.shapes != b.shapes {
            "shapes"
        } else {
            continue;
        };
        return Some(format!("{what} of layer {k}"));
    }
    let (a, b) = (&ours.mesh, &theirs.mesh);
    let bits = |values: &[f32]| -> Vec<u32> { values.iter().map(|v| v.to_bits()).collect() };
    let buffers = [
        ("positions", bits(&a.positions) == bits(&b.positions)),
        ("normals", bits(&a.normals) == bits(&b.normals)),
        ("indices", a.indices == b.indices),
        ("rockStarts", a.rock_starts == b.rock_starts),
        ("vertexStarts", a.vertex_starts == b.vertex_starts),
        ("rockLayer", a.rock_layer == b.rock_layer),
    ];
    buffers.iter().find(|(_, same)| !same).map(|(name, _)| name.to_string())
}

/// Random numbers for tests: SplitMix64 (Steele, Lea & Flood 2014), so that they depend on no stream of the field.
#[derive(Debug, Clone)]
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// Uniform in 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Equal factors are equally likely.
    pub fn log_between(&mut self, low: f64, high: f64) -> f64 {
        (low * (high / low).powf(self.unit())).clamp(low, high)
    }

    pub fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }
}

/// A field as a user could ask for it, on an image with sides of 1 to `side` px.
pub fn random_params(random: &mut Random, side: f64) -> Params {
    let [image_width, image_height] = [(); 2].map(|()| random.log_between(1.0, side + 0.999) as u32);
    let mut params = Params {
        seed: random.bits() as u32,
        image_width,
        image_height,
        packing: random_packing(random),
        notation: if random.chance(0.7) { Notation::Px } else { Notation::Relative },
        darts: if random.chance(0.8) { Darts::Saturate } else { Darts::Attempts },
        border: if random.chance(0.7) { Border::Clip } else { Border::Drop },
        swing: random.pick(&[Swing::Shared, Swing::Separate]),
        ..Params::with_defaults()
    };
    params.crossing = if params.seed.is_multiple_of(16) { Crossing::Apart } else { Crossing::Free };
    for _ in 0..random.below(9) {
        add_random_layer(random, &mut params);
    }
    params
}

pub fn random_packing(random: &mut Random) -> f64 {
    match random.below(10) {
        0..3 => 0.7,
        3..6 => random.between(0.0, 0.55),
        6 => random.pick(&[0.0, 1.0]),
        _ => random.unit(),
    }
}

pub fn add_random_layer(random: &mut Random, params: &mut Params) {
    // Mostly small ids, as they occur in links; now and then any.
    let mut id = if random.chance(0.9) { random.below(12) as u32 } else { random.bits() as u32 };
    while params.layers.iter().any(|layer| layer.id == id) {
        id = id.wrapping_add(1);
    }
    let at = random.below(params.layers.len() + 1);
    let layer = random_layer(random, params, id);
    params.layers.insert(at, layer);
}

pub fn random_layer(random: &mut Random, params: &Params, id: u32) -> Layer {
    let unit = if params.notation == Notation::Px { 1.0 } else { f64::from(params.image_width) / 100.0 };
    let side = f64::from(params.image_width.max(params.image_height));
    // In the conference's notation r can be a hundredth of a pixel.
    let smallest = if params.notation == Notation::Relative && random.chance(0.1) { 0.01 * unit } else { 1.0 };
    let radius = random.log_between(smallest, (1.5 * side).max(smallest + 1.0)) / unit;
    let radius = if random.chance(0.3) { radius.round() } else { radius };
    let reach = random.pick(&[0.0, 2.0, 40.0, 500.0]);
    let top = random.pick(&[0.0, 1.0, 40.0, 500.0]);
    // Cut finer, many rocks would take the tests long.
    let small = side < 200.0;
    let cell_count = random.chance(0.25).then(|| random.log_between(1.0, 1000.0) as u32 - 1);
    // Most of the time off, as in the papers; each stage alone, and all together.
    let mut worn = |values: &[f64]| if random.chance(0.7) { 0.0 } else { random.pick(values) };
    let [weathering, roughness, embedding] = [worn(&[0.05, 0.2, 0.5, 1.0]), worn(&[0.1, 1.0]), worn(&[0.2, 0.6, 1.0])];
    // Of any size of rock some are cut once, some twice or more often; in another layer, too, not so often that there are millions of triangles.
    let fine = |segments: f64| (100.0 * segments / (0.7 * radius)).min(30.0 * unit);
    let detail = if small { fine(worn(&[0.0, 1.0, 2.0, 4.0])) } else { 0.0 };
    let mut layer = Layer {
        id,
        radius: radius.clamp(if params.notation == Notation::Px { 1.0 } else { 0.01 }, 8192.0),
        area_fraction: if random.chance(0.3) { random.pick(&[0.0, 1.0]) } else { random.unit() },
        cell_count,
        taper: [(); 3].map(|()| random.between(-reach, reach)),
        height: [(); 3].map(|()| random.between(0.0, top)),
        weathering,
        roughness,
        detail,
        embedding,
        ..Layer::with_defaults(id, Notation::Px)
    };
    const DRAWN: [&str; 9] =
        ["radius", "areaFraction", "cellCount", "taper", "height", "weathering", "roughness", "detail", "embedding"];
    // Parameters that are added to the table are off as often as wear is.
    for spec in PARAMS.iter().filter(|spec| spec.stage != Stage::Look && !DRAWN.contains(&spec.key)) {
        if let Scope::Item(_, set) = spec.scope {
            let value = if random.chance(0.7) { spec.range.default } else { random_value(random, spec) };
            set(&mut layer, value);
        }
    }
    layer
}

/// A value from the whole range of a parameter.
pub fn random_value(random: &mut Random, spec: &ParamSpec) -> f64 {
    let Range { min, max, .. } = spec.range;
    match spec.kind {
        Kind::Real | Kind::OptionalReal => random.between(min, max),
        Kind::Integer | Kind::OptionalInteger | Kind::Choice(_) => random.between(min, max + 1.0).floor().min(max),
    }
}
