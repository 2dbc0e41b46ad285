//! Error of reading a scene.

use drape_input::Diagnostics;

use crate::tangle::Tangle;

/// Error of reading a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene, or a file that it names, has mistakes: correct them; all that were found are listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// Surfaces cross at the start, or are too near: move panels and bodies apart.
    #[error("{}", .0.mistakes)]
    Tangled(Box<Tangle>),
}
