//! Choices that a reader cannot make alone.

use std::path::PathBuf;

use drape_input::{Document, Edit};

use super::unit::Unit;

/// File to be read, with what it may not say itself.
#[derive(Debug, Clone)]
pub struct Request {
    /// Path of the file.
    pub path: PathBuf,
    /// Unit of its lengths; `None` to take what the file says.
    pub unit: Option<Unit>,
    /// Size among those of a graded file; `None` to take the only one, or the sample size.
    pub size: Option<String>,
    /// Pattern whose table `[from]` makes the request, if one does: remedies are edits of it.
    pub from: Option<Document>,
}

impl Request {
    /// Returns the request of a file as it is.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), unit: None, size: None, from: None }
    }

    /// Returns the change by which the request has another value of a key, in TOML.
    pub(crate) fn edit(&self, key: &str, new: &str) -> Option<Edit> {
        self.from.as_ref()?.edit(&format!("from.{key}"), Some(new))
    }

    /// Returns the change by which the request leaves a key out.
    pub(crate) fn edit_out(&self, key: &str) -> Option<Edit> {
        self.from.as_ref()?.edit(&format!("from.{key}"), None)
    }
}
