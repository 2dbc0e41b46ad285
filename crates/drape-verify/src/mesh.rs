//! Triangles of a run with the parts to which they belong and the vertices that are sewn together.

use drape_frames::{Manifest, SurfacePart, Topology};

use crate::joints::{Joints, Sewn};
use crate::triangle::Vertex;

/// Panel or body to which a triangle belongs, by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PartNumber {
    /// Panel of the cloth, from 0.
    Panel(usize),
    /// Body, from 0.
    Body(usize),
}

/// Triangles of a run: first those of the panels, then those of the bodies.
#[derive(Debug, Clone)]
pub struct Mesh {
    /// Numbers of the three vertices of each triangle.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Number of the part of each triangle, panels before bodies.
    pub(crate) part: Vec<u32>,
    /// First triangle of each part.
    first: Vec<usize>,
    pub(crate) parts: Vec<SurfacePart>,
    panels: usize,
    /// Fraction of the minimum separation of cloth and bodies that holds where bodies pinch the cloth.
    pub(crate) pinch_fraction: f64,
    /// Vertices that the run sews.
    pub(crate) sewn: Sewn,
    /// Joints once all seams are closed.
    closed: Joints,
    /// Material coordinates of the vertices of the cloth, in m: its rest shape.
    material: Vec<[f64; 2]>,
}

impl Mesh {
    /// Returns the mesh of a run; the vertices of the bodies are numbered after the cloth's.
    pub(crate) fn new(manifest: &Manifest, topology: &Topology) -> Mesh {
        let cloth = topology.material.len() as u32;
        let bodies = topology.bodies.iter().map(|triangle| triangle.map(|corner| corner + cloth));
        let triangles: Vec<_> = topology.cloth.iter().copied().chain(bodies).collect();
        let material = topology.material.clone();
        let parts: Vec<SurfacePart> =
            manifest.panels.iter().chain(&manifest.bodies).cloned().collect();
        let mut first = Vec::new();
        let mut part = Vec::with_capacity(triangles.len());
        for (number, own) in parts.iter().enumerate() {
            first.push(part.len());
            part.extend(std::iter::repeat_n(number as u32, own.triangles));
        }
        let vertices = parts.iter().map(|part| part.vertices).sum();
        let sewn = Sewn { pairs: manifest.seam_pairs.clone(), ties: manifest.ties.clone() };
        let closed = sewn.closed(vertices);
        let panels = manifest.panels.len();
        let pinch_fraction = manifest.pinch_fraction;
        Mesh { triangles, part, first, parts, panels, pinch_fraction, sewn, closed, material }
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Parts of the run, panels before bodies.
    #[must_use]
    pub fn parts(&self) -> &[SurfacePart] {
        &self.parts
    }

    /// Returns whether a triangle belongs to a body.
    pub(crate) fn is_body(&self, triangle: usize) -> bool {
        self.part[triangle] as usize >= self.panels
    }

    /// Returns the vertices of a triangle as they are once all seams are closed.
    pub(crate) fn sewn_vertices(&self, triangle: usize) -> [Vertex; 3] {
        self.triangles[triangle].map(|vertex| self.closed.vertex(vertex))
    }

    /// Returns the part of a triangle, and its number in that part.
    pub(crate) fn locate(&self, triangle: usize) -> Location {
        let part = self.part[triangle] as usize;
        let number = match part.checked_sub(self.panels) {
            None => PartNumber::Panel(part),
            Some(body) => PartNumber::Body(body),
        };
        Location { part: number, triangle: triangle - self.first[part] }
    }

    /// Number of vertices of the cloth.
    pub(crate) fn cloth_vertices(&self) -> usize {
        self.material.len()
    }

    /// Returns the vertices of the triangles of the cloth.
    pub(crate) fn cloth_triangles(&self) -> &[[u32; 3]] {
        &self.triangles[..self.first.get(self.panels).copied().unwrap_or(self.triangles.len())]
    }

    /// Returns the number of the panel of a vertex of the cloth.
    pub(crate) fn panel_of_vertex(&self, vertex: usize) -> usize {
        let mut end = 0;
        let ends = self.parts[..self.panels].iter().map(|panel| {
            end += panel.vertices;
            end
        });
        ends.take_while(|&end| end <= vertex).count()
    }

    /// Returns the vertices of the triangles of each body.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = &[[u32; 3]]> {
        let own = self.parts.iter().zip(&self.first).skip(self.panels);
        own.map(|(part, &first)| &self.triangles[first..first + part.triangles])
    }

    /// Returns the corners of a triangle of the cloth at rest, in m.
    pub(crate) fn rest_corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|vertex| {
            let [u, v] = self.material[vertex as usize];
            [u, v, 0.0]
        })
    }
}

/// Triangle by its part and its number there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Location {
    pub(crate) part: PartNumber,
    pub(crate) triangle: usize,
}
