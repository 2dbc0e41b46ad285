use std::path::PathBuf;

use drape_input::Diagnostics;

use crate::Tangle;

/// Why a scene could not be read, run or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The scene, or a file that it names, has mistakes: correct them; all that were found are listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// Surfaces cross at the start, or are too near: move panels and bodies apart.
    #[error("{}", .0.mistakes)]
    Tangled(Box<Tangle>),
    /// The solver cannot be set up for the scene.
    #[error("the solver cannot be set up: {0}")]
    Solver(#[from] drape_implicit::Error),
    /// The folder for the results is there already: give another one, or allow it to be replaced.
    #[error("{} holds results already; give another folder, or allow it with --force", folder.display())]
    Occupied {
        /// The folder.
        folder: PathBuf,
    },
    /// A result could not be written: check space and permissions.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: std::io::Error,
    },
}
