//! The textures of [`crate::shading::patterns`] on the device, which all passes in natural colours share.

use crate::shading::patterns::{PLANE_SIDE, POINTS_SIDE, VOLUME_SIDE, plane, points, volume};

/// Makes the textures, and their group.
pub(crate) fn group(device: &wgpu::Device, queue: &wgpu::Queue, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
    use wgpu::TextureDimension::{D2, D3};
    use wgpu::TextureFormat::{Rgba8Snorm, Rgba8Unorm};
    let make = |label, side, dimension, format, bytes: Vec<u8>| {
        let depth_or_array_layers = if dimension == D3 { side } else { 1 };
        let size = wgpu::Extent3d { width: side, height: side, depth_or_array_layers };
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * side), rows_per_image: Some(side) };
        queue.write_texture(texture.as_image_copy(), &bytes, layout, size);
        texture.create_view(&Default::default())
    };
    let volume = make("rock-field/patterns/volume", VOLUME_SIDE, D3, Rgba8Snorm, volume());
    let plane = make("rock-field/patterns/plane", PLANE_SIDE, D2, Rgba8Snorm, plane());
    let points = make("rock-field/patterns/points", POINTS_SIDE, D3, Rgba8Unorm, points());
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("rock-field/patterns/sampler"),
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        address_mode_w: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("rock-field/patterns/group"),
        layout,
        entries: &[
            entry(0, wgpu::BindingResource::TextureView(&volume)),
            entry(1, wgpu::BindingResource::TextureView(&plane)),
            entry(2, wgpu::BindingResource::TextureView(&points)),
            entry(3, wgpu::BindingResource::Sampler(&sampler)),
        ],
    })
}
