//! Checks of the numbers and texts of a report before anything is drawn.

use crate::error::Error;

/// Largest number that a report shows, in SI or as the size of a unit.
///
/// It is far beyond anything measured, and its products with a unit still fit into an `f64`.
const LARGEST: f64 = 1e90;

/// Refuses a `value` that cannot be shown. The error names the quantity by `what`.
pub(crate) fn number(what: impl Fn() -> String, value: f64) -> Result<(), Error> {
    if value.abs() <= LARGEST { Ok(()) } else { Err(Error::NotFinite { what: what(), value }) }
}

/// Refuses the size of a unit, `in_si`, that is out of range.
pub(crate) fn unit(in_si: f64) -> Result<(), Error> {
    if (1.0 / LARGEST.sqrt()..=LARGEST.sqrt()).contains(&in_si) {
        Ok(())
    } else {
        Err(Error::OutOfRange {
            what: "the size of a unit in SI",
            value: in_si,
            range: "positive, between 1e-45 and 1e45",
        })
    }
}

/// Refuses a `text` with control characters other than line ends and tabs. The error names it by
/// `what`.
pub(crate) fn text(what: &str, text: &str) -> Result<(), Error> {
    match text.chars().find(|&character| !is_shown(character)) {
        None => Ok(()),
        Some(character) => Err(Error::ControlCharacter { what: what.to_owned(), character }),
    }
}

/// Returns whether a page and a terminal can show a `character`.
fn is_shown(character: char) -> bool {
    let is_noncharacter = matches!(character, '\u{fffe}' | '\u{ffff}');
    (!character.is_control() || matches!(character, '\n' | '\r' | '\t')) && !is_noncharacter
}
