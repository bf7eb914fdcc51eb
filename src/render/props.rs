//! Props, that is things that stand among the rocks: a fallen log, and wood ears that grow on it. Each is one mesh and
//! one draw.

use glam::Vec3;

use super::buffers::{Mesh, MeshBuffers, VertexBuffers};
use super::{Gpu, RenderError};
use crate::shading::wood::{self, Axis, Ears};

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

/// Buffers of a log or of a colony.
pub(crate) struct Prop {
    buffers: MeshBuffers,
    /// The axis, if it is a log, px.
    axis: Option<Axis>,
    /// True for wood ears that are closed bodies, whose faces are not seen from inside.
    closed: bool,
    low: Vec3,
    high: Vec3,
}

impl Prop {
    /// Uploads a log. `kinds` has one entry per vertex.
    pub(crate) fn log(gpu: &Gpu, place: Place, mesh: &Mesh<'_>, kinds: &[u8]) -> Result<Self, RenderError> {
        let points = mesh.positions.to_vec();
        if 3 * kinds.len() != points.len() {
            return Err(RenderError::Malformed("kinds of another log"));
        }
        let painted = |vertex: u32| wood::painted(kinds.get(vertex as usize).copied().unwrap_or(0));
        let mut log = Self::new(gpu, place, mesh, painted)?;
        log.axis = Some(Axis::of(&points, kinds).placed(place.origin, place.scale));
        Ok(log)
    }

    pub(crate) fn colony(gpu: &Gpu, place: Place, mesh: &Mesh<'_>, ears: &Ears) -> Result<Self, RenderError> {
        let each = mesh.positions.length() / 3 / (ears.keys.len() as u32).max(1);
        if each * ears.keys.len() as u32 * 3 != mesh.positions.length() {
            return Err(RenderError::Malformed("individuals of different size"));
        }
        let mut colony = Self::new(gpu, place, mesh, |vertex| ears.painted(vertex, each.max(1)))?;
        colony.closed = ears.is_closed(each);
        Ok(colony)
    }

    fn new(gpu: &Gpu, place: Place, mesh: &Mesh<'_>, painted: impl Fn(u32) -> u32) -> Result<Self, RenderError> {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let vertices = VertexBuffers::new(gpu, "prop", mesh, |vertex| {
            let at = vertex * place.scale + place.origin;
            low = at.min(low);
            high = at.max(high);
            at
        })?;
        let buffers = MeshBuffers::new(gpu, "prop", vertices, mesh)?;
        if !buffers.is_empty() && !(high - low).is_finite() {
            return Err(RenderError::Malformed("a coordinate is infinite"));
        }
        buffers.paint(gpu, painted);
        Ok(Self { buffers, axis: None, closed: false, low, high })
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
                prop.buffers.draw(pass, pipeline);
            }
        }
    }

    /// Draws all edges of both, or nothing before [`Props::set_edges`].
    pub(crate) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        for prop in self.log.iter().chain(&self.colony) {
            prop.buffers.draw_edges(pass, pipeline);
        }
    }

    pub(crate) fn has_edges(&self) -> bool {
        self.log.iter().chain(&self.colony).all(|prop| prop.buffers.has_edges())
    }

    /// Makes the line lists of the props that have none. The indices must be those of the meshes.
    pub(crate) fn set_edges(
        &mut self,
        gpu: &Gpu,
        log: &js_sys::Uint32Array,
        colony: &js_sys::Uint32Array,
    ) -> Result<(), RenderError> {
        for (prop, indices) in [(&mut self.log, log), (&mut self.colony, colony)] {
            if let Some(prop) = prop.as_mut().filter(|prop| !prop.buffers.has_edges()) {
                prop.buffers.set_edges(gpu, indices)?;
            }
        }
        Ok(())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.log.is_none() && self.colony.is_none()
    }

    /// Returns a box around the box `low`…`high` and all props.
    pub(crate) fn around(&self, low: Vec3, high: Vec3) -> (Vec3, Vec3) {
        let shown = self.log.iter().chain(&self.colony).filter(|prop| !prop.buffers.is_empty());
        shown.fold((low, high), |(low, high), prop| (low.min(prop.low), high.max(prop.high)))
    }
}
