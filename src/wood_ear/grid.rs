//! A hash grid that finds points by their position. The points of a cell form a chain through a table.

use glam::DVec3;

/// An unbounded grid of cubic cells, all of the same width. Points are numbered in the order in which they are added.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    width: f64,
    heads: Vec<u32>,
    next: Vec<u32>,
    cells: Vec<[i32; 3]>,
}

impl Grid {
    /// Makes a grid of cells of this width for about `points` points.
    pub(super) fn new(width: f64, points: usize) -> Self {
        let heads = vec![u32::MAX; (2 * points).next_power_of_two()];
        Grid { width, heads, next: Vec::with_capacity(points), cells: Vec::with_capacity(points) }
    }

    /// Calls `each` with the number of every point in the cell of `p` and in the 26 cells around it. These are all
    /// points within one width of `p`, and some others.
    pub(super) fn near(&self, p: DVec3, mut each: impl FnMut(u32)) {
        let [x, y, z] = self.cell(p);
        for near in 0..27 {
            let around = [x + near % 3 - 1, y + near / 3 % 3 - 1, z + near / 9 - 1];
            let mut i = self.heads[self.slot(around)];
            while i != u32::MAX {
                // Other cells may share the slot, so points of other cells are skipped.
                if self.cells[i as usize] == around {
                    each(i);
                }
                i = self.next[i as usize];
            }
        }
    }

    pub(super) fn add(&mut self, p: DVec3) {
        let cell = self.cell(p);
        let home = self.slot(cell);
        self.next.push(self.heads[home]);
        self.heads[home] = self.cells.len() as u32;
        self.cells.push(cell);
    }

    fn cell(&self, p: DVec3) -> [i32; 3] {
        (p / self.width).floor().to_array().map(|c| c as i32)
    }

    fn slot(&self, [x, y, z]: [i32; 3]) -> usize {
        let hash = (x as u32).wrapping_mul(0x9e37_79b9)
            ^ (y as u32).wrapping_mul(0x85eb_ca6b)
            ^ (z as u32).wrapping_mul(0xc2b2_ae35);
        (hash ^ (hash >> 15)) as usize & (self.heads.len() - 1)
    }
}
