//! Choices that a reader cannot make alone.

use std::path::PathBuf;

use super::unit::Unit;

/// File to be read, with what it may not say itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Path of the file.
    pub path: PathBuf,
    /// Unit of its lengths; `None` to take what the file says.
    pub unit: Option<Unit>,
    /// Size among those of a graded file; `None` to take the only one, or the sample size.
    pub size: Option<String>,
}

impl Request {
    /// Returns the request of a file as it is.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), unit: None, size: None }
    }
}
