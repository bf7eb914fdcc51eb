//! The presets: the scenes of the thesis, and natural colonies.
//!
//! The thesis gives density, range, size and spread of Figs 3.7, 4.2 and 4.3, the moisture of Figs 4.4 and 4.5, the
//! wrinkles of Figs 4.6 and 4.7, and the sliders of Table 4.3, and nothing else; `tests/data/thesis-figures.json` holds
//! what it prints. The rest is our choice. Sliders that it does not name have the table's defaults, but a figure that
//! shows one stage leaves out all later stages (moisture 100, wrinkles 0, no collisions), and a figure that shows one
//! effect leaves out the other. Figs 4.8 and 4.9, a pair before and after its collision, are two undeformed bowls of
//! the default size. Figs 4.10 and 4.11, "dry" and "wet", have moisture 10 and 90.

use super::{Base, PARAMS, Params, Scope};

/// A named set of parameters. Values that it does not give are the table's defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Name in links and attributes.
    pub name: &'static str,
    /// True for a natural colony, false for a scene of the thesis.
    pub natural: bool,
    /// Values of the colony's parameters, by key. A choice is given as the index of its word.
    pub fields: &'static [(&'static str, f64)],
    /// One row per base: x, y, z and range. Empty for a single base at the default.
    pub bases: &'static [[f64; 4]],
}

impl Preset {
    /// The parameters of this preset.
    pub fn params(&self) -> Params {
        let mut params = Params::with_defaults();
        for spec in PARAMS {
            let given = self.fields.iter().find(|(key, _)| *key == spec.key);
            if let (Scope::Field(_, set), Some(&(_, value))) = (&spec.scope, given) {
                set(&mut params, value);
            }
        }
        if !self.bases.is_empty() {
            let columns =
                || PARAMS.iter().filter_map(|spec| if let Scope::Item(_, set) = spec.scope { Some(set) } else { None });
            params.bases.clear();
            for row in self.bases {
                let mut base = Base::with_defaults();
                for (set, &value) in columns().zip(row) {
                    set(&mut base, value);
                }
                params.bases.push(base);
            }
        }
        params
    }
}

impl Default for Params {
    /// The thesis's default sliders, seed 0.
    fn default() -> Self {
        PRESETS[0].params()
    }
}

/// Returns the preset with this name.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

macro_rules! presets {
    ($($name:literal $natural:literal { $($key:ident: $value:expr),* } $([$($number:expr),*])*;)*) => {
        /// Every preset; the first is the default.
        pub const PRESETS: &[Preset] = &[$(Preset {
            name: $name,
            natural: $natural,
            fields: &[$((stringify!($key), $value)),*],
            bases: &[$([$($number),*]),*],
        }),*];
    };
}

/// Words of choices, as the numbers that stand for them.
const OFF: f64 = 0.0;
const ON: f64 = 1.0;
const PRESSED: f64 = 2.0;
const NONE: f64 = f64::NAN;

presets! {
    // Table 4.3 times generation only, without collisions.
    "thesis-default" false { };
    "thesis-minimum" false { density: 0.0, range: 20.0, size: 1.0, sizeSpread: 1.0, collisions: OFF };
    "thesis-maximum" false { density: 100.0, range: 200.0, size: 3.0, sizeSpread: 2.0, collisions: OFF, logLength: 400.0 };
    "thesis-fig3-7" false { density: 25.0, range: 200.0, size: 2.0, sizeSpread: 1.5, moisture: 100.0, wrinkles: 0.0, collisions: OFF, logLength: 400.0 };
    "thesis-fig4-2" false { moisture: 100.0, wrinkles: 0.0, collisions: OFF };
    "thesis-fig4-3" false { density: 100.0, range: 200.0, size: 3.0, sizeSpread: 2.0, moisture: 100.0, wrinkles: 0.0, collisions: OFF, logLength: 400.0 };
    "thesis-fig4-4" false { density: 20.0, range: 20.0, moisture: 70.0, wrinkles: 0.0 };
    "thesis-fig4-5" false { density: 20.0, range: 20.0, moisture: 30.0, wrinkles: 0.0 };
    "thesis-fig4-6" false { density: 20.0, range: 20.0, moisture: 100.0, wrinkles: 50.0 };
    "thesis-fig4-7" false { density: 20.0, range: 20.0, moisture: 100.0, wrinkles: 100.0 };
    "thesis-fig4-8" false { density: 1.0, range: 20.0, moisture: 100.0, wrinkles: 0.0, collisions: OFF, logSpacing: 2.5 } [-10.0, -10.0, 23.0, NONE];
    "thesis-fig4-9" false { density: 1.0, range: 20.0, moisture: 100.0, wrinkles: 0.0, logSpacing: 2.5 } [-10.0, -10.0, 23.0, NONE];
    "thesis-fig4-10" false { moisture: 10.0 };
    "thesis-fig4-11" false { moisture: 90.0 };
    "wet-colony" true { density: 38.0, range: 45.0, moisture: 92.0, wrinkles: 30.0, perIndividual: 0.8, size: 2.4, sizeSpread: 1.7, collisions: PRESSED, droop: 0.75, thickness: 0.16, foot: 0.6, clearLog: ON };
    "dry-colony" true { density: 38.0, range: 45.0, moisture: 35.0, wrinkles: 45.0, perIndividual: 0.6, size: 2.2, sizeSpread: 1.7, collisions: PRESSED, droop: 0.5, thickness: 0.12, foot: 0.6, clearLog: ON };
    "wrinkled-colony" true { density: 30.0, range: 45.0, moisture: 70.0, wrinkles: 95.0, perIndividual: 0.3, size: 2.8, sizeSpread: 1.6, collisions: PRESSED, droop: 0.6, thickness: 0.16, foot: 0.6, clearLog: ON };
    "fallen-log" true { density: 34.0, range: 40.0, moisture: 80.0, wrinkles: 40.0, perIndividual: 0.8, size: 2.2, sizeSpread: 1.9, collisions: PRESSED, droop: 0.7, thickness: 0.14, foot: 0.6, clearLog: ON, logLength: 260.0, logBend: 0.9, logBark: 0.7 }
        [-78.0, -12.0, 22.0, 30.0] [-20.0, -13.0, 18.0, NONE] [35.0, -10.0, 24.0, 26.0] [92.0, -8.0, 25.0, 34.0];
}
