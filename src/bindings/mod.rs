//! The wasm boundary. Functions here convert their arguments, make one call, and convert the result, and do nothing
//! else.

#[cfg(all(target_family = "wasm", any(feature = "ground-mesh", feature = "wood-ear")))]
mod allocator;
#[cfg(any(feature = "generator", feature = "wood-ear"))]
mod error;
#[cfg(feature = "generator")]
mod generator;
#[cfg(feature = "ground-mesh")]
mod ground_mesh;
#[cfg(feature = "bench")]
mod literal;
#[cfg(feature = "renderer")]
mod renderer;
#[cfg(feature = "renderer")]
mod renderer_bake;
#[cfg(feature = "renderer")]
mod renderer_wood;
#[cfg(feature = "wood-ear")]
mod wood_ear;
