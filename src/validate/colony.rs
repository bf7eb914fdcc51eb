//! Checks wood ears: that the log is closed, that individuals stand on its vertices, that the buffers are consistent,
//! and which individuals cross.

use glam::{DVec3, Vec3};

use super::{Violation, crossing_pairs, ensure};
use crate::params::wood_ear::Params;
use crate::wood_ear::{ColonyMesh, Generator, Layout};

/// Checks that triangles form a closed surface: every edge is used once in each direction, and every index is valid.
///
/// # Errors
/// Returns the first violation.
pub fn check_closed(vertices: usize, indices: &[u32]) -> Result<(), Violation> {
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(indices.len());
    for (k, corners) in indices.chunks_exact(3).enumerate() {
        for c in 0..3 {
            let edge = [corners[c], corners[(c + 1) % 3]];
            ensure((edge[0] as usize) < vertices, || format!("triangle {k} names vertex {}", edge[0]))?;
            ensure(edge[0] != edge[1], || format!("triangle {k} repeats vertex {}", edge[0]))?;
            edges.push(edge);
        }
    }
    edges.sort_unstable();
    for pair in edges.windows(2) {
        ensure(pair[0] != pair[1], || format!("edge {:?} is used twice in one direction", pair[0]))?;
    }
    match edges.iter().find(|[a, b]| edges.binary_search(&[*b, *a]).is_err()) {
        Some(edge) => Err(Violation(format!("edge {edge:?} is used by one triangle alone"))),
        None => Ok(()),
    }
}

/// Checks the colony of a finished run and the log under it.
///
/// Individuals have to stand on vertices of the log, along its normals, within range of their base. The lengths of the
/// buffers must agree; triangles must stay within their individual and repeat the layout; all numbers must be finite
/// and normals of unit length. The number of crossing pairs must be the one that is reported.
///
/// # Errors
/// Returns the first violation.
pub fn check_colony(params: &Params, generator: &Generator) -> Result<(), Violation> {
    let (log, log_mesh) = (generator.log(), generator.log_mesh());
    ensure(log.points.len() == log.normals.len(), || "the log has as many normals as points".to_string())?;
    ensure(
        log_mesh.kinds.len() * 3 == log_mesh.positions.len()
            && log_mesh.coords.len() * 3 == log_mesh.positions.len() * 2,
        || {
            format!(
                "{} kinds and {} coords for {} positions",
                log_mesh.kinds.len(),
                log_mesh.coords.len(),
                log_mesh.positions.len()
            )
        },
    )?;
    check_spawn(params, generator)?;
    check_buffers(generator.mesh(), generator.layout())?;
    let (mesh, stats) = (generator.mesh(), generator.stats());
    let counted = [mesh.individuals(), mesh.triangles(), crossing_pairs(mesh).len()];
    let reported = [stats.individuals, stats.triangles, stats.crossing_pairs].map(|n| n as usize);
    ensure(counted == reported, || format!("individuals, triangles, crossing pairs {counted:?}, reported {reported:?}"))
}

fn check_spawn(params: &Params, generator: &Generator) -> Result<(), Violation> {
    let (log, spawn, mesh) = (generator.log(), generator.spawn(), generator.mesh());
    for (base, vertex) in params.bases.iter().zip(&spawn.bases) {
        let wanted = DVec3::from_array(base.position);
        let least = log.points.iter().map(|p| p.distance(wanted)).fold(f64::INFINITY, f64::min);
        let taken = log.points[*vertex as usize].distance(wanted);
        ensure(taken <= least, || {
            format!("base at {wanted} is {taken} from vertex {vertex}; another is {least} away")
        })?;
    }
    ensure(spawn.individuals.len() == mesh.individuals(), || {
        "individuals are lost on the way to the buffers".to_string()
    })?;
    let ascending = spawn.individuals.windows(2).all(|pair| pair[0].vertex < pair[1].vertex);
    ensure(ascending, || "two individuals on one vertex".to_string())?;
    for (k, individual) in spawn.individuals.iter().enumerate() {
        let vertex = individual.vertex as usize;
        ensure(individual.foot == log.points[vertex], || format!("individual {k} does not stand on vertex {vertex}"))?;
        let [x, y, z] = individual.axes;
        ensure(y.dot(log.normals[vertex]) > 0.9999, || format!("individual {k} does not stand along the normal"))?;
        let frame = [x.length(), y.length(), z.length(), x.cross(y).dot(z)];
        ensure(frame.iter().all(|n| (n - 1.0).abs() < 1.0e-9), || format!("individual {k}: {frame:?} is no frame"))?;
        let distance = |b: usize| log.points[spawn.bases[b] as usize].distance(individual.foot);
        let range = |b: usize| params.bases[b].range.unwrap_or(params.range);
        let own = usize::from(individual.base);
        ensure(distance(own) <= range(own), || format!("individual {k} is {} from its base", distance(own)))?;
        let nearer = (0..params.bases.len()).find(|b| distance(*b) <= range(*b) && distance(*b) < distance(own));
        ensure(nearer.is_none(), || format!("individual {k} is nearer to base {nearer:?}"))?;
        // On a log given by the user, the foot is the number of a triangle.
        let is_grown = !log.triangles.is_empty();
        ensure(!is_grown || mesh.foot[k] == individual.vertex, || format!("foot {k}"))?;
        ensure(mesh.base[k] == individual.base, || format!("base {k}"))?;
    }
    Ok(())
}

fn check_buffers(mesh: &ColonyMesh, layout: &Layout) -> Result<(), Violation> {
    let n = mesh.individuals();
    let [vertices, corners] = [usize::from(layout.vertices), 3 * layout.triangles.len()];
    let lengths = [mesh.positions.len(), mesh.normals.len(), mesh.indices.len(), mesh.size.len(), mesh.base.len()];
    ensure(lengths == [3 * vertices * n, 3 * vertices * n, corners * n, n, n], || {
        format!("lengths {lengths:?} for {n}")
    })?;
    let starts = |step: usize| (0..=n).map(|k| (k * step) as u32).collect::<Vec<u32>>();
    ensure(mesh.vertex_starts == starts(vertices) && mesh.individual_starts == starts(corners), || {
        "starts".to_string()
    })?;
    for (k, indices) in mesh.indices.chunks_exact(corners.max(1)).enumerate() {
        let own = indices.iter().zip(layout.triangles.as_flattened());
        let ok = own.into_iter().all(|(v, expected)| *v as usize == k * vertices + usize::from(*expected));
        ensure(ok && layout.triangles.as_flattened().iter().all(|v| usize::from(*v) < vertices), || {
            format!("individual {k} has indices of another")
        })?;
    }
    ensure(mesh.positions.iter().all(|c| c.is_finite()), || "a position is not finite".to_string())?;
    for (v, normal) in mesh.normals.chunks_exact(3).enumerate() {
        let length = Vec3::from_slice(normal).length();
        ensure((length - 1.0).abs() < 1.0e-5, || format!("normal {v} has length {length}"))?;
    }
    Ok(())
}
