//! The presets: Table 1 of both papers, number by number compared with it in `tests/params.rs`, and natural grounds.

use super::{Layer, Notation, PARAMS, Params, Scope};

/// A named set of parameters. Everything it does not give has the table's default.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Name in links and attributes.
    pub name: &'static str,
    /// Of the papers, shown as they show it; or a ground as it is found.
    pub natural: bool,
    /// Notation of the layers.
    pub notation: Notation,
    /// Values of the field's parameters by key; a choice is the index of its word.
    pub fields: &'static [(&'static str, f64)],
    /// One row per layer, in the order of the table without the count: r, A_s, c_w1, c_w2, c_w3, c_h1, c_h2, c_h3, and for
    /// natural grounds weathering, roughness, detail, embedding, material.
    pub layers: &'static [&'static [f64]],
}

impl Preset {
    /// The parameters it stands for, seed 0.
    pub fn params(&self) -> Params {
        let mut params = Params { notation: self.notation, ..Params::with_defaults() };
        for spec in PARAMS {
            let given = self.fields.iter().find(|(key, _)| *key == spec.key);
            if let (Scope::Field(_, set), Some(&(_, value))) = (spec.scope, given) {
                set(&mut params, value);
            }
        }
        let columns = PARAMS.iter().filter(|spec| spec.is_column());
        params.layers = (0..)
            .zip(self.layers)
            .map(|(id, row)| {
                let mut layer = Layer::with_defaults(id, self.notation);
                for (spec, &value) in columns.clone().zip(*row) {
                    if let Scope::Layer(_, set) = spec.scope {
                        set(&mut layer, value);
                    }
                }
                layer
            })
            .collect();
        params
    }
}

impl Default for Params {
    /// Fig. 1 of the journal, seed 0.
    fn default() -> Self {
        PRESETS[0].params()
    }
}

/// The preset of that name.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

macro_rules! presets {
    (
        papers { $($name:literal $notation:ident $([$($value:expr),*])*;)* }
        natural { $($ground:literal { $($key:ident: $given:expr),* } $([$($number:expr),*])*;)* }
    ) => {
        /// Every preset; the first is the default.
        pub const PRESETS: &[Preset] = &[
            $(Preset {
                name: $name,
                natural: false,
                notation: Notation::$notation,
                fields: &[],
                layers: &[$(&[$($value),*]),*],
            },)*
            $(Preset {
                name: $ground,
                natural: true,
                notation: Notation::Px,
                fields: &[$((stringify!($key), $given)),*],
                layers: &[$(&[$($number),*]),*],
            },)*
        ];
    };
}

/// Words of choices, as the numbers they travel as.
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

presets! {
    papers {
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
    // weathering, roughness, detail, embedding, material
    natural {
        //                                                             r     A_s   c_w1  c_w2  c_w3  c_h1  c_h2  c_h3   we    ro   de   em
        "riverbed" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.6, dust: 0.25, moss: 0.15, sunAzimuth: 240.0, sunElevation: 48.0 }
            [34.0, 0.05, 0.68, 2.04, 1.36, 10.20, 7.48, 3.40, 1.0, 0.35, 3.0, 0.2, MIXED]
            [20.0, 0.16, 0.40, 1.20, 0.80, 6.00, 4.40, 2.00, 1.0, 0.35, 2.0, 0.2, MIXED]
            [13.0, 0.30, 0.26, 0.78, 0.52, 3.90, 2.86, 1.30, 1.0, 0.35, 2.0, 0.2, MIXED]
            [8.0, 0.50, 0.16, 0.48, 0.32, 2.40, 1.76, 0.80, 1.0, 0.35, 1.0, 0.2, MIXED]
            [5.0, 0.50, 0.10, 0.30, 0.20, 1.50, 1.10, 0.50, 1.0, 0.35, 1.0, 0.2, MIXED];
        "beach-cobbles" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: SAND, variation: 0.6, wetness: 0.3, dust: 0.1, sunAzimuth: 240.0, sunElevation: 40.0 }
            [46.0, 0.20, 0.92, 2.76, 1.84, 13.80, 10.12, 4.60, 1.0, 0.2, 3.0, 0.2, MIXED]
            [28.0, 0.40, 0.56, 1.68, 1.12, 8.40, 6.16, 2.80, 1.0, 0.2, 2.0, 0.2, MIXED]
            [16.0, 0.50, 0.32, 0.96, 0.64, 4.80, 3.52, 1.60, 1.0, 0.2, 2.0, 0.2, MIXED]
            [9.0, 0.50, 0.18, 0.54, 0.36, 2.70, 1.98, 0.90, 1.0, 0.2, 1.0, 0.2, MIXED];
        "scree" { imageWidth: 768.0, imageHeight: 768.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.35, dust: 0.1, sunAzimuth: 230.0, sunElevation: 38.0 }
            [70.0, 0.10, 1.40, 4.20, 2.80, 21.00, 15.40, 7.00, 0.3, 0.4, 3.0, 0.2, LIMESTONE]
            [42.0, 0.25, 0.84, 2.52, 1.68, 12.60, 9.24, 4.20, 0.3, 0.4, 3.0, 0.2, LIMESTONE]
            [24.0, 0.40, 0.48, 1.44, 0.96, 7.20, 5.28, 2.40, 0.3, 0.4, 2.0, 0.2, LIMESTONE]
            [13.0, 0.50, 0.26, 0.78, 0.52, 3.90, 2.86, 1.30, 0.3, 0.4, 2.0, 0.2, LIMESTONE]
            [8.0, 0.50, 0.16, 0.48, 0.32, 2.40, 1.76, 0.80, 0.3, 0.4, 1.0, 0.2, LIMESTONE];
        "moraine" { imageWidth: 900.0, imageHeight: 900.0, border: DROP, swing: SEPARATE, ground: SOIL, variation: 0.5, dust: 0.35, moss: 0.25, sunAzimuth: 250.0, sunElevation: 32.0 }
            [150.0, 0.08, 3.00, 9.00, 6.00, 45.00, 33.00, 15.00, 0.6, 0.5, 3.0, 0.2, GRANITE]
            [60.0, 0.10, 1.20, 3.60, 2.40, 18.00, 13.20, 6.00, 0.6, 0.5, 3.0, 0.2, GRANITE]
            [30.0, 0.14, 0.60, 1.80, 1.20, 9.00, 6.60, 3.00, 0.6, 0.5, 3.0, 0.2, GRANITE]
            [16.0, 0.20, 0.32, 0.96, 0.64, 4.80, 3.52, 1.60, 0.6, 0.5, 2.0, 0.2, GRANITE]
            [9.0, 0.25, 0.18, 0.54, 0.36, 2.70, 1.98, 0.90, 0.6, 0.5, 1.0, 0.2, GRANITE];
        "desert-pavement" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: SAND, variation: 0.5, dust: 0.5, sunAzimuth: 260.0, sunElevation: 28.0 }
            [40.0, 0.03, 0.80, 2.40, 1.60, 12.00, 8.80, 4.00, 0.5, 0.4, 3.0, 0.2, SANDSTONE]
            [22.0, 0.10, 0.44, 1.32, 0.88, 6.60, 4.84, 2.20, 0.5, 0.4, 2.0, 0.2, SANDSTONE]
            [13.0, 0.25, 0.26, 0.78, 0.52, 3.90, 2.86, 1.30, 0.5, 0.4, 2.0, 0.2, SANDSTONE]
            [8.0, 0.40, 0.16, 0.48, 0.32, 2.40, 1.76, 0.80, 0.5, 0.4, 1.0, 0.2, SANDSTONE];
        "lava-field" { imageWidth: 900.0, imageHeight: 900.0, border: DROP, swing: SEPARATE, ground: SOIL, variation: 0.3, dust: 0.05, sunAzimuth: 235.0, sunElevation: 30.0 }
            [120.0, 0.25, 2.40, 7.20, 4.80, 36.00, 26.40, 12.00, 0.35, 1.0, 3.0, 0.2, BASALT]
            [70.0, 0.30, 1.40, 4.20, 2.80, 21.00, 15.40, 7.00, 0.35, 1.0, 3.0, 0.2, BASALT]
            [36.0, 0.35, 0.72, 2.16, 1.44, 10.80, 7.92, 3.60, 0.35, 1.0, 3.0, 0.2, BASALT]
            [18.0, 0.40, 0.36, 1.08, 0.72, 5.40, 3.96, 1.80, 0.35, 1.0, 2.0, 0.2, BASALT]
            [10.0, 0.40, 0.20, 0.60, 0.40, 3.00, 2.20, 1.00, 0.35, 1.0, 1.0, 0.2, BASALT];
        "dry-garden" { imageWidth: 900.0, imageHeight: 900.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.4, moss: 0.4, dust: 0.1, sunAzimuth: 250.0, sunElevation: 35.0 }
            [170.0, 0.08, 3.40, 10.20, 6.80, 51.00, 37.40, 17.00, 0.6, 0.5, 3.0, 0.2, SLATE]
            [80.0, 0.03, 1.60, 4.80, 3.20, 24.00, 17.60, 8.00, 0.6, 0.5, 3.0, 0.2, SLATE];
        "forest-floor" { imageWidth: 768.0, imageHeight: 768.0, border: DROP, swing: SEPARATE, ground: SOIL, variation: 0.4, wetness: 0.2, moss: 0.8, dust: 0.3, sunAzimuth: 250.0, sunElevation: 42.0 }
            [110.0, 0.12, 2.20, 6.60, 4.40, 33.00, 24.20, 11.00, 0.7, 0.5, 3.0, 0.2, GRANITE]
            [50.0, 0.12, 1.00, 3.00, 2.00, 15.00, 11.00, 5.00, 0.7, 0.5, 3.0, 0.2, GRANITE]
            [24.0, 0.12, 0.48, 1.44, 0.96, 7.20, 5.28, 2.40, 0.7, 0.5, 2.0, 0.2, GRANITE]
            [12.0, 0.12, 0.24, 0.72, 0.48, 3.60, 2.64, 1.20, 0.7, 0.5, 2.0, 0.2, GRANITE];
        "quarry-rubble" { imageWidth: 640.0, imageHeight: 640.0, border: DROP, swing: SEPARATE, ground: GRAVEL, variation: 0.3, dust: 0.15, sunAzimuth: 240.0, sunElevation: 55.0 }
            [26.0, 0.70, 0.52, 1.56, 1.04, 7.80, 5.72, 2.60, 0.22, 0.3, 2.0, 0.2, GRANITE]
            [18.0, 0.50, 0.36, 1.08, 0.72, 5.40, 3.96, 1.80, 0.22, 0.3, 2.0, 0.2, GRANITE]
            [10.0, 0.50, 0.20, 0.60, 0.40, 3.00, 2.20, 1.00, 0.22, 0.3, 1.0, 0.2, GRANITE]
            [6.0, 0.50, 0.12, 0.36, 0.24, 1.80, 1.32, 0.60, 0.22, 0.3, 1.0, 0.2, GRANITE];
        "shingle" { imageWidth: 512.0, imageHeight: 512.0, border: DROP, swing: SEPARATE, ground: SAND, variation: 0.7, wetness: 0.15, sunAzimuth: 235.0, sunElevation: 36.0 }
            [18.0, 0.20, 0.36, 1.08, 0.72, 5.40, 3.96, 1.80, 0.95, 0.15, 2.0, 0.2, MIXED]
            [12.0, 0.50, 0.24, 0.72, 0.48, 3.60, 2.64, 1.20, 0.95, 0.15, 2.0, 0.2, MIXED]
            [8.0, 0.50, 0.16, 0.48, 0.32, 2.40, 1.76, 0.80, 0.95, 0.15, 1.0, 0.2, MIXED]
            [5.0, 0.50, 0.10, 0.30, 0.20, 1.50, 1.10, 0.50, 0.95, 0.15, 1.0, 0.2, MIXED];
    }
}
