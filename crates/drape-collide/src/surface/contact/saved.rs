//! States of a contact between two steps: its memory, and all that is written to a file.

use serde::{Deserialize, Serialize};

use super::obstacles::check_bodies;
use super::surface_contact::SurfaceContact;
use crate::error::Error;
use crate::surface::friction::Stretch;
use crate::surface::geometry::PinchState;
use crate::surface::tracked_pairs::TrackedMemory;

/// State of a [`SurfaceContact`] between two steps: stretches of friction, positions of the bodies,
/// pinched vertices and the fraction of distances that is kept.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SurfaceMemory {
    pub(super) stretches: Vec<Stretch>,
    pub(super) bodies: Vec<f64>,
    pub(super) pinch: Vec<PinchState>,
    pub(super) growth_fraction: f64,
}

/// All that the next steps of a [`SurfaceContact`] depend on between two steps, to be written to a
/// file: its memory, the gaps of its open seams and the pairs at hand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedContact {
    pub(super) memory: SurfaceMemory,
    pub(super) seam_gaps: Vec<f64>,
    pub(super) tracked: TrackedMemory,
}

impl SurfaceMemory {
    /// Checks that this is the memory of a contact.
    pub(super) fn check(&self, contact: &SurfaceContact) -> Result<(), Error> {
        let Self { stretches, bodies, pinch, growth_fraction } = self;
        check_bodies(bodies, contact.obstacles.start.len())?;
        let free = contact.surface.free_count();
        if !pinch.is_empty() && pinch.len() != free {
            let (what, found) = ("pinch states", pinch.len());
            return Err(Error::WrongLength { what, found, needed: free });
        }
        let finite = bodies.iter().all(|x| x.is_finite()) && Stretch::are_right(stretches);
        if !(finite && *growth_fraction > 0.0 && *growth_fraction <= 1.0) {
            return Err(Error::SavedContact);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::contact::SurfaceSettings;
    use crate::surface::{ContactDistances, Surface, SurfaceParts};

    /// Contact of one triangle with a body of one triangle.
    fn contact() -> SurfaceContact {
        let bodies = vec![0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0];
        let cloth = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let surface = Surface::new(SurfaceParts {
            rest_positions: [&cloth[..], &bodies].concat(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            areas: vec![0.2; 6],
            groups: vec![0, 0, 0, 1, 1, 1],
            distances: vec![
                ContactDistances { activation_distance: 3e-4, min_separation: 5e-5 };
                2
            ],
            free_vertices: 3,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        });
        let settings = SurfaceSettings::new(1e8, vec![0.0; 4]);
        SurfaceContact::new(surface.unwrap(), settings, bodies).unwrap()
    }

    #[test]
    fn a_memory_that_no_contact_has_is_refused() {
        let contact = contact();
        let check = |change: &dyn Fn(&mut SurfaceMemory)| {
            let mut memory = contact.memory();
            change(&mut memory);
            memory.check(&contact)
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
