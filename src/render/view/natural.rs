//! How a view is drawn in natural colours, and what has to be made before.

use super::super::maps::Grade;
use super::super::pipelines::{Fixed, Natural};
use super::super::present::Present;
use super::super::{Gpu, Props, Scene};
use super::View;
use crate::shading::{Recipe, Sight, Sort};

/// In a rough picture, a triangle of a copy stands for about so many square pixels of what lies at the distance of the picture's own height.
const COARSE: f32 = 16.0;

/// Pixels of a rough picture per px of the world, at a distance of 1 px, from which it shows all that there is: it is about 650 pixels high.
const FINE: f32 = 1000.0;

impl View {
    /// Draws the scene; `field` is the group 1 that is bound.
    #[allow(clippy::too_many_arguments, reason = "what is drawn, and on what")]
    pub(in super::super) fn draw_natural(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        gpu: &Gpu,
        scene: &Scene,
        field: &wgpu::BindGroup,
        sight: &Sight,
        props: &Props,
        sort: Sort,
    ) {
        let sight = &if sort == Sort::Rough { coarser(sight) } else { *sight };
        let seen = &scene.seen(sight);
        let pipeline = |what| self.pipeline(gpu, props, what, sort);
        pass.set_bind_group(3, gpu.pipelines.patterns(&gpu.device, &gpu.queue), &[]);
        pass.set_pipeline(gpu.pipelines.fixed(&gpu.device, Fixed::floor(sort)));
        pass.draw(0..3, 0..1);
        scene.draw_rocks(pass, &pipeline(Natural::Rocks), seen);
        if scene.is_turned {
            scene.draw_rocks(pass, &pipeline(Natural::Insides), seen);
        }
        // In a small picture of a motion few triangles of copies can be told apart.
        let most = if sort == Sort::Rough { (sight.scale * sight.scale / COARSE) as u32 } else { u32::MAX };
        scene.draw_around(pass, gpu, &pipeline(Natural::Rocks), sight, self.quality.surroundings().min(most));
        pass.set_bind_group(1, field, &[]);
        if !props.is_empty() {
            props.draw(pass, [&pipeline(Natural::Log), &pipeline(ears(props))]);
        }
        // The backdrop and the ground come last, so that only their visible parts are shaded.
        pass.set_pipeline(&pipeline(Natural::Ground));
        pass.draw(0..6, 0..1);
    }

    fn pipeline(&self, gpu: &Gpu, props: &Props, what: Natural, sort: Sort) -> wgpu::RenderPipeline {
        gpu.pipelines.natural(&gpu.device, what, self.recipe(props, what, sort))
    }

    fn recipe(&self, props: &Props, what: Natural, sort: Sort) -> Recipe {
        let recipe = match what {
            Natural::Ground => Recipe::of_ground(self.quality, &self.look, props.axis().is_some()),
            _ => Recipe::of_bodies(self.quality, &self.look),
        };
        recipe.of(sort)
    }

    /// Dresses a scene that no picture was drawn of yet.
    fn dress_first(&self, gpu: &Gpu, scene: &mut Scene, props: &Props, sort: Sort) -> bool {
        let grade = if sort == Sort::Rough { Grade::Draft } else { Grade::Whole };
        let side = if scene.side() > 0 { scene.side() } else { grade.side(gpu.max_side()) };
        self.dress_next(gpu, scene, props, side)
    }

    /// Makes one of the things that pictures of this sort still lack, none of which takes long; `scene` if it is there already. False where nothing
    /// was lacking. Pipelines come first; what is drawn with them, only if `may_draw`.
    pub(crate) fn make_next(
        &self,
        gpu: &Gpu,
        scene: Option<&mut Scene>,
        props: &Props,
        sort: Sort,
        may_draw: bool,
    ) -> bool {
        if sort != Sort::Sample && gpu.present.get().is_none() {
            gpu.present.get_or_init(|| Present::new(&gpu.device, gpu.kind));
            return true;
        }
        self.make_next_pipeline(gpu, scene.as_deref(), props, sort)
            || (may_draw && scene.is_some_and(|scene| self.dress_first(gpu, scene, props, sort)))
    }

    fn make_next_pipeline(&self, gpu: &Gpu, scene: Option<&Scene>, props: &Props, sort: Sort) -> bool {
        if !self.is_solid() {
            return false;
        }
        let pipelines = &gpu.pipelines;
        let fixed: &[Fixed] = match sort {
            _ if !self.is_natural() => &[Fixed::Shadow, Fixed::Height, Fixed::Ground, Fixed::Outsides, Fixed::Insides],
            Sort::Sample => &[Fixed::SampleFloor, Fixed::Gather, Fixed::Develop],
            _ => &[Fixed::Shadow, Fixed::Height, Fixed::Open, Fixed::OpenRocks, Fixed::floor(sort)],
        };
        if fixed.iter().any(|what| pipelines.makes_fixed(&gpu.device, *what)) {
            return true;
        }
        let natural = [
            (true, Natural::Rocks),
            (scene.is_some_and(|scene| scene.is_turned), Natural::Insides),
            (!props.is_empty(), Natural::Log),
            (!props.is_empty(), ears(props)),
            (true, Natural::Ground),
        ];
        self.is_natural()
            && (pipelines.makes_patterns(&gpu.device, &gpu.queue)
                || gpu.maps.borrow_mut().makes_hills(&gpu.device, &gpu.queue)
                || natural.into_iter().any(|(is_drawn, what)| {
                    is_drawn && pipelines.makes_natural(&gpu.device, what, self.recipe(props, what, sort))
                }))
    }
}

/// The smaller a picture of a motion is, the more of its smallest rocks are left to the ground's shader. Triangles stay as small as in the shadow map,
/// since larger ones would lie in their own shade.
fn coarser(sight: &Sight) -> Sight {
    Sight { least: sight.least * (FINE / sight.scale).clamp(1.0, 4.0), ..*sight }
}

fn ears(props: &Props) -> Natural {
    if props.is_closed() { Natural::Bodies } else { Natural::Sheets }
}
