//! Copies typed arrays to GPU buffers one slice at a time, so that wasm memory never holds a whole field.

use std::ops::Range;

use super::{Gpu, RenderError};

/// Number of 4-byte elements per slice: 384 KiB of scratch memory. It is a multiple of 6, so that no vertex and no
/// triangle with its edges is split.
pub(crate) const SLICE: u32 = 6 << 14;

/// Makes a buffer of `bytes` bytes (at least 4, because empty buffers are not portable). Returns
/// [`RenderError::TooLarge`] if the device does not allow that many.
pub(crate) fn buffer(
    device: &wgpu::Device,
    label: &str,
    what: &'static str,
    bytes: u64,
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, RenderError> {
    let limit = device.limits().max_buffer_size;
    if bytes > limit {
        return Err(RenderError::TooLarge { what, bytes, limit });
    }
    Ok(device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.max(4),
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    }))
}

/// Writes `length` 4-byte elements to `buffer`. `fill(start, slice)` must put the elements from `start` on into
/// `slice`.
pub(crate) fn write<T: bytemuck::Pod>(
    queue: &wgpu::Queue,
    buffer: &wgpu::Buffer,
    length: u32,
    mut fill: impl FnMut(u32, &mut [T]),
) {
    write_part(queue, buffer, 0..length, &mut fill);
}

/// The same with those of the elements that are in `part`.
pub(crate) fn write_part<T: bytemuck::Pod>(
    queue: &wgpu::Queue,
    buffer: &wgpu::Buffer,
    Range { mut start, end: length }: Range<u32>,
    fill: &mut dyn FnMut(u32, &mut [T]),
) {
    let mut scratch = vec![T::zeroed(); (length - start).min(SLICE) as usize];
    while start < length {
        let count = (length - start).min(SLICE);
        if let Some(slice) = scratch.get_mut(..count as usize) {
            fill(start, slice);
            let bytes: &[u8] = bytemuck::cast_slice(slice);
            let offset = u64::from(start) * size_of::<T>() as u64;
            queue.write_buffer(buffer, offset, bytes);
            // Submitting frees the staging memory. Otherwise a large field would be staged as a whole.
            queue.submit(None);
        }
        start += count;
    }
}

/// Makes the line list of every triangle's edges.
pub(crate) fn edges(gpu: &Gpu, indices: &js_sys::Uint32Array) -> Result<wgpu::Buffer, RenderError> {
    let count = indices.length() / 3 * 6;
    let edges = buffer(&gpu.device, "rock-field/wire/edges", "edges", 4 * u64::from(count), wgpu::BufferUsages::INDEX)?;
    // There are two line ends per corner. Inner edges occur twice, once from each side; finding out which would cost
    // more.
    let mut corners = Vec::new();
    write::<u32>(&gpu.queue, &edges, count, |start, slice| {
        corners.resize(slice.len() / 2, 0);
        indices.subarray(start / 2, start / 2 + corners.len() as u32).copy_to(&mut corners);
        for (triangle, edges) in corners.chunks_exact(3).zip(slice.chunks_exact_mut(6)) {
            if let &[a, b, c] = triangle {
                edges.copy_from_slice(&[a, b, b, c, c, a]);
            }
        }
    });
    Ok(edges)
}
