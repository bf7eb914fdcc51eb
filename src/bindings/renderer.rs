//! The exports of the renderer artefacts. Each converts its arguments, makes a call, and converts the result.

use std::cell::RefCell;
use std::rc::Rc;

use wasm_bindgen::prelude::*;

use crate::render::{
    Bake, Camera, Gpu, Layer, Lens, Mesh, Picture, Plan, Prop, Props, RenderError, Rocks, Scene, Still, Tile, View,
};
use crate::shading::{ColorMode, Look, Mode, Quality, Sort};

thread_local! {
    // wgpu requires callbacks to be `Send`, which a JavaScript function is not, so they carry an index into this list.
    static LISTENERS: RefCell<Vec<Option<js_sys::Function>>> = const { RefCell::new(Vec::new()) };
}

fn listen(function: js_sys::Function) -> u32 {
    LISTENERS.with_borrow_mut(|list| {
        list.push(Some(function));
        list.len() as u32 - 1
    })
}

/// Calls listener `id` with the reason, once; later calls do nothing.
fn tell(id: u32, reason: &str) {
    let function = LISTENERS.with_borrow_mut(|list| list.get_mut(id as usize).and_then(Option::take));
    if let Some(function) = function {
        // There is nobody to report an exception of the listener to.
        let _ = function.call1(&JsValue::NULL, &reason.into());
    }
}

pub(super) fn to_js(error: &RenderError) -> js_sys::Error {
    let js = js_sys::Error::new(&error.to_string());
    js.set_name(error.code());
    js
}

/// A graphics device, which any number of [`Renderer`]s can share.
#[wasm_bindgen]
pub struct Device {
    listener: u32,
    gpu: Rc<Gpu>,
}

#[wasm_bindgen]
impl Device {
    /// Creates a device. With WebGL2 it is bound to `canvas`; with WebGPU it is for canvases like it. `on_lost(reason)`
    /// is called at most once.
    pub async fn create(
        canvas: web_sys::HtmlCanvasElement,
        on_lost: js_sys::Function,
    ) -> Result<Device, js_sys::Error> {
        let listener = listen(on_lost);
        let gpu = Gpu::new(canvas, listener, tell).await.map_err(|error| to_js(&error))?;
        Ok(Self { listener, gpu: Rc::new(gpu) })
    }

    /// Largest side of a picture, in device pixels.
    #[wasm_bindgen(js_name = maxSide)]
    pub fn max_side(&self) -> u32 {
        self.gpu.max_side()
    }

    /// Stops reporting losses and frees the device. Call it before `free`.
    pub fn close(&self) {
        // The listener is removed first, because freeing the device is reported as a loss too.
        LISTENERS.with_borrow_mut(|list| list.get_mut(self.listener as usize).map(Option::take));
        self.gpu.destroy();
    }
}

/// Draws one picture, with its own field.
#[wasm_bindgen]
pub struct Renderer {
    pub(super) gpu: Rc<Gpu>,
    pub(super) view: View,
    pub(super) scene: Option<Scene>,
    pub(super) props: Props,
    /// A log that is uploaded and will be shown with the next colony.
    pub(super) next_log: Option<Prop>,
    plan: Option<Plan>,
    layers: Vec<Layer>,
    pub(super) bake: Option<Bake>,
    still: Option<Still>,
    /// One that is drawn in pieces, and the one that was shown last.
    picture: Option<Picture>,
    shown: Option<Picture>,
}

#[wasm_bindgen]
impl Renderer {
    /// With WebGPU, pass the canvas to draw on. With WebGL2, pass none: the picture is then drawn in the corner of the
    /// device's canvas.
    #[wasm_bindgen(constructor)]
    pub fn new(device: &Device, canvas: Option<web_sys::HtmlCanvasElement>) -> Result<Renderer, js_sys::Error> {
        let gpu = device.gpu.clone();
        let own = canvas.map(|canvas| gpu.screen(canvas)).transpose().map_err(|error| to_js(&error))?;
        let view = View::new(&gpu, own).map_err(|error| to_js(&error))?;
        Ok(Self {
            gpu,
            view,
            scene: None,
            props: Props::default(),
            next_log: None,
            plan: None,
            layers: Vec::new(),
            bake: None,
            still: None,
            picture: None,
            shown: None,
        })
    }

    /// Takes a field's mesh, which replaces the present one. It is read, slice by slice, until the first picture is drawn, and must not change. `rock_layers` and `rock_sites` hold, per rock, the id of
    /// its layer and the index of its site.
    #[wasm_bindgen(js_name = setField)]
    #[allow(clippy::too_many_arguments, reason = "one flat buffer each")]
    pub fn set_field(
        &mut self,
        image_width: f32,
        image_height: f32,
        positions: &js_sys::Float32Array,
        normals: &js_sys::Float32Array,
        indices: &js_sys::Uint32Array,
        vertex_starts: Vec<u32>,
        index_starts: Vec<u32>,
        rock_layers: Vec<u32>,
        rock_sites: Vec<u32>,
    ) -> Result<(), js_sys::Error> {
        let rocks = Rocks { vertex_starts, index_starts, layers: rock_layers, sites: rock_sites };
        let mesh = Mesh { positions, normals, indices };
        let scene = Scene::new(&self.gpu, [image_width, image_height], &mesh, rocks);
        self.scene = Some(scene.map_err(|error| to_js(&error))?);
        self.plan = None;
        Ok(())
    }

    /// True if the wireframe is shown and waits for [`Renderer::set_edges`].
    #[wasm_bindgen(js_name = needsEdges)]
    pub fn needs_edges(&self) -> bool {
        let scene = self.scene.as_ref();
        self.view.mode == Mode::Wireframe && scene.is_some_and(|scene| !scene.has_edges())
    }

    /// Makes the wireframe's lines. Pass the same indices as to [`Renderer::set_field`].
    #[wasm_bindgen(js_name = setEdges)]
    pub fn set_edges(&mut self, indices: &js_sys::Uint32Array) -> Result<(), js_sys::Error> {
        match &mut self.scene {
            Some(scene) => scene.set_edges(&self.gpu, indices),
            None => Ok(()),
        }
        .map_err(|error| to_js(&error))
    }

    /// True if a plan is shown and waits for [`Renderer::add_layer`] and [`Renderer::make_plan`].
    #[wasm_bindgen(js_name = needsPlan)]
    pub fn needs_plan(&self) -> bool {
        let plan_shown = matches!(self.view.mode, Mode::Diagrams | Mode::Selection);
        plan_shown && self.scene.is_some() && self.plan.is_none()
    }

    /// Adds one layer to the plan that [`Renderer::make_plan`] will make.
    #[wasm_bindgen(js_name = addLayer)]
    pub fn add_layer(
        &mut self,
        id: u32,
        radius: f32,
        sites: Vec<f32>,
        cell_starts: Vec<u32>,
        cell_vertices: Vec<f32>,
        selected: Vec<u32>,
    ) {
        self.layers.push(Layer { id, radius, sites, cell_starts, cell_vertices, selected });
    }

    /// Makes the plan that the view asks for, and frees the layers.
    #[wasm_bindgen(js_name = makePlan)]
    pub fn make_plan(&mut self) -> Result<(), js_sys::Error> {
        let layers = std::mem::take(&mut self.layers);
        let plan = self.view.plan(&self.gpu, self.scene.as_ref(), &layers);
        self.plan = plan.map_err(|error| to_js(&error))?;
        Ok(())
    }

    /// Sets what is shown: the places of its words in `VIEWS` and `COLORS` of `www/renderer/order.gen.ts`.
    #[wasm_bindgen(js_name = setStyle)]
    pub fn set_style(&mut self, view: u8, color: u8, dark: bool) {
        let mode = Mode::at(view).unwrap_or(Mode::Rocks);
        let color = ColorMode::at(color).unwrap_or(ColorMode::Layer);
        if self.view.set_style(mode, color, dark) {
            self.plan = None;
        }
    }

    /// Sets the look. `values`: those of `LOOK` and then of `FLESH` in `www/renderer/order.gen.ts`. `materials`, per layer
    /// id: 0 mixed, 1 granite, 2 basalt, 3 sandstone, 4 limestone, 5 slate.
    #[wasm_bindgen(js_name = setLook)]
    pub fn set_look(&mut self, values: Vec<f32>, layer_ids: Vec<u32>, materials: Vec<u8>) {
        let changed = self.view.set_look(Look::new(&values, &layer_ids, &materials));
        if let Some(scene) = self.scene.as_mut().filter(|_| changed) {
            scene.unpaint();
        }
    }

    /// Sets the quality: the place of its word in `QUALITIES` of `www/renderer/order.gen.ts`. It matters only in natural
    /// colours.
    #[wasm_bindgen(js_name = setQuality)]
    pub fn set_quality(&mut self, level: u8) {
        self.view.set_quality(Quality::at(level).unwrap_or(Quality::High));
    }

    /// Sets the camera, with angles in radians and lengths in px; `fov` is the vertical field of view.
    #[wasm_bindgen(js_name = setCamera)]
    #[allow(clippy::too_many_arguments, reason = "a number each")]
    pub fn set_camera(
        &mut self,
        azimuth: f32,
        elevation: f32,
        distance: f32,
        target_x: f32,
        target_y: f32,
        target_z: f32,
        fov: f32,
    ) {
        self.view.set_camera(Camera { azimuth, elevation, distance, target: [target_x, target_y, target_z], fov });
    }

    /// Sets the size of the picture in device pixels, and how many of them make a CSS pixel.
    pub fn resize(&mut self, width: u32, height: u32, ratio: f32) {
        self.view.resize(&self.gpu, width, height, ratio);
    }

    /// Draws a part of a larger picture from now on, until [`Renderer::resize`]: the one of the size set there whose
    /// upper left corner is at `x`, `y` of the whole. `backing`: what stands in for ground and backdrop, 1 black, 2
    /// white, 0 neither.
    #[wasm_bindgen(js_name = setTile)]
    pub fn set_tile(&mut self, width: f32, height: f32, x: f32, y: f32, backing: u8) {
        self.view.set_tile(Tile { whole: [width.max(1.0), height.max(1.0)], corner: [x, y] }, backing);
    }

    /// Draws one frame.
    pub fn render(&mut self) -> Result<(), js_sys::Error> {
        self.view.render(&self.gpu, self.scene.as_mut(), &self.props, self.plan.as_ref());
        self.checked(())
    }

    /// Begins a still of what the view shows, of the size and through the camera that are set, in place of another. It needs natural
    /// colours; what it shows must not change until [`Renderer::end_still`]. `lens`: the radius of the lens, 0 where all is sharp, and how far
    /// away the plane is that is sharp, px.
    #[wasm_bindgen(js_name = beginStill)]
    pub fn begin_still(&mut self, lens: f32, focus: f32) -> Result<(), js_sys::Error> {
        self.still = None;
        let lens = Lens { radius: lens, focus };
        self.still = Some(Still::new(&self.gpu, &self.view, lens).map_err(|error| to_js(&error))?);
        Ok(())
    }

    /// Makes one of the things that the next picture lacks, none of which takes long. `sort`: 0 for a picture, 1 for a rough one, 2
    /// for the samples of a still. `may_draw`: the device has made all pipelines that it was asked for, so that things can be drawn, too. False
    /// where nothing was lacking.
    #[wasm_bindgen(js_name = makeNext)]
    pub fn make_next(&mut self, sort: u8, may_draw: bool) -> Result<bool, js_sys::Error> {
        let sort = match sort {
            0 => Sort::Frame,
            1 => Sort::Rough,
            _ => Sort::Sample,
        };
        let is_made = self.view.make_next(&self.gpu, self.scene.as_mut(), &self.props, sort, may_draw);
        self.checked(is_made)
    }

    /// Draws the next part of a sample of the still, out of sight: a part of a shadow map, or a piece of about `pixels`. False when the sample is whole.
    #[wasm_bindgen(js_name = drawSample)]
    pub fn draw_sample(&mut self, pixels: u32) -> bool {
        let Self { gpu, view, scene, props, still, .. } = self;
        match (still, scene) {
            (Some(still), Some(scene)) => still.draw(gpu, view, scene, props, pixels),
            _ => false,
        }
    }

    /// Shows the mean of the still's samples.
    #[wasm_bindgen(js_name = showStill)]
    pub fn show_still(&self) {
        if let (Some(still), Some(scene)) = (&self.still, &self.scene) {
            let [width, height] = still.size();
            let picture = Picture::new(&self.gpu, &self.view, width, height, false);
            still.develop(&self.gpu, &self.view, scene, &picture, 1.0);
            picture.show(&self.gpu, &self.view);
        }
    }

    /// Draws the mean of the still's samples over the picture that is shown, with this opacity, and shows it. False, and nothing changes, where no
    /// picture of the same size is shown.
    #[wasm_bindgen(js_name = refinePicture)]
    pub fn refine_picture(&self, opacity: f32) -> bool {
        let (Some(still), Some(scene), Some(picture)) = (&self.still, &self.scene, &self.shown) else {
            return false;
        };
        if still.size() != picture.size() {
            return false;
        }
        still.develop(&self.gpu, &self.view, scene, picture, opacity);
        picture.show(&self.gpu, &self.view);
        true
    }

    /// Frees the still.
    #[wasm_bindgen(js_name = endStill)]
    pub fn end_still(&mut self) {
        self.still = None;
    }

    /// Begins a picture of so many pixels, in pieces and out of sight, in place of one that is not whole; a rough one has one sample a pixel.
    /// It shows what the view shows now, through the camera of now. Nothing of that may change until it is whole, but the camera.
    #[wasm_bindgen(js_name = beginPicture)]
    pub fn begin_picture(&mut self, width: u32, height: u32, is_rough: bool) {
        self.picture = None;
        self.picture = Some(Picture::new(&self.gpu, &self.view, width, height, is_rough));
    }

    /// Draws the next part of what gives light to the picture, out of sight: its shadows and heights. False where nothing is lacking.
    #[wasm_bindgen(js_name = lightPicture)]
    pub fn light_picture(&mut self) -> bool {
        let Self { gpu, view, scene, props, picture, .. } = self;
        picture.as_mut().zip(scene.as_mut()).is_some_and(|(picture, scene)| picture.light(gpu, view, scene, props))
    }

    /// Draws the next piece of the picture, of about so many pixels. False when the picture is whole.
    #[wasm_bindgen(js_name = drawPiece)]
    pub fn draw_piece(&mut self, pixels: u32) -> bool {
        let Self { gpu, view, scene, props, plan, picture, .. } = self;
        picture
            .as_mut()
            .is_some_and(|picture| picture.draw_piece(gpu, view, scene.as_mut(), props, plan.as_ref(), pixels))
    }

    /// How many pieces of the picture the device is still drawing.
    #[wasm_bindgen(js_name = piecesUnderWay)]
    pub fn pieces_under_way(&self) -> u32 {
        self.picture.as_ref().map_or(0, |picture| picture.under_way(&self.gpu))
    }

    /// Shows the picture if it is whole, and else the one that was shown last. False if there is none.
    #[wasm_bindgen(js_name = showPicture)]
    pub fn show_picture(&mut self) -> bool {
        if let Some(picture) = self.picture.take_if(|picture| picture.is_whole()) {
            self.shown = Some(picture);
        }
        let Some(picture) = &self.shown else {
            return false;
        };
        picture.show(&self.gpu, &self.view);
        true
    }

    /// Frees both pictures.
    #[wasm_bindgen(js_name = endPictures)]
    pub fn end_pictures(&mut self) {
        (self.picture, self.shown) = (None, None);
    }

    /// Frees what other renderers of the device may use. Call it before `free`.
    pub fn close(&self) {
        self.view.release(&self.gpu);
    }
}

impl Renderer {
    /// What was made, unless it was found out meanwhile that the field cannot be drawn.
    fn checked<T>(&self, made: T) -> Result<T, js_sys::Error> {
        match self.scene.as_ref().and_then(Scene::fault) {
            Some(fault) => Err(to_js(fault)),
            None => Ok(made),
        }
    }
}
