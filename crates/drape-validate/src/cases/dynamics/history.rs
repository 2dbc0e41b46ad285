//! History of a figure of a moving strip, and the mean period of its oscillation.

use std::f64::consts::TAU;

use crate::error::ValidationError;
use crate::setup::{LinePoint, Strip};

/// Moves a simulation to its end, and gives a figure of it after every step with the time.
pub(super) fn record(
    strip: &Strip,
    angle: f64,
    rest: &str,
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

/// Mean period of an oscillation about nought, from the first to the last crossing.
pub(super) fn period(history: &[[f64; 2]]) -> f64 {
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
pub(super) fn cosine() -> Vec<[f64; 2]> {
    (0..=400).map(|k| 0.01 * f64::from(k)).map(|time| [time, (TAU * time).cos()]).collect()
}

/// Error of the accelerations over g to which steps are solved, a ratio.
pub(super) const TOLERANCE: f64 = 1e-6;

pub(super) fn motion(step: f64, end: f64) -> String {
    format!(
        "[time]\nstep = {step}\nend = {end}\n[solver]\ntolerance = {TOLERANCE:e}\n[output]\nenergy = false\n"
    )
}
