//! Ground covered with rocks of various sizes, as a pure function of its parameters.
//!
//! The method is that of Sakurai & Miyata, *A Procedural Modeling of Various-Sized Rocks on the Ground* (journal
//! version 2011; conference version, NICOGRAPH 2010). Each layer has its own disc radius. For each layer:
//!
//! 1. **sites** – dart throwing on a bitmap, until no pixel is free ([`rocks::Sites`]; §3.1, Fig. 4, Eq. 1);
//! 2. **cells** – the sites' Voronoi diagram, clipped to the image ([`rocks::Cells`]; §3.1);
//! 3. **selection** – cells all of whose pixels are free, coarsest layer first ([`rocks::Selection`]; §3.2, Fig. 7);
//! 4. **shape** – as many random points in a cell as it has vertices, and their Delaunay triangulation
//!    ([`rocks::Shapes`]; §3.3, Fig. 10);
//! 5. **mesh** – the points moved outward and up (Eqs 2, 3), written to flat buffers ([`Mesh`]). Beyond the papers, and
//!    off by default, rocks can be subdivided, worn, roughened and embedded (`weathering`, `roughness`, `detail`,
//!    `embedding` of a [`params::Layer`]).
//!
//! ```
//! use rock_field::params::preset;
//!
//! let mut params = preset("journal-fig1").expect("a preset of the journal").params();
//! (params.image_width, params.image_height, params.seed) = (256, 256, 7);
//! let field = rock_field::rocks::generate(&params)?;
//!
//! // Rock k owns these indices; three per triangle, into positions of three numbers each.
//! let mesh = &field.mesh;
//! let rock = mesh.rock_starts[0] as usize..mesh.rock_starts[1] as usize;
//! assert!(mesh.indices[rock].iter().all(|&v| 3 * (v as usize) + 2 < mesh.positions.len()));
//! # Ok::<(), rock_field::Error>(())
//! ```
//!
//! [`rocks::Generator`] does the same in small steps and keeps the result of every stage, so that an edit re-runs only
//! the stages that it affects.
//!
//! Besides rocks, [`wood_ear`] grows colonies of wood ears (kikurage) on a fallen log, by the method of Nishimura's
//! bachelor thesis (fiscal 2012): log → spawn → deform → collide → mesh. It shares the conventions below; one cm is one
//! px.
//!
//! # Conventions
//!
//! *Plane*: x points right and y up, in pixels, as `f64`. Pixel (column, row) has its centre at (column + 0.5, row +
//! 0.5); the origin is the image's corner, and row 0 is the bottom row seen from above. *World*: right-handed, z up,
//! with the plane's x and y and the ground at z = 0. Polygons and triangles are counter-clockwise seen from above, and
//! indices are `u32`. Errors name the parameter's key, its value and its bounds. Degenerate but legal input gives a
//! result, never an error.
//!
//! # What a seed promises
//!
//! Equal parameters give equal bytes on every platform: there is one portable random generator per (seed, purpose,
//! layer, item), f64 arithmetic uses only + − × ÷ √, predicates are exact, and hash maps are never iterated over. If a
//! change gives other rocks for the same parameters, the changelog says so.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | *(none)* | the generators: no clock, no global, no DOM, no GPU |
//! | `full` | what few fields ask for: masks and strokes; on by default |
//! | `generator` | wasm-bindgen exports of the rocks' generator, for workers and Node |
//! | `generator-full` | the same with `full`, in a separate artefact |
//! | `wood-ear` | wasm-bindgen exports of the wood ears' generator, in a separate artefact |
//! | `ground-mesh` | the ground around rocks as a mesh, and its wasm-bindgen exports, in a separate artefact |
//! | `renderer-webgpu`, `renderer-webgl` | a renderer for one backend; an artefact never contains both |
//! | `bench` | the papers' loops as they are written, for `npm run bench` |
//!
//! # Deviations and limits
//!
//! Where the papers are silent or ask for the impossible, the code cites a decision (*decision A1* …);
//! `docs/decisions.md` explains them all. The main ones: dart throwing ends when no pixel is free, which at c_d = 0.7
//! it always does (A1); j1 and j2 lie in \[0, 1\] (A10); the surface is open, without a bottom (A13); rocks of
//! neighbouring cells may pass through each other if their tops are moved outward (A14). Wear is an addition, since
//! both papers leave it to future work. A worn rock is a convex body made from the papers' rock; its rim stays on its
//! cell and sinks below the ground. With all four parameters at 0, the mesh is that of the papers, bit for bit. Images
//! have sides of 1 to 8192 px, and fields have up to eight layers.

mod bindings;
mod cached;
mod error;
#[cfg(any(feature = "ground-mesh", test))]
pub mod ground;
mod noise;
pub mod params;
#[cfg(feature = "renderer")]
mod render;
mod rng;
pub mod rocks;
#[cfg(any(feature = "renderer", test))]
#[cfg_attr(
    not(feature = "renderer"),
    allow(dead_code, unused_imports, reason = "without a renderer, only its tests use it")
)]
mod shading;
pub mod validate;
pub mod wood_ear;

pub use error::Error;
pub use rocks::memory::{MemoryEstimate, memory_estimate};
pub use rocks::mesh::Mesh;
