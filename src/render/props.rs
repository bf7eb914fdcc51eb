//! Props, that is things that stand among the rocks: a fallen log, and wood ears that grow on it. Each is one mesh and
//! one draw.

use glam::Vec3;

use super::scene::upload_normals;
use super::wood::{self, Axis, Ears};
use super::{Gpu, RenderError, upload};

/// Where a prop stands: its origin in px of the world, and the px per cm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    origin: Vec3,
    scale: f32,
}

impl Place {
    /// `values` holds x, y, z and the scale. Values that are missing or not finite are replaced: coordinates by 0, the
    /// scale by 1 px per cm.
    pub(crate) fn new(values: &[f32]) -> Self {
        let value = |at: usize| values.get(at).copied().filter(|value| value.is_finite());
        let origin = [0, 1, 2].map(|at| value(at).unwrap_or(0.0));
        Self { origin: origin.into(), scale: value(3).filter(|&scale| scale > 0.0).unwrap_or(1.0) }
    }
}

/// A closed or open mesh in cm, in JavaScript's memory.
pub(crate) struct PropMesh<'a> {
    /// 3v coordinates.
    pub(crate) positions: &'a js_sys::Float32Array,
    /// 3v coordinates.
    pub(crate) normals: &'a js_sys::Float32Array,
    /// 3t vertex numbers.
    pub(crate) indices: &'a js_sys::Uint32Array,
}

/// Buffers of a log or of a colony.
pub(crate) struct Prop {
    positions: wgpu::Buffer,
    normals: wgpu::Buffer,
    painted: wgpu::Buffer,
    /// The axis, if it is a log, px.
    axis: Option<Axis>,
    /// True for wood ears that are closed bodies, whose faces are not seen from inside.
    closed: bool,
    indices: wgpu::Buffer,
    index_count: u32,
    /// The lines of the wireframe, made when it is first shown.
    edges: Option<wgpu::Buffer>,
    low: Vec3,
    high: Vec3,
}

impl Drop for Prop {
    /// Buffers are not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        let buffers = [&self.positions, &self.normals, &self.painted, &self.indices];
        buffers.into_iter().chain(&self.edges).for_each(wgpu::Buffer::destroy);
    }
}

impl Prop {
    /// Uploads a log. `kinds` has one entry per vertex.
    pub(crate) fn log(gpu: &Gpu, place: Place, mesh: &PropMesh<'_>, kinds: &[u8]) -> Result<Self, RenderError> {
        let points = mesh.positions.to_vec();
        if 3 * kinds.len() != points.len() {
            return Err(RenderError::Malformed("kinds of another log"));
        }
        let painted = |vertex: u32| wood::painted(kinds.get(vertex as usize).copied().unwrap_or(0));
        let mut log = Self::new(gpu, place, mesh, painted)?;
        log.axis = Some(Axis::of(&points, kinds).placed(place.origin, place.scale));
        Ok(log)
    }

    pub(crate) fn colony(gpu: &Gpu, place: Place, mesh: &PropMesh<'_>, ears: &Ears) -> Result<Self, RenderError> {
        let each = mesh.positions.length() / 3 / (ears.keys.len() as u32).max(1);
        if each * ears.keys.len() as u32 * 3 != mesh.positions.length() {
            return Err(RenderError::Malformed("individuals of different size"));
        }
        let mut colony = Self::new(gpu, place, mesh, |vertex| ears.painted(vertex, each.max(1)))?;
        colony.closed = ears.is_closed(each);
        Ok(colony)
    }

    fn new(gpu: &Gpu, place: Place, mesh: &PropMesh<'_>, painted: impl Fn(u32) -> u32) -> Result<Self, RenderError> {
        let vertices = mesh.positions.length() / 3;
        let index_count = mesh.indices.length() / 3 * 3;
        if mesh.normals.length() != mesh.positions.length() {
            return Err(RenderError::Malformed("positions and normals disagree"));
        }
        let make = |label, what, elements: u32, usage| {
            upload::buffer(&gpu.device, label, what, 4 * u64::from(elements), usage)
        };
        let vertex = wgpu::BufferUsages::VERTEX;
        let positions = make("rock-field/prop/positions", "vertices", 3 * vertices, vertex)?;
        let normals = make("rock-field/prop/normals", "normals", vertices, vertex)?;
        let colors = make("rock-field/prop/painted", "colours", vertices, vertex)?;
        let indices = make("rock-field/prop/indices", "triangles", index_count, wgpu::BufferUsages::INDEX)?;
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        upload::write::<f32>(&gpu.queue, &positions, 3 * vertices, |start, slice| {
            mesh.positions.subarray(start, start + slice.len() as u32).copy_to(slice);
            for vertex in slice.chunks_exact_mut(3) {
                let at = Vec3::from_slice(vertex) * place.scale + place.origin;
                low = at.min(low);
                high = at.max(high);
                vertex.copy_from_slice(&at.to_array());
            }
        });
        upload_normals(gpu, &normals, vertices, mesh.normals);
        upload::write::<u32>(&gpu.queue, &colors, vertices, |start, slice| {
            for (vertex, out) in (start..).zip(slice) {
                *out = painted(vertex);
            }
        });
        let mut highest = 0;
        upload::write::<u32>(&gpu.queue, &indices, index_count, |start, slice| {
            mesh.indices.subarray(start, start + slice.len() as u32).copy_to(slice);
            highest = slice.iter().fold(highest, |most, &index| most.max(index));
        });
        if index_count > 0 && (highest >= vertices || !(high - low).is_finite()) {
            return Err(RenderError::Malformed("an index or a coordinate that is none"));
        }
        Ok(Self {
            positions,
            normals,
            painted: colors,
            indices,
            index_count,
            edges: None,
            axis: None,
            closed: false,
            low,
            high,
        })
    }

    /// Makes the line list. `indices` must be those given when the prop was made.
    fn set_edges(&mut self, gpu: &Gpu, indices: &js_sys::Uint32Array) -> Result<(), RenderError> {
        if indices.length() / 3 * 3 != self.index_count {
            return Err(RenderError::Malformed("edges of another log or colony"));
        }
        self.edges = Some(upload::edges(gpu, indices)?);
        Ok(())
    }

    fn draw(
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
        pass.set_vertex_buffer(1, self.painted.slice(..));
        pass.set_vertex_buffer(2, self.normals.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..count, 0, 0..1);
    }
}

/// Everything that one picture shows besides its field.
#[derive(Default)]
pub(crate) struct Props {
    log: Option<Prop>,
    colony: Option<Prop>,
    /// Grows with every change.
    pub(crate) number: u64,
}

impl Props {
    /// Replaces the colony and, if there is a new `log`, the log.
    pub(crate) fn set(&mut self, log: Option<Prop>, colony: Prop) {
        self.log = log.or(self.log.take());
        self.colony = Some(colony);
        self.number += 1;
    }

    pub(crate) fn clear(&mut self) {
        *self = Self { number: self.number + 1, ..Self::default() };
    }

    /// Whether the wood ears are closed bodies.
    pub(crate) fn is_closed(&self) -> bool {
        self.colony.as_ref().is_some_and(|colony| colony.closed)
    }

    /// The log's axis, if there is a log.
    pub(crate) fn axis(&self) -> Option<&Axis> {
        self.log.as_ref().and_then(|log| log.axis.as_ref())
    }

    /// Draws the log and then the colony, each with its pipeline.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, [log, ear]: [&wgpu::RenderPipeline; 2]) {
        for (prop, pipeline) in [(&self.log, log), (&self.colony, ear)] {
            if let Some(prop) = prop {
                prop.draw(pass, pipeline, &prop.indices, prop.index_count);
            }
        }
    }

    /// Draws all edges of both, or nothing before [`Props::set_edges`].
    pub(crate) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        for prop in self.log.iter().chain(&self.colony) {
            if let Some(edges) = &prop.edges {
                prop.draw(pass, pipeline, edges, 2 * prop.index_count);
            }
        }
    }

    pub(crate) fn has_edges(&self) -> bool {
        self.log.iter().chain(&self.colony).all(|prop| prop.edges.is_some())
    }

    /// Makes the line lists of the props that have none. The indices must be those of the meshes.
    pub(crate) fn set_edges(
        &mut self,
        gpu: &Gpu,
        log: &js_sys::Uint32Array,
        colony: &js_sys::Uint32Array,
    ) -> Result<(), RenderError> {
        for (prop, indices) in [(&mut self.log, log), (&mut self.colony, colony)] {
            if let Some(prop) = prop.as_mut().filter(|prop| prop.edges.is_none()) {
                prop.set_edges(gpu, indices)?;
            }
        }
        Ok(())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.log.is_none() && self.colony.is_none()
    }

    /// Returns a box around the box `low`…`high` and all props.
    pub(crate) fn around(&self, low: Vec3, high: Vec3) -> (Vec3, Vec3) {
        let shown = self.log.iter().chain(&self.colony).filter(|prop| prop.index_count > 0);
        shown.fold((low, high), |(low, high), prop| (low.min(prop.low), high.max(prop.high)))
    }
}
