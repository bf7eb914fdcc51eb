//! The structure of a row of a parameter table, and the macro that writes a table. Rocks and wood ears use the same.
//!
//! A table becomes two constants: `PARAMS` (keys and bounds) and `TEXTS` (controls, labels and documentation, in the
//! same order). A wasm artefact that only checks bounds therefore does not contain the texts.

/// The units of a layer's lengths (decision A5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Notation {
    /// Those of the journal: radius, taper and height in px.
    #[default]
    Px,
    /// Those of the conference version: radius and taper in image width / 100, height in multiples of the radius.
    Relative,
}

/// Whether a parameter belongs to the whole field or colony, or to each item of its list: each layer of rocks, each
/// base of wood ears. Holds functions that read and set the value.
#[derive(Debug)]
pub enum Scope<P, I> {
    /// The parameter occurs once.
    Field(fn(&P) -> f64, fn(&mut P, f64)),
    /// The parameter occurs once per item.
    Item(fn(&I) -> f64, fn(&mut I, f64)),
}

/// The kind of value that a parameter holds. Every value is passed as one number.
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
    /// One of these words, passed as its index.
    Choice(&'static [&'static str]),
}

impl Kind {
    /// Whether the parameter may have no value, which is passed as NaN.
    pub fn is_optional(self) -> bool {
        matches!(self, Kind::OptionalReal | Kind::OptionalInteger)
    }
}

/// Bounds and default value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Smallest legal value.
    pub min: f64,
    /// Largest legal value.
    pub max: f64,
    /// Value that is used if none is given; NaN for "none".
    pub default: f64,
}

/// The part of the range that a slider covers, and its step. The number field beside it has the same step and takes the
/// whole range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slider {
    /// Value at the left end.
    pub min: f64,
    /// Value at the right end.
    pub max: f64,
    /// Whether equal distances on the slider are equal factors.
    pub logarithmic: bool,
    /// Step of slider and number field.
    pub step: f64,
}

/// One row: key, bounds and accessors of a parameter of `P` or of its items `I`. `S` is the type of the generator's
/// stages.
#[derive(Debug)]
pub struct ParamSpec<P, I, S> {
    /// Name of the property in code. The three parts of a triple share it.
    pub key: &'static str,
    /// Whether it belongs to the whole or to each item, and its accessors.
    pub scope: Scope<P, I>,
    /// Kind of value.
    pub kind: Kind,
    /// Bounds in the journal's notation.
    pub range: Range,
    /// Bounds in the conference's notation, if they differ.
    pub relative: Option<Range>,
    /// The first stage that has to run again after an edit of this parameter.
    pub stage: S,
}

/// The part of a row that no stage needs: its controls and its texts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Text {
    /// Name of the parameter in links.
    pub url: &'static str,
    /// Which part of a triple it is: 0 for the base, 1 per rock, 2 per vertex.
    pub component: Option<u8>,
    /// The slider in the journal's notation.
    pub slider: Slider,
    /// The slider in the conference's notation, if it differs.
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
    /// Whether presets can have a column for it: true for every parameter of an item that is not optional.
    pub fn is_column(&self) -> bool {
        matches!(self.scope, Scope::Item(..)) && !self.kind.is_optional()
    }

    /// The bounds in the given notation.
    pub fn range(&self, notation: Notation) -> Range {
        match (notation, self.relative) {
            (Notation::Relative, Some(range)) => range,
            _ => self.range,
        }
    }
}

/// The type of a parameter of an item, which crosses boundaries as numbers.
pub(super) trait Value {
    /// Kind of each of its numbers.
    const KIND: Kind;
    /// The value before it is set.
    const EMPTY: Self;

    /// Number `part` of it; 0 if there is only one.
    fn get(&self, part: usize) -> f64;

    /// Sets number `part` of it.
    fn set(&mut self, part: usize, value: f64);
}

impl Value for f64 {
    const KIND: Kind = Kind::Real;
    const EMPTY: Self = 0.0;

    fn get(&self, _: usize) -> f64 {
        *self
    }

    fn set(&mut self, _: usize, value: f64) {
        *self = value;
    }
}

impl Value for u32 {
    const KIND: Kind = Kind::Integer;
    const EMPTY: Self = 0;

    fn get(&self, _: usize) -> f64 {
        f64::from(*self)
    }

    fn set(&mut self, _: usize, value: f64) {
        *self = value as u32;
    }
}

impl Value for Option<u32> {
    const KIND: Kind = Kind::OptionalInteger;
    const EMPTY: Self = None;

    fn get(&self, _: usize) -> f64 {
        self.map_or(f64::NAN, f64::from)
    }

    fn set(&mut self, _: usize, value: f64) {
        *self = if value.is_nan() { None } else { Some(value as u32) };
    }
}

impl Value for [f64; 3] {
    const KIND: Kind = Kind::Real;
    const EMPTY: Self = [0.0; 3];

    fn get(&self, part: usize) -> f64 {
        self[part]
    }

    fn set(&mut self, part: usize, value: f64) {
        self[part] = value;
    }
}

/// Makes `PARAMS` and `TEXTS` from rows. The module that uses it must have a type `ParamSpec`, and the `Scope`, `Kind`
/// and `Stage` of its rows.
///
/// After the rows, there can be the struct of the items. Its fields are rows too: each has its key, the first stage that
/// has to run again after an edit, and in braces what the other rows say, once for each of its numbers. The struct is
/// made from them; the types of the fields have to be [`Value`]s.
macro_rules! table {
    ($({
        $key:literal $(.$component:literal)?, url $url:literal, $scope:expr, $kind:expr, $stage:ident,
        range [$min:expr, $max:expr] step $step:literal default $default:expr, slider [$lo:expr, $hi:expr] $scale:ident,
        $(relative [$rmin:expr, $rmax:expr] step $rstep:literal default $rdefault:expr, slider [$rlo:expr, $rhi:expr] $rscale:ident,)?
        unit $unit:expr, label $label:expr,
        en $en:literal,
        ja $ja:literal
        $(, choices $choices:expr)?
    })*
    $(
        $(#[$item_doc:meta])*
        pub struct $Item:ident {
            $(#[$id_doc:meta])*
            pub $id:ident: $id_type:ty;
            $(
                $(#[$field_doc:meta])*
                pub $field:ident: $type:ty as $field_key:literal, from $field_stage:ident $({
                    $(.$part:literal)? url $part_url:literal,
                    range [$pmin:expr, $pmax:expr] step $pstep:literal default $pdefault:expr, slider [$plo:expr, $phi:expr] $pscale:ident,
                    $(relative [$prmin:expr, $prmax:expr] step $prstep:literal default $prdefault:expr, slider [$prlo:expr, $prhi:expr] $prscale:ident,)?
                    unit $part_unit:expr, label $part_label:expr,
                    en $part_en:literal,
                    ja $part_ja:literal
                    $(, choices $part_choices:expr)?
                })+
            )*
        }
    )?) => {
        $(
            $(#[$item_doc])*
            #[derive(Debug, Clone, PartialEq)]
            pub struct $Item {
                $(#[$id_doc])*
                pub $id: $id_type,
                $($(#[$field_doc])* pub $field: $type,)*
            }

            impl $Item {
                /// Empty values, which the table's rows then fill in.
                pub(crate) const EMPTY: $Item =
                    $Item { $id: 0, $($field: <$type as $crate::params::spec::Value>::EMPTY,)* };
            }
        )?

        /// Keys, bounds and accessors of every parameter.
        pub const PARAMS: &[ParamSpec] = &[$($crate::params::spec::ParamSpec {
            key: $key,
            scope: $scope,
            kind: $kind,
            range: $crate::params::spec::Range { min: $min, max: $max, default: $default },
            relative: table!(@option $($crate::params::spec::Range { min: $rmin, max: $rmax, default: $rdefault })?),
            stage: Stage::$stage,
        },)* $($($($crate::params::spec::ParamSpec {
            key: $field_key,
            scope: Scope::Item(
                |item| item.$field.get(table!(@part $($part)?)),
                |item, value| item.$field.set(table!(@part $($part)?), value),
            ),
            kind: <$type as $crate::params::spec::Value>::KIND,
            range: $crate::params::spec::Range { min: $pmin, max: $pmax, default: $pdefault },
            relative: table!(@option $($crate::params::spec::Range { min: $prmin, max: $prmax, default: $prdefault })?),
            stage: Stage::$field_stage,
        },)+)*)?];
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
        },)* $($($($crate::params::spec::Text {
            url: $part_url,
            component: table!(@option $($part)?),
            slider: $crate::params::spec::Slider { min: $plo, max: $phi, logarithmic: table!(@$pscale), step: $pstep },
            relative: table!(@option $($crate::params::spec::Slider { min: $prlo, max: $prhi, logarithmic: table!(@$prscale), step: $prstep })?),
            unit: $part_unit,
            label: $part_label,
            doc: [$part_en, $part_ja],
            choices: table!(@slice $($part_choices)?),
        },)+)*)?];
    };
    (@part) => { 0 };
    (@part $part:literal) => { $part };
    (@linear) => { false };
    (@log) => { true };
    (@option) => { None };
    (@option $value:expr) => { Some($value) };
    (@slice) => { &[] };
    (@slice $value:expr) => { $value };
}
pub(super) use table;
