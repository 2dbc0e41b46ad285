//! Closed triangle surfaces with an inside and an outside, and their signed distance.
//!
//! The nearest point comes from the crate `parry3d-f64`; its normal and curvature are taken here
//! from the kind of feature that it lies on.

use std::path::Path;
use std::sync::Arc;

use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TriMesh, TriMeshFlags, TrianglePointLocation};

use super::signed_distance::SignedDistance;
use crate::error::{Error, check};
use crate::mesh_io::{Merged, Triangulation, merge_coincident_vertices, read_mesh};
use crate::vector::{Vector, combine, cross, dot, norm, outer, projection, scale, subtract};

/// Ratio of its volume to the cube of its extent below which a closed surface is empty.
///
/// Rounding leaves about 1e-16 of two sheets back to back; a sheet of paper has 1e-4.
const HOLLOW: f64 = 1e-10;

/// Distance below which the direction to an edge or corner is mostly rounding, in m.
///
/// At 1 m from the origin the direction then has an error of 1e-7; nearer, the mean normal of the
/// faces around replaces it.
const TOUCHING: f64 = 1e-9;

/// Cosine above which a direction is the normal of the face: the point is not beyond the edge.
const UPRIGHT: f64 = 1.0 - 1e-12;

/// A closed triangle surface with an inside and an outside.
///
/// It is checked: every index exists, every coordinate is finite, no triangle is flat, every edge
/// has one triangle on each side, neighbours agree on the outside, the volume is positive. Two
/// parts that lie one in the other, or that intersect each other, are not noticed.
/// Cloning shares the data.
#[derive(Clone)]
pub struct Mesh {
    surface: Arc<TriMesh>,
    /// The first of the vertices as given that became each vertex.
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
    /// Makes a mesh of vertices in m and triangles of three vertex numbers, counter-clockwise from
    /// outside.
    ///
    /// Vertices at the same position are merged, triangles that lose a corner by it are left out,
    /// and a surface that is inside out as a whole is turned
    /// ([`was_inside_out`](Mesh::was_inside_out) says so).
    ///
    /// # Errors
    /// A surface that is open, not manifold, flat or empty.
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Mesh, Error> {
        let Merged { mesh: Triangulation { vertices, mut triangles }, source_vertices } =
            merge_coincident_vertices(vertices, triangles)?;
        check_closed(&vertices, &triangles)?;
        let volume = volume(&vertices, &triangles);
        let extent = (0..3).map(|k| extent(&vertices, k)).fold(0.0, f64::max);
        let solid = volume.abs() > HOLLOW * extent.powi(3);
        if !solid {
            return Err(Error::NoVolume { volume });
        }
        if volume < 0.0 {
            for [_, b, c] in &mut triangles {
                std::mem::swap(b, c);
            }
        }
        let count = vertices.len();
        let points = vertices.iter().map(|v| ParryVector::new(v[0], v[1], v[2])).collect();
        // Without the flag every point would silently count as outside.
        let surface = TriMesh::with_flags(points, triangles, TriMeshFlags::ORIENTED)
            .map_err(|_| Error::EmptyMesh { vertices: count })?;
        Ok(Mesh {
            surface: Arc::new(surface),
            source_vertices: source_vertices.into(),
            was_inside_out: volume < 0.0,
        })
    }

    /// Reads a mesh file and multiplies its coordinates by a scale, in m per unit of the file.
    ///
    /// # Errors
    /// A file that cannot be read, or a surface that [`Mesh::new`] refuses.
    pub fn load(path: impl AsRef<Path>, scale: f64) -> Result<Mesh, Error> {
        check("the scale of the mesh", scale, "positive", scale > 0.0)?;
        let Triangulation { vertices, triangles } = read_mesh(path)?.scaled(scale);
        Mesh::new(&vertices, &triangles)
    }

    /// Whether the triangles as given were inside out.
    #[must_use]
    pub fn was_inside_out(&self) -> bool {
        self.was_inside_out
    }

    /// Positions of the vertices, in m.
    #[must_use]
    pub fn vertices(&self) -> Vec<[f64; 3]> {
        let points = self.surface.vertices().iter();
        points.map(|v| [v.x, v.y, v.z]).collect()
    }

    /// The first of the vertices as given that became each vertex.
    #[must_use]
    pub fn source_vertices(&self) -> &[u32] {
        &self.source_vertices
    }

    /// Vertex numbers of the triangles, counter-clockwise from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.surface.indices()
    }

    /// Returns the distance to the box around the mesh, a lower bound of that to the mesh, in m.
    pub(crate) fn distance_to_box(&self, point: Vector) -> f64 {
        let bounds = self.surface.bvh().root_aabb();
        let (low, high) = (bounds.mins, bounds.maxs);
        let excess = |p: f64, low: f64, high: f64| (low - p).max(p - high).max(0.0);
        norm([
            excess(point[0], low.x, high.x),
            excess(point[1], low.y, high.y),
            excess(point[2], low.z, high.z),
        ])
    }

    /// Returns the signed distance of a point, which must be finite.
    pub(crate) fn signed_distance(&self, point: Vector) -> SignedDistance {
        let query = ParryVector::new(point[0], point[1], point[2]);
        // `solid` would move interior points onto themselves.
        let (nearest, (triangle, location)) =
            self.surface.project_local_point_and_get_location(query, false);
        let corners = self.corners(triangle as usize);
        let face = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
        let face = scale(face, 1.0 / norm(face));
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
        let normal = scale(gap, side / length);
        if dot(normal, face) > UPRIGHT {
            // Straight above a border of the face: a point of a flat part of the surface.
            return flat;
        }
        let round = match edge {
            Some(edge) => {
                let along = subtract(corners[(edge + 1) % 3], corners[edge]);
                let along = scale(along, 1.0 / norm(along));
                combine(&projection(normal), 1.0, &outer(along), -1.0)
            }
            None => projection(normal),
        };
        let distance = side * length;
        SignedDistance { distance, normal, curvature: round.map(|c| c / distance) }
    }

    fn corners(&self, triangle: usize) -> [Vector; 3] {
        self.surface.indices()[triangle].map(|index| {
            let v = self.surface.vertices()[index as usize];
            [v.x, v.y, v.z]
        })
    }

    /// Returns the unit mean normal of the faces around an edge or a corner.
    fn mean_normal(&self, triangle: usize, location: TrianglePointLocation) -> Option<Vector> {
        let normals = self.surface.pseudo_normals()?;
        let mean = match location {
            TrianglePointLocation::OnEdge(edge, _) => {
                normals.edges_pseudo_normal[triangle][edge as usize]
            }
            TrianglePointLocation::OnVertex(corner) => {
                let vertex = self.surface.indices()[triangle][corner as usize];
                normals.vertices_pseudo_normal[vertex as usize]
            }
            _ => return None,
        };
        let mean = [mean.x, mean.y, mean.z];
        let length = norm(mean);
        (length > 0.0).then(|| scale(mean, 1.0 / length))
    }
}

/// Checks that every edge is used once in each direction.
fn check_closed(vertices: &[Vector], triangles: &[[u32; 3]]) -> Result<(), Error> {
    let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * triangles.len());
    for [a, b, c] in triangles {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            edges.push((from.min(to), from.max(to), from < to));
        }
    }
    edges.sort_unstable();
    let middle = |edge: (u32, u32, bool)| -> Vector {
        let [a, b] = [vertices[edge.0 as usize], vertices[edge.1 as usize]];
        std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
    };
    let (mut open, mut bad, mut crowded) = (Vec::new(), Vec::new(), Vec::new());
    for group in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        match group {
            [one] => open.push(*one),
            [one, other] if one.2 != other.2 => {}
            [one, _] => bad.push(*one),
            _ => crowded.push((group[0], group.len())),
        }
    }
    if let Some(&(first, triangles)) = crowded.first() {
        let (edges, place) = (crowded.len(), middle(first));
        return Err(Error::NonManifoldMesh { edges, triangles, place });
    }
    if let Some(&first) = bad.first() {
        return Err(Error::InconsistentOrientation { edges: bad.len(), place: middle(first) });
    }
    if let Some(&first) = open.first() {
        return Err(Error::OpenMesh { edges: open.len(), place: middle(first) });
    }
    Ok(())
}

/// Returns the enclosed volume by the divergence theorem, in m³; about the first vertex, against
/// cancellation.
fn volume(vertices: &[Vector], triangles: &[[u32; 3]]) -> f64 {
    let origin = vertices[0];
    let cones = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|index| subtract(vertices[index as usize], origin));
        dot(a, cross(b, c))
    });
    cones.sum::<f64>() / 6.0
}

/// Returns the extent along an axis, in m.
fn extent(vertices: &[Vector], axis: usize) -> f64 {
    let values = || vertices.iter().map(|v| v[axis]);
    values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
}
