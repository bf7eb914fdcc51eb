//! How the mesh of a field comes into its buffers, and what is known by it: slice by slice, so that a page answers in between.

use glam::Vec3;

use super::super::buffers::Mesh;
use super::super::fill::Fill;
use super::super::indices::Arranging;
use super::super::{Gpu, RenderError};
use super::Scene;
use crate::shading::{Arrangement, Body, palette};

/// How many vertices a slice has.
const VERTICES: u32 = 1 << 15;

impl Scene {
    /// Uploads the next slice of the mesh, which takes some milliseconds. False if all of it is there.
    pub(crate) fn fill(&mut self, gpu: &Gpu) -> bool {
        let Some(mut fill) = self.fill.take() else { return false };
        let goes_on = if fill.vertices < self.buffers.vertices() {
            self.fill_vertices(gpu, &mut fill);
            true
        } else if let Some(arranging) = &mut fill.arranging {
            let Self { buffers, arrangement, rocks, .. } = &*self;
            arranging.advance(gpu, buffers.indices(), &rocks.index_starts, &fill.bodies, arrangement)
        } else {
            self.arrange(&mut fill.bodies);
            fill.arranging = Some(Arranging::new(fill.indices.clone(), &self.arrangement));
            true
        };
        if goes_on {
            self.fill = Some(fill);
            return true;
        }
        self.is_turned = fill.turned.found();
        let highest = fill.arranging.map_or(0, |arranging| arranging.highest());
        // WebGL2 would refuse to draw without saying why.
        if self.arrangement.length > 0 && highest >= self.buffers.vertices() {
            self.fail("an index points past the vertices");
        }
        true
    }

    fn fill_vertices(&mut self, gpu: &Gpu, fill: &mut Fill) {
        let Self { buffers, rocks, stands, .. } = self;
        let Fill { positions, normals, indices, bodies, vertices, rocks: whole, turned, .. } = fill;
        let start = *vertices;
        *vertices = buffers.vertices().min(start + VERTICES);
        let mesh = Mesh { positions, normals, indices };
        let mut count = start;
        buffers.vertex_buffers().fill(gpu, &mesh, start..*vertices, &mut |position, normal| {
            turned.add(&rocks.vertex_starts, position, normal);
            if let Some(body) = bodies.get_mut(*whole) {
                // NaN does not change these.
                body.low = position.min(body.low);
                body.high = position.max(body.high);
            }
            stands.add(position.to_array());
            count += 1;
            if rocks.vertex_starts.get(*whole + 1) == Some(&count) {
                stands.close();
                *whole += 1;
            }
            position
        });
    }

    /// All vertices are known: so is how the rocks are arranged.
    fn arrange(&mut self, bodies: &mut [Body]) {
        let Self { rocks, stands, image, .. } = &*self;
        let (low, high) =
            bodies.iter().fold((self.low, self.high), |(low, high), body| (low.min(body.low), high.max(body.high)));
        if !(high - low).is_finite() {
            self.fail("a coordinate is infinite");
            bodies.iter_mut().for_each(|body| (body.low, body.high) = (Vec3::ZERO, Vec3::ZERO));
            return;
        }
        for (rock, (body, (layer, site))) in bodies.iter_mut().zip(rocks.layers.iter().zip(&rocks.sites)).enumerate() {
            body.is_hidden = stands.hides(rock, *image, high.z, palette::hash(*layer, *site));
        }
        self.arrangement = Arrangement::of(bodies, *image);
        (self.low, self.high, self.bounds) = (low, high, [low, high]);
        (self.center, self.radius) = ((low + high) * 0.5, (high - low).length() * 0.5);
        self.is_buried = low.z < 0.0;
    }

    /// Nothing of it is drawn.
    fn fail(&mut self, why: &'static str) {
        self.fault = Some(RenderError::Malformed(why));
        self.arrangement = Arrangement::of(&[], self.image);
    }
}
