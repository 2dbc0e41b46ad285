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

/// What the second number of a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spread {
    /// In the unit of the first number.
    Absolute,
    /// Percent of the first number.
    Percent,
    /// Percent of the first number, or in its unit where that is percent too.
    PercentOrUnit,
    /// A whole number behind one with a fraction, as in `0.112 (3)`: last digits, or something
    /// else.
    Unclear,
}

/// Number and scatter as they are written, without the signs between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scattered<'t> {
    pub(crate) number: &'t str,
    pub(crate) deviation: &'t str,
    pub(crate) spread: Spread,
    /// Unit of both; empty where none is written.
    pub(crate) unit: &'t str,
}

/// Parts a cell into a number and its scatter; `None` where the cell is anything else.
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
        Some((before, behind)) => by_sign(before, behind),
        None => by_brackets(text),
    }
}

fn by_sign<'t>(before: &'t str, behind: &'t str) -> Option<Scattered<'t>> {
    // One pair of brackets may stand around both numbers, with the unit behind it.
    let open = |letter: char| BRACKETS.iter().any(|(open, _)| *open == letter);
    let before = before.trim().trim_start_matches(open);
    let (number, unit) = leading_number(before)?;
    let (deviation, rest) = leading_number(behind.trim())?;
    let close = |letter: char| BRACKETS.iter().any(|(_, close)| *close == letter);
    let rest = rest.trim().trim_start_matches(close).trim();
    let (is_percent, rest) = percent(rest);
    let unit = if rest.is_empty() { unit } else { rest };
    let spread = if !is_percent {
        Spread::Absolute
    } else if unit.is_empty() || percent(unit).0 {
        Spread::PercentOrUnit
    } else {
        Spread::Percent
    };
    let unit = if spread == Spread::PercentOrUnit || percent(unit).0 { "%" } else { unit };
    Some(Scattered { number, deviation, spread, unit })
}

fn by_brackets(text: &str) -> Option<Scattered<'_>> {
    let (start, open) =
        text.char_indices().find(|(_, c)| BRACKETS.iter().any(|(open, _)| open == c))?;
    let close = BRACKETS.iter().find(|(sign, _)| *sign == open).map(|(_, close)| *close)?;
    let end = start + text[start..].find(close)?;
    let (number, unit) = leading_number(&text[..start])?;
    let behind = text[end + close.len_utf8()..].trim();
    let unit = if behind.is_empty() { unit } else { behind };
    // What stands within: perhaps a word, a number, perhaps a unit.
    let inside = text[start + open.len_utf8()..end].trim();
    let small = inside.to_lowercase();
    let word = |words: &[&'static str]| {
        let starts = |word: &&&str| small.starts_with(**word);
        words.iter().filter(starts).map(|word| word.len()).max()
    };
    let (is_variation, skipped) = match (word(&VARIATIONS), word(&DEVIATIONS)) {
        (Some(length), _) => (true, length),
        (None, Some(length)) => (false, length),
        (None, None) => (false, 0),
    };
    let inside = inside.get(skipped..)?.trim_start_matches(['=', ':', ' ', '.']);
    let (deviation, rest) = leading_number(inside)?;
    let (is_percent, rest) = percent(rest);
    if !rest.is_empty() && rest != unit && !unit.is_empty() {
        return None;
    }
    let is_whole = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let spread = if is_variation || (is_percent && !percent(unit).0 && !unit.is_empty()) {
        Spread::Percent
    } else if is_percent {
        Spread::PercentOrUnit
    } else if skipped == 0 && is_whole(deviation) && !is_whole(number) {
        Spread::Unclear
    } else {
        Spread::Absolute
    };
    let unit = if unit.is_empty() { rest } else { unit };
    Some(Scattered { number, deviation, spread, unit: if percent(unit).0 { "%" } else { unit } })
}

/// Splits a text behind the longest number at its start; `None` where it begins otherwise.
pub(crate) fn leading_number(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let of_number = |letter: char| letter.is_numeric() || "+-−－.,．，' \u{a0}eE".contains(letter);
    let end = text.find(|letter| !of_number(letter)).unwrap_or(text.len());
    let ends = text[..end].char_indices().map(|(place, letter)| place + letter.len_utf8()).rev();
    let is_figure = |end: &usize| text[..*end].ends_with(char::is_numeric);
    let end = ends.filter(is_figure).find(|&end| evidence(&text[..end]).is_some())?;
    Some((&text[..end], text[end..].trim()))
}

/// Returns whether a text begins with the sign of percent, and what stands behind it.
fn percent(text: &str) -> (bool, &str) {
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
