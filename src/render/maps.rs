//! The shadow, height and sky maps that lighting reads: a few sets, which are lent to the fields that are drawn.
//!
//! A set takes 29 MB, and a page may show dozens of fields of which one is being moved. A canvas therefore keeps the
//! set it drew last as long as there are enough sets, and otherwise draws its maps again.
//!
//! Where a device takes long for them, pictures that are soon replaced do with a set of smaller maps, which show fewer and larger triangles.

use super::pass::{HEIGHT_FORMAT, OPEN_FORMAT, SHADOW_FORMAT};
use super::surface::texture;
use crate::shading::{SKY_COLUMNS, SKY_ROWS, Sky, hills};

/// How fine the maps of a set are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grade {
    /// For pictures smaller than the stage.
    Draft,
    /// For those with a sample a pixel, which are soon replaced.
    Rough,
    Whole,
}

impl Grade {
    /// Side of the shadow map and of the height map, texels, where textures can have sides of `max_side`. For the papers' fields of 1024 px, a texel of
    /// the whole ones is 0.7 px.
    pub(crate) fn side(self, max_side: u32) -> u32 {
        let side = match self {
            Self::Draft => 512,
            Self::Rough => 1024,
            Self::Whole => 2048,
        };
        side.min(max_side)
    }
}

/// Largest number of sets of either kind: 116 MB, for the few fields that move at the same time.
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
#[derive(Clone, Copy, Default)]
pub(crate) struct Stale {
    pub(crate) shadows: bool,
    pub(crate) heights: bool,
}

struct Set {
    maps: Maps,
    side: u32,
    /// The number of the view that the maps are lent to, and what is drawn in them, or is to be.
    view: u64,
    drawn: Drawn,
    /// What of that is still to be drawn, and how many parts of it are.
    stale: Stale,
    parts: usize,
    /// When the maps were last asked for.
    used: u64,
}

/// All sets of a device.
#[derive(Default)]
pub(crate) struct MapSets {
    sets: Vec<Set>,
    /// For sets of each side.
    height_depths: Vec<wgpu::TextureView>,
    /// The same for all sets.
    hills: Option<wgpu::TextureView>,
    now: u64,
}

impl MapSets {
    /// The side of the finest maps of `view` in which all of this is drawn; 0 if there are none.
    pub(crate) fn finest(&self, view: u64, drawn: Drawn) -> u32 {
        let mut finest = 0;
        for set in &self.sets {
            if set.view == view && set.drawn == drawn && !set.stale.shadows && !set.stale.heights {
                finest = set.side.max(finest);
            }
        }
        finest
    }

    /// Another part is drawn of what was stale in the maps of `view` that have this side; the last one if `is_last`.
    pub(crate) fn drew(&mut self, side: u32, view: u64, is_last: bool) {
        if let Some(set) = self.sets.iter_mut().find(|set| (set.side, set.view) == (side, view)) {
            set.parts += 1;
            if is_last {
                (set.stale, set.parts) = (Stale::default(), 0);
            }
        }
    }

    /// Returns maps of this side for `view`, as a group of this `layout`, which of them do not yet have what is to be `drawn` in them, and how many parts
    /// of that are drawn.
    pub(crate) fn lend(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        side: u32,
        view: u64,
        drawn: Drawn,
    ) -> (Maps, Stale, usize) {
        self.now += 1;
        let alike = || self.sets.iter().enumerate().filter(|(_, set)| set.side == side);
        let own = alike().find(|(_, set)| set.view == view);
        let oldest = || alike().min_by_key(|(_, set)| set.used).filter(|_| alike().count() >= MAX_SETS);
        let place = own.or_else(oldest).map(|(place, _)| place);
        match place.and_then(|place| self.sets.get_mut(place)) {
            Some(set) => {
                if (set.view, set.drawn) != (view, drawn) {
                    let is_other = set.view != view;
                    set.stale.shadows |= is_other || set.drawn.shadows != drawn.shadows;
                    set.stale.heights |= is_other || set.drawn.heights != drawn.heights;
                    set.parts = 0;
                }
                (set.view, set.drawn, set.used) = (view, drawn, self.now);
                (set.maps.clone(), set.stale, set.parts)
            }
            None => {
                let maps = self.make(device, queue, layout, side);
                let stale = Stale { shadows: true, heights: true };
                self.sets.push(Set { maps: maps.clone(), side, view, drawn, stale, parts: 0, used: self.now });
                (maps, stale, 0)
            }
        }
    }

    /// Makes what is the same for all sets, but for scratch. False if it was there.
    pub(crate) fn makes_hills(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) -> bool {
        let is_new = self.hills.is_none();
        self.hills.get_or_insert_with(|| hills(device, queue));
        is_new
    }

    /// Frees the sets of `view` that are smaller than this side.
    pub(crate) fn release(&mut self, view: u64, side: u32) {
        let is_free = |set: &Set| set.view == view && set.side < side;
        self.sets.retain(|set| {
            if is_free(set) {
                set.maps.shadow.texture().destroy();
                set.maps.height.texture().destroy();
                set.maps.sky.texture().destroy();
                set.maps.open.texture().destroy();
            }
            !is_free(set)
        });
    }

    fn make(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, layout: &wgpu::BindGroupLayout, side: u32) -> Maps {
        let map_of = |side, label, format| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            texture(device, label, (side, side), 1, format, usage)
        };
        let map = |label, format| map_of(side, label, format);
        let shadow = map("rock-field/shadow/map", SHADOW_FORMAT);
        let height = map("rock-field/height/map", HEIGHT_FORMAT);
        let open = map_of(side / 2, "rock-field/open/map", OPEN_FORMAT);
        let known = self.height_depths.iter().find(|map| map.texture().width() == side).cloned();
        let height_depth = known.unwrap_or_else(|| {
            let made = map("rock-field/height/depth", SHADOW_FORMAT);
            self.height_depths.push(made.clone());
            made
        });
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
