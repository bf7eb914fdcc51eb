//! The triangulation of the ground.

use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::noding::Network;
use super::outlines::{Outlines, Point};

/// A mesh that lies in the plane z = 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sheet {
    /// x and y of each vertex, px.
    pub positions: Vec<f32>,
    /// Three per triangle, counter-clockwise from above.
    pub indices: Vec<u32>,
}

/// A vertex of the triangulation: one of the points that were given, by its number, or where two segments cross.
struct Vertex {
    at: Point2<f64>,
    number: u32,
}

/// The number of a vertex at a crossing.
const CROSSING: u32 = u32::MAX;

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

type Triangles = ConstrainedDelaunayTriangulation<Vertex>;

pub(super) fn triangulate(outlines: &Outlines, size: Point, cut: bool) -> Sheet {
    let triangles = constrained(outlines, size, cut);
    let regions = Regions::of(&triangles);
    let mut outside: Vec<bool> = regions.samples.iter().map(|at| !is_in_image(*at, size)).collect();
    if cut {
        flag_covered(outlines, size, &regions.samples, &mut outside);
    }
    let kept = triangles.inner_faces().filter(|face| !outside[regions.of[face.fix().index()] as usize]);
    let corners = kept.map(|face| face.vertices().map(|v| v.fix().index() as u32));
    used(&triangles.vertices().map(|v| [v.position().x as f32, v.position().y as f32]).collect::<Vec<_>>(), corners)
}

/// The triangulation of the image's corners and of all ends of segments, in which every segment is a row of edges.
fn constrained(outlines: &Outlines, [width, height]: Point, cut: bool) -> Triangles {
    let border = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    let sides = (0..4).map(|k| [border[k], border[(k + 1) % 4]]);
    let mut network = Network::new(sides.chain(outlines.segments.iter().copied()), cut);
    network.cut([width, height]);

    let vertices = network.points.iter().zip(0..).map(|(&[x, y], number)| {
        let at = Point2::new(f64::from(x), f64::from(y));
        Vertex { at, number }
    });
    // Coordinates of rocks are neither infinite nor so small that spade refuses them.
    let mut triangles = Triangles::bulk_load(vertices.collect()).unwrap_or_default();
    let mut handles = vec![FixedVertexHandle::from_index(0); network.points.len()];
    for vertex in triangles.vertices() {
        handles[vertex.data().number as usize] = vertex.fix();
    }
    for [from, to] in network.segments {
        let [from, to] = [from, to].map(|number| handles[number as usize]);
        triangles.add_constraint_and_split(from, to, |at| Vertex { at, number: CROSSING });
    }
    triangles
}

/// The mesh of these triangles, with those of the points that they use.
fn used(points: &[Point], triangles: impl Iterator<Item = [u32; 3]>) -> Sheet {
    const NONE: u32 = u32::MAX;
    let mut sheet = Sheet::default();
    let mut numbers = vec![NONE; points.len()];
    for corner in triangles.flatten() {
        let number = &mut numbers[corner as usize];
        if *number == NONE {
            *number = sheet.positions.len() as u32 / 2;
            sheet.positions.extend(points[corner as usize]);
        }
        sheet.indices.push(*number);
    }
    sheet
}

/// The parts into which the constraints cut the plane.
struct Regions {
    /// For each face the region that it is in; that of the outer face means nothing.
    of: Vec<u32>,
    /// A point inside of each region, far from its border: the middle of its largest triangle.
    samples: Vec<Point2<f64>>,
}

impl Regions {
    fn of(triangles: &Triangles) -> Self {
        const NONE: u32 = u32::MAX;
        let mut regions = Regions { of: vec![NONE; triangles.num_all_faces()], samples: Vec::new() };
        let mut open = Vec::new();
        for first in triangles.inner_faces() {
            if regions.of[first.fix().index()] != NONE {
                continue;
            }
            let region = regions.samples.len() as u32;
            let mut largest = (0.0, first.center());
            regions.of[first.fix().index()] = region;
            open.push(first);
            while let Some(face) = open.pop() {
                let area = face.area();
                if area > largest.0 {
                    largest = (area, face.center());
                }
                for edge in face.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge()) {
                    let next = edge.rev().face().as_inner().filter(|next| regions.of[next.fix().index()] == NONE);
                    if let Some(next) = next {
                        regions.of[next.fix().index()] = region;
                        open.push(next);
                    }
                }
            }
            regions.samples.push(largest.1);
        }
        regions
    }
}

fn is_in_image(at: Point2<f64>, [width, height]: Point) -> bool {
    (0.0..f64::from(width)).contains(&at.x) && (0.0..f64::from(height)).contains(&at.y)
}

/// Flags the samples that are inside of a rock's outline. Those outside of the image must be flagged already.
fn flag_covered(outlines: &Outlines, [width, height]: Point, samples: &[Point2<f64>], flags: &mut [bool]) {
    // A grid of about one sample per cell.
    let side = (f64::from(width) * f64::from(height) / samples.len().max(1) as f64).sqrt().max(1.0);
    let last = [width, height].map(|length| (f64::from(length) / side) as usize);
    let cell = |at: [f64; 2]| [0, 1].map(|axis| ((at[axis] / side).max(0.0) as usize).min(last[axis]));
    let mut cells = vec![Vec::new(); (last[0] + 1) * (last[1] + 1)];
    for (k, at) in samples.iter().enumerate().filter(|(k, _)| !flags[*k]) {
        let [column, row] = cell([at.x, at.y]);
        cells[row * (last[0] + 1) + column].push(k as u32);
    }
    for rock in outlines.rocks() {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for [from, _] in rock {
            for axis in 0..2 {
                low[axis] = low[axis].min(f64::from(from[axis]));
                high[axis] = high[axis].max(f64::from(from[axis]));
            }
        }
        if rock.is_empty() {
            continue;
        }
        let (low, high) = (cell(low), cell(high));
        for row in low[1]..=high[1] {
            for column in low[0]..=high[0] {
                for &k in &cells[row * (last[0] + 1) + column] {
                    flags[k as usize] |= winds_around(rock, samples[k as usize]);
                }
            }
        }
    }
}

/// Whether directed segments that close wind around a point.
fn winds_around(segments: &[[Point; 2]], at: Point2<f64>) -> bool {
    let mut turns = 0;
    for &[from, to] in segments {
        let [[ax, ay], [bx, by]] = [from, to].map(|end| end.map(f64::from));
        let (starts_below, ends_below) = (ay <= at.y, by <= at.y);
        if starts_below != ends_below {
            let left = (bx - ax) * (at.y - ay) - (by - ay) * (at.x - ax);
            turns += i32::from(starts_below && left > 0.0) - i32::from(ends_below && left < 0.0);
        }
    }
    turns != 0
}
