//! The copies of a field that lie round it.

use std::cell::OnceCell;
use std::ops::Range;

use glam::Vec3;

use super::buffers::MeshBuffers;
use super::{Gpu, RenderError, upload};
use crate::shading::{Arrangement, Bricks, FieldUniforms, Sight, least_of};

/// Bytes between the uniforms of two copies: a multiple of what devices ask for.
const STRIDE: u64 = 512;

/// Nearer than so many of the field's diameters, a copy is drawn group by group.
const NEAR: f32 = 1.0;

/// Rocks that cover more are drawn in any case, square pixels.
const MOST: f32 = 2000.0;

/// Copies may have triangles so many times as large as the field's.
const COARSER: f32 = 3.0;

/// A picture shows about so many times fewer copies than there are.
const SHARE: u64 = 8;

/// How many copies touch the field.
const NEIGHBOURS: usize = 8;

/// What is copied.
pub(crate) struct Field<'a> {
    pub(crate) arrangement: &'a Arrangement,
    pub(crate) buffers: &'a MeshBuffers,
}

pub(crate) struct Around {
    image: [f32; 2],
    side: f32,
    bricks: Bricks,
    copies: Vec<Vec3>,
    uniforms: wgpu::Buffer,
    /// Of each copy, made when it is first drawn.
    groups: Vec<OnceCell<wgpu::BindGroup>>,
}

impl Drop for Around {
    /// As of a scene.
    fn drop(&mut self) {
        self.uniforms.destroy();
    }
}

impl Around {
    pub(crate) fn new(gpu: &Gpu, image: [f32; 2]) -> Result<Self, RenderError> {
        let bricks = Bricks::of(image);
        let copies = bricks.copies();
        let bytes = STRIDE * copies.len() as u64;
        let usage = wgpu::BufferUsages::UNIFORM;
        let uniforms = upload::buffer(&gpu.device, "rock-field/around/uniforms", "uniforms", bytes, usage)?;
        let groups = copies.iter().map(|_| OnceCell::new()).collect();
        Ok(Self { image, side: image[0].max(image[1]), bricks, copies, uniforms, groups })
    }

    pub(crate) fn bricks(&self) -> &Bricks {
        &self.bricks
    }

    /// Writes the uniforms of all copies, which are those of the field but for where they are.
    pub(crate) fn write(&self, gpu: &Gpu, field: &FieldUniforms) {
        let mut bytes = vec![0; STRIDE as usize * self.copies.len()];
        for ((number, copy), slot) in (1..).zip(&self.copies).zip(bytes.chunks_exact_mut(STRIDE as usize)) {
            // By the golden ratio: numbers that are far from each other.
            let own = (0.618_034 * number as f32).fract();
            let uniforms = FieldUniforms { shift: copy.extend(own).to_array(), ..*field };
            slot.iter_mut().zip(bytemuck::bytes_of(&uniforms)).for_each(|(to, from)| *to = *from);
        }
        gpu.queue.write_buffer(&self.uniforms, 0, &bytes);
    }

    /// Draws what a picture shows of the copies, the nearest first, with about `most` triangles.
    pub(crate) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        gpu: &Gpu,
        pipeline: &wgpu::RenderPipeline,
        field: &Field<'_>,
        sight: &Sight,
        most: u32,
    ) {
        let seen = self.seen(field, sight);
        // What is too much is left out by size, and everywhere alike: a copy that is missing between others would be seen. Copies out of the
        // picture count, so that all parts of a picture show the same.
        let away = |copy: &Vec3| Sight { eye: sight.eye - *copy, most: COARSER * sight.most, ..*sight };
        let all: Vec<Sight> = self.copies.iter().map(away).collect();
        let least = least_of(sight.least, MOST, &|least| {
            let triangles = |sight: &Sight| field.arrangement.triangles_afar(&Sight { least, ..*sight });
            all.iter().map(triangles).sum::<u64>() <= SHARE * u64::from(most)
        });
        let ranges = seen.iter().map(|(distance, _, sight)| {
            let sight = Sight { least, ..*sight };
            let is_near = *distance < NEAR * self.side;
            if is_near { field.arrangement.seen(&sight) } else { field.arrangement.seen_afar(&sight) }
        });
        for ((_, number, _), ranges) in seen.iter().zip(ranges) {
            self.bind(pass, gpu, *number);
            field.buffers.draw_ranges(pass, pipeline, &ranges);
        }
    }

    /// Whether any copy is in the picture.
    pub(crate) fn is_seen(&self, field: &Field<'_>, sight: &Sight) -> bool {
        !self.seen(field, sight).is_empty()
    }

    /// The copies that are in the picture, the nearest first: how far away they are, their numbers, and how the picture is seen from them.
    fn seen(&self, field: &Field<'_>, sight: &Sight) -> Vec<(f32, usize, Sight)> {
        let of = |(number, copy): (usize, &Vec3)| {
            let sight = Sight { eye: sight.eye - *copy, most: COARSER * sight.most, ..*sight };
            Some((field.arrangement.distance(&sight)?, number, sight))
        };
        let seen: Vec<_> = self.copies.iter().enumerate().filter_map(of).collect();
        // As an arrangement sorts its groups.
        let mut keys: Vec<u64> =
            (0..).zip(&seen).map(|(place, (distance, ..))| u64::from(distance.to_bits()) << 32 | place).collect();
        keys.sort_unstable();
        keys.into_iter().filter_map(|key| seen.get(key as u32 as usize).copied()).collect()
    }

    /// Adds to `all` what the nearest copies throw into the field, by triangles of at most `most` px², each with the number of its copy. `sun` is the
    /// direction of the sun.
    pub(crate) fn add_neighbours(
        &self,
        all: &mut Vec<(Option<usize>, Range<u32>)>,
        arrangement: &Arrangement,
        sun: Vec3,
        most: f32,
    ) {
        for (number, copy) in self.copies.iter().enumerate().take(NEIGHBOURS) {
            for range in arrangement.reaching(*copy, sun, self.image, most) {
                all.push((Some(number), range));
            }
        }
    }

    /// Binds the uniforms of a copy as the field's.
    pub(crate) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, gpu: &Gpu, number: usize) {
        let make = || {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("rock-field/around/group"),
                layout: &gpu.pipelines.field_layout,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: &self.uniforms,
                        offset: STRIDE * number as u64,
                        size: wgpu::BufferSize::new(size_of::<FieldUniforms>() as u64),
                    }),
                }],
            })
        };
        if let Some(group) = self.groups.get(number) {
            pass.set_bind_group(1, group.get_or_init(make), &[]);
        }
    }
}
