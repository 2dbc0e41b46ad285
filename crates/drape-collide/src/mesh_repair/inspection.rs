//! Inspection of a triangulation: what it is, and what keeps it from being a body.

use crate::mesh_io::{Triangulation, doubled_area};
use crate::vector::{norm, subtract};

use super::edges::{Edges, volume_six};
use super::holes::{Hole, find_holes};
use super::intersection::intersections;
use super::merge::merge_coincident;

/// Number of places that are kept of each kind.
const PLACES: usize = 5;

/// Median of the lengths of edges over the spacing of cloth, below which triangles are too fine and
/// above which they are too coarse.
const FINE: f64 = 0.2;
const COARSE: f64 = 5.0;

/// Number of triangles above which a body is round: boxes have few, and their edges are meant.
const ROUND: usize = 200;

/// Places where a mesh has a fault.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Places {
    /// Number of the places.
    pub count: usize,
    /// The first of them, in m.
    pub first: Vec<[f64; 3]>,
}

impl FromIterator<[f64; 3]> for Places {
    fn from_iter<I: IntoIterator<Item = [f64; 3]>>(places: I) -> Places {
        let mut all = Places::default();
        for place in places {
            all.count += 1;
            if all.first.len() < PLACES {
                all.first.push(place);
            }
        }
        all
    }
}

/// Lengths of the edges of a mesh, in m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EdgeLengths {
    /// Shortest edge.
    pub min: f64,
    /// Median.
    pub median: f64,
    /// Longest edge.
    pub max: f64,
}

/// What a triangulation is, and what keeps it from being a body.
///
/// ```
/// use drape_collide::{MeshInspection, Triangulation};
///
/// let tetrahedron = Triangulation {
///     vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
///     triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2]],
/// };
/// let inspection = MeshInspection::new(&tetrahedron);
/// assert_eq!((inspection.parts, inspection.holes.len()), (1, 1));
/// assert!(!inspection.is_closed());
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshInspection {
    /// Number of vertices at positions of their own.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Smallest coordinates, in m.
    pub low: [f64; 3],
    /// Largest coordinates, in m.
    pub high: [f64; 3],
    /// Area, in m².
    pub area: f64,
    /// Volume, in m³: below 0 if the surface is inside out.
    pub volume: f64,
    /// Number of parts that share no edge.
    pub parts: usize,
    /// Holes: closed lines of edges with one triangle.
    pub holes: Vec<Hole>,
    /// Edges with more than two triangles.
    pub branching_edges: Places,
    /// Edges on whose two sides the triangles disagree about the outside.
    pub opposed_edges: Places,
    /// Triangles without area.
    pub flat_triangles: Places,
    /// Edges that meet a triangle of the mesh, exactly.
    pub intersections: Places,
    /// Lengths of the edges.
    pub edge_lengths: EdgeLengths,
}

impl MeshInspection {
    /// Inspects a mesh as [`Mesh`](crate::Mesh) takes it: vertices at one position are one vertex, and
    /// triangles that lose a corner by it are left out. Triangles that name a vertex that is not there are
    /// left out too.
    #[must_use]
    pub fn new(mesh: &Triangulation) -> MeshInspection {
        let mut merged = mesh.clone();
        merge_coincident(&mut merged);
        let mesh = &merged;
        let point = |vertex: u32| mesh.vertices[vertex as usize];
        let edges = Edges::new(&mesh.triangles);
        let middle = |[a, b]: [u32; 2]| -> [f64; 3] {
            std::array::from_fn(|axis| 0.5 * (point(a)[axis] + point(b)[axis]))
        };
        let length = |[a, b]: [u32; 2]| norm(subtract(point(a), point(b)));
        let mut lengths: Vec<f64> = edges.iter().map(|(edge, _)| length(edge)).collect();
        lengths.sort_unstable_by(f64::total_cmp);
        let edge_lengths = EdgeLengths {
            min: lengths.first().copied().unwrap_or(0.0),
            median: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0),
            max: lengths.last().copied().unwrap_or(0.0),
        };
        let areas =
            mesh.triangles.iter().map(|t| doubled_area(t.map(point)).unwrap_or_else(|area| area));
        let mut parts = edges.parts(mesh.triangles.len());
        parts.sort_unstable();
        parts.dedup();
        let extreme = |start: f64, pick: fn(f64, f64) -> f64| -> [f64; 3] {
            std::array::from_fn(|axis| mesh.vertices.iter().map(|v| v[axis]).fold(start, pick))
        };
        let origin = mesh.vertices.first().copied().unwrap_or_default();
        let flat = mesh.triangles.iter().filter(|t| doubled_area(t.map(point)).is_err());
        MeshInspection {
            vertices: mesh.vertices.len(),
            triangles: mesh.triangles.len(),
            low: extreme(f64::INFINITY, f64::min),
            high: extreme(f64::NEG_INFINITY, f64::max),
            area: 0.5 * areas.sum::<f64>(),
            volume: mesh.triangles.iter().map(|t| volume_six(mesh, *t, origin)).sum::<f64>() / 6.0,
            parts: parts.len(),
            holes: find_holes(mesh, &edges),
            branching_edges: edges
                .iter()
                .filter(|(_, sides)| sides.len() > 2)
                .map(|(edge, _)| middle(edge))
                .collect(),
            opposed_edges: edges
                .iter()
                .filter(|(_, sides)| sides.len() == 2 && sides[0].rises == sides[1].rises)
                .map(|(edge, _)| middle(edge))
                .collect(),
            flat_triangles: flat.map(|triangle| point(triangle[0])).collect(),
            intersections: intersections(mesh, &edges, edge_lengths.median).into_iter().collect(),
            edge_lengths,
        }
    }

    /// Returns the size along x, y and z, in m.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        std::array::from_fn(|axis| self.high[axis] - self.low[axis])
    }

    /// Returns whether its triangles are finer than cloth with a spacing in m can see.
    #[must_use]
    pub fn is_too_fine(&self, spacing: f64) -> bool {
        let median = self.edge_lengths.median;
        median > 0.0 && median < FINE * spacing
    }

    /// Returns whether its triangles are so large that cloth with a spacing in m shows their edges:
    /// those of a round body, as its number of triangles tells.
    #[must_use]
    pub fn is_too_coarse(&self, spacing: f64) -> bool {
        self.edge_lengths.median > COARSE * spacing && self.triangles > ROUND
    }

    /// Returns whether every edge has one triangle on each side, and all agree about the outside.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.holes.is_empty() && self.branching_edges.count == 0 && self.opposed_edges.count == 0
    }

    /// Returns the number of faults of the surface for which a body is refused: open edges, edges with
    /// more than two triangles, edges on which the triangles disagree, and triangles without area.
    #[must_use]
    pub fn faults(&self) -> usize {
        let open: usize = self.holes.iter().map(|hole| hole.vertices.len()).sum();
        open + self.branching_edges.count + self.opposed_edges.count + self.flat_triangles.count
    }

    /// Returns whether the mesh is a worse body than another: one whose surface has more faults, or as
    /// many and more intersections with itself.
    #[must_use]
    pub fn is_worse_than(&self, other: &MeshInspection) -> bool {
        let rank = |own: &MeshInspection| (own.faults(), own.intersections.count);
        rank(self) > rank(other)
    }
}
