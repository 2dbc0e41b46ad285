use crate::error::{Error, check_place};
use crate::proximity::SignedDistance;
use crate::vector::{Vector, across, combine, cross, dot, norm, outer, scale, subtract};
use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TriMesh, TriMeshFlags, TrianglePointLocation};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A triangle counts as flat below this ratio of twice its area to its longest edge squared.
///
/// Rounding leaves about 1e-16 of exactly collinear corners; a sliver of 1 m by 1 µm has 1e-6.
pub(crate) const FLAT: f64 = 1e-12;

/// A closed surface counts as empty below this ratio of its volume to its extent cubed.
///
/// Rounding leaves about 1e-16 of two sheets back to back; a sheet of paper has 1e-4.
const HOLLOW: f64 = 1e-10;

/// Distance below which the direction to an edge or corner is mostly rounding, in m.
///
/// At 1 m from the origin the direction then has an error of 1e-7; nearer, the mean normal of the
/// faces around takes its place.
const TOUCHING: f64 = 1e-9;

/// Cosine above which a direction is the normal of the face: the point is not beyond the edge.
const UPRIGHT: f64 = 1.0 - 1e-12;

/// A closed triangle surface with an inside and an outside.
///
/// It has been checked: every index exists, every coordinate is finite, no triangle is flat, every
/// edge has one triangle on each side, neighbours agree on the outside, the volume is positive.
/// Two parts that lie one in the other, or that pass through each other, are not noticed.
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
    /// A mesh of vertices in m and triangles of three vertex numbers, counter-clockwise from
    /// outside.
    ///
    /// Vertices at the very same place become one, triangles that lose a corner by it are left
    /// out, and a surface that is inside out as a whole is turned
    /// ([`was_inside_out`](Mesh::was_inside_out) tells).
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Mesh, Error> {
        let ((vertices, mut triangles), source_vertices) = welded(vertices, triangles)?;
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

    /// Whether the triangles as given had their outside inside.
    pub fn was_inside_out(&self) -> bool {
        self.was_inside_out
    }

    /// The vertices, in m.
    pub fn vertices(&self) -> Vec<[f64; 3]> {
        let points = self.surface.vertices().iter();
        points.map(|v| [v.x, v.y, v.z]).collect()
    }

    /// The first of the vertices as given that became each vertex.
    pub fn source_vertices(&self) -> &[u32] {
        &self.source_vertices
    }

    /// The triangles, counter-clockwise from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.surface.indices()
    }

    /// Distance to the box around the mesh, a lower bound of the distance to the mesh.
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

    /// The nearest point of the whole surface; the point must be finite.
    pub(crate) fn signed_distance(&self, point: Vector) -> SignedDistance {
        let query = ParryVector::new(point[0], point[1], point[2]);
        // `solid` would move interior points onto themselves.
        let (projection, (triangle, location)) =
            self.surface.project_local_point_and_get_location(query, false);
        let corners = self.corners(triangle as usize);
        let face = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
        let face = scale(face, 1.0 / norm(face));
        let foot = [projection.point.x, projection.point.y, projection.point.z];
        let gap = subtract(point, foot);
        let length = norm(gap);
        let side = if projection.is_inside { -1.0 } else { 1.0 };
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
                combine(&across(normal), 1.0, &outer(along), -1.0)
            }
            None => across(normal),
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

    /// Unit mean normal of the faces around an edge or a corner.
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

/// Vertices and triangles.
pub(crate) type Surface = (Vec<Vector>, Vec<[u32; 3]>);

/// The surface with one vertex for those at the very same place and without triangles that lost a
/// corner by it.
pub(crate) fn weld(vertices: &[Vector], triangles: &[[u32; 3]]) -> Result<Surface, Error> {
    welded(vertices, triangles).map(|(surface, _)| surface)
}

/// The same with the first of the vertices as given that became each.
fn welded(vertices: &[Vector], triangles: &[[u32; 3]]) -> Result<(Surface, Vec<u32>), Error> {
    let mut number_at = BTreeMap::new();
    let mut kept = Vec::new();
    let mut source_vertices = Vec::new();
    let mut faces = Vec::with_capacity(triangles.len());
    for (t, triangle) in triangles.iter().enumerate() {
        let mut face = [0; 3];
        for (corner, &index) in face.iter_mut().zip(triangle) {
            let Some(&place) = vertices.get(index as usize) else {
                return Err(Error::MissingVertex { triangle: t, index, vertices: vertices.len() });
            };
            check_place(|| format!("vertex {index} of the mesh"), place)?;
            // Adding zero makes -0 the same place as 0.
            let key = place.map(|value| (value + 0.0).to_bits());
            *corner = *number_at.entry(key).or_insert_with(|| {
                kept.push(place);
                source_vertices.push(index);
                kept.len() as u32 - 1
            });
        }
        let [a, b, c] = face.map(|index| kept[index as usize]);
        if face[0] == face[1] || face[1] == face[2] || face[2] == face[0] {
            continue;
        }
        let sides = [subtract(b, a), subtract(c, b), subtract(a, c)];
        let area = norm(cross(sides[0], sides[1]));
        let longest = sides.iter().map(|s| dot(*s, *s)).fold(0.0, f64::max);
        let proper = area > FLAT * longest;
        if !proper {
            return Err(Error::FlatTriangle { triangle: t, place: a, area });
        }
        faces.push(face);
    }
    if faces.is_empty() {
        return Err(Error::EmptyMesh { vertices: vertices.len() });
    }
    Ok(((kept, faces), source_vertices))
}

/// Every edge must be run through once in each direction.
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

/// Enclosed volume by the divergence theorem, seen from the first vertex against cancellation.
fn volume(vertices: &[Vector], triangles: &[[u32; 3]]) -> f64 {
    let origin = vertices[0];
    let cones = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|index| subtract(vertices[index as usize], origin));
        dot(a, cross(b, c))
    });
    cones.sum::<f64>() / 6.0
}

fn extent(vertices: &[Vector], axis: usize) -> f64 {
    let values = || vertices.iter().map(|v| v[axis]);
    values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
}
