//! The index buffer of rocks: all levels of detail, in the order of an [`Arrangement`].

use super::Gpu;
use super::upload::SLICE;
use crate::shading::{Arrangement, Body, LEVELS, coarser};

/// Puts the levels into the buffer, a few rocks at a time.
pub(crate) struct Arranging {
    source: Source,
    levels: [Level; LEVELS],
    /// How many rocks are done.
    rocks: usize,
    highest: u32,
}

impl Arranging {
    /// `indices` are those of the mesh.
    pub(crate) fn new(indices: js_sys::Uint32Array, arrangement: &Arrangement) -> Self {
        let ahead = arrangement.order.is_sorted();
        let level = |level| Level { at: arrangement.level_start(level), slice: Vec::new() };
        let source = Source { indices, ahead, slice: Vec::new(), start: 0 };
        Self { source, levels: std::array::from_fn(level), rocks: 0, highest: 0 }
    }

    /// The highest index that there was until now.
    pub(crate) fn highest(&self) -> u32 {
        self.highest
    }

    /// Goes on with about [`SLICE`] indices of the mesh. `starts` holds rocks + 1 offsets into these. True while there is more to come.
    pub(crate) fn advance(
        &mut self,
        gpu: &Gpu,
        buffer: &wgpu::Buffer,
        starts: &[u32],
        bodies: &[Body],
        arrangement: &Arrangement,
    ) -> bool {
        let mut room = SLICE as usize;
        for rock in arrangement.order.iter().skip(self.rocks).map(|&rock| rock as usize) {
            self.rocks += 1;
            let (Some(body), Some(&[start, end])) =
                (bodies.get(rock), starts.get(rock..rock + 2).and_then(|two| two.first_chunk()))
            else {
                continue;
            };
            let triangles = self.source.read(start, end);
            self.highest = triangles.iter().fold(self.highest, |most, &index| most.max(index));
            for (number, level) in self.levels.iter_mut().enumerate() {
                coarser(body, number, triangles, &mut level.slice);
                if level.slice.len() >= SLICE as usize {
                    level.flush(gpu, buffer);
                }
            }
            room = room.saturating_sub(triangles.len());
            if room == 0 {
                return true;
            }
        }
        self.levels.iter_mut().for_each(|level| level.flush(gpu, buffer));
        false
    }
}

/// The indices in JavaScript's memory.
struct Source {
    indices: js_sys::Uint32Array,
    /// Whether they are asked for from the beginning to the end, so that many are fetched at once.
    ahead: bool,
    slice: Vec<u32>,
    /// Where the slice begins.
    start: u32,
}

impl Source {
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
