//! Errors of this crate, each with its remedy.

use std::path::PathBuf;

/// Reason why a scene cannot be run or its results written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The solver cannot be set up for the scene.
    #[error("the solver cannot be set up: {0}")]
    Solver(#[from] drape_implicit::Error),
    /// The contact cannot be set up for the scene, which was changed after it had been checked.
    #[error("the contact cannot be set up: {0}")]
    Contact(#[from] drape_collide::Error),
    /// A checkpoint cannot be written or read.
    #[error(transparent)]
    Checkpoint(#[from] drape_checkpoint::Error),
    /// A checkpoint is not of the scene: run the scene anew.
    #[error("the checkpoint does not fit the scene: {reason}; run the scene anew with --force")]
    Unfit {
        /// What does not fit, in words.
        reason: String,
    },
    /// Frames that a checkpoint counts are missing: take an earlier one, or run the scene anew.
    #[error("{} has {found} frames, of {frames} that the checkpoint counts; run the scene anew with --force", path.display())]
    LostFrames {
        /// The list of frames.
        path: PathBuf,
        /// Number of those that are listed.
        found: usize,
        /// Number of those that there should be.
        frames: usize,
    },
    /// The folder for the results is there already: give another one, or allow it to be replaced.
    #[error("{} holds results already; give another folder, or allow it with --force", folder.display())]
    Occupied {
        /// The folder.
        folder: PathBuf,
    },
    /// Forces, or the motion of a body, that are asked for between steps do not suit the simulation.
    #[error("{reason}")]
    Unsuited {
        /// What does not suit it, with the remedy.
        reason: String,
    },
    /// A result could not be written: check space and permissions.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Message of the system.
        reason: std::io::Error,
    },
}
