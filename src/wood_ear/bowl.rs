//! One individual before any deformation: the bowl of Eq. 3.1.

use glam::DVec3;

use super::circle::turn;

/// The vertices of the unit bowl, ring by ring: vertex (e, f) is number (e − 1)·c + f − 1.
///
/// P(e, f) = (e/d · sin θ_f, ((e − 1)/d)², e/d · cos θ_f), θ_f = 2π (f − 1)/c. This is Eq. 3.1 divided by d², so the
/// rim has radius 1 and height ((d − 1)/d)² (decision K1). The foot is the origin and the axis points along +y; ring 1
/// is an open hole.
pub fn bowl(rings: u32, meridians: u32) -> Vec<DVec3> {
    let d = f64::from(rings);
    let directions: Vec<[f64; 2]> = (0..meridians).map(|f| turn(f64::from(f) / f64::from(meridians))).collect();
    let mut points = Vec::with_capacity((rings * meridians) as usize);
    for e in 1..=rings {
        let radius = f64::from(e) / d;
        let height = f64::from(e - 1) / d;
        points.extend(directions.iter().map(|[cos, sin]| DVec3::new(radius * sin, height * height, radius * cos)));
    }
    points
}

/// Appends the triangles of a sheet of rings: 2c per pair of rings, counter-clockwise seen from inside the bowl, that
/// is from +y (decision K5).
///
/// `first` is the number of the sheet's first vertex. With `inside_out`, triangles are counter-clockwise seen from the
/// other side.
pub(super) fn sheet(triangles: &mut Vec<[u16; 3]>, first: u16, rings: u16, meridians: u16, inside_out: bool) {
    for e in 0..rings.saturating_sub(1) {
        band(triangles, first + e * meridians, first + (e + 1) * meridians, meridians, inside_out);
    }
}

/// Appends the 2c triangles between two rings of c vertices, each given by its first vertex. They are counter-clockwise
/// seen from inside the bowl if the second ring is the outer one.
pub(super) fn band(triangles: &mut Vec<[u16; 3]>, inner: u16, outer: u16, meridians: u16, inside_out: bool) {
    for f in 0..meridians {
        let next = (f + 1) % meridians;
        let (a, b) = ([inner + f, outer + f, outer + next], [inner + f, outer + next, inner + next]);
        for [p, q, r] in [a, b] {
            triangles.push(if inside_out { [p, r, q] } else { [p, q, r] });
        }
    }
}

/// Appends the c triangles between a ring and a point. They are counter-clockwise seen from inside the bowl if the
/// point is the middle of a disc across it.
pub(super) fn fan(triangles: &mut Vec<[u16; 3]>, point: u16, ring: u16, meridians: u16, inside_out: bool) {
    for f in 0..meridians {
        let [p, q] = [ring + f, ring + (f + 1) % meridians];
        triangles.push(if inside_out { [point, q, p] } else { [point, p, q] });
    }
}
