//! Triangles of a run with the parts to which they belong and the vertices that are sewn together.

use std::collections::BTreeMap;

use drape_frames::{Manifest, Part, Topology};

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
    pub(crate) parts: Vec<Part>,
    panels: usize,
    /// Fraction of the minimum separation of cloth and bodies that holds where bodies pinch the cloth.
    pub(crate) pinch_fraction: f64,
    /// Smallest of the vertices that are sewn to each vertex: the representative of its class.
    class: Vec<u32>,
    /// Classes of the two ends of the edge to which a vertex is tied, by the class of the vertex.
    between: BTreeMap<u32, [u32; 2]>,
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
        let parts: Vec<Part> = manifest.panels.iter().chain(&manifest.bodies).cloned().collect();
        let mut first = Vec::new();
        let mut part = Vec::with_capacity(triangles.len());
        for (number, own) in parts.iter().enumerate() {
            first.push(part.len());
            part.extend(std::iter::repeat_n(number as u32, own.triangles));
        }
        let vertices = parts.iter().map(|part| part.vertices).sum();
        let class = classes(vertices, &manifest.seam_pairs);
        let tie = |tie: &[u32; 3]| {
            let [own, a, b] = tie.map(|vertex| class[vertex as usize]);
            (own, [a, b])
        };
        let between = manifest.ties.iter().map(tie).collect();
        let panels = manifest.panels.len();
        let pinch_fraction = manifest.pinch_fraction;
        Mesh { triangles, part, first, parts, panels, pinch_fraction, class, between, material }
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Parts of the run, panels before bodies.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Returns whether a triangle belongs to a body.
    pub(crate) fn is_body(&self, triangle: usize) -> bool {
        self.part[triangle] as usize >= self.panels
    }

    /// Returns the vertices of a triangle; vertices that are sewn together have the same number.
    pub(crate) fn vertices(&self, triangle: usize) -> [Vertex; 3] {
        self.triangles[triangle].map(|vertex| {
            let number = self.class[vertex as usize];
            Vertex { number, between: self.between.get(&number).copied() }
        })
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

/// Returns for each vertex the smallest vertex to which it is sewn, directly or through others.
fn classes(vertices: usize, seam_pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut class: Vec<u32> = (0..vertices as u32).collect();
    loop {
        let mut settled = true;
        for &[a, b] in seam_pairs {
            let [a, b] = [a as usize, b as usize];
            let least = class[a].min(class[b]);
            settled &= class[a] == least && class[b] == least;
            (class[a], class[b]) = (least, least);
        }
        if settled {
            return class;
        }
    }
}
