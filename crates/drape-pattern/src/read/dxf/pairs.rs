//! Pairs of DXF: a line with a group code, then a line with its value.

use drape_input::{Diagnostic, Diagnostics, Document};

/// Group code with its value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<'a> {
    pub(crate) code: i32,
    pub(crate) value: &'a str,
    /// Line of the value, from 1.
    pub(crate) line: usize,
}

/// Returns the pairs of `document`.
///
/// # Errors
/// The file is binary, or a line is no group code.
pub(crate) fn pairs(document: &Document) -> Result<Vec<Pair<'_>>, Diagnostics> {
    let help = "export the pattern as DXF-AAMA or DXF-ASTM, in ASCII";
    let text = document.text();
    if text.starts_with("AutoCAD Binary DXF") {
        return Err(Diagnostic::new(document.path(), "the file is binary DXF").help(help).into());
    }

    let mut pairs = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((index, code)) = lines.next() {
        // An empty last line is no group code.
        if code.trim().is_empty() && text.lines().count() <= index + 1 {
            break;
        }
        let Ok(number) = code.trim().parse() else {
            let shown: String = code.trim().chars().take(40).collect();
            let message = format!("\"{shown}\" is no group code of DXF");
            return Err(Diagnostic::new(document.path(), message)
                .on_line(index + 1)
                .help(help)
                .into());
        };
        let Some((index, value)) = lines.next() else { break };
        pairs.push(Pair { code: number, value: value.trim(), line: index + 1 });
    }
    Ok(pairs)
}
