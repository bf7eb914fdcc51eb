//! Which individuals could touch: boxes on a grid. No pair is lost (decision K10).

use glam::DVec3;

/// An axis-aligned box; empty where `min` is above `max`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) min: DVec3,
    pub(super) max: DVec3,
}

impl Bounds {
    pub(super) const EMPTY: Bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    pub(super) fn of(points: impl Iterator<Item = DVec3>) -> Self {
        points.fold(Bounds::EMPTY, |bounds, p| bounds.with(p))
    }

    #[inline]
    pub(super) fn with(self, p: DVec3) -> Self {
        Bounds { min: self.min.min(p), max: self.max.max(p) }
    }

    #[inline]
    pub(super) fn overlaps(&self, other: &Bounds) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

/// Every pair i < j whose boxes overlap, in ascending order of j.
///
/// The grid's cells are as wide as the widest box, so the middles of overlapping boxes lie in the same or in neighbouring cells.
pub(super) fn overlapping(bounds: &[Bounds]) -> Vec<[u32; 2]> {
    let width = bounds.iter().fold(1.0e-3_f64, |most, b| most.max((b.max - b.min).max_element()));
    let cell = |b: &Bounds| ((b.min + b.max) * (0.5 / width)).floor().to_array().map(|c| c as i32);
    let slots = (2 * bounds.len()).next_power_of_two();
    let slot = |[x, y, z]: [i32; 3]| {
        let hash = (x as u32).wrapping_mul(0x9e37_79b9)
            ^ (y as u32).wrapping_mul(0x85eb_ca6b)
            ^ (z as u32).wrapping_mul(0xc2b2_ae35);
        (hash ^ (hash >> 15)) as usize & (slots - 1)
    };
    let mut heads = vec![u32::MAX; slots];
    let mut next = vec![u32::MAX; bounds.len()];
    let mut cells: Vec<[i32; 3]> = Vec::with_capacity(bounds.len());
    let mut pairs = Vec::new();
    for (j, b) in (0_u32..).zip(bounds) {
        let [x, y, z] = cell(b);
        for near in 0..27 {
            let around = [x + near % 3 - 1, y + near / 3 % 3 - 1, z + near / 9 - 1];
            let mut i = heads[slot(around)];
            while i != u32::MAX {
                // Other cells may share the slot; each pair is found in one cell alone.
                if cells[i as usize] == around && bounds[i as usize].overlaps(b) {
                    pairs.push([i, j]);
                }
                i = next[i as usize];
            }
        }
        let home = slot([x, y, z]);
        next[j as usize] = heads[home];
        heads[home] = j;
        cells.push([x, y, z]);
    }
    pairs
}
