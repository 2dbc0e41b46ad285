//! Answers to mistakes in files, shared by the readers.

use drape_input::{Diagnostic, Document};

use crate::mistake::Mistake;
use crate::panel::Panel;

/// Sizes of panels of garments, in m; others come from a wrong unit.
const SIZES: std::ops::RangeInclusive<f64> = 0.02..=3.0;

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
    Diagnostic::new(document.path(), mistake.to_string()).help(mistake.help())
}

/// Returns the mistake of a panel whose size can only come from a wrong unit.
pub(crate) fn wrong_unit(panel: &Panel) -> Option<Mistake> {
    let size = panel.size();
    (!SIZES.contains(&size)).then(|| Mistake::Size { panel: panel.name().into(), size })
}
