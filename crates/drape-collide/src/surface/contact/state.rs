//! States of a contact between two steps: its memory, and the state that a checkpoint saves.

use serde::{Deserialize, Serialize};

use super::obstacles::check_bodies;
use super::pinch::PinchedVertices;
use super::settings::PinchPolicy;
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::friction::Stretch;
use crate::surface::geometry::PinchState;
use crate::surface::tracked_pairs::TrackedMemory;

/// State of a [`SurfaceContact`] when its last step was committed. An open step does not change it.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceState<'a> {
    contact: &'a SurfaceContact,
}

/// Memory of a [`SurfaceContact`] between two steps: stretches of friction, positions of the
/// bodies, pinched vertices, and the fraction of distances that is kept.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SurfaceMemory {
    pub(super) stretches: Vec<Stretch>,
    pub(super) bodies: Vec<f64>,
    pub(super) pinch: Vec<PinchState>,
    pub(super) growth_fraction: f64,
}

/// Saved state of a [`SurfaceContact`], from which a run resumes: its memory, the gaps of its open
/// seams and its candidate pairs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedContact {
    pub(super) memory: SurfaceMemory,
    pub(super) seam_gaps: Vec<f64>,
    pub(super) tracked: TrackedMemory,
}

impl<'a> SurfaceState<'a> {
    /// Returns the state of `contact`.
    pub(super) fn new(contact: &'a SurfaceContact) -> SurfaceState<'a> {
        SurfaceState { contact }
    }

    /// Returns the positions of the bodies' vertices, in m, flat.
    #[must_use]
    pub fn body_positions(self) -> &'a [f64] {
        &self.contact.obstacles.start
    }

    /// Returns the fraction of activation distances and minimum separations that surfaces keep, 0
    /// to 1. See [`SurfaceStart::growth_increment`](super::SurfaceStart::growth_increment).
    #[must_use]
    pub fn growth_fraction(self) -> f64 {
        self.contact.growth.fraction
    }

    /// Returns the treatment of cloth that bodies pinch.
    #[must_use]
    pub fn pinch_policy(self) -> PinchPolicy {
        self.contact.pinch.policy
    }

    /// Returns the numbers of free vertices that bodies pinch, as [`PinchedVertices`].
    #[must_use]
    pub fn pinched_vertices(self) -> PinchedVertices {
        self.contact.pinch.count()
    }

    /// Returns the fraction of its minimum separation from bodies that pinched cloth keeps:
    /// [`PinchPolicy::THINNED_FRACTION`] or 1.
    #[must_use]
    pub fn thinned_fraction(self) -> f64 {
        let thins = self.contact.pinch.policy == PinchPolicy::Thin;
        if thins { PinchPolicy::THINNED_FRACTION } else { 1.0 }
    }

    /// Returns the state as a [`SurfaceMemory`], for [`SurfaceContact::restore`].
    #[must_use]
    pub fn memory(self) -> SurfaceMemory {
        let mut memory = SurfaceMemory::default();
        self.save(&mut memory);
        memory
    }

    /// Writes the state to `memory`, whose lists are reused.
    pub fn save(self, memory: &mut SurfaceMemory) {
        let SurfaceMemory { stretches, bodies, pinch, growth_fraction } = memory;
        stretches.clone_from(&self.contact.friction.stretches);
        bodies.clone_from(&self.contact.obstacles.start);
        pinch.clone_from(&self.contact.pinch.committed);
        *growth_fraction = self.contact.growth.fraction;
    }

    /// Returns the state with the present gaps and candidate pairs as a [`SavedContact`], for a
    /// file and [`SurfaceContact::resume`].
    #[must_use]
    pub fn saved(self) -> SavedContact {
        SavedContact {
            memory: self.memory(),
            seam_gaps: self.contact.surface.separations.seam_gaps.clone(),
            tracked: self.contact.tracked.memory(),
        }
    }
}

impl SurfaceContact {
    /// Restores the state `memory`, as if the steps since then had not been committed. A step that
    /// is open ends.
    ///
    /// # Errors
    /// `memory` belongs to another surface, or holds numbers that no contact produces.
    pub fn restore(&mut self, memory: &SurfaceMemory) -> Result<(), Error> {
        memory.check(self.surface.free_count(), self.obstacles.start.len())?;
        self.take_back(memory);
        Ok(())
    }

    /// Restores the state `memory`, which has been checked.
    pub(super) fn take_back(&mut self, memory: &SurfaceMemory) {
        let SurfaceMemory { stretches, bodies, pinch, growth_fraction } = memory;
        self.friction.stretches.clone_from(stretches);
        self.pinch.committed.clone_from(pinch);
        self.growth.fraction = *growth_fraction;
        self.set_pinch(pinch);
        self.set_growth_fraction(*growth_fraction);
        self.obstacles.restore(bodies);
        self.is_open = false;
    }

    /// Restores the state `saved`, which was saved with the free vertices at `positions`, in m.
    /// From then on, every result is identical to the uninterrupted run's. A step that is open
    /// ends.
    ///
    /// # Errors
    /// `saved` belongs to another surface, or holds numbers that no contact produces.
    pub fn resume(&mut self, positions: &[f64], saved: &SavedContact) -> Result<(), Error> {
        let SavedContact { memory, seam_gaps, tracked } = saved;
        memory.check(self.surface.free_count(), self.obstacles.start.len())?;
        let (needed, found) = (3 * self.surface.free_count(), positions.len());
        if found != needed {
            return Err(Error::WrongLength { what: "positions", found, needed });
        }

        let vertices = self.surface.vertex_count();
        if !tracked.fits(3 * vertices) || !self.open_seams.may_have(seam_gaps) {
            return Err(Error::SavedContact);
        }

        // An evaluation at the positions reports errors before the saved pairs are restored.
        self.surface.separations.seam_gaps.clone_from(seam_gaps);
        self.take_back(memory);
        self.active.invalidate();
        self.detect_pairs(positions)?;
        self.tracked.restore(&self.surface, tracked)
    }
}

impl SurfaceMemory {
    /// Checks that this memory fits a contact with `free_count` free vertices, whose bodies have
    /// `coordinate_count` coordinates.
    pub(super) fn check(&self, free_count: usize, coordinate_count: usize) -> Result<(), Error> {
        let Self { stretches, bodies, pinch, growth_fraction } = self;
        check_bodies(bodies, coordinate_count)?;
        if !pinch.is_empty() && pinch.len() != free_count {
            let (what, found) = ("pinch states", pinch.len());
            return Err(Error::WrongLength { what, found, needed: free_count });
        }
        let finite = bodies.iter().all(|x| x.is_finite()) && Stretch::are_valid(stretches);
        if !(finite && *growth_fraction > 0.0 && *growth_fraction <= 1.0) {
            return Err(Error::SavedContact);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_memory_that_no_contact_has_is_refused() {
        // Three free vertices, and a body of three.
        let check = |change: &dyn Fn(&mut SurfaceMemory)| {
            let bodies = vec![0.5; 9];
            let mut memory = SurfaceMemory { bodies, growth_fraction: 1.0, ..Default::default() };
            change(&mut memory);
            memory.check(3, 9)
        };
        check(&|_| ()).unwrap();
        check(&|memory| memory.growth_fraction = 0.5).unwrap();
        check(&|memory| memory.pinch = vec![PinchState::Thinned; 3]).unwrap();
        let wrong: [&dyn Fn(&mut SurfaceMemory); 6] = [
            &|memory| memory.bodies.truncate(8),
            &|memory| memory.bodies[8] = f64::NAN,
            &|memory| memory.pinch = vec![PinchState::Free; 2],
            &|memory| memory.growth_fraction = 0.0,
            &|memory| memory.growth_fraction = 1.0 + f64::EPSILON,
            &|memory| memory.growth_fraction = f64::NAN,
        ];
        for (k, change) in wrong.into_iter().enumerate() {
            assert!(check(change).is_err(), "{k}");
        }
    }
}
