//! Strips in motion.

use std::f64::consts::TAU;

use crate::reference;
use crate::strip::{GRAVITY, Hold, Strip};
use crate::{Axis, Check, Findings, Graph, Source, ValidationError};

type Found = Result<Findings, ValidationError>;

/// Moves a simulation to its end, and gives a figure of it after every step with the time.
fn record(
    strip: &Strip,
    (angle, rest): (f64, &str),
    figure: impl Fn(&[(f64, [f64; 3])]) -> f64,
) -> Result<Vec<[f64; 2]>, ValidationError> {
    let mut simulation = strip.simulation(angle, rest)?;
    let mut history = Vec::new();
    loop {
        let step = simulation.step()?;
        history.push([step.time, figure(&strip.line(&simulation))]);
        if step.finished {
            return Ok(history);
        }
    }
}

/// Mean period of an oscillation about nought, from the first to the last crossing.
fn period(history: &[[f64; 2]]) -> f64 {
    let crossing = |pair: &[[f64; 2]]| {
        let ([t0, x0], [t1, x1]) = (pair[0], pair[1]);
        (x0 * x1 < 0.0).then(|| t0 + (t1 - t0) * x0 / (x0 - x1))
    };
    let crossings: Vec<f64> = history.windows(2).filter_map(crossing).collect();
    match crossings.as_slice() {
        [first, .., last] => 2.0 * (last - first) / (crossings.len() - 1) as f64,
        _ => f64::NAN,
    }
}

/// Four periods of an oscillation.
fn cosine() -> Vec<[f64; 2]> {
    (0..=400).map(|k| 0.01 * f64::from(k)).map(|time| [time, (TAU * time).cos()]).collect()
}

/// Error of the accelerations over g to which steps are solved, a ratio.
const TOLERANCE: f64 = 1e-6;

pub(crate) fn motion(step: f64, end: f64) -> String {
    format!(
        "[time]\nstep = {step}\nend = {end}\n[solver]\ntolerance = {TOLERANCE:e}\n[output]\nenergy = false\n"
    )
}

/// The Bessel function `$J_0$`, by its series.
fn bessel(x: f64) -> f64 {
    let (mut sum, mut term) = (0.0, 1.0);
    for k in 1..40 {
        sum += term;
        term *= -0.25 * x * x / f64::from(k * k);
    }
    sum
}

/// Small swings of a limp strip that hangs from a hinge, mode by mode.
///
/// A straight strip a little off the vertical holds all modes at once. They are orthogonal in the mass, so the
/// deflection weighed with the shape of one swings with its frequency alone.
pub fn hanging_chain() -> Found {
    let strip = Strip {
        length: 0.5,
        width: 0.025,
        cells: 100,
        hold: Hold::Hinge,
        rigidity: 1e-7,
        ..Strip::default()
    };
    let unit = (GRAVITY / strip.length).sqrt();
    let mut checks = Vec::new();
    let axes = [
        Axis::ratio("time over the exact period"),
        Axis::ratio("part of the mode over that at the start"),
    ];
    let mut graph = Graph::new("modes of a limp hanging strip", axes);
    for (number, exact) in reference::CHAIN_MODES.iter().enumerate() {
        let shape = |s: f64| bessel(2.0 * exact * (1.0 - s / strip.length).max(0.0).sqrt());
        let weighed = |line: &[(f64, [f64; 3])]| {
            line.windows(2)
                .map(|pair| {
                    let at = |(s, x): &(f64, [f64; 3])| x[0] * shape(*s);
                    0.5 * (at(&pair[0]) + at(&pair[1])) * (pair[1].0 - pair[0].0)
                })
                .sum()
        };
        let rest = motion(0.002, 4.0 * TAU / (exact * unit));
        let history = record(&strip, (-89.5, &rest), weighed)?;
        let found = TAU / period(&history) / unit;
        let what = format!("mode {} of a hanging chain, ω over √(g/L)", number + 1);
        checks.push(Check::within(what, found, *exact, 0.01));
        let start = history[0][1] / (exact * unit * history[0][0]).cos();
        let period = TAU / (exact * unit);
        let parts = history.iter().map(|[t, x]| [t / period, x / start]).collect();
        graph.add(Source::Traced, format!("mode {}", number + 1), parts);
    }
    graph.add(Source::Reference, "exact", cosine());
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// The first mode of a strip that hangs from a clamp and resists bending.
pub fn hanging_strip() -> Found {
    let mut checks = Vec::new();
    let axes =
        [Axis::ratio("time over the exact period"), Axis::ratio("tip over its place at the start")];
    let mut graph = Graph::new("swing of a hanging strip", axes);
    for ratio in [1.0, 10.0, 100.0] {
        let strip = Strip { cells: 20, ..Strip::default() }.of_weight(ratio);
        let unit = (GRAVITY / strip.length).sqrt();
        let exact = reference::strip_modes(1.0 / ratio, 1)[0];
        let period_exact = TAU / (exact * unit);
        // The strip starts straight down and gravity is a little slanted: it swings about its slanted rest.
        let slant: f64 = 0.005;
        let rest = format!("gravity = [{:e}, -{GRAVITY}, 0]\n", slant * GRAVITY)
            + &motion(period_exact / 400.0, 4.0 * period_exact);
        let history = record(&strip, (-90.0, &rest), |line| line[line.len() - 1].1[0])?;
        let middle = history.iter().map(|[_, x]| x).sum::<f64>() / history.len() as f64;
        let about: Vec<[f64; 2]> = history.iter().map(|[t, x]| [*t, x - middle]).collect();
        let found = TAU / period(&about) / unit;
        let what = format!("first mode of a hanging strip with wL³/B = {ratio}, ω over √(g/L)");
        checks.push(Check::within(what, found, exact, 0.02));
        // The tip starts at nought, off its slanted rest.
        let swing = about.iter().map(|[t, x]| [t / period_exact, -x / middle]).collect();
        graph.add(Source::Traced, format!("wL³/B = {ratio}"), swing);
    }
    graph.add(Source::Reference, "the first mode alone", cosine());
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// A short stiff strip swings from a hinge as a rod does.
pub fn pendulum() -> Found {
    let strip = Strip {
        length: 0.05,
        width: 0.01,
        cells: 10,
        hold: Hold::Hinge,
        rigidity: 9e-4,
        ..Strip::default()
    };
    let small = TAU * (2.0 * strip.length / (3.0 * GRAVITY)).sqrt();
    let mut checks = Vec::new();
    let axes = [Axis::new("time", "s", 1.0), Axis::ratio("tip, across over length")];
    let mut graph = Graph::new("swing of a stiff strip on a hinge", axes);
    for amplitude in [30.0, 60.0, 90.0_f64] {
        let exact = small * reference::pendulum_period(amplitude.to_radians());
        let rest = motion(exact / 400.0, 4.0 * exact);
        let history = record(&strip, (amplitude - 90.0, &rest), |line| line[line.len() - 1].1[0])?;
        let what = format!("period of a pendulum of {amplitude}°, s");
        checks.push(Check::within(what, period(&history), exact, 0.01));
        let periods = history[history.len() - 1][0] / small;
        let swing = reference::pendulum_swing(amplitude.to_radians(), periods, 800);
        let tip = history.iter().map(|[t, x]| [*t, x / strip.length]).collect();
        graph.add(Source::Traced, format!("from {amplitude}°"), tip);
        let swing = swing.into_iter().map(|[t, angle]| [t * small, angle.sin()]).collect();
        graph.add(Source::Reference, "rod", swing);
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// What nothing holds falls, and keeps its shape.
pub fn free_fall() -> Found {
    let strip = Strip { hold: Hold::Free, cells: 20, ..Strip::default() };
    let end = 0.5;
    let rest = motion(0.001, end);
    let fallen = record(&strip, (0.0, &rest), |line| -line[0].1[1])?;
    let bent = record(&strip, (0.0, &rest), |line| {
        let heights = line.iter().map(|(_, x)| x[1]);
        heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min)
    })?;
    let [_, way] = fallen[fallen.len() - 1];
    let bent = bent.iter().map(|[_, bent]| *bent).fold(0.0, f64::max);
    Ok(vec![
        Check::within("way of half a second's fall, m", way, 0.5 * GRAVITY * end * end, 0.005),
        // Accelerations are right to the tolerance, so ways are to that part of the fall.
        Check::at_most("bend of a falling strip, m", bent, TOLERANCE * way),
    ]
    .into())
}

/// What nothing holds and nothing pulls at turns on for ever.
pub fn rotation() -> Found {
    let turns = 1.0;
    let strip = Strip { hold: Hold::Free, cells: 20, spin: turns, ..Strip::default() };
    let end = 2.25;
    let rest = format!("gravity = [0, 0, 0]\n{}", motion(0.002, end));
    let rest = rest.replace("energy = false", "energy = true");
    let mut simulation = strip.simulation(0.0, &rest)?;
    while !simulation.step()?.finished {}
    let line = strip.line(&simulation);
    let ([x0, y0, _], [x1, y1, _]) = (line[0].1, line[line.len() - 1].1);
    let angle = (y1 - y0).atan2(x1 - x0);
    // A quarter beyond whole turns.
    let turned = end - 0.25 + angle / TAU;
    let kinetic = simulation.energy().unwrap_or_default().kinetic;
    let speed = turns * TAU;
    // Particles stand for the cells around them.
    let lumped = 1.0 + 2.0 / (strip.cells as f64).powi(2);
    let inertia = lumped * strip.density * strip.width * strip.length.powi(3) / 12.0;
    Ok(vec![
        Check::within(
            "turns of a free strip in 2.25 s at one a second",
            turned,
            end * turns,
            0.001,
        ),
        Check::within(
            "its energy of motion then, µJ",
            1e6 * kinetic,
            0.5e6 * inertia * speed * speed,
            0.001,
        ),
    ]
    .into())
}
