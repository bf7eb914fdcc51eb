//! Wood-ear colonies on a fallen log: log → spawn → deform → collide → mesh.
//!
//! The method is that of Nishimura's bachelor thesis on kikurage growing in colonies on a fallen log (fiscal 2012); where it is
//! silent or inconsistent the deciding item says so (*decision K1* …). Droop, thickness, foot, clearing the log and the rule
//! `pressed` are additions; off, they leave the thesis's mesh as it is, bit for bit.

mod body;
mod bowl;
mod circle;
mod crossing;
mod deform;
mod generator;
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
