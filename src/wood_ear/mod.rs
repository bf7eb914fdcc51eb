//! Wood-ear colonies on a fallen log: log → spawn → deform → collide → mesh.
//!
//! The method is that of Nishimura's bachelor thesis on kikurage growing in colonies on a fallen log (fiscal 2012); where it is
//! silent or inconsistent the deciding item says so (*decision K1* …).
//!
//! 1. **log** – grown here, or feet drawn over a mesh of the user's own ([`Log`]; K12);
//! 2. **spawn** – vertices of the log within range carry an individual ([`spawn()`]; §3.2, K6);
//! 3. **deform** – bowl, drying, wrinkles ([`bowl()`], [`deform()`]; Eqs 3.1 to 3.5, K1 to K5, K7);
//! 4. **collide** – meridians step inward (Eqs 3.6 to 3.10, K8 to K11), or bodies press flat against planes;
//! 5. **mesh** – flat buffers ([`ColonyMesh`], [`LogMesh`]).
//!
//! Beyond the thesis, and off by default: droop, thickness, foot, keeping clear of the log, and the collisions `pressed`. Off, they leave the
//! thesis's mesh as it is, bit for bit.
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
//! // Individual k owns these indices, three per triangle, and vertex i of it is on ring i / c + 1 of its inner sheet.
//! let mesh = generator.mesh();
//! let one = mesh.individual_starts[0] as usize..mesh.individual_starts[1] as usize;
//! assert!(mesh.indices[one].iter().all(|&v| v < mesh.vertex_starts[1]));
//! # Ok::<(), rock_field::Error>(())
//! ```
//!
//! # Limits
//!
//! With `thesis` a few pairs may stay crossed: a later pair can disturb an earlier one (K9). With a thickness the thesis's rule looks at the inner
//! sheets alone. `pressed` leaves none crossing, but does not look at a body's own parts: a strongly wrinkled, thick sheet may touch
//! itself. A log of the user's own has to be closed to be kept clear of.

mod body;
mod bowl;
mod circle;
mod crossing;
mod deform;
mod feet;
mod generator;
mod grid;
mod ground;
mod log;
mod memory;
mod mesh;
mod pairs;
mod pose;
mod press;
mod settle;
mod shape;
mod spawn;
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
