//! Thinning: edges of a closed mesh collapsed as long as the surface hardly moves.
//!
//! An edge is replaced by one vertex where the mean squared distance of that vertex from the planes of
//! all triangles that it stands for is least \[GH97\]. Edges collapse in the order of that distance.
//! It is a mean: the caller measures how far the surface moved.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::edges::Edges;
use super::merge::drop_unused;
use super::quadric::Quadric;
use crate::mesh_io::Triangulation;
use crate::vector::{Vector, cross, dot, norm, subtract};

/// Limits of the thinning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ThinningLimits {
    /// Largest root mean square distance of a new vertex from the planes that it stands for, in m.
    pub(crate) distance: f64,
    /// Largest length of an edge that is made, in m.
    pub(crate) edge_length: f64,
}

/// Smallest cosine of the angle by which a triangle may tilt.
const TILT: f64 = 0.5;

/// Smallest ratio of twice its area to the square of its longest edge of a triangle that is made.
const SLENDER: f64 = 0.05;

/// Edge to collapse, with the vertex that takes its place.
#[derive(Debug, Clone, Copy)]
struct Collapse {
    cost: f64,
    edge: [u32; 2],
    /// Versions of the two vertices for which the cost was computed.
    versions: [u32; 2],
    position: Vector,
}

impl PartialEq for Collapse {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Collapse {}

impl PartialOrd for Collapse {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Collapse {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.cost.total_cmp(&other.cost).then(self.edge.cmp(&other.edge))
    }
}

/// Mesh whose edges are being collapsed.
struct Thinning<'a> {
    mesh: &'a mut Triangulation,
    limits: ThinningLimits,
    /// Triangles around each vertex.
    around: Vec<Vec<u32>>,
    quadrics: Vec<Quadric>,
    /// Number of changes of each vertex.
    versions: Vec<u32>,
    /// Whether each triangle is gone.
    gone: Vec<bool>,
    open: BinaryHeap<Reverse<Collapse>>,
}

/// Collapses edges of a closed mesh within limits, and returns the number of triangles that are gone.
pub(crate) fn thin(mesh: &mut Triangulation, limits: ThinningLimits) -> usize {
    let before = mesh.triangles.len();
    let mut around = vec![Vec::new(); mesh.vertices.len()];
    let mut quadrics = vec![Quadric::default(); mesh.vertices.len()];
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        let plane = Quadric::of_triangle(triangle.map(|v| mesh.vertices[v as usize]));
        for &vertex in triangle {
            around[vertex as usize].push(number as u32);
            quadrics[vertex as usize] = quadrics[vertex as usize] + plane;
        }
    }
    let edges = Edges::new(&mesh.triangles);
    let mut thinning = Thinning {
        limits,
        around,
        quadrics,
        versions: vec![0; mesh.vertices.len()],
        gone: vec![false; mesh.triangles.len()],
        open: BinaryHeap::new(),
        mesh,
    };
    edges.iter().for_each(|(edge, _)| thinning.offer(edge));
    while let Some(Reverse(collapse)) = thinning.open.pop() {
        if thinning.allows(&collapse) {
            thinning.apply(&collapse);
        }
    }
    let mut gone = thinning.gone.into_iter();
    mesh.triangles.retain(|_| !gone.next().unwrap_or(false));
    drop_unused(mesh);
    before - mesh.triangles.len()
}

impl Thinning<'_> {
    fn point(&self, vertex: u32) -> Vector {
        self.mesh.vertices[vertex as usize]
    }

    /// Puts an edge on the list if its collapse is within the limits.
    fn offer(&mut self, edge: [u32; 2]) {
        let [a, b] = edge.map(|vertex| self.point(vertex));
        let sum = self.quadrics[edge[0] as usize] + self.quadrics[edge[1] as usize];
        let middle: Vector = std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]));
        let best = [middle, a, b]
            .into_iter()
            .map(|position| (sum.mean_square(position), position))
            .min_by(|one, other| one.0.total_cmp(&other.0));
        let Some((cost, position)) = best else { return };
        if cost <= self.limits.distance * self.limits.distance {
            let versions = edge.map(|vertex| self.versions[vertex as usize]);
            self.open.push(Reverse(Collapse { cost, edge, versions, position }));
        }
    }

    /// Returns the vertices around a vertex, sorted.
    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let triangles = self.around[vertex as usize].iter();
        let corners = triangles.flat_map(|t| self.mesh.triangles[*t as usize]);
        let mut all: Vec<u32> = corners.filter(|other| *other != vertex).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Returns whether a collapse is of the mesh as it is now, keeps it a closed surface, and makes
    /// no triangle that is tilted, slender or too large.
    fn allows(&self, collapse: &Collapse) -> bool {
        let [a, b] = collapse.edge;
        let current = collapse.edge.map(|vertex| self.versions[vertex as usize]);
        if current != collapse.versions || self.around[a as usize].is_empty() {
            return false;
        }
        let (one, other) = (self.neighbours(a), self.neighbours(b));
        let common = one.iter().filter(|vertex| other.binary_search(vertex).is_ok()).count();
        if common != 2 || one.len() + other.len() < 8 {
            return false;
        }
        let changed = |vertex: u32| {
            if vertex == a || vertex == b { collapse.position } else { self.point(vertex) }
        };
        let all = self.around[a as usize].iter().chain(&self.around[b as usize]);
        all.map(|triangle| self.mesh.triangles[*triangle as usize])
            .filter(|triangle| !(triangle.contains(&a) && triangle.contains(&b)))
            .all(|triangle| {
                let normal = |[p, q, r]: [Vector; 3]| cross(subtract(q, p), subtract(r, p));
                let new = triangle.map(changed);
                let (before, after) = (normal(triangle.map(|v| self.point(v))), normal(new));
                let sides = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| norm(subtract(new[i], new[j])));
                let longest = sides.into_iter().fold(0.0, f64::max);
                dot(before, after) > TILT * norm(before) * norm(after)
                    && norm(after) > SLENDER * longest * longest
                    && longest <= self.limits.edge_length
            })
    }

    /// Moves the first vertex of the edge to its place and gives it the triangles of the second.
    fn apply(&mut self, collapse: &Collapse) {
        let [a, b] = collapse.edge;
        self.mesh.vertices[a as usize] = collapse.position;
        self.quadrics[a as usize] = self.quadrics[a as usize] + self.quadrics[b as usize];
        let moved = std::mem::take(&mut self.around[b as usize]);
        for triangle in moved {
            let corners = &mut self.mesh.triangles[triangle as usize];
            if corners.contains(&a) {
                let corners = *corners;
                self.gone[triangle as usize] = true;
                for corner in corners.into_iter().filter(|corner| *corner != b) {
                    self.around[corner as usize].retain(|own| *own != triangle);
                }
            } else {
                corners.iter_mut().filter(|corner| **corner == b).for_each(|corner| *corner = a);
                self.around[a as usize].push(triangle);
            }
        }
        self.versions[b as usize] += 1;
        self.versions[a as usize] += 1;
        for other in self.neighbours(a) {
            self.offer([a.min(other), a.max(other)]);
        }
    }
}
