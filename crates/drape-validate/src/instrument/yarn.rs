//! Yarns of a direction: their laws, and the strain at which they bear a tension.
//!
//! `cycle`, `ideal` and `measurement` ask it.

use drape_fabric::{Fabric, Law, TractionLaw, YarnLaws};
use drape_kes::Direction;

use crate::bisection::bisect;

/// Strain at which a tensile test is given up.
const LARGEST_STRAIN: f64 = 0.5;

/// Returns the laws of a direction.
pub(crate) fn laws(fabric: &Fabric, direction: Direction) -> &YarnLaws {
    match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    }
}

/// Returns the strain at which a virgin specimen has a tension in N/m.
pub(crate) fn extension(law: &TractionLaw, tension: f64) -> f64 {
    let virgin = law.virgin();
    bisect(0.0..LARGEST_STRAIN, |strain| law.respond(&virgin, strain).load < tension).high
}
