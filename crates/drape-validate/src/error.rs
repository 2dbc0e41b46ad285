//! Error of a case that cannot be run to its end. All modules return it; the suite tells it.

use drape_input::Diagnostics;

/// Reason why a case cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ValidationError {
    /// A scene of the suite, or a fabric that it was given, is wrong.
    #[error("{0}")]
    Scene(#[from] drape_scene::Error),
    /// A scene of the suite cannot be set up, or its frames stored.
    #[error("{0}")]
    Simulation(#[from] drape_dynamics::Error),
    /// A step could not be solved.
    #[error("{0}")]
    Step(#[from] drape_implicit::Error),
    /// A curve that is none.
    #[error("{0}")]
    Curve(#[from] drape_kes::Error),
    /// Too few starts for a deviation.
    #[error("{starts} starts have no standard deviation; take 2 or more")]
    Starts {
        /// As asked for.
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
