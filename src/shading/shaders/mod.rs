//! The shaders: one file per pass, and files of functions that are prepended to several of them.

/// The shader in the file of this name, without its comments (build.rs).
macro_rules! wgsl {
    ($name:expr) => {
        include_str!(concat!(env!("OUT_DIR"), "/", $name, ".wgsl"))
    };
}

const COMMON: &str = wgsl!("common");

/// Prepended to the passes of the papers' style.
const LIGHTING: &[&str] = &[wgsl!("lighting")];

const RECIPE: &str = wgsl!("recipe");
const NOISE: &str = wgsl!("noise");
const STONE: &str = wgsl!("stone");
const COVER: &str = wgsl!("cover");
const SKY: &str = wgsl!("sky");
const HEIGHTS: &str = wgsl!("heights");
const DAYLIGHT: &str = wgsl!("daylight");
const SAMPLED: &str = wgsl!("sampled");
const FILM: &str = wgsl!("film");
const WATER: &str = wgsl!("water");

/// Prepended to the passes in natural colours.
const NATURAL: &[&str] = &[RECIPE, NOISE, STONE, COVER, SKY, FILM, HEIGHTS, DAYLIGHT, SAMPLED, WATER];

/// Prepended to the passes that draw rocks in natural colours.
const STONY: &[&str] = &[RECIPE, NOISE, STONE, COVER, SKY, FILM, HEIGHTS, DAYLIGHT, SAMPLED, WATER, wgsl!("surface")];

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
    /// The patterns, and the map of heights with vertices of rocks as textures.
    Vertices,
    /// Of the uniforms, and the mean of a still and its newest sample.
    Still,
}

/// Shows a picture that was drawn before. It stands alone.
pub(crate) const PRESENT: &str = wgsl!("present");

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
            "open_rock" => Reads::Vertices,
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
            Shader { name: $name, before: $before, source: wgsl!($name) };)*

        /// Every shader, for the tests.
        #[cfg(test)]
        const ALL: &[Shader] = &[$($constant),*];
    };
}

shaders! {
    SHADOW "shadow" after &[];
    HEIGHT "height" after &[];
    OPEN "open" after &[HEIGHTS];
    OPEN_ROCK "open_rock" after &[NOISE, HEIGHTS];
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
mod film;
#[cfg(test)]
mod tests;
