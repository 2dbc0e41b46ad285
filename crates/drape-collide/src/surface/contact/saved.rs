//! States of a contact between two steps: its memory, and the state that a checkpoint saves.

use serde::{Deserialize, Serialize};

use super::obstacles::check_bodies;
use crate::error::Error;
use crate::surface::friction::Stretch;
use crate::surface::geometry::PinchState;
use crate::surface::tracked_pairs::TrackedMemory;

/// State of a [`SurfaceContact`] between two steps: stretches of friction, positions of the bodies,
/// pinched vertices, and the fraction of distances that is kept.
///
/// [`SurfaceContact`]: super::SurfaceContact
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SurfaceMemory {
    pub(super) stretches: Vec<Stretch>,
    pub(super) bodies: Vec<f64>,
    pub(super) pinch: Vec<PinchState>,
    pub(super) growth_fraction: f64,
}

/// Saved state of a [`SurfaceContact`], from which a run resumes: its memory, the gaps of its open
/// seams and its candidate pairs.
///
/// [`SurfaceContact`]: super::SurfaceContact
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedContact {
    pub(super) memory: SurfaceMemory,
    pub(super) seam_gaps: Vec<f64>,
    pub(super) tracked: TrackedMemory,
}

impl SurfaceMemory {
    /// Checks that this memory fits a contact with `free` free vertices and `coordinates`
    /// coordinates of bodies.
    pub(super) fn check(&self, free: usize, coordinates: usize) -> Result<(), Error> {
        let Self { stretches, bodies, pinch, growth_fraction } = self;
        check_bodies(bodies, coordinates)?;
        if !pinch.is_empty() && pinch.len() != free {
            let (what, found) = ("pinch states", pinch.len());
            return Err(Error::WrongLength { what, found, needed: free });
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
