//! Units within the text of a cell: in brackets, behind a sign or a blank.

use drape_input::{Quantity, parse_unit};

/// Unit as it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenUnit {
    pub(crate) text: String,
    /// Whether any quantity has the unit.
    pub(crate) is_known: bool,
}

impl WrittenUnit {
    /// Returns the unit that a text is; `None` where it is none. Within brackets an unknown one may
    /// be a unit too.
    pub(crate) fn of(text: &str, is_bracketed: bool) -> Option<Self> {
        const ALL: [Quantity; 13] = [
            Quantity::Ratio,
            Quantity::Angle,
            Quantity::Length,
            Quantity::Curvature,
            Quantity::Force,
            Quantity::ForcePerWidth,
            Quantity::Moment,
            Quantity::MomentPerWidth,
            Quantity::BendingRigidity,
            Quantity::ShearStiffness,
            Quantity::WorkPerArea,
            Quantity::Pressure,
            Quantity::MassPerArea,
        ];
        let text = text.trim();
        let unit = |is_known: bool| Some(Self { text: text.to_owned(), is_known });
        if text.is_empty() || text.parse::<f64>().is_ok() {
            return None;
        }
        if ["-", "–", "—", "/"].contains(&text) {
            return if is_bracketed { unit(true) } else { None };
        }
        // Outside of brackets these are words or names.
        let is_word = ["in", "m", "s", "h", "N", "C", "g", "cd"].contains(&text);
        if (parse_unit(text, &ALL).is_ok() || drape_input::is_unit(text))
            && (is_bracketed || !is_word)
        {
            return unit(true);
        }
        let has_sign = text.contains(['/', '·', '・', '²', '^', '％']) && !text.contains(' ');
        if is_bracketed && has_sign { unit(false) } else { None }
    }
}

/// Splits a text before the longest unit at its end, behind a sign or a blank.
pub(crate) fn behind_sign(text: &str) -> Option<(String, WrittenUnit)> {
    for (place, sign) in text.match_indices([',', '/', ':', ' ', '_', ';', '、', '：']) {
        let (before, behind) = (&text[..place], text[place + sign.len()..].trim());
        let unit = WrittenUnit::of(behind, false).filter(|unit| unit.is_known);
        let is_list = [",", "/", ";", "、"].contains(&sign);
        let none = is_list && ["-", "–"].contains(&behind);
        let none = none.then(|| WrittenUnit { text: "-".into(), is_known: true });
        let Some(unit) = unit.or(none).filter(|_| !before.trim().is_empty()) else { continue };
        let signs = [' ', ',', '/', ':', '-'];
        let words = before.trim_end_matches(signs);
        let words = [" in", " en", " em"].iter().find_map(|end| words.strip_suffix(end));
        return Some((words.unwrap_or(before).trim_end_matches(signs).to_owned(), unit));
    }
    None
}

/// Returns the place of the first bracket and of the bracket that closes it.
pub(crate) fn bracket(text: &str) -> Option<(usize, usize)> {
    let pairs = [('(', ')'), ('[', ']'), ('<', '>'), ('{', '}')];
    let (start, open) =
        text.char_indices().find(|(_, c)| pairs.iter().any(|(open, _)| open == c))?;
    let close = pairs.iter().find(|(sign, _)| *sign == open)?.1;
    let mut depth = 0;
    for (place, letter) in text[start..].char_indices() {
        depth += i32::from(letter == open) - i32::from(letter == close);
        if depth == 0 {
            return Some((start, start + place));
        }
    }
    None
}
