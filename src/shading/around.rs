//! The ground goes on beyond the field with copies of it, which lie like bricks: each row is shifted against the next.
//!
//! Copies are moved and never turned, so that the maps of shadows and heights, which hold the field and what its neighbours throw into it,
//! are right for all of them.

use glam::{Vec2, Vec3};

/// How far apart copies are, as a share of the field's sides. Near its border, half of the rocks have sunk ([`super::Stands`]): there the next copy begins.
const APART: f32 = 0.83;

/// By how much each row is shifted against the one below it, as a share of how far apart copies are: so that for the usual cameras, which look 30°
/// aside, no rock stands behind the copies of itself.
const SHIFTED: f32 = 0.27;

/// How many copies there are in each direction. Farther away the ground's shader has the stones, as flat as the heights' map has them.
const REACH: i32 = 6;

/// Where copies are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bricks {
    apart: Vec2,
    skew: f32,
}

impl Bricks {
    /// `image` is the size of the field, px.
    pub(crate) fn of(image: [f32; 2]) -> Self {
        let apart = APART * Vec2::from(image);
        Self { apart, skew: SHIFTED * apart.x }
    }

    /// As the shaders have it: how far apart copies are along x and y, and how far rows are shifted, px.
    pub(crate) fn uniform(&self) -> [f32; 4] {
        [self.apart.x, self.apart.y, self.skew, 0.0]
    }

    /// How far each copy is moved, px, the nearest first.
    pub(crate) fn copies(&self) -> Vec<Vec3> {
        let columns = 4 * REACH + 1;
        let of = |number: i32| {
            let [row, column] = [number / columns - REACH, number % columns - 2 * REACH];
            Vec2::new(column as f32, row as f32) * self.apart + Vec2::X * (row as f32 * self.skew)
        };
        // Of positive floats the bits are in their order.
        let key = |number: i32| {
            let away = (of(number) / self.apart).length();
            (0.5..=REACH as f32 + 0.5).contains(&away).then(|| u64::from(away.to_bits()) << 32 | number as u64)
        };
        let mut keys: Vec<u64> = (0..columns * (2 * REACH + 1)).filter_map(key).collect();
        keys.sort_unstable();
        keys.into_iter().map(|key| of(key as u32 as i32).extend(0.0)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_near_the_field_lies_well_within_one_copy() {
        let image = [640.0, 400.0];
        let bricks = Bricks::of(image);
        let copies: Vec<Vec3> = bricks.copies().into_iter().chain([Vec3::ZERO]).collect();
        let half = 0.5 * Vec2::from(image);
        for step in 0..2500 {
            let at = Vec2::new((step % 50) as f32 * 53.0 - 1000.0, (step / 50) as f32 * 31.0 - 600.0);
            let inside = |copy: &&Vec3| ((at - copy.truncate() - half).abs() / half).max_element() <= APART + 1e-3;
            assert!(copies.iter().any(|copy| inside(&copy)), "{at}");
        }
    }

    #[test]
    fn the_nearest_copies_come_first_and_none_lies_on_the_field() {
        let bricks = Bricks::of([640.0, 400.0]);
        let copies = bricks.copies();
        let away = |copy: &Vec3| (copy.truncate() / bricks.apart).length();
        assert!(copies.is_sorted_by(|a, b| away(a) <= away(b) + 1e-5));
        assert!(copies.iter().all(|copy| away(copy) > 0.9));
        assert!((80..200).contains(&copies.len()), "{}", copies.len());
    }
}
