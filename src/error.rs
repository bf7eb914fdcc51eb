//! The one error enum. Every variant carries what a user interface needs to put the message
//! beside the right control: the parameter's key, the value and the bounds.

use std::fmt;

/// What a caller asked for and cannot have. Nothing was changed or allocated.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A number outside its bounds, or not a number at all.
    OutOfRange {
        /// Key of the parameter, as in [`crate::params::PARAMS`].
        key: &'static str,
        /// Layer the parameter belongs to (index in input order).
        layer: Option<usize>,
        /// The value given.
        value: f64,
        /// Smallest legal value.
        min: f64,
        /// Largest legal value.
        max: f64,
    },
    /// A value that has to be whole and is not.
    NotAnInteger {
        /// Key of the parameter.
        key: &'static str,
        /// Layer the parameter belongs to.
        layer: Option<usize>,
        /// The value given.
        value: f64,
    },
    /// More layers than [`crate::params::MAX_LAYERS`].
    TooManyLayers {
        /// Layers given.
        value: usize,
        /// Layers allowed.
        max: usize,
    },
    /// Two layers carry the same id, so their random streams would coincide.
    DuplicateLayerId {
        /// The id that occurs twice.
        value: u32,
    },
    /// A preset nobody has heard of.
    UnknownPreset {
        /// The name given.
        value: String,
    },
    /// The numeric form of the parameters has the wrong length; see [`crate::params::Params::from_flat`].
    MalformedRequest {
        /// Numbers given.
        value: usize,
        /// Numbers expected.
        expected: usize,
    },
    /// The estimate of [`crate::memory_estimate`] is over the budget.
    OverBudget {
        /// The parameter to change: the one that saves most.
        key: &'static str,
        /// Bytes the run would need at its peak.
        estimate: u64,
        /// Bytes allowed.
        budget: u64,
    },
}

impl Error {
    /// Machine-readable name, stable across versions.
    pub fn code(&self) -> &'static str {
        match self {
            Error::OutOfRange { .. } => "OutOfRange",
            Error::NotAnInteger { .. } => "NotAnInteger",
            Error::TooManyLayers { .. } => "TooManyLayers",
            Error::DuplicateLayerId { .. } => "DuplicateLayerId",
            Error::UnknownPreset { .. } => "UnknownPreset",
            Error::MalformedRequest { .. } => "MalformedRequest",
            Error::OverBudget { .. } => "OverBudget",
        }
    }

    /// Key of the parameter at fault.
    pub fn key(&self) -> &'static str {
        match self {
            Error::OutOfRange { key, .. } | Error::NotAnInteger { key, .. } | Error::OverBudget { key, .. } => key,
            Error::TooManyLayers { .. } => "layers",
            Error::DuplicateLayerId { .. } => "id",
            Error::UnknownPreset { .. } => "preset",
            Error::MalformedRequest { .. } => "params",
        }
    }

    /// Index of the layer at fault.
    pub fn layer(&self) -> Option<usize> {
        match *self {
            Error::OutOfRange { layer, .. } | Error::NotAnInteger { layer, .. } => layer,
            _ => None,
        }
    }

    /// Value, smallest and largest legal value; NaN where there is none.
    pub fn numbers(&self) -> [f64; 3] {
        match *self {
            Error::OutOfRange { value, min, max, .. } => [value, min, max],
            Error::NotAnInteger { value, .. } => [value, f64::NAN, f64::NAN],
            Error::TooManyLayers { value, max } => [value as f64, 0.0, max as f64],
            Error::DuplicateLayerId { value } => [f64::from(value), f64::NAN, f64::NAN],
            Error::UnknownPreset { .. } => [f64::NAN; 3],
            Error::MalformedRequest { value, expected } => [value as f64, expected as f64, expected as f64],
            Error::OverBudget { estimate, budget, .. } => [estimate as f64, 0.0, budget as f64],
        }
    }
}

impl Error {
    /// The message for people; `number` writes a number. JavaScript has a way to write numbers, and Rust's takes 20 kB of a wasm file.
    pub(crate) fn message(&self, number: impl Fn(f64) -> String) -> String {
        let mut text = String::new();
        // These keys are the wood ears' alone.
        let is_colony = matches!(self.key(), "density" | "logSpacing" | "x" | "y" | "z" | "range");
        let [whole, part] = if is_colony { ["this colony", " of base "] } else { ["this field", " of layer "] };
        let mut say = |words: &str, value: Option<f64>| {
            text.push_str(words);
            if let Some(value) = value {
                text.push_str(&number(value));
            }
        };
        let mut place = |key: &str, layer: &Option<usize>| match layer {
            Some(index) => {
                say(key, None);
                say(part, Some(*index as f64));
            }
            None => say(key, None),
        };
        match self {
            Error::OutOfRange { key, layer, value, min, max } => {
                place(key, layer);
                say(" is ", Some(*value));
                say("; it has to lie in ", Some(*min));
                say(" to ", Some(*max));
            }
            Error::NotAnInteger { key, layer, value } => {
                place(key, layer);
                say(" is ", Some(*value));
                say("; it has to be a whole number", None);
            }
            Error::TooManyLayers { value, max } => {
                say("", Some(*value as f64));
                say(" layers; at most ", Some(*max as f64));
            }
            Error::DuplicateLayerId { value } => say("two layers have the id ", Some(f64::from(*value))),
            Error::UnknownPreset { value } => {
                say("there is no preset called \"", None);
                say(value, None);
                say("\"", None);
            }
            Error::MalformedRequest { value, expected } => {
                say("the request holds ", Some(*value as f64));
                say(" numbers instead of ", Some(*expected as f64));
            }
            Error::OverBudget { key, estimate, budget } => {
                say(whole, None);
                say(" would need about ", Some((estimate >> 20) as f64));
                say(" MiB and the budget is ", Some((budget >> 20) as f64));
                say(" MiB; change ", None);
                say(key, None);
            }
        }
        text
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(|n| n.to_string()))
    }
}

impl std::error::Error for Error {}
