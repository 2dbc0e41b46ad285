//! Strips at rest.

use crate::reference;
use crate::strip::{GRAVITY, Strip, finish};
use crate::{Check, ValidationError};

/// How a strip goes to rest: creeping, to a thousandth of what the usual scene asks for.
const REST: &str = "[time]\nstep = 0.002\nend = 1000.0\n[air]\ndensity = 0\n\
                    [settle]\nresidual = 1e-5\nspeed = 1e-5\n[solver]\ntolerance = 1e-6\n";

/// Weights over rigidity, wL³/B, from stiff to limp.
const WEIGHTS: [f64; 7] = [0.1, 1.0, 3.0, 10.0, 30.0, 60.0, 100.0];

/// Drop over reach of the tip of a strip of given cells that bends under its own weight.
pub fn cantilever(weight: f64, cells: usize) -> Result<[f64; 2], ValidationError> {
    let strip = Strip { cells, ..Strip::default() };
    let load = strip.density * GRAVITY * strip.length.powi(3);
    let strip = Strip { rigidity: load / weight, ..strip };
    let mut simulation = strip.simulation([-90.0, 0.0, 0.0], REST)?;
    finish(&mut simulation)?;
    let tip = strip.tip(&simulation);
    Ok([-tip[1], tip[0]].map(|way| way / strip.length))
}

/// The heavy elastica: drop over reach within 1 % from stiff to limp, and the order of convergence.
pub fn cantilevers() -> Result<Vec<Check>, ValidationError> {
    let mut checks = Vec::new();
    for weight in WEIGHTS {
        let exact = reference::cantilever(weight, 0.0);
        let [drop, reach] = cantilever(weight, 40)?;
        let what = format!("drop over reach, wL³/B = {weight}, 40 cells");
        checks.push(Check::within(what, drop / reach, exact.drop / exact.reach, 0.01));
    }
    Ok(checks)
}
