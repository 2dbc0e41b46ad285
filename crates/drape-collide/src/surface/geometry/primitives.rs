//! Primitives of a surface: vertices, edges and triangles, their areas and their order in space.

use super::order::{Primitive, PrimitiveRun, SpatialOrder};
use super::parts::{SurfaceParts, check_parts};
use super::seam_exemptions::SeamExemptions;
use super::topology::{self, TriangleEdges};
use crate::error::Error;
use crate::vector::{at, dot, subtract};

/// Largest extent of a run over the mean length of an edge. Four neighbours in a row fit.
const RUN: f64 = 4.0;

/// Vertices, edges and triangles of a surface.
#[derive(Debug, Clone)]
pub(crate) struct Primitives {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) edges: Vec<[u32; 2]>,
    /// Number of the last free edge, `None` if no edge is free.
    pub(crate) last_free_edge: Option<u32>,
    groups: Vec<u32>,
    pub(crate) free: usize,
    vertex_areas: Vec<f64>,
    edge_areas: Vec<f64>,
    triangle_areas: Vec<f64>,
    edge_lengths_squared: Vec<f64>,
    pub(crate) seams: SeamExemptions,
    pub(crate) edge_order: SpatialOrder,
    pub(crate) triangle_order: SpatialOrder,
    /// Seam classes of the vertices of the edge in each slot of its order.
    pub(crate) edge_classes: Vec<[u32; 2]>,
    /// Seam classes of the vertices of the triangle in each slot of its order.
    pub(crate) triangle_classes: Vec<[u32; 3]>,
    pub(crate) vertex_runs: Vec<PrimitiveRun>,
    pub(crate) edge_runs: Vec<PrimitiveRun>,
}

impl Primitives {
    /// Checks `parts` and returns their primitives.
    pub(crate) fn new(parts: SurfaceParts) -> Result<Primitives, Error> {
        check_parts(&parts)?;
        let SurfaceParts {
            rest_positions: rest,
            triangles,
            areas,
            groups,
            distances,
            free_vertices: free,
            seam_pairs,
            ties,
        } = parts;
        let topology = TriangleEdges::new(&triangles);

        // A vertex of a body has the area of its triangles. The geometric area is above 0, because
        // each corner has a triangle with an area.
        let geometric_triangle_areas = topology::areas_of_triangles(&rest, &triangles);
        let geometric =
            topology::areas_of_vertices(&geometric_triangle_areas, &triangles, areas.len());
        let mut vertex_areas = geometric.clone();
        vertex_areas[..free].copy_from_slice(&areas[..free]);
        let triangle_areas =
            topology::weighted_areas(&geometric_triangle_areas, &triangles, |vertex| {
                vertex_areas[vertex] / geometric[vertex]
            });

        // Groups and middles decide about the order in space and about runs.
        let primitive = |vertices: &[u32]| Primitive {
            group: groups[vertices[0] as usize],
            middle: topology::middle(&rest, vertices),
            free: (vertices[0] as usize) < free,
        };
        let vertices: Vec<Primitive> = (0..areas.len() as u32).map(|v| primitive(&[v])).collect();
        let edges: Vec<Primitive> = topology.edges.iter().map(|edge| primitive(edge)).collect();
        let faces: Vec<Primitive> = triangles.iter().map(|corners| primitive(corners)).collect();
        let lengths: Vec<f64> = topology
            .edges
            .iter()
            .map(|&[a, b]| {
                let edge = subtract(at(&rest, b as usize), at(&rest, a as usize));
                dot(edge, edge)
            })
            .collect();
        let extents = run_extents(&edges, &lengths, distances.len());

        let seams = SeamExemptions::new(areas.len(), &seam_pairs, &ties);
        let edge_order = SpatialOrder::new(&edges);
        let triangle_order = SpatialOrder::new(&faces);
        Ok(Primitives {
            edge_classes: classes_in_order(&edge_order, &topology.edges, &seams),
            triangle_classes: classes_in_order(&triangle_order, &triangles, &seams),
            edge_order,
            triangle_order,
            last_free_edge: edges.iter().rposition(|edge| edge.free).map(|edge| edge as u32),
            vertex_runs: PrimitiveRun::divide(&vertices, &extents),
            edge_runs: PrimitiveRun::divide(&edges, &extents),
            edge_lengths_squared: lengths,
            edge_areas: topology.areas_of_edges(&triangle_areas),
            seams,
            edges: topology.edges,
            vertex_areas,
            triangle_areas,
            triangles,
            groups,
            free,
        })
    }

    /// Returns the number of vertices.
    pub(crate) fn vertex_count(&self) -> usize {
        self.groups.len()
    }

    /// Returns the group of `vertex`. All primitives with this vertex belong to the group.
    pub(crate) fn group(&self, vertex: u32) -> u32 {
        self.groups[vertex as usize]
    }

    /// Returns whether one of `vertices` is free.
    pub(crate) fn is_free(&self, vertices: &[u32]) -> bool {
        vertices.iter().any(|&v| (v as usize) < self.free)
    }

    /// Returns the squared length of `edge` at rest, in m².
    pub(crate) fn edge_length_squared(&self, edge: usize) -> f64 {
        self.edge_lengths_squared[edge]
    }

    /// Returns the median length of the free edges at rest, in m, or 0 without free edges.
    pub(crate) fn median_edge_length(&self) -> f64 {
        let edges = self.edges.iter().zip(&self.edge_lengths_squared);
        let mut squares: Vec<f64> =
            edges.filter(|(edge, _)| self.is_free(&edge[..])).map(|(_, square)| *square).collect();
        squares.sort_by(f64::total_cmp);
        squares.get(squares.len() / 2).map_or(0.0, |square| square.sqrt())
    }

    /// Returns the area of contact of `vertex` and `triangle`, in m².
    pub(crate) fn vertex_face_area(&self, vertex: usize, triangle: usize) -> f64 {
        let (point, face) = (self.vertex_areas[vertex], self.triangle_areas[triangle]);
        let corner = self.triangles[triangle][0] as usize;
        0.25 * match (vertex < self.free, corner < self.free) {
            (true, true) => point + face.min(point),
            (true, false) => point,
            // However fine a body's mesh is, its vertices count at most with their area.
            (false, _) => face.min(point),
        }
    }

    /// Returns the area of contact of the edges `a` and `b`, in m².
    pub(crate) fn edge_edge_area(&self, a: usize, b: usize) -> f64 {
        let smaller = self.edge_areas[a].min(self.edge_areas[b]);
        let both_free = [a, b].iter().all(|&edge| self.is_free(&self.edges[edge]));
        if both_free { 0.5 * smaller } else { 0.25 * smaller }
    }
}

/// Returns the largest extent of a run in each of `group_count` groups, in m.
fn run_extents(edges: &[Primitive], lengths_squared: &[f64], group_count: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); group_count];
    for (edge, square) in edges.iter().zip(lengths_squared) {
        let (count, sum) = &mut sums[edge.group as usize];
        *count += 1.0;
        *sum += square.sqrt();
    }
    sums.iter().map(|(count, sum)| if *count > 0.0 { RUN * sum / count } else { 0.0 }).collect()
}

/// Returns the seam classes of the vertices of the primitive in each slot of `order`.
fn classes_in_order<const N: usize>(
    order: &SpatialOrder,
    items: &[[u32; N]],
    seams: &SeamExemptions,
) -> Vec<[u32; N]> {
    order.items.iter().map(|&item| items[item as usize].map(|vertex| seams.class(vertex))).collect()
}
