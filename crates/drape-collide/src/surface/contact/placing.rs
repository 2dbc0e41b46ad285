//! Placing: cloth and bodies at other places between two steps.

use super::obstacles::check_bodies;
use super::pinch::vertices_of;
use super::surface_contact::SurfaceContact;
use crate::error::Error;

/// Fraction of the smallest distance over its minimum separation that shrunk distances keep.
const SEPARATION_KEPT: f64 = 0.9;

/// Result of placing surfaces with closed seams: intersections, or the smallest distance.
#[derive(Debug, Clone, PartialEq)]
pub enum SewnPlacement {
    /// Nothing intersects: the smallest distance of a pair over its minimum separation.
    Free(f64),
    /// Something intersects: the vertices of the edge and the triangle of every intersection.
    Intersecting(Vec<[u32; 5]>),
}

impl SurfaceContact {
    /// Shrinks all distances until no pair is below its minimum separation at the free vertices'
    /// positions, in m.
    ///
    /// # Errors
    /// Positions that are not finite, or too many pairs.
    pub fn shrink_to_separation(&mut self, positions: &[f64]) -> Result<(), Error> {
        let ratio = SEPARATION_KEPT * self.summary_at(positions)?.min_ratio;
        if ratio < 1.0 {
            self.growth.fraction *= ratio;
            self.set_growth_fraction(self.growth.fraction);
        }
        Ok(())
    }

    /// Puts the bodies' vertices at flat positions, in m, between two steps.
    ///
    /// # Errors
    /// Another number of coordinates.
    pub fn place_bodies(&mut self, bodies: &[f64]) -> Result<(), Error> {
        check_bodies(bodies, self.obstacles.start.len())?;
        self.obstacles.restore(bodies);
        self.active.invalidate();
        Ok(())
    }

    /// Returns the placement with closed seams at other positions of the free vertices and of the bodies, in
    /// m. The contact stays as it is.
    ///
    /// # Errors
    /// Positions that are not finite, too many pairs, or another number of coordinates of bodies.
    pub fn sewn_placement(
        &mut self,
        positions: &[f64],
        bodies: &[f64],
    ) -> Result<SewnPlacement, Error> {
        let (memory, open_seams) = (self.memory(), self.open_seams.clone());
        let seam_gaps = self.surface.separations.seam_gaps.clone();
        self.close_seams();
        let placed = self.place_bodies(bodies);
        let found = placed.and_then(|()| self.placement(positions));
        self.open_seams = open_seams;
        self.surface.separations.seam_gaps = seam_gaps;
        self.drop_pairs();
        self.restore(&memory);
        found
    }

    /// Returns the placement at positions of the free vertices, in m.
    fn placement(&mut self, positions: &[f64]) -> Result<SewnPlacement, Error> {
        let found = self.intersections(positions)?.to_vec();
        if found.is_empty() {
            return Ok(SewnPlacement::Free(self.summary_at(positions)?.min_ratio));
        }
        let vertices = found.into_iter().map(|own| vertices_of(&self.surface, own));
        Ok(SewnPlacement::Intersecting(vertices.collect()))
    }
}
