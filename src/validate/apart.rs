//! Checks rocks that were drawn apart against the same rocks as the papers leave them.

use glam::{DVec2, Vec3};

use super::mesh::check_mesh;
use super::worn::check_normals;
use super::{Violation, crossing_pairs, ensure};
use crate::Mesh;
use crate::params::{Crossing, Params};
use crate::rocks::{Field, generate};

/// Checks that no two rocks pass through each other, and that nothing has happened to them but what that takes.
///
/// The same parameters with rocks that may cross have to give a correct mesh. Each vertex must have stayed at its height,
/// and lie between its place there and the axis over its rock's site. Triangles must be the same, and normals the means
/// of the faces as they are now.
///
/// # Errors
/// Returns the first violation.
pub fn check_apart(params: &Params, field: &Field) -> Result<(), Violation> {
    let params = Params { crossing: Crossing::Free, ..params.clone() };
    let free = generate(&params).map_err(|error| Violation(error.to_string()))?;
    check_mesh(&params, &free)?;
    let (mesh, free) = (&field.mesh, &free.mesh);
    let same = mesh.indices == free.indices
        && [&mesh.rock_starts, &mesh.vertex_starts] == [&free.rock_starts, &free.vertex_starts]
        && mesh.rock_layer == free.rock_layer;
    ensure(same, || "rocks that stay apart have other triangles".to_string())?;
    let mut rock = 0;
    for (index, layer) in field.layers.iter().enumerate() {
        for &site in &layer.selection.selected {
            let axis = DVec2::from(layer.sites.pixels[site as usize].map(f64::from)) + 0.5;
            let corners = layer.cells.polygon(site as usize).len();
            // A rock of c corners has 3c − 2 triangles, each cut into the square of the number of segments.
            let triangles = (mesh.rock_starts[rock + 1] - mesh.rock_starts[rock]) as usize / 3;
            let segments = (triangles / (3 * corners - 2)).isqrt();
            let buried = if layer.layer.weathering > 0.0 && segments > 1 { corners * segments } else { 0 };
            check_rock(mesh, free, rock, axis, buried)
                .map_err(|violation| violation.within(format_args!("rock {rock} (layer {index}, site {site})")))?;
            rock += 1;
        }
    }
    let crossing = crossing_pairs(mesh);
    ensure(crossing.is_empty(), || format!("rocks {:?} pass through each other", crossing[0]))
}

fn check_rock(mesh: &Mesh, free: &Mesh, rock: usize, axis: DVec2, buried: usize) -> Result<(), Violation> {
    let range = mesh.vertex_starts[rock] as usize..mesh.vertex_starts[rock + 1] as usize;
    let of = |list: &[f32]| -> Vec<Vec3> {
        list[3 * range.start..3 * range.end].chunks_exact(3).map(Vec3::from_slice).collect()
    };
    let (vertices, before) = (of(&mesh.positions), of(&free.positions));
    for (v, (now, before)) in vertices.iter().zip(&before).enumerate() {
        let [away, most] = [now, before].map(|at| at.as_dvec3().truncate() - axis);
        let tolerance = 4.0 * f64::from(f32::EPSILON) * (1.0 + axis.length() + most.length());
        let aside = (away.perp_dot(most) / most.length().max(1.0e-9)).abs();
        ensure(now.z == before.z && aside <= tolerance, || {
            format!("vertex {v} is at {now}, aside of its way from {before}")
        })?;
        let along = away.dot(most) / most.length().max(1.0e-9);
        ensure(along >= -tolerance && along <= most.length() + tolerance, || {
            format!("vertex {v} is at {now}, not between {before} and the axis over {axis}")
        })?;
    }
    let corners = &mesh.indices[mesh.rock_starts[rock] as usize..mesh.rock_starts[rock + 1] as usize];
    let faces: Vec<[usize; 3]> =
        corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]].map(|v| v as usize - range.start)).collect();
    check_normals(&vertices, &mesh.normals[3 * range.start..3 * range.end], &faces, buried)
}
