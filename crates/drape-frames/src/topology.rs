//! Topology: the triangles and the material coordinates that all frames share.

use std::path::Path;

use crate::error::Error;
use crate::manifest::SurfacePart;

/// Triangles and material coordinates that all frames share.
#[derive(Debug, Clone, PartialEq)]
pub struct Topology {
    /// Weft and warp coordinate of each vertex of the cloth at rest, in m.
    pub material: Vec<[f64; 2]>,
    /// Triangles of the cloth, panel after panel: numbers of vertices of the cloth.
    pub cloth: Vec<[u32; 3]>,
    /// Triangles of the bodies, body after body: numbers of vertices of the bodies.
    pub bodies: Vec<[u32; 3]>,
}

/// Checks that the corners of each of `triangles` are three different vertices of its part.
///
/// `triangles` are the triangles of all `parts`, part after part, from the file `path`.
///
/// # Errors
/// [`Error::BadTriangle`] for the first triangle that fails.
pub(crate) fn check_corners(
    path: &Path,
    triangles: &[[u32; 3]],
    parts: &[SurfacePart],
) -> Result<(), Error> {
    let (mut first_vertex, mut first_triangle) = (0, 0);
    for part in parts {
        let vertices = first_vertex..first_vertex + part.vertices;
        let of_part = triangles.iter().enumerate().skip(first_triangle).take(part.triangles);
        for (triangle, &corners) in of_part {
            let [a, b, c] = corners;
            let reason = if a == b || b == c || c == a {
                "two are the same"
            } else if !corners.iter().all(|&corner| vertices.contains(&(corner as usize))) {
                "not all are vertices of its part"
            } else {
                continue;
            };
            let path = path.to_owned();
            return Err(Error::BadTriangle { path, triangle, corners, reason });
        }
        (first_vertex, first_triangle) = (vertices.end, first_triangle + part.triangles);
    }
    Ok(())
}
