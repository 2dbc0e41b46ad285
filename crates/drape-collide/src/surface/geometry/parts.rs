//! Parts of a surface as a caller gives them, and their checks.

use crate::error::{Error, check, check_positions};
use crate::mesh_io::doubled_area;
use crate::vector::at;

/// Distances of contact: of a pair of primitives, or half distances of a group.
///
/// A pair of two groups has the sum of both half distances. The primitives of a pair repel each
/// other below the activation distance `$\hat d$` and stay above the minimum separation `$\xi$`
/// \[Li21\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactDistances {
    /// Activation distance `$\hat d$`, in m.
    pub activation_distance: f64,
    /// Minimum separation `$\xi$`, in m, below the activation distance.
    pub min_separation: f64,
}

impl ContactDistances {
    /// Returns the range of the barrier, `$\hat d - \xi$`, in m.
    pub(crate) fn range(self) -> f64 {
        self.activation_distance - self.min_separation
    }

    /// Returns the smaller activation distance and the smaller minimum separation of `self` and
    /// `other`.
    pub(crate) fn least(self, other: ContactDistances) -> ContactDistances {
        ContactDistances {
            activation_distance: self.activation_distance.min(other.activation_distance),
            min_separation: self.min_separation.min(other.min_separation),
        }
    }
}

/// Parts of a [`Surface`](crate::Surface): vertices, cloth first, and triangles.
///
/// [`from_meshes`](SurfaceParts::from_meshes) makes the parts of meshes that have positions and
/// triangles alone. A vertex without a triangle is a loose point, which has contact with triangles
/// like a vertex of cloth. Points have no contact with points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceParts {
    /// Three coordinates per vertex at rest, in m. Cloth takes them from its flat panel.
    ///
    /// Distances at rest count only within a group, so groups may lie over each other.
    pub rest_positions: Vec<f64>,
    /// Vertices of each triangle, all of one group.
    pub triangles: Vec<[u32; 3]>,
    /// Lumped area of cloth at each vertex, in m², such as a third of its triangles. The force on a
    /// point is in proportion to its area. Entries of bodies must be there and are not used.
    pub areas: Vec<f64>,
    /// Group of each vertex, from 0: a panel or a body.
    pub groups: Vec<u32>,
    /// Half distances of each group. Their number is the number of groups.
    pub distances: Vec<ContactDistances>,
    /// Number of free vertices, which come first. The others belong to bodies and move as
    /// prescribed.
    ///
    /// Pairs without a free vertex are left out: bodies do not meet bodies. Their motion is given,
    /// so no force could part them, and a step filter between two bodies would stop all bodies at
    /// once. [`earliest_impact`](crate::earliest_impact) and
    /// [`mesh_distance`](crate::mesh_distance) say whether and when bodies meet. Meshes that shall
    /// meet each other are free, with a group each. A surface without a free vertex is refused.
    pub free_vertices: usize,
    /// Pairs of vertices that a seam joins. Once the seam is closed, primitives that share a vertex
    /// through such pairs are exempt from contact.
    pub seam_pairs: Vec<[u32; 2]>,
    /// Vertices that a seam ties to a point between two others: the tied vertex, then these two.
    /// Once the seam is closed, the tied vertex is exempt from contact with primitives that have
    /// both.
    pub ties: Vec<[u32; 3]>,
}

/// Checks lengths, indices and ranges of `parts`.
pub(super) fn check_parts(parts: &SurfaceParts) -> Result<(), Error> {
    let vertices = parts.areas.len();
    for (what, found, needed) in [
        ("rest coordinates", parts.rest_positions.len(), 3 * vertices),
        ("groups", parts.groups.len(), vertices),
    ] {
        if found != needed {
            return Err(Error::WrongLength { what, found, needed });
        }
    }
    let free = parts.free_vertices as f64;
    check("the number of free vertices", free, "at most all", parts.free_vertices <= vertices)?;
    if parts.free_vertices == 0 {
        return Err(Error::NothingFree { vertices });
    }
    check_positions("rest position of vertex", &parts.rest_positions)?;
    check_distances(&parts.distances)?;
    for (vertex, &group) in parts.groups.iter().enumerate() {
        if group as usize >= parts.distances.len() {
            return Err(Error::MissingGroup { vertex, group, groups: parts.distances.len() });
        }
    }
    if let Some(particle) = parts.areas.iter().position(|area| !area.is_finite() || *area < 0.0) {
        return Err(Error::InvalidArea { particle, area: parts.areas[particle] });
    }

    // Indices are checked before positions at them are read.
    let mut sewn = parts.seam_pairs.iter().flatten().chain(parts.ties.iter().flatten());
    if let Some(&index) = sewn.find(|vertex| **vertex as usize >= vertices) {
        return Err(Error::MissingSeamVertex { index, vertices });
    }
    for (triangle, corners) in parts.triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|vertex| **vertex as usize >= vertices) {
            return Err(Error::MissingVertex { triangle, index, vertices });
        }
        check_triangle(parts, triangle)?;
    }
    Ok(())
}

/// Checks the half `distances` of all groups.
fn check_distances(distances: &[ContactDistances]) -> Result<(), Error> {
    for (group, distances) in distances.iter().enumerate() {
        let ContactDistances { activation_distance, min_separation } = *distances;
        check(
            format!("the activation distance of group {group} (m)"),
            activation_distance,
            "above 0",
            activation_distance > 0.0,
        )?;
        let what = format!("the minimum separation of group {group} (m)");
        check(
            what,
            min_separation,
            "above 0 and below its activation distance",
            min_separation > 0.0 && min_separation < activation_distance,
        )?;
    }
    Ok(())
}

/// Checks the corners and the area of `triangle`, a number in [`SurfaceParts::triangles`].
fn check_triangle(parts: &SurfaceParts, triangle: usize) -> Result<(), Error> {
    let corners = parts.triangles[triangle];
    let [a, b, c] = corners;
    if a == b || b == c || c == a {
        return Err(Error::RepeatedVertex { triangle, corners });
    }
    let owner = |v: u32| (parts.groups[v as usize], (v as usize) < parts.free_vertices);
    if owner(a) != owner(b) || owner(b) != owner(c) {
        return Err(Error::MixedTriangle { triangle, corners });
    }
    let points = corners.map(|v| at(&parts.rest_positions, v as usize));
    match doubled_area(points) {
        Ok(_) => Ok(()),
        Err(area) => Err(Error::FlatTriangle { triangle, place: points[0], area }),
    }
}
