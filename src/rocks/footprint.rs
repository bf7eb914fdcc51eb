//! Ground that is occupied by something else, so that no rock grows there.

use glam::DVec2;

use super::bitmap::Bitmap;
use super::memory::bytes;
use crate::error::Error;

/// Largest number of triangles in a footprint.
const MAX_TRIANGLES: usize = 1 << 16;

/// Largest absolute value of a coordinate, px: enough for anything that lies partly on the largest image, and small
/// enough for rows to be computed exactly.
const FARTHEST: f64 = 65_536.0;

/// Triangles in the plane, px, in any order and orientation. They may overlap each other and extend beyond the image.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Footprint(Vec<[DVec2; 3]>);

impl Footprint {
    /// Takes six numbers per triangle: x and y of its three corners. Refuses a length that is not a multiple of six,
    /// too many triangles and coordinates out of range.
    pub(super) fn new(numbers: &[f64]) -> Result<Self, Error> {
        let triangles = numbers.chunks_exact(6);
        if !triangles.remainder().is_empty() {
            return Err(Error::MalformedRequest { value: numbers.len(), expected: 6 * (triangles.len() + 1) });
        }
        let limits = |value: f64, min: f64, max: f64| {
            let is_within = (min..=max).contains(&value);
            is_within.then_some(()).ok_or(Error::OutOfRange { key: "footprint", layer: None, value, min, max })
        };
        limits(triangles.len() as f64, 0.0, MAX_TRIANGLES as f64)?;
        numbers.iter().try_for_each(|&value| limits(value, -FARTHEST, FARTHEST))?;
        Ok(Footprint(triangles.map(|t| [0, 2, 4].map(|i| DVec2::new(t[i], t[i + 1]))).collect()))
    }

    /// Whether the footprint has no triangles.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Bytes of memory that the footprint uses.
    pub(super) fn bytes(&self) -> usize {
        bytes(&self.0)
    }

    /// Flags every pixel that a triangle touches, even if only with a corner.
    pub(super) fn flag(&self, [width, height]: [u32; 2], taken: &mut Bitmap) {
        for triangle in &self.0 {
            let low = triangle.iter().fold(f64::INFINITY, |low, v| low.min(v.y));
            let high = triangle.iter().fold(f64::NEG_INFINITY, |high, v| high.max(v.y));
            // `as` saturates, so a triangle beside the image has no rows.
            for row in low.floor().max(0.0) as u32..(high.floor() + 1.0).min(f64::from(height)).max(0.0) as u32 {
                let [left, right] = reach(triangle, f64::from(row));
                let (first, last) = (left.floor().max(0.0), right.floor().min(f64::from(width) - 1.0));
                if first <= last {
                    taken.fill_span(row, first as u32, last as u32);
                }
            }
        }
    }
}

/// Leftmost and rightmost x of the part of a triangle between `y` and y + 1. The triangle has no part there if the
/// first is greater than the second.
fn reach(triangle: &[DVec2; 3], y: f64) -> [f64; 2] {
    let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
    for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (triangle[i], triangle[j])) {
        let (low, high) = if from.y <= to.y { (from, to) } else { (to, from) };
        if high.y < y || low.y > y + 1.0 {
            continue;
        }
        let at = |height: f64| {
            let rise = high.y - low.y;
            // A horizontal edge is farthest out at one of its ends.
            if height <= low.y || rise == 0.0 {
                low.x
            } else {
                low.x + (high.x - low.x) * ((height - low.y) / rise).min(1.0)
            }
        };
        for x in [at(y), at(y + 1.0), if high.y <= y + 1.0 { high.x } else { at(y + 1.0) }] {
            reach = [reach[0].min(x), reach[1].max(x)];
        }
    }
    reach
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, Stream};

    const IMAGE: [u32; 2] = [40, 30];

    fn flagged(numbers: &[f64]) -> Bitmap {
        let mut taken = Bitmap::new(IMAGE[0], IMAGE[1]);
        Footprint::new(numbers).expect("a footprint").flag(IMAGE, &mut taken);
        taken
    }

    #[test]
    fn every_pixel_that_holds_a_point_of_a_triangle_is_flagged_and_none_beside_its_box() {
        let mut stream = Stream::new(5, Purpose::Darts, 0, 0);
        for _ in 0..300 {
            let mut corner = || [60.0 * stream.unit() - 10.0, 50.0 * stream.unit() - 10.0];
            let corners = [corner(), corner(), corner()];
            let taken = flagged(corners.as_flattened());
            let [a, b, c] = corners.map(DVec2::from);
            for _ in 0..200 {
                let (s, t) = (stream.unit(), stream.unit());
                let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
                let at = a + s * (b - a) + t * (c - a);
                if at.cmpge(DVec2::ZERO).all() && at.x < 40.0 && at.y < 30.0 {
                    assert!(taken.get(at.x as u32, at.y as u32), "{at} of {corners:?}");
                }
            }
            let (low, high) = (a.min(b).min(c).floor(), a.max(b).max(c).floor());
            for (x, y) in (0..40).flat_map(|x| (0..30).map(move |y| (x, y))) {
                let at = DVec2::new(f64::from(x), f64::from(y));
                assert!(!taken.get(x, y) || (at.cmpge(low).all() && at.cmple(high).all()), "{at} of {corners:?}");
            }
        }
    }

    #[test]
    fn what_lies_beside_the_image_flags_nothing() {
        for away in [-100.0, 100.0] {
            let taken = flagged(&[away, away, away + 5.0, away, away, away + 5.0]);
            assert_eq!(taken.count(), 0);
        }
    }

    #[test]
    fn a_malformed_footprint_is_an_error_that_names_the_value() {
        assert_eq!(Footprint::new(&[1.0; 7]), Err(Error::MalformedRequest { value: 7, expected: 12 }));
        for value in [f64::NAN, f64::INFINITY, 1.0e6] {
            let error = Footprint::new(&[0.0, 0.0, value, 0.0, 0.0, 1.0]).expect_err("an error");
            assert_eq!(error.key(), "footprint");
            assert_eq!(error.numbers()[0].to_bits(), value.to_bits());
        }
    }
}
