//! TOML form of the run: its times, its solver, its results.

use drape_input::{Angle, Given, Length, Speed, Time};
use serde::Deserialize;

/// Steps and the end of the run.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeFile {
    /// Length of a step, or of the first one where they vary, in s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 0.1)))]
    pub(crate) step: Given<Time>,
    /// Shortest step where steps vary, in s: `step` divided by a power of two; `step`/32 with an
    /// error, else `step`, if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) step_min: Option<Given<Time>>,
    /// Longest step where steps vary, in s; 4 `step`, on the way to rest 200 `step`, if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) step_max: Option<Given<Time>>,
    /// Root mean square error of the positions that a step may make, by which its length is chosen;
    /// steps of one length if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) error: Option<Given<Length>>,
    /// Latest end of the run, in s.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 1e5)))]
    pub(crate) end: Given<Time>,
    /// Time over which gravity grows to its value, in s.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.0)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e5)))]
    pub(crate) ramp: Option<Given<Time>>,
}

/// Run to rest.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SettleFile {
    /// Largest speed of a particle at rest, kept for 0.1 s, in m/s.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.002)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 10.0)))]
    pub(crate) speed: Option<Given<Speed>>,
    /// Largest imbalance of the forces at rest, root mean square, as a fraction of g.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.001)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-8, 1.0)))]
    pub(crate) residual: Option<f64>,
    /// Largest displacement of a particle in one step; a quarter of the spacing if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) stride: Option<Given<Length>>,
    /// Whether the way to rest is in time, with momentum, so that the cloth swings until it rests.
    #[cfg_attr(feature = "schema", schemars(extend("default" = false)))]
    pub(crate) inertia: Option<bool>,
}

/// Coarser grids on which the cloth comes to rest first.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RefineFile {
    /// Spacings of the coarser grids, from the coarsest on, 8 at most. Panels and garments that
    /// name a spacing keep the ratio of this spacing to the spacing of the scene.
    pub(crate) spacings: Vec<Given<Length>>,
}

/// Larger distances between particles where the cloth is flat.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GradingFile {
    /// Folder of an earlier run of the scene, such as at twice the spacing, relative to the folder
    /// of the scene. The largest curvature in any of its frames counts.
    pub(crate) run: String,
    /// Largest angle by which the cloth turns from one particle to the next where they are farther
    /// apart than the spacing.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 30.0)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.1, 90.0)))]
    pub(crate) angle: Option<Given<Angle>>,
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
    /// Formula of the steps: `bdf2`, `backward-euler`, or `explicit`, semi-implicit Euler in as
    /// many parts as stability requires.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "bdf2")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["bdf2", "backward-euler", "explicit"])))]
    pub(crate) integrator: Option<String>,
    /// Method for the equations of a step: `broyden` and `newton`; `textbook-mass` and
    /// `textbook-diagonal` are there for comparison.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "broyden")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["broyden", "newton", "textbook-mass", "textbook-diagonal"])))]
    pub(crate) method: Option<String>,
    /// Solver of linear systems.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "conjugate-gradient")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["conjugate-gradient", "cholesky"])))]
    pub(crate) linear: Option<String>,
    /// Root mean square error of the acceleration at which a step is solved, as a fraction of g.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 1e-4)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-10, 0.1)))]
    pub(crate) tolerance: Option<f64>,
    /// Error that the solver may leave in a step, as a fraction of the step's own error in time; a
    /// step is solved as soon as this or the tolerance is met. 0 leaves the tolerance alone, and is
    /// the default where a tolerance is given. Steps of relaxation have their own accuracy.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.2)))]
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1.0)))]
    pub(crate) error_fraction: Option<f64>,
}

/// Results.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputFile {
    /// Folder for the results; `out/` and the name of the file if missing.
    pub(crate) folder: Option<String>,
    /// Time between frames, in s; 0.04 s, or a step where that is longer, if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 1e5)))]
    pub(crate) every: Option<Given<Time>>,
    /// Whether the balance of the energy is kept. Without it a run takes a tenth less time.
    #[cfg_attr(feature = "schema", schemars(extend("default" = true)))]
    pub(crate) energy: Option<bool>,
    /// Direction from which the picture is taken, about the vertical, in degrees.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 30.0)))]
    pub(crate) azimuth: Option<Given<Angle>>,
    /// Height from which the picture is taken, in degrees above level.
    #[cfg_attr(feature = "schema", schemars(extend("default" = 28.0)))]
    pub(crate) elevation: Option<Given<Angle>>,
}
