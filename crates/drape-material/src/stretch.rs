//! Stretch and compression of a traction law, as secants.

use drape_fabric::{Law, TractionLaw};

use crate::error::Error;

/// Strain at which the stiffness against compression is read, a ratio.
///
/// Yarns buckle beyond a hundredth or so. A smaller strain gives the stiffness of a fabric that lies
/// flat, a larger one that of a fabric that has folded.
const COMPRESSION_STRAIN: f64 = -0.01;

/// Largest strain at which a law may have a load, a ratio.
const LARGEST_STRAIN: f64 = 10.0;

/// Bisections for the strain at a load: the bits of a double.
const BISECTIONS: usize = 60;

/// Stretch of a fabric by a load, on its first stretching: friction adds to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Load per width, in N/m.
    pub load: f64,
    /// Strain at the load, a ratio.
    pub strain: f64,
    /// Secant stiffness from rest to the load, in N/m.
    pub stiffness: f64,
}

impl Stretch {
    /// Returns the stretch of a law by a load, in N/m.
    pub(crate) fn of(law: &TractionLaw, direction: &'static str, load: f64) -> Result<Self, Error> {
        let virgin = law.virgin();
        let is_below = |strain: f64| law.respond(&virgin, strain).load < load;
        let (mut low, mut high) = (0.0, LARGEST_STRAIN);
        if is_below(high) {
            return Err(Error::NoStretch { direction, load });
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if is_below(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(Self { load, strain: high, stiffness: load / high })
    }
}

/// Returns the secant stiffness of a law from rest to a compression of 1 %, in N/m.
pub(crate) fn compression(law: &TractionLaw) -> f64 {
    law.respond(&law.virgin(), COMPRESSION_STRAIN).load / COMPRESSION_STRAIN
}
