use std::collections::BTreeMap;

use crate::distance::Vertex;
use crate::manifest::{Manifest, Part};

/// Where a vertex or a triangle belongs: a panel, or a body, by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PartNumber {
    /// Of the cloth, from 0.
    Panel(usize),
    /// Of the bodies, from 0.
    Body(usize),
}

/// All triangles of a run: first those of the panels, then those of the bodies.
#[derive(Debug, Clone)]
pub struct Mesh {
    /// Three vertices each.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Which part each triangle is of, panels before bodies.
    pub(crate) part: Vec<u32>,
    /// First triangle of each part.
    first: Vec<usize>,
    pub(crate) parts: Vec<Part>,
    panels: usize,
    /// Part of its distance from bodies that cloth keeps wherever they pinch it.
    pub(crate) thinned: f64,
    /// The smallest of the vertices that are sewn to each vertex.
    class: Vec<u32>,
    /// By the class of a vertex that lies between two others, their classes.
    between: BTreeMap<u32, [u32; 2]>,
    /// Material coordinates of the cloth's vertices, in m: its shape at rest.
    pub(crate) material: Vec<[f64; 2]>,
}

impl Mesh {
    /// The mesh of checked triangles: those of the bodies numbered behind the cloth's.
    pub(crate) fn new(
        manifest: &Manifest,
        triangles: Vec<[u32; 3]>,
        material: Vec<[f64; 2]>,
    ) -> Mesh {
        let parts: Vec<Part> = manifest.panels.iter().chain(&manifest.bodies).cloned().collect();
        let mut first = Vec::new();
        let mut part = Vec::with_capacity(triangles.len());
        for (number, own) in parts.iter().enumerate() {
            first.push(part.len());
            part.extend(std::iter::repeat_n(number as u32, own.triangles));
        }
        let vertices = parts.iter().map(|part| part.vertices).sum();
        let class = classes(vertices, &manifest.twins);
        let tie = |tie: &[u32; 3]| {
            let [own, a, b] = tie.map(|vertex| class[vertex as usize]);
            (own, [a, b])
        };
        let between = manifest.ties.iter().map(tie).collect();
        let panels = manifest.panels.len();
        let thinned = manifest.thinned;
        Mesh { triangles, part, first, parts, panels, thinned, class, between, material }
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// The parts, panels before bodies.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    pub(crate) fn is_body(&self, triangle: usize) -> bool {
        self.part[triangle] as usize >= self.panels
    }

    /// The corners, those that are sewn together alike.
    pub(crate) fn vertices(&self, triangle: usize) -> [Vertex; 3] {
        self.triangles[triangle].map(|vertex| {
            let number = self.class[vertex as usize];
            Vertex { number, between: self.between.get(&number).copied() }
        })
    }

    /// Which part a triangle is of, and its number there.
    pub(crate) fn locate(&self, triangle: usize) -> (PartNumber, usize) {
        let part = self.part[triangle] as usize;
        let own = triangle - self.first[part];
        match part.checked_sub(self.panels) {
            None => (PartNumber::Panel(part), own),
            Some(body) => (PartNumber::Body(body), own),
        }
    }

    /// The corners of a triangle of the cloth at rest, in m.
    pub(crate) fn at_rest(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|vertex| {
            let [u, v] = self.material[vertex as usize];
            [u, v, 0.0]
        })
    }
}

/// The smallest vertex of each that are sewn together, directly or through others.
fn classes(vertices: usize, twins: &[[u32; 2]]) -> Vec<u32> {
    let mut class: Vec<u32> = (0..vertices as u32).collect();
    loop {
        let mut settled = true;
        for &[a, b] in twins {
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
