//! Notes on garments that are smaller than their body at bust, waist or hip, or at a height that the scene
//! names: by the flat pattern, before anything is sewn.

use drape_collide::Shape;

use crate::figure::ease::{Figures, merged, named};
use crate::figure::landmark::{FoundBy, Landmark};
use crate::figure::trunk::Trunk;
use crate::scene::Scene;
use crate::scene::garment::Garment;

use super::girth::Girths;
use super::rings::Ring;

/// Difference of two girths that is no difference, in m.
const EQUAL: f64 = 5e-4;

/// Distance of a ring from a height at which it still is at that height, in m.
const LEVEL: f64 = 0.01;

/// Returns a note for each place at which a garment of a scene is smaller than its body.
pub(crate) fn ease_notes(scene: &Scene) -> Vec<String> {
    if scene.sewing.is_none() {
        return Vec::new();
    }
    let solid = scene.bodies.iter().filter(|moving| !matches!(moving.body.shape, Shape::Plane));
    let figures = Figures::new(solid.filter_map(|moving| moving.body.triangulate().ok()).collect());
    let garments = scene.garments.iter().enumerate();
    garments.flat_map(|(number, garment)| notes(scene, &figures, (number, garment))).collect()
}

/// Returns the notes on a garment, on the first figure that it is about.
fn notes(scene: &Scene, figures: &Figures, (number, garment): (usize, &Garment)) -> Vec<String> {
    let girths = Girths::new(scene, number);
    for (bodies, found) in figures.candidates() {
        let (mut is_about, mut notes) = (false, Vec::new());
        let landmarks = merged(found, &named(garment));
        for landmark in &landmarks {
            let Some(trunk) = Trunk::at(bodies, landmark.height) else { continue };
            let ring = girths.around(landmark.height, trunk.middle());
            let Some(ring) = ring.filter(|ring| is_worn_at(ring, landmark, &landmarks)) else {
                continue;
            };
            is_about = true;
            if trunk.girth() - ring.girth > EQUAL {
                notes.push(note(&garment.name, landmark, ring, trunk.girth()));
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

/// Describes a garment that is smaller than its body.
fn note(name: &str, landmark: &Landmark, ring: &Ring, body: f64) -> String {
    let by_stature = match landmark.found_by {
        FoundBy::Stature => ", where bodies of its height have it",
        FoundBy::Shape | FoundBy::Scene => "",
    };
    // The difference is that of the figures that are shown.
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
