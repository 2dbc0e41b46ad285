//! Setup: what changes between two steps only. Seams are opened and closed, distances shrink, and
//! cloth and bodies are placed at new positions.

use super::obstacles::check_bodies;
use super::pinch::vertices_of;
use super::state::SurfaceState;
use super::surface_contact::SurfaceContact;
use crate::error::{Error, check_length, check_positions};

/// Fraction of the nearest pair's distance that its minimum separation takes after shrinking.
const SEPARATION_KEPT: f64 = 0.9;

/// Result of placing surfaces with closed seams.
#[derive(Debug, Clone, PartialEq)]
pub enum SewnPlacement {
    /// No primitives intersect. The number is the smallest ratio of a pair's distance to the pair's
    /// minimum separation.
    Free(f64),
    /// Some primitives intersect. The list has the two vertices of the edge and the three vertices
    /// of the triangle of every intersection.
    Intersecting(Vec<[u32; 5]>),
}

/// Setup of a [`SurfaceContact`] between two steps. While a step is open,
/// [`SurfaceContact::setup`] returns an error in place of the setup.
#[derive(Debug)]
pub struct SurfaceSetup<'a> {
    contact: &'a mut SurfaceContact,
}

impl<'a> SurfaceSetup<'a> {
    /// Returns the setup of `contact`.
    ///
    /// # Errors
    /// [`Error::StepIsOpen`].
    pub(super) fn new(contact: &'a mut SurfaceContact) -> Result<SurfaceSetup<'a>, Error> {
        if contact.is_open { Err(Error::StepIsOpen) } else { Ok(SurfaceSetup { contact }) }
    }

    /// Opens the seams at the `positions` of the free vertices, in m. `gaps` holds the gap at each
    /// free vertex, in m: 0 where its seam is one point, infinite without a seam.
    ///
    /// The two sides of an open seam are two cloths. They repel each other below half of the gap,
    /// and keep a tenth of the gap, or the usual distances where these are smaller.
    ///
    /// # Errors
    /// Positions are not finite, there are too many pairs, or there is not one gap for each free
    /// vertex.
    pub fn open_seams(&mut self, gaps: &[f64], positions: &[f64]) -> Result<(), Error> {
        let contact = &mut *self.contact;
        check_length("gaps of seams", gaps.len(), contact.surface.free_count())?;
        contact.open_seams.open(&contact.surface);
        contact.set_seam_gaps(gaps);
        contact.detect_pairs(positions)?;
        contact.open_seams.limit(&contact.surface, contact.active.iter());
        contact.set_seam_gaps(gaps);
        Ok(())
    }

    /// Closes the seams: from now on, primitives with vertices that seams join or tie are exempt
    /// from contact with each other. The vertices must be at their sewn positions.
    pub fn close_seams(&mut self) {
        self.contact.open_seams.close();
        self.contact.set_seam_gaps(&[]);
    }

    /// Shrinks all distances until no pair is active at the `positions` of the free vertices, in m.
    ///
    /// The fraction of the distances that is kept becomes the smallest ratio of a pair's distance
    /// to its activation distance, or stays if no pair is active.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub fn shrink_distances(&mut self, positions: &[f64]) -> Result<(), Error> {
        let contact = &mut *self.contact;
        contact.detect_pairs(positions)?;
        contact.growth.fraction = contact
            .active
            .iter()
            .map(|active| active.gap.distance() / active.pair.activation_distance)
            .fold(contact.growth.fraction, f64::min);
        contact.set_growth_fraction(contact.growth.fraction);
        Ok(())
    }

    /// Shrinks all distances until no pair is below its minimum separation at the `positions` of
    /// the free vertices, in m.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub fn shrink_to_separation(&mut self, positions: &[f64]) -> Result<(), Error> {
        let contact = &mut *self.contact;
        let ratio = SEPARATION_KEPT * contact.detect_pairs(positions)?.summary().min_ratio;
        if ratio < 1.0 {
            contact.growth.fraction *= ratio;
            contact.set_growth_fraction(contact.growth.fraction);
        }
        Ok(())
    }

    /// Moves the bodies' vertices to the flat positions `bodies`, in m.
    ///
    /// # Errors
    /// `bodies` has the wrong number of coordinates, or one that is not finite or beyond 1000 km.
    pub fn place_bodies(&mut self, bodies: &[f64]) -> Result<(), Error> {
        let SurfaceContact { obstacles, active, .. } = &mut *self.contact;
        check_bodies(bodies, obstacles.start.len())?;
        check_positions("vertex of a body", bodies)?;
        obstacles.restore(bodies);
        active.invalidate();
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
        let memory = SurfaceState::new(self.contact).memory();
        let open_seams = self.contact.open_seams.clone();
        let seam_gaps = self.contact.surface.separations.seam_gaps.clone();
        self.close_seams();
        let placed = self.place_bodies(bodies);
        let placement = placed.and_then(|()| self.placement(positions));

        let contact = &mut *self.contact;
        contact.open_seams = open_seams;
        contact.surface.separations.seam_gaps = seam_gaps;
        contact.drop_pairs();
        contact.take_back(&memory);
        placement
    }

    /// Returns the [`SewnPlacement`] at `positions` of the free vertices, in m.
    fn placement(&mut self, positions: &[f64]) -> Result<SewnPlacement, Error> {
        let contact = &mut *self.contact;
        let intersections = contact.intersections(positions)?.to_vec();
        if intersections.is_empty() {
            return Ok(SewnPlacement::Free(contact.detect_pairs(positions)?.summary().min_ratio));
        }
        let vertices = intersections.into_iter().map(|each| vertices_of(&contact.surface, each));
        Ok(SewnPlacement::Intersecting(vertices.collect()))
    }
}
