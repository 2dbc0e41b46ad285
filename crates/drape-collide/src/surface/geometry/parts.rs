//! Parts that a surface is made of, and their checks.

use crate::error::{Error, check, check_positions};
use crate::mesh_io::doubled_area;
use crate::vector::at;

/// Distances of contact: of a pair of primitives, or half of them of a group.
///
/// A pair of two groups has the sum of both. Its primitives repel each other below the activation
/// distance `$\hat d$` and are kept above the minimum separation `$\xi$` \[Li21\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactDistances {
    /// Activation distance `$\hat d$`, in m.
    pub activation_distance: f64,
    /// Minimum separation `$\xi$`, in m; below the activation distance.
    pub min_separation: f64,
}

impl ContactDistances {
    /// Returns the range of the barrier `$\hat d - \xi$`, in m.
    pub(crate) fn range(self) -> f64 {
        self.activation_distance - self.min_separation
    }

    /// Returns the smaller of two activation distances with the smaller of two minimum separations.
    pub(crate) fn least(self, other: ContactDistances) -> ContactDistances {
        ContactDistances {
            activation_distance: self.activation_distance.min(other.activation_distance),
            min_separation: self.min_separation.min(other.min_separation),
        }
    }
}

/// Parts of a [`Surface`](crate::Surface): vertices, of which the first are cloth, and triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceParts {
    /// Three coordinates per vertex at rest, in m; of cloth, those of its flat panel.
    ///
    /// Distances at rest matter within a group only, so groups may lie over each other.
    pub rest_positions: Vec<f64>,
    /// Vertices of each triangle, all of one group.
    pub triangles: Vec<[u32; 3]>,
    /// Lumped area of cloth of each vertex, in m²; that of a body's vertex is not used.
    pub areas: Vec<f64>,
    /// Group of each vertex: a panel or a body.
    pub groups: Vec<u32>,
    /// Half distances of each group.
    pub distances: Vec<ContactDistances>,
    /// Number of free vertices, which come first; the others belong to bodies and move as
    /// prescribed. Pairs without a free vertex are left out.
    pub free_vertices: usize,
    /// Vertices that a seam joins in pairs: primitives that share a vertex by them are exempt from
    /// contact once the seam is closed.
    pub seam_pairs: Vec<[u32; 2]>,
    /// Vertices that a seam ties to a point between two others, each with these: once the seam is
    /// closed, such a vertex is exempt from contact with primitives that have both.
    pub ties: Vec<[u32; 3]>,
}

/// Checks lengths, indices and ranges of the parts of a surface.
pub(super) fn check_parts(parts: &SurfaceParts) -> Result<(), Error> {
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
    check_positions("rest position of vertex", &parts.rest_positions)?;
    for (group, distances) in parts.distances.iter().enumerate() {
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
    let mut seams = parts.seam_pairs.iter().flatten().chain(parts.ties.iter().flatten());
    if let Some(&index) = seams.find(out) {
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

/// Checks the corners and the area of a triangle.
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
    let points = corners.map(|v| at(&parts.rest_positions, v as usize));
    match doubled_area(points) {
        Ok(_) => Ok(()),
        Err(area) => Err(Error::FlatTriangle { triangle, place: points[0], area }),
    }
}
