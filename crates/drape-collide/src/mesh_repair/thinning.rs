//! Thinning: edges of a closed mesh collapse as long as the surface hardly moves.
//!
//! A collapsed edge becomes one vertex, which stands for the triangles around both ends. The vertex
//! lies where its mean squared distance from the planes of these triangles is least \[GH97\]. Edges
//! collapse in the order of this distance. It is a mean, so the caller measures how far the surface
//! moved.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::edges::Edges;
use super::merge::drop_unused;
use super::quadric::Quadric;
use crate::mesh_io::Triangulation;
use crate::vector::{Vector, cross, dot, midpoint, norm, subtract};

/// Limits of thinning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ThinningLimits {
    /// Largest root mean square distance of a new vertex from the planes of its triangles, in m.
    pub(crate) distance: f64,
    /// Largest length of an edge that a collapse creates, in m.
    pub(crate) edge_length: f64,
}

/// Smallest cosine of the angle by which a collapse may tilt a triangle.
const TILT: f64 = 0.5;

/// Smallest ratio of a new triangle's doubled area to the square of its longest edge.
const SLENDER: f64 = 0.05;

/// Edge that may collapse, with the position of the vertex that would replace it.
#[derive(Debug, Clone, Copy)]
struct Collapse {
    /// Mean squared distance of the new vertex from its planes, in m².
    cost: f64,
    edge: [u32; 2],
    /// Versions of the two vertices at the time when `cost` was computed.
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
    /// Whether each triangle has been removed.
    removed: Vec<bool>,
    /// Collapses to try, the cheapest first.
    queue: BinaryHeap<Reverse<Collapse>>,
}

/// Collapses edges of the closed `mesh` within `limits`. Returns the number of removed triangles.
pub(crate) fn thin(mesh: &mut Triangulation, limits: ThinningLimits) -> usize {
    let before = mesh.triangles.len();
    // Each vertex starts with the planes of the triangles around it.
    let mut around = vec![Vec::new(); mesh.vertices.len()];
    let mut quadrics = vec![Quadric::default(); mesh.vertices.len()];
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        let plane = Quadric::from_triangle(mesh.corners(*triangle));
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
        removed: vec![false; mesh.triangles.len()],
        queue: BinaryHeap::new(),
        mesh,
    };
    edges.iter().for_each(|(edge, _)| thinning.offer(edge));

    while let Some(Reverse(collapse)) = thinning.queue.pop() {
        if thinning.allows(&collapse) {
            thinning.apply(&collapse);
        }
    }

    let mut removed = thinning.removed.into_iter();
    mesh.triangles.retain(|_| !removed.next().unwrap_or(false));
    drop_unused(mesh);
    before - mesh.triangles.len()
}

impl Thinning<'_> {
    fn point(&self, vertex: u32) -> Vector {
        self.mesh.vertices[vertex as usize]
    }

    /// Queues the collapse of `edge` if its cost is within the limits.
    fn offer(&mut self, edge: [u32; 2]) {
        let [a, b] = edge.map(|vertex| self.point(vertex));
        let sum = self.quadrics[edge[0] as usize] + self.quadrics[edge[1] as usize];
        let middle = midpoint(a, b);
        let best = [middle, a, b]
            .into_iter()
            .map(|position| (sum.mean_square(position), position))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((cost, position)) = best else { return };
        if cost <= self.limits.distance * self.limits.distance {
            let versions = edge.map(|vertex| self.versions[vertex as usize]);
            self.queue.push(Reverse(Collapse { cost, edge, versions, position }));
        }
    }

    /// Returns the vertices around `vertex`, sorted.
    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let triangles = self.around[vertex as usize].iter();
        let corners = triangles.flat_map(|t| self.mesh.triangles[*t as usize]);
        let mut all: Vec<u32> = corners.filter(|corner| *corner != vertex).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Returns whether `collapse` is still current, keeps the mesh closed, and creates no triangle
    /// that is tilted, slender or too large.
    fn allows(&self, collapse: &Collapse) -> bool {
        let [a, b] = collapse.edge;
        let current = collapse.edge.map(|vertex| self.versions[vertex as usize]);
        if current != collapse.versions || self.around[a as usize].is_empty() {
            return false;
        }

        // The surface stays a manifold if the ends of the edge have just two neighbours in common.
        let (around_a, around_b) = (self.neighbours(a), self.neighbours(b));
        let common = around_a.iter().filter(|v| around_b.binary_search(v).is_ok()).count();
        if common != 2 || around_a.len() + around_b.len() < 8 {
            return false;
        }

        // Every triangle that remains around the two ends is checked in its new shape.
        let all = self.around[a as usize].iter().chain(&self.around[b as usize]);
        all.map(|triangle| self.mesh.triangles[*triangle as usize])
            .filter(|triangle| !(triangle.contains(&a) && triangle.contains(&b)))
            .all(|triangle| {
                let old = self.mesh.corners(triangle);
                let new: [Vector; 3] = std::array::from_fn(|k| {
                    if triangle[k] == a || triangle[k] == b { collapse.position } else { old[k] }
                });
                let (before, after) = (doubled_normal(old), doubled_normal(new));
                let sides = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| norm(subtract(new[i], new[j])));
                let longest = sides.into_iter().fold(0.0, f64::max);
                dot(before, after) > TILT * norm(before) * norm(after)
                    && norm(after) > SLENDER * longest * longest
                    && longest <= self.limits.edge_length
            })
    }

    /// Moves the first vertex of the edge to the new position, and gives it the triangles of the
    /// second vertex. Queues the edges around it anew.
    fn apply(&mut self, collapse: &Collapse) {
        let [a, b] = collapse.edge;
        self.mesh.vertices[a as usize] = collapse.position;
        self.quadrics[a as usize] = self.quadrics[a as usize] + self.quadrics[b as usize];
        for triangle in std::mem::take(&mut self.around[b as usize]) {
            let corners = &mut self.mesh.triangles[triangle as usize];
            if corners.contains(&a) {
                // The triangle had both ends of the edge, so it is gone.
                let corners = *corners;
                self.removed[triangle as usize] = true;
                for corner in corners.into_iter().filter(|corner| *corner != b) {
                    self.around[corner as usize].retain(|number| *number != triangle);
                }
            } else {
                corners.iter_mut().filter(|corner| **corner == b).for_each(|corner| *corner = a);
                self.around[a as usize].push(triangle);
            }
        }

        self.versions[b as usize] += 1;
        self.versions[a as usize] += 1;
        for neighbour in self.neighbours(a) {
            self.offer([a.min(neighbour), a.max(neighbour)]);
        }
    }
}

/// Returns the normal of a triangle with twice its area as length, in m².
fn doubled_normal([p, q, r]: [Vector; 3]) -> Vector {
    cross(subtract(q, p), subtract(r, p))
}
