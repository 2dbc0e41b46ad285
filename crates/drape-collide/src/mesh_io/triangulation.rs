//! Vertices and triangles, as files and bodies give them to pictures and to surfaces.

use crate::vector::{Vector, add, cross, norm, scale, subtract};

/// Triangle mesh: vertices and triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulation {
    /// Positions of the vertices, in m.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex numbers of each triangle, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Triangulation {
    /// Returns the mesh with coordinates multiplied by a factor, such as m per unit of a file.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Triangulation {
        self.vertices.iter_mut().flatten().for_each(|value| *value *= factor);
        self
    }

    /// Returns the outward unit normals of the vertices: means of those of their triangles,
    /// weighted by area.
    #[must_use]
    pub fn normals(&self) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; self.vertices.len()];
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| self.vertices[corner as usize]);
            let doubled = cross(subtract(b, a), subtract(c, a));
            for &corner in corners {
                sums[corner as usize] = add(sums[corner as usize], doubled);
            }
        }
        let unit = |sum: Vector| if norm(sum) > 0.0 { scale(sum, 1.0 / norm(sum)) } else { sum };
        sums.into_iter().map(unit).collect()
    }
}
