//! Number with its scatter in one cell: `0.085 ± 0.004`, `0.045 (0.002)`.

use crate::tables::number::evidence;

/// Signs between a number and its scatter.
const SIGNS: [&str; 8] = ["±", "+/-", "+/−", "+-", "+−", "＋/－", "＋／－", "∓"];
/// Brackets around a scatter.
const BRACKETS: [(char, char); 4] = [('(', ')'), ('[', ']'), ('（', '）'), ('［', '］')];
/// Words before a standard deviation within its brackets, in small letters.
const DEVIATIONS: [&str; 9] = ["±", "s.d.", "std", "sd", "stdev", "s", "σ", "標準偏差", "标准差"];
/// Words before a coefficient of variation within its brackets, in small letters.
const VARIATIONS: [&str; 6] = ["cv%", "c.v.", "cv", "vk", "変動係数", "变异系数"];

/// Meaning of the second number of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spread {
    /// In the unit of the first number.
    Absolute,
    /// Percent of the first number.
    Percent,
    /// Percent of the first number, or in the unit of the first number if that unit is percent.
    PercentOrUnit,
    /// A whole number behind a number with a fraction, as in `0.112 (3)`: last digits, or something
    /// else.
    Unclear,
}

/// Number and scatter as written, without the signs between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scattered<'t> {
    pub(crate) number: &'t str,
    pub(crate) deviation: &'t str,
    pub(crate) spread: Spread,
    /// Unit of both numbers; empty if none is written.
    pub(crate) unit: &'t str,
}

/// Splits `text` into a number and its scatter; `None` for any other text.
///
/// ```text
/// 0.085 ± 0.004   0,085±0,004   0.085 +/- 0.004   (0.085 ± 0.004) N   0.085 ± 5 %
/// 0.045 (0.002)   0.045 [0.002] N   0.045 (SD 0.002)   0.045 (CV 4.2 %)
/// ```
pub(crate) fn scattered(text: &str) -> Option<Scattered<'_>> {
    let text = text.trim();
    if !text.contains(|letter: char| letter.is_numeric()) {
        return None;
    }
    let sign = SIGNS.iter().find_map(|sign| text.split_once(sign));
    match sign.filter(|(before, _)| !before.trim().is_empty()) {
        Some((before, behind)) => split_at_sign(before, behind),
        None => split_at_brackets(text),
    }
}

/// Splits a text at the sign between the number `before` and the scatter `behind`.
fn split_at_sign<'t>(before: &'t str, behind: &'t str) -> Option<Scattered<'t>> {
    // One pair of brackets may stand around both numbers, with the unit behind it.
    let [opening, closing] = [BRACKETS.map(|(open, _)| open), BRACKETS.map(|(_, close)| close)];
    let before = before.trim().trim_start_matches(opening);
    let (number, unit) = leading_number(before)?;
    let (deviation, rest) = leading_number(behind.trim())?;
    let rest = rest.trim().trim_start_matches(closing).trim();
    let (is_percent, rest) = strip_percent(rest);
    let unit = if rest.is_empty() { unit } else { rest };

    let spread = if !is_percent {
        Spread::Absolute
    } else if unit.is_empty() || strip_percent(unit).0 {
        Spread::PercentOrUnit
    } else {
        Spread::Percent
    };
    let unit = if spread == Spread::PercentOrUnit || strip_percent(unit).0 { "%" } else { unit };
    Some(Scattered { number, deviation, spread, unit })
}

/// Splits `text` at the brackets around the scatter.
fn split_at_brackets(text: &str) -> Option<Scattered<'_>> {
    let (start, open) =
        text.char_indices().find(|(_, c)| BRACKETS.iter().any(|(open, _)| open == c))?;
    let close = BRACKETS.iter().find(|(sign, _)| *sign == open).map(|(_, close)| *close)?;
    let end = start + text[start..].find(close)?;
    let (number, unit) = leading_number(&text[..start])?;
    let behind = text[end + close.len_utf8()..].trim();
    let unit = if behind.is_empty() { unit } else { behind };

    // Within the brackets may stand a word, a number and a unit.
    let inside = text[start + open.len_utf8()..end].trim();
    let small = inside.to_lowercase();
    let variation = longest_start(&small, &VARIATIONS);
    let is_variation = variation.is_some();
    let skipped = variation.or_else(|| longest_start(&small, &DEVIATIONS)).unwrap_or(0);
    let inside = inside.get(skipped..)?.trim_start_matches(['=', ':', ' ', '.']);
    let (deviation, rest) = leading_number(inside)?;
    let (is_percent, rest) = strip_percent(rest);
    if !rest.is_empty() && rest != unit && !unit.is_empty() {
        return None;
    }

    let spread = if is_variation || (is_percent && !strip_percent(unit).0 && !unit.is_empty()) {
        Spread::Percent
    } else if is_percent {
        Spread::PercentOrUnit
    } else if skipped == 0 && is_whole(deviation) && !is_whole(number) {
        Spread::Unclear
    } else {
        Spread::Absolute
    };
    let unit = if unit.is_empty() { rest } else { unit };
    Some(Scattered {
        number,
        deviation,
        spread,
        unit: if strip_percent(unit).0 { "%" } else { unit },
    })
}

/// Returns the length of the longest of `words` with which `text` starts.
fn longest_start(text: &str, words: &[&str]) -> Option<usize> {
    words.iter().filter(|word| text.starts_with(**word)).map(|word| word.len()).max()
}

/// Returns whether `text` has only ASCII digits.
fn is_whole(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Splits `text` behind the longest number at its start; `None` if no number stands there.
pub(crate) fn leading_number(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let end = text
        .find(|letter: char| !(letter.is_numeric() || "+-−－.,．，' \u{a0}eE".contains(letter)))
        .unwrap_or(text.len());
    let mut ends =
        text[..end].char_indices().map(|(place, letter)| place + letter.len_utf8()).rev();
    let end = ends
        .find(|&end| text[..end].ends_with(char::is_numeric) && evidence(&text[..end]).is_some())?;
    Some((&text[..end], text[end..].trim()))
}

/// Returns whether `text` begins with the sign of percent, and the text behind the sign.
fn strip_percent(text: &str) -> (bool, &str) {
    let behind = text.strip_prefix('%').or_else(|| text.strip_prefix('％'));
    (behind.is_some(), behind.unwrap_or(text).trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_and_its_scatter_are_read_as_laboratories_write_them() {
        use Spread::{Absolute, Percent, PercentOrUnit, Unclear};
        let cases = [
            ("0.085 ± 0.004", "0.085", "0.004", Absolute, ""),
            ("0,085±0,004", "0,085", "0,004", Absolute, ""),
            ("0.085 +/- 0.004", "0.085", "0.004", Absolute, ""),
            ("0.045 (0.002)", "0.045", "0.002", Absolute, ""),
            ("0.085 [0.004]", "0.085", "0.004", Absolute, ""),
            ("０．０８５（０．００４）", "０．０８５", "０．００４", Absolute, ""),
            ("(0.085 ± 0.004) N.m", "0.085", "0.004", Absolute, "N.m"),
            ("0.085 ± 0.004 gf.cm2/cm", "0.085", "0.004", Absolute, "gf.cm2/cm"),
            ("0.085 N.m (0.004)", "0.085", "0.004", Absolute, "N.m"),
            ("0.085 (SD 0.004)", "0.085", "0.004", Absolute, ""),
            ("0.085 (s = 0.004)", "0.085", "0.004", Absolute, ""),
            ("0.085 (CV: 4.2 %)", "0.085", "4.2", Percent, ""),
            ("0.085 N.m ± 4 %", "0.085", "4", Percent, "N.m"),
            ("58 ± 2 %", "58", "2", PercentOrUnit, "%"),
            ("58 % (2 %)", "58", "2", PercentOrUnit, "%"),
            ("0.085 (4.2 %)", "0.085", "4.2", PercentOrUnit, ""),
            ("0.112 (3)", "0.112", "3", Unclear, ""),
            ("58 (2)", "58", "2", Absolute, ""),
            ("1.2e-5 ± 3e-7", "1.2e-5", "3e-7", Absolute, ""),
        ];
        for (text, number, deviation, spread, unit) in cases {
            let found = scattered(text);
            assert_eq!(found, Some(Scattered { number, deviation, spread, unit }), "{text}");
        }
        for text in
            ["0.085", "Warp (1)", "0.085 N", "± 0.1", "B (gf.cm2/cm)", "(0.1)", "0.1 (n.d.)"]
        {
            assert_eq!(scattered(text), None, "{text}");
        }
    }
}
