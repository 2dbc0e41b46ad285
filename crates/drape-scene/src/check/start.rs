//! Start of a scene: whether its cloth is outside of its bodies, its surfaces apart, its layers in
//! order.

mod apart;
mod bodies;
mod ease_notes;
pub(crate) mod girth;
mod layers;
mod place_key;
pub(crate) mod placing;
mod rings;
mod stitches;
mod tangle;

use drape_collide::{ParticleContact, SurfaceContact};
use drape_input::{Diagnostics, Subject, tidy};

use crate::check::checker::Checker;
use crate::error::{Error, Refused};
use crate::scene::Scene;
use crate::scene::panel::Panel;
use crate::surfaces::StartSurfaces;
use crate::tangle::Tangle;

use self::apart::{leave_bodies, part_panels};
use self::bodies::{body_notes, contact_limits};
use self::ease_notes::ease_notes;
use self::girth::girth_notes;
use self::layers::check_layers;
use self::place_key::place_key;
use self::placing::{Places, check_places};
use self::stitches::{stitches_through_bodies, stitches_through_panels};
use self::tangle::{Tangled, check_tangle};

/// Checks the start of a scene that has no other mistakes, and returns the scene with notes on its
/// layers.
pub(crate) fn check_start(
    checker: &mut Checker<'_>,
    mut scene: Scene,
) -> Result<Scene, Box<Refused>> {
    let moved = leave_bodies(&mut scene);
    scene.source.notes.extend(moved);
    let Places { notes, advised } = check_places(checker, &scene);
    if advised {
        // Where it is advised to be, it is clear of the bodies that it crosses where it is.
        if let Err(mistakes) = checker.finish() {
            return Err(Refused::with(mistakes, scene));
        }
    }
    scene.source.contact_limits = contact_limits(&scene);
    scene.source.notes.extend([body_notes(&scene), notes].concat());
    let mut surfaces = surfaces(checker, &scene)?;
    let moved = surfaces.as_mut().map(|surfaces| part_panels(&mut scene, surfaces));
    if let Some(moved) = moved.filter(|moved| !moved.is_empty()) {
        scene.source.notes.extend(moved);
        surfaces = self::surfaces(checker, &scene)?;
    }
    let tangle = surfaces.as_mut().and_then(|surfaces| check_tangle(checker, surfaces, &scene));
    let particles = scene.particle_contact();
    let particles = particles.map_err(|error| mistake(checker, "collider", &error))?;
    match (&surfaces, scene.contact.inflation) {
        (Some(surfaces), Some(_)) => check_panels_outside(checker, &surfaces.contact, &scene),
        _ => check_particles_outside(checker, &particles, &scene),
    }
    if tangle.is_none() {
        let notes = [
            stitches_through_bodies(&scene),
            stitches_through_panels(&scene),
            girth_notes(&scene),
            ease_notes(&scene),
        ]
        .concat();
        scene.source.notes.extend(notes);
    }
    if tangle.is_none() {
        let notes = check_layers(checker, &scene);
        scene.source.notes.extend(notes);
    }
    let Err(mistakes) = checker.finish() else { return Ok(scene) };
    let error = match tangle {
        Some(Tangled { overlaps, mistake }) => Error::Tangled(Box::new(Tangle {
            mistakes,
            mistake,
            folder: scene.output.folder.clone(),
            overlaps: overlaps.first,
            total: overlaps.total,
        })),
        None => Error::Input(mistakes),
    };
    Err(Refused::with(error, scene))
}

/// Makes the surfaces of a scene where they are kept apart.
fn surfaces(
    checker: &mut Checker<'_>,
    scene: &Scene,
) -> Result<Option<StartSurfaces>, Diagnostics> {
    let surfaces = scene.contact.surfaces.then(|| StartSurfaces::new(scene)).transpose();
    surfaces.map_err(|error| mistake(checker, "contact.surfaces", &error))
}

/// Mistake of a scene of which no contact can be made.
fn mistake(checker: &Checker<'_>, key: &str, error: &drape_collide::Error) -> Diagnostics {
    checker.document().at(key, tidy(&error.to_string())).into()
}

/// Checks that no particle starts inside a body.
fn check_particles_outside(checker: &mut Checker<'_>, contact: &ParticleContact, scene: &Scene) {
    let summary = contact.summary(&scene.start.positions);
    if summary.inside > 0 {
        let particle = summary.nearest.map_or(0, |nearest| nearest.particle);
        let of = |panel: &&Panel| panel.particles().contains(&particle);
        let panel = scene.panels.iter().find(of);
        let key = panel.map_or("panel".into(), |panel| place_key(checker, scene, panel));
        let body = summary.nearest.map_or("", |nearest| &contact.bodies()[nearest.body].name);
        let message = format!(
            "{} particles start inside a body (deepest {:.4} m, in {body})",
            summary.inside, -summary.min_distance
        );
        let help = "move or turn the panel so that it starts outside, or let bodies grow with contact.inflate";
        let mistake = checker.fail(&key, message, help);
        if let Some(panel) = panel {
            checker.about(mistake, Subject::Panel(panel.name.clone()));
        }
    }
}

/// Checks that no panel starts inside a body. Of panels that cross no body, one particle tells.
fn check_panels_outside(checker: &mut Checker<'_>, contact: &SurfaceContact, scene: &Scene) {
    for panel in &scene.panels {
        if contact.is_inside_body(panel.first, &scene.start.positions) {
            let message = format!("all of \"{}\" starts inside a body", panel.name);
            let help = "move or turn the panel so that it starts outside";
            let key = place_key(checker, scene, panel);
            let mistake = checker.fail(&key, message, help);
            checker.about(mistake, Subject::Panel(panel.name.clone()));
        }
    }
}
