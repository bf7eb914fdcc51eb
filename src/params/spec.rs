//! What a row of a parameter table is, and the macro that writes one: the rocks' table and the wood-ear's are made alike.
//!
//! The rows give rise to two constants, so that a wasm build which only checks bounds does not carry
//! the texts: `PARAMS` (keys and bounds) and `TEXTS` (controls, labels and documentation, same order).

use super::Notation;

/// Whether a parameter belongs to the whole or to each item of its list: a layer of rocks, a base of wood ears.
#[derive(Debug)]
pub enum Scope<P, I> {
    /// Once.
    Field(fn(&P) -> f64, fn(&mut P, f64)),
    /// Once per item.
    Item(fn(&I) -> f64, fn(&mut I, f64)),
}

/// What kind of value a parameter holds. Every value travels as one number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Any number within the range.
    Real,
    /// A whole number.
    Integer,
    /// A number, or NaN for "none".
    OptionalReal,
    /// A whole number, or NaN for "none".
    OptionalInteger,
    /// An index into these words.
    Choice(&'static [&'static str]),
}

impl Kind {
    /// Whether NaN is a value: "none".
    pub fn is_optional(self) -> bool {
        matches!(self, Kind::OptionalReal | Kind::OptionalInteger)
    }
}

/// Bounds and default.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Smallest legal value.
    pub min: f64,
    /// Largest legal value.
    pub max: f64,
    /// Value where none is given; NaN for "none".
    pub default: f64,
}

/// The part of the range that a slider covers, and the step of it and of the number field beside it, which takes the whole range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slider {
    /// Left end.
    pub min: f64,
    /// Right end.
    pub max: f64,
    /// Equal steps are equal factors.
    pub logarithmic: bool,
    /// Step of the control.
    pub step: f64,
}

/// One row: the bounds and the place of a parameter of `P` or of its items `I`, whose stages are `S`.
#[derive(Debug)]
pub struct ParamSpec<P, I, S> {
    /// Property name in code; the three parts of a triple share it.
    pub key: &'static str,
    /// Whole or item, with its accessors.
    pub scope: Scope<P, I>,
    /// Kind of value.
    pub kind: Kind,
    /// Bounds in the journal's notation.
    pub range: Range,
    /// Bounds in the conference's notation, where they differ.
    pub relative: Option<Range>,
    /// First stage an edit re-runs.
    pub stage: S,
}

/// What belongs to a row of `PARAMS` and no stage needs: its controls and its words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Text {
    /// Key in links.
    pub url: &'static str,
    /// Which part of a triple: base, per rock, per vertex.
    pub component: Option<u8>,
    /// Its control in the journal's notation.
    pub slider: Slider,
    /// Its control in the conference's notation, where they differ.
    pub relative: Option<Slider>,
    /// Unit in the journal's and in the conference's notation.
    pub unit: [&'static str; 2],
    /// Label in English and Japanese.
    pub label: [&'static str; 2],
    /// One sentence of documentation in English and Japanese.
    pub doc: [&'static str; 2],
    /// Labels of the words of a [`Kind::Choice`], in English and Japanese.
    pub choices: &'static [[&'static str; 2]],
}

impl<P, I, S> ParamSpec<P, I, S> {
    /// Whether it has a column in the rows of the presets: every parameter of an item but the optional ones.
    pub fn is_column(&self) -> bool {
        matches!(self.scope, Scope::Item(..)) && !self.kind.is_optional()
    }

    /// Bounds in a notation.
    pub fn range(&self, notation: Notation) -> Range {
        match (notation, self.relative) {
            (Notation::Relative, Some(range)) => range,
            _ => self.range,
        }
    }
}

/// `PARAMS` and `TEXTS` from rows. Where it stands there have to be a type `ParamSpec`, the rows' `Scope`, `Kind` and `Stage`.
macro_rules! table {
    ($({
        $key:literal $(.$component:literal)?, url $url:literal, $scope:expr, $kind:expr, $stage:ident,
        range [$min:expr, $max:expr] step $step:literal default $default:expr, slider [$lo:expr, $hi:expr] $scale:ident,
        $(relative [$rmin:expr, $rmax:expr] step $rstep:literal default $rdefault:expr, slider [$rlo:expr, $rhi:expr] $rscale:ident,)?
        unit $unit:expr, label $label:expr,
        en $en:literal,
        ja $ja:literal
        $(, choices $choices:expr)?
    })*) => {
        /// Keys, bounds and accessors of every parameter.
        pub const PARAMS: &[ParamSpec] = &[$($crate::params::spec::ParamSpec {
            key: $key,
            scope: $scope,
            kind: $kind,
            range: $crate::params::spec::Range { min: $min, max: $max, default: $default },
            relative: table!(@option $($crate::params::spec::Range { min: $rmin, max: $rmax, default: $rdefault })?),
            stage: Stage::$stage,
        }),*];
        /// Controls, labels and documentation of every parameter, in the order of [`PARAMS`].
        pub const TEXTS: &[$crate::params::spec::Text] = &[$($crate::params::spec::Text {
            url: $url,
            component: table!(@option $($component)?),
            slider: $crate::params::spec::Slider { min: $lo, max: $hi, logarithmic: table!(@$scale), step: $step },
            relative: table!(@option $($crate::params::spec::Slider { min: $rlo, max: $rhi, logarithmic: table!(@$rscale), step: $rstep })?),
            unit: $unit,
            label: $label,
            doc: [$en, $ja],
            choices: table!(@slice $($choices)?),
        }),*];
    };
    (@linear) => { false };
    (@log) => { true };
    (@option) => { None };
    (@option $value:expr) => { Some($value) };
    (@slice) => { &[] };
    (@slice $value:expr) => { $value };
}
pub(super) use table;
