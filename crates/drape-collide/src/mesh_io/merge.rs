//! Merging of vertices at one position, and the test for triangles without area.

use std::collections::BTreeMap;

use super::triangulation::Triangulation;
use crate::error::{Error, check_position};
use crate::vector::{Vector, cross, dot, norm, subtract};

/// Ratio of twice a triangle's area to the square of its longest edge below which it is flat.
///
/// Rounding leaves about 1e-16 of exactly collinear corners. A sliver of 1 m by 1 µm has 1e-6.
const FLAT: f64 = 1e-12;

/// Mesh with one vertex for each position.
pub(crate) struct MergedMesh {
    pub(crate) mesh: Triangulation,
    /// For each vertex, the number of the first given vertex at its position.
    pub(crate) source_vertices: Vec<u32>,
}

/// Merges `vertices` at one position and leaves out `triangles` that lose a corner by merging.
pub(crate) fn merge_coincident_vertices(
    vertices: &[Vector],
    triangles: &[[u32; 3]],
) -> Result<MergedMesh, Error> {
    let mut number_at = BTreeMap::new();
    let mut merged = Vec::new();
    let mut source_vertices = Vec::new();
    let mut faces = Vec::with_capacity(triangles.len());
    for (t, triangle) in triangles.iter().enumerate() {
        // Each corner gets the number of the one vertex at its position.
        let mut face = [0; 3];
        for (corner, &index) in face.iter_mut().zip(triangle) {
            let Some(&position) = vertices.get(index as usize) else {
                return Err(Error::MissingVertex { triangle: t, index, vertices: vertices.len() });
            };
            check_position(|| format!("vertex {index} of the mesh"), position)?;
            // Adding zero makes -0 the same position as 0.
            let key = position.map(|value| (value + 0.0).to_bits());
            *corner = *number_at.entry(key).or_insert_with(|| {
                merged.push(position);
                source_vertices.push(index);
                merged.len() as u32 - 1
            });
        }

        let corners: [Vector; 3] = face.map(|index| merged[index as usize]);
        if face[0] == face[1] || face[1] == face[2] || face[2] == face[0] {
            continue;
        }
        if let Err(area) = doubled_area(corners) {
            return Err(Error::FlatTriangle { triangle: t, place: corners[0], area });
        }
        faces.push(face);
    }
    if faces.is_empty() {
        return Err(Error::EmptyMesh { vertices: vertices.len() });
    }
    Ok(MergedMesh { mesh: Triangulation { vertices: merged, triangles: faces }, source_vertices })
}

/// Returns twice the area of a triangle, in m², as `Err` if it is mostly rounding.
pub(crate) fn doubled_area([a, b, c]: [Vector; 3]) -> Result<f64, f64> {
    let sides = [subtract(b, a), subtract(c, b), subtract(a, c)];
    let area = norm(cross(sides[0], sides[1]));
    let longest = sides.iter().map(|s| dot(*s, *s)).fold(0.0, f64::max);
    if area > FLAT * longest { Ok(area) } else { Err(area) }
}
