//! Topology: the triangles and the material coordinates that all frames share.

use std::path::Path;

use crate::error::Error;
use crate::manifest::{Manifest, SurfacePart};

/// Triangles and material coordinates that all frames share.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Topology {
    /// Weft and warp coordinate of each vertex of the cloth at rest, in m, panel after panel. A
    /// program without a pattern gives the flat coordinates of its choice.
    pub material: Vec<[f64; 2]>,
    /// Triangles of the cloth, panel after panel: numbers of vertices of the whole cloth, from 0.
    pub cloth: Vec<[u32; 3]>,
    /// Triangles of the bodies, body after body: numbers of vertices of all bodies, from 0.
    pub bodies: Vec<[u32; 3]>,
}

impl Topology {
    /// Checks that the topology has the vertices and triangles of `manifest`, and checks
    /// `manifest`.
    ///
    /// # Errors
    /// [`Error::BadTopology`] or [`Error::BadTriangle`].
    pub(crate) fn check(&self, manifest: &Manifest) -> Result<(), Error> {
        manifest.check().map_err(|reason| Error::BadTopology { reason })?;
        let (cloth, bodies) = (manifest.cloth_counts(), manifest.body_counts());
        let counts = [
            ("material coordinates", self.material.len(), cloth.vertices),
            ("triangles of cloth", self.cloth.len(), cloth.triangles),
            ("triangles of bodies", self.bodies.len(), bodies.triangles),
        ];
        for (what, found, needed) in counts {
            if found != needed {
                let reason = format!("there are {found} {what}, and the parts have {needed}");
                return Err(Error::BadTopology { reason });
            }
        }

        let finite = self.material.iter().flatten().all(|coordinate| coordinate.is_finite());
        if !finite {
            let reason = "a material coordinate is no number".to_owned();
            return Err(Error::BadTopology { reason });
        }
        check_corners(Path::new("cloth"), &self.cloth, &manifest.panels)?;
        check_corners(Path::new("bodies"), &self.bodies, &manifest.bodies)
    }
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
