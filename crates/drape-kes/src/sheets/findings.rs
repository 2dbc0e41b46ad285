//! Errors and warnings about one sheet, collected while it is read.

use crate::scatter::OtherScatter;
use drape_input::{Advice, Diagnostic, Diagnostics, Document, Faults, ValueError, toml_string};

/// File being read, with the errors and warnings so far.
pub(crate) struct Findings<'t> {
    pub(crate) document: &'t Document,
    /// Mistakes of the text itself, with the values that they left out.
    pub(crate) faults: Faults,
    pub(crate) errors: Vec<Diagnostic>,
    pub(crate) warnings: Vec<Diagnostic>,
    /// What each curve file was taken for, one line per file.
    pub(crate) readings: Vec<String>,
    /// Key paths of values whose standard deviations are not used.
    pub(crate) unused_scatter: Vec<String>,
    /// Standard deviations that are not used.
    pub(crate) other_scatter: Vec<OtherScatter>,
}

impl<'t> Findings<'t> {
    /// Returns findings for `document`, whose text has `faults`, with no error or warning yet.
    pub(crate) fn new(document: &'t Document, faults: Faults) -> Self {
        Self {
            document,
            faults,
            errors: Vec::new(),
            warnings: Vec::new(),
            readings: Vec::new(),
            unused_scatter: Vec::new(),
            other_scatter: Vec::new(),
        }
    }

    /// Warns about all standard deviations that are not used, in one warning.
    pub(crate) fn warn_unused_scatter(&mut self) {
        let Some((first, others)) = self.unused_scatter.split_first() else { return };
        let others: Vec<_> = others.iter().map(|key| self.document.key_as_written(key)).collect();
        let (first, other_keys) = (first.clone(), others.join(", "));
        let message = if other_keys.is_empty() {
            "its standard deviation is not used".to_owned()
        } else {
            format!("its standard deviation is not used, nor are those of {other_keys}")
        };
        let help = "those of B, 2HB, G, 2HG, 2HG5, LT, WT, RT and EM give intervals";
        self.warn(&first, message, help);
    }

    /// Adds an error about the value at the key path `key`, with its remedy `help`. Nothing is
    /// added about a value that was left out.
    pub(crate) fn error(&mut self, key: &str, message: impl Into<String>, help: impl Into<Advice>) {
        if !self.faults.cover(key) {
            self.errors.push(self.document.at(key, message).help(help));
        }
    }

    /// Adds the error that the text at the key path `key` is wrong for the reason `error`.
    pub(crate) fn refuse(&mut self, key: &str, error: ValueError) {
        let ValueError { message, help, intended_value } = error;
        let edit =
            intended_value.and_then(|text| self.document.edit(key, Some(&toml_string(&text))));
        self.errors.push(self.document.at(key, message).help(help).with_edits(edit));
    }

    /// Adds a warning about the value at the key path `key`, with its remedy `help`.
    pub(crate) fn warn(&mut self, key: &str, message: impl Into<String>, help: impl Into<Advice>) {
        self.warnings.push(self.document.at(key, message).help(help));
    }

    /// Returns the value of `result`, or `None` after collecting its mistakes.
    pub(crate) fn collect<T>(&mut self, result: Result<T, Diagnostics>) -> Option<T> {
        result.map_err(|Diagnostics(mistakes)| self.errors.extend(mistakes)).ok()
    }
}
