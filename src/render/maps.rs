//! The shadow, height and sky maps that lighting reads: a few sets, which are lent to the fields that are drawn.
//!
//! A set takes 29 MB, and a page may show dozens of fields of which one is being moved. A canvas therefore keeps the
//! set it drew last as long as there are enough sets, and otherwise draws its maps again.

use super::pass::{HEIGHT_FORMAT, OPEN_FORMAT, SHADOW_FORMAT};
use super::surface::texture;
use crate::shading::{SKY_COLUMNS, SKY_ROWS, Sky, hills};

/// Side of the shadow map and of the height map, texels. For the papers' fields of 1024 px, a texel is 0.7 px.
const MAP_SIDE: u32 = 2048;

/// Largest number of sets: 116 MB, for the few fields that move at the same time.
const MAX_SETS: usize = 4;

/// The textures that lighting reads. They are handles, so a clone refers to the same textures.
#[derive(Clone)]
pub(crate) struct Maps {
    pub(crate) group: wgpu::BindGroup,
    pub(crate) shadow: wgpu::TextureView,
    pub(crate) height: wgpu::TextureView,
    pub(crate) sky: wgpu::TextureView,
    pub(crate) hills: wgpu::TextureView,
    /// What the ground sees of the sky; `open.wgsl` says what its side is.
    pub(crate) open: wgpu::TextureView,
    /// Scratch texture, shared by all sets.
    pub(crate) height_depth: wgpu::TextureView,
}

impl Maps {
    /// Puts a sky into its map.
    pub(crate) fn write_sky(&self, queue: &wgpu::Queue, sky: &Sky) {
        let texels = sky.texels();
        let [width, height] = [SKY_COLUMNS, SKY_ROWS].map(|side| side as u32);
        queue.write_texture(
            self.sky.texture().as_image_copy(),
            bytemuck::cast_slice(&texels),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(8 * width), rows_per_image: None },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }
}

/// What is drawn in maps; see [`super::Scene::drawn`].
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Drawn {
    pub(crate) shadows: u64,
    pub(crate) heights: u64,
}

/// Which maps have to be drawn.
#[derive(Clone, Copy)]
pub(crate) struct Stale {
    pub(crate) shadows: bool,
    pub(crate) heights: bool,
}

struct Set {
    maps: Maps,
    /// The number of the view that the maps are lent to, and what is drawn in them.
    view: u64,
    drawn: Drawn,
    /// When the maps were last asked for.
    used: u64,
}

/// All sets of a device.
#[derive(Default)]
pub(crate) struct MapSets {
    sets: Vec<Set>,
    height_depth: Option<wgpu::TextureView>,
    /// The same for all sets.
    hills: Option<wgpu::TextureView>,
    now: u64,
}

impl MapSets {
    /// Side of every map, texels, where textures can have sides of `max_side`.
    pub(crate) fn side(max_side: u32) -> u32 {
        MAP_SIDE.min(max_side)
    }

    /// Returns maps for `view`, as a group of this `layout`, and which of them do not yet have what is to be `drawn` in them.
    pub(crate) fn lend(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        view: u64,
        drawn: Drawn,
    ) -> (Maps, Stale) {
        self.now += 1;
        let own = self.sets.iter().position(|set| set.view == view);
        let place = own.or_else(|| {
            let oldest = self.sets.iter().enumerate().min_by_key(|(_, set)| set.used);
            oldest.map(|(place, _)| place).filter(|_| self.sets.len() >= MAX_SETS)
        });
        match place.and_then(|place| self.sets.get_mut(place)) {
            Some(set) => {
                let is_other = set.view != view;
                let shadows = is_other || set.drawn.shadows != drawn.shadows;
                let heights = is_other || set.drawn.heights != drawn.heights;
                (set.view, set.drawn, set.used) = (view, drawn, self.now);
                (set.maps.clone(), Stale { shadows, heights })
            }
            None => {
                let maps = self.make(device, queue, layout);
                self.sets.push(Set { maps: maps.clone(), view, drawn, used: self.now });
                (maps, Stale { shadows: true, heights: true })
            }
        }
    }

    /// Makes what is the same for all sets, but for scratch. False if it was there.
    pub(crate) fn makes_hills(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) -> bool {
        let is_new = self.hills.is_none();
        self.hills.get_or_insert_with(|| hills(device, queue));
        is_new
    }

    /// Frees the set of `view`.
    pub(crate) fn release(&mut self, view: u64) {
        self.sets.retain(|set| {
            if set.view == view {
                set.maps.shadow.texture().destroy();
                set.maps.height.texture().destroy();
                set.maps.sky.texture().destroy();
                set.maps.open.texture().destroy();
            }
            set.view != view
        });
    }

    fn make(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, layout: &wgpu::BindGroupLayout) -> Maps {
        let side = Self::side(device.limits().max_texture_dimension_2d);
        let map_of = |side, label, format| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            texture(device, label, (side, side), 1, format, usage)
        };
        let map = |label, format| map_of(side, label, format);
        let shadow = map("rock-field/shadow/map", SHADOW_FORMAT);
        let height = map("rock-field/height/map", HEIGHT_FORMAT);
        let open = map_of(side / 2, "rock-field/open/map", OPEN_FORMAT);
        let height_depth =
            self.height_depth.get_or_insert_with(|| map("rock-field/height/depth", SHADOW_FORMAT)).clone();
        let usage = wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::TEXTURE_BINDING;
        let size = (SKY_COLUMNS as u32, SKY_ROWS as u32);
        let sky = texture(device, "rock-field/sky/map", size, 1, wgpu::TextureFormat::Rgba16Float, usage);
        let hills = self.hills.get_or_insert_with(|| hills(device, queue)).clone();
        let group = group(device, layout, [&shadow; 3], [&height, &sky, &hills, &open]);
        Maps { group, shadow, height, sky, hills, open, height_depth }
    }
}

/// The panorama of the hills.
fn hills(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let [width, height] = [hills::COLUMNS, hills::ROWS].map(|side| side as u32);
    let usage = wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::TEXTURE_BINDING;
    let map = texture(device, "rock-field/hills", (width, height), 1, wgpu::TextureFormat::Rgba8Unorm, usage);
    queue.write_texture(
        map.texture().as_image_copy(),
        bytemuck::cast_slice(&hills::panorama()),
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None },
        wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
    );
    map
}

/// A sampler that filters, or that compares and filters what comes of it.
pub(crate) fn linear(device: &wgpu::Device, compare: Option<wgpu::CompareFunction>) -> wgpu::Sampler {
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("rock-field/maps/sampler"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare,
        ..Default::default()
    })
}

/// `shadows` of the sun, and for a still of the sky and of the ground.
pub(crate) fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    [shadow, high, below]: [&wgpu::TextureView; 3],
    [height, sky, hills, open]: [&wgpu::TextureView; 4],
) -> wgpu::BindGroup {
    let compare = linear(device, Some(wgpu::CompareFunction::LessEqual));
    let linear = linear(device, None);
    // Reads the depths themselves, to find what casts a shadow.
    let nearest = device
        .create_sampler(&wgpu::SamplerDescriptor { label: Some("rock-field/shadow/depths"), ..Default::default() });
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("rock-field/maps/group"),
        layout,
        entries: &[
            entry(0, wgpu::BindingResource::TextureView(shadow)),
            entry(1, wgpu::BindingResource::Sampler(&compare)),
            entry(2, wgpu::BindingResource::TextureView(height)),
            entry(3, wgpu::BindingResource::Sampler(&linear)),
            entry(4, wgpu::BindingResource::TextureView(shadow)),
            entry(5, wgpu::BindingResource::Sampler(&nearest)),
            entry(6, wgpu::BindingResource::TextureView(sky)),
            entry(7, wgpu::BindingResource::Sampler(&linear)),
            entry(8, wgpu::BindingResource::TextureView(high)),
            entry(9, wgpu::BindingResource::TextureView(below)),
            entry(10, wgpu::BindingResource::TextureView(hills)),
            entry(11, wgpu::BindingResource::TextureView(open)),
        ],
    })
}
