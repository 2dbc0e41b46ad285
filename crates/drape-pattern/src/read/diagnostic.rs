//! Answers to mistakes in files, shared by the readers.

mod foreign;

use drape_input::{Diagnostic, Document};

use crate::mistake::Mistake;

pub(crate) use foreign::foreign;

/// Returns the answer to a mistake of grammar or type in JSON.
pub(crate) fn syntax(document: &Document, error: &serde_json::Error) -> Diagnostic {
    let text = error.to_string();
    let message = text.split(" at line ").next().unwrap_or(&text);
    let mut diagnostic = Diagnostic::new(document.path(), message).on_line(error.line());
    diagnostic.column = Some(error.column());
    diagnostic
}

/// Returns the answer to a mistake of a pattern in a file.
pub(crate) fn diagnostic(document: &Document, mistake: &Mistake) -> Diagnostic {
    mistake.diagnostic(document.path())
}
