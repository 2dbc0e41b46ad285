//! Safeguards of contact, taken away one by one: what is missing shows in the run or in its frames.

use std::path::Path;

use drape_frames::{Frame, Recording};
use drape_implicit::Settings;
use drape_input::Document;
use drape_scene::Scene;
use drape_verify::{Verdict, Verifier};

use crate::error::Error;
use crate::record::summary::{Contacts, Status};
use crate::simulation::Simulation;
use crate::simulation::run::Progress;
use crate::stepping::Scheme;
use crate::world::world_tests::FABRIC;
use crate::world::{Energy, Omitted};

/// A slanting sheet that goes 60 mm in a step, towards a plate of a millimetre.
const THROWN: &str = r#"spacing = 0.01
gravity = [0, 0, 0]
air.density = 0.0
fabric.plain.file = "plain.toml"
[[panel]]
name = "sheet"
fabric = "plain"
rectangle = [0.1, 0.1]
turn = [-65, 10, 0]
velocity = [0, -12, 0]
noise = { amplitude = 1e-4, seed = 1 }
[[collider.box]]
name = "plate"
size = [0.3, 0.001, 0.3]
center = [0, -0.04, 0]
[time]
step = 0.005
end = 0.015
[output]
every = 0.005
"#;

/// How a run ended, and what its frames show to a program that shares no code with it.
#[derive(Debug)]
struct End {
    status: Status,
    contact: Contacts,
    intersections: usize,
    too_near: usize,
    /// Exempt intersections of the last frame, and the deepest of all frames, in m.
    exempt: usize,
    exempt_penetration: f64,
}

struct Film(Vec<Frame>);

impl Progress for Film {
    fn frame(&mut self, frame: &Frame, _: Option<&Energy>) -> Result<(), Error> {
        self.0.push(frame.clone());
        Ok(())
    }
}

fn run(text: &str, omitted: Omitted, stiffness: Option<f64>) -> End {
    run_in(Path::new(""), text, omitted, stiffness)
}

/// Runs a scene as if it were in a folder.
fn run_in(folder: &Path, text: &str, omitted: Omitted, stiffness: Option<f64>) -> End {
    let fabric = Document::new(folder.join("plain.toml"), FABRIC);
    let scene = Document::new(folder.join("scene.toml"), text);
    let scene = Scene::from_documents(&scene, &[fabric]);
    let mut scene = scene.expect("a right scene");
    scene.contact.stiffness = stiffness.or(scene.contact.stiffness);
    let mut simulation = Simulation::new(scene).expect("a solver");
    simulation.world.contact.surfaces_mut().expect("surfaces").omitted = omitted;
    let (manifest, topology) = (simulation.manifest(), simulation.topology());
    let mut film = Film(Vec::new());
    let summary = simulation.run(&mut film).expect("frames are kept");
    let recording = Recording::of_frames(manifest, topology, film.0).expect("a run");
    let verifier = Verifier::new(recording);
    let frames = 0..verifier.recording().frame_count();
    let verdicts = frames.map(|number| verifier.verify(number).expect("a frame"));
    let verdicts: Vec<Verdict> = verdicts.collect();
    End {
        status: summary.status,
        contact: summary.contact,
        intersections: verdicts.iter().map(|verdict| verdict.intersections).sum(),
        too_near: verdicts.iter().map(|verdict| verdict.too_near).sum(),
        exempt: verdicts.last().expect("a frame").exempt,
        exempt_penetration: verdicts
            .iter()
            .map(|verdict| verdict.exempt_penetration)
            .fold(0.0, f64::max),
    }
}

/// Whatever happened, the frames are sound.
fn holds(end: &End) {
    assert_eq!([end.intersections, end.too_near], [0, 0], "{end:?}");
}

#[test]
fn with_all_of_it_no_step_crosses() {
    let end = run(THROWN, Omitted::default(), None);
    holds(&end);
    assert!(end.status == Status::Ok && end.contact.pairs_max > 0, "{end:?}");
    assert_eq!((end.contact.intersections_found, end.contact.intersections), (0, 0));
}

#[test]
fn without_the_filter_steps_cross_and_are_taken_back() {
    let end = run(THROWN, Omitted { step_filter: true, ..Omitted::default() }, None);
    holds(&end);
    assert!(end.contact.intersections_found > 0, "{end:?}");
    // What takes them back is the exact test and nothing else.
    let end = run(
        THROWN,
        Omitted { step_filter: true, intersection_test: true, ..Omitted::default() },
        None,
    );
    assert!(end.intersections > 0, "{end:?}");
}

#[test]
fn without_a_barrier_pairs_freeze() {
    let end = run(THROWN, Omitted::default(), Some(1e-30));
    holds(&end);
    assert_eq!(end.status, Status::SolverFailed, "{end:?}");
    assert_eq!(end.contact.intersections_found, 0, "{end:?}");
}

/// Runs the shipped skirt with a coarse spacing, in m, until a time, in s.
fn run_skirt(spacing: &str, seconds: &str, omitted: Omitted) -> End {
    let scenes = Path::new("../../scenes");
    let skirt = std::fs::read_to_string(scenes.join("skirt.toml")).expect("a scene");
    let skirt = skirt
        .replace("spacing = 0.01", &format!("spacing = {spacing}"))
        .replace("../fabrics/matsudaira-b/sheet.toml", "plain.toml")
        .replace("end = 60", &format!("end = {seconds}\n[output]\nevery = 0.05"));
    run_in(scenes, &skirt, omitted, None)
}

#[test]
fn sides_of_a_seam_that_are_exempt_before_they_meet_cross() {
    holds(&run_skirt("0.045", "1.1", Omitted::default()));
    let end = run_skirt("0.045", "1.1", Omitted { open_seams: true, ..Omitted::default() });
    assert!(end.intersections > 0, "{end:?}");
}

#[test]
fn intersections_of_a_seam_that_closes_are_counted_until_it_is_merged() {
    // Its seams are closed, and are not merged yet.
    let before = run_skirt("0.031", "1.07", Omitted::default());
    holds(&before);
    let contact = before.contact;
    assert!(before.exempt > 0 && contact.exempt > 0, "{before:?}");
    assert!((1e-6..1e-4).contains(&before.exempt_penetration), "{before:?}");
    assert!(
        (contact.exempt_penetration_max - before.exempt_penetration).abs() < 1e-9,
        "{before:?}"
    );
    let sewn = run_skirt("0.031", "1.2", Omitted::default());
    assert!(sewn.contact.exempt_max >= contact.exempt_max, "{sewn:?}");
    assert_eq!((sewn.contact.exempt, sewn.exempt), (0, 0), "{sewn:?}");
}

/// A sheet that a plate lifts by 20 mm.
const LIFTED: &str = r#"spacing = 0.01
air.density = 0.0
fabric.plain.file = "plain.toml"
[[panel]]
name = "sheet"
fabric = "plain"
rectangle = [0.1, 0.1]
turn = [-90, 0, 0]
center = [0, 0.0009, 0]
[[collider.box]]
name = "plate"
size = [0.3, 0.02, 0.3]
center = [0, -0.01, 0]
[collider.box.motion]
times = [0, 0.1]
shift = [[0, 0, 0], [0, 0.02, 0]]
[time]
step = 0.002
end = 0.1
"#;

#[test]
fn the_balance_opens_without_the_work_of_a_body_that_moves() {
    let open = |omitted: Omitted| {
        let fabric = Document::new("plain.toml", FABRIC);
        let scene = Scene::from_documents(&Document::new("scene.toml", LIFTED), &[fabric]);
        let scene = scene.expect("a right scene");
        // Every sub-step, not a sample.
        let settings = Settings { tolerance: 1e-6, energy_balance: true, ..Settings::default() };
        let simulation = Simulation::with_scheme(scene, Scheme::Implicit(settings));
        let mut simulation = simulation.expect("a solver");
        simulation.world.contact.surfaces_mut().expect("surfaces").omitted = omitted;
        let summary = simulation.run(&mut ()).expect("nothing is written");
        let energy = summary.energy.expect("a balance");
        assert!(energy.gravity > 2e-4 && energy.unproved == 0.0, "{energy:?}");
        ((energy.residual / energy.gravity).abs(), summary.status, summary.warnings)
    };
    let (right, status, warnings) = open(Omitted::default());
    assert!(right < 1e-6 && status == Status::Ok && warnings.is_empty(), "{right:e} is open");
    let (wrong, status, warnings) = open(Omitted { body_work: true, ..Omitted::default() });
    assert!(wrong > 0.9 && status == Status::Unbalanced, "{wrong:e} is open, {status:?}");
    assert!(warnings.iter().any(|warning| warning.contains("unaccounted for")), "{warnings:?}");
}
