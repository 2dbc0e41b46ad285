//! Vertices and triangles, as files and bodies give them to pictures and to surfaces.

use std::fmt::Write;

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
    /// Returns the mesh in the format of Wavefront (OBJ). [`parse_mesh`](crate::parse_mesh) reads
    /// the numbers to the same bits.
    #[must_use]
    pub fn to_obj(&self) -> String {
        let mut text = String::new();
        for [x, y, z] in &self.vertices {
            _ = writeln!(text, "v {x:?} {y:?} {z:?}");
        }
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| u64::from(corner) + 1);
            _ = writeln!(text, "f {a} {b} {c}");
        }
        text
    }

    /// Returns the mesh with coordinates multiplied by `factor`, such as m per unit of a file.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Triangulation {
        self.vertices.iter_mut().flatten().for_each(|value| *value *= factor);
        self
    }

    /// Returns the outward unit normals of the vertices: means of the normals of the triangles
    /// around each vertex, weighted by area.
    #[must_use]
    pub fn normals(&self) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; self.vertices.len()];
        for corners in &self.triangles {
            let [a, b, c] = self.corners(*corners);
            let doubled = cross(subtract(b, a), subtract(c, a));
            for &corner in corners {
                sums[corner as usize] = add(sums[corner as usize], doubled);
            }
        }
        sums.into_iter().map(unit_or_zero).collect()
    }

    /// Returns the position of `vertex`, in m.
    pub(crate) fn point(&self, vertex: u32) -> Vector {
        self.vertices[vertex as usize]
    }

    /// Returns the positions of the corners of `triangle`, in m.
    pub(crate) fn corners(&self, triangle: [u32; 3]) -> [Vector; 3] {
        triangle.map(|vertex| self.point(vertex))
    }
}

/// Returns the unit vector in the direction of `sum`, or `sum` if it is zero.
fn unit_or_zero(sum: Vector) -> Vector {
    if norm(sum) > 0.0 { scale(sum, 1.0 / norm(sum)) } else { sum }
}
