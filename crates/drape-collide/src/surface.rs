use crate::detector::{Close, close_at_rest};
use crate::error::{Error, check, check_places};
use crate::order::{Entry, Order, Run};
use crate::pinch::Grip;
use crate::sewn::Sewn;
use crate::topology::{self, Topology};
use crate::vector::{at, dot, subtract};

/// Half of the distances at which a surface touches.
///
/// A pair of primitives of two groups has the sum of both: it pushes below the activation_distance `$r$` and is
/// kept above the min_separation `$\xi$`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactDistances {
    /// Half of the distance `$r$` below which two such surfaces push each other, in m.
    pub activation_distance: f64,
    /// Half of the distance `$\xi$` that two such surfaces always keep, in m; below the activation_distance.
    pub min_separation: f64,
}

/// What a [`Surface`] is made of: `n` vertices, of which the first `free` are cloth.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceParts {
    /// Three coordinates per vertex at rest, in m; of cloth, its flat panel.
    ///
    /// Distances at rest are taken within a group only, so groups may lie over each other.
    pub rest_positions: Vec<f64>,
    /// Three vertices each, all of one group.
    pub triangles: Vec<[u32; 3]>,
    /// Area of cloth that each vertex stands for, in m²; that of a body's vertex is not used.
    pub areas: Vec<f64>,
    /// Which skin each vertex has; a panel or a body is a group.
    pub groups: Vec<u32>,
    /// One per group.
    pub distances: Vec<ContactDistances>,
    /// The vertices below this number move freely; those from it on belong to bodies and move as
    /// prescribed. CandidatePairs without a free vertex are never made.
    pub free_vertices: usize,
    /// CandidatePairs of vertices that are sewn together: primitives that share a vertex through them do
    /// not touch.
    pub seam_pairs: Vec<[u32; 2]>,
    /// Vertices that are sewn to a place between two others, and these: such a vertex does not touch primitives with
    /// both.
    pub ties: Vec<[u32; 3]>,
}

/// The surface of all cloth and all bodies: everything about contact that never changes.
///
/// It has been checked, and holds edges, shares of area, the order of the primitives in space, and
/// the pairs that lie close at rest.
#[derive(Debug, Clone)]
pub struct Surface {
    triangles: Vec<[u32; 3]>,
    edges: Vec<[u32; 2]>,
    group: Vec<u32>,
    distances: Vec<ContactDistances>,
    free: usize,
    vertex_areas: Vec<f64>,
    edge_areas: Vec<f64>,
    triangle_areas: Vec<f64>,
    edge_lengths_squared: Vec<f64>,
    pub(crate) sewn: Sewn,
    pub(crate) edge_order: Order,
    pub(crate) triangle_order: Order,
    /// The classes of the vertices of the edge or the triangle in each slot of its order.
    pub(crate) edge_classes: Vec<[u32; 2]>,
    pub(crate) triangle_classes: Vec<[u32; 3]>,
    pub(crate) vertex_runs: Vec<Run>,
    pub(crate) edge_runs: Vec<Run>,
    pub(crate) close: Vec<Close>,
    /// How each free vertex meets bodies; empty if all do as usual.
    pub(crate) grips: Vec<Grip>,
    /// Part of all distances that is kept; see [`SurfaceContact::grow`](crate::SurfaceContact::grow).
    pub(crate) grown: f64,
}

impl Surface {
    /// A surface of checked parts.
    ///
    /// # Errors
    ///
    /// If a list has the wrong length, an index is out of range, a coordinate is not finite or
    /// beyond 1000 km, a triangle has no area, names a vertex twice or spans two groups, an area is
    /// negative, a skin is not positive or its min_separation not below its activation_distance, or two primitives
    /// of one group that share no vertex touch at rest.
    pub fn new(parts: SurfaceParts) -> Result<Surface, Error> {
        check_parts(&parts)?;
        let SurfaceParts {
            rest_positions: rest,
            triangles,
            areas,
            groups: group,
            distances,
            free_vertices: free,
            seam_pairs,
            ties,
        } = parts;
        let topology = Topology::new(&triangles);
        let triangle_areas = topology::areas_of_triangles(&rest, &triangles);
        // A body's vertices stand for the area of their triangles.
        let mut vertex_areas =
            topology::areas_of_vertices(&triangle_areas, &triangles, areas.len());
        let geometric = vertex_areas.clone();
        vertex_areas[..free].copy_from_slice(&areas[..free]);
        let triangle_areas = topology::shares(&triangle_areas, &triangles, |vertex| {
            // The geometric area is above 0, for each corner has a triangle with an area.
            vertex_areas[vertex] / geometric[vertex]
        });
        let length_squared = |&[a, b]: &[u32; 2]| {
            let edge = subtract(at(&rest, b as usize), at(&rest, a as usize));
            dot(edge, edge)
        };
        let entry = |vertices: &[u32]| Entry {
            group: group[vertices[0] as usize],
            place: topology::middle(&rest, vertices),
            free: (vertices[0] as usize) < free,
        };
        let vertices: Vec<Entry> = (0..areas.len() as u32).map(|v| entry(&[v])).collect();
        let edges: Vec<Entry> = topology.edges.iter().map(|edge| entry(edge)).collect();
        let faces: Vec<Entry> = triangles.iter().map(|triangle| entry(triangle)).collect();
        let lengths: Vec<f64> = topology.edges.iter().map(length_squared).collect();
        let sizes = run_sizes(&edges, &lengths, distances.len());
        let sewn = Sewn::new(areas.len(), &seam_pairs, &ties);
        let edge_order = Order::new(&edges);
        let triangle_order = Order::new(&faces);
        let mut surface = Surface {
            edge_classes: classes_of(&edge_order, &topology.edges, &sewn),
            triangle_classes: classes_of(&triangle_order, &triangles, &sewn),
            edge_order,
            triangle_order,
            vertex_runs: Run::divide(&vertices, &sizes),
            edge_runs: Run::divide(&edges, &sizes),
            edge_lengths_squared: lengths,
            edge_areas: topology.areas_of_edges(&triangle_areas),
            sewn,
            edges: topology.edges,
            vertex_areas,
            triangle_areas,
            triangles,
            group,
            distances,
            free,
            close: Vec::new(),
            grips: Vec::new(),
            grown: 1.0,
        };
        surface.close = close_at_rest(&surface, &rest)?;
        Ok(surface)
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.group.len()
    }

    /// Number of free vertices, which come first.
    pub fn free_count(&self) -> usize {
        self.free
    }

    /// Three vertices each, as given.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Two vertices each, the lower first, sorted.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// Median length of the free edges at rest, in m; 0 without any.
    ///
    /// The edges of bodies do not count: those of a rounded box may be a hundred times shorter.
    pub fn median_edge_length(&self) -> f64 {
        let free = self.edges.iter().zip(&self.edge_lengths_squared);
        let free = free.filter(|(edge, _)| self.is_free(&edge[..]));
        let mut squares: Vec<f64> = free.map(|(_, square)| *square).collect();
        squares.sort_by(f64::total_cmp);
        squares.get(squares.len() / 2).map_or(0.0, |square| square.sqrt())
    }

    /// Half distances per group.
    pub fn group_distances(&self) -> &[ContactDistances] {
        &self.distances
    }

    /// Group of a vertex, and so of all primitives at it.
    pub fn group(&self, vertex: u32) -> u32 {
        self.group[vertex as usize]
    }

    /// Reach and min_separation of a pair of vertices or of primitives at them, in m, without regard
    /// to their distance at rest.
    pub fn pair_distances(&self, a: u32, b: u32) -> ContactDistances {
        let [a, b] = [a, b].map(|v| self.distances[self.group(v) as usize]);
        let (activation_distance, min_separation) =
            (a.activation_distance + b.activation_distance, a.min_separation + b.min_separation);
        ContactDistances {
            activation_distance: self.grown * activation_distance,
            min_separation: self.grown * min_separation,
        }
    }

    pub(crate) fn check_positions(&self, positions: &[f64]) -> Result<(), Error> {
        let needed = 3 * self.vertex_count();
        if positions.len() != needed {
            return Err(Error::WrongLength { what: "positions", found: positions.len(), needed });
        }
        check_places("vertex", positions)
    }

    pub(crate) fn is_free(&self, vertices: &[u32]) -> bool {
        vertices.iter().any(|&v| (v as usize) < self.free)
    }

    pub(crate) fn edge_length_squared(&self, edge: usize) -> f64 {
        self.edge_lengths_squared[edge]
    }

    /// Area that the contact of a vertex and a triangle stands for, in m².
    pub(crate) fn vertex_face_area(&self, vertex: usize, triangle: usize) -> f64 {
        let (point, face) = (self.vertex_areas[vertex], self.triangle_areas[triangle]);
        let corner = self.triangles[triangle][0] as usize;
        0.25 * match (vertex < self.free, corner < self.free) {
            (true, true) => point + face.min(point),
            (true, false) => point,
            // However fine a body's mesh, its vertices push no more than their own area.
            (false, _) => face.min(point),
        }
    }

    /// Area that the contact of two edges stands for, in m².
    pub(crate) fn edge_edge_area(&self, a: usize, b: usize) -> f64 {
        let smaller = self.edge_areas[a].min(self.edge_areas[b]);
        let free = |edge: usize| self.is_free(&self.edges[edge]);
        if free(a) && free(b) { 0.5 * smaller } else { 0.25 * smaller }
    }
}

/// Edges of a mean length that a run may span: four neighbours in a row do.
const RUN: f64 = 4.0;

/// How large runs of each group may be, in m.
fn run_sizes(edges: &[Entry], lengths_squared: &[f64], groups: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); groups];
    for (edge, square) in edges.iter().zip(lengths_squared) {
        let (count, sum) = &mut sums[edge.group as usize];
        *count += 1.0;
        *sum += square.sqrt();
    }
    sums.iter().map(|(count, sum)| if *count > 0.0 { RUN * sum / count } else { 0.0 }).collect()
}

/// The classes of the vertices of the primitive in each slot.
fn classes_of<const N: usize>(order: &Order, items: &[[u32; N]], sewn: &Sewn) -> Vec<[u32; N]> {
    let classes = |&item: &u32| items[item as usize].map(|vertex| sewn.class(vertex));
    order.items.iter().map(classes).collect()
}

fn check_parts(parts: &SurfaceParts) -> Result<(), Error> {
    let vertices = parts.areas.len();
    let length = |what, found: usize, needed: usize| {
        if found == needed {
            return Ok(());
        }
        Err(Error::WrongLength { what, found, needed })
    };
    length("rest coordinates", parts.rest_positions.len(), 3 * vertices)?;
    length("groups", parts.groups.len(), vertices)?;
    let free = parts.free_vertices as f64;
    check("the number of free vertices", free, "at most all", parts.free_vertices <= vertices)?;
    check_places("rest position of vertex", &parts.rest_positions)?;
    for (k, skin) in parts.distances.iter().enumerate() {
        let ContactDistances { activation_distance, min_separation } = *skin;
        check(
            format!("the activation distance of group {k} (m)"),
            activation_distance,
            "above 0",
            activation_distance > 0.0,
        )?;
        let what = format!("the minimum separation of group {k} (m)");
        check(
            what,
            min_separation,
            "above 0 and below its activation distance",
            min_separation > 0.0 && min_separation < activation_distance,
        )?;
    }
    for (vertex, &group) in parts.groups.iter().enumerate() {
        if group as usize >= parts.distances.len() {
            return Err(Error::MissingGroup { vertex, group, groups: parts.distances.len() });
        }
    }
    let bad = |(_, area): &(usize, &f64)| !area.is_finite() || **area < 0.0;
    if let Some((particle, &area)) = parts.areas.iter().enumerate().find(bad) {
        return Err(Error::InvalidArea { particle, area });
    }
    let out = |vertex: &&u32| **vertex as usize >= vertices;
    let mut sewn = parts.seam_pairs.iter().flatten().chain(parts.ties.iter().flatten());
    if let Some(&index) = sewn.find(out) {
        return Err(Error::MissingSeamVertex { index, vertices });
    }
    for (triangle, corners) in parts.triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(out) {
            return Err(Error::MissingVertex { triangle, index, vertices });
        }
        check_triangle(parts, triangle)?;
    }
    Ok(())
}

fn check_triangle(parts: &SurfaceParts, triangle: usize) -> Result<(), Error> {
    let corners = parts.triangles[triangle];
    let [a, b, c] = corners;
    if a == b || b == c || c == a {
        return Err(Error::RepeatedVertex { triangle, corners });
    }
    let kind = |v: u32| (parts.groups[v as usize], (v as usize) < parts.free_vertices);
    if kind(a) != kind(b) || kind(b) != kind(c) {
        return Err(Error::MixedTriangle { triangle, corners });
    }
    let places = corners.map(|v| at(&parts.rest_positions, v as usize));
    match topology::doubled_area(places) {
        Ok(_) => Ok(()),
        Err(area) => Err(Error::FlatTriangle { triangle, place: places[0], area }),
    }
}
