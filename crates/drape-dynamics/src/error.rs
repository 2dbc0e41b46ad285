//! Errors of this crate, each with its remedy.

/// Reason why a scene cannot be run, or why its results cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The solver cannot be set up for the scene.
    #[error("the solver cannot be set up: {0}")]
    Solver(#[from] drape_implicit::Error),
    /// The cloth, or the way it is sewn, does not fit the scene, which was changed after it was
    /// checked.
    #[error("the cloth does not fit the scene: {0}")]
    Cloth(#[from] drape_cloth::Error),
    /// Contact cannot be set up for the scene, which was changed after it was checked.
    #[error("the contact cannot be set up: {0}")]
    Contact(#[from] drape_collide::Error),
    /// A checkpoint cannot be written or read.
    #[error(transparent)]
    Checkpoint(#[from] drape_checkpoint::Error),
    /// A checkpoint does not fit the scene. Run the scene again.
    #[error("the checkpoint does not fit the scene: {reason}; run the scene again")]
    Unfit {
        /// Description of the part that does not fit.
        reason: String,
    },
    /// Frames cannot be written.
    #[error(transparent)]
    Frames(#[from] drape_frames::Error),
    /// A value that a program prescribes between steps does not suit the simulation: forces,
    /// gravity, air, a particle, a pin, or a motion of a body.
    #[error("{reason}")]
    Unsuited {
        /// Description of the fault, with the remedy.
        reason: String,
    },
}
