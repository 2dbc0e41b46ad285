//! Checked surface of all cloth and all bodies.

use super::broad_phase::close_at_rest;
use super::geometry::{ContactDistances, Primitives, Separations, SurfaceParts};
use crate::error::{Error, check_index, check_length, check_positions};

/// Surface of all cloth and all bodies: the constant data of their contact.
///
/// The surface has been checked. It has edges, areas of primitives, their order in space, and the
/// pairs that lie close at rest.
#[derive(Debug, Clone)]
pub struct Surface {
    primitives: Primitives,
    pub(crate) separations: Separations,
}

impl Surface {
    /// Checks `parts` and returns their surface.
    ///
    /// # Errors
    ///
    /// A list has the wrong length; an index is out of range; no vertex is free; a coordinate is
    /// not finite or beyond 1000 km; a triangle has no area, names a vertex twice or spans two
    /// groups; an area is negative; a distance is not positive; a minimum separation is not below
    /// its activation distance; or two primitives of one group that share no vertex touch at rest.
    pub fn new(parts: SurfaceParts) -> Result<Surface, Error> {
        let rest_positions = parts.rest_positions.clone();
        let mut separations = Separations::new(parts.distances.clone());
        let primitives = Primitives::new(parts)?;
        separations.close_at_rest = close_at_rest(&primitives, &separations, &rest_positions)?;
        Ok(Surface { primitives, separations })
    }

    /// Returns the number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.primitives.vertex_count()
    }

    /// Returns the number of free vertices, which come first.
    #[must_use]
    pub fn free_count(&self) -> usize {
        self.primitives.free
    }

    /// Returns the class of `vertex`: the smallest number among the vertices that move together
    /// with it where seams are closed.
    pub(crate) fn moving_class(&self, vertex: u32) -> u32 {
        if self.separations.seam_gaps.is_empty() {
            self.primitives.seams.moving_class(vertex)
        } else {
            vertex
        }
    }

    /// Returns the vertices of each triangle, in the order of [`SurfaceParts::triangles`].
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.primitives.triangles
    }

    /// Returns the vertices of each edge, the lower first, sorted.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.primitives.edges
    }

    /// Returns the median length of the free edges at rest, in m, or 0 without free edges.
    ///
    /// Edges of bodies do not count, because the edges of a rounded box may be a hundred times
    /// shorter.
    #[must_use]
    pub fn median_edge_length(&self) -> f64 {
        self.primitives.median_edge_length()
    }

    /// Returns the half distances of each group.
    #[must_use]
    pub fn group_distances(&self) -> &[ContactDistances] {
        &self.separations.groups
    }

    /// Returns the group of `vertex`. All primitives with this vertex belong to the group.
    ///
    /// # Errors
    ///
    /// `vertex` does not exist.
    pub fn group(&self, vertex: u32) -> Result<u32, Error> {
        check_index("vertex", vertex as usize, self.vertex_count())?;
        Ok(self.primitives.group(vertex))
    }

    /// Returns the [`ContactDistances`] between the groups of the vertices `a` and `b`. Pairs that
    /// lie close at rest may have smaller distances.
    ///
    /// # Errors
    ///
    /// `a` or `b` does not exist.
    pub fn pair_distances(&self, a: u32, b: u32) -> Result<ContactDistances, Error> {
        check_index("vertex", a.max(b) as usize, self.vertex_count())?;
        Ok(self.vertex_distances([a, b]))
    }

    /// Returns the [`ContactDistances`] between the groups of two `vertices` that exist.
    pub(crate) fn vertex_distances(&self, vertices: [u32; 2]) -> ContactDistances {
        self.separations.between_groups(vertices.map(|vertex| self.primitives.group(vertex)))
    }

    /// Returns the primitives of the surface.
    pub(crate) fn primitives(&self) -> &Primitives {
        &self.primitives
    }

    /// Returns the fraction of its minimum separation that the pair of `vertices` keeps where
    /// bodies pinch cloth, or `None` for a pair without contact.
    pub(crate) fn pinch_fraction(&self, vertices: &[u32]) -> Option<f64> {
        self.separations.pinch_fraction(&self.primitives, vertices)
    }

    /// Checks length and range of flat `displacements`, in m. They belong to all vertices or, where
    /// bodies rest, to the free vertices.
    pub(crate) fn check_displacements(&self, displacements: &[f64]) -> Result<(), Error> {
        if displacements.len() == 3 * self.free_count() {
            check_positions("the displacement of vertex", displacements)
        } else {
            self.check_positions(displacements)
        }
    }

    /// Checks length and range of the flat `positions` of all vertices, in m.
    pub(crate) fn check_positions(&self, positions: &[f64]) -> Result<(), Error> {
        check_length("positions", positions.len(), 3 * self.vertex_count())?;
        check_positions("vertex", positions)
    }
}
