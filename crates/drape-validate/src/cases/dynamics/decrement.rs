//! Case `decrement`: the swings of a strip with friction against the area of its loop.
//!
//! The reference is the logarithmic decrement of [`crate::reference::DahlStrip`] \[Dahl68\].

use std::f64::consts::TAU;

use drape_dynamics::Simulation;

use super::super::figure_name;
use super::history::time_and_solver;
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::reference::{CycleLoss, DahlStrip};
use crate::setup::{Friction, Strip};

/// Strip with so little friction that it swings in the mode of an elastic strip.
const STRIP: DahlStrip =
    DahlStrip { length: 0.05, rigidity: 1.6e-5, plateau: 3.2e-7, sliding: 1.0 };

/// Returns the largest deflections of the tip to one side, in m. Each comes with the energy that
/// friction has dissipated until then, in J/m. Without `friction` the strip is elastic.
fn swings(friction: bool) -> Result<Vec<[f64; 2]>, ValidationError> {
    /// Largest curvature at the clamp in the first swing, in 1/m: twice the length of the friction.
    const CURVATURE: f64 = 2.0;

    /// Swings to one side.
    const SWINGS: usize = 6;

    /// Steps in a period.
    const STEPS: f64 = 250.0;

    let plateau = if friction { STRIP.plateau } else { 0.0 };
    let strip = Strip {
        length: STRIP.length,
        width: 0.005,
        cells: 20,
        rigidity: STRIP.rigidity,
        friction: Friction { plateau, length: STRIP.sliding },
        ..Strip::default()
    };
    let frequency = STRIP.frequency(strip.density);
    let period = TAU / frequency;
    let bend = STRIP.mode(0.0).curvature;
    let mut rest = time_and_solver(period / STEPS, (SWINGS as f64 + 0.5) * period);
    rest.gravity = [0.0; 3];
    rest.output.energy = true;
    let mut scene = strip.scene(0.0, rest)?;

    // The strip starts flat with the velocities of the first mode: no yarn is strained, and no
    // element has slid.
    let held = scene.held_particles();
    let speeds = scene.start.velocities.chunks_exact_mut(3).zip(scene.cloth.coordinates());
    for ((speed, [u, _]), held) in speeds.zip(held) {
        let deflection = STRIP.mode(u - strip.clamped_length()).deflection;
        speed[1] = if held { 0.0 } else { frequency * CURVATURE / bend * deflection };
    }

    let mut simulation = Simulation::new(scene)?;
    let (mut tips, mut maxima) = (vec![[0.0; 2]], Vec::new());
    loop {
        let finished = simulation.step()?.finished;
        let energy = simulation.energy().unwrap_or_default();
        tips.push([strip.tip(&simulation)[1], energy.friction_dissipated / strip.width]);
        if let [.., [a, _], [b, lost], [c, _]] = tips[..]
            && b > a
            && b >= c
            && b > 0.0
        {
            // The maximum is the top of the parabola through three deflections.
            maxima.push([b + (a - c).powi(2) / (8.0 * (2.0 * b - a - c)), lost]);
        }
        if finished {
            return Ok(maxima);
        }
    }
}

/// Compares the decrement of free swings with the area of the loop.
pub(crate) fn decrement() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let rubbing = swings(true)?;

    // The first swing starts without slip, so its loop is not steady.
    for (number, pair) in rubbing.windows(2).enumerate().skip(1).step_by(2) {
        let ([first, before], [second, after]) = (pair[0], pair[1]);
        let CycleLoss { energy: lost, decrement } = STRIP.decrement((first * second).sqrt());
        let swing = format!("swing {}", number + 1);
        let what = figure_name(&swing, "logarithmic decrement");
        checks.push(Check::within(what, (first / second).ln(), decrement, 0.02));
        let dissipated = 1e9 * (after - before);
        let what = figure_name(&swing, "energy that friction takes, nJ/m");
        checks.push(Check::within(what, dissipated, 1e9 * lost, 0.02));
    }

    // The time integration alone must damp the swings far less than friction does.
    let elastic = swings(false)?;
    if let ([[first, _], .., [last, _]], [[rubbing_first, _], .., [rubbing_last, _]]) =
        (&elastic[..], &rubbing[..])
    {
        let what = "decrement of the formula, without friction, over that with friction";
        let ratio = (first / last).ln() / (rubbing_first / rubbing_last).ln();
        checks.push(Check::at_most(what, ratio, 0.02));
    }
    Ok(checks.into())
}
