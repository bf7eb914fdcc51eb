//! What can go wrong between a field and a picture, in words that a page can show.

use std::fmt;

/// Why a device, a canvas or a field was refused.
#[derive(Debug)]
pub(crate) enum RenderError {
    /// There is no graphics adapter for this backend.
    NoAdapter(String),
    /// The adapter refused a device.
    NoDevice(String),
    /// The canvas gave no surface, or none that this device can draw to.
    Surface(String),
    /// A buffer of the field is larger than this device accepts.
    TooLarge { what: &'static str, bytes: u64, limit: u64 },
    /// The buffers contradict each other, which is a bug of rock-field.
    Malformed(&'static str),
}

impl RenderError {
    /// The machine-readable name that JavaScript sees as `error.name`.
    pub(crate) fn code(&self) -> &'static str {
        match self {
            Self::NoAdapter(_) => "NoAdapter",
            Self::NoDevice(_) => "NoDevice",
            Self::Surface(_) => "NoSurface",
            Self::TooLarge { .. } => "FieldTooLarge",
            Self::Malformed(_) => "MalformedField",
        }
    }
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter(why) => write!(f, "no graphics adapter: {why}"),
            Self::NoDevice(why) => write!(f, "the graphics adapter refused a device: {why}"),
            Self::Surface(why) => write!(f, "the canvas cannot be drawn to: {why}"),
            Self::TooLarge { what, bytes, limit } => write!(
                f,
                "the {what} of this field need {bytes} bytes in one buffer, this graphics device takes {limit}: \
                 make the image smaller or the discs larger"
            ),
            Self::Malformed(what) => write!(f, "the field is malformed: {what}"),
        }
    }
}
