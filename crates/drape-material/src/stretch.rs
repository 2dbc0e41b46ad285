//! Stretch and compression of a traction law, as secants.

use drape_fabric::{Law, TractionLaw};

use crate::error::Error;

/// Strain at which the stiffness against compression is read, a ratio.
///
/// Yarns buckle beyond about a hundredth. At a smaller strain the stiffness describes a flat
/// fabric, at a larger strain a folded fabric.
const COMPRESSION_STRAIN: f64 = -0.01;

/// Strain of a fabric under a load on the first stretching, against the friction of the fabric.
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
    /// Returns the stretch of `law` under `load`, in N/m. `direction` names the yarns in an error.
    pub(crate) fn new(
        law: &TractionLaw,
        direction: &'static str,
        load: f64,
    ) -> Result<Self, Error> {
        let strain = law.strain_at(load).ok_or(Error::NoStretch { direction, load })?;
        Ok(Self { load, strain, stiffness: load / strain })
    }
}

/// Returns the secant stiffness of `law` from rest to a compression of 1 %, in N/m.
pub(crate) fn compression(law: &TractionLaw) -> f64 {
    law.respond(&law.virgin(), COMPRESSION_STRAIN).load / COMPRESSION_STRAIN
}
