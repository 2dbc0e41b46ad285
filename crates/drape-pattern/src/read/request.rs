//! Request for a pattern file, with choices that its reader cannot make alone.

use std::path::PathBuf;

use drape_input::{Document, Edit, FileAccess};

use super::unit::Unit;

/// File to be read, with facts that it may not state.
#[derive(Debug, Clone)]
pub struct Request {
    /// Path of the file.
    pub path: PathBuf,
    /// Unit of its lengths; `None` for the unit that the file states.
    pub unit: Option<Unit>,
    /// Size in a graded file; `None` for the only size, or the sample size.
    pub size: Option<String>,
    /// Pattern whose table `[from]` makes the request. A remedy of a mistake is an edit of this
    /// pattern.
    pub from: Option<Document>,
    /// Access to the file.
    pub access: FileAccess,
}

impl Request {
    /// Returns the request for the file `path` without choices.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self {
            path: path.into(),
            unit: None,
            size: None,
            from: None,
            access: FileAccess::default(),
        }
    }

    /// Returns the edit that sets `key` of the request to `value`, in TOML.
    pub(crate) fn edit(&self, key: &str, value: &str) -> Option<Edit> {
        self.from.as_ref()?.edit(&format!("from.{key}"), Some(value))
    }

    /// Returns the edit that removes `key` from the request.
    pub(crate) fn edit_out(&self, key: &str) -> Option<Edit> {
        self.from.as_ref()?.edit(&format!("from.{key}"), None)
    }
}
