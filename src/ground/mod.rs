//! The ground around rocks as a mesh: a constrained Delaunay triangulation through their outlines at z = 0.
//!
//! A rock stands on the ground with its rim, or is sunk into it; its outline is where its surface begins to be above
//! z = 0. Outlines of several rocks may touch, share edges and cross each other, and may leave the image. The ground is
//! the image without what is inside of any outline, or all of the image. Its vertices are those of the outlines, the
//! corners of the image, and the points where outlines cross. No others are added, so that triangles are large where
//! there is nothing.
//!
//! [`spade`] triangulates: it splits constraints that cross each other, and its predicates are exact.

mod noding;
mod outlines;
mod sheet;
#[cfg(test)]
mod tests;

use outlines::Outlines;
pub use sheet::Sheet;

/// Collects the outlines of rocks and triangulates the ground around them.
#[derive(Debug)]
pub struct Ground {
    size: [f32; 2],
    outlines: Outlines,
}

impl Ground {
    /// Starts the ground of an image of `width` × `height` px.
    pub fn new(width: u32, height: u32) -> Self {
        Ground { size: [width as f32, height as f32], outlines: Outlines::default() }
    }

    /// Adds rocks, which may be some of a [`crate::Mesh`]. Rock k owns the vertices `vertex_starts[k] ..
    /// vertex_starts[k + 1]` and the indices `rock_starts[k] .. rock_starts[k + 1]`. The numbers may count from any
    /// vertex and index on: the first elements of the lists belong to the first rock.
    pub fn add(&mut self, positions: &[f32], indices: &[u32], vertex_starts: &[u32], rock_starts: &[u32]) {
        let (Some(&first_vertex), Some(&first_index)) = (vertex_starts.first(), rock_starts.first()) else {
            return;
        };
        for (vertices, corners) in vertex_starts.windows(2).zip(rock_starts.windows(2)) {
            let [from, to] = [vertices[0], vertices[1]].map(|v| 3 * (v - first_vertex) as usize);
            let [begin, end] = [corners[0], corners[1]].map(|i| (i - first_index) as usize);
            self.outlines.add(&positions[from..to], &indices[begin..end], vertices[0]);
        }
    }

    /// Returns the ground, with `cut` without what is inside of the outlines.
    pub fn sheet(&self, cut: bool) -> Sheet {
        sheet::triangulate(&self.outlines, self.size, cut)
    }
}
