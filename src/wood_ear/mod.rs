//! Wood-ear colonies on a fallen log: log → spawn → deform → collide → mesh.
//!
//! The method is that of Nishimura's bachelor thesis on kikurage growing in colonies on a fallen log (fiscal 2012).
//! Where the thesis is silent or inconsistent, the code cites a decision (*decision K1* …); docs/decisions.md explains
//! them all.
//!
//! 1. **log** – a log is grown, or points to stand on are drawn over a mesh given by the user ([`Log`]; K12);
//! 2. **spawn** – some vertices of the log within range carry an individual ([`spawn()`]; §3.2, K6);
//! 3. **deform** – bowl, drying, wrinkles ([`bowl()`], [`deform()`]; Eqs 3.1 to 3.5, K1 to K5, K7);
//! 4. **collide** – meridians step inward (Eqs 3.6 to 3.10, K8 to K11), or bodies press flat against planes between
//!    them;
//! 5. **mesh** – flat buffers ([`ColonyMesh`], [`LogMesh`]).
//!
//! Droop, thickness, foot, keeping clear of the log, and the collision rule `pressed` go beyond the thesis and are off
//! by default. While they are off, the mesh is that of the thesis, bit for bit.
//!
//! ```
//! use rock_field::params::wood_ear::preset;
//! use rock_field::wood_ear::Generator;
//!
//! let mut params = preset("thesis-default").expect("a preset of the thesis").params();
//! params.range = 20.0;
//! let mut generator = Generator::new();
//! generator.start(params, u64::MAX)?;
//! while !generator.step()? {}
//!
//! // Individual k owns these indices, three per triangle. Its vertex i is on ring i / c + 1 of its inner sheet.
//! let mesh = generator.mesh();
//! let one = mesh.individual_starts[0] as usize..mesh.individual_starts[1] as usize;
//! assert!(mesh.indices[one].iter().all(|&v| v < mesh.vertex_starts[1]));
//! # Ok::<(), rock_field::Error>(())
//! ```
//!
//! # Limits
//!
//! With `thesis` a few pairs may stay crossed, because a later pair can disturb an earlier one (K9). With a thickness,
//! the thesis's rule looks at the inner sheets only. `pressed` leaves no pair crossing, but it does not test a body
//! against itself: a strongly wrinkled, thick sheet may touch itself. A log given by the user has to be closed if
//! individuals are to be kept out of it.

mod body;
mod bowl;
mod circle;
mod crossing;
mod deform;
mod feet;
mod generator;
mod grid;
mod ground;
mod keys;
mod log;
mod memory;
mod mesh;
mod pairs;
mod pose;
mod press;
mod settle;
mod shape;
mod spawn;
mod task;
mod thesis;
mod user_log;
mod work;

pub use body::Layout;
pub use bowl::bowl;
pub use deform::{Sheet, deform, drying};
pub use generator::Generator;
pub use log::Log;
pub use mesh::{ColonyMesh, LogMesh};
pub use settle::Stats;
pub use shape::Wood;
pub use spawn::{Individual, Spawn, spawn};
pub use user_log::LogError;
