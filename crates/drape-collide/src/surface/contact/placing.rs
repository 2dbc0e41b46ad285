//! Placing of cloth and bodies at new positions between two steps.

use super::obstacles::check_bodies;
use super::pinch::vertices_of;
use super::surface_contact::SurfaceContact;
use crate::error::Error;

/// Fraction of the nearest pair's distance that its minimum separation takes after shrinking.
const SEPARATION_KEPT: f64 = 0.9;

/// Result of placing surfaces with closed seams.
#[derive(Debug, Clone, PartialEq)]
pub enum SewnPlacement {
    /// Nothing intersects. Holds the smallest ratio of a pair's distance to its minimum separation.
    Free(f64),
    /// Some primitives intersect. Holds the vertices of the edge and the triangle of every
    /// intersection.
    Intersecting(Vec<[u32; 5]>),
}

impl SurfaceContact {
    /// Shrinks all distances until no pair is below its minimum separation at the `positions` of
    /// the free vertices, in m.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub fn shrink_to_separation(&mut self, positions: &[f64]) -> Result<(), Error> {
        let ratio = SEPARATION_KEPT * self.summary_at(positions)?.min_ratio;
        if ratio < 1.0 {
            self.growth.fraction *= ratio;
            self.set_growth_fraction(self.growth.fraction);
        }
        Ok(())
    }

    /// Moves the bodies' vertices to the flat positions `bodies`, in m, between two steps.
    ///
    /// # Errors
    /// `bodies` has the wrong number of coordinates.
    pub fn place_bodies(&mut self, bodies: &[f64]) -> Result<(), Error> {
        check_bodies(bodies, self.obstacles.start.len())?;
        self.obstacles.restore(bodies);
        self.active.invalidate();
        Ok(())
    }

    /// Returns the [`SewnPlacement`] with closed seams at `positions` of the free vertices and
    /// `bodies` of the bodies' vertices, in m. The contact stays unchanged.
    ///
    /// # Errors
    /// Positions are not finite, there are too many pairs, or `bodies` has the wrong number of
    /// coordinates.
    pub fn sewn_placement(
        &mut self,
        positions: &[f64],
        bodies: &[f64],
    ) -> Result<SewnPlacement, Error> {
        let (memory, open_seams) = (self.memory(), self.open_seams.clone());
        let seam_gaps = self.surface.separations.seam_gaps.clone();
        self.close_seams();
        let placed = self.place_bodies(bodies);
        let placement = placed.and_then(|()| self.placement(positions));

        self.open_seams = open_seams;
        self.surface.separations.seam_gaps = seam_gaps;
        self.drop_pairs();
        self.restore(&memory);
        placement
    }

    /// Returns the [`SewnPlacement`] at `positions` of the free vertices, in m.
    fn placement(&mut self, positions: &[f64]) -> Result<SewnPlacement, Error> {
        let intersections = self.intersections(positions)?.to_vec();
        if intersections.is_empty() {
            return Ok(SewnPlacement::Free(self.summary_at(positions)?.min_ratio));
        }
        let vertices = intersections.into_iter().map(|each| vertices_of(&self.surface, each));
        Ok(SewnPlacement::Intersecting(vertices.collect()))
    }
}
