//! Checks worn rocks: what the optional stages must keep of the papers' mesh, and what they promise themselves.

use glam::{DVec3, Vec3};

use super::{Violation, ensure};
use crate::Mesh;
use crate::rocks::Wear;

/// Checks a worn rock against the papers' mesh of the same rock: `points` are that mesh's displaced vertices, the first
/// half of them the rim, and `triangles` its faces.
///
/// Every triangle must be cut into as many as the rock's size and `detail` demand (`height` holds the constants of Eq. 3), whose vertices stay on it if only detail and embedding are used. The rim
/// must stay on its cell, at or below the ground, and the surface must be a disc that ends only there, so that no gap
/// is visible from above. All numbers must be finite. Normals must have unit length and be the area-weighted means of
/// their faces; the buried faces at the rim of a weathered rock count for the rim only, if its triangles are cut.
///
/// # Errors
/// Returns the first violation.
pub(super) fn check_worn(
    mesh: &Mesh,
    rock: usize,
    wear: Wear,
    height: [f64; 3],
    points: &[DVec3],
    triangles: &[[u16; 3]],
) -> Result<(), Violation> {
    let given = mesh.rock_starts[rock + 1] as usize - mesh.rock_starts[rock] as usize;
    let segments = check_segments(given / 3, wear, height, points, triangles.len())?;
    let first = mesh.vertex_starts[rock] as usize;
    let vertices: Vec<Vec3> = mesh.positions[3 * first..3 * mesh.vertex_starts[rock + 1] as usize]
        .chunks_exact(3)
        .map(Vec3::from_slice)
        .collect();
    let normals = &mesh.normals[3 * first..3 * mesh.vertex_starts[rock + 1] as usize];
    let corners = &mesh.indices[mesh.rock_starts[rock] as usize..mesh.rock_starts[rock + 1] as usize];
    ensure(vertices.iter().all(|v| v.is_finite()), || "a vertex is not finite".into())?;
    let faces: Vec<[usize; 3]> =
        corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]].map(|v| v as usize - first)).collect();
    ensure(faces.as_flattened().iter().all(|&v| v < vertices.len()), || "an index is another rock's".into())?;

    let rim = points.len() / 2 * segments;
    check_rim(&vertices[..rim], points, segments)?;
    check_disc(&faces, rim, vertices.len())?;
    if wear.weathering == 0.0 && wear.roughness == 0.0 {
        check_flat(&vertices, &faces, points, triangles, segments, wear.embedding)?;
    }
    check_normals(&vertices, normals, &faces, if wear.weathering > 0.0 && segments > 1 { rim } else { 0 })
}

/// Checks that the edges of the papers' mesh are cut into that power of two, of 1 to 32, by which triangles come nearest to
/// equilateral ones of the edge that `detail` asks for, if the rock were a prism as high as its layer's mean; not so finely that its vertices
/// could not be numbered in 16 bits. Returns the number of segments.
fn check_segments(
    given: usize,
    wear: Wear,
    height: [f64; 3],
    points: &[DVec3],
    triangles: usize,
) -> Result<usize, Violation> {
    let rim = &points[..points.len() / 2];
    let next = |i: usize| rim[(i + 1) % rim.len()];
    let area =
        0.5 * (0..rim.len()).map(|i| (rim[i] - rim[0]).truncate().perp_dot((next(i) - rim[0]).truncate())).sum::<f64>();
    let sides =
        (0..rim.len()).map(|i| rim[i].distance(next(i))).sum::<f64>() * (height[0] + (height[1] + height[2]) / 2.0);
    // The edge of an equilateral triangle as large as the mean of the prism's.
    let edge = ((area + sides) / triangles as f64 * 4.0 / 3.0_f64.sqrt()).sqrt();
    let power = if wear.detail == 0.0 { 0.0 } else { (edge * wear.detail / 100.0).log2() };
    // By Euler's formula.
    let vertices = |power: usize| (((triangles << power) + rim.len()) << power) / 2 + 1;
    // Half way between two powers rounding may decide.
    let wanted = [power - 1.0e-9, power + 1.0e-9].map(|power| {
        let nearest = power.round().clamp(0.0, 5.0) as usize;
        (0..=nearest).rev().find(|&power| vertices(power) <= usize::from(u16::MAX)).unwrap_or(0)
    });
    let found = wanted.into_iter().find(|power| given == triangles << (2 * power));
    found
        .map(|power| 1 << power)
        .ok_or_else(|| Violation(format!("{given} triangles instead of {triangles} times 4^{}", wanted[0])))
}

/// Checks that the rim's vertices divide the edges of the cell evenly, and lie at or below the ground.
fn check_rim(rim: &[Vec3], points: &[DVec3], segments: usize) -> Result<(), Violation> {
    let edges = points.len() / 2;
    for (v, vertex) in rim.iter().enumerate() {
        let (edge, step) = (v / segments, v % segments);
        let [a, b] = [points[edge], points[(edge + 1) % edges]];
        let expected = a + (b - a) * (step as f64 / segments as f64);
        let off = (vertex.as_dvec3() - expected).truncate();
        let tolerance = expected.truncate().abs() * f64::from(f32::EPSILON) + 1.0e-9;
        ensure(off.abs().cmple(tolerance).all(), || format!("rim vertex {v} is at {vertex} instead of {expected}"))?;
        ensure(vertex.z <= 0.0, || format!("rim vertex {v} is at height {}", vertex.z))?;
    }
    Ok(())
}

/// Checks that every edge has a triangle on both sides, except for the edges of the rim, in its order; and that the
/// Euler characteristic is that of a disc.
fn check_disc(faces: &[[usize; 3]], rim: usize, vertices: usize) -> Result<(), Violation> {
    let mut sides: Vec<[usize; 2]> = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    sides.sort_unstable();
    for pair in sides.windows(2) {
        ensure(pair[0] != pair[1], || format!("two triangles have the edge from {} to {}", pair[0][0], pair[0][1]))?;
    }
    let mut open = 0;
    for &[a, b] in &sides {
        if sides.binary_search(&[b, a]).is_err() {
            ensure(a < rim && b == (a + 1) % rim, || format!("the surface ends between {a} and {b}"))?;
            open += 1;
        }
    }
    ensure(open == rim, || format!("{open} edges of the rim instead of {rim}"))?;
    let edges = (sides.len() + open) / 2;
    ensure(vertices + faces.len() == edges + 1, || {
        format!("{vertices} vertices, {edges} edges and {} faces are no disc", faces.len())
    })
}

/// Checks that each face of the papers' mesh is covered by the faces into which it was cut, except that it is lower.
fn check_flat(
    vertices: &[Vec3],
    faces: &[[usize; 3]],
    points: &[DVec3],
    triangles: &[[u16; 3]],
    segments: usize,
    embedding: f64,
) -> Result<(), Violation> {
    let highest = points.iter().fold(0.0_f64, |most, point| most.max(point.z));
    let sunk = DVec3::Z * (embedding * highest);
    for (parts, whole) in faces.chunks_exact(segments * segments).zip(triangles) {
        let whole = whole.map(|v| points[usize::from(v)] - sunk);
        let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let expected = normal(whole);
        let part = |face: &[usize; 3]| face.map(|v| vertices[v].as_dvec3());
        let sum: DVec3 = parts.iter().map(|face| normal(part(face))).sum();
        let reach = whole.iter().fold(1.0_f64, |most, corner| most.max(corner.abs().max_element()));
        let tolerance = reach * f64::from(f32::EPSILON);
        let size = whole.iter().map(|corner| (*corner - whole[0]).length()).fold(tolerance, f64::max);
        ensure((sum - expected).length() <= 20.0 * tolerance * size * parts.len() as f64, || {
            format!("the parts of a face sum up to {sum} instead of {expected}")
        })?;
        for vertex in parts.iter().flat_map(part) {
            let off = (vertex - whole[0]).dot(expected.normalize_or(DVec3::Z)).abs();
            ensure(off <= 4.0 * tolerance, || format!("{vertex} is {off} px off its face"))?;
        }
    }
    Ok(())
}

/// Checks that the normals have unit length and are the area-weighted means of the faces at their vertices; that faces at the first
/// `buried` vertices count for those alone. `faces` hold indices into `vertices`, and `normals` has three numbers for each of these.
pub(super) fn check_normals(
    vertices: &[Vec3],
    normals: &[f32],
    faces: &[[usize; 3]],
    buried: usize,
) -> Result<(), Violation> {
    let mut sums = vec![(DVec3::ZERO, 0.0); vertices.len()];
    for face in faces {
        let [a, b, c] = face.map(|v| vertices[v].as_dvec3());
        let normal = (b - a).cross(c - a);
        // The most by which rounding the corners to f32 can turn the normal of a sliver.
        let doubt = f64::from(f32::EPSILON) * 4.0 * (a.length() + 1.0) * ((b - a).length() + (c - a).length());
        let at_rim = face.iter().any(|&v| v < buried);
        for &v in face.iter().filter(|&&v| !at_rim || v < buried) {
            sums[v].0 += normal;
            sums[v].1 += doubt;
        }
    }
    for (v, (unit, (sum, doubt))) in normals.chunks_exact(3).map(Vec3::from_slice).zip(sums).enumerate() {
        ensure((unit.length() - 1.0).abs() <= 1.0e-6, || format!("normal {unit} of vertex {v} is not unit"))?;
        let off = unit.as_dvec3().cross(sum).length().max(-unit.as_dvec3().dot(sum));
        ensure(off <= 1.0e-5 * sum.length() + doubt, || format!("normal of vertex {v} is {unit} instead of {sum}"))?;
    }
    Ok(())
}
