//! `drape bench`: times the solver on a square metre of cloth, hung as a curtain and in a violent
//! swing.

use std::fmt::Write;
use std::sync::Arc;

use clap::Args;
use drape::dynamics::{Simulation, Summary};
use drape::fabric::Fabric;
use drape::input::Document;
use drape::scene::{FabricSpec, OutputSpec, PanelSpec, PinSpec, RippleSpec, SceneSpec, TimeSpec};
use serde_json::json;

use crate::console::progress;
use crate::failure::Failure;
use crate::say::say;

#[derive(Args)]
pub(crate) struct BenchArguments {
    /// Particles along a side of the square, one run each.
    #[arg(long, value_delimiter = ',', default_value = "20,50,100", value_name = "N,…")]
    sizes: Vec<usize>,
    /// Length of a step, in seconds.
    #[arg(long, default_value_t = 0.005, value_name = "SECONDS")]
    step: f64,
    /// Simulated time, in seconds.
    #[arg(long, default_value_t = 1.0, value_name = "SECONDS")]
    until: f64,
    /// Simulates in air, whose drag damps the swing, instead of in a vacuum.
    #[arg(long)]
    air: bool,
    /// Prints the results as JSON.
    #[arg(long)]
    json: bool,
}

/// Fabric of the cloth: a plain weave of 200 g/m² with friction in every law.
const FABRIC: &str = r#"name = "bench"
density = 0.2
thickness = 0.0004
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.6, toe_strain = 0.015, toe_strain_after = 0.02 }
traction.friction = [{ plateau = 4.0, length = 0.001 }]
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4.0 }] }
[weft]
traction.primed = { stiffness = 5000, toe_ratio = 0.6, toe_strain = 0.015, toe_strain_after = 0.02 }
traction.friction = [{ plateau = 4.0, length = 0.001 }]
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4.0 }] }
[shear]
stiffness = 50.0
friction = [{ plateau = 0.5, length = 0.004 }]
"#;

/// Motion of the square metre, which is held at two corners.
struct Motion {
    name: &'static str,
    /// Returns the panel as it is at the start of the motion.
    start: fn() -> PanelSpec,
}

const MOTIONS: [Motion; 2] =
    [Motion { name: "curtain", start: rippled }, Motion { name: "swing", start: level }];

/// Returns a panel with ripples.
fn rippled() -> PanelSpec {
    let ripple = Some(RippleSpec { amplitude: 0.005, wavelength: 0.25 });
    PanelSpec { ripple, ..PanelSpec::default() }
}

/// Returns a panel that lies level.
fn level() -> PanelSpec {
    PanelSpec { turn: [-90.0, 0.0, 0.0], ..PanelSpec::default() }
}

/// Simulation of one motion at one size.
struct Run {
    motion: &'static str,
    /// Number of particles along a side.
    size: usize,
    summary: Summary,
}

impl Run {
    /// Returns the processor time per simulated second. Where the system does not measure processor
    /// time, `wall_seconds` is taken.
    fn seconds_per_simulated_second(&self) -> f64 {
        let Summary { cpu_seconds, wall_seconds, simulated_seconds, .. } = &self.summary;
        cpu_seconds.unwrap_or(*wall_seconds) / simulated_seconds
    }

    /// Returns the processor time per step, in ms, from [`Self::seconds_per_simulated_second`].
    fn step_milliseconds(&self) -> f64 {
        1e3 * self.seconds_per_simulated_second() * self.summary.simulated_seconds
            / self.summary.steps as f64
    }

    /// Returns the number of linear iterations per step, which `solver` of the summary counts.
    fn linear_iterations_per_step(&self) -> f64 {
        self.summary.solver.linear_iterations as f64 / self.summary.steps as f64
    }
}

/// Executes `drape bench`.
pub(crate) fn bench(arguments: &BenchArguments) -> Result<(), Failure> {
    let BenchArguments { sizes, step, until, .. } = arguments;
    if let Some(size) = sizes.iter().find(|size| !(3..=1000).contains(*size)) {
        let message = format!("--sizes {size}: from 3 to 1000 particles along a side");
        return Err(Failure::Usage(message));
    }
    if !(*step >= 1e-5 && *step <= 0.1 && *until >= *step && *until <= 1e3) {
        let message = format!("--step {step} --until {until}: seconds, one step at least");
        return Err(Failure::Usage(message));
    }

    let length = (MOTIONS.len() * sizes.len() * 1000) as u64;
    let bar = progress::bar(length, "{percent} %, {eta} left  {msg}");
    let mut runs = Vec::new();
    for Motion { name, start } in MOTIONS {
        for &size in sizes {
            bar.set_message(format!("{name}, {size} × {size}"));
            let base = (runs.len() * 1000) as u64;
            let summary = run(start, size, arguments, &|fraction: f64| {
                bar.set_position(base + (1000.0 * fraction) as u64);
            })?;
            runs.push(Run { motion: name, size, summary });
        }
    }
    bar.finish_and_clear();
    say(if arguments.json { as_json(&runs, arguments) } else { table(&runs, arguments) })
}

/// Simulates a cloth of `size` × `size` particles that `start` sets in motion. `done` is called
/// after each step with the fraction of the time that is simulated.
fn run(
    start: fn() -> PanelSpec,
    size: usize,
    &BenchArguments { step, until, air, .. }: &BenchArguments,
    done: &dyn Fn(f64),
) -> Result<Summary, Failure> {
    let mut spec = SceneSpec {
        name: Some("bench".into()),
        spacing: 1.0 / (size as f64 - 1.0),
        time: TimeSpec { step, end: until, ..TimeSpec::default() },
        output: OutputSpec { every: Some(until), energy: false, ..OutputSpec::default() },
        ..SceneSpec::default()
    };
    if !air {
        spec.air.density = 0.0;
    }
    spec.contact.surfaces = Some(false);
    let file = Arc::new(Fabric::from_document(&Document::new("bench.toml", FABRIC))?).into();
    spec.fabric.insert("bench".into(), FabricSpec { file, ..FabricSpec::default() });
    let start = start();
    spec.panel.push(PanelSpec {
        name: "sheet".into(),
        fabric: "bench".into(),
        rectangle: Some([1.0, 1.0]),
        ..start
    });
    let points = vec![[0.0, 1.0], [1.0, 1.0]];
    spec.pin.push(PinSpec { panel: "sheet".into(), points, ..PinSpec::default() });

    let scene = spec.build()?;
    let mut simulation = Simulation::new(scene)?;
    loop {
        let step = simulation.step().map_err(|error| Failure::Solver(error.to_string()))?;
        done(step.time / until);
        if step.finished {
            return Ok(simulation.summary());
        }
    }
}

/// Returns the results of `runs` as a table, with the growth of each motion below it.
fn table(runs: &[Run], &BenchArguments { step, air, .. }: &BenchArguments) -> String {
    let mut text = format!(
        "A square metre of 0.2 kg/m², 5000 N/m, friction in every law, held at two corners {};\n\
         steps of {} ms, tolerance 1e-4 g, {} threads.\n\n\
         motion    particles  ms/step  iterations  linear  rejected  CPU s per simulated s\n",
        if air { "in air" } else { "in a vacuum" },
        1e3 * step,
        runs[0].summary.threads
    );

    for run in runs {
        let Summary { particles, solver, .. } = &run.summary;
        let _ = writeln!(
            text,
            "{:8} {particles:10} {:8.2} {:11.1} {:7.0} {:9} {:22.3}",
            run.motion,
            run.step_milliseconds(),
            solver.iterations_mean,
            run.linear_iterations_per_step(),
            solver.rejected_steps,
            run.seconds_per_simulated_second()
        );
    }

    for Growth { motion, exponent } in growths(runs) {
        let _ = writeln!(text, "{motion} grows like N^{exponent:.2}");
    }
    text.trim_end().to_owned()
}

/// Returns the results of `runs` as JSON.
fn as_json(runs: &[Run], &BenchArguments { step, air, .. }: &BenchArguments) -> String {
    let rows = runs.iter().map(|run| {
        json!({
            "motion": run.motion,
            "size": run.size,
            "particles": run.summary.particles,
            "step_milliseconds": run.step_milliseconds(),
            "cpu_per_simulated_second": run.seconds_per_simulated_second(),
            "summary": run.summary,
        })
    });
    let growth: serde_json::Map<_, _> =
        growths(runs).into_iter().map(|g| (g.motion.to_owned(), g.exponent.into())).collect();
    let rows = rows.collect::<Vec<_>>();
    let all = json!({ "step": step, "air": air, "runs": rows, "growth_exponent": growth });
    serde_json::to_string_pretty(&all).expect("numbers and words always have a JSON form")
}

/// Growth of the processor time of a motion with the number N of particles.
struct Growth {
    motion: &'static str,
    /// Exponent of N, by least squares of the logarithms.
    exponent: f64,
}

/// Returns the growth of each motion that `runs` has with two sizes or more.
fn growths(runs: &[Run]) -> Vec<Growth> {
    MOTIONS.iter().filter_map(|motion| growth(motion.name, runs)).collect()
}

/// Returns the growth of `motion`, or `None` if `runs` has the motion with one size only.
fn growth(motion: &'static str, runs: &[Run]) -> Option<Growth> {
    let points: Vec<[f64; 2]> = runs
        .iter()
        .filter(|run| run.motion == motion)
        .map(|run| [(run.summary.particles as f64).ln(), run.seconds_per_simulated_second().ln()])
        .collect();
    let [x, y] =
        [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64);
    let variance: f64 = points.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
    let covariance: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    (variance > 0.0).then_some(Growth { motion, exponent: covariance / variance })
}
