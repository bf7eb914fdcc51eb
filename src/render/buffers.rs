//! The buffers of one mesh on the device: of all rocks of a field, of a log, or of a colony.

use std::ops::Range;

use glam::Vec3;

use super::{Gpu, RenderError, upload};

/// Buffers end with a whole row of so many vertices, since textures have them in rows when it is found out what each sees of the sky.
pub(crate) const ROW: u32 = 512;

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
}

/// The vertices of a [`Mesh`], with four bytes of colour or paint for each.
pub(crate) struct VertexBuffers {
    positions: wgpu::Buffer,
    normals: wgpu::Buffer,
    colors: wgpu::Buffer,
    count: u32,
}

impl Drop for VertexBuffers {
    /// Without this, a WebGPU buffer lives until JavaScript collects it, which is too late while a slider is dragged.
    fn drop(&mut self) {
        [&self.positions, &self.normals, &self.colors].into_iter().for_each(wgpu::Buffer::destroy);
    }
}

impl VertexBuffers {
    /// Uploads the vertices of `mesh`, which are first moved by `place`, in their order. The colours follow with
    /// [`MeshBuffers::paint`]. `kind` stands in the buffers' labels.
    pub(crate) fn new(
        gpu: &Gpu,
        kind: &str,
        mesh: &Mesh<'_>,
        mut place: impl FnMut(Vec3) -> Vec3,
    ) -> Result<Self, RenderError> {
        let buffers = Self::empty(gpu, kind, mesh)?;
        buffers.fill(gpu, mesh, 0..buffers.count, &mut |position, _| place(position));
        Ok(buffers)
    }

    /// Makes room for the vertices of `mesh`, which [`VertexBuffers::fill`] uploads.
    pub(crate) fn empty(gpu: &Gpu, kind: &str, mesh: &Mesh<'_>) -> Result<Self, RenderError> {
        let count = mesh.vertices();
        if mesh.normals.length() != mesh.positions.length() {
            return Err(RenderError::Malformed("positions and normals disagree"));
        }
        let make = |name, what, each| buffer(gpu, &["rock-field/", kind, name].concat(), what, count, each);
        let positions = make("/positions", "vertices", 3)?;
        let normals = make("/normals", "normals", 1)?;
        let colors = make("/colors", "colours", 1)?;
        Ok(Self { positions, normals, colors, count })
    }

    /// Uploads some of the vertices of `mesh`, in their order, each to where `place` moves what it is given: the position, and the normal.
    pub(crate) fn fill(
        &self,
        gpu: &Gpu,
        mesh: &Mesh<'_>,
        Range { start, end }: Range<u32>,
        place: &mut dyn FnMut(Vec3, Vec3) -> Vec3,
    ) {
        let mut normals = Vec::new();
        upload::write_part::<f32>(&gpu.queue, &self.positions, 3 * start..3 * end, &mut |start, slice| {
            normals.resize(slice.len(), 0.0);
            for (all, part) in [(mesh.positions, &mut *slice), (mesh.normals, normals.as_mut_slice())] {
                all.subarray(start, start + part.len() as u32).copy_to(part);
            }
            for (vertex, normal) in slice.chunks_exact_mut(3).zip(normals.chunks_exact(3)) {
                let at = place(Vec3::from_slice(vertex), Vec3::from_slice(normal));
                vertex.copy_from_slice(&at.to_array());
            }
            upload::write_part::<u32>(
                &gpu.queue,
                &self.normals,
                start / 3..(start + slice.len() as u32) / 3,
                &mut |from, out| {
                    let normals = normals.chunks_exact(3).skip((from - start / 3) as usize);
                    normals.zip(out).for_each(|(normal, out)| *out = octahedral(Vec3::from_slice(normal)));
                },
            );
        });
    }
}

/// The buffers of a [`Mesh`].
pub(crate) struct MeshBuffers {
    vertices: VertexBuffers,
    indices: wgpu::Buffer,
    index_count: u32,
    /// Two vertex numbers per edge. Made when the wireframe is first shown.
    edges: Option<wgpu::Buffer>,
    /// What each vertex sees of the sky, four bytes, if the mesh is one of rocks.
    open: Option<wgpu::Buffer>,
}

impl Drop for MeshBuffers {
    /// As of the vertices.
    fn drop(&mut self) {
        std::iter::once(&self.indices).chain(&self.edges).chain(&self.open).for_each(wgpu::Buffer::destroy);
    }
}

impl MeshBuffers {
    /// Uploads the triangles of `mesh`, whose `vertices` are uploaded already.
    pub(crate) fn new(gpu: &Gpu, kind: &str, vertices: VertexBuffers, mesh: &Mesh<'_>) -> Result<Self, RenderError> {
        let count = mesh.indices.length() / 3 * 3;
        let indices = Self::index_buffer(gpu, kind, count)?;
        let mut highest = 0;
        upload::write::<u32>(&gpu.queue, &indices, count, |start, slice| {
            mesh.indices.subarray(start, start + slice.len() as u32).copy_to(slice);
            highest = slice.iter().fold(highest, |most, &index| most.max(index));
        });
        Self::with_indices(vertices, mesh, indices, highest)
    }

    /// As [`MeshBuffers::new`], with triangles of `mesh` that lie in `indices` already, `highest` being the highest index.
    pub(crate) fn with_indices(
        vertices: VertexBuffers,
        mesh: &Mesh<'_>,
        indices: wgpu::Buffer,
        highest: u32,
    ) -> Result<Self, RenderError> {
        let index_count = mesh.indices.length() / 3 * 3;
        // WebGL2 would refuse to draw without saying why.
        if index_count > 0 && highest >= vertices.count {
            return Err(RenderError::Malformed("an index points past the vertices"));
        }
        Ok(Self { vertices, indices, index_count, edges: None, open: None })
    }

    /// Makes a buffer for so many indices.
    pub(crate) fn index_buffer(gpu: &Gpu, kind: &str, count: u32) -> Result<wgpu::Buffer, RenderError> {
        let label = ["rock-field/", kind, "/indices"].concat();
        upload::buffer(&gpu.device, &label, "triangles", 4 * u64::from(count), wgpu::BufferUsages::INDEX)
    }

    /// Gives every vertex, in their order, the four bytes that `color` returns for its number.
    pub(crate) fn paint(&self, gpu: &Gpu, mut color: impl FnMut(u32) -> u32) {
        upload::write::<u32>(&gpu.queue, &self.vertices.colors, self.vertices.count, |start, slice| {
            for (vertex, out) in (start..).zip(slice) {
                *out = color(vertex);
            }
        });
    }

    pub(crate) fn vertices(&self) -> u32 {
        self.vertices.count
    }

    /// The buffers of the vertices.
    pub(crate) fn vertex_buffers(&self) -> &VertexBuffers {
        &self.vertices
    }

    /// The buffer of the indices.
    pub(crate) fn indices(&self) -> &wgpu::Buffer {
        &self.indices
    }

    /// Whether there is nothing to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.index_count == 0
    }

    /// Adds room for what each vertex sees of the sky.
    pub(crate) fn add_open(&mut self, gpu: &Gpu) -> Result<(), RenderError> {
        self.open = Some(buffer(gpu, "rock-field/rock/open", "vertices", self.vertices(), 1)?);
        Ok(())
    }

    /// Positions, normals and colours of the vertices, and how many times four bytes each has.
    pub(crate) fn each(&self) -> [(&wgpu::Buffer, u32); 3] {
        let VertexBuffers { positions, normals, colors, .. } = &self.vertices;
        [(positions, 3), (normals, 1), (colors, 1)]
    }

    pub(crate) fn open(&self) -> Option<&wgpu::Buffer> {
        self.open.as_ref()
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

    /// Draws all triangles of the mesh, if they lie in the buffer as they came.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        self.draw_ranges(pass, pipeline, std::slice::from_ref(&(0..self.index_count)));
    }

    /// Draws what lies in these ranges of the index buffer.
    pub(crate) fn draw_ranges(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        ranges: &[Range<u32>],
    ) {
        self.draw_indexed(pass, pipeline, &self.indices, ranges);
    }

    /// Draws all edges at once, or nothing before [`MeshBuffers::set_edges`].
    pub(crate) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        if let Some(edges) = &self.edges {
            self.draw_indexed(pass, pipeline, edges, std::slice::from_ref(&(0..2 * self.index_count)));
        }
    }

    fn draw_indexed(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        indices: &wgpu::Buffer,
        ranges: &[Range<u32>],
    ) {
        if ranges.iter().all(Range::is_empty) {
            return;
        }
        let VertexBuffers { positions, normals, colors, .. } = &self.vertices;
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, positions.slice(..));
        pass.set_vertex_buffer(1, colors.slice(..));
        pass.set_vertex_buffer(2, normals.slice(..));
        if let Some(open) = &self.open {
            pass.set_vertex_buffer(3, open.slice(..));
        }
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        for range in ranges {
            pass.draw_indexed(range.clone(), 0, 0..1);
        }
    }
}

/// A buffer with `each` times four bytes a vertex, for whole rows of vertices.
fn buffer(gpu: &Gpu, label: &str, what: &'static str, count: u32, each: u32) -> Result<wgpu::Buffer, RenderError> {
    let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC;
    let bytes = 4 * u64::from(each) * u64::from(count).next_multiple_of(u64::from(ROW));
    upload::buffer(&gpu.device, label, what, bytes, usage)
}

/// A normal as two 16-bit numbers: the unfolded faces of an octahedron (Cigolle et al., *A survey of efficient representations for independent unit
/// vectors*, 2014). With 8 bits each, bands would show on a smooth boulder.
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
