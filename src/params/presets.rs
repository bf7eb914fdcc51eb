//! Table 1 of both papers; `tests/params.rs` compares every number with the papers' tables.

use super::{Layer, Notation, Params};

/// A named set of parameters. Everything a row does not give has the table's default.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Name in links and attributes.
    pub name: &'static str,
    /// Notation of the paper it comes from.
    pub notation: Notation,
    /// One row per layer: r, A_s, c_w1, c_w2, c_w3, c_h1, c_h2, c_h3.
    pub layers: &'static [[f64; 8]],
}

impl Preset {
    /// The parameters it stands for, seed 0.
    pub fn params(&self) -> Params {
        Params {
            seed: 0,
            image_width: 1024,
            image_height: 1024,
            packing: 0.7,
            notation: self.notation,
            darts: Default::default(),
            border: Default::default(),
            swing: Default::default(),
            layers: (0..)
                .zip(self.layers)
                .map(|(id, &[radius, area_fraction, w1, w2, w3, h1, h2, h3])| Layer {
                    id,
                    radius,
                    area_fraction,
                    cell_count: None,
                    taper: [w1, w2, w3],
                    height: [h1, h2, h3],
                })
                .collect(),
        }
    }
}

/// The preset of that name.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

macro_rules! presets {
    ($($name:literal $notation:ident $([$($value:expr),*])*;)*) => {
        /// Every preset; the first is the default.
        pub const PRESETS: &[Preset] = &[$(Preset {
            name: $name,
            notation: Notation::$notation,
            layers: &[$([$($value),*]),*],
        }),*];
    };
}

presets! {
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
