//! Case `decrement`: the swings of a strip with friction against the area of its loop.
//!
//! The logarithmic decrement is that of [`crate::reference::DahlStrip`] \[Dahl68\].

use std::f64::consts::TAU;

use drape_dynamics::Simulation;

use super::history::motion;
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::reference::{CycleLoss, DahlStrip};
use crate::setup::{Friction, Strip};

/// The strip: friction so little that it swings in the mode of an elastic one.
const STRIP: DahlStrip =
    DahlStrip { length: 0.05, rigidity: 1.6e-5, plateau: 3.2e-7, sliding: 1.0 };

/// Curvature at the clamp at first, in 1/m: twice the length of the friction.
const CURVATURE: f64 = 2.0;

/// Swings to one side, and steps in a period.
const SWINGS: usize = 6;

const STEPS: f64 = 250.0;

/// Largest deflections of the tip to one side, in m, each with what the friction has taken until
/// then, in J/m.
fn swings(friction: bool) -> Result<Vec<[f64; 2]>, ValidationError> {
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
    let rest =
        format!("gravity = [0, 0, 0]\n{}", motion(period / STEPS, (SWINGS as f64 + 0.5) * period));
    let mut scene = strip.scene(0.0, &rest.replace("energy = false", "energy = true"))?;
    // Flat and fast in the first mode: no yarn is strained, and none has slid.
    let held = scene.held_particles();
    let speeds = scene.start.velocities.chunks_exact_mut(3).zip(scene.cloth.coordinates());
    for ((speed, [u, _]), held) in speeds.zip(held) {
        let deflection = STRIP.mode(u - strip.beyond()).deflection;
        speed[1] = if held { 0.0 } else { frequency * CURVATURE / bend * deflection };
    }
    let mut simulation = Simulation::new(scene)?;
    let (mut tips, mut found) = (vec![[0.0; 2]], Vec::new());
    loop {
        let finished = simulation.step()?.finished;
        let energy = simulation.energy().unwrap_or_default();
        tips.push([strip.tip(&simulation)[1], energy.friction_dissipated / strip.width]);
        if let [.., [a, _], [b, lost], [c, _]] = tips[..]
            && b > a
            && b >= c
            && b > 0.0
        {
            // The top of the parabola through three deflections.
            found.push([b + (a - c).powi(2) / (8.0 * (2.0 * b - a - c)), lost]);
        }
        if finished {
            return Ok(found);
        }
    }
}

/// The decrement of free swings against the area of the loop.
pub(crate) fn decrement() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let found = swings(true)?;
    // The first swing begins without a past, in no loop.
    for (number, pair) in found.windows(2).enumerate().skip(1).step_by(2) {
        let ([first, before], [second, after]) = (pair[0], pair[1]);
        let CycleLoss { energy: lost, decrement } = STRIP.decrement((first * second).sqrt());
        let what = |what: &str| format!("swing {}: {what}", number + 1);
        checks.push(Check::within(
            what("logarithmic decrement"),
            (first / second).ln(),
            decrement,
            0.02,
        ));
        let taken = 1e9 * (after - before);
        checks.push(Check::within(
            what("energy that friction takes, nJ/m"),
            taken,
            1e9 * lost,
            0.02,
        ));
    }
    let elastic = swings(false)?;
    if let ([[first, _], .., [last, _]], [[begun, _], .., [ended, _]]) = (&elastic[..], &found[..])
    {
        let what = "decrement of the formula, without friction, over that with friction";
        checks.push(Check::at_most(what, (first / last).ln() / (begun / ended).ln(), 0.02));
    }
    Ok(checks.into())
}
