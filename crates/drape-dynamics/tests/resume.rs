//! Simulations that go on from a checkpoint: every number is what it would have been.

#![allow(clippy::unwrap_used, dead_code)]

#[path = "motion/sheet.rs"]
mod sheet;

use drape_checkpoint::{Checkpoint, Identity};
use drape_dynamics::{Energy, Error, Progress, SavedSimulation, Simulation, Summary};
use drape_frames::Frame;
use drape_input::Document;
use drape_scene::Scene;

use sheet::{FLAT, Sheet};

/// Watcher that keeps a checkpoint in bytes after every so many steps, and all frames.
#[derive(Default)]
struct Keeper {
    every: usize,
    steps: usize,
    kept: Vec<Kept>,
    frames: Vec<(Frame, Option<Energy>)>,
}

/// Checkpoint with the frames that it counts.
#[derive(Clone)]
struct Kept {
    bytes: Vec<u8>,
    frames: usize,
}

impl Progress for Keeper {
    fn step(&mut self, _: &drape_dynamics::Step, _: usize) {
        self.steps += 1;
    }

    fn frame(&mut self, frame: &Frame, energy: Option<&Energy>) -> Result<(), Error> {
        self.frames.push((frame.clone(), energy.copied()));
        Ok(())
    }

    fn is_checkpoint_due(&self) -> bool {
        self.every > 0 && self.steps.is_multiple_of(self.every)
    }

    fn checkpoint(&mut self, saved: &SavedSimulation) -> Result<(), Error> {
        let mut checkpoint = Checkpoint::new(Identity::new("test"));
        saved.write(&mut checkpoint)?;
        let mut bytes = Vec::new();
        checkpoint.encode(&mut bytes).unwrap();
        self.kept.push(Kept { bytes, frames: saved.frame_count() });
        Ok(())
    }
}

fn saved(kept: &Kept) -> SavedSimulation {
    SavedSimulation::read(&Checkpoint::decode(&kept.bytes).unwrap()).unwrap()
}

/// Text of a summary without its times.
fn told(summary: &Summary) -> String {
    format!("{:?}", Summary { wall_seconds: 0.0, cpu_seconds: None, ..summary.clone() })
}

/// Runs a scene without checkpoints, with one after every so many steps, and from each of these to
/// the end: all must be the same.
fn goes_on(scene: impl Fn() -> Scene, every: usize) {
    let mut plain = Keeper::default();
    let whole = Simulation::new(scene()).unwrap().run(&mut plain).unwrap();
    let mut keeper = Keeper { every, ..Keeper::default() };
    let with_checkpoints = Simulation::new(scene()).unwrap().run(&mut keeper).unwrap();
    assert_eq!(told(&whole), told(&with_checkpoints), "checkpoints change a run");
    assert!(keeper.kept.len() > 3, "{} checkpoints of {} steps", keeper.kept.len(), whole.steps);
    for kept in &keeper.kept {
        let mut resumed = Simulation::new(scene()).unwrap();
        resumed.resume(saved(kept)).unwrap();
        let at = resumed.time();
        let mut rest = Keeper::default();
        let summary = resumed.run(&mut rest).unwrap();
        assert_eq!(told(&whole), told(&summary), "resumed at {at} s");
        assert!(rest.frames == plain.frames[kept.frames..], "frames after {at} s");
    }
}

const BALL: &str = "[[collider.sphere]]\nradius = 0.08\ncenter = [0, -0.1, 0]\nfriction = 0.4\n";

fn over_a_ball(scene: &str, panel: &str) -> Scene {
    let scene = format!("{scene}{BALL}");
    let panel = format!("{FLAT}noise = {{ amplitude = 1e-4, seed = 1 }}\n{panel}");
    Sheet { particles: 15, side: 0.28, scene, panel, ..Sheet::default() }.scene()
}

#[test]
fn a_stack_with_friction_goes_on_to_the_same_bits() {
    let scene =
        "contact.surfaces = true\noutput.every = 0.02\ntime = { step = 0.004, end = 0.16 }\n";
    let stack = "stack = { count = 2, step = [0, 0.004, 0], turn = [0, 15, 0] }\n";
    goes_on(|| over_a_ball(scene, stack), 7);
}

#[test]
fn steps_of_a_chosen_error_go_on_to_the_same_bits() {
    let scene = "contact.surfaces = true\ntime = { step = 0.004, end = 0.12, error = 1e-4, step_max = 0.008 }\n";
    goes_on(|| over_a_ball(scene, ""), 5);
}

#[test]
fn particles_on_a_body_that_moves_go_on_to_the_same_bits() {
    let scene = "contact.surfaces = false\ntime = { step = 0.004, end = 0.16 }\n";
    let motion = "[collider.sphere.motion]\ntimes = [0, 0.2]\nturn = [[0, 0, 0], [0, 90, 0]]\n";
    let scene = format!("{scene}{BALL}{motion}");
    let panel = format!("{FLAT}noise = {{ amplitude = 1e-4, seed = 1 }}\n");
    let sheet = Sheet { particles: 15, side: 0.28, scene, panel, ..Sheet::default() };
    goes_on(|| sheet.scene(), 6);
}

#[test]
fn breens_particles_go_on_to_the_same_bits() {
    let scene =
        "model = \"breen-1994\"\ncontact.surfaces = false\ntime = { step = 0.004, end = 0.2 }\n";
    goes_on(|| over_a_ball(scene, ""), 9);
}

#[test]
fn rest_and_the_motion_after_it_go_on_to_the_same_bits() {
    let scene = "contact.surfaces = true\ntime = { step = 0.005, end = 20 }\n[settle]\nspeed = 0.01\nresidual = 0.01\n[motion]\nseconds = 0.05\n";
    goes_on(|| over_a_ball(scene, ""), 23);
}

/// Watcher that notes on which grids steps are made.
#[derive(Default)]
struct Grids(Vec<Option<f64>>);

impl Progress for Grids {
    fn step(&mut self, step: &drape_dynamics::Step, _: usize) {
        if self.0.last() != Some(&step.coarser_grid) {
            self.0.push(step.coarser_grid);
        }
    }
}

/// Scene that comes to rest over a ball on coarser grids first.
fn refined(contact: &str, spacings: &str) -> Scene {
    let scene = format!(
        "contact = {{ surfaces = true{contact} }}\ntime = {{ step = 0.005, end = 20 }}\n\
         settle = {{ speed = 0.02, residual = 0.02 }}\nrefine.spacings = {spacings}\n"
    );
    over_a_ball(&scene, "")
}

#[test]
fn cloth_carried_from_coarser_grids_goes_on_to_the_same_bits() {
    let scene = || refined(", offset = 0.003", "[0.04, 0.03]");
    let mut grids = Grids::default();
    let summary = Simulation::new(scene()).unwrap().run(&mut grids).unwrap();
    let [coarse, middle] = &summary.coarser_grids[..] else { panic!("{summary:?}") };
    assert!(coarse.carried && middle.carried && summary.settled, "{summary:?}");
    assert!(middle.end > coarse.end && summary.simulated_seconds > middle.end);
    let passed: Vec<_> = grids.0.iter().map(|own| own.map(|own| (1e3 * own).round())).collect();
    assert_eq!(passed, [Some(40.0), Some(31.0), None]);
    // No frame is of a coarser grid.
    assert!(summary.frame_times[0] >= middle.end);
    goes_on(scene, 11);
}

#[test]
fn a_run_that_is_interrupted_on_a_coarser_grid_has_a_frame_and_goes_on() {
    /// Watcher that ends a run after three steps.
    #[derive(Default)]
    struct Interrupter(Keeper);

    impl Progress for Interrupter {
        fn step(&mut self, step: &drape_dynamics::Step, ticks: usize) {
            self.0.step(step, ticks);
        }

        fn frame(&mut self, frame: &Frame, energy: Option<&Energy>) -> Result<(), Error> {
            self.0.frame(frame, energy)
        }

        fn checkpoint(&mut self, saved: &SavedSimulation) -> Result<(), Error> {
            self.0.checkpoint(saved)
        }

        fn is_interrupted(&self) -> bool {
            self.0.steps == 3
        }
    }

    let scene = || refined(", offset = 0.003", "[0.03]");
    let whole = Simulation::new(scene()).unwrap().run(&mut ()).unwrap();
    let mut watcher = Interrupter::default();
    let interrupted = Simulation::new(scene()).unwrap().run(&mut watcher).unwrap();
    assert_eq!(interrupted.status, drape_dynamics::Status::Interrupted);
    assert_eq!((interrupted.frames, watcher.0.frames.len()), (1, 1));
    let mut resumed = Simulation::new(scene()).unwrap();
    resumed.resume(saved(&watcher.0.kept[0])).unwrap();
    assert_eq!(told(&whole), told(&resumed.run(&mut ()).unwrap()));
}

#[test]
fn a_run_whose_time_is_over_on_a_coarser_grid_ends_there() {
    let mut scene = refined(", offset = 0.003", "[0.03]");
    scene.schedule.clock.end = 0.02;
    let summary = Simulation::new(scene).unwrap().run(&mut ()).unwrap();
    assert_eq!(summary.status, drape_dynamics::Status::DidNotSettle);
    assert_eq!((summary.frames, summary.steps, summary.simulated_seconds), (1, 0, 0.02));
}

#[test]
fn what_moves_after_rest_moves_on_the_last_grid() {
    let motion = "[motion]\nseconds = 0.05\n";
    let scene = format!(
        "contact = {{ surfaces = true, offset = 0.003 }}\ntime = {{ step = 0.005, end = 20 }}\n\
         settle = {{ speed = 0.02, residual = 0.02 }}\nrefine.spacings = [0.03]\n{motion}"
    );
    let scene = || over_a_ball(&scene, "");
    let summary = Simulation::new(scene()).unwrap().run(&mut ()).unwrap();
    let names: Vec<_> = summary.phases.iter().map(|phase| format!("{:?}", phase.name)).collect();
    assert_eq!(names, ["Relax", "Simulate"]);
    let [rest, motion] = &summary.phases[..] else { panic!("{summary:?}") };
    assert!(summary.coarser_grids[0].carried && rest.start == summary.coarser_grids[0].end);
    assert!((summary.simulated_seconds - motion.start - 0.05).abs() < 1e-9, "{summary:?}");
    goes_on(scene, 13);
}

#[test]
fn cloth_that_intersects_in_few_places_on_the_next_grid_is_carried_untangled() {
    // The grid is as coarse as the ball, whose triangles are finer.
    let scene = || refined("", "[0.07, 0.03]");
    let summary = Simulation::new(scene()).unwrap().run(&mut ()).unwrap();
    assert!(summary.coarser_grids.iter().all(|own| own.carried) && summary.settled, "{summary:?}");
    assert!(summary.warnings[0].contains("are displaced by up to"), "{:?}", summary.warnings);
    assert!(summary.frame_times[0] > 0.0 && summary.contact.intersections == 0);
    goes_on(scene, 17);
}

const FABRIC: &str = r#"name = "plain"
density = 0.15
thickness = 0.0003
shear = { stiffness = 35.0, friction = [{ plateau = 0.4, length = 0.004 }] }
[warp]
traction.primed = { stiffness = 5000.0, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending = { rigidity = 1.2e-5, friction = [{ plateau = 1e-4, length = 4.0 }] }
[weft]
traction.primed = { stiffness = 4000.0, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
bending = { rigidity = 0.8e-5, friction = [{ plateau = 1e-4, length = 4.0 }] }
"#;

/// A tube of two halves that is sewn round a post, becomes heavy and comes to rest on a plate.
fn tube() -> Scene {
    let half = |name: &str, z: &str, turn: &str| {
        format!(
            "[panel.{name}]\ngrain = 0\nstart = [-90, 0]\noutline = [\n{{ name = \"bottom\", to = [90, 0] }},\n\
             {{ name = \"a\", to = [90, 40] }},\n{{ name = \"top\", to = [-90, 40] }},\n{{ name = \"b\", to = [-90, 0] }},\n]\n\
             origin = [0, 0, {z}]\n{turn}wrap = 80\n"
        )
    };
    let pattern = format!(
        "length = \"mm\"\n{}{}[seam.left]\nsides = [[\"front.a\"], [\"back.b\"]]\n\
         [seam.right]\nsides = [[\"back.a\"], [\"front.b\"]]\n",
        half("front", "80", ""),
        half("back", "-80", "turn = [0, 180, 0]\n")
    );
    let text = "spacing = 0.01\nfabric.plain.file = \"plain.toml\"\n\
         [[garment]]\nname = \"tube\"\npattern = \"tube.toml\"\nfabric = \"plain\"\n\
         [[collider.cylinder]]\nname = \"post\"\nradius = 0.03\nheight = 0.2\nfriction = 0.3\n\
         [[collider.cylinder]]\nname = \"plate\"\nradius = 0.15\nheight = 0.02\ncenter = [0, -0.12, 0]\nfriction = 0.3\n\
         [time]\nstep = 0.005\nend = 20\nramp = 0.3\n[settle]\nspeed = 0.01\nresidual = 0.01\n";
    let documents = [Document::new("plain.toml", FABRIC), Document::new("tube.toml", pattern)];
    Scene::from_documents(&Document::new("scene.toml", text), &documents).unwrap()
}

#[test]
fn a_garment_goes_on_while_it_is_sewn_and_after() {
    goes_on(tube, 19);
}

#[test]
fn a_checkpoint_of_another_scene_is_refused() {
    let scene = "contact.surfaces = true\ntime = { step = 0.004, end = 0.02 }\n";
    let mut keeper = Keeper { every: 2, ..Keeper::default() };
    Simulation::new(over_a_ball(scene, "")).unwrap().run(&mut keeper).unwrap();
    let kept = &keeper.kept[0];
    let particles = "contact.surfaces = false\ntime = { step = 0.004, end = 0.02 }\n";
    let stack = "stack = { count = 2, step = [0, 0.004, 0] }\n";
    for other in [over_a_ball(particles, ""), over_a_ball(scene, stack), tube()] {
        let refused = Simulation::new(other).unwrap().resume(saved(kept)).unwrap_err();
        assert!(matches!(refused, Error::Unfit { .. }), "{refused}");
    }
}

#[test]
fn a_run_goes_on_beyond_its_end_as_a_longer_one() {
    let until = |end: &str| {
        over_a_ball(
            &format!("contact.surfaces = true\ntime = {{ step = 0.004, end = {end} }}\n"),
            "",
        )
    };
    let hashed = |end: &str| {
        let mut simulation = Simulation::new(until(end)).unwrap();
        simulation.hash_steps();
        simulation
    };
    let longer = hashed("0.12").run(&mut ()).unwrap();
    let mut shorter = hashed("0.08");
    let ended = shorter.run(&mut ()).unwrap();
    let resumed = || {
        let mut simulation = Simulation::new(until("0.08")).unwrap();
        simulation.resume(shorter.saved()).unwrap();
        simulation
    };
    // From its end no step is left.
    let again = resumed().run(&mut ()).unwrap();
    assert_eq!((again.steps, again.state_hash), (ended.steps, ended.state_hash));
    assert!(again.wall_seconds > ended.wall_seconds && ended.wall_seconds > 0.0);
    assert!(
        cfg!(not(unix)) || (again.cpu_seconds > ended.cpu_seconds && ended.cpu_seconds > Some(0.0))
    );
    let mut extended = resumed();
    for wrong in [f64::NAN, 0.0, -1.0, 1e20, f64::INFINITY] {
        let error = extended.extend(wrong).expect_err("no time to go on for");
        assert!(error.to_string().contains("up to an end at 100000 s"), "{error}");
    }
    assert!(extended.extend(0.04).expect("a time"));
    let extended = extended.run(&mut ()).unwrap();
    assert_eq!(extended.state_hash, longer.state_hash);
    assert_eq!(extended.step_hashes, longer.step_hashes);
    let hashes = extended.step_hashes.unwrap();
    assert_eq!((hashes.steps, hashes.hashes.len()), (longer.steps, longer.steps));
}
