//! Cuts segments where they cross each other, so that they meet at their ends alone.
//!
//! A segment that passes a point by less than single precision could tell is bent through that point: otherwise the
//! triangles between the two would be thinner than the rounding of their corners. The bend may bring the segment near
//! another point, so that all is repeated until nothing changes. This is iterated snap rounding (Halperin & Packer,
//! *Iterated snap rounding*, 2002) with the given points in place of a raster's.

use super::outlines::Point;

/// Points and segments between them, by the points' numbers.
pub(super) struct Network {
    pub(super) points: Vec<Point>,
    /// The smaller number first, each segment once, in ascending order.
    pub(super) segments: Vec<[u32; 2]>,
    /// Whether each point and each segment is there since the last round.
    is_new: [Vec<bool>; 2],
}

/// Two or three rounds are enough. What would be left after so many is cut by the triangulation, which is less exact.
const ROUNDS: usize = 12;

impl Network {
    /// Makes the network of directed segments. With `only_borders` it has none of those that lead there and back equally
    /// often: what they are the borders of lies on both sides.
    pub(super) fn new(segments: impl Iterator<Item = [Point; 2]>, only_borders: bool) -> Self {
        const NONE: u32 = u32::MAX;
        let (all, numbers) = joined(segments.flatten());
        let directed =
            numbers.chunks_exact(2).map(|ends| (ends[0].min(ends[1]), ends[0].max(ends[1]), ends[0] < ends[1]));
        let mut directed: Vec<_> = directed.filter(|(a, b, _)| a != b).collect();
        directed.sort_unstable();
        let same = directed.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
        let kept =
            same.filter(|same| !only_borders || 2 * same.iter().filter(|(.., forth)| *forth).count() != same.len());
        let mut network = Network {
            points: Vec::new(),
            segments: kept.map(|same| [same[0].0, same[0].1]).collect(),
            is_new: Default::default(),
        };
        // The others' points are left out.
        let mut places = vec![NONE; all.len()];
        network.segments.iter().flatten().for_each(|&point| places[point as usize] = 0);
        for (place, point) in places.iter_mut().zip(all).filter(|(place, _)| **place != NONE) {
            *place = network.points.len() as u32;
            network.points.push(point);
        }
        network.segments.iter_mut().flatten().for_each(|point| *point = places[*point as usize]);
        network.is_new = [vec![true; network.points.len()], vec![true; network.segments.len()]];
        network
    }

    /// Cuts and bends the segments. `size` is that of the image, and decides what is too near.
    pub(super) fn cut(&mut self, size: Point) {
        let longest = size[0].max(size[1]).max(1.0);
        let near = f64::from(longest.next_up() - longest);
        let grid = Grid::of(&self.points, near);
        for _ in 0..ROUNDS {
            let cuts = self.cuts(&grid, near);
            if cuts.is_empty() {
                return;
            }
            self.apply(&cuts);
        }
    }

    /// Takes pieces, each with whether it is new.
    fn replace(&mut self, pieces: impl Iterator<Item = ([u32; 2], bool)>) {
        let mut pieces: Vec<_> =
            pieces.filter(|([a, b], _)| a != b).map(|([a, b], new)| ([a.min(b), a.max(b)], new)).collect();
        pieces.sort_unstable();
        pieces.dedup_by_key(|(ends, _)| *ends);
        (self.segments, self.is_new[1]) = pieces.into_iter().unzip();
    }

    fn ends(&self, segment: u32) -> [[f64; 2]; 2] {
        self.segments[segment as usize].map(|point| self.points[point as usize].map(f64::from))
    }

    /// Where segments have to be cut, in ascending order of segments and along each. Looks only at what is new since the last round.
    fn cuts(&self, grid: &Grid, near: f64) -> Vec<Cut> {
        let Contents { points, segments } = grid.contents(self, near);
        let [new_points, new_segments] = &self.is_new;
        let mut cuts = Vec::new();
        let mut is_bent = vec![false; self.segments.len()];
        for (points, segments) in points.iter().zip(segments.iter()) {
            for &segment in segments {
                let s = segment as usize;
                for &point in points.iter().filter(|&&point| new_segments[s] || new_points[point as usize]) {
                    let at = self.points[point as usize];
                    if let Some(share) = share_near(self.ends(segment), at.map(f64::from), near) {
                        is_bent[s] = true;
                        cuts.push(Cut { segment, share, at });
                    }
                }
            }
        }
        let mut crossings = Vec::new();
        for segments in segments.iter() {
            for (k, &a) in segments.iter().enumerate() {
                for &b in &segments[..k] {
                    let is_either = |flags: &[bool]| flags[a as usize] || flags[b as usize];
                    // What is going to be bent may not cross any more afterwards.
                    if is_either(new_segments) && !is_either(&is_bent) {
                        crossings.extend(shares_crossing(self.ends(a), self.ends(b)).map(|shares| ([a, b], shares)));
                    }
                }
            }
        }
        // Two segments may share several cells.
        crossings.sort_unstable_by_key(|(segments, _)| *segments);
        crossings.dedup_by_key(|(segments, _)| *segments);
        for (segments, shares) in crossings {
            let [from, to] = self.ends(segments[0]);
            let at = [0, 1].map(|axis| (from[axis] + shares[0] * (to[axis] - from[axis])) as f32);
            cuts.extend([0, 1].map(|k| Cut { segment: segments[k], share: shares[k], at }));
        }
        cuts.sort_by(|a, b| a.segment.cmp(&b.segment).then(a.share.total_cmp(&b.share)));
        cuts
    }

    fn apply(&mut self, cuts: &[Cut]) {
        let old = self.points.len();
        let (points, numbers) = joined(self.points.iter().copied().chain(cuts.iter().map(|cut| cut.at)));
        let mut pieces = Vec::with_capacity(self.segments.len() + cuts.len());
        let mut cuts = cuts.iter().zip(old..).peekable();
        for (&[from, to], segment) in self.segments.iter().zip(0..) {
            let (mut last, mut is_cut) = (from as usize, false);
            while let Some((_, point)) = cuts.next_if(|(cut, _)| cut.segment == segment) {
                pieces.push(([last, point], true));
                (last, is_cut) = (point, true);
            }
            pieces.push(([last, to as usize], is_cut));
        }
        self.is_new[0] = vec![true; points.len()];
        for &place in &numbers[..old] {
            self.is_new[0][place as usize] = false;
        }
        self.points = points;
        self.replace(pieces.into_iter().map(|(ends, new)| (ends.map(|point| numbers[point]), new)));
    }
}

/// A segment is to be cut at this share of its length, and moved there to `at`.
struct Cut {
    segment: u32,
    share: f64,
    at: Point,
}

/// The share of a segment at which it passes a point by less than `near`. Near its ends, bending it would not help.
fn share_near([from, to]: [[f64; 2]; 2], at: [f64; 2], near: f64) -> Option<f64> {
    let (along, offset) = (minus(to, from), minus(at, from));
    let length2 = dot(along, along);
    let share = dot(along, offset) / length2;
    let across = cross(along, offset);
    let is_between = share > 0.0 && share < 1.0 && across * across < near * near * length2;
    let is_apart = |end: [f64; 2]| dot(minus(at, end), minus(at, end)) > near * near;
    (is_between && is_apart(from) && is_apart(to)).then_some(share)
}

/// The shares of two segments at which they cross, if neither ends there.
fn shares_crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (ab, cd, ac) = (minus(b, a), minus(d, c), minus(c, a));
    let across = cross(ab, cd);
    let shares = [cross(ac, cd) / across, cross(ac, ab) / across];
    (across != 0.0 && shares.iter().all(|share| *share > 0.0 && *share < 1.0)).then_some(shares)
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Cells of the plane, in which what is near is found.
struct Grid {
    low: [f64; 2],
    side: f64,
    columns: u32,
    rows: u32,
}

impl Grid {
    /// About one point for each cell.
    fn of(points: &[Point], near: f64) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(f64::from(point[axis]) - near);
                high[axis] = high[axis].max(f64::from(point[axis]) + near);
            }
        }
        let side = ((high[0] - low[0]) * (high[1] - low[1]) / points.len().max(1) as f64).sqrt().max(64.0 * near);
        let cells = [0, 1].map(|axis| ((high[axis] - low[axis]) / side) as u32 + 1);
        Grid { low, side, columns: cells[0], rows: cells[1] }
    }

    fn column(&self, x: f64) -> u32 {
        (((x - self.low[0]) / self.side).max(0.0) as u32).min(self.columns - 1)
    }

    fn row(&self, y: f64) -> u32 {
        (((y - self.low[1]) / self.side).max(0.0) as u32).min(self.rows - 1)
    }

    /// What is in the cells in which something is new.
    fn contents(&self, network: &Network, near: f64) -> Contents {
        let [new_points, new_segments] = &network.is_new;
        let mut is_looked_at = vec![false; (self.columns * self.rows) as usize];
        for (&point, _) in network.points.iter().zip(new_points).filter(|(_, new)| **new) {
            is_looked_at[self.cell_of(point) as usize] = true;
        }
        for (number, _) in (0..).zip(new_segments).filter(|(_, new)| **new) {
            self.pass(network.ends(number), near, &mut |cell| is_looked_at[cell as usize] = true);
        }
        let points = Lists::of(is_looked_at.len(), |visit| {
            for (&point, number) in network.points.iter().zip(0..) {
                let cell = self.cell_of(point);
                if is_looked_at[cell as usize] {
                    visit(cell, number);
                }
            }
        });
        let segments = Lists::of(is_looked_at.len(), |visit| {
            for number in 0..network.segments.len() as u32 {
                self.pass(network.ends(number), near, &mut |cell| {
                    if is_looked_at[cell as usize] {
                        visit(cell, number);
                    }
                });
            }
        });
        Contents { points, segments }
    }

    fn cell_of(&self, point: Point) -> u32 {
        let [x, y] = point.map(f64::from);
        self.row(y) * self.columns + self.column(x)
    }

    /// Calls `visit` with each cell that a segment passes, or nearly. Small, it is as fast.
    #[inline(never)]
    fn pass(&self, [a, b]: [[f64; 2]; 2], near: f64, visit: &mut dyn FnMut(u32)) {
        let (lower, upper) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let slope = if upper[1] > lower[1] { (upper[0] - lower[0]) / (upper[1] - lower[1]) } else { 0.0 };
        let (left, right) = (a[0].min(b[0]), a[0].max(b[0]));
        let (first, last) = (self.row(lower[1] - near), self.row(upper[1] + near));
        for row in first..=last {
            let (mut from, mut to) = (left, right);
            if first < last && upper[1] - lower[1] > near {
                // The part of the segment within the row's heights, a little extended.
                let ends = [(row, -near), (row + 1, near)].map(|(edge, more)| {
                    let y = self.low[1] + f64::from(edge) * self.side + more;
                    (lower[0] + slope * (y - lower[1])).clamp(left, right)
                });
                (from, to) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            }
            for column in self.column(from - near)..=self.column(to + near) {
                visit(row * self.columns + column);
            }
        }
    }
}

/// For each cell of a grid the points and the segments in it.
struct Contents {
    points: Lists,
    segments: Lists,
}

/// For each cell a list of numbers, one list after the other.
struct Lists {
    starts: Vec<u32>,
    numbers: Vec<u32>,
}

impl Lists {
    /// `each` calls what it gets with every cell and number, twice in the same order.
    fn of(cells: usize, each: impl Fn(&mut dyn FnMut(u32, u32))) -> Self {
        let mut starts = vec![0; cells + 1];
        each(&mut |cell, _| starts[cell as usize + 1] += 1);
        for cell in 0..cells {
            starts[cell + 1] += starts[cell];
        }
        let mut numbers = vec![0; starts[cells] as usize];
        let mut ends = starts.clone();
        each(&mut |cell, number| {
            let end = &mut ends[cell as usize];
            numbers[*end as usize] = number;
            *end += 1;
        });
        Lists { starts, numbers }
    }

    /// The lists in the order of cells.
    fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.starts.windows(2).map(|ends| &self.numbers[ends[0] as usize..ends[1] as usize])
    }
}

/// Returns the different points in the order of x and then y, and for each point its place among them.
fn joined(points: impl Iterator<Item = Point>) -> (Vec<Point>, Vec<u32>) {
    // Sorted like the numbers, and −0 like 0.
    let key = |number: f32| {
        let bits = (number + 0.0).to_bits();
        if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
    };
    let keyed = points.zip(0..).map(|(at, k)| (u64::from(key(at[0])) << 32 | u64::from(key(at[1])), k, at));
    let mut order: Vec<(u64, u32, Point)> = keyed.collect();
    order.sort_unstable_by_key(|&(key, k, _)| (key, k));
    let mut different = Vec::new();
    let mut places = vec![0; order.len()];
    let mut last = None;
    for (key, k, at) in order {
        if last != Some(key) {
            different.push(at.map(|number| number + 0.0));
            last = Some(key);
        }
        places[k as usize] = different.len() as u32 - 1;
    }
    (different, places)
}
