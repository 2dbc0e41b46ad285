//! Primitives of a surface: vertices, edges and triangles, their areas and their order in space.

use super::order::{Order, Primitive, Run};
use super::parts::{SurfaceParts, check_parts};
use super::seam_exemptions::SeamExemptions;
use super::topology::{self, Topology};
use crate::error::Error;
use crate::vector::{at, dot, subtract};

/// Largest extent of a run over the mean length of an edge: four neighbours in a row fit.
const RUN: f64 = 4.0;

/// Vertices, edges and triangles of a surface.
#[derive(Debug, Clone)]
pub(crate) struct Primitives {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) edges: Vec<[u32; 2]>,
    /// Number of the last free edge; none if no edge is free.
    pub(crate) last_free_edge: Option<u32>,
    groups: Vec<u32>,
    pub(crate) free: usize,
    vertex_areas: Vec<f64>,
    edge_areas: Vec<f64>,
    triangle_areas: Vec<f64>,
    edge_lengths_squared: Vec<f64>,
    pub(crate) seams: SeamExemptions,
    pub(crate) edge_order: Order,
    pub(crate) triangle_order: Order,
    /// Seam classes of the vertices of the edge in each slot of its order.
    pub(crate) edge_classes: Vec<[u32; 2]>,
    /// Seam classes of the vertices of the triangle in each slot of its order.
    pub(crate) triangle_classes: Vec<[u32; 3]>,
    pub(crate) vertex_runs: Vec<Run>,
    pub(crate) edge_runs: Vec<Run>,
}

impl Primitives {
    /// Checks the parts of a surface and makes its primitives.
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
        let topology = Topology::new(&triangles);
        let triangle_areas = topology::areas_of_triangles(&rest, &triangles);
        // A body's vertices have the area of their triangles.
        let mut vertex_areas =
            topology::areas_of_vertices(&triangle_areas, &triangles, areas.len());
        let geometric = vertex_areas.clone();
        vertex_areas[..free].copy_from_slice(&areas[..free]);
        let triangle_areas = topology::weighted_areas(&triangle_areas, &triangles, |vertex| {
            // The geometric area is above 0, for each corner has a triangle with an area.
            vertex_areas[vertex] / geometric[vertex]
        });
        let length_squared = |&[a, b]: &[u32; 2]| {
            let edge = subtract(at(&rest, b as usize), at(&rest, a as usize));
            dot(edge, edge)
        };
        let primitive = |vertices: &[u32]| Primitive {
            group: groups[vertices[0] as usize],
            middle: topology::middle(&rest, vertices),
            free: (vertices[0] as usize) < free,
        };
        let vertices: Vec<Primitive> = (0..areas.len() as u32).map(|v| primitive(&[v])).collect();
        let edges: Vec<Primitive> = topology.edges.iter().map(|edge| primitive(edge)).collect();
        let faces: Vec<Primitive> = triangles.iter().map(|corners| primitive(corners)).collect();
        let lengths: Vec<f64> = topology.edges.iter().map(length_squared).collect();
        let extents = run_extents(&edges, &lengths, distances.len());
        let seams = SeamExemptions::new(areas.len(), &seam_pairs, &ties);
        let edge_order = Order::new(&edges);
        let triangle_order = Order::new(&faces);
        Ok(Primitives {
            edge_classes: classes_in_order(&edge_order, &topology.edges, &seams),
            triangle_classes: classes_in_order(&triangle_order, &triangles, &seams),
            edge_order,
            triangle_order,
            last_free_edge: edges.iter().rposition(|edge| edge.free).map(|edge| edge as u32),
            vertex_runs: Run::divide(&vertices, &extents),
            edge_runs: Run::divide(&edges, &extents),
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

    /// Number of vertices.
    pub(crate) fn vertex_count(&self) -> usize {
        self.groups.len()
    }

    /// Group of a vertex, and so of all primitives at it.
    pub(crate) fn group(&self, vertex: u32) -> u32 {
        self.groups[vertex as usize]
    }

    /// Returns whether one of some vertices is free.
    pub(crate) fn is_free(&self, vertices: &[u32]) -> bool {
        vertices.iter().any(|&v| (v as usize) < self.free)
    }

    /// Square of the length of an edge at rest, in m².
    pub(crate) fn edge_length_squared(&self, edge: usize) -> f64 {
        self.edge_lengths_squared[edge]
    }

    /// Median length of the free edges at rest, in m; 0 without any.
    pub(crate) fn median_edge_length(&self) -> f64 {
        let free = self.edges.iter().zip(&self.edge_lengths_squared);
        let free = free.filter(|(edge, _)| self.is_free(&edge[..]));
        let mut squares: Vec<f64> = free.map(|(_, square)| *square).collect();
        squares.sort_by(f64::total_cmp);
        squares.get(squares.len() / 2).map_or(0.0, |square| square.sqrt())
    }

    /// Area of contact of a vertex and a triangle, in m².
    pub(crate) fn vertex_face_area(&self, vertex: usize, triangle: usize) -> f64 {
        let (point, face) = (self.vertex_areas[vertex], self.triangle_areas[triangle]);
        let corner = self.triangles[triangle][0] as usize;
        0.25 * match (vertex < self.free, corner < self.free) {
            (true, true) => point + face.min(point),
            (true, false) => point,
            // However fine a body's mesh, its vertices have no more than their own area.
            (false, _) => face.min(point),
        }
    }

    /// Area of contact of two edges, in m².
    pub(crate) fn edge_edge_area(&self, a: usize, b: usize) -> f64 {
        let smaller = self.edge_areas[a].min(self.edge_areas[b]);
        let free = |edge: usize| self.is_free(&self.edges[edge]);
        if free(a) && free(b) { 0.5 * smaller } else { 0.25 * smaller }
    }
}

/// Returns the largest extent of a run of each group, in m.
fn run_extents(edges: &[Primitive], lengths_squared: &[f64], groups: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); groups];
    for (edge, square) in edges.iter().zip(lengths_squared) {
        let (count, sum) = &mut sums[edge.group as usize];
        *count += 1.0;
        *sum += square.sqrt();
    }
    sums.iter().map(|(count, sum)| if *count > 0.0 { RUN * sum / count } else { 0.0 }).collect()
}

/// Returns the seam classes of the vertices of the primitive in each slot.
fn classes_in_order<const N: usize>(
    order: &Order,
    items: &[[u32; N]],
    seams: &SeamExemptions,
) -> Vec<[u32; N]> {
    let classes = |&item: &u32| items[item as usize].map(|vertex| seams.class(vertex));
    order.items.iter().map(classes).collect()
}
