//! Error of a case that cannot be run to its end.
//!
//! All modules return this error. The suite turns it into the failure of an outcome.

use drape_input::Diagnostics;

/// Reason why a case cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ValidationError {
    /// A scene of the suite, or the fabric in it, is wrong.
    #[error("{0}")]
    Scene(#[from] drape_scene::Error),
    /// A scene of the suite cannot be set up, or its frames cannot be stored.
    #[error("{0}")]
    Simulation(#[from] drape_dynamics::Error),
    /// A step could not be solved.
    #[error("{0}")]
    Step(#[from] drape_implicit::Error),
    /// Deformations and loads do not form a curve.
    #[error("{0}")]
    Curve(#[from] drape_kes::Error),
    /// A study has too few starts for a standard deviation.
    #[error("{starts} starts have no standard deviation; take 2 or more")]
    Starts {
        /// Number of starts that was asked for.
        starts: u64,
    },
    /// A strip that should rest still moves.
    #[error("the strip did not come to rest in {seconds} s")]
    NotSettled {
        /// Simulated time, in s.
        seconds: f64,
    },
    /// The text of a scene is wrong.
    #[error("{0}")]
    Input(#[from] Diagnostics),
}
