//! Wearing: where garments are relative to the bodies of a scene, and where they fit.
//!
//! [`Scene::garment_placement`] is the entrance. `solids` has the bodies that a garment can be worn
//! on, `rings` and `girth` measure how far a garment goes round them, and `placing` searches for a
//! place at which the garment is worn.

pub(crate) mod girth;
pub(crate) mod placing;
pub(crate) mod rings;
pub(crate) mod solids;

use crate::scene::Scene;
use crate::scene::garment::Garment;

use self::girth::Girths;
use self::placing::free_shift;
use self::solids::{GarmentPlace, Solids};

/// Place of a garment at the start, and the way to where it is worn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GarmentPlacement {
    /// Place at the start.
    pub place: GarmentPlace,
    /// Shift that brings the garment about a body, in m. The shift is added to the `center` of the
    /// garment. `None` if no place was found at which the garment fits and is clear of all bodies.
    pub shift: Option<[f64; 3]>,
}

impl Scene {
    /// Returns where the garment with the number `garment` starts relative to the bodies, and the
    /// shift that brings it to a place where it is worn.
    ///
    /// A garment that hangs from the waist is brought to the lowest height at which it holds, any
    /// other garment to the place nearest to the bodies. The search tries some hundred places and
    /// takes about a second. Returns `None` if the scene has no such garment, or no body but
    /// floors.
    #[must_use]
    pub fn garment_placement(&self, garment: usize) -> Option<GarmentPlacement> {
        let solids = Solids::new(self.bodies.iter().map(|moving| &moving.body))?;
        let garment = self.garments.get(garment)?;
        let points = points(self, garment);
        let shift = shift_to_body(self, &solids, garment, &points);
        Some(GarmentPlacement { place: solids.place(&points), shift })
    }
}

/// Returns the shift, in m, that brings `garment` of `scene`, with its particles at `points`, about
/// one of `solids`, or `None` if no place was found.
pub(crate) fn shift_to_body(
    scene: &Scene,
    solids: &Solids<'_>,
    garment: &Garment,
    points: &[[f64; 3]],
) -> Option<[f64; 3]> {
    let girths = Girths::new(scene, &solids.outlines, garment);
    let shift = solids.shift(points, Some(&girths));
    shift.map(|shift| free_shift(scene, garment, shift))
}

/// Returns whether pins hold particles of `garment`.
pub(crate) fn is_held(scene: &Scene, garment: &Garment) -> bool {
    let mut pinned = scene.pins.iter().flat_map(|pin| &pin.particles);
    pinned.any(|particle| garment.particles.contains(particle))
}

/// Returns the positions of the particles of `garment` at the start, in m.
pub(crate) fn points(scene: &Scene, garment: &Garment) -> Vec<[f64; 3]> {
    scene.start.positions.as_chunks::<3>().0[garment.particles.clone()].to_vec()
}
