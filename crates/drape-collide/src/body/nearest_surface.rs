//! Distance of points from a triangle surface, closed or open.

use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::TriMesh;

use crate::error::Error;

/// Triangle surface, closed or open, from which distances are measured.
pub struct NearestSurface(TriMesh);

impl std::fmt::Debug for NearestSurface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("NearestSurface").field("triangles", &self.0.indices().len()).finish()
    }
}

impl NearestSurface {
    /// Returns the surface with `vertices`, in m, and `triangles` of three vertex numbers each.
    ///
    /// # Errors
    /// There are no triangles, or a triangle names a vertex that does not exist.
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<NearestSurface, Error> {
        let empty = Error::EmptyMesh { vertices: vertices.len() };
        let all_known =
            triangles.iter().flatten().all(|&corner| (corner as usize) < vertices.len());
        if triangles.is_empty() || !all_known {
            return Err(empty);
        }
        let points = vertices.iter().map(|v| ParryVector::new(v[0], v[1], v[2])).collect();
        TriMesh::new(points, triangles.to_vec()).map(NearestSurface).map_err(|_| empty)
    }

    /// Returns the distance of a point from the surface, in m, or `None` beyond `limit`.
    #[must_use]
    pub fn distance(&self, [x, y, z]: [f64; 3], limit: f64) -> Option<f64> {
        let point = ParryVector::new(x, y, z);
        let near =
            self.0.project_local_point_and_get_location_with_max_dist(point, false, limit)?;
        Some((near.0.point - point).length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_from_faces_edges_and_corners() {
        let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let surface = NearestSurface::new(&vertices, &[[0, 1, 2]]).expect("a surface");
        for (point, distance) in [
            ([0.2, 0.3, 0.2], 0.3),
            ([0.2, -0.3, 0.2], 0.3),
            ([0.5, 0.0, -0.2], 0.2),
            ([-0.3, 0.0, -0.4], 0.5),
        ] {
            let found = surface.distance(point, 1.0).expect("it is near");
            assert!((found - distance).abs() < 1e-15, "{point:?}: {found}");
        }
        assert_eq!(surface.distance([0.2, 0.3, 0.2], 0.29), None);
        assert!(NearestSurface::new(&vertices, &[]).is_err());
        assert!(NearestSurface::new(&vertices, &[[0, 1, 3]]).is_err());
    }
}
