//! Which selection is made next: those without paint first, then those with it.

use super::super::bitmap::Bitmap;
use super::super::budget::Known;
use super::super::cache::SelectionKey;
use super::super::memory::coarsest_first;
use super::super::select::{Selector, Threshold};
use super::super::work::{Taken, Work};
use super::{Generator, Task};
use crate::error::Error;
use crate::params::Border;

impl Generator {
    /// The layers' indices by descending mean cell area W·H / n, equal ones in input order (decision A7).
    fn selection_order(&self) -> Vec<usize> {
        coarsest_first(self.results.layers.len(), |k| self.results.layers[k].sites.value.pixels.len() as f64)
    }

    /// Whether this selection is kept for the paint alone.
    fn is_open(&self, key: &SelectionKey) -> bool {
        key.paint[0] == 0 && !self.paint.value.is_empty()
    }

    /// The coarsest layer whose selection still has to be made, and its key.
    fn stale_selection(&self) -> Option<(usize, SelectionKey)> {
        let open = self.stale_selection_of(false);
        if open.is_some() || self.paint.value.is_empty() { open } else { self.stale_selection_of(true) }
    }

    /// The same of the selections with the paint, or of those without.
    #[inline(never)]
    fn stale_selection_of(&self, painted: bool) -> Option<(usize, SelectionKey)> {
        let params = self.params.as_ref()?;
        let mut coarser = [0; 2];
        for k in self.selection_order() {
            let cache = &self.results.layers[k];
            let layer = cache.layer.as_ref()?;
            let key = SelectionKey {
                cells: cache.cells.version,
                threshold: layer.cell_count.map_or(Threshold::Area(layer.area_fraction), Threshold::Count),
                border: params.border,
                footprint: self.footprint.version,
                paint: if painted { [self.paint.version, cache.open.version] } else { [0; 2] },
                coarser,
            };
            let made = if self.is_open(&key) { &cache.open } else { &cache.selection };
            if !made.is_current(&key) {
                return Some((k, key));
            }
            coarser = [coarser[0] + 1, coarser[1] + made.version];
        }
        None
    }

    pub(super) fn next_selection(&mut self) -> Result<Option<Task>, Error> {
        let Some((k, key)) = self.stale_selection() else { return Ok(None) };
        self.check_memory(Known::Sites)?;
        self.budget.selects = true;
        Ok(self.new_selection(k, key))
    }

    /// The task that selects from layer `k`; or, while the cells of a coarser layer are not flagged yet, the task that
    /// flags them.
    fn new_selection(&mut self, k: usize, key: SelectionKey) -> Option<Task> {
        let order = self.selection_order();
        let open = self.is_open(&key);
        let params = self.params.as_ref()?;
        if self.taken.as_ref().is_some_and(|taken| taken.open != open) {
            self.taken = None;
        }
        let taken = self.taken.get_or_insert_with(|| {
            let image = [params.image_width, params.image_height];
            let mut bitmap = Bitmap::new(image[0], image[1]);
            self.footprint.value.flag(image, &mut bitmap);
            Taken { bitmap, open, flagged: 0 }
        });
        let next = order[taken.flagged];
        if next != k {
            return Some(Task { layer: next, work: Work::Flag(0) });
        }
        let cache = &self.results.layers[k];
        let layer = cache.layer.as_ref()?;
        let drop_border = params.border == Border::Drop;
        let (cells, [seed, id]) = (&cache.cells.value, [params.seed, layer.id]);
        let mut selector = Selector::new(cells, key.threshold, drop_border, seed, id);
        if key.paint[0] > 0 {
            selector.paint_over(&cache.open.value);
        }
        Some(Task { layer: k, work: Work::Selection(key, Box::new(selector)) })
    }
}
