//! The error enum of the generators. Every variant carries what a user interface needs to put the message beside the
//! right control: the parameter's key, the value and the bounds.

use std::fmt;

/// Why a request was refused. Nothing was changed or allocated.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// A value that has to be a whole number, but is not.
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
    /// The numeric form of the parameters has the wrong length; see [`crate::params::Params::from_flat`].
    MalformedRequest {
        /// Numbers given.
        value: usize,
        /// Numbers expected.
        expected: usize,
    },
    /// The memory estimate (see [`crate::memory_estimate`]) is above the budget.
    OverBudget {
        /// The parameter whose change would save most memory.
        key: &'static str,
        /// Bytes the run would need at its peak.
        estimate: u64,
        /// Bytes allowed.
        budget: u64,
    },
}

impl Error {
    /// Machine-readable name of the error, stable across versions.
    pub fn code(&self) -> &'static str {
        match self {
            Error::OutOfRange { .. } => "OutOfRange",
            Error::NotAnInteger { .. } => "NotAnInteger",
            Error::TooManyLayers { .. } => "TooManyLayers",
            Error::DuplicateLayerId { .. } => "DuplicateLayerId",
            Error::MalformedRequest { .. } => "MalformedRequest",
            Error::OverBudget { .. } => "OverBudget",
        }
    }

    /// Key of the parameter that caused the error.
    pub fn key(&self) -> &'static str {
        match self {
            Error::OutOfRange { key, .. } | Error::NotAnInteger { key, .. } | Error::OverBudget { key, .. } => key,
            Error::TooManyLayers { .. } => "layers",
            Error::DuplicateLayerId { .. } => "id",
            Error::MalformedRequest { .. } => "params",
        }
    }

    /// Index of the layer that caused the error, if it was one layer.
    pub fn layer(&self) -> Option<usize> {
        match *self {
            Error::OutOfRange { layer, .. } | Error::NotAnInteger { layer, .. } => layer,
            _ => None,
        }
    }

    /// The value, the smallest and the largest legal value. NaN if there is none.
    pub fn numbers(&self) -> [f64; 3] {
        match *self {
            Error::OutOfRange { value, min, max, .. } => [value, min, max],
            Error::NotAnInteger { value, .. } => [value, f64::NAN, f64::NAN],
            Error::TooManyLayers { value, max } => [value as f64, 0.0, max as f64],
            Error::DuplicateLayerId { value } => [f64::from(value), f64::NAN, f64::NAN],
            Error::MalformedRequest { value, expected } => [value as f64, expected as f64, expected as f64],
            Error::OverBudget { estimate, budget, .. } => [estimate as f64, 0.0, budget as f64],
        }
    }
}

impl Error {
    /// The message for people. `number` converts a number to text: JavaScript has a way to do that, whereas Rust's
    /// takes 20 kB of a wasm file.
    pub(crate) fn message(&self, number: &dyn Fn(f64) -> String) -> String {
        let key = self.key();
        // Only the wood ears have these keys.
        let is_colony = matches!(key, "density" | "logSpacing" | "clearLog" | "x" | "y" | "z" | "range");
        let [whole, part] = if is_colony { ["this colony", " of base "] } else { ["this field", " of layer "] };
        let place = self.layer().map(|index| [part, &number(index as f64)].concat()).unwrap_or_default();
        let [value, min, max] = self.numbers();
        let mebibytes = |bytes: f64| (bytes / 1_048_576.0).floor();
        let (text, words, numbers) = match self {
            Error::OutOfRange { .. } => ("@@ is #; it must be between # and #", [key, &place], [value, min, max]),
            Error::NotAnInteger { .. } => ("@@ is #; it must be a whole number", [key, &place], [value; 3]),
            Error::TooManyLayers { .. } => ("there are # layers; there may be at most #", [""; 2], [value, max, max]),
            Error::DuplicateLayerId { .. } => ("two layers have the id #", [""; 2], [value; 3]),
            Error::MalformedRequest { .. } => ("the request holds # numbers instead of #", [""; 2], [value, max, max]),
            Error::OverBudget { .. } => (
                "@ would need about # MiB and the budget is # MiB; change @",
                [whole, key],
                [mebibytes(value), mebibytes(max), 0.0],
            ),
        };
        fill(text, &words, &numbers, number)
    }
}

/// Fills in a text (ASCII): each `@` is replaced by the next of `words`, each `#` by the next of `numbers`.
pub(crate) fn fill(text: &str, words: &[&str], numbers: &[f64], number: &dyn Fn(f64) -> String) -> String {
    let mut filled = String::new();
    let (mut words, mut numbers) = (words.iter(), numbers.iter());
    for c in text.bytes().map(char::from) {
        match c {
            '@' => filled.push_str(words.next().unwrap_or(&"")),
            '#' => filled.push_str(&number(numbers.next().copied().unwrap_or(f64::NAN))),
            _ => filled.push(c),
        }
    }
    filled
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(&|n| n.to_string()))
    }
}

impl std::error::Error for Error {}
