//! A still: the mean of many samples of a picture in natural colours, each in the light of one point of the sun, of the sky and of the
//! ground. It converges to what the sun, the sky and one bounce of light give.

use glam::{Vec2, Vec3, Vec4};

use super::maps::{Maps, group};
use super::pass::{MEAN_FORMAT, SAMPLE_FORMAT, SHADOW_FORMAT};
use super::pipelines::Fixed;
use super::surface::{DEPTH_FORMAT, depth_attachment, kept, texture};
use super::view::Shot;
use super::{Gpu, Picture, Props, RenderError, Scene, Tile, View, upload};
use crate::shading::{Bounds, FieldUniforms, Globals, Piece, Pieces, Sample, Sort, in_sight};

/// Most bytes that the textures of a still may take.
const MOST_BYTES: u64 = 1 << 29;

/// Bytes per pixel: two means.
const PIXEL_BYTES: u64 = 2 * 16;

/// Longest side of a piece of a sample: each clears all that it may be drawn on.
const PIECE_SIDE: u32 = 512;

/// Largest sides of the shadow maps of the sun, the sky and the ground, texels. The edges of a single shadow are seen of the sun's alone.
const SIDES: [u32; 3] = [4096, 2048, 2048];

/// Texels of the sun's map for each pixel along the longer side of the picture, which does not show more; half as many of the others.
const FINE: u32 = 4;

/// What the picture is taken through.
#[derive(Clone, Copy)]
pub(crate) struct Lens {
    /// px; at 0 everything is sharp.
    pub(crate) radius: f32,
    /// From the eye to the plane that is sharp, px.
    pub(crate) focus: f32,
}

/// One light of a sample: its shadow map, and the uniforms with which that is drawn.
struct Light {
    side: u32,
    map: wgpu::TextureView,
    uniforms: wgpu::Buffer,
    group: wgpu::BindGroup,
}

/// The samples of one picture.
pub(crate) struct Still {
    shot: Shot,
    lens: Lens,
    /// How many samples are whole.
    count: u32,
    /// Of the one after them: the light whose shadow map is drawn, which part of that is next, and what is left of the picture.
    light: usize,
    part: usize,
    pieces: Pieces,
    /// A piece of the sample, in the upper left corner.
    sample: wgpu::TextureView,
    depth: wgpu::TextureView,
    /// The mean is in one of them, by turns.
    means: [wgpu::TextureView; 2],
    /// Each mean with the newest sample.
    gathered: [wgpu::BindGroup; 2],
    /// Of the sun, the sky and the ground.
    lights: [Light; 3],
    uniforms: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Drop for Still {
    /// Memory of the device is not left to JavaScript's garbage collector.
    fn drop(&mut self) {
        for light in &self.lights {
            light.map.texture().destroy();
            light.uniforms.destroy();
        }
        self.uniforms.destroy();
        for view in self.means.iter().chain([&self.sample, &self.depth]) {
            view.texture().destroy();
        }
    }
}

impl Still {
    /// A still of what `view` shows, through its camera and as large as it is now, with the depth of field of `lens`. Fails with [`RenderError::TooLarge`].
    pub(crate) fn new(gpu: &Gpu, view: &View, lens: Lens) -> Result<Self, RenderError> {
        let shot = view.shot;
        let bytes = PIXEL_BYTES * u64::from(shot.width) * u64::from(shot.height);
        if bytes > MOST_BYTES {
            return Err(RenderError::TooLarge { what: "still", bytes, limit: MOST_BYTES });
        }
        let device = &gpu.device;
        let (drawn, read) = (wgpu::TextureUsages::RENDER_ATTACHMENT, wgpu::TextureUsages::TEXTURE_BINDING);
        let picture = |label, format, usage| texture(device, label, (shot.width, shot.height), 1, format, usage);
        let size = (shot.width.min(PIECE_SIDE), shot.height.min(PIECE_SIDE));
        let sample = texture(device, "rock-field/still/sample", size, 1, SAMPLE_FORMAT, drawn | read);
        let depth = texture(device, "rock-field/still/depth", size, 1, DEPTH_FORMAT, drawn);
        let means = [0, 1].map(|_| picture("rock-field/still/mean", MEAN_FORMAT, drawn | read));
        let gathered = [0, 1].map(|mean: usize| {
            let entry =
                |binding, view| wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) };
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("rock-field/still/gathered"),
                layout: &gpu.pipelines.still_layout,
                entries: &[entry(0, &means[mean]), entry(1, &sample)],
            })
        });
        let (uniforms, group) = uniforms(gpu)?;
        // In steps, so that equal pictures in two parts have equal maps.
        let longer = shot.width.max(shot.height).next_power_of_two();
        let light = |most: u32| {
            let (uniforms, group) = self::uniforms(gpu)?;
            let side = most.min(FINE * longer * most / SIDES[0]).min(gpu.max_side());
            let map = texture(device, "rock-field/still/shadows", (side, side), 1, SHADOW_FORMAT, drawn | read);
            Ok(Light { side, map, uniforms, group })
        };
        let [sun, sky, below] = SIDES.map(light);
        let lights = [sun?, sky?, below?];
        Ok(Self {
            shot,
            lens,
            count: 0,
            light: 0,
            part: 0,
            pieces: Pieces::new(shot.width, shot.height),
            sample,
            depth,
            means,
            gathered,
            lights,
            uniforms,
            group,
        })
    }

    /// Draws what comes next of a sample: a part of a shadow map, or a piece of the picture of about `pixels`. False when the sample is whole, and in the
    /// mean. The scene, the props and the view must be those of the samples before; what else is drawn may come between.
    pub(crate) fn draw(&mut self, gpu: &Gpu, view: &View, scene: &mut Scene, props: &Props, pixels: u32) -> bool {
        let Some(maps) = view.prepare(gpu, scene, props) else {
            return false;
        };
        let sample = Sample::new(self.count, view.sun());
        let globals = moved(view.globals(&self.shot, Some(scene)), &sample, self.lens);
        // Copies are lit as the field is, and may show any part of it.
        let shows_around = scene.shows_around(&view.sight(&globals, scene));
        let lit = if shows_around { scene.bounds } else { lit(&globals, scene.bounds) };
        let (uniforms, shadows) = scene.sampled(&sample, lit);
        if let (Some(light), Some(shadow)) = (self.lights.get(self.light), shadows.get(self.light)) {
            view.write(gpu, &globals);
            gpu.queue.write_buffer(&light.uniforms, 0, bytemuck::bytes_of(shadow));
            let texel = shadow.sun[3] / light.side as f32;
            let groups = [&view.frame_group, &light.group];
            let goes_on = scene.draw_shadows(gpu, groups, &light.map, texel, props, self.part);
            (self.light, self.part) = if goes_on { (self.light, self.part + 1) } else { (self.light + 1, 0) };
        } else if let Some(piece) = self.pieces.next(pixels, PIECE_SIDE) {
            gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
            scene.light_around(gpu, &uniforms, true);
            self.draw_piece(gpu, view, (scene, &maps), props, &sample, piece);
        }
        let is_whole = self.pieces.is_whole();
        if is_whole {
            self.count += 1;
            self.light = 0;
            self.pieces = Pieces::new(self.shot.width, self.shot.height);
        }
        !is_whole
    }

    /// Draws a piece of the picture of the sample, whose shadow maps are drawn, and adds it to the mean.
    fn draw_piece(
        &self,
        gpu: &Gpu,
        view: &View,
        (scene, maps): (&Scene, &Maps),
        props: &Props,
        sample: &Sample,
        Piece { x, y, width, height }: Piece,
    ) {
        let own = [self.shot.width as f32, self.shot.height as f32];
        let Tile { whole, corner } = self.shot.tile.unwrap_or(Tile { whole: own, corner: [0.0; 2] });
        let [left, top] = [x as f32, y as f32];
        let tile = Tile { whole, corner: [corner[0] + left, corner[1] + top] };
        let shot = Shot { width, height, tile: Some(tile), ..self.shot };
        let mut globals = moved(view.globals(&shot, Some(scene)), sample, self.lens);
        globals.scene[1] = 1.0 / (self.count + 1) as f32;
        // Where the mean has the piece.
        globals.plan = [left, top, 0.0, 0.0];
        view.write(gpu, &globals);
        let [sun, sky, below] = self.lights.each_ref().map(|light| &light.map);
        let others = [&maps.height, &maps.sky, &maps.hills, &maps.open];
        let maps_group = group(&gpu.device, &gpu.pipelines.maps_layout, [sun, sky, below], others);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/still/pass"),
            color_attachments: &[Some(cleared(&self.sample))],
            depth_stencil_attachment: Some(depth_attachment(&self.depth, wgpu::StoreOp::Discard)),
            ..Default::default()
        });
        pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
        for (index, group) in (0..).zip([&view.frame_group, &self.group, &maps_group]) {
            pass.set_bind_group(index, group, &[]);
        }
        view.draw_natural(&mut pass, gpu, scene, &self.group, &view.sight(&globals, scene), props, Sort::Sample);
        drop(pass);
        let gather = gpu.pipelines.fixed(&gpu.device, Fixed::Gather);
        let [before, after] = if self.count.is_multiple_of(2) { [0, 1] } else { [1, 0] };
        let place = [left, top, width as f32, height as f32];
        self.fill(view, &mut encoder, &self.means[after], place, gather, &self.gathered[before]);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Draws on a place of a target what a pipeline makes of a mean.
    fn fill(
        &self,
        view: &View,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        [left, top, width, height]: [f32; 4],
        pipeline: &wgpu::RenderPipeline,
        mean: &wgpu::BindGroup,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("rock-field/still/fill"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment { ops: kept(), ..cleared(target) })],
            ..Default::default()
        });
        pass.set_viewport(left, top, width, height, 0.0, 1.0);
        for (index, group) in (0..).zip([&view.frame_group, &self.group, mean]) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.set_pipeline(pipeline);
        pass.draw(0..3, 0..1);
    }

    /// Draws the mean of the samples over a picture of the same size, with this opacity, 0…1.
    pub(crate) fn develop(&self, gpu: &Gpu, view: &View, scene: &Scene, picture: &Picture, opacity: f32) {
        let mut globals = view.globals(&self.shot, Some(scene));
        globals.scene[1] = opacity;
        view.write(gpu, &globals);
        let develop = gpu.pipelines.fixed(&gpu.device, Fixed::Develop);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let newest = &self.gathered[if self.count.is_multiple_of(2) { 0 } else { 1 }];
        let place = [0.0, 0.0, self.shot.width as f32, self.shot.height as f32];
        self.fill(view, &mut encoder, picture.image(), place, develop, newest);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Width and height, device pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.shot.width, self.shot.height]
    }
}

/// An attachment that nothing is kept of.
fn cleared(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    }
}

fn uniforms(gpu: &Gpu) -> Result<(wgpu::Buffer, wgpu::BindGroup), RenderError> {
    let size = size_of::<FieldUniforms>() as u64;
    let uniforms =
        upload::buffer(&gpu.device, "rock-field/still/uniforms", "uniforms", size, wgpu::BufferUsages::UNIFORM)?;
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("rock-field/still/group"),
        layout: &gpu.pipelines.field_layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() }],
    });
    Ok((uniforms, group))
}

/// The same picture, of which each pixel shows what the sample's point of it sees through its point of the lens.
fn moved(mut globals: Globals, sample: &Sample, lens: Lens) -> Globals {
    let [_, _, width, height] = globals.tile;
    let by = sample.pixel;
    let mut shift = Vec4::new(-2.0 * by.x / width, 2.0 * by.y / height, 0.0, 0.0);
    if lens.radius > 0.0 {
        let [right, up] = [globals.ray_right, globals.ray_up].map(|axis| Vec4::from(axis).with_w(0.0));
        let at = sample.lens * lens.radius;
        let aside = right.normalize() * at.x + up.normalize() * at.y;
        globals.eye = (Vec4::from(globals.eye) + aside).to_array();
        // What is in focus stays where it is in the picture.
        globals.ray_forward = (Vec4::from(globals.ray_forward) - aside / lens.focus).to_array();
        shift.x += at.x / (lens.focus * right.length()) * globals.ray_right[3] / width;
        shift.y += at.y / (lens.focus * up.length()) * globals.ray_up[3] / height;
    }
    for column in &mut globals.clip_from_eye {
        let moved = Vec4::from(*column) + shift * column[3];
        *column = moved.to_array();
    }
    globals.tile[0] += by.x;
    globals.tile[1] += by.y;
    globals
}

/// What the picture shows of the box `bounds`.
fn lit(globals: &Globals, bounds: Bounds) -> Bounds {
    let [x, y, width, height] = globals.tile;
    let axis = |axis: [f32; 4]| Vec4::from(axis).truncate();
    let whole = Vec2::new(globals.ray_right[3], globals.ray_up[3]);
    let ray = |place: Vec2| -> Vec3 {
        let pixel = Vec2::new(x, y) + (place * Vec2::new(0.5, -0.5) + 0.5) * Vec2::new(width, height);
        let at = pixel / whole * Vec2::new(2.0, -2.0) + Vec2::new(-1.0, 1.0);
        axis(globals.ray_forward) + axis(globals.ray_right) * at.x + axis(globals.ray_up) * at.y
    };
    in_sight(axis(globals.eye), ray, bounds)
}
