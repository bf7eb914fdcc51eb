//! The field seen from above, as drawn in Fig. 8: the diagram of every layer with its sites, or the selected graph.

use super::pipelines::{FILL_STRIDE, STROKE_STRIDE};
use super::{Gpu, RenderError, upload};
use crate::shading::palette::{self, Theme};

/// One layer, as in the field's flat buffers.
pub(crate) struct Layer {
    pub(crate) id: u32,
    /// Disc radius, px.
    pub(crate) radius: f32,
    /// Site i is at 2i, 2i + 1.
    pub(crate) sites: Vec<f32>,
    /// Cell i owns the vertices `cell_starts[i]..cell_starts[i + 1]`.
    pub(crate) cell_starts: Vec<u32>,
    /// Vertex j is at 2j, 2j + 1.
    pub(crate) cell_vertices: Vec<f32>,
    /// Indices of the selected sites.
    pub(crate) selected: Vec<u32>,
}

/// The buffers of a plan on the device. Fills are drawn below strokes.
pub(crate) struct Plan {
    fills: wgpu::Buffer,
    fill_vertices: u32,
    strokes: wgpu::Buffer,
    stroke_count: u32,
}

impl Drop for Plan {
    /// As with a scene, buffers are not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        self.fills.destroy();
        self.strokes.destroy();
    }
}

type Point = [f32; 2];

/// Number of corners of the quad that each stroke is drawn as, a triangle strip.
const STROKE_CORNERS: u32 = 4;

/// Collects fills and strokes as 4-byte words; floats are stored by their bits.
#[derive(Default)]
struct Ink {
    fills: Vec<u32>,
    strokes: Vec<u32>,
}

impl Ink {
    /// Adds a convex polygon, counter-clockwise, as a fan.
    fn fill(&mut self, polygon: &[Point], color: u32) {
        let Some((first, rest)) = polygon.split_first() else {
            return;
        };
        for pair in rest.windows(2) {
            for point in std::iter::once(first).chain(pair) {
                self.fills.extend([point[0].to_bits(), point[1].to_bits(), color]);
            }
        }
    }

    /// Adds a line with round ends, or a dot if `a` = `b`. `width` is in CSS pixels; the line becomes thinner if `cell`
    /// px of the image are only a few on the screen.
    fn stroke(&mut self, a: Point, b: Point, color: u32, width: f32, cell: f32) {
        let bits = |x: f32| x.to_bits();
        self.strokes.extend([bits(a[0]), bits(a[1]), bits(b[0]), bits(b[1])]);
        self.strokes.extend([color, bits(width), bits(cell)]);
    }

    fn outline(&mut self, polygon: &[Point], color: u32, width: f32, cell: f32) {
        for (&a, &b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
            self.stroke(a, b, color, width, cell);
        }
    }
}

impl Layer {
    fn points(flat: &[f32]) -> Vec<Point> {
        flat.chunks_exact(2).map(|xy| [xy[0], xy[1]]).collect()
    }

    /// The polygon of cell `i`; empty if the buffers are too short.
    fn cell<'a>(&self, vertices: &'a [Point], i: usize) -> &'a [Point] {
        let start = |i: usize| self.cell_starts.get(i).map(|&start| start as usize);
        match (start(i), start(i + 1)) {
            (Some(from), Some(to)) => vertices.get(from..to).unwrap_or(&[]),
            _ => &[],
        }
    }
}

impl Plan {
    /// Makes the plan of all layers' diagrams, one above the other, each with its sites: Fig. 8 (a)–(c) on one sheet.
    /// The finest layer is at the bottom and has the thinnest lines.
    pub(crate) fn diagrams(
        gpu: &Gpu,
        image: Point,
        layers: &[Layer],
        dark: bool,
        theme: &Theme,
    ) -> Result<Self, RenderError> {
        let mut ink = Ink::default();
        let sheet = corners(image);
        ink.fill(&sheet, palette::packed(theme.paper));
        let mut order: Vec<&Layer> = layers.iter().collect();
        order.sort_by(|a, b| a.radius.total_cmp(&b.radius));
        let finest = order.first().map_or(1.0, |layer| layer.radius.max(1.0));
        for layer in order {
            let color = palette::line(layer.id, dark);
            // 1 CSS px for the finest layer, 2 for three times its radius, 3 for nine times.
            let width = (1.0 + 0.63 * (layer.radius / finest).log2()).clamp(1.0, 3.5);
            let vertices = Layer::points(&layer.cell_vertices);
            for i in 0..layer.cell_starts.len().saturating_sub(1) {
                let cell = layer.cell(&vertices, i);
                for (&a, &b) in cell.iter().zip(cell.iter().cycle().skip(1)) {
                    // Neighbours have their common edge in opposite directions, and only one of them draws it. On the
                    // border there is no neighbour, but the sheet's own frame is drawn there.
                    if a < b && !on_border(a, b, image) {
                        ink.stroke(a, b, color, width, layer.radius);
                    }
                }
            }
            for site in Layer::points(&layer.sites) {
                ink.stroke(site, site, color, 1.2 + 1.3 * width, layer.radius);
            }
        }
        ink.outline(&sheet, palette::packed(theme.rule), 1.5, image[0].max(image[1]));
        Self::upload(gpu, &ink)
    }

    /// Makes the plan of the selected cells in the colours of their layers, with dark outlines on dark ground: Fig. 8
    /// (d).
    pub(crate) fn selection(gpu: &Gpu, image: Point, layers: &[Layer], theme: &Theme) -> Result<Self, RenderError> {
        let mut ink = Ink::default();
        let sheet = corners(image);
        ink.fill(&sheet, palette::packed(palette::GROUND));
        let outline = palette::packed(palette::OUTLINE);
        for layer in layers {
            let vertices = Layer::points(&layer.cell_vertices);
            for &site in &layer.selected {
                let cell = layer.cell(&vertices, site as usize);
                let color = palette::cell(layer.id, palette::hash(layer.id, site));
                ink.fill(cell, color);
                ink.outline(cell, outline, 1.2, layer.radius);
            }
        }
        ink.outline(&sheet, palette::packed(theme.rule), 1.5, image[0].max(image[1]));
        Self::upload(gpu, &ink)
    }

    fn upload(gpu: &Gpu, ink: &Ink) -> Result<Self, RenderError> {
        let make = |label, what, words: &[u32]| {
            let bytes = 4 * words.len() as u64;
            let buffer = upload::buffer(&gpu.device, label, what, bytes, wgpu::BufferUsages::VERTEX)?;
            gpu.queue.write_buffer(&buffer, 0, bytemuck::cast_slice(words));
            Ok(buffer)
        };
        Ok(Self {
            fills: make("rock-field/plan/fills", "cells", &ink.fills)?,
            fill_vertices: (ink.fills.len() as u64 * 4 / FILL_STRIDE) as u32,
            strokes: make("rock-field/plan/strokes", "cell outlines", &ink.strokes)?,
            stroke_count: (ink.strokes.len() as u64 * 4 / STROKE_STRIDE) as u32,
        })
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, [fills, strokes]: [&wgpu::RenderPipeline; 2]) {
        pass.set_pipeline(fills);
        pass.set_vertex_buffer(0, self.fills.slice(..));
        pass.draw(0..self.fill_vertices, 0..1);
        pass.set_pipeline(strokes);
        pass.set_vertex_buffer(0, self.strokes.slice(..));
        pass.draw(0..STROKE_CORNERS, 0..self.stroke_count);
    }
}

fn corners([w, h]: Point) -> [Point; 4] {
    [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]
}

/// Whether an edge is on the image's border, where it belongs to one cell only.
fn on_border(a: Point, b: Point, image: Point) -> bool {
    (0..2).any(|axis| a[axis] == b[axis] && (a[axis] == 0.0 || a[axis] == image[axis]))
}
