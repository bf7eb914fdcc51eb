//! What a pipeline in natural colours is made for: the constants of `shaders/recipe.wgsl`.

use super::{Look, Quality};

/// Which pictures a pipeline is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Sort {
    /// With as many samples a pixel as the screen has.
    Frame,
    /// With one sample a pixel, and soon replaced.
    Rough,
    /// A sample of a still.
    Sample,
}

/// Equal recipes share a pipeline. A pass ignores what it does not read, so that fewer have to be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Recipe {
    quality: Quality,
    /// 0 soil, 1 sand, 2 gravel.
    ground: u8,
    has_moss: bool,
    is_wet: bool,
    has_snow: bool,
    has_water: bool,
    has_log: bool,
    sort: Sort,
}

impl Recipe {
    /// For what stands on the ground: it takes the ground's kind from the uniforms.
    pub(crate) fn of_bodies(quality: Quality, look: &Look) -> Self {
        let [_, wetness, moss, _] = look.weather;
        let (has_moss, is_wet, has_snow, has_water) = (moss > 0.0, wetness > 0.0, look.snow > 0.0, look.water > 0.0);
        Self { quality, ground: 0, has_moss, is_wet, has_snow, has_water, has_log: false, sort: Sort::Frame }
    }

    pub(crate) fn of_ground(quality: Quality, look: &Look, has_log: bool) -> Self {
        Self { ground: look.ground as u8, has_log, ..Self::of_bodies(quality, look) }
    }

    /// The same for a picture of another sort.
    pub(crate) fn of(self, sort: Sort) -> Self {
        Self { sort, ..self }
    }

    pub(crate) fn sort(self) -> Sort {
        self.sort
    }

    /// By the names that the shaders give them.
    pub(crate) fn constants(self) -> [(&'static str, f64); 8] {
        let Self { quality, ground, has_moss, is_wet, has_snow, has_water, has_log, sort } = self;
        let is_sampled = sort == Sort::Sample;
        [
            ("quality", f64::from(quality as u8)),
            ("ground_kind", f64::from(ground)),
            ("has_moss", f64::from(u8::from(has_moss))),
            ("is_wet", f64::from(u8::from(is_wet))),
            ("has_snow", f64::from(u8::from(has_snow))),
            ("has_water", f64::from(u8::from(has_water))),
            ("has_log", f64::from(u8::from(has_log))),
            ("is_sampled", f64::from(u8::from(is_sampled))),
        ]
    }
}
