//! Error of reading, making or cutting a pattern.

use drape_input::Diagnostics;

use crate::mistake::Mistake;

/// Reason why a pattern could not be read, made or cut.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file has mistakes; all that were found are listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// The pattern has mistakes, or cannot be cut at the spacing; all that were found are listed.
    #[error("{}", list(.0))]
    Pattern(Vec<Mistake>),
}

/// Returns `mistakes` as text, each with its remedy.
fn list(mistakes: &[Mistake]) -> String {
    let lines: Vec<String> =
        mistakes.iter().map(|mistake| format!("{mistake}\n  help: {}", mistake.help())).collect();
    lines.join("\n")
}
