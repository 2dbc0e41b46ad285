//! Diagnostics of mistakes in files, shared by the readers.

mod foreign;

use drape_input::{Diagnostic, Document};

use crate::mistake::Mistake;

pub(crate) use foreign::foreign_file;

/// Returns the diagnostic of `error`, a mistake of grammar or type in the JSON of `document`.
pub(crate) fn syntax(document: &Document, error: &serde_json::Error) -> Diagnostic {
    let text = error.to_string();
    let message = text.split(" at line ").next().unwrap_or(&text);
    let mut diagnostic = Diagnostic::new(document.path(), message).on_line(error.line());
    diagnostic.column = Some(error.column());
    diagnostic
}

/// Returns the diagnostic of `mistake`, a mistake of the pattern in `document`, without a line.
pub(crate) fn diagnostic(document: &Document, mistake: &Mistake) -> Diagnostic {
    mistake.diagnostic(document.path())
}
