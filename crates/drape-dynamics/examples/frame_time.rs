//! Measures the processor time of a frame of 1/60 s for a sheet of 2 500 particles that swings onto
//! a sphere, in the usual setting and in the fast setting, with and without contact of surfaces.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release --example frame_time -- 60` measures 60 frames on one
//! thread. Without a number the example makes two frames of each.

use drape_dynamics::Simulation;
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

/// Sheet of 98 cm × 98 cm that is held at one edge, and a sphere below it.
const SCENE: &str = r#"
spacing = 0.02
fabric.plain.file = "heavy.toml"
[[panel]]
name = "sheet"
fabric = "plain"
rectangle = [0.98, 0.98]
turn = [-90, 0, 0]
[[pin]]
panel = "sheet"
edge = "top"
[[collider.sphere]]
name = "ball"
radius = 0.2
center = [0, -0.4, 0]
friction = 0.3
"#;

/// Setting of a scene.
struct Setting {
    name: &'static str,
    /// Number of steps in a frame.
    steps: usize,
    keys: &'static str,
}

/// Keys of the fast setting.
const FAST: &str = "output.energy = false\nsolver.error_fraction = 1";

/// Settings that are measured. Each is measured with surfaces and with particles in contact.
const SETTINGS: [Setting; 3] = [
    Setting { name: "usual", steps: 4, keys: "" },
    Setting { name: "fast", steps: 2, keys: FAST },
    Setting { name: "one step", steps: 1, keys: FAST },
];

/// Processor times of the frames of a simulation, in s.
struct FrameTimes {
    mean: f64,
    slowest: f64,
}

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let frames = std::env::args().nth(1).map_or(Ok(2), |frames| frames.parse())?;
    for surfaces in [true, false] {
        let mut usual = Vec::new();
        for Setting { name, steps, keys } in SETTINGS {
            let step = 1.0 / (60.0 * steps as f64);
            let text = format!(
                "contact.surfaces = {surfaces}\ntime = {{ step = {step}, end = 1000 }}\n{keys}\n{SCENE}"
            );
            let fabric = Document::new("heavy.toml", samples::HEAVY_WEAVE);
            let scene = Scene::from_documents(&Document::new("sheet.toml", text), &[fabric])?;
            let mut simulation = Simulation::new(scene)?;
            let FrameTimes { mean, slowest } = measure(&mut simulation, frames, steps)?;

            if usual.is_empty() {
                usual = simulation.positions().to_vec();
            }
            println!(
                "surfaces {surfaces:5}, {name:9} ({steps} a frame): {:6.1} ms a frame, {:6.1} ms at most, \
                 {:.1} mm from the usual setting, {} intersections",
                1e3 * mean,
                1e3 * slowest,
                1e3 * root_mean_square(&usual, simulation.positions()),
                simulation.summary().contact.intersections
            );
        }
    }
    Ok(())
}

/// Makes `frames` frames of `steps` steps each, and returns their times.
fn measure(
    simulation: &mut Simulation,
    frames: usize,
    steps: usize,
) -> Result<FrameTimes, drape_implicit::Error> {
    let used = |simulation: &Simulation| simulation.summary().cpu_seconds.unwrap_or(f64::NAN);
    let mut slowest: f64 = 0.0;
    for _ in 0..frames {
        let before = used(simulation);
        for _ in 0..steps {
            simulation.step()?;
        }
        slowest = slowest.max(used(simulation) - before);
    }
    Ok(FrameTimes { mean: used(simulation) / frames as f64, slowest })
}

/// Returns the root-mean-square distance of particles at `first` and `second`, in m.
fn root_mean_square(first: &[f64], second: &[f64]) -> f64 {
    let squares = first.iter().zip(second).map(|(a, b)| (a - b) * (a - b));
    (squares.sum::<f64>() / (first.len() as f64 / 3.0)).sqrt()
}
