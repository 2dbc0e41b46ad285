//! Topology: the triangles and the material coordinates that all frames share.

use std::path::Path;

use crate::error::Error;
use crate::manifest::Part;

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

/// Refuses triangles whose corners are not three different vertices of their own part.
pub(crate) fn check_corners(
    path: &Path,
    triangles: &[[u32; 3]],
    parts: &[SurfacePart],
) -> Result<(), Error> {
    let (mut vertex, mut triangle) = (0, 0);
    for part in parts {
        let own = vertex..vertex + part.vertices;
        let range = triangles.iter().enumerate().skip(triangle).take(part.triangles);
        for (index, &corners) in range {
            let [a, b, c] = corners;
            let reason = if a == b || b == c || c == a {
                "two are the same"
            } else if !corners.iter().all(|&corner| own.contains(&(corner as usize))) {
                "not all are vertices of its part"
            } else {
                continue;
            };
            let path = path.to_owned();
            return Err(Error::BadTriangle { path, triangle: index, corners, reason });
        }
        (vertex, triangle) = (own.end, triangle + part.triangles);
    }
    Ok(())
}
