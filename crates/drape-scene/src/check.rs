//! Check of a scene: from the content of its file to checked values in SI units.
//!
//! A [`Checker`](self::checker::Checker) has the file and collects its mistakes; every part of a
//! scene has a function that takes the checker and returns the checked value. Values are checked
//! where they enter, once, and mistakes are collected, so that one reading names all that can be
//! found. Panels, times, bodies, contact and pins come first; seams and the start need sound panels
//! and follow only without mistakes. Files are read here, but for fabrics, which the caller's
//! function reads.

pub(crate) mod body;
pub(crate) mod checker;
mod contact;
pub(crate) mod documents;
mod fabrics;
mod garment;
mod hash;
pub(crate) mod memory;
mod motion;
pub(crate) mod panel;
mod pins;
mod solver;
mod start;
pub(crate) mod time;

use std::collections::BTreeSet;

use drape_cloth::{Breen, Cloth};
use drape_collide::MeshInspection;
use drape_input::{Advice, Diagnostics, Faults, excerpt};

use crate::contact_stiffness::max_impact_speed;
use crate::error::Refused;
use crate::scene::garment::Garment;
use crate::scene::material::Material;
use crate::scene::model::Model;
use crate::scene::panel::Panel;
use crate::scene::{
    Environment, MeshSource, MovingBody, Output, Scene, Schedule, Source, Start, View,
};
use crate::spec::SceneSpec;

use self::body::{CheckedBody, MeshFile};
use self::checker::Checker;
use self::checker::ranges::check_ranges;
use self::contact::ContactBounds;
use self::documents::Documents;
use self::garment::cost::cost;
use self::garment::distance::check_distance;
use self::garment::sewing::{frictionless_cloth, sewing_settings};
use self::hash::Content;
use self::panel::PlacedPanel;

/// Checks the content of a scene's file.
pub(crate) fn check(
    documents: &Documents<'_>,
    spec: &SceneSpec,
    faults: Faults,
) -> Result<Scene, Box<Refused>> {
    let document = documents.scene;
    let checker = &mut Checker::new(documents, spec, faults);
    check_ranges(checker);
    let model = spec.model;
    let materials = fabrics::materials(checker, documents.fabrics, model);
    let grading = panel::graded::grading(checker);
    let mut placed = panel::panels(checker, &materials, grading.as_ref());
    let count = placed.iter().map(|placed| placed.positions.len() / 3).sum();
    let plain = placed.len();
    let (mut seams, mut notes, mut garments) = (Vec::new(), Vec::new(), Vec::new());
    for garment in garment::garments(checker, &materials, count, grading.as_ref()) {
        let particles = garment.particles();
        garments.extend(particles.map(|particles| Garment {
            name: garment.name,
            particles,
            measured_heights: garment.measured_heights,
        }));
        placed.extend(garment.panels);
        seams.extend(garment.seams);
        notes.extend(garment.notes.into_iter().map(Advice::from));
    }
    check_names(checker, &placed);
    let clock = time::clock(checker);
    let spacings = placed.iter().flat_map(|placed| placed.panel.lattice.spacing());
    let spacing = spacings.fold(f64::INFINITY, f64::min);
    let relaxation = time::relaxation(checker, spacing.min(1.0));
    time::refinement(checker);
    let motion_seconds = time::motion_seconds(checker);
    let solver = solver::solver(spec);
    let environment = environment(checker);
    let bodies = body::bodies(checker);
    check_distance(checker, &placed[plain..], &bodies);
    let fabrics = || materials.iter().flatten().map(|material| &material.fabric);
    let density = fabrics().map(|fabric| fabric.density).fold(0.0, f64::max);
    let pull = environment.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let bounds = ContactBounds {
        spacing,
        step: clock.step,
        end: clock.end,
        weight: density * pull,
        thickness: fabrics().map(|fabric| fabric.thickness).fold(f64::INFINITY, f64::min),
    };
    let contact = contact::contact(checker, bounds);
    let pins = pins::pins(checker, &placed);
    if spec.keeps_surfaces_apart() {
        let most = fabrics().map(max_impact_speed).fold(f64::INFINITY, f64::min);
        contact::speed::check_speeds(checker, &bodies, &pins, most);
        contact::speed::check_top_speed(checker, most);
    } else if spec.contact.top_speed.is_some() {
        contact::check_surfaces(checker, "contact.top_speed");
    }
    let pins = pins.into_iter().map(|checked| checked.pin).collect();
    let sewing = sewing_settings(checker, seams.is_empty());
    let folder = spec.output.folder.as_ref();
    let folder = folder.and_then(|folder| checker.locate("output.folder", folder));
    // Seams and the start need sound panels.
    checker.finish_parts()?;

    let pairs: Vec<_> = placed
        .iter()
        .map(|PlacedPanel { panel, .. }| {
            let material = materials[panel.material].as_ref();
            (&panel.lattice, &material.expect("mistakes were reported").fabric)
        })
        .collect();
    let sewing = sewing.and_then(|settings| settings.sewing(checker, seams, &pairs));
    let breen = (model == Model::Breen1994).then(|| Breen::new(&pairs)).transpose();
    let breen =
        breen.map_err(|error| Diagnostics::from(document.at("model", error.to_string())))?;
    let cloth = match model {
        Model::Kes => Cloth::new(&pairs),
        Model::Breen1994 => frictionless_cloth(&pairs),
    };
    let ties = sewing.iter().flat_map(|sewing| &sewing.pairs.ties);
    let cloth = cloth.and_then(|cloth| cloth.with_ties(ties));
    let cloth =
        cloth.map_err(|error| Diagnostics::from(document.at("panel", error.to_string())))?;
    let materials: Vec<Material> = materials.into_iter().flatten().collect();
    let positions: Vec<f64> = placed.iter().flat_map(|placed| &placed.positions).copied().collect();
    let velocities = placed.iter().flat_map(|placed| &placed.velocities).copied().collect();
    let panels: Vec<Panel> = placed.into_iter().map(|placed| placed.panel).collect();
    let bodies = with_friction(bodies, &materials);
    let content = Content {
        text: hash::text(spec),
        materials: &materials,
        positions: &positions,
        bodies: &bodies,
        panels: &panels,
        sewing: sewing.as_ref(),
    };
    let source = Source {
        file: document.path().to_owned(),
        hash: content.hash(),
        parts: content.parts(),
        notes,
        contact_limits: Vec::new(),
        graded_by: grading.map(|grading| grading.folder),
    };
    let mut scene = Scene {
        source,
        materials,
        panels,
        garments,
        cloth,
        breen,
        sewing,
        start: Start { positions, velocities },
        pins,
        bodies,
        contact,
        environment,
        schedule: Schedule { clock, relaxation, motion_seconds },
        solver,
        output: Output {
            folder,
            view: View { azimuth: spec.output.azimuth, elevation: spec.output.elevation },
        },
        name: spec.name.clone().unwrap_or_else(|| "unnamed".into()),
        coarser: Vec::new(),
    };
    hold(&mut scene);
    if let Err(mistakes) = checker.finish() {
        return Err(Refused::with(mistakes, scene));
    }
    let mut scene = start::check_start(checker, scene)?;
    let note = scene.stiffness_note();
    scene.source.notes.extend(note.map(Advice::from));
    if !scene.garments.is_empty() && relaxation.is_some() && spec.refine.is_none() {
        let note = cost(scene.cloth.particle_count(), spacing);
        scene.source.notes.extend(note.map(Advice::from));
    }
    Ok(scene)
}

/// Checks that panels are told apart by their names. Names that the scene itself has twice have
/// been reported.
fn check_names(checker: &mut Checker<'_>, placed: &[PlacedPanel]) {
    let spec = checker.spec;
    let mut known_names = BTreeSet::new();
    let names = spec.panel.iter().map(|panel| panel.name.as_str());
    let twice: BTreeSet<&str> = names.filter(|name| !known_names.insert(*name)).collect();
    let mut placed_names = BTreeSet::new();
    for PlacedPanel { panel, .. } in placed {
        let name = panel.name.as_str();
        if !twice.contains(name) && !placed_names.insert(name) {
            let message = format!("there are two panels \"{}\"", excerpt(&panel.name));
            let help =
                "give each its own name; the panels of a garment with a name are called NAME.PANEL";
            checker.fail_file(message, help);
        }
    }
}

/// Returns air and gravity.
fn environment(checker: &Checker<'_>) -> Environment {
    let SceneSpec { gravity, ref air, .. } = *checker.spec;
    Environment { gravity, air: 0.5 * air.density * air.drag }
}

/// Gives bodies without friction of their own the largest friction of a fabric.
fn with_friction(bodies: Vec<CheckedBody>, materials: &[Material]) -> Vec<MovingBody> {
    let fallback = materials.iter().map(|m| m.fabric.surface_friction).fold(0.0, f64::max);
    let with_friction = |CheckedBody { body, friction, motion, file, .. }| {
        let outline = file.and_then(|file| Some((file, body.triangulate().ok()?)));
        MovingBody {
            body: body.with_friction(friction.unwrap_or(fallback)),
            motion,
            source: outline.map(|(MeshFile { path, scale }, outline)| MeshSource {
                file: path,
                scale,
                inspection: MeshInspection::new(&outline),
            }),
        }
    };
    bodies.into_iter().map(with_friction).collect()
}

/// Takes the velocities of particles that are held in all directions.
fn hold(scene: &mut Scene) {
    let held = scene.held_particles();
    let velocities = scene.start.velocities.chunks_exact_mut(3).zip(held);
    velocities.filter(|(_, held)| *held).for_each(|(velocity, _)| velocity.fill(0.0));
}
