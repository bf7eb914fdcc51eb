//! Lists whose order is the meaning of the numbers that JavaScript passes: words are passed as their index, and values as
//! one list of numbers. `www/renderer/order.gen.ts` is generated from the lists here, so that both sides have one order.

/// Makes an enum whose values JavaScript knows by these words.
macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($(#[$value_doc:meta])* $value:ident $word:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub(crate) enum $name { $($(#[$value_doc])* $value,)* }

        impl $name {
            #[cfg(test)]
            const WORDS: &[&str] = &[$($word),*];

            /// The value whose word is at this place.
            pub(crate) fn at(place: u8) -> Option<Self> {
                [$($name::$value),*].get(place as usize).copied()
            }
        }
    };
}

/// Makes a struct of numbers that JavaScript knows by these keys.
macro_rules! values {
    ($(#[$doc:meta])* $name:ident { $($field:ident $key:literal,)* }) => {
        $(#[$doc])*
        pub(super) struct $name { $(pub(super) $field: f32,)* }

        impl $name {
            #[cfg(test)]
            const KEYS: &[&str] = &[$($key),*];

            /// Takes the numbers from the start of a list. Those that are missing or not finite count as 0.
            pub(super) fn take(values: &mut impl Iterator<Item = f32>) -> Self {
                let mut next = || values.next().filter(|value| value.is_finite()).unwrap_or(0.0);
                Self { $($field: next(),)* }
            }
        }
    };
}

words! {
    /// What a view shows.
    Mode {
        Rocks "3d",
        Wireframe "wireframe",
        Diagrams "diagrams",
        Selection "selection",
    }
}

words! {
    /// How rocks are coloured.
    ColorMode {
        Layer "layer",
        Rock "rock",
        Plain "plain",
        Natural "natural",
    }
}

words! {
    /// How much work is spent on a pixel in natural colours. The values ascend, because the shaders compare them.
    Quality {
        Low "low",
        Medium "medium",
        High "high",
    }
}

impl Quality {
    /// How large the triangles of rocks may be on the mean, square pixels. Larger ones show in the outlines.
    pub(crate) fn triangle(self) -> f32 {
        match self {
            Self::Low => 16.0,
            Self::Medium => 10.0,
            Self::High => 6.0,
        }
    }
}

impl Quality {
    /// How many triangles the copies of a field may have in a picture.
    pub(crate) fn surroundings(self) -> u32 {
        match self {
            Self::Low => 80_000,
            Self::Medium => 200_000,
            Self::High => 450_000,
        }
    }
}

values! {
    /// The weather 0 … 1, up to the water; the ground, 0 soil, 1 sand, 2 gravel; and the sun's place in degrees.
    LookValues {
        variation "variation",
        wetness "wetness",
        moss "moss",
        dust "dust",
        snow "snow",
        water "water",
        ground "ground",
        sun_azimuth "sunAzimuth",
        sun_elevation "sunElevation",
    }
}

values! {
    /// The flesh of wood ears, 0 … 1.
    FleshValues {
        moisture "moisture",
        variation "variation",
        translucency "translucency",
        velvet "velvet",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typescript_has_the_same_order() {
        let lists = [
            ("VIEWS", "The index of its word is what `RawRenderer.setStyle` takes as a view.", Mode::WORDS),
            ("COLORS", "Likewise, as a colour mode.", ColorMode::WORDS),
            ("QUALITIES", "Likewise, what `RawRenderer.setQuality` takes.", Quality::WORDS),
            ("LOOK", "The values that `RawRenderer.setLook` takes, in this order.", LookValues::KEYS),
            ("FLESH", "The values of wood ears, which follow those of `LOOK`.", FleshValues::KEYS),
        ];
        let mut content = String::from(
            "// Generated from src/shading/order.rs by `UPDATE=1 cargo test --lib order`; never edited.\n",
        );
        for (name, doc, words) in lists {
            let words: Vec<String> = words.iter().map(|word| format!("'{word}'")).collect();
            content += &format!("\n/** {doc} */\nexport const {name} = [{}] as const;\n", words.join(", "));
        }
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/www/renderer/order.gen.ts");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, &content).expect("the file can be written");
        }
        let found = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
        assert!(found == content, "{path} has another order; run `UPDATE=1 cargo test --lib order`");
    }
}
