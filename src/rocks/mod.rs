//! The rock method: sites → cells → selection → shape → mesh. Numbers such as A9 refer to docs/decisions.md.

mod body;
mod budget;
mod cache;
mod cell;
mod field;
mod footprint;
mod generator;
mod grid;
mod mesher;
mod select;
mod shape;
mod sites;
mod subdivide;
mod triangulate;
mod voronoi;
mod wear;
mod wrap;

pub use cache::LayerView;
pub use field::{Field, FieldLayer, generate};
pub use generator::Generator;
pub use select::{Selection, Threshold, cell_pixels, select};
pub use shape::{Shapes, displace};
pub use sites::{Pixel, Sites, accept_picks, target_sites};
pub(crate) use subdivide::counts as worn_counts;
pub use triangulate::triangulate;
pub use voronoi::{Cells, voronoi};
pub(crate) use wear::Wear;
