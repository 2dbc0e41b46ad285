//! Pins that hold in some directions alone: what is held, what is free, and what that costs.

use drape_dynamics::{Simulation, Status, Summary};
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::{Error, Scene};

use crate::tube;

const FABRIC: &str = samples::PLAIN_WEAVE_WITH_FRICTION;

/// Weight of the band, in N.
const WEIGHT: f64 = 2.0 * 0.16 * 0.04 * 0.15 * 9.81;

/// A band round a post that stands on a plate, whose upper edges are held.
fn band(held: &str) -> Result<Simulation, Error> {
    let pins: String = ["front", "back"]
        .iter()
        .map(|panel| format!("[[pin]]\npanel = \"{panel}\"\nedge = \"top\"\n{held}\n"))
        .collect();
    let text = format!(
        "spacing = 0.01\nfabric.plain.file = \"plain.toml\"\n\
         [[garment]]\npattern = \"band.toml\"\nfabric = \"plain\"\n{pins}\
         [[collider.cylinder]]\nname = \"post\"\nradius = 0.035\nheight = 0.2\nfriction = 0.3\n\
         [[collider.cylinder]]\nname = \"plate\"\nradius = 0.15\nheight = 0.02\ncenter = [0, -0.07, 0]\nfriction = 0.3\n\
         [time]\nstep = 0.005\nend = 20\n[settle]\n"
    );
    let documents =
        [Document::new("plain.toml", FABRIC), Document::new("band.toml", tube(160, 90))];
    let scene = Scene::from_documents(&Document::new("scene.toml", &text), &documents)?;
    Ok(Simulation::new(scene).unwrap())
}

fn run(simulation: &mut Simulation) -> Summary {
    let summary = simulation.run(&mut ()).unwrap();
    assert_eq!(summary.contact.intersections, 0);
    summary
}

/// Least and largest distance of all particles from the axis of the post, in m.
fn radii(simulation: &Simulation) -> [f64; 2] {
    let positions = simulation.positions().to_vec();
    let radii = positions.chunks_exact(3).map(|x| x[0].hypot(x[2]));
    radii.fold([f64::MAX, 0.0], |[low, high], radius| [low.min(radius), high.max(radius)])
}

fn highest(simulation: &Simulation) -> f64 {
    simulation.positions().chunks_exact(3).map(|x| x[1]).fold(f64::MIN, f64::max)
}

#[test]
fn a_band_held_up_and_down_closes_round_a_post_and_hangs_there() {
    let mut simulation = band("axes = [\"y\"]").unwrap();
    let [before, _] = radii(&simulation);
    assert!(before > 0.085, "{before} m");
    let summary = run(&mut simulation);
    assert_eq!(summary.status, Status::Ok, "{:?}", summary.reason);
    let [_, after] = radii(&simulation);
    assert!(after < 0.07, "it has closed to {after} m");
    assert!((highest(&simulation) - 0.04).abs() < 1e-6, "{} m", highest(&simulation));
    // Each of the two bears its half, and nothing across.
    let loads = simulation.pin_loads();
    let borne: f64 = loads.iter().map(|load| load.force[1]).sum();
    assert!((borne / -WEIGHT - 1.0).abs() < 2e-3, "{loads:?} of {WEIGHT} N");
    assert!(loads.iter().all(|load| load.force[0] == 0.0 && load.force[2] == 0.0), "{loads:?}");
    let energy = summary.energy.unwrap();
    assert!(energy.residual.abs() < 1e-9, "{energy:?}");
}

#[test]
fn held_altogether_it_stays_open() {
    let mut simulation = band("").unwrap();
    assert_eq!(run(&mut simulation).status, Status::SeamsOpen);
}

#[test]
fn held_until_it_is_sewn_it_then_falls_on_the_plate() {
    let mut simulation = band("axes = [\"y\"]\nuntil = \"sewn\"").unwrap();
    let mut sewn = f64::NAN;
    while !simulation.step().unwrap().finished {
        match &simulation.summary().phases[..] {
            [_, relax] if simulation.time() > relax.start => {
                assert!(simulation.pin_loads().iter().all(|load| load.force == [0.0; 3]));
            }
            _ => sewn = highest(&simulation),
        }
    }
    let summary = simulation.summary();
    assert_eq!((summary.status, summary.settled), (Status::Ok, true));
    assert!((sewn - 0.04).abs() < 1e-6, "{sewn} m");
    assert!(highest(&simulation) < -0.015, "{} m", highest(&simulation));
    let residual = summary.energy.unwrap().residual;
    assert!(residual.abs() < 1e-9, "{residual} J");
}

/// A sheet of 100 mm × 100 mm in a vacuum that hangs by its upper edge.
fn sheet(more: &str) -> Result<Scene, Error> {
    let text = format!(
        "spacing = 0.02\nair.density = 0\nfabric.plain.file = \"plain.toml\"\n\
         [[panel]]\nname = \"sheet\"\nfabric = \"plain\"\nrectangle = [0.1, 0.1]\n\
         [[pin]]\npanel = \"sheet\"\nedge = \"top\"\n{more}"
    );
    let fabric = Document::new("plain.toml", FABRIC);
    Scene::from_documents(&Document::new("scene.toml", &text), &[fabric])
}

#[test]
fn held_until_rest_it_falls_when_what_follows_begins() {
    let scene = "axes = [\"y\"]\nuntil = \"rest\"\n\
                 [time]\nstep = 0.002\nend = 10\n[settle]\n[motion]\nseconds = 0.1\n";
    let mut simulation = Simulation::new(sheet(scene).unwrap()).unwrap();
    let mut rested = f64::NAN;
    let mut time = f64::NAN;
    loop {
        let step = simulation.step().unwrap();
        if simulation.summary().phases.len() == 1 {
            (rested, time) = (highest(&simulation), step.time);
        }
        if step.finished {
            break;
        }
    }
    assert!((rested - 0.05).abs() < 1e-6, "{rested} m");
    let fallen = rested - highest(&simulation);
    let seconds = simulation.time() - time;
    let free = 0.5 * 9.81 * 0.1 * 0.1;
    assert!((fallen / free - 1.0).abs() < 0.06, "{fallen} m and {free} m in {seconds} s");
    assert!(simulation.energy().unwrap().residual.abs() < 1e-9);
}

#[test]
fn lifting_by_springs_does_the_work_of_lifting_by_hand() {
    let lifted = |axes: &str| {
        let scene = format!(
            "{axes}\n[pin.motion]\ntimes = [0, 0.4]\nshift = [[0, 0, 0], [0, 0.05, 0]]\n\
             [time]\nstep = 0.001\nend = 0.4\n[solver]\ntolerance = 1e-7\n"
        );
        let mut simulation = Simulation::new(sheet(&scene).unwrap()).unwrap();
        let summary = run(&mut simulation);
        let energy = summary.energy.unwrap();
        assert!(energy.residual.abs() < 1e-9, "{energy:?}");
        (energy.work_in, simulation.pin_loads()[0].force[1])
    };
    let (hand, spring) = (lifted(""), lifted("axes = [\"x\", \"y\"]"));
    assert!(hand.0 > 0.9 * 0.1 * 0.1 * 0.15 * 9.81 * 0.05, "{hand:?}");
    assert!((spring.0 / hand.0 - 1.0).abs() < 2e-3, "{spring:?} J and N by springs, {hand:?}");
}

#[test]
fn a_pin_that_holds_wrongly_is_refused_at_its_line() {
    let time = "[time]\nstep = 0.002\nend = 1\n";
    for (wrong, place, said) in [
        ("axes = [\"w\"]", "scene.toml:11", "there is no \"w\""),
        ("axes = []", "scene.toml:11", "in no direction"),
        ("until = \"sow\"", "scene.toml:11", "there is no \"sow\""),
        ("until = \"rest\"", "scene.toml:11", "add [motion]"),
    ] {
        let message = sheet(&format!("{wrong}\n{time}")).unwrap_err().to_string();
        assert!(message.contains(place) && message.contains(said), "{wrong}: {message}");
    }
}
