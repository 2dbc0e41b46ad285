//! Errors of a run in a folder, each with its remedy.

use std::path::PathBuf;

use drape_input::{Diagnostics, size_in_words};

/// Reason why a run cannot begin, continue or be stored.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Another run writes to the folder: wait, or give another folder.
    #[error("another run is writing to {}; wait for its end, or give another folder", folder.display())]
    Locked {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder holds an interrupted run: continue the run, or allow it to be replaced.
    #[error(
        "{} holds a run that was interrupted; go on with it as a `ResumableRun`, or begin anew with \
         `RunOptions` that replace it",
        folder.display()
    )]
    Interrupted {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder holds the run that the panels are graded by: give another folder.
    #[error(
        "{} holds the run that grading.run names; give another folder",
        folder.display()
    )]
    GradedBy {
        /// The folder.
        folder: PathBuf,
    },
    /// The run ends before its first step: give a later end.
    #[error("the end of the run is at {end} s: a step takes {step} s already")]
    End {
        /// End of the run, in s.
        end: f64,
        /// Length of a step, in s.
        step: f64,
    },
    /// The file of the request is damaged: begin the run anew.
    #[error("{}: {reason}; the file is not as it was written: restore it, or begin the run anew", path.display())]
    Damaged {
        /// File of the request.
        path: PathBuf,
        /// Fault, in words.
        reason: String,
    },
    /// No run was begun in the folder: name another folder.
    #[error("{}: {reason}; a folder in which a run was begun has it", path.display())]
    NotBegun {
        /// File of the request.
        path: PathBuf,
        /// Reason, in words.
        reason: String,
    },
    /// The run has reached its end: extend it.
    #[error(
        "{}: the run has ended ({status}); extend it to go on beyond its end",
        folder.display()
    )]
    Ended {
        /// The folder.
        folder: PathBuf,
        /// Status of its summary.
        status: String,
    },
    /// The run has failed: change its scene.
    #[error(
        "{}: the run has ended ({status}); it would end so again: change its scene, and run it anew \
         with `RunOptions` that replace it",
        folder.display()
    )]
    Failed {
        /// The folder.
        folder: PathBuf,
        /// Status of its summary.
        status: String,
    },
    /// No checkpoint exists that could be extended: run the scene anew.
    #[error("{}: no checkpoint is left to extend", folder.display())]
    NoCheckpoint {
        /// The folder.
        folder: PathBuf,
    },
    /// The run cannot be extended by the time that was asked for: give another time.
    #[error("{0}")]
    Extension(drape_dynamics::Error),
    /// The cloth has come to rest, which ends a run.
    #[error("the cloth is at rest, by which the run is over; there is nothing to extend")]
    AtRest,
    /// The disk is too full for the frames: name another folder, or write fewer frames.
    #[error(
        "the frames take {} of disk, and {} are free in {}; name another folder, or write fewer \
         frames: a larger output.every or a larger spacing",
        size_in_words(*needed),
        size_in_words(*free),
        folder.display()
    )]
    Space {
        /// The folder.
        folder: PathBuf,
        /// Disk that the frames take at least, in bytes.
        needed: u64,
        /// Free disk, in bytes.
        free: u64,
    },
    /// The folder cannot be created: check space and permissions.
    #[error("cannot write {}: {reason}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Message of the system.
        reason: std::io::Error,
    },
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] crate::file::Error),
    /// The scene, or an input of a checkpoint, has mistakes.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// The simulation cannot be set up, or its results cannot be written.
    #[error(transparent)]
    Dynamics(#[from] drape_dynamics::Error),
    /// The frames that were written cannot be read.
    #[error(transparent)]
    Frames(#[from] drape_frames::Error),
    /// The last frame cannot be written as OBJ: check space and permissions.
    #[error("cannot write {}: {reason}", path.display())]
    LastFrame {
        /// The file.
        path: PathBuf,
        /// Reason, in words.
        reason: String,
    },
}
