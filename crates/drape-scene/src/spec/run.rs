//! The run: its times, its solver, its results.

use drape_input::{Angle, Length, Speed, Time};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::serde_as;

use crate::scene::solver::{Integrator, Method};

/// Steps and the end of the run.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSpec {
    /// Length of a step, or of the first one where they vary, in s.
    #[schemars(transform = drape_input::within(1e-7, 0.1))]
    #[serde_as(as = "Time")]
    pub step: f64,
    /// Shortest step where steps vary, in s: `step` divided by a power of two; `step`/32 with an
    /// error, else `step`, if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Time>")]
    pub step_min: Option<f64>,
    /// Longest step where steps vary, in s; 4 `step`, on the way to rest 200 `step`, if missing.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Option<Time>")]
    pub step_max: Option<f64>,
    /// Root mean square error of the positions that a step may make, by which its length is chosen;
    /// steps of one length if missing.
    #[schemars(transform = drape_input::between(1e-9, 0.1))]
    #[serde_as(as = "Option<Length>")]
    pub error: Option<f64>,
    /// Latest end of the run, in s.
    #[schemars(transform = drape_input::within(1e-7, 1e5))]
    #[serde_as(as = "Time")]
    pub end: f64,
    /// Time over which gravity grows to its value, in s.
    #[schemars(transform = drape_input::within(0.0, 1e5))]
    #[serde_as(as = "Time")]
    #[serde(default)]
    pub ramp: f64,
}

impl Default for TimeSpec {
    /// A second in steps of 5 ms.
    fn default() -> Self {
        Self { step: 0.005, step_min: None, step_max: None, error: None, end: 1.0, ramp: 0.0 }
    }
}

/// Run to rest.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SettleSpec {
    /// Largest speed of a particle at rest, kept for 0.1 s, in m/s.
    #[schemars(transform = drape_input::within(1e-6, 10.0))]
    #[serde_as(as = "Speed")]
    pub speed: f64,
    /// Largest imbalance of the forces at rest, root mean square, as a fraction of g.
    #[schemars(transform = drape_input::within(1e-8, 1.0))]
    pub residual: f64,
    /// Largest displacement of a particle in one step; a quarter of the spacing if missing.
    #[schemars(transform = drape_input::between(1e-7, 1.0))]
    #[serde_as(as = "Option<Length>")]
    pub stride: Option<f64>,
    /// Whether the way to rest is in time, with momentum, so that the cloth swings until it rests.
    pub inertia: bool,
}

impl Default for SettleSpec {
    fn default() -> Self {
        Self { speed: 0.002, residual: 1e-3, stride: None, inertia: false }
    }
}

/// Coarser grids on which the cloth comes to rest first.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RefineSpec {
    /// Spacings of the coarser grids, from the coarsest on, 8 at most. Panels and garments that
    /// name a spacing keep the ratio of this spacing to the spacing of the scene.
    #[serde_as(as = "Vec<Length>")]
    pub spacings: Vec<f64>,
}

/// Larger distances between particles where the cloth is flat.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GradingSpec {
    /// Folder of an earlier run of the scene, such as at twice the spacing, relative to the folder
    /// of the scene. The largest curvature in any of its frames counts.
    pub run: String,
    /// Largest angle by which the cloth turns from one particle to the next where they are farther
    /// apart than the spacing.
    #[schemars(transform = drape_input::within(0.1, 90.0))]
    #[serde_as(as = "Angle")]
    #[serde(default = "grading_angle")]
    pub angle: f64,
}

/// Returns the largest angle of graded cloth where a scene names none, in degrees.
fn grading_angle() -> f64 {
    30.0
}

impl Default for GradingSpec {
    fn default() -> Self {
        Self { run: String::new(), angle: grading_angle() }
    }
}

/// Phase that follows when the cloth has come to rest.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionPhaseSpec {
    /// Time for which bodies and pins then move, from the times 0 of their motions.
    #[schemars(transform = drape_input::positive)]
    #[serde_as(as = "Time")]
    pub seconds: f64,
}

/// Solver of the steps.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SolverSpec {
    /// Formula of the steps.
    pub integrator: Integrator,
    /// Method for the equations of a step.
    pub method: Method,
    /// Root mean square error of the acceleration at which a step is solved, as a fraction of g.
    #[schemars(extend("default" = 1e-4))]
    #[schemars(transform = drape_input::within(1e-10, 0.1))]
    pub tolerance: Option<f64>,
    /// Error that the solver may leave in a step, as a fraction of the step's own error in time; a
    /// step is solved as soon as this or the tolerance is met. 0 leaves the tolerance alone, and is
    /// the default where a tolerance of 1e-4 or less is given. Steps of relaxation have their own
    /// accuracy.
    #[schemars(extend("default" = 0.2))]
    #[schemars(transform = drape_input::within(0.0, 1.0))]
    pub error_fraction: Option<f64>,
}

/// Results.
#[serde_as]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct OutputSpec {
    /// Folder for the results; `out/` and the name of the file if missing.
    pub folder: Option<String>,
    /// Time between frames, in s; 0.04 s, or a step where that is longer, if missing.
    #[schemars(transform = drape_input::within(1e-7, 1e5))]
    #[serde_as(as = "Option<Time>")]
    pub every: Option<f64>,
    /// Whether the balance of the energy is kept. Without it a run takes a tenth less time.
    pub energy: bool,
    /// Direction from which the picture is taken, about the vertical, in degrees.
    #[schemars(extend("default" = 30.0))]
    #[serde_as(as = "Option<Angle>")]
    pub azimuth: Option<f64>,
    /// Height from which the picture is taken, in degrees above level.
    #[schemars(extend("default" = 28.0))]
    #[serde_as(as = "Option<Angle>")]
    pub elevation: Option<f64>,
}

impl Default for OutputSpec {
    fn default() -> Self {
        Self { folder: None, every: None, energy: true, azimuth: None, elevation: None }
    }
}
