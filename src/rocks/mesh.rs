//! The flat buffers of a field. This is the only place in the rocks' code where f64 becomes f32.

use glam::{DVec2, DVec3};

/// The rocks of a field as one indexed mesh.
///
/// Rock k owns `indices[rock_starts[k] .. rock_starts[k + 1]]` and the vertices `vertex_starts[k] .. vertex_starts[k +
/// 1]`: first n rim vertices at z = 0, then n top vertices. Vertex v stands at `positions[3·v .. 3·v + 3]`, px, z up.
/// Triangles are counter-clockwise seen from above before displacement. A rock that is subdivided has a power of two
/// times as many rim vertices, and the rim of a rock that is weathered or embedded lies below the ground.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// 3 per vertex, px.
    pub positions: Vec<f32>,
    /// 3 per vertex, unit length: the area-weighted mean over the adjacent faces, or (0, 0, 1) if they cancel. If
    /// weathering has put the faces at the rim of a subdivided rock below the ground, those count for the rim vertices
    /// only.
    pub normals: Vec<f32>,
    /// 3 per triangle.
    pub indices: Vec<u32>,
    /// rocks + 1 offsets into `indices`.
    pub rock_starts: Vec<u32>,
    /// rocks + 1 offsets into the vertices.
    pub vertex_starts: Vec<u32>,
    /// Per rock, the index of the layer it belongs to.
    pub rock_layer: Vec<u8>,
}

/// Numbers of rocks, vertices and triangles: where something begins in the buffers, or how much room it takes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Extent {
    pub(crate) rocks: usize,
    pub(crate) vertices: usize,
    pub(crate) triangles: usize,
}

impl Mesh {
    /// Number of rocks.
    pub fn rocks(&self) -> usize {
        self.rock_layer.len()
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.indices.len() / 3
    }

    /// Bytes allocated for positions, normals and indices, whether they are filled or not.
    pub(crate) fn bytes(&self) -> [usize; 3] {
        [self.positions.capacity(), self.normals.capacity(), self.indices.capacity()].map(|n| 4 * n)
    }

    /// Makes room for exactly `total`. What is written already stays where it is.
    pub(crate) fn resize(&mut self, total: Extent) {
        // Buffers grow to the exact size, because doubling would make the peak of a large field far larger than needed.
        fn fit<T: Copy>(buffer: &mut Vec<T>, len: usize, value: T) {
            buffer.reserve_exact(len.saturating_sub(buffer.len()));
            buffer.resize(len, value);
        }
        fit(&mut self.positions, 3 * total.vertices, 0.0);
        fit(&mut self.normals, 3 * total.vertices, 0.0);
        fit(&mut self.indices, 3 * total.triangles, 0);
        fit(&mut self.rock_starts, total.rocks + 1, 0);
        fit(&mut self.vertex_starts, total.rocks + 1, 0);
        fit(&mut self.rock_layer, total.rocks, 0);
        self.rock_starts[total.rocks] = 3 * total.triangles as u32;
        self.vertex_starts[total.rocks] = total.vertices as u32;
    }

    /// Writes one rock at `at`, and moves `at` to the end of it.
    pub(crate) fn write_rock(&mut self, at: &mut Extent, layer: u8, rock: &RockBuilder, triangles: &[[u16; 3]]) {
        let count = rock.points.len();
        self.rock_layer[at.rocks] = layer;
        self.rock_starts[at.rocks] = 3 * at.triangles as u32;
        self.vertex_starts[at.rocks] = at.vertices as u32;
        let range = 3 * at.vertices..3 * (at.vertices + count);
        for (slot, point) in self.positions[range].chunks_exact_mut(3).zip(&rock.points) {
            slot.copy_from_slice(&point.as_vec3().to_array());
        }
        self.write_normals(at.vertices, rock);
        let base = at.vertices as u32;
        let range = 3 * at.triangles..3 * (at.triangles + triangles.len());
        for (slot, triangle) in self.indices[range].chunks_exact_mut(3).zip(triangles) {
            slot.copy_from_slice(&triangle.map(|v| base + u32::from(v)));
        }
        at.rocks += 1;
        at.vertices += count;
        at.triangles += triangles.len();
    }

    /// Writes the normals of a rock whose vertices begin with number `first`.
    #[inline(never)]
    pub(crate) fn write_normals(&mut self, first: usize, rock: &RockBuilder) {
        let range = 3 * first..3 * (first + rock.normals.len());
        for (slot, normal) in self.normals[range].chunks_exact_mut(3).zip(&rock.normals) {
            slot.copy_from_slice(&normal.normalize_or(DVec3::Z).as_vec3().to_array());
        }
    }
}

/// The vertices and summed face normals of one rock. Re-used from rock to rock.
#[derive(Debug, Default)]
pub(crate) struct RockBuilder {
    pub(crate) points: Vec<DVec3>,
    normals: Vec<DVec3>,
}

impl RockBuilder {
    /// Starts a rock, with its rim on the ground.
    pub(crate) fn start(&mut self, rim: &[DVec2]) {
        self.points.clear();
        self.points.extend(rim.iter().map(|v| v.extend(0.0)));
    }

    /// Sums the face normals at the vertices, weighted by area: these are the cross products before normalisation.
    ///
    /// A face at the rim of a worn rock lies below the ground and is not visible. Its normal counts only at the first
    /// `buried` vertices.
    #[inline(never)]
    pub(crate) fn finish(&mut self, triangles: &[[u16; 3]], buried: usize) {
        self.normals.clear();
        self.normals.resize(self.points.len(), DVec3::ZERO);
        for triangle in triangles {
            let [a, b, c] = triangle.map(usize::from);
            let origin = self.points[a];
            let normal = (self.points[b] - origin).cross(self.points[c] - origin);
            let at_rim = a.min(b).min(c) < buried;
            for v in [a, b, c] {
                if !at_rim || v < buried {
                    self.normals[v] += normal;
                }
            }
        }
    }
}
