//! Closed triangle surfaces with an inside and an outside, and their signed distance.
//!
//! The crate `parry3d-f64` finds the nearest point. This file derives normal and curvature from the
//! feature of the surface on which the nearest point lies.

use std::path::Path;
use std::sync::Arc;

use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TriMesh, TriMeshFlags, TrianglePointLocation};

use super::signed_distance::SignedDistance;
use crate::error::{Error, check};
use crate::mesh_io::{MergedMesh, Triangulation, merge_coincident_vertices, read_mesh};
use crate::vector::{
    Vector, combine, cross, dot, midpoint, norm, outer, projection, scale, subtract,
};

/// Smallest ratio of a closed surface's volume to the cube of its extent.
///
/// Rounding leaves about 1e-16 of two sheets back to back. A sheet of paper has 1e-4.
const HOLLOW: f64 = 1e-10;

/// Distance below which the direction to an edge or corner is mostly rounding, in m.
///
/// At this distance, 1 m from the origin, the direction has an error of 1e-7. Nearer points take
/// the mean normal of the faces around the edge or corner.
const TOUCHING: f64 = 1e-9;

/// Smallest cosine between a direction and a face's normal at which the point lies over the face.
const UPRIGHT: f64 = 1.0 - 1e-12;

/// A closed triangle surface with an inside and an outside.
///
/// [`Mesh::new`] checks that every index exists, every coordinate is finite, no triangle is flat,
/// every edge has one triangle on each side, neighbours agree about the outside, and the volume is
/// positive. Two parts of which one lies inside the other, and parts that intersect, are not
/// noticed. Clones share the data.
#[derive(Clone)]
pub struct Mesh {
    surface: Arc<TriMesh>,
    /// For each vertex, the number of the first given vertex at its position.
    source_vertices: Arc<[u32]>,
    was_inside_out: bool,
}

impl std::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Mesh")
            .field("vertices", &self.surface.vertices().len())
            .field("triangles", &self.surface.indices().len())
            .finish()
    }
}

impl Mesh {
    /// Returns the mesh with `vertices`, in m, and `triangles` of three vertex numbers each,
    /// counter-clockwise from outside.
    ///
    /// Vertices at one position are merged. Triangles that lose a corner by merging are left out. A
    /// surface that is inside out as a whole is turned; [`was_inside_out`](Mesh::was_inside_out)
    /// tells.
    ///
    /// # Errors
    /// The surface is open, not manifold, flat or empty.
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Mesh, Error> {
        let MergedMesh { mesh: Triangulation { vertices, mut triangles }, source_vertices } =
            merge_coincident_vertices(vertices, triangles)?;
        check_closed(&vertices, &triangles)?;
        let enclosed = volume(&vertices, &triangles);
        let largest_extent = (0..3).map(|k| extent(&vertices, k)).fold(0.0, f64::max);
        let is_solid = enclosed.abs() > HOLLOW * largest_extent.powi(3);
        if !is_solid {
            return Err(Error::NoVolume { volume: enclosed });
        }

        if enclosed < 0.0 {
            for [_, b, c] in &mut triangles {
                std::mem::swap(b, c);
            }
        }

        let count = vertices.len();
        let points = vertices.iter().map(|v| ParryVector::new(v[0], v[1], v[2])).collect();
        // Without the flag, parry counts every point as outside.
        let surface = TriMesh::with_flags(points, triangles, TriMeshFlags::ORIENTED)
            .map_err(|_| Error::EmptyMesh { vertices: count })?;
        Ok(Mesh {
            surface: Arc::new(surface),
            source_vertices: source_vertices.into(),
            was_inside_out: enclosed < 0.0,
        })
    }

    /// Reads the mesh file at `path` and multiplies its coordinates by `scale`, in m per unit of
    /// the file.
    ///
    /// # Errors
    /// The file cannot be read, or [`Mesh::new`] refuses its surface. Or the crate was built
    /// without its feature `mesh-files`.
    pub fn load(path: impl AsRef<Path>, scale: f64) -> Result<Mesh, Error> {
        check("the scale of the mesh", scale, "positive", scale > 0.0)?;
        let Triangulation { vertices, triangles } = read_mesh(path)?.scaled(scale);
        Mesh::new(&vertices, &triangles)
    }

    /// Returns whether the triangles given to [`Mesh::new`] were inside out.
    #[must_use]
    pub fn was_inside_out(&self) -> bool {
        self.was_inside_out
    }

    /// Returns the positions of the vertices, in m.
    #[must_use]
    pub fn vertices(&self) -> Vec<[f64; 3]> {
        let points = self.surface.vertices().iter();
        points.map(|v| [v.x, v.y, v.z]).collect()
    }

    /// Returns, for each vertex, the number of the first vertex given to [`Mesh::new`] at its
    /// position.
    #[must_use]
    pub fn source_vertices(&self) -> &[u32] {
        &self.source_vertices
    }

    /// Returns the vertex numbers of the triangles, counter-clockwise from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.surface.indices()
    }

    /// Returns the distance of `point` from the box around the mesh, in m: a lower bound of its
    /// distance from the mesh.
    pub(crate) fn distance_to_box(&self, point: Vector) -> f64 {
        let bounds = self.surface.bvh().root_aabb();
        let (low, high) = (bounds.mins, bounds.maxs);
        norm([
            distance_to_range(point[0], low.x, high.x),
            distance_to_range(point[1], low.y, high.y),
            distance_to_range(point[2], low.z, high.z),
        ])
    }

    /// Returns the [`SignedDistance`] of `point`, which must be finite.
    pub(crate) fn signed_distance(&self, point: Vector) -> SignedDistance {
        let query = ParryVector::new(point[0], point[1], point[2]);
        // With `solid`, parry would move interior points onto themselves.
        let (nearest, (triangle, location)) =
            self.surface.project_local_point_and_get_location(query, false);

        // Over a face the distance is linear.
        let corners = self.corners(triangle as usize);
        let doubled = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
        let face = scale(doubled, 1.0 / norm(doubled));
        let foot = [nearest.point.x, nearest.point.y, nearest.point.z];
        let gap = subtract(point, foot);
        let length = norm(gap);
        let side = if nearest.is_inside { -1.0 } else { 1.0 };
        let flat = SignedDistance::flat(dot(face, gap), face);
        let edge = match location {
            TrianglePointLocation::OnFace(..) | TrianglePointLocation::OnSolid => return flat,
            TrianglePointLocation::OnEdge(edge, _) => Some(edge as usize),
            TrianglePointLocation::OnVertex(_) => None,
        };

        if length < TOUCHING {
            let normal = self.mean_normal(triangle as usize, location).unwrap_or(face);
            return SignedDistance::flat(side * length, normal);
        }
        // Around an edge the surfaces of equal distance are cylinders, around a corner spheres.
        let normal = scale(gap, side / length);
        if dot(normal, face) > UPRIGHT {
            // The point lies over the border of a flat part of the surface.
            return flat;
        }
        let round = match edge {
            Some(edge) => {
                let span = subtract(corners[(edge + 1) % 3], corners[edge]);
                let along = scale(span, 1.0 / norm(span));
                combine(&projection(normal), 1.0, &outer(along), -1.0)
            }
            None => projection(normal),
        };
        let distance = side * length;
        SignedDistance { distance, normal, curvature: round.map(|c| c / distance) }
    }

    /// Returns the positions of the corners of `triangle`, in m.
    fn corners(&self, triangle: usize) -> [Vector; 3] {
        self.surface.indices()[triangle].map(|index| {
            let v = self.surface.vertices()[index as usize];
            [v.x, v.y, v.z]
        })
    }

    /// Returns the unit mean normal of the faces around the edge or corner at `location` of
    /// `triangle`, or `None` if the normals cancel.
    fn mean_normal(&self, triangle: usize, location: TrianglePointLocation) -> Option<Vector> {
        let normals = self.surface.pseudo_normals()?;
        let sum = match location {
            TrianglePointLocation::OnEdge(edge, _) => {
                normals.edges_pseudo_normal[triangle][edge as usize]
            }
            TrianglePointLocation::OnVertex(corner) => {
                let vertex = self.surface.indices()[triangle][corner as usize];
                normals.vertices_pseudo_normal[vertex as usize]
            }
            _ => return None,
        };
        let mean = [sum.x, sum.y, sum.z];
        let length = norm(mean);
        (length > 0.0).then(|| scale(mean, 1.0 / length))
    }
}

/// Returns the distance of `value` from the range from `low` to `high`, 0 inside.
fn distance_to_range(value: f64, low: f64, high: f64) -> f64 {
    (low - value).max(value - high).max(0.0)
}

/// A triangle's edge: its smaller and its larger vertex number, and whether the triangle runs from
/// the smaller to the larger.
type DirectedEdge = (u32, u32, bool);

/// Checks that the `triangles` use every edge once in each direction.
fn check_closed(vertices: &[Vector], triangles: &[[u32; 3]]) -> Result<(), Error> {
    let mut edges: Vec<DirectedEdge> = Vec::with_capacity(3 * triangles.len());
    for [a, b, c] in triangles {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            edges.push((from.min(to), from.max(to), from < to));
        }
    }
    edges.sort_unstable();

    let (mut open, mut opposed, mut crowded) = (Vec::new(), Vec::new(), Vec::new());
    for group in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        match group {
            [edge] => open.push(*edge),
            [first, second] if first.2 != second.2 => {}
            [edge, _] => opposed.push(*edge),
            _ => crowded.push((group[0], group.len())),
        }
    }

    // Crowded edges come first: they may cause the other faults.
    if let Some(&(first, triangles)) = crowded.first() {
        let (edges, place) = (crowded.len(), edge_middle(vertices, first));
        return Err(Error::NonManifoldMesh { edges, triangles, place });
    }
    if let Some(&first) = opposed.first() {
        let place = edge_middle(vertices, first);
        return Err(Error::InconsistentOrientation { edges: opposed.len(), place });
    }
    if let Some(&first) = open.first() {
        return Err(Error::OpenMesh { edges: open.len(), place: edge_middle(vertices, first) });
    }
    Ok(())
}

/// Returns the middle of `edge`, in m.
fn edge_middle(vertices: &[Vector], edge: DirectedEdge) -> Vector {
    midpoint(vertices[edge.0 as usize], vertices[edge.1 as usize])
}

/// Returns the volume that `triangles` enclose, in m³, by the divergence theorem. The first vertex
/// is the origin, against cancellation.
fn volume(vertices: &[Vector], triangles: &[[u32; 3]]) -> f64 {
    let origin = vertices[0];
    let cones = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|index| subtract(vertices[index as usize], origin));
        dot(a, cross(b, c))
    });
    cones.sum::<f64>() / 6.0
}

/// Returns the extent of `vertices` along `axis`, in m.
fn extent(vertices: &[Vector], axis: usize) -> f64 {
    let highest = vertices.iter().map(|v| v[axis]).fold(f64::MIN, f64::max);
    let lowest = vertices.iter().map(|v| v[axis]).fold(f64::MAX, f64::min);
    highest - lowest
}
