//! Drawing the atlas of a field that is exported.

use super::super::bake::{Bake, SIDE as BAKE_SIDE};
use super::super::maps::Grade;
use super::super::pipelines::Natural;
use super::super::{Gpu, Props, Scene};
use super::View;
use crate::shading::{ColorMode, Quality, Recipe};

impl View {
    /// Draws a tile of the scene's atlas: the one whose upper left corner is `corner`, texels. Rocks stand where the
    /// field has them, and the quality is the highest.
    pub(crate) fn bake(&self, gpu: &Gpu, scene: &mut Scene, bake: &Bake, corner: [f32; 2]) {
        let props = Props::default();
        let side = Grade::Whole.side(gpu.max_side());
        scene.light(gpu, &self.look, &props, false, side);
        let mut globals = self.globals(&self.shot, None);
        let half = 0.5 * BAKE_SIDE as f32;
        globals.plan = [corner[0] + half, corner[1] + half, 1.0 / half, -1.0 / half];
        globals.eye = [0.0; 4];
        // No rock sinks.
        globals.scene[2] = 0.0;
        self.write(gpu, &globals);
        scene.paint(gpu, ColorMode::Natural, &self.look);
        while self.draw_maps(gpu, scene, &props, side, || {}) {}
        let maps = self.maps(gpu, scene, side).0;
        let encoder = gpu.device.create_command_encoder(&Default::default());
        let pipeline = gpu.pipelines.natural(&gpu.device, Natural::Bake, Recipe::of_bodies(Quality::High, &self.look));
        let patterns = gpu.pipelines.patterns(&gpu.device, &gpu.queue);
        let groups = [&self.frame_group, &scene.field_group, &maps.group, patterns];
        bake.draw(gpu, encoder, groups, &pipeline, |pass, pipeline| {
            scene.draw_rocks(pass, pipeline, &scene.whole());
        });
    }
}
