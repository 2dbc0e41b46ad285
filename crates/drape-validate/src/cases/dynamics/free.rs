//! Cases `free-fall` and `rotation`: a strip that nothing holds falls, and turns on.

use std::f64::consts::TAU;

use super::history::{TOLERANCE, motion, record};
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::setup::{GRAVITY, Hold, Strip};

/// What nothing holds falls, and keeps its shape.
pub(crate) fn free_fall() -> Result<Findings, ValidationError> {
    let strip = Strip { hold: Hold::Free, cells: 20, ..Strip::default() };
    let end = 0.5;
    let rest = motion(0.001, end);
    let fallen = record(&strip, 0.0, &rest, |line| -line[0].position[1])?;
    let bent = record(&strip, 0.0, &rest, |line| {
        let heights = line.iter().map(|point| point.position[1]);
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
pub(crate) fn rotation() -> Result<Findings, ValidationError> {
    let turns = 1.0;
    let strip = Strip { hold: Hold::Free, cells: 20, spin: turns, ..Strip::default() };
    let end = 2.25;
    let rest = format!("gravity = [0, 0, 0]\n{}", motion(0.002, end));
    let rest = rest.replace("energy = false", "energy = true");
    let mut simulation = strip.simulation(0.0, &rest)?;
    while !simulation.step()?.finished {}
    let line = strip.line(&simulation);
    let ([x0, y0, _], [x1, y1, _]) = (line[0].position, line[line.len() - 1].position);
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
