//! Notes on garments whose flat pattern is smaller than the body at bust, waist or hip, or at a
//! height that the scene names. Nothing is sewn for them.

use crate::figure::ease::{Figures, merged, named};
use crate::figure::landmark::{FoundBy, Landmark};
use crate::figure::trunk::Trunk;

use crate::wearing::girth::Girths;
use crate::wearing::rings::Ring;

/// Largest difference of two girths that count as equal, in m.
const EQUAL: f64 = 5e-4;

/// Largest distance of a ring from a height, in m, at which the ring counts as at this height.
const LEVEL: f64 = 0.01;

/// Returns a note for each landmark at which the garment of `girths` is smaller than the first of
/// `figures` that it is about.
pub(crate) fn ease_notes(girths: &Girths<'_>, figures: &Figures) -> Vec<String> {
    for (bodies, detected) in figures.candidates() {
        let (mut is_about, mut notes) = (false, Vec::new());
        let landmarks = merged(detected, &named(girths.garment));
        for landmark in &landmarks {
            let Some(trunk) = Trunk::at(bodies, landmark.height) else { continue };
            let ring = girths.around(landmark.height, trunk.middle());
            let Some(ring) = ring.filter(|ring| is_worn_at(ring, landmark, &landmarks)) else {
                continue;
            };

            is_about = true;
            if trunk.girth() - ring.girth > EQUAL {
                notes.push(note(&girths.garment.name, landmark, ring, trunk.girth()));
            }
        }
        if is_about {
            return notes;
        }
    }
    Vec::new()
}

/// Returns whether `ring`, which is near `landmark`, belongs to it: the ring is at the height of
/// `landmark`, or no landmark of `all` is nearer.
fn is_worn_at(ring: &Ring, landmark: &Landmark, all: &[Landmark]) -> bool {
    let away = |other: &Landmark| (other.height - ring.plane.height()).abs();
    away(landmark) <= LEVEL || all.iter().all(|other| away(landmark) <= away(other))
}

/// Describes the garment `name`, whose `ring` at `landmark` is shorter than `body`, in m.
fn note(name: &str, landmark: &Landmark, ring: &Ring, body: f64) -> String {
    let by_stature = match landmark.found_by {
        FoundBy::Stature => ", where bodies of its height have it",
        FoundBy::Shape | FoundBy::Scene => "",
    };
    // The difference is taken between the rounded figures, so that the note adds up.
    let [garment, body] = [ring.girth, body].map(|girth| (1e3 * girth).round());
    let parts = ring.parts.join(" + ");
    format!(
        "\"{name}\" is smaller than the body at the {} ({:.2} m{by_stature}): {parts} measure {garment:.0} mm round in the \
         flat pattern, and the body {body:.0} mm, so its ease is −{:.0} mm and it has to stretch by {:.1} %; widen it \
         there, unless it is meant to be tight",
        landmark.name,
        landmark.height,
        body - garment,
        100.0 * (body / garment - 1.0)
    )
}
