//! One canvas: its camera, its style, and how a frame is drawn.

mod atlas;
mod natural;

use glam::{Mat4, Vec3, Vec4};

use super::maps::{Grade, Maps, Stale};
use super::pipelines::Fixed;
use super::surface::Screen;
use super::{Camera, Gpu, Layer, Plan, Props, RenderError, Scene, upload};
use crate::shading::palette::{self, DARK, LIGHT};
use crate::shading::{ColorMode, Globals, Look, Mode, Quality, Sight, Sort};

/// A part of a larger picture: the size of the whole and where the part's upper left corner is in it, device pixels.
#[derive(Clone, Copy)]
pub(crate) struct Tile {
    pub(crate) whole: [f32; 2],
    pub(crate) corner: [f32; 2],
}

/// A picture, or a part of one: through which camera, and of what size in device pixels.
#[derive(Clone, Copy)]
pub(crate) struct Shot {
    pub(crate) camera: Camera,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) tile: Option<Tile>,
}

/// In natural colours, rocks that cover less on the mean are not drawn one by one, square pixels.
const SMALLEST: f32 = 6.0;

/// The state of one canvas.
pub(crate) struct View {
    /// A number that no other view or scene of the device has.
    number: u64,
    /// `None` if all views share one screen: [`Gpu::shared`].
    own: Option<Screen>,
    pub(super) shot: Shot,
    /// 1 or 2 where black or white stands in for ground and backdrop, else 0.
    backing: u8,
    globals: wgpu::Buffer,
    pub(super) frame_group: wgpu::BindGroup,
    pub(crate) mode: Mode,
    color: ColorMode,
    look: Look,
    quality: Quality,
    dark: bool,
    /// Device pixels per CSS pixel.
    ratio: f32,
}

impl View {
    /// Makes a view. With WebGPU, `own` is the screen of its own canvas.
    pub(crate) fn new(gpu: &Gpu, own: Option<Screen>) -> Result<Self, RenderError> {
        let globals = upload::buffer(
            &gpu.device,
            "rock-field/view/globals",
            "uniforms",
            size_of::<Globals>() as u64,
            wgpu::BufferUsages::UNIFORM,
        )?;
        let frame_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("rock-field/view/group"),
            layout: &gpu.pipelines.frame_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: globals.as_entire_binding() }],
        });
        Ok(Self {
            number: gpu.next_number(),
            own,
            shot: Shot {
                camera: Camera { azimuth: 0.0, elevation: 1.0, distance: 1000.0, target: [0.0; 3], fov: 1.0 },
                width: 1,
                height: 1,
                tile: None,
            },
            backing: 0,
            globals,
            frame_group,
            mode: Mode::Rocks,
            color: ColorMode::Layer,
            look: Look::default(),
            quality: Quality::High,
            dark: false,
            ratio: 1.0,
        })
    }

    pub(crate) fn set_camera(&mut self, camera: Camera) {
        self.shot.camera = camera.sanitised();
    }

    /// Draws a part of a picture from now on, as large as the view; `backing` is what stands in for ground and backdrop.
    pub(crate) fn set_tile(&mut self, tile: Tile, backing: u8) {
        (self.shot.tile, self.backing) = (Some(tile), backing);
    }

    /// Sets the size in device pixels, clamped to what a texture can hold, and the device pixels per CSS pixel. The
    /// picture is drawn whole again.
    pub(crate) fn resize(&mut self, gpu: &Gpu, width: u32, height: u32, ratio: f32) {
        (self.shot.tile, self.backing) = (None, 0);
        self.ratio = if ratio.is_finite() { ratio.max(0.25) } else { 1.0 };
        let max = gpu.max_side();
        (self.shot.width, self.shot.height) = (width.clamp(1, max), height.clamp(1, max));
        if let Some(screen) = &mut self.own {
            screen.resize(&gpu.device, gpu.kind, self.shot.width, self.shot.height);
        }
    }

    /// Frees what other views can use.
    pub(crate) fn release(&self, gpu: &Gpu) {
        gpu.maps.borrow_mut().release(self.number, u32::MAX);
        self.globals.destroy();
    }

    /// Sets what is shown. Returns true if a plan made before no longer fits.
    pub(crate) fn set_style(&mut self, mode: Mode, color: ColorMode, dark: bool) -> bool {
        let changed = (mode, dark) != (self.mode, self.dark);
        (self.mode, self.color, self.dark) = (mode, color, dark);
        changed
    }

    /// Sets the look. Returns true if the rocks' materials have changed.
    pub(crate) fn set_look(&mut self, look: Look) -> bool {
        let changed = look.materials != self.look.materials;
        self.look = look;
        changed
    }

    pub(crate) fn set_quality(&mut self, quality: Quality) {
        self.quality = quality;
    }

    /// Makes the plan that this view shows, if it shows one.
    pub(crate) fn plan(&self, gpu: &Gpu, scene: Option<&Scene>, layers: &[Layer]) -> Result<Option<Plan>, RenderError> {
        let theme = if self.dark { &DARK } else { &LIGHT };
        match (self.mode, scene) {
            (Mode::Diagrams, Some(scene)) => Plan::diagrams(gpu, scene.image, layers, self.dark, theme).map(Some),
            (Mode::Selection, Some(scene)) => Plan::selection(gpu, scene.image, layers, theme).map(Some),
            _ => Ok(None),
        }
    }

    /// Draws one frame, which shows only the backdrop if `scene` is `None`. If the screen is shared, the frame is in
    /// its top left corner until another view is drawn.
    pub(crate) fn render(&self, gpu: &Gpu, scene: Option<&mut Scene>, props: &Props, plan: Option<&Plan>) {
        if let Some(screen) = &gpu.shared {
            screen.borrow_mut().grow(&gpu.device, gpu.kind, self.shot.width, self.shot.height);
        }
        self.show(gpu, |encoder, screen, frame| self.encode(gpu, encoder, screen, frame, scene, props, plan));
    }

    /// Shows what `encode` draws on the screen's next texture. One that is shared has to be large enough.
    pub(super) fn show(&self, gpu: &Gpu, encode: impl FnOnce(&mut wgpu::CommandEncoder, &Screen, &wgpu::TextureView)) {
        let shared = gpu.shared.as_ref().map(|screen| screen.borrow());
        let Some(screen) = self.own.as_ref().or(shared.as_deref()) else {
            return;
        };
        let Some(texture) = screen.acquire(&gpu.device, gpu.kind) else {
            return;
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encode(&mut encoder, screen, &texture.texture.create_view(&Default::default()));
        gpu.queue.submit([encoder.finish()]);
        gpu.queue.present(texture);
    }

    /// Does the next thing that takes some milliseconds before the scene is painted, and lit for maps of this side. False if it is so.
    pub(super) fn dress_next(&self, gpu: &Gpu, scene: &mut Scene, props: &Props, side: u32) -> bool {
        scene.fill(gpu)
            || self.is_solid() && scene.paint(gpu, self.shown_color(), &self.look)
            || scene.light(gpu, &self.look, props, self.is_surrounded(), side)
    }

    fn dress(&self, gpu: &Gpu, scene: &mut Scene, props: &Props, side: u32) {
        while self.dress_next(gpu, scene, props, side) {}
    }

    /// The side of the maps for a picture of the scene that needs them of this grade: of better ones, if they are drawn already.
    pub(super) fn map_side(&self, gpu: &Gpu, scene: &mut Scene, props: &Props, grade: Grade) -> u32 {
        let least = if self.is_natural() { grade } else { Grade::Whole }.side(gpu.max_side());
        // What changes its light makes its maps stale, whatever their side.
        let lit = if scene.side() == 0 { least } else { scene.side() };
        self.dress(gpu, scene, props, lit);
        gpu.maps.borrow().finest(self.number, scene.drawn).max(least)
    }

    /// Makes the scene ready to be drawn, with its maps.
    pub(super) fn prepare(&self, gpu: &Gpu, scene: &mut Scene, props: &Props) -> Option<Maps> {
        let side = self.map_side(gpu, scene, props, Grade::Whole);
        self.prepare_for(gpu, scene, props, side)
    }

    /// The same with maps of this side.
    pub(super) fn prepare_for(&self, gpu: &Gpu, scene: &mut Scene, props: &Props, side: u32) -> Option<Maps> {
        while self.prepare_next(gpu, scene, props, side) {}
        self.is_solid().then(|| self.maps(gpu, scene, side).0)
    }

    /// Does the next thing before the scene is ready to be drawn with maps of this side: of the maps, a part is submitted. False if it is ready.
    pub(super) fn prepare_next(&self, gpu: &Gpu, scene: &mut Scene, props: &Props, side: u32) -> bool {
        self.dress(gpu, scene, props, side);
        // Before the uniforms of the picture are written: rocks sink by these.
        let globals = || self.write(gpu, &self.globals(&self.shot, Some(scene)));
        let goes_on = self.is_solid() && self.draw_maps(gpu, scene, props, side, globals);
        if !goes_on {
            gpu.maps.borrow_mut().release(self.number, side);
        }
        goes_on
    }

    /// The maps of a scene, which of them are stale, and how many parts of these are drawn.
    fn maps(&self, gpu: &Gpu, scene: &Scene, side: u32) -> (Maps, Stale, usize) {
        let layout = &gpu.pipelines.maps_layout;
        gpu.maps.borrow_mut().lend(&gpu.device, &gpu.queue, layout, side, self.number, scene.drawn)
    }

    /// Draws the next part of the maps of a scene that is dressed, after `write` has written the uniforms. False where none is stale.
    fn draw_maps(&self, gpu: &Gpu, scene: &Scene, props: &Props, side: u32, write: impl FnOnce()) -> bool {
        let (maps, stale, part) = self.maps(gpu, scene, side);
        if !stale.shadows && !stale.heights {
            return false;
        }
        write();
        let goes_on = scene.draw_maps(gpu, &self.frame_group, &maps, stale, props, self.is_natural(), part);
        gpu.maps.borrow_mut().drew(side, self.number, !goes_on);
        true
    }

    #[allow(clippy::too_many_arguments, reason = "what is drawn, and on what")]
    fn encode(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        screen: &Screen,
        frame: &wgpu::TextureView,
        scene: Option<&mut Scene>,
        props: &Props,
        plan: Option<&Plan>,
    ) {
        let scene = scene.map(|scene| {
            let maps = self.prepare(gpu, scene, props);
            (&*scene, maps)
        });
        let attachments = screen.attachments(&gpu.device, gpu.kind, frame, self.clear_color(gpu));
        self.paint(gpu, encoder, attachments, &self.shot, scene, props, plan, Sort::Frame);
    }

    /// Draws what the view shows on a cleared target that is at least as large as `shot`; of this `sort`.
    #[allow(clippy::too_many_arguments, reason = "what is drawn, and on what")]
    pub(super) fn paint(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (color, depth): (wgpu::RenderPassColorAttachment<'_>, wgpu::RenderPassDepthStencilAttachment<'_>),
        shot: &Shot,
        scene: Option<(&Scene, Option<Maps>)>,
        props: &Props,
        plan: Option<&Plan>,
        sort: Sort,
    ) {
        let mut globals = self.globals(shot, scene.as_ref().map(|(scene, _)| *scene));
        // A picture that is smaller than the screen has fewer pixels in a CSS pixel.
        globals.eye[3] *= globals.ray_right[3] / self.shot.tile.map_or(self.shot.width as f32, |tile| tile.whole[0]);
        self.write(gpu, &globals);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/view/pass"),
            color_attachments: &[Some(color)],
            depth_stencil_attachment: Some(depth),
            ..Default::default()
        });
        pass.set_viewport(0.0, 0.0, shot.width as f32, shot.height as f32, 0.0, 1.0);
        if let Some((scene, maps)) = scene {
            if let Some(maps) = &maps {
                pass.set_bind_group(2, &maps.group, &[]);
            }
            pass.set_bind_group(0, &self.frame_group, &[]);
            pass.set_bind_group(1, &scene.field_group, &[]);
            self.draw(&mut pass, gpu, scene, &self.sight(&globals, scene), props, plan, sort);
        }
    }

    /// Sets the uniforms of what is submitted next.
    pub(super) fn write(&self, gpu: &Gpu, globals: &Globals) {
        gpu.queue.write_buffer(&self.globals, 0, bytemuck::bytes_of(globals));
    }

    /// Draws what the mode shows of the scene, with all groups bound.
    #[allow(clippy::too_many_arguments, reason = "what is drawn, and on what")]
    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        gpu: &Gpu,
        scene: &Scene,
        sight: &Sight,
        props: &Props,
        plan: Option<&Plan>,
        sort: Sort,
    ) {
        let seen = &scene.seen(sight);
        let pipeline = |what| gpu.pipelines.fixed(&gpu.device, what);
        match (self.mode, plan) {
            (Mode::Rocks, _) if self.is_natural() => {
                self.draw_natural(pass, gpu, scene, &scene.field_group, sight, props, sort);
            }
            (Mode::Rocks, _) => {
                draw_ground(pass, gpu, scene);
                for sides in [Fixed::Outsides, Fixed::Insides].map(&pipeline) {
                    scene.draw_rocks(pass, sides, seen);
                }
                if !props.is_empty() {
                    props.draw(pass, [pipeline(Fixed::Wood); 2]);
                }
            }
            (Mode::Wireframe, _) => {
                let [fill, edges] = [Fixed::WireFill, Fixed::WireEdges].map(&pipeline);
                draw_ground(pass, gpu, scene);
                scene.draw_rocks(pass, fill, seen);
                scene.draw_edges(pass, edges);
                if !props.is_empty() {
                    let [fill, edges] = [Fixed::WoodFill, Fixed::WoodEdges].map(&pipeline);
                    props.draw(pass, [fill; 2]);
                    props.draw_edges(pass, edges);
                }
            }
            (_, Some(plan)) => plan.draw(pass, [Fixed::PlanFills, Fixed::PlanStrokes].map(&pipeline)),
            (_, None) => {}
        }
    }

    /// In natural colours, rocks have as many triangles as can be told apart. In the papers' style every facet is seen.
    pub(super) fn sight(&self, globals: &Globals, scene: &Scene) -> Sight {
        let natural = self.is_natural();
        Sight {
            clip_from_eye: Mat4::from_cols_array_2d(&globals.clip_from_eye),
            eye: Vec4::from(globals.eye).truncate(),
            sunk: if natural { scene.highest() } else { 0.0 },
            scale: 0.5 * globals.ray_up[3] / self.shot.camera.tangent(),
            most: if natural { self.quality.triangle() } else { 0.0 },
            // Smaller ones are left to the ground's shader, which finds them in the map of heights.
            least: if scene.is_repeated() { SMALLEST } else { 0.0 },
            is_part: globals.tile[2] < globals.ray_right[3] || globals.tile[3] < globals.ray_up[3],
        }
    }

    fn is_solid(&self) -> bool {
        matches!(self.mode, Mode::Rocks | Mode::Wireframe)
    }

    /// The direction of the sun's middle.
    pub(super) fn sun(&self) -> Vec3 {
        self.look.sun
    }

    /// Whether the ground goes on beyond the field.
    fn is_surrounded(&self) -> bool {
        self.is_natural() && self.backing == 0
    }

    pub(super) fn is_natural(&self) -> bool {
        self.mode == Mode::Rocks && self.color == ColorMode::Natural
    }

    /// The colour mode in use. The wireframe shows no stone, so natural colours are replaced by colours by layer.
    fn shown_color(&self) -> ColorMode {
        if self.color == ColorMode::Natural && !self.is_natural() { ColorMode::Layer } else { self.color }
    }

    /// The colour around a plan. The other views cover every pixel themselves.
    pub(super) fn clear_color(&self, gpu: &Gpu) -> wgpu::Color {
        if self.backing > 0 {
            return if self.backing == 1 { wgpu::Color::BLACK } else { wgpu::Color::WHITE };
        }
        let theme = if self.dark { &DARK } else { &LIGHT };
        let [r, g, b] = if gpu.kind.format.is_srgb() {
            let [r, g, b, _] = palette::linear(theme.table);
            [r, g, b].map(f64::from)
        } else {
            theme.table.map(|c| f64::from(c) / 255.0)
        };
        wgpu::Color { r, g, b, a: 1.0 }
    }

    pub(super) fn globals(&self, shot: &Shot, scene: Option<&Scene>) -> Globals {
        let theme = if self.dark { &DARK } else { &LIGHT };
        let own = [shot.width as f32, shot.height as f32];
        let Tile { whole: [width, height], corner: [x, y] } =
            shot.tile.unwrap_or(Tile { whole: own, corner: [0.0; 2] });
        // From the whole picture's clip space to the tile's.
        let scale = [width / own[0], height / own[1]];
        let shift = [(width - 2.0 * x - own[0]) / own[0], (2.0 * y + own[1] - height) / own[1]];
        let aspect = width / height;
        let frame = shot.camera.frame();
        let (center, radius) = scene.map_or((frame.eye, 1.0), |scene| (scene.center, scene.radius));
        let tangent = frame.tangent;
        // At the target's distance, a plan shows as much as the 3D view: half the height is distance · tan.
        let zoom = 1.0 / (shot.camera.distance * tangent);
        let natural = self.is_natural();
        let horizon = natural.then(|| scene.map_or(0.0, Scene::highest));
        let wireframe = if self.mode == Mode::Wireframe { 1.0 } else { 0.0 };
        Globals {
            clip_from_eye: (Mat4::from_translation(Vec3::new(shift[0], shift[1], 0.0))
                * Mat4::from_scale(Vec3::new(scale[0], scale[1], 1.0))
                * frame.clip_from_eye(aspect, center, radius, horizon))
            .to_cols_array_2d(),
            eye: frame.eye.extend(self.ratio).to_array(),
            ray_right: (frame.right * tangent * aspect).extend(width).to_array(),
            ray_up: (frame.up * tangent).extend(height).to_array(),
            ray_forward: frame.forward.extend(wireframe).to_array(),
            plan: [
                shot.camera.target[0] - shift[0] / (zoom / aspect * scale[0]),
                shot.camera.target[1] - shift[1] / (zoom * scale[1]),
                zoom / aspect * scale[0],
                zoom * scale[1],
            ],
            tile: [x, y, own[0], own[1]],
            backdrop_low: palette::linear(theme.backdrop_low),
            backdrop_high: palette::linear(theme.backdrop_high),
            soil: Vec4::from(palette::linear(theme.soil)).truncate().extend(f32::from(self.backing)).to_array(),
            dust: palette::linear(theme.dust),
            weather: self.look.weather,
            waters: [self.look.snow, self.look.water, 0.0, 0.0],
            scene: [self.look.ground, 0.0, if natural { 1.0 } else { 0.0 }, f32::from(self.look.debris)],
            flesh: self.look.flesh,
        }
    }
}

/// Draws the backdrop and the ground in the papers' style, and the ground's depth too if something extends below it.
fn draw_ground(pass: &mut wgpu::RenderPass<'_>, gpu: &Gpu, scene: &Scene) {
    pass.set_pipeline(gpu.pipelines.fixed(&gpu.device, Fixed::Ground));
    pass.draw(0..3, 0..1);
    if scene.is_buried {
        pass.set_pipeline(gpu.pipelines.fixed(&gpu.device, Fixed::Floor));
        pass.draw(0..3, 0..1);
    }
}
