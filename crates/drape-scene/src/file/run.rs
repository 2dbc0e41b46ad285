//! TOML form of the run: its times, its solver, its results.

use drape_input::{Angle, Given, Length, Speed, Time};
use serde::Deserialize;

/// Steps and the end of the run.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeFile {
    /// Length of a step, in s, like all times.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 0.1)))]
    pub(crate) step: Given<Time>,
    /// Shortest step, in s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) step_min: Option<Given<Time>>,
    /// Longest step, in s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) step_max: Option<Given<Time>>,
    /// Error of the positions that a step may make.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) error: Option<Given<Length>>,
    /// Latest end of the run, in s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 1e5)))]
    pub(crate) end: Given<Time>,
    /// Time over which gravity grows to its value.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e5)))]
    pub(crate) ramp: Option<Given<Time>>,
}

/// Run to rest.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SettleFile {
    /// Largest speed at rest, in m/s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 10.0)))]
    pub(crate) speed: Option<Given<Speed>>,
    /// Largest acceleration at rest, over g.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-8, 1.0)))]
    pub(crate) residual: Option<f64>,
    /// Largest displacement of a particle in one step.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) stride: Option<Given<Length>>,
    /// Whether the way to rest is in time, with momentum.
    pub(crate) inertia: Option<bool>,
}

/// Phase that follows when the cloth has come to rest.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionPhaseFile {
    /// Time for which bodies and pins then move, from the times 0 of their motions.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) seconds: Given<Time>,
}

/// Solver of the steps.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SolverFile {
    /// Formula of the steps: `bdf2`, `backward-euler` or `explicit`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["bdf2", "backward-euler", "explicit"])))]
    pub(crate) integrator: Option<String>,
    /// Method for the equations of a step: `broyden`, `newton`, `textbook-mass` or `textbook-diagonal`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["broyden", "newton", "textbook-mass", "textbook-diagonal"])))]
    pub(crate) method: Option<String>,
    /// Solver of linear systems: `conjugate-gradient` or `cholesky`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["conjugate-gradient", "cholesky"])))]
    pub(crate) linear: Option<String>,
    /// Relative error of the equations of a step.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-10, 0.1)))]
    pub(crate) tolerance: Option<f64>,
}

/// Results.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputFile {
    /// Folder for the results; out/NAME if missing.
    pub(crate) folder: Option<String>,
    /// Seconds between frames.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 1e5)))]
    pub(crate) every: Option<Given<Time>>,
    /// Whether the balance of the energy is kept.
    pub(crate) energy: Option<bool>,
    /// Direction from which the picture is taken, about the vertical, in degrees.
    pub(crate) azimuth: Option<Given<Angle>>,
    /// Height from which the picture is taken, in degrees above level.
    pub(crate) elevation: Option<Given<Angle>>,
}
