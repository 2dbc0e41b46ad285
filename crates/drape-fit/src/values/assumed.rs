//! Defaults for values that a sheet does not have; each use is named in the result.

/// Mass per area: the median of 251 measured fabrics, in kg/m².
pub(crate) const DENSITY: f64 = 0.197;
/// Thickness of a shirting, in metres; it affects contact at rest and hardly the drape.
pub(crate) const THICKNESS: f64 = 0.4e-3;
/// Bending length `$(B/w)^{1/3}$`: the median of 251 measured fabrics, in metres.
const BENDING_LENGTH: f64 = 0.020;
/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

/// Shear stiffness, in N/(m·rad): 0.5 gf/(cm·deg), as of a light dress fabric.
pub(crate) const SHEAR_STIFFNESS: f64 = 28.1;
/// Width of the shear loop, in N/m: 0.5 gf/cm, as of a light dress fabric.
pub(crate) const SHEAR_LOOP_WIDTH: f64 = 0.49;

/// EM, a ratio: in the middle of the 3 to 8 % of apparel fabrics.
pub(crate) const EXTENSION: f64 = 0.05;
/// LT, a ratio: in the middle of the 0.6 to 0.9 of apparel fabrics.
pub(crate) const LINEARITY: f64 = 0.75;
/// RT, a ratio: in the middle of the 0.45 to 0.7 of apparel fabrics.
pub(crate) const RESILIENCE: f64 = 0.55;

/// Length of bending friction, in 1/m: 1/24.94 cm⁻¹, the one published measurement
/// \[THK03, fig. 8b\]. 2HB alone does not determine it.
pub(crate) const BENDING_FRICTION_LENGTH: f64 = 4.01;
/// Length of shear friction, the sine of 0.2°: well below the 0.5° at which 2HG is read, where KES
/// loops have reached their plateau.
pub(crate) const SHEAR_FRICTION_LENGTH: f64 = 3.49e-3;
/// Length of tensile friction, over EM; RT, an area, hardly depends on it.
pub(crate) const TENSILE_FRICTION_LENGTH: f64 = 0.03;

/// Returns the bending rigidity that a fabric of the given `density` has with the median bending
/// length, in N·m.
pub(crate) fn bending_rigidity(density: f64) -> f64 {
    density * GRAVITY * BENDING_LENGTH.powi(3)
}
