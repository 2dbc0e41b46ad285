//! TOML form of the run: its times, its solver, its results.

use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeFile {
    /// Length of a step, in s, like all times.
    pub(crate) step: f64,
    pub(crate) step_min: Option<f64>,
    pub(crate) step_max: Option<f64>,
    /// Error of the positions that a step may make.
    pub(crate) error: Option<f64>,
    pub(crate) end: f64,
    /// Time over which gravity grows to its value.
    pub(crate) ramp: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SettleFile {
    /// Largest speed at rest, in m/s.
    pub(crate) speed: Option<f64>,
    /// Largest acceleration at rest, over g.
    pub(crate) residual: Option<f64>,
    /// Largest displacement of a particle in one step.
    pub(crate) stride: Option<f64>,
    pub(crate) inertia: Option<bool>,
}

/// Phase that follows when the cloth has come to rest.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionPhaseFile {
    /// Time for which bodies and pins then move, from the times 0 of their motions.
    pub(crate) seconds: f64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SolverFile {
    /// `bdf2`, `backward-euler` or `explicit`.
    pub(crate) integrator: Option<String>,
    /// `broyden`, `newton`, `textbook-mass` or `textbook-diagonal`.
    pub(crate) method: Option<String>,
    /// `conjugate-gradient` or `cholesky`.
    pub(crate) linear: Option<String>,
    pub(crate) tolerance: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputFile {
    pub(crate) folder: Option<String>,
    /// Seconds between frames.
    pub(crate) every: Option<f64>,
    /// Whether the balance of the energy is kept.
    pub(crate) energy: Option<bool>,
    /// Direction from which the picture is taken, in degrees.
    pub(crate) azimuth: Option<f64>,
    pub(crate) elevation: Option<f64>,
}
