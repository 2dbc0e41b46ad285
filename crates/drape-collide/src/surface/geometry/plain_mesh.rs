//! Parts of a surface from plain meshes and point clouds.

use super::parts::{ContactDistances, SurfaceParts};
use crate::error::Error;
use crate::vector::{cross, norm, subtract};

/// Plain mesh or point cloud, for [`SurfaceParts::from_meshes`].
#[derive(Debug, Clone, Copy, Default)]
pub struct PlainMesh<'a> {
    /// Position of each vertex, in m.
    pub positions: &'a [[f64; 3]],
    /// Vertices of each triangle. A vertex without a triangle is a point, and a mesh without
    /// triangles is a point cloud.
    pub triangles: &'a [[u32; 3]],
}

impl SurfaceParts {
    /// Returns the parts of a surface of the `free` meshes, which the caller moves by forces, and
    /// of `bodies`, whose motion is given. Each mesh is a group, and `distances` are the half
    /// distances of all groups. No seams join the meshes.
    ///
    /// The vertices of the free meshes come first, mesh by mesh. A vertex has a third of the area
    /// of its triangles. A point, which has no triangles, has the area of a disc whose radius is
    /// the activation distance of `distances`. A point of a body has no area and pushes nothing.
    ///
    /// # Errors
    ///
    /// A triangle names a vertex that its mesh does not have. [`Surface::new`](crate::Surface::new)
    /// checks everything else.
    ///
    /// # Examples
    ///
    /// Two loose points over a floor of one triangle. A point is pushed up, as if it were cloth.
    ///
    /// ```
    /// use drape_collide::{ContactDistances, PlainMesh, Surface, SurfaceContact};
    /// use drape_collide::{SurfaceParts, SurfaceSettings};
    ///
    /// let points = [[0.0, 4e-4, 0.0], [0.0, 0.5, 0.1]];
    /// let floor = [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    /// let distances = ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 };
    /// let parts = SurfaceParts::from_meshes(
    ///     &[PlainMesh { positions: &points, triangles: &[] }],
    ///     &[PlainMesh { positions: &floor, triangles: &[[0, 1, 2]] }],
    ///     distances,
    /// )?;
    ///
    /// let settings = SurfaceSettings::new(1e8, vec![0.0; 4]);
    /// let bodies = floor.concat();
    /// let mut contact = SurfaceContact::new(Surface::new(parts)?, settings, bodies)?;
    /// let mut forces = [0.0; 6];
    /// contact.energy(points.as_flattened())?.add_forces(&mut forces)?;
    /// assert!(forces[1] > 0.0 && forces[4] == 0.0);
    /// # Ok::<(), drape_collide::Error>(())
    /// ```
    pub fn from_meshes(
        free: &[PlainMesh<'_>],
        bodies: &[PlainMesh<'_>],
        distances: ContactDistances,
    ) -> Result<SurfaceParts, Error> {
        let mut parts = SurfaceParts {
            distances: vec![distances; free.len() + bodies.len()],
            free_vertices: free.iter().map(|mesh| mesh.positions.len()).sum(),
            ..SurfaceParts::default()
        };
        for (group, mesh) in free.iter().chain(bodies).enumerate() {
            let areas = mesh.vertex_areas(distances.activation_distance)?;
            let first = parts.areas.len() as u32;
            parts.rest_positions.extend_from_slice(mesh.positions.as_flattened());
            parts.triangles.extend(mesh.triangles.iter().map(|corners| corners.map(|v| first + v)));
            parts.groups.resize(parts.groups.len() + areas.len(), group as u32);
            parts.areas.extend(areas);
        }
        Ok(parts)
    }
}

impl PlainMesh<'_> {
    /// Returns the area of each vertex, in m². A vertex without a triangle has the area of a disc
    /// with `radius`, in m.
    fn vertex_areas(&self, radius: f64) -> Result<Vec<f64>, Error> {
        let vertices = self.positions.len();
        let mut areas = vec![0.0; vertices];
        let mut is_point = vec![true; vertices];
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|corner| **corner as usize >= vertices) {
                return Err(Error::MissingVertex { triangle, index, vertices });
            }
            let [a, b, c] = corners.map(|corner| self.positions[corner as usize]);
            let area = 0.5 * norm(cross(subtract(b, a), subtract(c, a)));
            for &corner in corners {
                areas[corner as usize] += area / 3.0;
                is_point[corner as usize] = false;
            }
        }
        let disc = std::f64::consts::PI * radius * radius;
        let areas = areas.iter().zip(is_point);
        Ok(areas.map(|(area, is_point)| if is_point { disc } else { *area }).collect())
    }
}
