//! Inspection of a triangulation: its size, its parts, and its faults as a body.

use crate::mesh_io::{Triangulation, doubled_area};
use crate::vector::{bounds, midpoint, norm, subtract};

use super::edges::{Edges, volume_six};
use super::holes::{Hole, find_holes};
use super::intersection::intersections;
use super::merge::merge_coincident;

/// Number of places that are kept of each kind of fault.
const PLACES: usize = 5;

/// Ratio of the median edge to the spacing of cloth below which triangles are too fine.
const FINE: f64 = 0.2;

/// Ratio of the median edge to the spacing of cloth above which triangles are too coarse.
const COARSE: f64 = 5.0;

/// Number of triangles above which a body is round. A box has few, and its long edges are intended.
const ROUND: usize = 200;

/// FaultPlaces where a mesh has faults of one kind.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FaultPlaces {
    /// Number of all places.
    pub count: usize,
    /// First few places, in m.
    pub first: Vec<[f64; 3]>,
}

impl FromIterator<[f64; 3]> for FaultPlaces {
    fn from_iter<I: IntoIterator<Item = [f64; 3]>>(places: I) -> FaultPlaces {
        let mut all = FaultPlaces::default();
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

/// Description of a triangulation, with all that keeps it from being a body.
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
    /// Number of vertices, counting vertices at one position once.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Smallest coordinates, in m.
    pub low: [f64; 3],
    /// Largest coordinates, in m.
    pub high: [f64; 3],
    /// Area, in m².
    pub area: f64,
    /// Enclosed volume, in m³, negative if the surface is inside out.
    pub volume: f64,
    /// Number of parts. Triangles that share an edge belong to one part.
    pub parts: usize,
    /// Holes: closed lines of edges that have a triangle on one side only.
    pub holes: Vec<Hole>,
    /// Edges with more than two triangles.
    pub branching_edges: FaultPlaces,
    /// Edges whose two triangles disagree about the outside.
    pub opposed_edges: FaultPlaces,
    /// Triangles without area.
    pub flat_triangles: FaultPlaces,
    /// Edges that meet a triangle of the mesh, by an exact test.
    pub intersections: FaultPlaces,
    /// Lengths of the edges.
    pub edge_lengths: EdgeLengths,
}

impl MeshInspection {
    /// Inspects `mesh` as [`Mesh`](crate::Mesh) takes it: vertices at one position are one vertex,
    /// and triangles that lose a corner by merging are left out. Triangles that name a vertex that
    /// does not exist are left out too.
    #[must_use]
    pub fn new(mesh: &Triangulation) -> MeshInspection {
        let mut merged = mesh.clone();
        merge_coincident(&mut merged);
        let mesh = &merged;
        let edges = Edges::new(&mesh.triangles);
        let edge_lengths = EdgeLengths::new(mesh, &edges);
        let middle = |[a, b]: [u32; 2]| midpoint(mesh.point(a), mesh.point(b));

        // Flat triangles have an area too, of rounding.
        let areas = mesh
            .triangles
            .iter()
            .map(|t| doubled_area(mesh.corners(*t)).unwrap_or_else(|area| area));
        let flat = mesh.triangles.iter().filter(|t| doubled_area(mesh.corners(**t)).is_err());

        let mut parts = edges.parts(mesh.triangles.len());
        parts.sort_unstable();
        parts.dedup();

        // Volumes about a vertex of the mesh lose few digits.
        let origin = mesh.vertices.first().copied().unwrap_or_default();
        let [low, high] = bounds(mesh.vertices.iter());
        MeshInspection {
            vertices: mesh.vertices.len(),
            triangles: mesh.triangles.len(),
            low,
            high,
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
            flat_triangles: flat.map(|triangle| mesh.point(triangle[0])).collect(),
            intersections: intersections(mesh, &edges, edge_lengths.median).into_iter().collect(),
            edge_lengths,
        }
    }

    /// Returns the size along x, y and z, in m.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        std::array::from_fn(|axis| self.high[axis] - self.low[axis])
    }

    /// Returns whether the triangles are finer than cloth with `spacing`, in m, can resolve.
    #[must_use]
    pub fn is_too_fine(&self, spacing: f64) -> bool {
        let median = self.edge_lengths.median;
        median > 0.0 && median < FINE * spacing
    }

    /// Returns whether the triangles are so large that cloth with `spacing`, in m, shows their
    /// edges. A body with few triangles, such as a box, is never too coarse.
    #[must_use]
    pub fn is_too_coarse(&self, spacing: f64) -> bool {
        self.edge_lengths.median > COARSE * spacing && self.triangles > ROUND
    }

    /// Returns whether every edge has one triangle on each side, and neighbours agree about the
    /// outside.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.holes.is_empty() && self.branching_edges.count == 0 && self.opposed_edges.count == 0
    }

    /// Returns the number of faults for which [`Mesh`](crate::Mesh) refuses the surface: open
    /// edges, edges with more than two triangles, edges on which triangles disagree, and triangles
    /// without area.
    #[must_use]
    pub fn fault_count(&self) -> usize {
        let open: usize = self.holes.iter().map(|hole| hole.vertices.len()).sum();
        open + self.branching_edges.count + self.opposed_edges.count + self.flat_triangles.count
    }

    /// Returns whether this mesh is a worse body than `other`: it has more faults, or equally many
    /// faults and more self-intersections.
    #[must_use]
    pub fn is_worse_than(&self, other: &MeshInspection) -> bool {
        self.badness() > other.badness()
    }

    /// Returns the numbers of faults and of self-intersections.
    fn badness(&self) -> (usize, usize) {
        (self.fault_count(), self.intersections.count)
    }
}

impl EdgeLengths {
    /// Returns the shortest, median and longest length of the `edges` of `mesh`, 0 without edges.
    fn new(mesh: &Triangulation, edges: &Edges) -> EdgeLengths {
        let mut lengths: Vec<f64> = edges
            .iter()
            .map(|(edge, _)| edge.map(|vertex| mesh.point(vertex)))
            .map(|[a, b]| norm(subtract(a, b)))
            .collect();
        lengths.sort_unstable_by(f64::total_cmp);
        EdgeLengths {
            min: lengths.first().copied().unwrap_or(0.0),
            median: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0),
            max: lengths.last().copied().unwrap_or(0.0),
        }
    }
}
