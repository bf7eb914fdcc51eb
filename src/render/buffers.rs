//! The buffers of one mesh on the device: of all rocks of a field, of a log, or of a colony.

use glam::Vec3;

use super::{Gpu, RenderError, upload};

/// A mesh in JavaScript's memory, which is read one slice at a time.
pub(crate) struct Mesh<'a> {
    /// 3v coordinates.
    pub(crate) positions: &'a js_sys::Float32Array,
    /// 3v coordinates.
    pub(crate) normals: &'a js_sys::Float32Array,
    /// 3t vertex numbers.
    pub(crate) indices: &'a js_sys::Uint32Array,
}

impl Mesh<'_> {
    pub(crate) fn vertices(&self) -> u32 {
        self.positions.length() / 3
    }

    /// Calls `see` with the position and the normal of every vertex, in their order.
    pub(crate) fn each_vertex(&self, mut see: impl FnMut(Vec3, Vec3)) {
        const SLICE: u32 = 3 * 4096;
        let [mut positions, mut normals] = [(); 2].map(|()| vec![0.0; SLICE as usize]);
        let length = 3 * self.vertices();
        for start in (0..length).step_by(SLICE as usize) {
            let count = SLICE.min(length - start);
            for (all, slice) in [(self.positions, &mut positions), (self.normals, &mut normals)] {
                slice.truncate(count as usize);
                all.subarray(start, start + count).copy_to(slice);
            }
            for (position, normal) in positions.chunks_exact(3).zip(normals.chunks_exact(3)) {
                see(Vec3::from_slice(position), Vec3::from_slice(normal));
            }
        }
    }
}

/// The buffers of a [`Mesh`], with four bytes of colour or paint per vertex.
pub(crate) struct MeshBuffers {
    positions: wgpu::Buffer,
    normals: wgpu::Buffer,
    colors: wgpu::Buffer,
    indices: wgpu::Buffer,
    vertex_count: u32,
    index_count: u32,
    /// Two vertex numbers per edge. Made when the wireframe is first shown.
    edges: Option<wgpu::Buffer>,
}

impl Drop for MeshBuffers {
    /// Without this, a WebGPU buffer lives until JavaScript collects it, which is too late while a slider is dragged.
    fn drop(&mut self) {
        let buffers = [&self.positions, &self.normals, &self.colors, &self.indices];
        buffers.into_iter().chain(&self.edges).for_each(wgpu::Buffer::destroy);
    }
}

impl MeshBuffers {
    /// Uploads `mesh`, whose vertices are first moved by `place`, in their order. The colours follow with
    /// [`MeshBuffers::paint`]. `kind` stands in the buffers' labels.
    pub(crate) fn new(
        gpu: &Gpu,
        kind: &str,
        mesh: &Mesh<'_>,
        mut place: impl FnMut(Vec3) -> Vec3,
    ) -> Result<Self, RenderError> {
        let vertex_count = mesh.vertices();
        let index_count = mesh.indices.length() / 3 * 3;
        if mesh.normals.length() != mesh.positions.length() {
            return Err(RenderError::Malformed("positions and normals disagree"));
        }
        let make = |name, what, elements: u32, usage| {
            let label = ["rock-field/", kind, name].concat();
            upload::buffer(&gpu.device, &label, what, 4 * u64::from(elements), usage)
        };
        let vertex = wgpu::BufferUsages::VERTEX;
        let positions = make("/positions", "vertices", 3 * vertex_count, vertex)?;
        let normals = make("/normals", "normals", vertex_count, vertex)?;
        let colors = make("/colors", "colours", vertex_count, vertex)?;
        let indices = make("/indices", "triangles", index_count, wgpu::BufferUsages::INDEX)?;
        upload::write::<f32>(&gpu.queue, &positions, 3 * vertex_count, |start, slice| {
            mesh.positions.subarray(start, start + slice.len() as u32).copy_to(slice);
            for vertex in slice.chunks_exact_mut(3) {
                let at = place(Vec3::from_slice(vertex));
                vertex.copy_from_slice(&at.to_array());
            }
        });
        upload_normals(gpu, &normals, vertex_count, mesh.normals);
        let mut highest = 0;
        upload::write::<u32>(&gpu.queue, &indices, index_count, |start, slice| {
            mesh.indices.subarray(start, start + slice.len() as u32).copy_to(slice);
            highest = slice.iter().fold(highest, |most, &index| most.max(index));
        });
        // WebGL2 would refuse to draw without saying why.
        if index_count > 0 && highest >= vertex_count {
            return Err(RenderError::Malformed("an index points past the vertices"));
        }
        Ok(Self { positions, normals, colors, indices, vertex_count, index_count, edges: None })
    }

    /// Gives every vertex, in their order, the four bytes that `color` returns for its number.
    pub(crate) fn paint(&self, gpu: &Gpu, mut color: impl FnMut(u32) -> u32) {
        upload::write::<u32>(&gpu.queue, &self.colors, self.vertex_count, |start, slice| {
            for (vertex, out) in (start..).zip(slice) {
                *out = color(vertex);
            }
        });
    }

    pub(crate) fn vertices(&self) -> u32 {
        self.vertex_count
    }

    /// Whether there is nothing to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.index_count == 0
    }

    pub(crate) fn has_edges(&self) -> bool {
        self.edges.is_some()
    }

    /// Makes the line list of every triangle's edges. `indices` must be those of the mesh.
    pub(crate) fn set_edges(&mut self, gpu: &Gpu, indices: &js_sys::Uint32Array) -> Result<(), RenderError> {
        if indices.length() / 3 * 3 != self.index_count {
            return Err(RenderError::Malformed("edges of another mesh"));
        }
        self.edges = Some(upload::edges(gpu, indices)?);
        Ok(())
    }

    /// Draws all triangles at once.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        self.draw_indexed(pass, pipeline, &self.indices, self.index_count);
    }

    /// Draws all edges at once, or nothing before [`MeshBuffers::set_edges`].
    pub(crate) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        if let Some(edges) = &self.edges {
            self.draw_indexed(pass, pipeline, edges, 2 * self.index_count);
        }
    }

    fn draw_indexed(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        indices: &wgpu::Buffer,
        count: u32,
    ) {
        if count == 0 {
            return;
        }
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.colors.slice(..));
        pass.set_vertex_buffer(2, self.normals.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..count, 0, 0..1);
    }
}

/// Uploads normals, each as two 16-bit numbers: the unfolded faces of an octahedron (Cigolle et al., *A survey of
/// efficient representations for independent unit vectors*, 2014). With 8 bits each, bands would show on a smooth
/// boulder.
fn upload_normals(gpu: &Gpu, buffer: &wgpu::Buffer, count: u32, normals: &js_sys::Float32Array) {
    let mut scratch = Vec::new();
    upload::write::<u32>(&gpu.queue, buffer, count, |start, slice| {
        scratch.resize(slice.len() * 3, 0.0);
        normals.subarray(3 * start, 3 * (start + slice.len() as u32)).copy_to(&mut scratch);
        for (normal, out) in scratch.chunks_exact(3).zip(slice) {
            if let &[x, y, z] = normal {
                *out = octahedral(Vec3::new(x, y, z));
            }
        }
    });
}

fn octahedral(normal: Vec3) -> u32 {
    let flat = normal / normal.abs().element_sum();
    let sign = |value: f32| if value < 0.0 { -1.0 } else { 1.0 };
    let [x, y] = if flat.z < 0.0 {
        [(1.0 - flat.y.abs()) * sign(flat.x), (1.0 - flat.x.abs()) * sign(flat.y)]
    } else {
        [flat.x, flat.y]
    };
    // The cast turns NaN into 0.
    let bits = |value: f32| u32::from((value * 32767.0).round() as i16 as u16);
    bits(x) | bits(y) << 16
}
