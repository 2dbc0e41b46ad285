//! TOML form of the run: its times, its solver, its results.

use drape_input::{Angle, Given, Length, Speed, Time};
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeFile {
    /// Length of a step, in s, like all times.
    pub(crate) step: Given<Time>,
    pub(crate) step_min: Option<Given<Time>>,
    pub(crate) step_max: Option<Given<Time>>,
    /// Error of the positions that a step may make.
    pub(crate) error: Option<Given<Length>>,
    pub(crate) end: Given<Time>,
    /// Time over which gravity grows to its value.
    pub(crate) ramp: Option<Given<Time>>,
}

#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SettleFile {
    /// Largest speed at rest, in m/s.
    pub(crate) speed: Option<Given<Speed>>,
    /// Largest acceleration at rest, over g.
    pub(crate) residual: Option<f64>,
    /// Largest displacement of a particle in one step.
    pub(crate) stride: Option<Given<Length>>,
    pub(crate) inertia: Option<bool>,
}

/// Phase that follows when the cloth has come to rest.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionPhaseFile {
    /// Time for which bodies and pins then move, from the times 0 of their motions.
    pub(crate) seconds: Given<Time>,
}

#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SolverFile {
    /// `bdf2`, `backward-euler` or `explicit`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["bdf2", "backward-euler", "explicit"])))]
    pub(crate) integrator: Option<String>,
    /// `broyden`, `newton`, `textbook-mass` or `textbook-diagonal`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["broyden", "newton", "textbook-mass", "textbook-diagonal"])))]
    pub(crate) method: Option<String>,
    /// `conjugate-gradient` or `cholesky`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["conjugate-gradient", "cholesky"])))]
    pub(crate) linear: Option<String>,
    pub(crate) tolerance: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputFile {
    pub(crate) folder: Option<String>,
    /// Seconds between frames.
    pub(crate) every: Option<Given<Time>>,
    /// Whether the balance of the energy is kept.
    pub(crate) energy: Option<bool>,
    /// Direction from which the picture is taken, in degrees.
    pub(crate) azimuth: Option<Given<Angle>>,
    pub(crate) elevation: Option<Given<Angle>>,
}
