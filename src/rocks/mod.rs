//! The rock method: sites → cells → selection → shape → mesh. Numbers such as A9 refer to docs/decisions.md.

mod apart;
mod bitmap;
mod body;
mod budget;
mod cache;
pub(crate) mod cell;
mod field;
mod footprint;
mod generator;
mod given;
mod grid;
mod grow;
#[cfg(feature = "bench")]
pub(crate) mod literal;
pub(crate) mod memory;
pub(crate) mod mesh;
mod mesher;
mod net;
#[cfg_attr(not(feature = "full"), path = "unpainted.rs")]
mod paint;
mod relief;
mod select;
mod shape;
mod sites;
mod spans;
mod stone;
mod subdivide;
mod triangulate;
mod voronoi;
mod wear;
mod work;
mod wrap;

pub use bitmap::Pixel;
pub use cache::LayerView;
pub use field::{Field, FieldLayer};
pub use generator::{Generator, generate};
pub use grow::{Outlines, grow};
pub use select::{Selection, Threshold, select};
pub use shape::{Shapes, displace};
pub use sites::{Sites, accept_picks, target_sites};
pub use spans::cell_pixels;
pub use triangulate::triangulate;
pub use voronoi::{Cells, voronoi};
pub(crate) use wear::Wear;
