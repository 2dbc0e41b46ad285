//! Start of a scene: checks that cloth starts outside all bodies, that surfaces start apart, and
//! that layers start in order.

mod apart;
mod bodies;
mod ease_notes;
mod layers;
mod place_key;
pub(crate) mod places;
mod stitches;
mod tangle;

use drape_collide::{ParticleContact, SurfaceContact};
use drape_input::{Advice, Diagnostics, Subject, counted, tidy};

use crate::check::checker::Checker;
use crate::error::{Error, Refused};
use crate::figure::ease::Figures;
use crate::scene::Scene;
use crate::surfaces::StartSurfaces;
use crate::tangle::Tangle;
use crate::wearing::girth::{Girths, girth_note};
use crate::wearing::solids::Solids;

use self::apart::{leave_bodies, part_panels};
use self::bodies::{body_notes, contact_limits};
use self::ease_notes::ease_notes;
use self::layers::check_layers;
use self::place_key::place_key;
use self::places::{PlaceReport, check_places};
use self::stitches::{stitches_through_bodies, stitches_through_panels};
use self::tangle::{Tangled, check_tangle};

/// Checks the start of `scene`, which has no other mistakes. Moves panels by a few millimetres
/// where patterns overlap, and returns `scene` with notes on what was moved and on seams, girths
/// and layers.
///
/// Fails with the mistakes of `checker` together with the refused scene.
pub(crate) fn check_start(
    checker: &mut Checker<'_>,
    mut scene: Scene,
) -> Result<Scene, Box<Refused>> {
    let moved = leave_bodies(&mut scene);
    add_notes(&mut scene, moved);
    let PlaceReport { notes, advised } = check_places(checker, &scene);
    if advised {
        // A garment crosses bodies because its place is wrong. At the advised place it is clear of
        // them, so further mistakes would repeat this one.
        if let Err(mistakes) = checker.finish() {
            return Err(Refused::with(mistakes, scene));
        }
    }

    scene.source.contact_limits = contact_limits(&scene);
    let of_bodies = body_notes(&scene);
    scene.source.notes.extend(of_bodies);
    add_notes(&mut scene, notes);

    // Panels of a pattern that overlap by millimetres are moved apart, and the surfaces are then
    // made again from the new positions.
    let mut surfaces = surfaces(checker, &scene)?;
    let parted = surfaces.as_mut().map(|surfaces| part_panels(&mut scene, surfaces));
    if let Some(moved) = parted.filter(|moved| !moved.is_empty()) {
        add_notes(&mut scene, moved);
        surfaces = self::surfaces(checker, &scene)?;
    }

    // Cloth starts outside all bodies. Growing bodies may still cover some particles of a panel.
    let tangle = surfaces.as_mut().and_then(|surfaces| check_tangle(checker, surfaces, &scene));
    let particles = scene.particle_contact();
    let particles = particles.map_err(|error| mistake(checker, "collider", &error))?;
    match (&surfaces, scene.contact.inflation) {
        (Some(surfaces), Some(_)) => check_panels_outside(checker, &surfaces.contact, &scene),
        _ => check_particles_outside(checker, &particles, &scene),
    }

    // Notes on a tangled start would repeat its mistake in other words.
    if tangle.is_none() {
        let through_bodies = stitches_through_bodies(&scene);
        add_notes(&mut scene, through_bodies);
        let through_panels = stitches_through_panels(&scene);
        scene.source.notes.extend(through_panels);
        let girths = girth_and_ease_notes(&scene);
        add_notes(&mut scene, girths);
        let layers = check_layers(checker, &scene);
        add_notes(&mut scene, layers);
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

/// Adds `notes` without a remedy to the notes on `scene`.
fn add_notes(scene: &mut Scene, notes: Vec<String>) {
    scene.source.notes.extend(notes.into_iter().map(Advice::from));
}

/// Returns notes on garments of `scene` that are narrower than the body that they go round. Only
/// garments that are sewn are measured.
fn girth_and_ease_notes(scene: &Scene) -> Vec<String> {
    if scene.sewing.is_none() {
        return Vec::new();
    }

    let Some(solids) = Solids::new(scene.bodies.iter().map(|moving| &moving.body)) else {
        return Vec::new();
    };

    // Bodies and garments are measured once for both kinds of notes.
    let garments = scene.garments.iter();
    let girths: Vec<Girths<'_>> =
        garments.map(|garment| Girths::new(scene, &solids.outlines, garment)).collect();
    let figures = Figures::new(solids.outlines.clone());

    let tight = girths.iter().filter_map(girth_note);
    let small = girths.iter().flat_map(|girths| ease_notes(girths, &figures));
    tight.chain(small).collect()
}

/// Returns the surfaces of `scene` at its start, or `None` if the scene does not keep surfaces
/// apart. Fails with a mistake at the key `contact.surfaces`.
fn surfaces(
    checker: &mut Checker<'_>,
    scene: &Scene,
) -> Result<Option<StartSurfaces>, Diagnostics> {
    let surfaces = scene.contact.surfaces.then(|| StartSurfaces::new(scene)).transpose();
    surfaces.map_err(|error| mistake(checker, "contact.surfaces", &error))
}

/// Returns `error` as a mistake of the scene at `key`.
fn mistake(checker: &Checker<'_>, key: &str, error: &drape_collide::Error) -> Diagnostics {
    checker.document().at(key, tidy(&error.to_string())).into()
}

/// Checks that no particle of `scene` starts inside a body. Adds one mistake about the deepest
/// particle.
fn check_particles_outside(checker: &mut Checker<'_>, contact: &ParticleContact, scene: &Scene) {
    let summary = contact.summary(&scene.start.positions).expect("a scene has all positions");
    if summary.inside > 0 {
        let particle = summary.nearest.map_or(0, |nearest| nearest.particle);
        let panel = scene.panels.iter().find(|panel| panel.particles().contains(&particle));
        let key = panel.map_or("panel".into(), |panel| place_key(checker, scene, panel));
        let body = summary.nearest.map_or("", |nearest| &contact.bodies()[nearest.body].name);
        let particles = counted(summary.inside, "particle starts", "particles start");
        let message = format!(
            "{particles} inside a body (deepest {:.4} m, in {body})",
            -summary.min_distance
        );

        let help = "move or turn the panel so that it starts outside, or let bodies grow with contact.inflate";
        let mistake = checker.fail(&key, message, help);
        if let Some(panel) = panel {
            checker.about(mistake, Subject::Panel(panel.name.clone()));
        }
    }
}

/// Checks that no panel of `scene` starts inside a body. The surfaces of `contact` do not cross, so
/// the first particle of a panel stands for all of its particles.
fn check_panels_outside(checker: &mut Checker<'_>, contact: &SurfaceContact, scene: &Scene) {
    let firsts: Vec<usize> = scene.panels.iter().map(|panel| panel.first).collect();
    let inspection = contact.inspect(&scene.start.positions);
    let inside = inspection.and_then(|inspection| inspection.are_inside_bodies(&firsts));
    for (panel, is_inside) in scene.panels.iter().zip(inside.unwrap_or_default()) {
        if is_inside {
            let message = format!("all of \"{}\" starts inside a body", panel.name);
            let help = "move or turn the panel so that it starts outside";
            let key = place_key(checker, scene, panel);
            let mistake = checker.fail(&key, message, help);
            checker.about(mistake, Subject::Panel(panel.name.clone()));
        }
    }
}
