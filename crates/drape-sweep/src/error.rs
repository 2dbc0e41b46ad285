//! Errors of studies.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics};
use thiserror::Error;

/// Reason why a study cannot be read, or why its results cannot be stored.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// Mistakes in the study or its base, with their remedies.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// A file or folder of the results cannot be read or written: check space and permissions.
    #[error("cannot {what} {}: {source}", path.display())]
    Io {
        /// Action that failed, such as "read".
        what: &'static str,
        /// File or folder.
        path: PathBuf,
        /// Message of the system.
        source: std::io::Error,
    },
}

impl Error {
    /// Returns a function that makes the error of the action `what` on the file or folder `path`.
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
