//! Exact solutions of the statics and dynamics of thin strips.
//!
//! Each function answers one question with one formula and its source. No solution comes from a
//! simulation. `runge_kutta` integrates where no closed form exists. A ratio such as `$wL^3/B$`
//! describes all strips with equal shape: `$w$` is the weight per area, `$L$` the length and `$B$`
//! the bending rigidity per width. The cases compare simulations with these solutions.

mod bias;
mod catenary;
mod column;
mod decrement;
mod heavy_elastica;
mod runge_kutta;
mod vibration;

use crate::bisection::bisect;

pub use bias::bias_stiffness;
pub use catenary::{catenary_sag, catenary_shape};
pub use column::{END_LOAD_BUCKLING, SELF_WEIGHT_BUCKLING};
pub use decrement::{CycleLoss, DahlStrip, Deflection};
pub use heavy_elastica::{Tip, cantilever, cantilever_shape};
pub use vibration::{CHAIN_MODES, pendulum_period, pendulum_swing, strip_modes};

/// Returns the number between `low` and `high` where `f` changes sign, to the last bits.
fn root(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let rising = f(low) < 0.0;
    let bracket = bisect(low..high, |x| (f(x) < 0.0) == rising);
    0.5 * (bracket.low + bracket.high)
}
