//! The pieces of work that a run consists of.

use super::apart::Separator;
use super::bitmap::Bitmap;
use super::cache::{LayerCache, SelectionKey, SitesKey};
use super::mesh::Mesh;
use super::mesher::{Mesher, Source};
use super::paint::Paint;
use super::select::{Selector, flag};
use super::shape::Shaper;
use super::sites::DartThrower;
use super::voronoi::VoronoiBuilder;
use crate::params::{Params, Stage};

/// Number of picks, cells or rocks that one step works on, which takes one to three milliseconds in wasm.
const PICKS_PER_STEP: u32 = 1 << 15;
const CELLS_PER_STEP: usize = 1 << 11;
const ROCKS_PER_STEP: usize = 1 << 10;
/// Number of vertices that one step draws apart.
pub(super) const VERTICES_PER_STEP: usize = 1 << 15;

/// The pixels that coarser layers have taken.
#[derive(Debug)]
pub(super) struct Taken {
    pub(super) bitmap: Bitmap,
    /// Whether they are those of the selections that are made without the paint.
    pub(super) open: bool,
    /// How many selections are flagged already, coarsest first.
    pub(super) flagged: usize,
}

/// Work on one layer, each kind with its key or with what it has done so far.
#[derive(Debug)]
pub(super) enum Work {
    Sites(SitesKey, Box<DartThrower>),
    Cells(Box<VoronoiBuilder>),
    /// Flags the selected cells of a coarser layer, from this one on.
    Flag(usize),
    Selection(SelectionKey, Box<Selector>),
    Shapes(Box<Shaper>),
    Mesh(Box<Mesher>),
    /// Draws the rocks of all layers apart.
    Apart(Box<Separator>),
}

impl Work {
    /// The stage that it belongs to.
    pub(super) fn stage(&self) -> Stage {
        match self {
            Work::Sites(..) => Stage::Sites,
            Work::Cells(..) => Stage::Cells,
            Work::Flag(..) | Work::Selection(..) => Stage::Selection,
            Work::Shapes(..) => Stage::Shape,
            Work::Mesh(..) | Work::Apart(..) => Stage::Mesh,
        }
    }

    /// The share that is done, 0 … 1.
    pub(super) fn progress(&self, cache: &LayerCache) -> f64 {
        match self {
            Work::Sites(_, thrower) => thrower.progress(),
            Work::Cells(builder) => builder.progress(&cache.sites.value),
            Work::Flag(_) => 0.0,
            Work::Selection(_, selector) => selector.progress(),
            Work::Shapes(shaper) => shaper.progress(),
            Work::Mesh(mesher) => mesher.progress(&cache.shapes.value),
            Work::Apart(separator) => separator.progress(),
        }
    }

    /// Works on it for a while. Returns true when it is done.
    ///
    /// The stages are functions of their own and never inlined here, because V8 compiles very large functions to code
    /// that is a third slower.
    pub(super) fn advance(
        &mut self,
        cache: &LayerCache,
        params: &Params,
        paint: &Paint,
        taken: &mut Option<Taken>,
        mesh: &mut Mesh,
    ) -> bool {
        let (sites, cells) = (&cache.sites.value, &cache.cells.value);
        let selected = &cache.selection.value.selected;
        match (self, taken) {
            (Work::Sites(_, thrower), _) => thrower.advance(PICKS_PER_STEP),
            (Work::Cells(builder), _) => builder.advance(sites, CELLS_PER_STEP),
            (Work::Flag(from), Some(taken)) => {
                let selected = if taken.open { &cache.open.value.selected } else { selected };
                let to = (*from + CELLS_PER_STEP).min(selected.len());
                flag(sites, cells, &selected[*from..to], &mut taken.bitmap);
                *from = to;
                to == selected.len()
            }
            (Work::Selection(_, selector), Some(taken)) => {
                let Some(layer) = &cache.layer else { return true };
                let count = paint.share(CELLS_PER_STEP);
                selector.advance(sites, cells, &taken.bitmap, count, (paint, layer.id))
            }
            (Work::Flag(_) | Work::Selection(..), None) | (Work::Apart(_), _) => true,
            (Work::Shapes(shaper), _) => shaper.advance(cells, selected, ROCKS_PER_STEP),
            (Work::Mesh(mesher), _) => {
                let Some(layer) = &cache.layer else { return true };
                let of = Source { seed: params.seed, layer: layer.id, cells, selected, shapes: &cache.shapes.value };
                mesher.advance(&of, mesh, ROCKS_PER_STEP)
            }
        }
    }
}
