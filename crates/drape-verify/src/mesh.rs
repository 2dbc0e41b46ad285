//! Mesh: the triangles of a run, their parts, and the vertices that are sewn together.

use drape_frames::{Manifest, SurfacePart, Topology};

use crate::joints::{Joints, SewnVertices};
use crate::triangle::Vertex;

/// Number of a panel or body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PartNumber {
    /// Panel of the cloth, from 0.
    Panel(usize),
    /// Body, from 0.
    Body(usize),
}

/// Triangles of a run, the triangles of the panels before the triangles of the bodies.
#[derive(Debug, Clone)]
pub struct Mesh {
    /// Numbers of the three vertices of each triangle. The vertices of the bodies follow the
    /// vertices of the cloth.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Index in `parts` of the part of each triangle.
    pub(crate) part: Vec<u32>,
    /// Number of the first triangle of each part.
    first_triangle: Vec<usize>,
    /// Panels, then bodies.
    pub(crate) parts: Vec<SurfacePart>,
    panel_count: usize,
    /// Fraction of the minimum separation of cloth and bodies that holds where bodies pinch the
    /// cloth.
    pub(crate) pinch_fraction: f64,
    /// Vertices that the run sews.
    pub(crate) sewn: SewnVertices,
    /// Joints once all seams are closed.
    closed: Joints,
    /// Material coordinates of the vertices of the cloth, in m. They are its rest shape.
    material: Vec<[f64; 2]>,
}

impl Mesh {
    /// Returns the mesh of the run with the given `manifest` and `topology`.
    pub(crate) fn new(manifest: &Manifest, topology: &Topology) -> Mesh {
        let cloth_vertices = topology.material.len() as u32;
        let bodies =
            topology.bodies.iter().map(|triangle| triangle.map(|corner| corner + cloth_vertices));
        let triangles: Vec<_> = topology.cloth.iter().copied().chain(bodies).collect();

        let parts: Vec<SurfacePart> =
            manifest.panels.iter().chain(&manifest.bodies).cloned().collect();
        let mut first_triangle = Vec::new();
        let mut part = Vec::with_capacity(triangles.len());
        for (index, SurfacePart { triangles, .. }) in parts.iter().enumerate() {
            first_triangle.push(part.len());
            part.extend(std::iter::repeat_n(index as u32, *triangles));
        }

        let vertex_count = parts.iter().map(|part| part.vertices).sum();
        let sewn = SewnVertices {
            pairs: manifest.seam_pairs.clone(),
            ties: manifest.ties.clone(),
            closed_gap: manifest.closed_gap,
        };
        Mesh {
            triangles,
            part,
            first_triangle,
            parts,
            panel_count: manifest.panels.len(),
            pinch_fraction: manifest.pinch_fraction,
            closed: sewn.closed(vertex_count),
            sewn,
            material: topology.material.clone(),
        }
    }

    /// Returns the number of triangles of cloth and bodies.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Returns the parts of the run, panels before bodies.
    #[must_use]
    pub fn parts(&self) -> &[SurfacePart] {
        &self.parts
    }

    /// Returns whether triangle `triangle` belongs to a body.
    pub(crate) fn is_body(&self, triangle: usize) -> bool {
        self.part[triangle] as usize >= self.panel_count
    }

    /// Returns the vertices that triangle `triangle` has once all seams are closed.
    pub(crate) fn sewn_vertices(&self, triangle: usize) -> [Vertex; 3] {
        self.triangles[triangle].map(|vertex| self.closed.vertex(vertex))
    }

    /// Returns the part of triangle `triangle` and its number in this part.
    pub(crate) fn locate(&self, triangle: usize) -> TriangleLocation {
        let part = self.part[triangle] as usize;
        let number = match part.checked_sub(self.panel_count) {
            None => PartNumber::Panel(part),
            Some(body) => PartNumber::Body(body),
        };
        TriangleLocation { part: number, triangle: triangle - self.first_triangle[part] }
    }

    /// Returns the number of vertices of the cloth.
    pub(crate) fn cloth_vertex_count(&self) -> usize {
        self.material.len()
    }

    /// Returns the vertices of the triangles of the cloth.
    pub(crate) fn cloth_triangles(&self) -> &[[u32; 3]] {
        let first_of_bodies = self.first_triangle.get(self.panel_count);
        &self.triangles[..first_of_bodies.copied().unwrap_or(self.triangles.len())]
    }

    /// Returns the number of the panel of vertex `vertex` of the cloth.
    pub(crate) fn panel_of_vertex(&self, vertex: usize) -> usize {
        let mut end = 0;
        self.parts[..self.panel_count]
            .iter()
            .take_while(|panel| {
                end += panel.vertices;
                end <= vertex
            })
            .count()
    }

    /// Returns the vertices of the triangles of each body.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = &[[u32; 3]]> {
        let bodies = self.parts.iter().zip(&self.first_triangle).skip(self.panel_count);
        bodies.map(|(body, &first)| &self.triangles[first..first + body.triangles])
    }

    /// Returns the corners that triangle `triangle` of the cloth has at rest, in m.
    pub(crate) fn rest_corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|vertex| {
            let [u, v] = self.material[vertex as usize];
            [u, v, 0.0]
        })
    }
}

/// Part of a triangle and number of the triangle in this part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct TriangleLocation {
    pub(crate) part: PartNumber,
    /// Number of the triangle in its part, from 0.
    pub(crate) triangle: usize,
}
