//! Case `column`: the weight at which an upright strip bends over \[Gre81\].
//!
//! Near the critical ratio `$\lambda_c$` of `$\lambda = wL^3/B$` a small side force gives the
//! deflection `$\delta \propto \lambda/(\lambda_c - \lambda)$`; two weights give `$\lambda_c$`
//! \[Sou32\].

use drape_scene::SceneSpec;

use super::rest;
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::reference;
use crate::setup::{GRAVITY, Strip, finish, settle, tolerance};

/// Returns the lean of an upright strip with the ratio `weight`: deflection of the tip over length.
fn lean(weight: f64) -> Result<f64, ValidationError> {
    let strip = Strip::default().with_weight(weight);
    // A slant of gravity by a part in a thousand pushes sideways in proportion to the weight.
    let rest = SceneSpec {
        gravity: [1e-3 * GRAVITY, -GRAVITY, 0.0],
        settle: settle(1e-6, 1e-6),
        solver: tolerance(1e-6),
        ..rest()
    };
    let mut simulation = strip.simulation(90.0, rest)?;
    finish(&mut simulation)?;
    Ok(strip.tip(&simulation)[0].abs() / strip.length)
}

/// Compares the critical weight of an upright strip, found from two leans \[Sou32\], with
/// [`reference::SELF_WEIGHT_BUCKLING`].
pub(crate) fn column() -> Result<Findings, ValidationError> {
    // δ (λc − λ)/λ is equal for both weights.
    let [low, high] = [6.0, 7.0];
    let (first, second) = (lean(low)? / low, lean(high)? / high);
    let critical = (second * high - first * low) / (second - first);
    let what = "weight wL³/B at which an upright strip bends over";
    Ok(vec![Check::within(what, critical, reference::SELF_WEIGHT_BUCKLING, 0.02)].into())
}
