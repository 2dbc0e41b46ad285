//! Surface of all cloth and all bodies, checked.

use super::broad_phase::close_at_rest;
use super::geometry::{ContactDistances, Primitives, Separations, SurfaceParts};
use crate::error::{Error, check_positions};

/// Surface of all cloth and all bodies: what never changes in their contact.
///
/// It is checked, and has edges, areas of primitives, their order in space, and the pairs that lie
/// close at rest.
#[derive(Debug, Clone)]
pub struct Surface {
    primitives: Primitives,
    pub(crate) separations: Separations,
}

impl Surface {
    /// Checks parts and makes a surface of them.
    ///
    /// # Errors
    ///
    /// If a list has the wrong length, an index is out of range, a coordinate is not finite or
    /// beyond 1000 km, a triangle has no area, names a vertex twice or spans two groups, an area is
    /// negative, a distance is not positive or a minimum separation not below its activation
    /// distance, or two primitives of one group that share no vertex touch at rest.
    pub fn new(parts: SurfaceParts) -> Result<Surface, Error> {
        let rest_positions = parts.rest_positions.clone();
        let mut separations = Separations::new(parts.distances.clone());
        let primitives = Primitives::new(parts)?;
        separations.close_at_rest = close_at_rest(&primitives, &separations, &rest_positions)?;
        Ok(Surface { primitives, separations })
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.primitives.vertex_count()
    }

    /// Number of free vertices, which come first.
    #[must_use]
    pub fn free_count(&self) -> usize {
        self.primitives.free
    }

    /// Class of a vertex: the smallest of the vertices that move together with it where seams are closed.
    pub(crate) fn moving_class(&self, vertex: u32) -> u32 {
        match self.separations.seam_gaps.is_empty() {
            true => self.primitives.seams.moving_class(vertex),
            false => vertex,
        }
    }

    /// Vertices of each triangle, as given.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.primitives.triangles
    }

    /// Vertices of each edge, the lower first, sorted.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.primitives.edges
    }

    /// Median length of the free edges at rest, in m; 0 without any.
    ///
    /// The edges of bodies do not count: those of a rounded box may be a hundred times shorter.
    #[must_use]
    pub fn median_edge_length(&self) -> f64 {
        self.primitives.median_edge_length()
    }

    /// Half distances of each group.
    #[must_use]
    pub fn group_distances(&self) -> &[ContactDistances] {
        &self.separations.groups
    }

    /// Group of a vertex, and so of all primitives at it.
    #[must_use]
    pub fn group(&self, vertex: u32) -> u32 {
        self.primitives.group(vertex)
    }

    /// Distances of a pair of vertices, or of primitives at them, whatever their distance at rest.
    #[must_use]
    pub fn pair_distances(&self, a: u32, b: u32) -> ContactDistances {
        self.separations.of_groups([a, b].map(|vertex| self.group(vertex)))
    }

    /// Primitives of the surface.
    pub(crate) fn primitives(&self) -> &Primitives {
        &self.primitives
    }

    /// Returns the fraction of its minimum separation that a pair keeps where bodies pinch; none if
    /// it is released.
    pub(crate) fn pinch_fraction(&self, vertices: &[u32]) -> Option<f64> {
        self.separations.pinch_fraction(&self.primitives, vertices)
    }

    /// Checks the length and the range of flat displacements: of all vertices, or of the free ones
    /// where bodies rest.
    pub(crate) fn check_displacements(&self, displacements: &[f64]) -> Result<(), Error> {
        match displacements.len() == 3 * self.free_count() {
            true => check_positions("the displacement of vertex", displacements),
            false => self.check_positions(displacements),
        }
    }

    /// Checks the length and the range of flat positions.
    pub(crate) fn check_positions(&self, positions: &[f64]) -> Result<(), Error> {
        let needed = 3 * self.vertex_count();
        if positions.len() != needed {
            return Err(Error::WrongLength { what: "positions", found: positions.len(), needed });
        }
        check_positions("vertex", positions)
    }
}
