//! The presets: Table 1 of both papers, which `tests/params.rs` compares number by number, and natural grounds.

use super::super::spec::Notation;
use super::{Layer, PARAMS, Params, Scope};

/// A named set of parameters. Values that it does not give are the table's defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Name in links and attributes.
    pub name: &'static str,
    /// True for a natural ground, false for a figure of the papers, which is shown in their style.
    pub natural: bool,
    /// Notation of the layers.
    pub notation: Notation,
    /// Values of the field's parameters, by key. A choice is given as the index of its word.
    pub fields: &'static [(&'static str, f64)],
    /// The keys of the values in `layers`. A parameter of three numbers has three columns.
    pub columns: &'static [&'static str],
    /// One row per layer, with a value for every column. A choice is given as the index of its word.
    pub layers: &'static [&'static [f64]],
}

impl Preset {
    /// The parameters of this preset, with seed 0.
    pub fn params(&self) -> Params {
        let mut params = Params { notation: self.notation, ..Params::with_defaults() };
        for spec in PARAMS {
            let given = self.fields.iter().find(|(key, _)| *key == spec.key);
            if let (Scope::Field(_, set), Some(&(_, value))) = (&spec.scope, given) {
                set(&mut params, value);
            }
        }
        params.layers = (0..)
            .zip(self.layers)
            .map(|(id, row)| {
                let mut layer = Layer::with_defaults(id, self.notation);
                for (set, &value) in self.setters().zip(*row) {
                    set(&mut layer, value);
                }
                layer
            })
            .collect();
        params
    }

    /// What sets the value of each column.
    fn setters(&self) -> impl Iterator<Item = fn(&mut Layer, f64)> {
        self.columns.iter().enumerate().filter_map(|(at, key)| {
            let numbers = PARAMS.iter().filter_map(|spec| match spec.scope {
                Scope::Item(_, set) if spec.key == *key => Some(set),
                _ => None,
            });
            let part = self.columns[..at].iter().filter(|other| *other == key).count();
            numbers.into_iter().nth(part)
        })
    }
}

impl Default for Params {
    /// Fig. 1 of the journal, seed 0.
    fn default() -> Self {
        PRESETS[0].params()
    }
}

/// Returns the preset with this name.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

macro_rules! presets {
    (
        papers [$($column:ident)*] { $($name:literal $notation:ident $([$($value:expr),*])*;)* }
        natural [$($natural_column:ident)*] { $($ground:literal { $($key:ident: $given:expr),* } $([$($number:expr),*])*;)* }
    ) => {
        const PAPERS: &[&str] = &[$(stringify!($column)),*];
        const NATURAL: &[&str] = &[$(stringify!($natural_column)),*];

        /// Every preset; the first is the default.
        pub const PRESETS: &[Preset] = &[
            $(Preset {
                name: $name,
                natural: false,
                notation: Notation::$notation,
                fields: &[],
                columns: PAPERS,
                layers: &[$(&[$($value),*]),*],
            },)*
            $(Preset {
                name: $ground,
                natural: true,
                notation: Notation::Px,
                fields: &[$((stringify!($key), $given)),*],
                columns: NATURAL,
                layers: &[$(&[$($number),*]),*],
            },)*
        ];
    };
}

/// Words of choices, as the numbers that stand for them.
const MIXED: f64 = 0.0;
const GRANITE: f64 = 1.0;
const BASALT: f64 = 2.0;
const SANDSTONE: f64 = 3.0;
const LIMESTONE: f64 = 4.0;
const SLATE: f64 = 5.0;
const SOIL: f64 = 0.0;
const SAND: f64 = 1.0;
const GRAVEL: f64 = 2.0;
const DROP: f64 = 1.0;
const SEPARATE: f64 = 1.0;
const APART: f64 = 1.0;

presets! {
    papers [radius areaFraction taper taper taper height height height] {
        //                            r     A_s   c_w1  c_w2  c_w3  c_h1  c_h2  c_h3
        "journal-fig1"      Px      [90.0,  0.2,  0.0,  6.0,  6.0, 14.0, 14.0,  9.0]
                                     [30.0, 0.24,  0.0,  6.0,  2.0,  5.0,  5.0,  3.0]
                                     [10.0, 0.56,  2.0,  2.0,  2.0,  2.0,  2.0,  1.0];
        "journal-fig11a"    Px      [90.0,  0.5,  0.0,  0.0,  0.0, 45.0,  0.0,  0.0];
        "journal-fig11b"    Px      [30.0,  0.5,  0.0,  0.0,  0.0, 15.0,  0.0,  0.0];
        "journal-fig11c"    Px      [10.0,  0.5,  0.0,  0.0,  0.0,  5.0,  0.0,  0.0];
        "journal-fig12a"    Px      [90.0,  0.5,  0.0,  0.0,  0.0, 45.0,  0.0,  0.0]
                                     [30.0, 0.25,  0.0,  0.0,  0.0, 15.0,  0.0,  0.0]
                                     [10.0, 0.25,  0.0,  0.0,  0.0,  5.0,  0.0,  0.0];
        "journal-fig12b"    Px      [90.0, 0.25,  0.0,  0.0,  0.0, 45.0,  0.0,  0.0]
                                     [30.0,  0.5,  0.0,  0.0,  0.0, 15.0,  0.0,  0.0]
                                     [10.0, 0.25,  0.0,  0.0,  0.0,  5.0,  0.0,  0.0];
        "journal-fig12c"    Px      [90.0, 0.25,  0.0,  0.0,  0.0, 45.0,  0.0,  0.0]
                                     [30.0, 0.25,  0.0,  0.0,  0.0, 15.0,  0.0,  0.0]
                                     [10.0,  0.5,  0.0,  0.0,  0.0,  5.0,  0.0,  0.0];
        "journal-fig13a"    Px      [90.0,  0.5, 10.0,  0.0,  0.0, 45.0,  0.0,  0.0];
        "journal-fig13b"    Px      [90.0,  0.5,  0.0, 10.0,  0.0, 45.0,  0.0,  0.0];
        "journal-fig13c"    Px      [90.0,  0.5,  0.0,  0.0, 10.0, 45.0,  0.0,  0.0];
        "journal-fig14a"    Px      [90.0,  0.5,  0.0,  0.0,  0.0, 67.0,  0.0,  0.0];
        "journal-fig14b"    Px      [90.0,  0.5,  0.0,  0.0,  0.0,  0.0, 45.0,  0.0];
        "journal-fig14c"    Px      [90.0,  0.5,  0.0,  0.0,  0.0,  0.0,  0.0, 45.0];
        "conference-fig1"   Relative[ 9.0,  0.2,  0.0,  0.3,  0.3,  0.3,  0.3,  0.1]
                                     [ 3.0, 0.24,  0.0,  0.3,  0.1,  0.3,  0.3,  0.1]
                                     [ 1.0, 0.56,  0.1,  0.1,  0.1,  0.3,  0.0,  0.1];
        "conference-fig9a"  Relative[ 9.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1];
        "conference-fig9b"  Relative[ 3.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1];
        "conference-fig9c"  Relative[ 1.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1];
        "conference-fig10a" Relative[ 9.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1]
                                     [ 3.0, 0.25,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1]
                                     [ 1.0, 0.25,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1];
        "conference-fig10b" Relative[ 9.0, 0.25,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1]
                                     [ 3.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1]
                                     [ 1.0, 0.25,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1];
        "conference-fig10c" Relative[ 9.0, 0.25,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1]
                                     [ 3.0, 0.25,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1]
                                     [ 1.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.0,  0.1];
        "conference-fig11a" Relative[ 9.0,  0.5,  0.4,  0.0,  0.0,  0.3,  0.0,  0.0];
        "conference-fig11b" Relative[ 9.0,  0.5, -0.4,  0.0,  0.0,  0.3,  0.0,  0.0];
        "conference-fig11c" Relative[ 9.0,  0.5,  0.2,  0.4,  0.0,  0.3,  0.0,  0.0];
        "conference-fig11d" Relative[ 9.0,  0.5,  0.0,  0.0,  0.0,  1.0,  0.0,  0.0];
        "conference-fig11e" Relative[ 9.0,  0.5,  0.0,  0.0,  0.0,  0.1,  0.0,  0.0];
        "conference-fig11f" Relative[ 9.0,  0.5,  0.0,  0.0,  0.0,  0.3,  0.7,  0.0];
    }
    natural [
        radius areaFraction taper taper taper height height height weathering roughness detail embedding material
    ] {
        //                                                             r     A_s   c_w1  c_w2  c_w3  c_h1  c_h2  c_h3   we    ro   de   em
        "riverbed" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.45, dust: 0.3, moss: 0.3, sunAzimuth: 245.0, sunElevation: 42.0 }
            [22.0, 0.03, 0.44, 1.76, 1.1, 7.48, 5.28, 2.64, 0.95, 0.35, 133.0, 0.25, MIXED]
            [15.0, 0.1, 0.3, 1.2, 0.75, 5.1, 3.6, 1.8, 0.9, 0.35, 87.0, 0.25, MIXED]
            [10.5, 0.24, 0.21, 0.84, 0.53, 3.57, 2.52, 1.26, 0.85, 0.35, 55.0, 0.25, MIXED]
            [7.2, 0.36, 0.14, 0.58, 0.36, 2.45, 1.73, 0.86, 0.8, 0.35, 48.0, 0.25, MIXED]
            [5.0, 0.4, 0.1, 0.4, 0.25, 1.7, 1.2, 0.6, 0.75, 0.3, 45.0, 0.2, MIXED]
            [3.4, 0.4, 0.07, 0.27, 0.17, 1.16, 0.82, 0.41, 0.7, 0.2, 64.0, 0.2, MIXED]
            [2.4, 0.4, 0.05, 0.19, 0.12, 0.82, 0.58, 0.29, 0.6, 0.0, 0.0, 0.15, MIXED];
        "beach-cobbles" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: SAND, variation: 0.55, wetness: 0.3, dust: 0.05, sunAzimuth: 240.0, sunElevation: 34.0 }
            [60.0, 0.1, 1.2, 3.6, 2.4, 21.6, 12.0, 4.8, 1.0, 0.15, 46.0, 0.3, MIXED]
            [38.0, 0.28, 0.76, 2.28, 1.52, 13.68, 7.6, 3.04, 1.0, 0.15, 34.0, 0.25, MIXED]
            [24.0, 0.4, 0.48, 1.44, 0.96, 8.64, 4.8, 1.92, 1.0, 0.15, 35.0, 0.2, MIXED]
            [15.0, 0.5, 0.3, 0.9, 0.6, 5.4, 3.0, 1.2, 1.0, 0.15, 40.0, 0.2, MIXED]
            [9.0, 0.5, 0.18, 0.54, 0.36, 3.24, 1.8, 0.72, 0.95, 0.1, 50.0, 0.2, MIXED]
            [5.5, 0.5, 0.11, 0.33, 0.22, 1.98, 1.1, 0.44, 0.9, 0.1, 70.0, 0.2, MIXED]
            [3.6, 0.5, 0.07, 0.22, 0.14, 1.3, 0.72, 0.29, 0.8, 0.0, 90.0, 0.2, MIXED]
            [2.4, 0.5, 0.05, 0.14, 0.1, 0.86, 0.48, 0.19, 0.8, 0.0, 60.0, 0.2, MIXED];
        "scree" { imageWidth: 720.0, imageHeight: 720.0, border: DROP, swing: SEPARATE, crossing: APART, ground: GRAVEL, variation: 0.3, dust: 0.1, sunAzimuth: 235.0, sunElevation: 38.0 }
            [80.0, 0.08, 3.2, 8.0, 4.8, 24.0, 33.6, 12.8, 0.24, 0.45, 36.0, 0.2, LIMESTONE]
            [48.0, 0.22, 1.92, 4.8, 2.88, 14.4, 20.16, 7.68, 0.24, 0.4, 27.0, 0.2, LIMESTONE]
            [28.0, 0.35, 1.12, 2.8, 1.68, 8.4, 11.76, 4.48, 0.25, 0.4, 25.0, 0.2, LIMESTONE]
            [17.0, 0.4, 0.68, 1.7, 1.02, 5.1, 7.14, 2.72, 0.25, 0.3, 27.0, 0.2, LIMESTONE]
            [10.0, 0.4, 0.4, 1.0, 0.6, 3.0, 4.2, 1.6, 0.25, 0.3, 23.0, 0.15, LIMESTONE]
            [6.0, 0.4, 0.24, 0.6, 0.36, 1.8, 2.52, 0.96, 0.25, 0.2, 30.0, 0.15, LIMESTONE]
            [3.6, 0.3, 0.14, 0.36, 0.22, 1.08, 1.51, 0.58, 0.22, 0.0, 0.0, 0.1, LIMESTONE];
        "moraine" { imageWidth: 800.0, imageHeight: 800.0, border: DROP, swing: SEPARATE, ground: SOIL, variation: 0.5, dust: 0.3, moss: 0.25, sunAzimuth: 250.0, sunElevation: 32.0 }
            [120.0, 0.08, 0.0, 6.0, 4.8, 33.6, 38.4, 14.4, 0.5, 0.5, 34.0, 0.25, GRANITE]
            [70.0, 0.1, 0.0, 3.5, 2.8, 19.6, 22.4, 8.4, 0.55, 0.5, 38.0, 0.3, GRANITE]
            [40.0, 0.14, 0.0, 2.0, 1.6, 11.2, 12.8, 4.8, 0.6, 0.5, 36.0, 0.3, GRANITE]
            [24.0, 0.18, 0.0, 1.2, 0.96, 6.72, 7.68, 2.88, 0.65, 0.4, 25.0, 0.3, GRANITE]
            [13.0, 0.25, 0.0, 0.65, 0.52, 3.64, 4.16, 1.56, 0.7, 0.3, 19.0, 0.3, GRANITE]
            [7.0, 0.3, 0.0, 0.35, 0.28, 1.96, 2.24, 0.84, 0.7, 0.2, 27.0, 0.3, GRANITE]
            [4.0, 0.3, 0.0, 0.2, 0.16, 1.12, 1.28, 0.48, 0.7, 0.1, 38.0, 0.3, GRANITE];
        "desert-pavement" { imageWidth: 560.0, imageHeight: 560.0, border: DROP, swing: SEPARATE, crossing: APART, ground: SAND, variation: 0.6, dust: 0.3, sunAzimuth: 255.0, sunElevation: 27.0 }
            [44.0, 0.03, 0.0, 2.2, 1.76, 9.68, 9.68, 4.4, 0.4, 0.4, 70.0, 0.35, SANDSTONE]
            [24.0, 0.08, 0.0, 1.2, 0.96, 5.28, 5.28, 2.4, 0.45, 0.4, 65.0, 0.35, SANDSTONE]
            [14.0, 0.24, 0.0, 0.7, 0.56, 3.08, 3.08, 1.4, 0.45, 0.35, 44.0, 0.35, SANDSTONE]
            [8.5, 0.4, 0.0, 0.43, 0.34, 1.87, 1.87, 0.85, 0.5, 0.3, 34.0, 0.3, SANDSTONE]
            [5.0, 0.4, 0.0, 0.25, 0.2, 1.1, 1.1, 0.5, 0.5, 0.2, 47.0, 0.3, SANDSTONE]
            [3.2, 0.4, 0.0, 0.16, 0.13, 0.7, 0.7, 0.32, 0.5, 0.1, 52.0, 0.25, SANDSTONE]
            [2.2, 0.4, 0.0, 0.11, 0.09, 0.48, 0.48, 0.22, 0.5, 0.0, 0.0, 0.2, SANDSTONE];
        "lava-field" { imageWidth: 800.0, imageHeight: 800.0, border: DROP, swing: SEPARATE, crossing: APART, ground: GRAVEL, variation: 0.35, dust: 0.0, sunAzimuth: 300.0, sunElevation: 36.0 }
            [110.0, 0.2, 6.6, 15.4, 11.0, 26.4, 46.2, 24.2, 0.26, 1.0, 27.0, 0.2, BASALT]
            [66.0, 0.26, 3.96, 9.24, 6.6, 15.84, 27.72, 14.52, 0.26, 1.0, 21.0, 0.2, BASALT]
            [40.0, 0.34, 2.4, 5.6, 4.0, 9.6, 16.8, 8.8, 0.26, 1.0, 26.0, 0.2, BASALT]
            [24.0, 0.4, 1.44, 3.36, 2.4, 5.76, 10.08, 5.28, 0.26, 1.0, 28.0, 0.2, BASALT]
            [14.0, 0.45, 0.84, 1.96, 1.4, 3.36, 5.88, 3.08, 0.26, 0.9, 32.0, 0.15, BASALT]
            [8.0, 0.45, 0.48, 1.12, 0.8, 1.92, 3.36, 1.76, 0.26, 0.7, 29.0, 0.15, BASALT]
            [5.0, 0.45, 0.3, 0.7, 0.5, 1.2, 2.1, 1.1, 0.26, 0.5, 33.0, 0.15, BASALT]
            [3.2, 0.4, 0.19, 0.45, 0.32, 0.77, 1.34, 0.7, 0.26, 0.2, 46.0, 0.1, BASALT];
        "dry-garden" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.3, moss: 0.4, dust: 0.05, sunAzimuth: 250.0, sunElevation: 36.0 }
            [120.0, 0.09, 0.0, 6.0, 4.8, 36.0, 72.0, 24.0, 0.45, 0.6, 32.0, 0.25, SLATE]
            [60.0, 0.03, 0.0, 3.0, 2.4, 18.0, 24.0, 9.0, 0.5, 0.5, 45.0, 0.3, SLATE]
            [6.0, 0.3, 0.0, 0.3, 0.24, 1.68, 1.92, 0.72, 0.9, 0.1, 45.0, 0.2, LIMESTONE]
            [4.4, 0.6, 0.0, 0.22, 0.18, 1.5, 0.88, 0.44, 0.9, 0.1, 45.0, 0.2, LIMESTONE]
            [3.2, 0.6, 0.0, 0.16, 0.13, 1.09, 0.64, 0.32, 0.9, 0.0, 62.0, 0.2, LIMESTONE];
        "forest-floor" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: SOIL, variation: 0.4, wetness: 0.25, moss: 0.62, dust: 0.3, sunAzimuth: 250.0, sunElevation: 40.0 }
            [110.0, 0.1, 0.0, 5.5, 4.4, 30.8, 35.2, 13.2, 0.6, 0.5, 34.0, 0.3, GRANITE]
            [60.0, 0.1, 0.0, 3.0, 2.4, 16.8, 19.2, 7.2, 0.65, 0.5, 38.0, 0.35, GRANITE]
            [34.0, 0.12, 0.0, 1.7, 1.36, 9.52, 10.88, 4.08, 0.7, 0.45, 36.0, 0.35, GRANITE]
            [18.0, 0.12, 0.0, 0.9, 0.72, 5.04, 5.76, 2.16, 0.7, 0.4, 30.0, 0.35, GRANITE]
            [9.0, 0.15, 0.0, 0.45, 0.36, 2.52, 2.88, 1.08, 0.75, 0.2, 27.0, 0.3, GRANITE]
            [5.0, 0.15, 0.0, 0.25, 0.2, 1.4, 1.6, 0.6, 0.75, 0.2, 35.0, 0.3, GRANITE];
        "quarry-rubble" { imageWidth: 480.0, imageHeight: 480.0, border: DROP, swing: SEPARATE, crossing: APART, ground: GRAVEL, variation: 0.35, dust: 0.1, sunAzimuth: 240.0, sunElevation: 56.0 }
            [14.0, 0.3, 2.24, 2.8, 1.12, 4.9, 8.4, 4.2, 0.22, 0.25, 78.0, 0.05, GRANITE]
            [11.5, 0.7, 1.84, 2.3, 0.92, 4.02, 6.9, 3.45, 0.22, 0.25, 72.0, 0.05, GRANITE]
            [8.5, 0.5, 1.36, 1.7, 0.68, 2.97, 5.1, 2.55, 0.22, 0.25, 59.0, 0.05, GRANITE]
            [6.0, 0.4, 0.96, 1.2, 0.48, 2.1, 3.6, 1.8, 0.22, 0.2, 55.0, 0.05, GRANITE]
            [4.4, 0.4, 0.7, 0.88, 0.35, 1.54, 2.64, 1.32, 0.22, 0.15, 44.0, 0.05, GRANITE]
            [3.0, 0.4, 0.48, 0.6, 0.24, 1.05, 1.8, 0.9, 0.22, 0.0, 53.0, 0.05, GRANITE];
        "first-snow" { imageWidth: 720.0, imageHeight: 720.0, border: DROP, swing: SEPARATE, ground: SOIL, variation: 0.4, moss: 0.2, dust: 0.05, snow: 0.45, sunAzimuth: 285.0, sunElevation: 16.0 }
            [110.0, 0.07, 0.0, 5.5, 4.4, 30.8, 35.2, 13.2, 0.5, 0.5, 36.0, 0.3, GRANITE]
            [64.0, 0.1, 0.0, 3.2, 2.56, 17.9, 20.5, 7.7, 0.55, 0.5, 40.0, 0.3, GRANITE]
            [36.0, 0.14, 0.0, 1.8, 1.44, 10.1, 11.5, 4.3, 0.6, 0.45, 38.0, 0.3, GRANITE]
            [20.0, 0.16, 0.0, 1.0, 0.8, 5.6, 6.4, 2.4, 0.65, 0.4, 34.0, 0.3, GRANITE]
            [11.0, 0.2, 0.0, 0.55, 0.44, 3.08, 3.52, 1.32, 0.7, 0.3, 38.0, 0.3, GRANITE]
            [6.0, 0.2, 0.0, 0.3, 0.24, 1.68, 1.92, 0.72, 0.7, 0.2, 40.0, 0.25, GRANITE];
        "mountain-stream" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.5, wetness: 0.2, moss: 0.25, dust: 0.05, water: 0.42, sunAzimuth: 300.0, sunElevation: 44.0 }
            [84.0, 0.07, 0.84, 4.2, 3.4, 23.5, 21.8, 8.4, 0.75, 0.4, 44.0, 0.25, MIXED]
            [50.0, 0.1, 0.5, 2.5, 2.0, 14.0, 13.0, 5.0, 0.8, 0.4, 44.0, 0.25, MIXED]
            [30.0, 0.16, 0.3, 1.5, 1.2, 8.4, 7.8, 3.0, 0.85, 0.35, 44.0, 0.25, MIXED]
            [18.0, 0.25, 0.18, 0.9, 0.72, 5.4, 4.3, 1.8, 0.85, 0.35, 46.0, 0.25, MIXED]
            [11.0, 0.32, 0.11, 0.55, 0.44, 3.3, 2.6, 1.1, 0.85, 0.35, 55.0, 0.25, MIXED]
            [7.0, 0.38, 0.07, 0.35, 0.28, 2.1, 1.6, 0.7, 0.85, 0.3, 48.0, 0.2, MIXED]
            [4.4, 0.4, 0.04, 0.22, 0.18, 1.3, 1.0, 0.44, 0.8, 0.2, 50.0, 0.2, MIXED];
        "shingle" { imageWidth: 480.0, imageHeight: 480.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.6, wetness: 0.15, dust: 0.05, sunAzimuth: 235.0, sunElevation: 36.0 }
            [20.0, 0.08, 1.0, 2.0, 0.8, 6.4, 4.8, 1.6, 1.0, 0.1, 67.0, 0.15, MIXED]
            [14.0, 0.3, 0.7, 1.4, 0.56, 4.48, 3.36, 1.12, 1.0, 0.1, 46.0, 0.15, MIXED]
            [10.0, 0.45, 0.5, 1.0, 0.4, 3.2, 2.4, 0.8, 1.0, 0.1, 45.0, 0.15, MIXED]
            [7.0, 0.45, 0.35, 0.7, 0.28, 2.24, 1.68, 0.56, 0.95, 0.1, 39.0, 0.15, MIXED]
            [5.0, 0.4, 0.25, 0.5, 0.2, 1.6, 1.2, 0.4, 0.95, 0.05, 49.0, 0.15, MIXED]
            [3.4, 0.4, 0.17, 0.34, 0.14, 1.09, 0.82, 0.27, 0.9, 0.0, 56.0, 0.15, MIXED]
            [2.4, 0.4, 0.12, 0.24, 0.1, 0.77, 0.58, 0.19, 0.8, 0.0, 0.0, 0.15, MIXED];
    }
}
