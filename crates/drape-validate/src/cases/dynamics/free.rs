//! Cases `free-fall` and `rotation`: the fall and the rotation of a strip that nothing holds.

use std::f64::consts::TAU;

use super::history::{TOLERANCE, record, time_and_solver};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::setup::{GRAVITY, Hold, Strip};

/// Compares the fall of a strip that nothing holds with [`GRAVITY`], and checks that the strip
/// keeps its shape.
pub(crate) fn free_fall() -> Result<Findings, ValidationError> {
    let strip = Strip { hold: Hold::Free, cells: 20, ..Strip::default() };
    let end = 0.5;
    let rest = time_and_solver(0.001, end);
    let fallen = record(&strip, 0.0, rest.clone(), |line| -line[0].position[1])?;
    let bent = record(&strip, 0.0, rest, |line| {
        let heights = line.iter().map(|point| point.position[1]);
        heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min)
    })?;
    let [_, height] = fallen[fallen.len() - 1];
    let bend = bent.iter().map(|[_, bend]| *bend).fold(0.0, f64::max);
    Ok(vec![
        Check::within("way of half a second's fall, m", height, 0.5 * GRAVITY * end * end, 0.005),
        // Accelerations have a relative error of the tolerance, and so has the height of the fall.
        Check::at_most("bend of a falling strip, m", bend, TOLERANCE * height),
    ]
    .into())
}

/// Compares the rotation of a strip without forces with a constant rotation (of [`Strip::spin`]).
pub(crate) fn rotation() -> Result<Findings, ValidationError> {
    // The strip turns once a second for two turns and a quarter.
    let turns = 1.0;
    let strip = Strip { hold: Hold::Free, cells: 20, spin: turns, ..Strip::default() };
    let end = 2.25;
    let mut rest = time_and_solver(0.002, end);
    rest.gravity = [0.0; 3];
    rest.output.energy = true;
    let mut simulation = strip.simulation(0.0, rest)?;
    while !simulation.step()?.finished {}

    let line = strip.line(&simulation);
    let ([x0, y0, _], [x1, y1, _]) = (line[0].position, line[line.len() - 1].position);
    let angle = (y1 - y0).atan2(x1 - x0);
    // The angle is a quarter turn beyond whole turns.
    let turned = end - 0.25 + angle / TAU;

    // The mass of the cells is lumped at the particles, which makes the inertia larger.
    let kinetic = simulation.energy().unwrap_or_default().kinetic;
    let speed = turns * TAU;
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
