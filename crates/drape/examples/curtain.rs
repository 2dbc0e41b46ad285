//! From a measured fabric to hanging cloth: fits the cupro, hangs a small curtain of it by two
//! corners that are nearer to each other than the curtain is wide, and prints how it drapes. The
//! scene is built without a file:
//! `cargo run --release --example curtain`.

#![expect(clippy::print_stdout, reason = "an example prints its result")]

use std::sync::Arc;

use drape::dynamics::Simulation;
use drape::fit::identify;
use drape::kes::Sheet;
use drape::scene::{
    FabricSpec, FileOr, MotionSpec, NoiseSpec, PanelSpec, PinSpec, SceneSpec, SettleSpec, TimeSpec,
};

/// Width of the curtain, and the part of it that is left between the corners, in m.
const WIDTH: f64 = 0.3;
const SPAN: f64 = 0.2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sheet = Sheet::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fabrics/cupro-weave"))?;
    let fit = identify(&sheet)?;

    let mut spec = SceneSpec {
        spacing: 0.02,
        time: TimeSpec { step: 0.01, end: 20.0, ..TimeSpec::default() },
        settle: Some(SettleSpec { speed: 0.005, ..SettleSpec::default() }),
        ..SceneSpec::default()
    };
    let file = FileOr::Value(Arc::new(fit.fabric.clone()));
    spec.fabric.insert("cupro".into(), FabricSpec { file, ..FabricSpec::default() });
    spec.panel.push(PanelSpec {
        name: "curtain".into(),
        fabric: "cupro".into(),
        rectangle: Some([WIDTH, WIDTH]),
        noise: Some(NoiseSpec { amplitude: 1e-3, length: Some(0.05), seed: 1 }),
        ..PanelSpec::default()
    });
    let corner =
        |x| PinSpec { panel: "curtain".into(), points: vec![[x, WIDTH]], ..PinSpec::default() };
    let nearer = MotionSpec {
        times: vec![0.0, 1.0],
        shift: vec![[0.0; 3], [SPAN - WIDTH, 0.0, 0.0]],
        ..MotionSpec::default()
    };
    spec.pin = vec![corner(0.0), PinSpec { motion: Some(nearer), ..corner(WIDTH) }];

    let scene = spec.build()?;
    let mut simulation = Simulation::new(scene)?;
    while !simulation.step()?.finished {}

    // Heights of the upper edge, below the corners.
    let particles = simulation.positions().as_chunks::<3>().0;
    let top = simulation.coordinates().iter().map(|[_, v]| *v).fold(f64::MIN, f64::max);
    let upper = simulation.coordinates().iter().zip(particles);
    let upper = upper.filter(|([_, v], _)| top - v < 1e-9);
    let heights: Vec<f64> = upper.map(|(_, [_, y, _])| *y).collect();
    let highest = heights.iter().copied().fold(f64::MIN, f64::max);
    let sag = highest - heights.iter().copied().fold(f64::MAX, f64::min);
    let depths = particles.iter().map(|[.., z]| *z);
    let depth = depths.clone().fold(f64::MIN, f64::max) - depths.fold(f64::MAX, f64::min);
    println!(
        "{}: at rest after {:.2} s, the upper edge sags by {:.1} mm, folds are {:.1} mm deep",
        fit.fabric.name,
        simulation.time(),
        1e3 * sag,
        1e3 * depth
    );
    // An edge that does not stretch sags at most as two straight halves do.
    let straight = (0.25 * (WIDTH * WIDTH - SPAN * SPAN)).sqrt();
    assert!(sag > 0.5 * straight && sag < 1.02 * straight, "{sag} m, of {straight} m at most");
    assert!(depth > 0.01, "the curtain hangs in a fold, not flat: {depth} m");
    Ok(())
}
