//! Units within the text of a cell: in brackets, behind a sign or a blank.

use drape_input::{Quantity, is_unit, parse_unit};

/// Unit as written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenUnit {
    pub(crate) text: String,
    /// Whether a quantity has the unit.
    pub(crate) is_known: bool,
}

impl WrittenUnit {
    /// Parses the unit `text`; `None` for a text that is no unit. An unknown text may be a unit if
    /// it `is_bracketed`.
    pub(crate) fn parse(text: &str, is_bracketed: bool) -> Option<Self> {
        /// Quantities of results that no curve is measured in.
        const RESULTS: [Quantity; 4] = [
            Quantity::BendingRigidity,
            Quantity::ShearStiffness,
            Quantity::WorkPerArea,
            Quantity::MassPerArea,
        ];
        let text = text.trim();
        if text.is_empty() || text.parse::<f64>().is_ok() {
            return None;
        }

        let is_dash = ["-", "–", "—", "/"].contains(&text);
        // Outside of brackets these are words or names.
        let is_word = ["in", "m", "s", "h", "N", "C", "g", "cd"].contains(&text);
        let is_unit = is_unit(text) || parse_unit(text, &RESULTS).is_ok();
        let has_sign = text.contains(['/', '·', '・', '²', '^', '％']) && !text.contains(' ');
        let is_known = if is_dash { is_bracketed } else { is_unit && (is_bracketed || !is_word) };
        let may_be_unknown = !is_dash && is_bracketed && has_sign;
        (is_known || may_be_unknown).then(|| Self { text: text.to_owned(), is_known })
    }
}

/// Splits `text` before the longest unit at its end, behind a sign or a blank.
pub(crate) fn split_unit(text: &str) -> Option<(String, WrittenUnit)> {
    for (place, sign) in text.match_indices([',', '/', ':', ' ', '_', ';', '、', '：']) {
        let (before, behind) = (&text[..place], text[place + sign.len()..].trim());
        let unit = WrittenUnit::parse(behind, false).filter(|unit| unit.is_known);
        // A dash in a list states that there is no unit.
        let is_list = [",", "/", ";", "、"].contains(&sign);
        let dash = (is_list && ["-", "–"].contains(&behind))
            .then(|| WrittenUnit { text: "-".into(), is_known: true });
        let Some(unit) = unit.or(dash).filter(|_| !before.trim().is_empty()) else { continue };
        let signs = [' ', ',', '/', ':', '-'];
        let words = before.trim_end_matches(signs);
        let words = [" in", " en", " em"].iter().find_map(|end| words.strip_suffix(end));
        return Some((words.unwrap_or(before).trim_end_matches(signs).to_owned(), unit));
    }
    None
}

/// Returns the places of the first opening bracket in `text` and of its closing bracket.
pub(crate) fn find_bracket(text: &str) -> Option<(usize, usize)> {
    const PAIRS: [(char, char); 4] = [('(', ')'), ('[', ']'), ('<', '>'), ('{', '}')];
    let (start, open) =
        text.char_indices().find(|(_, letter)| PAIRS.iter().any(|(open, _)| open == letter))?;
    let close = PAIRS.iter().find(|(sign, _)| *sign == open)?.1;
    let mut depth = 0;
    for (place, letter) in text[start..].char_indices() {
        depth += i32::from(letter == open) - i32::from(letter == close);
        if depth == 0 {
            return Some((start, start + place));
        }
    }
    None
}
