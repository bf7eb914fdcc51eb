//! Checks the mesh: the flat buffers have to hold the displaced shapes, which are recomputed here from Eqs 2 and 3.

use glam::{DVec2, DVec3, Vec3};

use super::worn::check_worn;
use super::{Violation, ensure};
use crate::Mesh;
use crate::params::{Layer, Params, Swing};
use crate::rng::{Purpose, Stream};
use crate::rocks::{Field, Wear};

/// Checks the buffers of a field.
///
/// Rocks have to be in the order of the layers, and within a layer in the order of the selection. The offsets must
/// grow, and every index must lie within the range of its rock. The rim must be at z = 0 and the top where Eqs 2 and 3
/// put it. Normals must have unit length and be the area-weighted means of their faces, and all numbers must be finite.
/// For worn rocks, `worn.rs` says what must hold. Rocks that stay apart are checked by `apart.rs`.
///
/// # Errors
/// Returns the first violation.
pub fn check_mesh(params: &Params, field: &Field) -> Result<(), Violation> {
    let mesh = &field.mesh;
    check_lengths(mesh)?;
    let mut rock = 0;
    for (index, layer) in field.layers.iter().enumerate() {
        for (k, &site) in layer.selection.selected.iter().enumerate() {
            ensure(mesh.rock_layer.get(rock) == Some(&(index as u8)), || {
                format!("rock {rock} is in layer {:?} instead of {index}", mesh.rock_layer.get(rock))
            })?;
            let rim = layer.cells.polygon(site as usize);
            let mut points: Vec<DVec3> = rim.iter().map(|v| v.extend(0.0)).collect();
            points.extend(displaced(params, &layer.layer, site, layer.shapes.top_of(k)));
            let triangles = layer.shapes.triangles_of(k);
            let checked = match Wear::of(&layer.layer) {
                wear if wear.is_none() => check_rock(mesh, rock, &points, triangles),
                wear => check_worn(mesh, rock, wear, layer.layer.height, &points, triangles),
            };
            checked.map_err(|violation| violation.within(format_args!("rock {rock} (layer {index}, site {site})")))?;
            rock += 1;
        }
    }
    ensure(rock == mesh.rocks(), || format!("{} rocks instead of {rock}", mesh.rocks()))
}

fn check_lengths(mesh: &Mesh) -> Result<(), Violation> {
    let Mesh { positions, normals, indices, rock_starts, vertex_starts, rock_layer } = mesh;
    let rocks = rock_layer.len();
    ensure(rock_starts.len() == rocks + 1 && vertex_starts.len() == rocks + 1, || {
        format!("{} and {} offsets for {rocks} rocks", rock_starts.len(), vertex_starts.len())
    })?;
    ensure(positions.len() == normals.len(), || format!("{} positions, {} normals", positions.len(), normals.len()))?;
    for (name, starts, len) in [("rock", rock_starts, indices.len()), ("vertex", vertex_starts, positions.len() / 3)] {
        let increases = starts.first() == Some(&0) && starts.windows(2).all(|pair| pair[0] < pair[1]);
        ensure(increases, || format!("{name} starts do not increase from 0"))?;
        ensure(starts[rocks] as usize == len, || format!("{name} starts end at {} of {len}", starts[rocks]))?;
    }
    Ok(())
}

/// The p_add of a rock after Eqs 2 and 3, computed from the random streams of its layer and site.
fn displaced(params: &Params, layer: &Layer, site: u32, top: &[DVec2]) -> Vec<DVec3> {
    let stream = |purpose| Stream::new(params.seed, purpose, layer.id, site);
    let [purpose_j1, purpose_j2] = match params.swing {
        Swing::Shared => [Purpose::RockSwing, Purpose::VertexSwing],
        Swing::Separate => [Purpose::RockSwingHeight, Purpose::VertexSwingHeight],
    };
    let (j1, j1_height) = (stream(Purpose::RockSwing).unit(), stream(purpose_j1).unit());
    let (mut j2, mut j2_height) = (stream(Purpose::VertexSwing), stream(purpose_j2));
    let g_add = top.iter().sum::<DVec2>() / top.len() as f64;
    top.iter()
        .map(|&p_add| {
            let [c_w1, c_w2, c_w3] = layer.taper;
            let [c_h1, c_h2, c_h3] = layer.height;
            let step = c_w1 + c_w2 * j1 + c_w3 * j2.unit();
            let z = c_h1 + c_h2 * j1_height + c_h3 * j2_height.unit();
            let outward = p_add - g_add;
            let t_xy = if outward == DVec2::ZERO { DVec2::ZERO } else { step * outward / outward.length() };
            (p_add + t_xy).extend(z)
        })
        .collect()
}

fn check_rock(mesh: &Mesh, rock: usize, points: &[DVec3], triangles: &[[u16; 3]]) -> Result<(), Violation> {
    let vertices = mesh.vertex_starts[rock] as usize..mesh.vertex_starts[rock + 1] as usize;
    let corners = &mesh.indices[mesh.rock_starts[rock] as usize..mesh.rock_starts[rock + 1] as usize];
    ensure(vertices.len() == points.len() && corners.len() == 3 * triangles.len(), || {
        format!(
            "{} vertices and {} indices instead of {} and {}",
            vertices.len(),
            corners.len(),
            points.len(),
            3 * triangles.len()
        )
    })?;
    for (corner, &vertex) in corners.iter().zip(triangles.as_flattened()) {
        let expected = vertices.start + usize::from(vertex);
        ensure(*corner as usize == expected && vertices.contains(&expected), || {
            format!("index {corner} instead of {expected}, of vertices {vertices:?}")
        })?;
    }

    let mut normals = vec![(DVec3::ZERO, 0.0); points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| points[usize::from(v)]);
        let normal = (b - a).cross(c - a);
        for v in triangle.map(usize::from) {
            normals[v].0 += normal;
            normals[v].1 += normal.length();
        }
    }
    for (v, (&expected, (normal, area))) in points.iter().zip(normals).enumerate() {
        let at = 3 * (vertices.start + v);
        let position = Vec3::from_slice(&mesh.positions[at..at + 3]);
        // Half a unit in the last place of f32 for each coordinate, plus what f64 may differ by.
        let tolerance = expected.abs() * f64::from(f32::EPSILON) + 1.0e-9;
        ensure((position.as_dvec3() - expected).abs().cmple(tolerance).all(), || {
            format!("vertex {v} is at {position} instead of {expected}")
        })?;
        ensure(position.z == 0.0 || v >= points.len() / 2, || format!("rim vertex {v} is at height {}", position.z))?;
        let unit = Vec3::from_slice(&mesh.normals[at..at + 3]);
        ensure((unit.length() - 1.0).abs() <= 1.0e-6, || format!("normal {unit} of vertex {v} is not unit"))?;
        // If the faces cancel, what remains of their sum is rounding error, and so is its direction.
        if normal.length() > 1.0e-7 * area {
            let distance = unit.as_dvec3().distance(normal.normalize());
            ensure(distance <= 1.0e-6, || format!("normal of vertex {v} is {unit} instead of {}", normal.normalize()))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rocks::generate;

    #[test]
    fn a_tampered_mesh_is_found_out() {
        let params = Params { image_width: 200, image_height: 160, ..Params::default() };
        let field = generate(&params).unwrap_or_default();
        assert_eq!(check_mesh(&params, &field), Ok(()));
        let message = |params: &Params, field: &Field| {
            check_mesh(params, field).map_or_else(|violation| violation.to_string(), |()| String::new())
        };
        let with = |change: &dyn Fn(&mut Mesh)| {
            let mut field = field.clone();
            change(&mut field.mesh);
            message(&params, &field)
        };
        for axis in 0..3 {
            assert!(with(&|mesh| mesh.positions[30 + axis] += 0.01).contains("instead of"));
            assert!(with(&|mesh| mesh.positions[axis] = f32::NAN).contains("instead of"));
            assert!(with(&|mesh| mesh.normals[30 + axis] += 0.01).contains("normal"));
            assert!(with(&|mesh| mesh.normals[axis] = f32::INFINITY).contains("normal"));
        }
        assert!(with(&|mesh| mesh.indices.swap(4, 5)).contains("index"));
        assert!(with(&|mesh| mesh.rock_starts[1] += 3).contains("indices instead of"));
        assert!(with(&|mesh| mesh.vertex_starts.swap(1, 2)).contains("do not increase"));
        assert!(with(&|mesh| mesh.rock_layer[0] = 2).contains("is in layer"));
        let mut other = params.clone();
        other.seed += 1;
        assert!(message(&other, &field).contains("instead of"));
        other = Params { swing: Swing::Separate, ..params.clone() };
        assert!(message(&other, &field).contains("instead of"));
    }
}
