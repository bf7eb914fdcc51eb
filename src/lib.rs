//! rock-field
pub mod error;
pub mod params;
pub mod rocks;
pub mod validate;
mod bitmap;
#[cfg(feature = "bench")]
mod literal;
mod memory;
mod mesh;
mod rng;
#[cfg(feature = "renderer")]
mod render;
mod bindings;

pub use error::Error;
pub use memory::{MemoryEstimate, memory_estimate};
pub use mesh::Mesh;
