//! A fit and a simulation without files, which a page in a browser can call.
//!
//! `check.mjs` calls the functions in WebAssembly, and holds the numbers against the program
//! `native`, which calls the same functions on the machine itself.

use std::path::Path;

use drape_dynamics::Simulation;
use drape_fabric::samples::PLAIN_WEAVE;
use drape_fit::identify;
use drape_input::{Document, FileAccess};
use drape_kes::SheetDraft;
use drape_scene::{Scene, read_fabric};

/// Bending cycle of a fabric of 1.2e-5 N·m with friction, as a laboratory exports it.
fn bending_table() -> String {
    let mut table = String::from("Curvature (1/cm),Moment (gf.cm/cm)\n");
    let (mut moment, mut last) = (0.0_f64, 0.0_f64);
    let cycle = (0..=50).chain((-50..50).rev()).chain(-49..=0);
    for curvature in cycle.map(|step| 0.05 * f64::from(step)) {
        // Dahl friction with a plateau of 0.05 gf·cm/cm and a length of 0.04 1/cm.
        let change = curvature - last;
        let plateau = 0.05 * change.signum();
        moment = plateau + (moment - plateau) * (-change.abs() / 0.04).exp();
        last = curvature;
        table += &format!("{curvature:.4},{:.8}\n", 0.12 * curvature + moment);
    }
    table
}

/// Returns the bending rigidity that a fit finds in a laboratory's table, in µN·m.
#[unsafe(no_mangle)]
pub extern "C" fn fitted_rigidity() -> f64 {
    let drafts = SheetDraft::from_bytes("bending-warp.csv", bending_table().as_bytes());
    let sheet = drafts.expect("a table").remove(0).read(Path::new("")).expect("a sheet");
    let fit = identify(&sheet).expect("a law");
    let estimates = fit.curves.iter().flat_map(|curve| &curve.parameters);
    let rigidity = estimates.into_iter().find(|estimate| estimate.name == "rigidity");
    1e6 * rigidity.expect("a rigidity").value
}

/// Returns the height of the lowest particle of a towel that falls on a ball, after `step_count`
/// steps, in mm.
#[unsafe(no_mangle)]
pub extern "C" fn lowest_height(step_count: u32) -> f64 {
    const SCENE: &str = "
        spacing = 0.02
        [fabric.plain]
        file = \"plain.toml\"
        [[panel]]
        name = \"towel\"
        fabric = \"plain\"
        rectangle = [0.3, 0.3]
        turn = [-90, 0, 0]
        center = [0, 0.11, 0]
        [[collider.sphere]]
        radius = 0.1
        [time]
        step = 0.005
        end = 2
    ";
    let access = FileAccess::default().holding("plain.toml", PLAIN_WEAVE.as_bytes());
    let document = Document::new("scene.toml", SCENE).with_access(&access);
    let scene = Scene::from_document(&document, &read_fabric).expect("a scene");
    let mut simulation = Simulation::new(scene).expect("a start");
    for _ in 0..step_count {
        simulation.step().expect("a step");
    }
    let heights = simulation.positions().chunks_exact(3).map(|position| position[1]);
    1e3 * heights.fold(f64::MAX, f64::min)
}
