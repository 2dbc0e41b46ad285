//! Settings of the contact of surfaces.

use crate::barrier::Barrier;
use crate::error::{Error, check};
use crate::surface::geometry::{ContactDistances, THINNED_FRACTION};

/// Stiffness, friction and pinch policy of the contact of surfaces.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceSettings {
    /// Stiffness `$k$` per area, in N/m³.
    pub stiffness: f64,
    /// Sticking displacement `$\delta$` at which two surfaces begin to slide, in m.
    ///
    /// A load below Coulomb's limit displaces the surfaces by less than this, once. A smaller value
    /// holds more stiffly and is harder to solve.
    pub sticking_displacement: f64,
    /// Coefficient of friction for each two groups, row by row: the square of the number of groups.
    /// The entry `g * groups + h` is for the groups `g` and `h`, and equals the entry for `h` and
    /// `g`.
    pub friction_coefficients: Vec<f64>,
    /// Policy for cloth between closing bodies.
    pub pinch: PinchPolicy,
}

/// Policy for cloth that bodies pinch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PinchPolicy {
    /// A step that pinches cloth fails. The default.
    #[default]
    Error,
    /// The cloth keeps [`PinchPolicy::THINNED_FRACTION`] of its minimum separation from bodies.
    Thin,
    /// The approaching body passes through the cloth, and has contact again once it is out.
    Release,
}

impl PinchPolicy {
    /// Fraction of the minimum separation from bodies that thinned cloth keeps.
    pub const THINNED_FRACTION: f64 = THINNED_FRACTION;
}

impl SurfaceSettings {
    /// Default of [`sticking_displacement`](SurfaceSettings::sticking_displacement), in m.
    pub const STICKING_DISPLACEMENT: f64 = 5e-6;

    /// Returns settings with `stiffness`, in N/m³, and `friction_coefficients` for each two groups,
    /// row by row. The other settings have their defaults.
    #[must_use]
    pub fn new(stiffness: f64, friction_coefficients: Vec<f64>) -> SurfaceSettings {
        let (sticking_displacement, pinch) = (Self::STICKING_DISPLACEMENT, PinchPolicy::default());
        SurfaceSettings { stiffness, sticking_displacement, friction_coefficients, pinch }
    }

    /// Returns the stiffness, in N/m³, at which two equal sheets under `pressure`, in Pa, are
    /// `distance` apart, in m. It is infinite at the activation distance of `pair_distances`.
    ///
    /// Each of the two sheets counts the area of contact once: by its vertices over the triangles
    /// of the other sheet, and by the edges that cross.
    #[must_use]
    pub fn stiffness_for_pressure(
        pressure: f64,
        distance: f64,
        pair_distances: ContactDistances,
    ) -> f64 {
        let ContactDistances { activation_distance, min_separation } = pair_distances;
        let slope =
            Barrier::strict(activation_distance - min_separation).slope(distance - min_separation);
        pressure / (-2.0 * slope)
    }

    /// Checks the ranges of all settings, for `group_count` groups.
    pub(super) fn check(&self, group_count: usize) -> Result<(), Error> {
        for (what, value) in [
            ("the contact stiffness (N/m³)", self.stiffness),
            ("the sticking displacement (m)", self.sticking_displacement),
        ] {
            check(what, value, "above 0", value > 0.0)?;
        }
        let (needed, found) = (group_count * group_count, self.friction_coefficients.len());
        if needed != found {
            return Err(Error::WrongLength { what: "coefficients of friction", found, needed });
        }
        for &coefficient in &self.friction_coefficients {
            check("a coefficient of friction", coefficient, "0 or more", coefficient >= 0.0)?;
        }
        Ok(())
    }
}
