//! The shaders: one file per pass, and files of functions that are prepended to several of them.

const COMMON: &str = include_str!("common.wgsl");

/// Prepended to the passes of the papers' style.
const LIGHTING: &[&str] = &[include_str!("lighting.wgsl")];

const RECIPE: &str = include_str!("recipe.wgsl");
const NOISE: &str = include_str!("noise.wgsl");
const STONE: &str = include_str!("stone.wgsl");
const COVER: &str = include_str!("cover.wgsl");
const SKY: &str = include_str!("sky.wgsl");
const DAYLIGHT: &str = include_str!("daylight.wgsl");
const SAMPLED: &str = include_str!("sampled.wgsl");
const FILM: &str = include_str!("film.wgsl");

/// Prepended to the passes in natural colours.
const NATURAL: &[&str] = &[RECIPE, NOISE, STONE, COVER, SKY, FILM, DAYLIGHT, SAMPLED];

/// Prepended to the passes that draw rocks in natural colours.
const STONY: &[&str] = &[RECIPE, NOISE, STONE, COVER, SKY, FILM, DAYLIGHT, SAMPLED, include_str!("surface.wgsl")];

/// Prepended to the pass that makes a picture of a still.
const DEVELOPING: &[&str] = &[RECIPE, FILM];

/// The bind groups of a pass: those of the uniforms, and others.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reads {
    Uniforms,
    /// Also the shadow and height maps.
    Maps,
    /// Also these and the patterns of natural colours.
    Patterns,
    /// Also the mean of a still, and its newest sample.
    Still,
}

/// Shows a picture that was drawn before. It stands alone.
pub(crate) const PRESENT: &str = include_str!("present.wgsl");

/// The shader of a pass.
#[derive(Clone, Copy)]
pub(crate) struct Shader {
    /// Name of the pass and of its file.
    name: &'static str,
    /// Shader code between the common part and the pass's own.
    before: &'static [&'static str],
    source: &'static str,
}

impl Shader {
    pub(crate) fn name(self) -> &'static str {
        self.name
    }

    /// Name of the pipeline for debuggers.
    pub(crate) fn label(self) -> String {
        ["rock-field/", self.name, "/pipeline"].concat()
    }

    /// The whole code.
    pub(crate) fn code(self) -> String {
        [&[COMMON], self.before, &[self.source]].concat().concat()
    }

    /// What the pass reads.
    pub(crate) fn reads(self) -> Reads {
        match self.name {
            "gather" | "develop" => Reads::Still,
            _ if self.before.contains(&NOISE) => Reads::Patterns,
            // What is lit has the lighting before it.
            _ if self.before.is_empty() => Reads::Uniforms,
            _ => Reads::Maps,
        }
    }
}

macro_rules! shaders {
    ($($constant:ident $name:literal after $before:expr;)*) => {
        $(pub(crate) const $constant: Shader =
            Shader { name: $name, before: $before, source: include_str!(concat!($name, ".wgsl")) };)*

        /// Every shader, for the tests.
        #[cfg(test)]
        const ALL: &[Shader] = &[$($constant),*];
    };
}

shaders! {
    SHADOW "shadow" after &[];
    HEIGHT "height" after &[];
    GROUND "ground" after LIGHTING;
    FLOOR "floor" after &[];
    ROCK "rock" after LIGHTING;
    NATURAL_ROCK "natural_rock" after STONY;
    BAKE "bake" after STONY;
    NATURAL_GROUND "natural_ground" after NATURAL;
    LOG "log" after NATURAL;
    EAR "ear" after NATURAL;
    PLAIN_WOOD "plain_wood" after LIGHTING;
    WIRE "wire" after &[];
    WOOD_WIRE "wood_wire" after &[];
    PLAN "plan" after &[];
    STROKE "stroke" after &[];
    GATHER "gather" after &[];
    DEVELOP "develop" after DEVELOPING;
}

#[cfg(test)]
mod complete;
#[cfg(test)]
mod tests;
