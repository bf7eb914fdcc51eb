//! The index buffer of rocks: all levels of detail, in the order of an [`Arrangement`].

use super::buffers::MeshBuffers;
use super::upload::SLICE;
use super::{Gpu, RenderError};
use crate::shading::{Arrangement, Body, LEVELS, coarser};

/// Makes the buffer, and returns it with the highest index in it. `starts` holds rocks + 1 offsets into `indices`, which
/// are those of the mesh.
pub(crate) fn arranged(
    gpu: &Gpu,
    indices: &js_sys::Uint32Array,
    starts: &[u32],
    bodies: &[Body],
    arrangement: &Arrangement,
) -> Result<(wgpu::Buffer, u32), RenderError> {
    let buffer = MeshBuffers::index_buffer(gpu, "rock", arrangement.length)?;
    let mut source = Source { indices, ahead: arrangement.order.is_sorted(), slice: Vec::new(), start: 0 };
    let mut levels: [Level; LEVELS] =
        std::array::from_fn(|level| Level { at: arrangement.level_start(level), slice: Vec::new() });
    let mut highest = 0;
    for rock in arrangement.order.iter().map(|&rock| rock as usize) {
        let (Some(body), Some(&[start, end])) =
            (bodies.get(rock), starts.get(rock..rock + 2).and_then(|two| two.first_chunk()))
        else {
            continue;
        };
        let triangles = source.read(start, end);
        highest = triangles.iter().fold(highest, |most, &index| most.max(index));
        for (number, level) in levels.iter_mut().enumerate() {
            coarser(body, number, triangles, &mut level.slice);
            if level.slice.len() >= SLICE as usize {
                level.flush(gpu, &buffer);
            }
        }
    }
    levels.iter_mut().for_each(|level| level.flush(gpu, &buffer));
    Ok((buffer, highest))
}

/// The indices in JavaScript's memory.
struct Source<'a> {
    indices: &'a js_sys::Uint32Array,
    /// Whether they are asked for from the beginning to the end, so that many are fetched at once.
    ahead: bool,
    slice: Vec<u32>,
    /// Where the slice begins.
    start: u32,
}

impl Source<'_> {
    fn read(&mut self, start: u32, end: u32) -> &[u32] {
        if start < self.start || end > self.start + self.slice.len() as u32 {
            let ahead = if self.ahead { (start + SLICE).min(self.indices.length()) } else { end };
            let end = end.max(ahead);
            self.slice.resize((end - start) as usize, 0);
            self.indices.subarray(start, end).copy_to(&mut self.slice);
            self.start = start;
        }
        let range = (start - self.start) as usize..(end - self.start) as usize;
        self.slice.get(range).unwrap_or_default()
    }
}

/// What is still to be written of a level.
struct Level {
    /// Where it goes, in indices.
    at: u32,
    slice: Vec<u32>,
}

impl Level {
    fn flush(&mut self, gpu: &Gpu, buffer: &wgpu::Buffer) {
        gpu.queue.write_buffer(buffer, 4 * u64::from(self.at), bytemuck::cast_slice(&self.slice));
        // As in `upload::write`.
        gpu.queue.submit(None);
        self.at += self.slice.len() as u32;
        self.slice.clear();
    }
}
