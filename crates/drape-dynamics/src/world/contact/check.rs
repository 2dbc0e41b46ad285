//! What keeps surfaces apart, taken away part by part: what is missing shows in the run or in its
//! frames.

use drape_collide::Guards;
use drape_input::Document;
use drape_scene::Scene;
use drape_verify::Recording;

use crate::error::Error;
use crate::record::frame::Frame;
use crate::record::recorder::{Recorder, prepare_folder};
use crate::record::summary::{Contacts, Status};
use crate::simulation::{Progress, Simulation};
use crate::world::check::FABRIC;

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
}

struct Film<'a>(Recorder<'a>);

impl Progress for Film<'_> {
    fn frame(&mut self, frame: &Frame) -> Result<(), Error> {
        self.0.frame(frame)
    }
}

fn run(text: &str, take: impl FnOnce(&mut Guards)) -> End {
    let fabric = Document::new("plain.toml", FABRIC);
    let scene = Scene::from_documents(&Document::new("scene.toml", text), &[fabric]);
    let mut simulation = Simulation::new(scene.expect("a right scene")).expect("a solver");
    take(simulation.world.contact.surfaces_mut().expect("surfaces").contact.guards());
    let folder = tempfile::tempdir().expect("a folder");
    let output = prepare_folder(folder.path(), false).expect("an empty folder");
    let mut film = Film(output.record(simulation.topology()).expect("it can be written"));
    let summary = simulation.run(&mut film).expect("frames can be written");
    let recording = Recording::open(folder.path()).expect("a run");
    let verdicts = (0..recording.frames()).map(|number| recording.verify(number).expect("a frame"));
    let sums = verdicts.fold([0; 2], |[met, near], verdict| {
        [met + verdict.intersections, near + verdict.too_near]
    });
    let (status, contact) = (summary.status, summary.contact);
    End { status, contact, intersections: sums[0], too_near: sums[1] }
}

/// Whatever happened, the frames are sound.
fn holds(end: &End) {
    assert_eq!([end.intersections, end.too_near], [0, 0], "{end:?}");
}

#[test]
fn with_all_of_it_no_step_crosses() {
    let end = run(THROWN, |_| {});
    holds(&end);
    assert!(end.status == Status::Ok && end.contact.pairs_max > 0, "{end:?}");
    assert_eq!((end.contact.intersections_found, end.contact.intersections), (0, 0));
}

#[test]
fn without_the_filter_steps_cross_and_are_taken_back() {
    let end = run(THROWN, |guards| guards.filter = false);
    holds(&end);
    assert!(end.contact.intersections_found > 0, "{end:?}");
    // What takes them back is the exact test and nothing else.
    let end = run(THROWN, |guards| (guards.filter, guards.exact) = (false, false));
    assert!(end.intersections > 0, "{end:?}");
}

#[test]
fn pairs_that_are_too_old_stop_a_run_or_let_surfaces_cross() {
    let end = run(THROWN, |guards| guards.cover = false);
    holds(&end);
    assert_eq!(end.status, Status::SolverFailed, "{end:?}");
    let end = run(THROWN, |guards| (guards.cover, guards.budget) = (false, false));
    holds(&end);
    assert!(end.contact.intersections_found > 0, "{end:?}");
    let end = run(THROWN, |guards| {
        (guards.cover, guards.budget, guards.exact) = (false, false, false);
    });
    assert!(end.intersections > 0, "{end:?}");
}

#[test]
fn without_the_barrier_pairs_freeze_or_cross() {
    let end = run(THROWN, |guards| guards.barrier = false);
    holds(&end);
    assert_eq!(end.status, Status::SolverFailed, "{end:?}");
    assert_eq!(end.contact.intersections_found, 0, "{end:?}");
    // The barrier keeps pairs from ever being so near that they freeze.
    let end = run(THROWN, |guards| (guards.barrier, guards.freeze) = (false, false));
    holds(&end);
    assert_eq!(end.status, Status::Intersecting, "{end:?}");
    let end = run(THROWN, |guards| {
        (guards.barrier, guards.freeze, guards.exact) = (false, false, false);
    });
    assert!(end.intersections > 0, "{end:?}");
}
