//! The colony's flat buffers. This is the only place in the colony's code where f64 becomes f32.

use glam::{DVec3, Vec3};

use super::body::Layout;
use super::work::tally;

/// A colony as one indexed mesh. All individuals have the same number of vertices and triangles.
///
/// Individual k owns `indices[individual_starts[k] .. individual_starts[k + 1]]` and the vertices `vertex_starts[k] ..
/// vertex_starts[k + 1]`. Vertex v stands at `positions[3·v .. 3·v + 3]`, cm, z up. With d rings of c vertices, vertex
/// number i within an individual is:
///
/// | i | what |
/// |---|---|
/// | (e − 1)·c + f − 1, e = 1 … d | the inner sheet, the thesis's; e = d is its rim |
/// | d·c + j·c + f − 1, j = 0, 1 | only with a thickness: the rounded rim, from the inner sheet to the outer |
/// | (d + 2)·c + (e − 1)·c + f − 1 | only with a thickness: the outer sheet |
/// | then c, 1 and, with a thickness, 1 | only with a foot: the stalk's ring, its tip in the log, the floor inside |
///
/// Triangles are counter-clockwise seen from inside the bowl or, with a thickness, from outside the closed body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ColonyMesh {
    /// 3 per vertex, cm.
    pub positions: Vec<f32>,
    /// 3 per vertex, unit: area-weighted over the adjacent faces.
    pub normals: Vec<f32>,
    /// 3 per triangle.
    pub indices: Vec<u32>,
    /// individuals + 1 offsets into `indices`.
    pub individual_starts: Vec<u32>,
    /// individuals + 1 offsets into the vertices.
    pub vertex_starts: Vec<u32>,
    /// Per individual, the vertex of the log that it stands on; on a log given by the user, the number of the triangle
    /// in the mesh as it was given.
    pub foot: Vec<u32>,
    /// Per individual, its size: the rim radius before drying, cm.
    pub size: Vec<f32>,
    /// Per individual, the index of the base it belongs to.
    pub base: Vec<u8>,
}

impl ColonyMesh {
    /// Number of individuals.
    pub fn individuals(&self) -> usize {
        self.foot.len()
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.indices.len() / 3
    }

    /// Makes room for exactly this many individuals, and fills in everything that does not depend on their shapes:
    /// indices and offsets.
    pub(super) fn resize(&mut self, individuals: usize, layout: &Layout) {
        fn fit<T: Copy>(buffer: &mut Vec<T>, len: usize, value: T) {
            // Much larger buffers are freed instead of being kept.
            if buffer.capacity() > len + len / 8 {
                *buffer = Vec::new();
            }
            buffer.reserve_exact(len.saturating_sub(buffer.len()));
            buffer.resize(len, value);
        }
        let [vertices, corners] = [usize::from(layout.vertices), 3 * layout.triangles.len()];
        fit(&mut self.positions, 3 * vertices * individuals, 0.0);
        fit(&mut self.normals, 3 * vertices * individuals, 0.0);
        fit(&mut self.indices, corners * individuals, 0);
        fit(&mut self.foot, individuals, 0);
        fit(&mut self.size, individuals, 0.0);
        fit(&mut self.base, individuals, 0);
        let starts = |step: usize| (0..=individuals).map(|k| (k * step) as u32).collect::<Vec<u32>>();
        self.individual_starts = starts(corners);
        self.vertex_starts = starts(vertices);
        if corners > 0 {
            for (base, slots) in (0_u32..).step_by(vertices).zip(self.indices.chunks_exact_mut(corners)) {
                for (slot, v) in slots.iter_mut().zip(layout.triangles.as_flattened()) {
                    *slot = base + u32::from(*v);
                }
            }
        }
    }
}

/// Computes the normals of one body from its positions. `sums` is scratch space.
pub(super) fn shade(layout: &Layout, positions: &[f32], normals: &mut [f32], sums: &mut Vec<DVec3>) {
    let at = |v: u16| Vec3::from_slice(&positions[3 * usize::from(v)..]).as_dvec3();
    tally(20 * layout.triangles.len());
    sums.clear();
    sums.resize(usize::from(layout.vertices), DVec3::ZERO);
    for triangle in &layout.triangles {
        let [a, b, c] = triangle.map(at);
        let normal = (b - a).cross(c - a);
        for v in triangle {
            sums[usize::from(*v)] += normal;
        }
    }
    for (slot, sum) in normals.chunks_exact_mut(3).zip(sums.iter()) {
        slot.copy_from_slice(&sum.normalize_or(DVec3::Z).as_vec3().to_array());
    }
}

/// Writes points as f32, three numbers each.
pub(super) fn write(slots: &mut [f32], points: impl Iterator<Item = DVec3>) {
    for (slot, point) in slots.chunks_exact_mut(3).zip(points) {
        slot.copy_from_slice(&point.as_vec3().to_array());
    }
}

/// The log's flat buffers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LogMesh {
    /// 3 per vertex, cm, z up.
    pub positions: Vec<f32>,
    /// 3 per vertex, unit.
    pub normals: Vec<f32>,
    /// 3 per triangle, counter-clockwise seen from outside.
    pub indices: Vec<u32>,
    /// Per vertex, what it is made of: 0 bark, 1 end grain, 2 a splinter. All 0 on a log given by the user.
    pub kinds: Vec<u8>,
    /// 2 per vertex, cm: place along the log's axis, and distance from it (for growth rings). All 0 on a log given by
    /// the user.
    pub coords: Vec<f32>,
}

impl LogMesh {
    /// The corners of a triangle, cm.
    #[inline]
    pub(super) fn corners(&self, triangle: usize) -> [DVec3; 3] {
        [0, 1, 2].map(|k| place(&self.positions, self.indices[3 * triangle + k]).as_dvec3())
    }

    /// The corners of all triangles, cm.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        (0..self.indices.len() / 3).map(|triangle| self.corners(triangle))
    }
}

/// The position of a vertex in a flat list.
#[inline]
pub(super) fn place(positions: &[f32], vertex: u32) -> Vec3 {
    Vec3::from_slice(&positions[3 * vertex as usize..])
}

impl From<&super::Log> for LogMesh {
    fn from(log: &super::Log) -> LogMesh {
        let flat = |points: &[DVec3]| {
            let mut slots = vec![0.0; 3 * points.len()];
            write(&mut slots, points.iter().copied());
            slots
        };
        LogMesh {
            positions: flat(&log.points),
            normals: flat(&log.normals),
            indices: log.triangles.as_flattened().to_vec(),
            kinds: log.kinds.clone(),
            coords: log.coords.as_flattened().to_vec(),
        }
    }
}
