//! The journal presets behave like the reference implementation: means over seeds 0–9 against `data/stats-journal.md`.
//!
//! The mean of ten of our own seeds may differ from that of the reference's ten by 5·√(1/10 + 1/10) of the standard deviation
//! between seeds, or by one unit of the last digit printed.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use std::collections::BTreeMap;
use std::fmt::Write;

use common::{field_test, link};
use glam::{DVec2, Vec3};
use rock_field::params::{PRESETS, Params, Preset};
use rock_field::rocks::{Field, FieldLayer, generate};

const SEEDS: u32 = 10;

const TABLES: &str = include_str!("data/stats-journal.md");

/// What one seed measures: (layer, or none for the whole field; column) → value.
type Measures = BTreeMap<(Option<usize>, &'static str), f64>;

field_test! {
    fn means_over_ten_seeds_agree_with_the_reference() {
        let mut report = String::new();
        let mut failures = 0;
        for preset in PRESETS.iter().filter(|preset| preset.name.starts_with("journal-")) {
            let means = means(preset);
            for (table, row) in rows_of(preset) {
                for (column, printed) in &row.cells {
                    let Some(ours) = means.get(&(row.layer, column.as_str())) else { continue };
                    let expected = Expected::parse(printed);
                    let ok = (ours - expected.mean).abs() <= expected.allowed;
                    failures += u32::from(!ok);
                    let verdict = if ok { "" } else { "  <-- FAIL" };
                    let r = row.layer.map_or(String::new(), |k| format!("r {}", preset.layers[k][0]));
                    writeln!(
                        report,
                        "{:<15} {r:<5} {table:<10} {column:<24} {ours:>12.4}  {printed:<18} ± {:.4}{verdict}",
                        preset.name, expected.allowed
                    )
                    .unwrap();
                }
            }
        }
        // Ten columns of three diagrams, six of the field, and so on: the tables were found and read.
        assert!(report.lines().count() > 400, "only {} comparisons", report.lines().count());
        assert_eq!(failures, 0, "of {} comparisons\n{report}", report.lines().count());
    }
}

struct Expected {
    mean: f64,
    allowed: f64,
}

impl Expected {
    /// `10416.6 ± 208.1`, `0.5001`, or `7/10`, which has to be met.
    fn parse(printed: &str) -> Self {
        if let Some((count, _)) = printed.split_once('/') {
            return Expected { mean: count.parse::<f64>().unwrap() / f64::from(SEEDS), allowed: 1.0e-9 };
        }
        let (mean, std) = printed.split_once(" ± ").unwrap_or((printed, "0"));
        let digits = mean.split_once('.').map_or(0, |(_, fraction)| fraction.len());
        let unit = 10_f64.powi(-(digits as i32));
        let spread = 5.0 * (2.0 / f64::from(SEEDS)).sqrt() * std.parse::<f64>().unwrap();
        // A hair more than one unit: 0.2064 + 0.0001 is not 0.2065 in binary.
        Expected { mean: mean.parse().unwrap(), allowed: spread.max(unit * (1.0 + 1.0e-6)) }
    }
}

struct Row {
    layer: Option<usize>,
    cells: Vec<(String, String)>,
}

/// The rows that speak of a preset, with the name of their table.
fn rows_of(preset: &Preset) -> Vec<(&'static str, Row)> {
    let name = preset.name.trim_start_matches("journal-");
    let mut rows = Vec::new();
    for (title, table) in
        [("Diagrams", "Diagrams"), ("Selection", "Selection"), ("Totals", "Totals"), ("Heights", "Per-diagram")]
    {
        let section = TABLES.split("\n## ").find(|section| section.starts_with(table)).unwrap();
        let mut lines = section.lines().filter(|line| line.starts_with('|')).map(cells);
        let header = lines.next().unwrap();
        for row in lines.skip(1) {
            // Presets with the same radii share their diagrams, which are listed under Fig. 1.
            if row[0] != name && table != "Diagrams" {
                continue;
            }
            let cells: Vec<_> = header.iter().cloned().zip(row.iter().cloned()).collect();
            let radius = cells.iter().find(|(column, _)| ["r", "r px", "diagram r px"].contains(&column.as_str()));
            let layer = match radius {
                None => None,
                Some((_, r)) => match preset.layers.iter().position(|layer| layer[0].to_string() == *r) {
                    Some(k) => Some(k),
                    None => continue,
                },
            };
            rows.push((title, Row { layer, cells }));
        }
    }
    rows
}

fn cells(line: &str) -> Vec<String> {
    line.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect()
}

fn means(preset: &Preset) -> Measures {
    let mut means = Measures::new();
    for seed in 0..SEEDS {
        let params = Params { seed, ..preset.params() };
        let field = generate(&params).unwrap_or_else(|error| panic!("{error}\n  {}", link(&params)));
        for (key, value) in measure(&field) {
            *means.entry(key).or_default() += value / f64::from(SEEDS);
        }
    }
    means
}

fn measure(field: &Field) -> Measures {
    let mut all = Measures::new();
    let mut tops = Vec::new();
    let mut rock = 0;
    for (k, layer) in field.layers.iter().enumerate() {
        let mut add = |column, value| all.insert((Some(k), column), value);
        let Diagram { areas, interior, vertices, interior_vertices } = diagram(layer);
        let image = f64::from(layer.sites.width) * f64::from(layer.sites.height);
        let count = areas.values.len() as f64;
        let half = 0.5 * layer.sites.radius;
        add("N_p", layer.sites.target as f64);
        add("sites = cells", count);
        add("coverage", count * core::f64::consts::PI * half * half / image);
        add("cell area mean", areas.mean());
        add("cell area std", areas.std());
        add("mean (interior)", interior.mean());
        add("CV (interior)", interior.std() / interior.mean());
        add("verts/cell", vertices.mean());
        add("verts/cell (interior)", interior_vertices.mean());

        add("reached area fraction", layer.area_reached());
        add("seeds that reached A_s", f64::from(!layer.selection.saturated));
        add("rocks selected", layer.selection.selected.len() as f64);

        let (mut heights, mut steps) = (Sample::default(), Sample::default());
        let (mut before, mut after) = (Sample::default(), Sample::default());
        for place in 0..layer.shapes.len() {
            let top = layer.shapes.top_of(place);
            let centre = top.iter().sum::<DVec2>() / top.len() as f64;
            let first = field.mesh.vertex_starts[rock] as usize + top.len();
            for (v, p_add) in (first..).zip(top) {
                let moved = Vec3::from_slice(&field.mesh.positions[3 * v..3 * v + 3]).as_dvec3();
                heights.values.push(moved.z);
                steps.values.push(moved.truncate().distance(*p_add));
                before.values.push(p_add.distance(centre));
                after.values.push(moved.truncate().distance(centre));
            }
            rock += 1;
        }
        add("z min", heights.min());
        add("z mean", heights.mean());
        add("z max", heights.max());
        add("z std", heights.std());
        add("step min", steps.min());
        add("step mean", steps.mean());
        add("step max", steps.max());
        add("top radius before", before.mean());
        add("after", after.mean());
        add("triangles", layer.shapes.triangles() as f64);
        tops.append(&mut heights.values);
    }
    let tops = Sample { values: tops };
    let mut add = |column, value| all.insert((None, column), value);
    add("rocks", field.mesh.rocks() as f64);
    add("covered fraction", field.covered_fraction());
    add("triangles", field.mesh.triangles() as f64);
    add("height min", tops.min());
    add("height mean", tops.mean());
    add("height max", tops.max());
    all
}

struct Diagram {
    areas: Sample,
    interior: Sample,
    vertices: Sample,
    interior_vertices: Sample,
}

fn diagram(layer: &FieldLayer) -> Diagram {
    let [mut areas, mut interior, mut vertices, mut interior_vertices] = [(); 4].map(|()| Sample::default());
    for i in 0..layer.cells.len() {
        let polygon = layer.cells.polygon(i);
        let origin = polygon[0];
        let area: f64 = polygon.windows(2).map(|side| 0.5 * (side[0] - origin).perp_dot(side[1] - origin)).sum();
        areas.values.push(area);
        vertices.values.push(polygon.len() as f64);
        if !layer.cells.touches_border(i) {
            interior.values.push(area);
            interior_vertices.values.push(polygon.len() as f64);
        }
    }
    Diagram { areas, interior, vertices, interior_vertices }
}

#[derive(Default)]
struct Sample {
    values: Vec<f64>,
}

impl Sample {
    fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    fn std(&self) -> f64 {
        let mean = self.mean();
        (self.values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / self.values.len() as f64).sqrt()
    }

    fn min(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn max(&self) -> f64 {
        self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}
