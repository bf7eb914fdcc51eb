//! How dense the rocks stand where: a mask over the whole image, and strokes painted on it (decision A24).

use glam::DVec2;

use super::memory::bytes;
use super::sites::Sites;
use super::voronoi::Cells;
use crate::error::Error;

/// Number of units in the image's width: strokes are told in them, so that they keep their place on an image of another
/// size, as a mask does.
const UNITS: f64 = 4096.0;

/// What a stroke does with the cells that it reaches. One that erases grants no cell whose site lies on it.
///
/// Every cell whose site lies on it may be granted, however few the layer asks for.
const ADD: f64 = 0.0;
/// No cell that it touches is granted: a way that is free of rocks.
const PATH: f64 = 2.0;
/// The cells whose sites lie on it are as if nothing had been painted.
const RESTORE: f64 = 3.0;

/// A mask and strokes. With neither, every cell is as dense as its layer asks.
#[derive(Debug, Default)]
pub(super) struct Paint {
    /// Its rows, from the top of the picture to its bottom.
    mask: Vec<u8>,
    width: usize,
    /// Per stroke: what it does; 0 for every layer or the id of one + 1; half its width; its number of points; and x
    /// and y of each.
    strokes: Vec<f64>,
}

impl Paint {
    /// Refuses a mask that is no rectangle, and strokes without points or with too few numbers.
    pub(super) fn new(mask: Vec<u8>, width: usize, strokes: Vec<f64>) -> Result<Self, Error> {
        let height = mask.len() / width.max(1);
        if height * width != mask.len() {
            return Err(Error::MalformedRequest { value: mask.len(), expected: height * width });
        }
        let mut rest = strokes.as_slice();
        while next_stroke(&mut rest).is_some() {}
        if !rest.is_empty() {
            return Err(Error::MalformedRequest { value: strokes.len(), expected: strokes.len() - rest.len() });
        }
        Ok(Paint { mask, width, strokes })
    }

    pub(super) fn is_empty(&self) -> bool {
        self.mask.is_empty() && self.strokes.is_empty()
    }

    /// Bytes of memory that it uses.
    pub(super) fn bytes(&self) -> usize {
        bytes(&self.mask) + bytes(&self.strokes)
    }

    /// How many cells to look at in the time of `count` cells without paint.
    pub(super) fn share(&self, count: usize) -> usize {
        count.div_ceil(1 + self.strokes.len() / 64)
    }

    /// Whether cell `i` of a layer may be granted. Without paint, those are the first `cut` of the layer's visiting
    /// order, in which it has the place `rank`. The last stroke that reaches the cell decides, and where there is none,
    /// the mask: it leaves as many of the first as it is bright.
    #[inline(never)]
    pub(super) fn allows(&self, layer: u32, sites: &Sites, cells: &Cells, i: usize, [rank, cut]: [u32; 2]) -> bool {
        let scale = UNITS / f64::from(sites.width);
        let [x, y] = sites.pixels[i].map(|at| f64::from(at) + 0.5);
        let site = DVec2::new(x, y) * scale;
        let mut last = None;
        let mut rest = self.strokes.as_slice();
        while let Some(([mode, of, reach, _], points)) = next_stroke(&mut rest) {
            if of != 0.0 && of != f64::from(layer) + 1.0 {
                continue;
            }
            let corners = if mode == PATH { cells.polygon(i) } else { &[] };
            let farthest = corners.iter().fold(0.0_f64, |far, v| far.max((*v * scale - site).length_squared()));
            let far = reach + farthest.sqrt();
            // A single point is a line to itself.
            let mut from = DVec2::new(points[0], points[1]);
            for to in points.chunks_exact(2).map(|to| DVec2::new(to[0], to[1])) {
                if squared_distance(site, from, to) <= far * far
                    && (corners.is_empty() || touches(corners, scale, [from, to], reach * reach))
                {
                    last = Some(mode);
                    break;
                }
                from = to;
            }
        }
        let density = match last {
            Some(ADD) => return true,
            Some(RESTORE) => 255,
            Some(_) => 0,
            None => self.density([x, f64::from(sites.height) - y], [sites.width, sites.height]),
        };
        u64::from(rank) * 255 < density * u64::from(cut)
    }

    /// The mask's value at a place on an image of this size, 0 … 255, between the middles of its four nearest pixels.
    fn density(&self, at: [f64; 2], image: [u32; 2]) -> u64 {
        if self.mask.is_empty() {
            return 255;
        }
        let last = [self.width - 1, self.mask.len() / self.width - 1];
        // Column and row before the place, and how far it is beyond them.
        let [(column, u), (row, v)] = [0, 1].map(|k| {
            let at = at[k] * (last[k] + 1) as f64 / f64::from(image[k]) - 0.5;
            let at = at.max(0.0).min(last[k] as f64);
            (at as usize, at - at.floor())
        });
        let across = |row: usize| {
            let row = row.min(last[1]) * self.width;
            let [left, right] = [column, column + 1].map(|column| f64::from(self.mask[row + column.min(last[0])]));
            left + (right - left) * u
        };
        let [upper, lower] = [row, row + 1].map(across);
        (upper + (lower - upper) * v + 0.5) as u64
    }
}

/// Takes the first stroke off a list: its head and its points. `None` where the list does not begin with one.
fn next_stroke<'a>(list: &mut &'a [f64]) -> Option<([f64; 4], &'a [f64])> {
    let (head, rest) = list.split_first_chunk::<4>()?;
    let (points, rest) = rest.split_at_checked((2.0 * head[3]) as usize)?;
    *list = if points.len() < 2 { return None } else { rest };
    Some((*head, points))
}

/// Whether a convex polygon is no farther from a line than `near`, squared. Its vertices are counter-clockwise.
fn touches(polygon: &[DVec2], scale: f64, [a, b]: [DVec2; 2], near: f64) -> bool {
    // On which side of a line a point lies: inside of the polygon, it is positive for every edge.
    let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
    // The part of the line that is inside of all edges so far, as shares of its length.
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    let mut u = polygon.last().map_or(a, |v| *v * scale);
    for v in polygon.iter().map(|v| *v * scale) {
        if [[v, a, b], [a, u, v], [b, u, v]]
            .iter()
            .any(|[point, from, to]| squared_distance(*point, *from, *to) <= near)
        {
            return true;
        }
        let [at_a, at_b] = [side(u, v, a), side(u, v, b)];
        let edge = at_a / (at_a - at_b);
        if at_a < 0.0 {
            first = first.max(if at_b < 0.0 { 2.0 } else { edge });
        } else if at_b < 0.0 {
            last = last.min(edge);
        }
        u = v;
    }
    first <= last
}

/// Of a point from the line between two others.
#[inline(never)]
#[allow(clippy::manual_clamp, reason = "`clamp` would keep NaN")]
fn squared_distance(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let (line, way) = (to - from, point - from);
    // A line without length gives NaN, and `max` then 0.
    let along = (way.dot(line) / line.length_squared()).max(0.0).min(1.0);
    (way - line * along).length_squared()
}
