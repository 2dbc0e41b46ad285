//! Errors of studies.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics};
use thiserror::Error;

/// Reason why a study cannot be read, or its results cannot be kept.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// Mistakes in the study or its base: mend them.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// A file or folder of the results cannot be read or written: make room, or allow it.
    #[error("cannot {what} {}: {source}", path.display())]
    Io {
        /// What was tried, as in "read".
        what: &'static str,
        /// File or folder.
        path: PathBuf,
        /// Message of the system.
        source: std::io::Error,
    },
}

impl Error {
    /// Returns what makes the error of a file that could not be read or written.
    pub(crate) fn io(what: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { what, path, source }
    }
}

impl From<Diagnostic> for Error {
    fn from(mistake: Diagnostic) -> Self {
        Self::Input(mistake.into())
    }
}
