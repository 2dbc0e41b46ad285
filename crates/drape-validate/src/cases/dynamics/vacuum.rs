//! Case `vacuum`: a strip in a vacuum, in a clamp that turns \[THK03\].
//!
//! The paper's text has lost digits. How its strip was set swinging, its exact size and the
//! pressure in the chamber are not legible; its measured shapes are in photographs only. So what is
//! held against a reference here is what must be true of any such experiment: without friction in
//! the fabric nothing slows the strip, with it the fabric does, and the trajectory of the strip
//! does not depend on the grid.

use drape_dynamics::Simulation;
use drape_fabric::Fabric;

use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source, Still};
use crate::setup::fabrics::{TAGAWA, fabric};
use crate::setup::{ALONE, GRAVITY, simulation};

/// Length and width of the strip beyond the clamp, in m.
const LENGTH: f64 = 0.2;

const WIDTH: f64 = 0.1;

/// How far the strip is turned at first, in degrees, and how long it swings, in s.
const ANGLE: f64 = 30.0;

const SWING: f64 = 5.0;

/// Turn of the clamp after its impulse, in rad, and duration of the impulse, in s.
const IMPULSE_TURN: f64 = 2.88;
const IMPULSE_SECONDS: f64 = 0.0481;

/// The grids that are compared, in m, and times, in s, at which they are.
const GRIDS: [f64; 2] = [0.005, 0.0025];

const TIMES: [f64; 4] = [0.03, 0.05, 0.07, 0.09];

/// From where the strip is seen, azimuth and elevation in degrees.
const VIEW: [f64; 2] = [60.0, 15.0];

/// Turn of the clamp in the paper's second experiment at a time, in rad.
fn impulse(t: f64) -> f64 {
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

/// Run of the strip: its grid, its start, the motion of its clamp and the time.
struct Run<'a> {
    /// Distance of the particles, in m.
    spacing: f64,
    /// Turn of the strip at the start, in degrees.
    angle: f64,
    /// Motion of the clamp.
    keys: &'a [Key],
    /// Length of a step, and time of the end, in s.
    step: f64,
    end: f64,
}

/// The strip below a clamp on the x axis that begins turned by an angle and then turns by others,
/// in degrees.
fn strip(fabric: &Fabric, run: &Run<'_>) -> Result<Simulation, ValidationError> {
    let Run { spacing, angle, keys, step, end } = *run;
    let spacing = LENGTH / (LENGTH / spacing).round();
    // The clamp holds three rows, and its line is one and a half cells from the edge.
    let height = LENGTH + 1.5 * spacing;
    let below = 0.5 * height - 1.5 * spacing;
    let (sin, cos) = angle.to_radians().sin_cos();
    let times: Vec<f64> = keys.iter().map(|key| key.time).collect();
    let turns: Vec<[f64; 3]> = keys.iter().map(|key| [key.turn, 0.0, 0.0]).collect();
    let text = format!(
        "{ALONE}name = \"strip\"\nspacing = {spacing:e}\nair = {{ density = 0 }}\n\
         fabric.strip.file = \"fabric.toml\"\n[[panel]]\nname = \"strip\"\nfabric = \"strip\"\n\
         rectangle = [{WIDTH}, {height:e}]\ncenter = [0, {:e}, {:e}]\nturn = [{angle:e}, 0, 0]\n\
         [[pin]]\npanel = \"strip\"\nedge = \"top\"\nrows = 3\n[pin.motion]\ncenter = [0, 0, 0]\n\
         times = {times:?}\nturn = {turns:?}\n[time]\nstep = {step}\nend = {end}\n",
        -below * cos,
        -below * sin
    );
    simulation(text, fabric.to_toml())
}

/// A swing set going by a clamp that turns upright.
struct Swing {
    /// What is lost of its energy by the fabric, and in all, in J.
    lost: [f64; 2],
    /// Time, and how far the tip is to the side, in s and m.
    tip: Vec<[f64; 2]>,
}

fn swing(fabric: &Fabric) -> Result<Swing, ValidationError> {
    let keys = [Key { time: 0.0, turn: 0.0 }, Key { time: 0.05, turn: ANGLE }];
    let run = Run { spacing: GRIDS[0], angle: -ANGLE, keys: &keys, step: 0.002, end: SWING };
    let mut simulation = strip(fabric, &run)?;
    let mut tip = Vec::new();
    loop {
        let step = simulation.step()?;
        tip.push([step.time, middle(&simulation)[0][0]]);
        if step.finished {
            break;
        }
    }
    let energy = simulation.energy().unwrap_or_default();
    let lost = energy.numerical_dissipated + energy.rotation_dissipated;
    Ok(Swing { lost: [energy.friction_dissipated, lost + energy.friction_dissipated], tip })
}

/// Places along the middle of the strip, to the side and up, from its tip to the clamp; in m.
fn middle(simulation: &Simulation) -> Vec<[f64; 2]> {
    let positions = simulation.frame().positions;
    let points = simulation.coordinates().iter().zip(positions.chunks_exact(3));
    let mut middle: Vec<(f64, [f64; 2])> = points
        .filter(|(c, _)| (c[0] - 0.5 * WIDTH).abs() < 0.25 * simulation.spacing())
        .map(|(c, x)| (c[1], [x[2], x[1]]))
        .collect();
    middle.sort_by(|a, b| a.0.total_cmp(&b.0));
    middle.into_iter().map(|(_, place)| place).collect()
}

/// Both experiments.
pub(crate) fn vacuum() -> Result<Findings, ValidationError> {
    let fabric = fabric(TAGAWA)?;
    let rest = fabric.without_friction();
    let mass = fabric.density * LENGTH * WIDTH;
    let swung = mass * GRAVITY * 0.5 * LENGTH * (1.0 - ANGLE.to_radians().cos());
    // The first mode of a hanging strip, whose bending is small beside its weight.
    let periods = SWING * 1.2024 * (GRAVITY / LENGTH).sqrt() / std::f64::consts::TAU;
    let elastic = swing(&rest)?;
    let [_, lost] = elastic.lost;
    // The energy goes with the square of the amplitude.
    let loss = 1.0 - (1.0 - lost / swung).max(0.0).powf(0.5 / periods);
    let mut checks = vec![Check::at_most(
        "amplitude that a swing without friction loses in a period, a part",
        loss,
        0.01,
    )];
    let rubbing = swing(&fabric)?;
    let [friction, lost] = rubbing.lost;
    let what = "part of the loss of a swing with friction that the fabric takes";
    checks.push(Check::at_least(what, friction / lost, 0.9));

    let keys: Vec<Key> = (0..=97)
        .map(|k| IMPULSE_SECONDS * f64::from(k) / 97.0)
        .map(|time| Key { time, turn: impulse(time).to_degrees() })
        .collect();
    let axes = [Axis::new("time", "s", 1.0), Axis::new("tip to the side", "mm", 1e-3)];
    let mut swings = Graph::new("swing in a vacuum", axes);
    swings.add(Source::Traced, "without friction", elastic.tip);
    swings.add(Source::Traced, "with the fabric's friction", rubbing.tip);
    let axes = [Axis::new("to the side", "mm", 1e-3), Axis::new("up", "mm", 1e-3)];
    let mut shapes = Graph::new("thrown over by its clamp", axes).laid_out(Layout::ToScale);
    let mut thrown = Vec::new();
    let mut tips = Vec::new();
    for spacing in GRIDS {
        let run = Run { spacing, angle: 0.0, keys: &keys, step: 0.0005, end: TIMES[3] };
        let mut simulation = strip(&fabric, &run)?;
        let mut found = Vec::new();
        while found.len() < TIMES.len() {
            let step = simulation.step()?;
            if step.time >= TIMES[found.len()] - 1e-9 {
                let time = TIMES[found.len()];
                let shape = middle(&simulation);
                found.push(shape[0]);
                let (source, label) = if spacing == GRIDS[0] {
                    (Source::Simulated, format!("{time} s, 5 mm"))
                } else {
                    thrown.push(simulation.snapshot());
                    (Source::Reference, "2.5 mm".to_owned())
                };
                shapes.add(source, label, shape);
            }
        }
        tips.push(found);
    }
    for (k, time) in TIMES.into_iter().enumerate() {
        let [a, b] = [tips[0][k], tips[1][k]];
        let what = format!(
            "impulse: tip on grids of 5 and 2.5 mm at {time} s, apart by part of the length"
        );
        checks.push(Check::at_most(what, (a[0] - b[0]).hypot(a[1] - b[1]) / LENGTH, 0.05));
    }
    let title = format!("thrown over by its clamp, after {TIMES:?} s");
    let still = Still { title, snapshots: thrown, columns: 2, view: VIEW };
    Ok(Findings { checks, graphs: vec![swings, shapes], stills: vec![still] })
}
