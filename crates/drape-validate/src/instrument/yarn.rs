//! Yarns of a direction: their laws, and the strain at which they bear a tension.
//!
//! `cycle`, `ideal` and `measurement` use this module.

use drape_fabric::{Fabric, Law, TractionLaw, YarnLaws};
use drape_kes::Direction;

use crate::bisection::bisect;

/// Returns the laws of the yarns of `fabric` along `direction`.
pub(crate) fn laws(fabric: &Fabric, direction: Direction) -> &YarnLaws {
    match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    }
}

/// Returns the strain at which a virgin specimen with `law` has `tension`, in N/m. A specimen that
/// has less tension at a strain of one half is given up there.
pub(crate) fn extension(law: &TractionLaw, tension: f64) -> f64 {
    /// Strain at which a tensile test is given up.
    const LARGEST_STRAIN: f64 = 0.5;
    let virgin = law.virgin();
    bisect(0.0..LARGEST_STRAIN, |strain| law.respond(&virgin, strain).load < tension).high
}
