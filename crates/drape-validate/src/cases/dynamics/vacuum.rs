//! Case `vacuum`: a strip in a vacuum, in a clamp that turns \[THK03\].
//!
//! The paper's text has lost digits. The start of the swing, the exact size of the strip and the
//! pressure in the chamber are not legible. The measured shapes are in photographs only. So this
//! case checks facts that hold for any such experiment: nothing slows a strip of a fabric without
//! friction, friction slows any other strip, and the trajectory of the strip does not depend on the
//! grid.

use drape_dynamics::Simulation;
use drape_fabric::Fabric;
use drape_scene::{MotionSpec, PanelSpec, PinSpec, SceneSpec, TimeSpec};

use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source, Still};
use crate::setup::fabrics::{TAGAWA, fabric};
use crate::setup::{GRAVITY, alone, simulation, with_panel};

/// Length of the strip beyond the clamp, in m.
const LENGTH: f64 = 0.2;

/// Width of the strip, in m.
const WIDTH: f64 = 0.1;

/// Angle of the strip to the vertical when its swing starts, in degrees.
const ANGLE: f64 = 30.0;

/// Duration of the swing, in s.
const SWING_SECONDS: f64 = 5.0;

/// Duration of the impulse of the clamp, in s.
const IMPULSE_SECONDS: f64 = 0.0481;

/// Spacings of the grids that are compared, in m.
const GRIDS: [f64; 2] = [0.005, 0.0025];

/// Times at which the grids are compared, in s.
const TIMES: [f64; 4] = [0.03, 0.05, 0.07, 0.09];

/// Returns the turn of the clamp in the paper's second experiment at the time `t` (in s), in rad.
fn impulse(t: f64) -> f64 {
    /// Turn of the clamp after its impulse, in rad.
    const IMPULSE_TURN: f64 = 2.88;

    if t < IMPULSE_SECONDS {
        t * (2.4315 + t * (1935.4 + t * (-22462.0 + t * 146_610.0)))
    } else {
        IMPULSE_TURN
    }
}

/// Key of the clamp's motion: its turn in degrees at a time in s.
#[derive(Clone, Copy)]
struct Key {
    time: f64,
    turn: f64,
}

/// Experiment with the strip: its grid, its start, the motion of its clamp and the time.
struct Experiment<'a> {
    /// Distance of the particles, in m.
    spacing: f64,
    /// Turn of the strip at the start, in degrees.
    angle: f64,
    /// Motion of the clamp.
    keys: &'a [Key],
    /// Length of a step, in s.
    step: f64,
    /// Time of the end, in s.
    end: f64,
}

/// Returns a simulation of `experiment` with a strip of `fabric` below a clamp on the x axis.
fn strip(fabric: &Fabric, experiment: &Experiment<'_>) -> Result<Simulation, ValidationError> {
    let Experiment { spacing, angle, keys, step, end } = *experiment;
    let spacing = LENGTH / (LENGTH / spacing).round();

    // The clamp holds three rows, and its line is one and a half cells from the edge.
    let height = LENGTH + 1.5 * spacing;
    let below = 0.5 * height - 1.5 * spacing;
    let (sin, cos) = angle.to_radians().sin_cos();
    let times: Vec<f64> = keys.iter().map(|key| key.time).collect();
    let turns: Vec<[f64; 3]> = keys.iter().map(|key| [key.turn, 0.0, 0.0]).collect();
    let motion = MotionSpec { times, turn: turns, center: Some([0.0; 3]), ..MotionSpec::default() };
    let mut spec = SceneSpec {
        name: Some("strip".into()),
        spacing,
        time: TimeSpec { step, end, ..TimeSpec::default() },
        ..alone()
    };
    spec.air.density = 0.0;
    spec.output.energy = true;
    let panel = PanelSpec {
        name: "strip".into(),
        fabric: "strip".into(),
        rectangle: Some([WIDTH, height]),
        center: [0.0, -below * cos, -below * sin],
        turn: [angle, 0.0, 0.0],
        ..PanelSpec::default()
    };
    spec.pin.push(PinSpec {
        panel: "strip".into(),
        edge: Some("top".into()),
        rows: 3,
        motion: Some(motion),
        ..PinSpec::default()
    });
    simulation(&with_panel(spec, panel, fabric))
}

/// Swing of the strip below a clamp that has turned upright.
struct Swing {
    /// Energy that the friction of the fabric dissipates, in J.
    friction_loss: f64,
    /// Energy that friction and time integration dissipate, in J.
    loss: f64,
    /// Time, in s, and distance of the tip to the side, in m.
    tip: Vec<[f64; 2]>,
}

/// Simulates the swing of a strip of `fabric`.
fn swing(fabric: &Fabric) -> Result<Swing, ValidationError> {
    let keys = [Key { time: 0.0, turn: 0.0 }, Key { time: 0.05, turn: ANGLE }];
    let experiment = Experiment {
        spacing: GRIDS[0],
        angle: -ANGLE,
        keys: &keys,
        step: 0.002,
        end: SWING_SECONDS,
    };
    let mut simulation = strip(fabric, &experiment)?;

    let mut tip = Vec::new();
    loop {
        let step = simulation.step()?;
        tip.push([step.time, middle(&simulation)[0][0]]);
        if step.finished {
            break;
        }
    }

    let energy = simulation.energy().unwrap_or_default();
    let numerical_loss = energy.numerical_dissipated + energy.rotation_dissipated;
    let friction_loss = energy.friction_dissipated;
    Ok(Swing { friction_loss, loss: numerical_loss + friction_loss, tip })
}

/// Returns the points along the middle of the strip in `simulation`, from its tip to the clamp:
/// distance to the side and height, in m.
fn middle(simulation: &Simulation) -> Vec<[f64; 2]> {
    let positions = simulation.positions().to_vec();
    let points = simulation.coordinates().iter().zip(positions.chunks_exact(3));
    let mut middle: Vec<(f64, [f64; 2])> = points
        .filter(|(c, _)| (c[0] - 0.5 * WIDTH).abs() < 0.25 * simulation.spacing())
        .map(|(c, x)| (c[1], [x[2], x[1]]))
        .collect();
    middle.sort_by(|a, b| a.0.total_cmp(&b.0));
    middle.into_iter().map(|(_, point)| point).collect()
}

/// Checks both experiments of the paper.
pub(crate) fn vacuum() -> Result<Findings, ValidationError> {
    let fabric = fabric(TAGAWA)?;
    let mut findings = Findings::default();
    compare_swings(&fabric, &mut findings)?;
    compare_grids(&fabric, &mut findings)?;
    Ok(findings)
}

/// Adds to `findings` the losses of swings of strips of `fabric`, with its friction and without.
fn compare_swings(fabric: &Fabric, findings: &mut Findings) -> Result<(), ValidationError> {
    let mass = fabric.density * LENGTH * WIDTH;
    let swing_energy = mass * GRAVITY * 0.5 * LENGTH * (1.0 - ANGLE.to_radians().cos());
    // Bending is small beside the weight, so the strip swings in the first mode of a chain.
    let periods = SWING_SECONDS * 1.2024 * (GRAVITY / LENGTH).sqrt() / std::f64::consts::TAU;

    // The energy is proportional to the square of the amplitude.
    let elastic = swing(&fabric.without_friction())?;
    let loss = 1.0 - (1.0 - elastic.loss / swing_energy).max(0.0).powf(0.5 / periods);
    let what = "amplitude that a swing without friction loses in a period, a part";
    findings.checks.push(Check::at_most(what, loss, 0.01));

    let rubbing = swing(fabric)?;
    let what = "part of the loss of a swing with friction that the fabric takes";
    findings.checks.push(Check::at_least(what, rubbing.friction_loss / rubbing.loss, 0.9));

    let axes = [Axis::new("time", "s", 1.0), Axis::new("tip to the side", "mm", 1e-3)];
    let mut swings = Graph::new("swing in a vacuum", axes);
    swings.add(Source::Traced, "without friction", elastic.tip);
    swings.add(Source::Traced, "with the fabric's friction", rubbing.tip);
    findings.graphs.push(swings);
    Ok(())
}

/// Adds to `findings` the trajectories of strips of `fabric` that their clamp throws over, on both
/// grids.
fn compare_grids(fabric: &Fabric, findings: &mut Findings) -> Result<(), ValidationError> {
    /// Azimuth and elevation of the view of the strip, in degrees.
    const VIEW: [f64; 2] = [60.0, 15.0];

    let keys: Vec<Key> = (0..=97)
        .map(|k| IMPULSE_SECONDS * f64::from(k) / 97.0)
        .map(|time| Key { time, turn: impulse(time).to_degrees() })
        .collect();
    let axes = [Axis::new("to the side", "mm", 1e-3), Axis::new("up", "mm", 1e-3)];
    let mut shapes = Graph::new("thrown over by its clamp", axes).laid_out(Layout::ToScale);
    let mut thrown = Vec::new();
    let mut tips = Vec::new();

    // The shape on each grid at each time. The coarse grid is drawn as points, the fine grid as a
    // line.
    for spacing in GRIDS {
        let experiment =
            Experiment { spacing, angle: 0.0, keys: &keys, step: 0.0005, end: TIMES[3] };
        let mut simulation = strip(fabric, &experiment)?;
        let mut grid_tips = Vec::new();
        while grid_tips.len() < TIMES.len() {
            let step = simulation.step()?;
            if step.time >= TIMES[grid_tips.len()] - 1e-9 {
                let time = TIMES[grid_tips.len()];
                let shape = middle(&simulation);
                grid_tips.push(shape[0]);
                let (source, label) = if spacing == GRIDS[0] {
                    (Source::Simulated, format!("{time} s, 5 mm"))
                } else {
                    thrown.push(simulation.snapshot());
                    (Source::Reference, "2.5 mm".to_owned())
                };
                shapes.add(source, label, shape);
            }
        }
        tips.push(grid_tips);
    }
    findings.graphs.push(shapes);

    for (k, time) in TIMES.into_iter().enumerate() {
        let [a, b] = [tips[0][k], tips[1][k]];
        let what = format!(
            "impulse: tip on grids of 5 and 2.5 mm at {time} s, apart by part of the length"
        );
        let distance = (a[0] - b[0]).hypot(a[1] - b[1]) / LENGTH;
        findings.checks.push(Check::at_most(what, distance, 0.05));
    }

    let title = format!("thrown over by its clamp, after {TIMES:?} s");
    findings.stills.push(Still { title, snapshots: thrown, columns: 2, view: VIEW });
    Ok(())
}
