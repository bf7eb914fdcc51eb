//! What a wedge ends at: the lowest of several convex functions, each the highest of a few lines.

use super::fronts::ROUNDING;

/// One of the functions: it is the highest of some lines.
#[derive(Debug, Clone, Copy)]
struct Bound {
    first: u32,
    end: u32,
    /// A value that it is not below anywhere between the ends.
    least: f64,
}

/// A line of a function.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    bound: usize,
    pub(super) line: u32,
}

/// Functions of u over a stretch.
#[derive(Debug, Default)]
pub(super) struct Bounds {
    /// Slopes and values at 0.
    lines: Vec<(f64, f64)>,
    bounds: Vec<Bound>,
    ends: [f64; 2],
    /// A value that the lowest function is not above anywhere, as far as it is known.
    pub(super) most: f64,
    /// The first line of the function that is next.
    first: usize,
}

impl Bounds {
    /// Forgets all functions. What is above `most` does not matter.
    pub(super) fn start(&mut self, ends: [f64; 2], most: f64) {
        self.lines.clear();
        self.bounds.clear();
        (self.ends, self.most, self.first) = (ends, most, 0);
    }

    /// Adds a line to the next function.
    pub(super) fn push(&mut self, slope: f64, start: f64) {
        self.lines.push((slope, start));
    }

    /// Ends the function of the lines since the last one.
    pub(super) fn close(&mut self) {
        let (mut least, mut greatest) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for &(slope, start) in &self.lines[self.first..] {
            let ends = self.ends.map(|u| slope * u + start);
            least = least.max(ends[0].min(ends[1]));
            greatest = greatest.max(ends[0]).max(ends[1]);
        }
        if least > self.most {
            self.lines.truncate(self.first);
        } else {
            self.bounds.push(Bound { first: self.first as u32, end: self.lines.len() as u32, least });
            self.most = self.most.min(greatest);
        }
        self.first = self.lines.len();
    }

    /// Leaves out what turned out not to matter.
    pub(super) fn finish(&mut self) {
        let most = self.most;
        self.bounds.retain(|bound| bound.least <= most);
    }

    /// Number of lines.
    pub(super) fn lines(&self) -> usize {
        self.lines.len()
    }

    pub(super) fn value(&self, line: u32, u: f64) -> f64 {
        let (slope, start) = self.lines[line as usize];
        slope * u + start
    }

    /// Where a line is 0, unless it is level.
    pub(super) fn root(&self, line: u32) -> Option<f64> {
        let (slope, start) = self.lines[line as usize];
        (slope != 0.0).then_some(-start / slope)
    }

    /// The function that is lowest just after u, and its line there.
    pub(super) fn lowest(&self, u: f64) -> Option<Piece> {
        let mut best: Option<Piece> = None;
        for bound in 0..self.bounds.len() {
            let line = self.line_of(bound, u);
            if best.is_none_or(|best| self.is_above(best.line, line, u)) {
                best = Some(Piece { bound, line });
            }
        }
        best
    }

    /// The line of a function that counts just after u.
    fn line_of(&self, bound: usize, u: f64) -> u32 {
        let Bound { first, end, .. } = self.bounds[bound];
        (first + 1..end).fold(first, |best, line| if self.is_above(line, best, u) { line } else { best })
    }

    /// Whether a line is above another just after u.
    fn is_above(&self, line: u32, other: u32, u: f64) -> bool {
        let ahead = self.value(line, u) - self.value(other, u);
        ahead > ROUNDING || (ahead > -ROUNDING && self.lines[line as usize].0 > self.lines[other as usize].0)
    }

    /// Follows the lowest function from u on: where its line ends, at `to` at the latest, and what is lowest from there on.
    pub(super) fn next(&self, u: f64, to: f64, lowest: Piece) -> (f64, Option<Piece>) {
        let (slope, start) = self.lines[lowest.line as usize];
        let (mut at, mut next) = (to, None);
        let own = self.bounds[lowest.bound];
        for line in own.first..own.end {
            let (its_slope, its_start) = self.lines[line as usize];
            if its_slope > slope {
                let meets = ((start - its_start) / (its_slope - slope)).max(u);
                if meets < at {
                    (at, next) = (meets, Some(Piece { line, ..lowest }));
                }
            }
        }
        for (bound, other) in self.bounds.iter().enumerate().filter(|(bound, _)| *bound != lowest.bound) {
            // Where all lines of the other function are below this one.
            let (mut low, mut high) = (u, at);
            let mut entry = None;
            for line in other.first..other.end {
                let (its_slope, its_start) = self.lines[line as usize];
                let (rise, ahead) = (its_slope - slope, its_start - start);
                if rise > 0.0 {
                    high = high.min(-ahead / rise);
                } else if rise < 0.0 {
                    let from = -ahead / rise;
                    if from > low {
                        (low, entry) = (from, Some(line));
                    }
                } else if ahead >= -ROUNDING {
                    high = f64::NEG_INFINITY;
                }
                if low >= high - ROUNDING {
                    break;
                }
            }
            if low < high - ROUNDING {
                let line = entry.unwrap_or_else(|| self.line_of(bound, low));
                (at, next) = (low, Some(Piece { bound, line }));
            }
        }
        (at, next)
    }
}
