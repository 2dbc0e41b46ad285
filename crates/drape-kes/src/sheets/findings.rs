//! Errors and warnings about one sheet, collected while it is read.

use crate::scatter::OtherScatter;
use drape_input::{Diagnostic, Diagnostics, Document};

/// File being read, with the errors and warnings so far.
pub(crate) struct Findings<'t> {
    pub(crate) document: &'t Document,
    pub(crate) errors: Vec<Diagnostic>,
    pub(crate) warnings: Vec<Diagnostic>,
    /// What was taken for what, a line for each file.
    pub(crate) readings: Vec<String>,
    /// Key paths of values whose standard deviations have no use.
    pub(crate) unused_scatter: Vec<String>,
    /// Those standard deviations.
    pub(crate) other_scatter: Vec<OtherScatter>,
}

impl<'t> Findings<'t> {
    pub(crate) fn new(document: &'t Document) -> Self {
        Self {
            document,
            errors: Vec::new(),
            warnings: Vec::new(),
            readings: Vec::new(),
            unused_scatter: Vec::new(),
            other_scatter: Vec::new(),
        }
    }

    /// Warns about standard deviations that have no use, all together.
    pub(crate) fn tell_unused_scatter(&mut self) {
        let Some(first) = self.unused_scatter.first().cloned() else { return };
        let others = self.unused_scatter[1..].join(", ");
        let message = if others.is_empty() {
            "its standard deviation is not used".to_owned()
        } else {
            format!("its standard deviation is not used, nor are those of {others}")
        };
        let help = "those of B, 2HB, G, 2HG, 2HG5, LT, WT, RT and EM give intervals";
        self.warn(&first, message, help);
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
