//! Settings of the contact of particles.

use crate::barrier::Barrier;
use crate::error::{Error, check};

/// Activation distance, stiffness and slip speed of the contact of particles.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParticleSettings {
    /// Activation distance `$\hat d$` from a body, in m.
    ///
    /// The middle surface of cloth rests just below this distance. It is half the cloth's thickness
    /// plus a margin for the picture or for the spacing of the particles. Default 1 mm.
    pub activation_distance: f64,
    /// Stiffness `$k_A$` per area of cloth, in N/m³.
    ///
    /// The pressure is `$-k_A b'(d)$`: `$k_A \hat d/2$` at half the activation distance,
    /// `$2.5\,k_A \hat d$` at a tenth of it, `$5\,k_A \hat d$` at the surface itself. The default
    /// 2·10⁶ N/m³ with the default distance carries 5 kPa at a tenth of the distance: the pressure
    /// of a KES compression test (50 gf/cm²). A cloth of 100 g/m² at rest sinks by 0.5 µm. A larger
    /// stiffness carries heavier loads and takes the solver more iterations.
    pub stiffness: f64,
    /// Slip speed `$\epsilon_v$` below which a particle in contact sticks, in m/s.
    ///
    /// Friction reaches Coulomb's limit at this speed, so a particle that sticks still moves, at
    /// most at this speed. A smaller value makes the step harder to solve. Default 1 mm/s.
    pub slip_speed: f64,
}

impl Default for ParticleSettings {
    fn default() -> ParticleSettings {
        ParticleSettings { activation_distance: 1e-3, stiffness: 2e6, slip_speed: 1e-3 }
    }
}

impl ParticleSettings {
    /// Returns the contact pressure at `distance` from a body, in Pa.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        -self.stiffness * Barrier::new(self.activation_distance).slope(distance)
    }

    /// Checks that each setting is above 0.
    pub(super) fn check(&self) -> Result<(), Error> {
        for (what, value) in [
            ("the contact offset (m)", self.activation_distance),
            ("the contact stiffness (N/m³)", self.stiffness),
            ("the slip speed (m/s)", self.slip_speed),
        ] {
            check(what, value, "above 0", value > 0.0)?;
        }
        Ok(())
    }
}
