//! Outlines of rocks on the ground.

/// A point of the plane, px.
pub(super) type Point = [f32; 2];

/// For each rock the boundary of the part of its surface that is not below z = 0: directed segments, in no order, which
/// close in one or more loops.
#[derive(Debug)]
pub(super) struct Outlines {
    /// Start and end of each segment. The inside of an outline is on its left.
    pub(super) segments: Vec<[Point; 2]>,
    /// Rock k owns the segments `starts[k] .. starts[k + 1]`.
    starts: Vec<usize>,
}

impl Default for Outlines {
    fn default() -> Self {
        Outlines { segments: Vec::new(), starts: vec![0] }
    }
}

impl Outlines {
    /// Adds a rock. Its indices count from `base`, and the vertices of its rim come first, counter-clockwise.
    pub(super) fn add(&mut self, positions: &[f32], indices: &[u32], base: u32) {
        let rock = Rock { positions };
        let triangles = indices.chunks_exact(3);
        // Euler's formula for a disc; see `rimOf` in www/export/solid.ts.
        let rim = (2 * positions.len() / 3).saturating_sub(triangles.len() + 2);
        for v in 0..rim {
            let (a, b) = (v, if v + 1 < rim { v + 1 } else { 0 });
            match (rock.is_up(a), rock.is_up(b)) {
                (true, true) => self.segments.push([rock.at(a), rock.at(b)]),
                (true, false) => self.segments.push([rock.at(a), rock.crossing(a, b)]),
                (false, true) => self.segments.push([rock.crossing(a, b), rock.at(b)]),
                (false, false) => {}
            }
        }
        for triangle in triangles {
            let [a, b, c] = [0, 1, 2].map(|k| (triangle[k] - base) as usize);
            let edges = [(a, b), (b, c), (c, a)];
            let crossed = |(from, to): &(usize, usize), up: bool| rock.is_up(*from) == up && rock.is_up(*to) != up;
            let down = edges.iter().find(|edge| crossed(edge, true));
            let up = edges.iter().find(|edge| crossed(edge, false));
            if let (Some(&(a, b)), Some(&(c, d))) = (down, up) {
                self.segments.push([rock.crossing(a, b), rock.crossing(c, d)]);
            }
        }
        self.starts.push(self.segments.len());
    }

    /// The segments of each rock.
    pub(super) fn rocks(&self) -> impl Iterator<Item = &[[Point; 2]]> {
        self.starts.windows(2).map(|ends| &self.segments[ends[0]..ends[1]])
    }
}

struct Rock<'a> {
    positions: &'a [f32],
}

impl Rock<'_> {
    fn is_up(&self, v: usize) -> bool {
        self.positions[3 * v + 2] >= 0.0
    }

    fn at(&self, v: usize) -> Point {
        [self.positions[3 * v], self.positions[3 * v + 1]]
    }

    /// Where the edge between two vertices goes through z = 0: the same bits for both triangles at the edge.
    fn crossing(&self, a: usize, b: usize) -> Point {
        let (a, b) = (a.min(b), a.max(b));
        let [za, zb] = [a, b].map(|v| f64::from(self.positions[3 * v + 2]));
        let share = za / (za - zb);
        let (a, b) = (self.at(a).map(f64::from), self.at(b).map(f64::from));
        [0, 1].map(|axis| (a[axis] + share * (b[axis] - a[axis])) as f32)
    }
}
