//! The wasm boundary: convert – call – convert, nothing else.

#[cfg(feature = "generator")]
mod generator;
#[cfg(feature = "bench")]
mod literal;
#[cfg(feature = "renderer")]
mod renderer;
