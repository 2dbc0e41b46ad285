//! What a report's numbers and texts must satisfy before anything is drawn.

use crate::error::ReportError;

/// Largest number that a report shows, in SI or as a unit's size.
///
/// Far beyond anything measured, and its products with a unit still fit into an `f64`.
const LARGEST: f64 = 1e90;

/// A number that can be shown.
pub(crate) fn number(what: impl Fn() -> String, value: f64) -> Result<(), ReportError> {
    if value.abs() <= LARGEST {
        Ok(())
    } else {
        Err(ReportError::NotFinite { what: what(), value })
    }
}

/// The size of a unit in SI.
pub(crate) fn unit(in_si: f64) -> Result<(), ReportError> {
    if (1.0 / LARGEST.sqrt()..=LARGEST.sqrt()).contains(&in_si) {
        Ok(())
    } else {
        Err(ReportError::OutOfRange {
            what: "the size of a unit in SI",
            value: in_si,
            range: "positive, between 1e-45 and 1e45",
        })
    }
}

/// A text that a page and a terminal can show: no control characters but line ends and tabs.
pub(crate) fn text(what: &str, text: &str) -> Result<(), ReportError> {
    let shown = |c: char| !c.is_control() || matches!(c, '\n' | '\r' | '\t');
    let noncharacter = |c: char| matches!(c, '\u{fffe}' | '\u{ffff}');
    match text.chars().find(|&c| !shown(c) || noncharacter(c)) {
        None => Ok(()),
        Some(character) => Err(ReportError::ControlCharacter { what: what.to_owned(), character }),
    }
}
