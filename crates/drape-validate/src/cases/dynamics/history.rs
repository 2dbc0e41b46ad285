//! History of a figure of a moving strip, and the mean period of its oscillation.

use std::f64::consts::TAU;

use drape_scene::{SceneSpec, TimeSpec};

use crate::error::ValidationError;
use crate::setup::{LinePoint, Strip, alone, tolerance};

/// Simulates `strip`, turned by `angle` (in degrees), to its end. Returns the time, in s, and
/// `figure` of the middle line of the strip, after every step.
///
/// `rest` is the rest of the scene, see [`Strip::simulation`].
pub(super) fn record(
    strip: &Strip,
    angle: f64,
    rest: SceneSpec,
    figure: impl Fn(&[LinePoint]) -> f64,
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

/// Returns the mean period of an oscillation about zero, in s, from the first to the last crossing
/// of zero in `history`. Not a number if there are fewer than two crossings.
pub(super) fn period(history: &[[f64; 2]]) -> f64 {
    let crossings: Vec<f64> = history
        .windows(2)
        .filter_map(|pair| {
            let ([t0, x0], [t1, x1]) = (pair[0], pair[1]);
            (x0 * x1 < 0.0).then(|| t0 + (t1 - t0) * x0 / (x0 - x1))
        })
        .collect();
    match crossings.as_slice() {
        [first, .., last] => 2.0 * (last - first) / (crossings.len() - 1) as f64,
        _ => f64::NAN,
    }
}

/// Returns points of `$\cos 2\pi t$` over four periods, at even times.
pub(super) fn cosine() -> Vec<[f64; 2]> {
    (0..=400).map(|k| 0.01 * f64::from(k)).map(|time| [time, (TAU * time).cos()]).collect()
}

/// Tolerance of a step: largest error of the accelerations over g, a ratio.
pub(super) const TOLERANCE: f64 = 1e-6;

/// Returns the rest of a scene with steps of `step` until `end`, both in s.
pub(super) fn time_and_solver(step: f64, end: f64) -> SceneSpec {
    let time = TimeSpec { step, end, ..TimeSpec::default() };
    SceneSpec { time, solver: tolerance(TOLERANCE), ..alone() }
}
