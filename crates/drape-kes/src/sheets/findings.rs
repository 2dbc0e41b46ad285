//! Errors and warnings about one sheet, collected while it is read.

use drape_input::{Diagnostic, Diagnostics, Document};

/// File being read, with the errors and warnings so far.
pub(crate) struct Findings<'t> {
    pub(crate) document: &'t Document,
    pub(crate) errors: Vec<Diagnostic>,
    pub(crate) warnings: Vec<Diagnostic>,
    /// What was taken for what, a line for each file.
    pub(crate) readings: Vec<String>,
}

impl<'t> Findings<'t> {
    pub(crate) fn new(document: &'t Document) -> Self {
        Self { document, errors: Vec::new(), warnings: Vec::new(), readings: Vec::new() }
    }

    /// Adds an error in the value at a key path.
    pub(crate) fn error(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(self.document.at(key, message).help(help));
    }

    /// Adds a warning about the value at a key path.
    pub(crate) fn warn(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.warnings.push(self.document.at(key, message).help(help));
    }

    /// Returns a result, or `None` after collecting its mistakes.
    pub(crate) fn collect<T>(&mut self, result: Result<T, Diagnostics>) -> Option<T> {
        result.map_err(|Diagnostics(mistakes)| self.errors.extend(mistakes)).ok()
    }
}
