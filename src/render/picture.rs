//! A picture that is drawn out of sight, piece by piece, and shown when it is whole: however slow the device is, no submission takes long, and
//! what is on the screen stays there meanwhile.
//!
//! A piece is drawn on an easel that is hardly larger than itself, and copied to its place. So a picture needs four bytes a pixel, however many
//! samples are drawn of each.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::easel::Easel;
use super::maps::Grade;
use super::present::Present;
use super::surface::texture;
use super::view::Shot;
use super::{Gpu, Plan, Props, Scene, Tile, View};
use crate::shading::{Piece, Pieces, Sort};

/// Longest side of a piece: its easel takes 37 MB with 4 samples.
const MOST_SIDE: u32 = 1024;

/// A picture of what a view shows, through the camera that it had when the picture was begun.
pub(crate) struct Picture {
    shot: Shot,
    may_be_rough: bool,
    pieces: Pieces,
    image: wgpu::TextureView,
    group: wgpu::BindGroup,
    /// How many pieces the device has been given, and how many of them it is done with.
    given: u32,
    done: Arc<AtomicU32>,
}

impl Drop for Picture {
    /// As of an easel.
    fn drop(&mut self) {
        self.image.texture().destroy();
    }
}

impl Picture {
    /// Begins a picture of so many pixels, whatever the size of the view is. One that is rough has one sample a pixel, where that makes a
    /// difference.
    pub(crate) fn new(gpu: &Gpu, view: &View, width: u32, height: u32, may_be_rough: bool) -> Self {
        let most = gpu.max_side();
        let (width, height) = (width.clamp(1, most), height.clamp(1, most));
        let usage = wgpu::TextureUsages::COPY_DST
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::RENDER_ATTACHMENT;
        let image = texture(&gpu.device, "rock-field/picture/image", (width, height), 1, gpu.kind.format, usage);
        let present = gpu.present.get_or_init(|| Present::new(&gpu.device, gpu.kind));
        let group = present.group(&gpu.device, &image);
        let whole = Tile { whole: [width as f32, height as f32], corner: [0.0; 2] };
        let shot = Shot { width, height, tile: Some(whole), ..view.shot };
        Self { shot, may_be_rough, pieces: Pieces::new(width, height), image, group, given: 0, done: Arc::default() }
    }

    /// Draws the next part of the maps that all pieces need. False where nothing is lacking.
    pub(crate) fn light(&mut self, gpu: &Gpu, view: &View, scene: &mut Scene, props: &Props) -> bool {
        let side = view.map_side(gpu, scene, props, self.grade(view));
        let is_lacking = view.prepare_next(gpu, scene, props, side);
        if is_lacking {
            self.sent(gpu);
        }
        is_lacking
    }

    /// Whether it has one sample a pixel. In motion the style may change before the first piece is drawn, and only natural colours can be rough.
    fn is_rough(&self, view: &View) -> bool {
        self.may_be_rough && view.is_natural()
    }

    /// Of the maps that are fine enough for it.
    fn grade(&self, view: &View) -> Grade {
        if self.shot.width < view.shot.width && self.shot.height < view.shot.height {
            Grade::Draft
        } else if self.is_rough(view) {
            Grade::Rough
        } else {
            Grade::Whole
        }
    }

    /// The device was given something to draw.
    fn sent(&mut self, gpu: &Gpu) {
        self.given += 1;
        let done = self.done.clone();
        gpu.queue.on_submitted_work_done(move || {
            done.fetch_add(1, Ordering::Relaxed);
        });
    }

    /// Draws the next piece, of about `pixels`. True while there is more to come. Between the pieces nothing that the view shows may change.
    pub(crate) fn draw_piece(
        &mut self,
        gpu: &Gpu,
        view: &View,
        scene: Option<&mut Scene>,
        props: &Props,
        plan: Option<&Plan>,
        pixels: u32,
    ) -> bool {
        let Some(piece) = self.pieces.next(pixels, MOST_SIDE) else {
            return false;
        };
        let scene = scene.map(|scene| {
            let side = view.map_side(gpu, scene, props, self.grade(view));
            let maps = view.prepare_for(gpu, scene, props, side);
            (&*scene, maps)
        });
        let is_rough = self.is_rough(view);
        let samples = if is_rough { 1 } else { gpu.kind.samples };
        let Piece { x, y, width, height } = piece;
        let mut easel = gpu.easel.borrow_mut();
        let easel = match &mut *easel {
            Some(easel) if easel.suits(samples, [width, height]) => easel,
            other => other.insert(Easel::new(&gpu.device, gpu.kind.format, samples, [width, height])),
        };
        let tile = self.shot.tile.map(|Tile { whole, .. }| Tile { whole, corner: [x as f32, y as f32] });
        let shot = Shot { width, height, tile, ..self.shot };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let attachments = easel.attachments(view.clear_color(gpu));
        view.paint(
            gpu,
            &mut encoder,
            attachments,
            &shot,
            scene,
            props,
            plan,
            if is_rough { Sort::Rough } else { Sort::Frame },
        );
        let mut place = self.image.texture().as_image_copy();
        place.origin = wgpu::Origin3d { x, y, z: 0 };
        encoder.copy_texture_to_texture(
            easel.frame().texture().as_image_copy(),
            place,
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        self.sent(gpu);
        !self.pieces.is_whole()
    }

    /// How many pieces the device is still drawing. Of a device that was lost this may never be 0.
    pub(crate) fn under_way(&self, gpu: &Gpu) -> u32 {
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        self.given - self.done.load(Ordering::Relaxed)
    }

    /// Whether there is no piece left to draw.
    pub(crate) fn is_whole(&self) -> bool {
        self.pieces.is_whole()
    }

    /// Where it is drawn.
    pub(crate) fn image(&self) -> &wgpu::TextureView {
        &self.image
    }

    /// Width and height, device pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.shot.width, self.shot.height]
    }

    /// Shows the picture on the view's own screen, as large as that; on a shared one in its own size, and whoever copies it from there scales it.
    pub(crate) fn show(&self, gpu: &Gpu, view: &View) {
        let Some(present) = gpu.present.get() else {
            return;
        };
        let (width, height) = if let Some(screen) = &gpu.shared {
            screen.borrow_mut().fit(&gpu.device, gpu.kind, self.shot.width, self.shot.height);
            (self.shot.width, self.shot.height)
        } else {
            (view.shot.width, view.shot.height)
        };
        view.show(gpu, |encoder, _, frame| {
            let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store };
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("rock-field/present/pass"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: frame,
                    depth_slice: None,
                    resolve_target: None,
                    ops,
                })],
                ..Default::default()
            });
            pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
            pass.set_pipeline(&present.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}
