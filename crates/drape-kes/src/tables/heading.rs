//! Headings of columns: name and unit, and the kind of quantity that a column holds.

pub(crate) mod words;

pub(crate) use self::words::Kind;
use self::words::{
    BIAS, DIRECTIONS, JOINED, NAMES, PARTS, SPECIMENS, SYMBOLS, TESTS, WORDS, Words, single,
};
use crate::test::{Direction, Test};
use drape_input::is_unit;

/// Heading of a column, such as `curvature (1/cm)`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Heading {
    /// Name without its unit.
    pub(crate) name: String,
    pub(crate) unit: Option<String>,
}

impl Heading {
    /// Splits the text `cell` into name and unit.
    ///
    /// ```text
    /// Load (N)   Load [N]   荷重（N）   Load / N   Load, N   Load in N   Load_N   Load N
    /// ```
    pub(crate) fn parse(cell: &str) -> Self {
        // The half-width dot of Shift_JIS, in a file with no other Japanese character: gf･cm.
        let cell = cell.replace('¥', "･");
        let cell = cell.trim().trim_matches('"').trim();
        for (open, close) in [('[', ']'), ('(', ')'), ('（', '）'), ('［', '］'), ('<', '>')] {
            if let Some(inside) = cell.strip_suffix(close)
                && let Some((name, unit)) = split_at_bracket(inside, open, close)
            {
                return Self::with_unit(name, unit);
            }
        }
        for sign in [" / ", "/", ", ", " in ", " en ", ":", " ", "_"] {
            if let Some((name, unit)) =
                cell.split_once(sign).filter(|_| sign == "/").or_else(|| cell.rsplit_once(sign))
                && !name.trim().is_empty()
                && is_unit(unit.trim())
            {
                return Self::with_unit(name, unit);
            }
        }
        Self { name: cell.to_owned(), unit: None }
    }

    /// Returns whether `name` in a sheet means this heading.
    pub(crate) fn is_named(&self, name: &str) -> bool {
        if normal(&self.name) == normal(name) {
            return true;
        }
        let heading = Self::parse(name);
        heading.unit.is_some()
            && heading.unit == self.unit
            && normal(&self.name) == normal(&heading.name)
    }

    /// Returns a heading of `name` and `unit`, without the signs between them.
    fn with_unit(name: &str, unit: &str) -> Self {
        Self {
            name: name.trim().trim_end_matches([':', ',', '/', '-', '_']).trim().to_owned(),
            unit: Some(unit.trim().to_owned()),
        }
    }
}

/// Splits a text such as `Load (max) (N` at the bracket that its end closes.
fn split_at_bracket(inside: &str, open: char, close: char) -> Option<(&str, &str)> {
    let mut depth = 0;
    for (place, letter) in inside.char_indices().rev() {
        if letter == close {
            depth += 1;
        } else if letter == open {
            if depth == 0 {
                return Some((&inside[..place], &inside[place + open.len_utf8()..]));
            }
            depth -= 1;
        }
    }
    None
}

/// Returns `name` in small letters, without signs between its words.
pub(crate) fn normal(name: &str) -> String {
    let mut letters = String::with_capacity(name.len());
    for letter in name.chars() {
        letters.push(match letter {
            '\u{ff01}'..='\u{ff5e}' => char::from_u32(letter as u32 - 0xfee0).unwrap_or(letter),
            '_' | '-' | '.' | ':' | '#' | '"' | '\u{a0}' | '\u{3000}' => ' ',
            letter => letter,
        });
    }
    letters.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns the kind of the column `name`; `None` for a name without a known word.
pub(crate) fn kind(name: &str) -> Option<Kind> {
    let name = normal(name);
    // "Crosshead position" is a position, "crosshead travel" an extension: the weaker word is last.
    let by_word = WORDS
        .iter()
        .find(|(_, words)| single(words).any(|word| has_word(&name, word)))
        .map(|(kind, _)| *kind);
    by_word.or_else(|| {
        let symbol = name.split(' ').next().unwrap_or("").trim_end_matches(char::is_numeric);
        SYMBOLS.iter().find(|(_, symbols)| symbols.contains(&symbol)).map(|(kind, _)| *kind)
    })
}

/// Returns whether `name` has `word` at the start of one of its words. In scripts and languages
/// that join words, `word` may stand anywhere.
pub(crate) fn has_word(name: &str, word: &str) -> bool {
    let is_joined = !word.is_ascii() || JOINED.contains(&word);
    name.match_indices(word).any(|(place, _)| {
        let before = name[..place].chars().next_back();
        let after = name[place + word.len()..].chars().next();
        let starts = before.is_none_or(|letter| !letter.is_alphabetic());
        let ends = after.is_none_or(|letter| !letter.is_alphabetic() || letter == 's');
        is_joined || (starts && (ends || word.len() > 4))
    })
}

/// Returns the directions that `label` names.
pub(crate) fn directions(label: &str) -> Vec<Direction> {
    words_in(&DIRECTIONS, label)
}

/// Returns the tests that `label` names.
pub(crate) fn tests(label: &str) -> Vec<Test> {
    words_in(&TESTS, label)
}

/// Returns the number of letters of `text` that belong to known words beyond ASCII.
pub(crate) fn known_letters(text: &str) -> usize {
    let text = text.to_lowercase();
    let kinds = WORDS.iter().map(|(_, words)| *words);
    let directions = DIRECTIONS.iter().map(|(_, words)| *words);
    let tests = TESTS.iter().map(|(_, words)| *words);
    let all = kinds.chain(directions).chain(tests).chain([BIAS, SPECIMENS, NAMES]);
    let known = all.flat_map(single).filter(|word| !word.is_ascii());
    known.filter(|word| text.contains(word)).map(|word| word.chars().count()).sum()
}

/// Returns whether `label` names a strip that is cut at 45° to the yarns.
pub(crate) fn is_bias(label: &str) -> bool {
    let name = normal(label);
    names_45_degrees(&label.to_lowercase())
        || single(BIAS).any(|word| {
            // "Diagonal twill" is a weave, and so is "斜纹": the words stand alone.
            name.match_indices(word).any(|(place, _)| {
                let before = name[..place].chars().next_back();
                let after = name[place + word.len()..].chars().next();
                !word.is_ascii() || [before, after].iter().flatten().all(|c| !c.is_alphabetic())
            })
        })
}

/// Returns whether `label`, in small letters, states 45 degrees. A number 45 without sign or
/// degrees counts something else.
fn names_45_degrees(label: &str) -> bool {
    label.match_indices("45").any(|(place, _)| {
        let before = label[..place].chars().next_back();
        let after = label[place + 2..].trim_start_matches([' ', '_', '-', '\u{a0}']);
        let is_degree = ["°", "º", "deg", "grad", "度", "゜"].iter().any(|d| after.starts_with(d));
        let is_signed = matches!(before, Some('±' | '+'));
        let is_number = before.is_none_or(|c| !c.is_ascii_digit() && !".,".contains(c));
        is_number && (is_degree || is_signed && !after.starts_with(|c: char| c.is_ascii_digit()))
    })
}

/// Returns the meanings of the `known` words that `label` has.
fn words_in<T: Copy>(known: &[(T, Words)], label: &str) -> Vec<T> {
    let label = normal(label);
    known
        .iter()
        .filter(|(_, words)| single(words).any(|word| has_word(&label, word)))
        .map(|(meaning, _)| *meaning)
        .collect()
}

/// Returns whether `label` names a part of one history: a cycle, or the recovery.
pub(crate) fn is_part(label: &str) -> bool {
    let label = normal(label);
    single(PARTS).any(|word| has_word(&label, word))
}

/// Returns whether `label` is the label of one of several specimens: a number, with a word for
/// specimens.
pub(crate) fn is_specimen(label: &str) -> bool {
    let label = normal(label);
    let has_number = label.contains(|letter: char| letter.is_ascii_digit());
    has_number
        && label.split(' ').all(|word| {
            let word = word
                .trim_matches(|letter: char| letter.is_ascii_digit() || "()[],;/".contains(letter));
            word.is_empty()
                || single(SPECIMENS).any(|specimen| specimen == word)
                || word == "of"
                || !directions(word).is_empty()
                || !tests(word).is_empty()
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_is_found_however_it_is_set_off() {
        for cell in [
            "Load (N)",
            "Load [N]",
            "Load（N）",
            "Load / N",
            "Load, N",
            "Load in N",
            "Load_N",
            "Load N",
            "\"Load (N)\"",
            "Load: N",
            "Load <N>",
            "Load/N",
        ] {
            let heading = Heading::parse(cell);
            assert_eq!(
                (heading.name.as_str(), heading.unit.as_deref()),
                ("Load", Some("N")),
                "{cell}"
            );
        }
        let heading = Heading::parse("F (gf/cm)");
        assert_eq!((heading.name.as_str(), heading.unit.as_deref()), ("F", Some("gf/cm")));
        assert_eq!(Heading::parse("G (gf/(cm.deg))").unit.as_deref(), Some("gf/(cm.deg)"));
        assert_eq!(Heading::parse("Crosshead position").unit, None);
        assert_eq!(Heading::parse("strain %").unit.as_deref(), Some("%"));
    }

    #[test]
    fn words_of_the_instruments_tell_what_a_column_holds() {
        let cases = [
            ("Tensile extension", Kind::Extension),
            ("Standardkraft", Kind::Force),
            ("Standardweg", Kind::Extension),
            ("Prüfzeit", Kind::Other),
            ("Traversenweg", Kind::Extension),
            ("Crosshead position", Kind::Position),
            ("伸び", Kind::Extension),
            ("荷重", Kind::Force),
            ("clamp_distance_m", Kind::Distance),
            ("bending moment", Kind::Moment),
            ("Shear angle", Kind::Angle),
            ("Cycle time", Kind::Other),
            ("Zyklus", Kind::Cycle),
            ("Specimen", Kind::Specimen),
            ("Force 1", Kind::Force),
            ("F", Kind::Force),
            ("Déformation", Kind::Strain),
            ("Tensile stress", Kind::Other),
        ];
        for (name, found) in cases {
            assert_eq!(kind(name), Some(found), "{name}");
        }
        assert_eq!(kind("Quux"), None);
    }

    #[test]
    fn a_strip_at_45_degrees_is_neither_warp_nor_weft() {
        for label in [
            "warp_bias_45deg",
            "Bias",
            "45°",
            "+45",
            "±45 degrees",
            "Schräg",
            "バイアス方向",
            "45 度",
            "sens biais",
        ] {
            assert!(is_bias(label), "{label}");
        }
        for label in
            ["warp", "sample 45 warp", "145 deg", "0.45 deg", "biased clamp", "斜纹 经向", "W45"]
        {
            assert!(!is_bias(label), "{label}");
        }
    }

    #[test]
    fn headings_in_further_languages_tell_what_a_column_holds() {
        let cases = [
            ("伸长率(%)", Kind::Strain),
            ("力 (N)", Kind::Force),
            ("弯矩", Kind::Moment),
            ("时间", Kind::Other),
            ("应力", Kind::Other),
            ("位移", Kind::Extension),
            ("Kuvvet", Kind::Force),
            ("Uzama", Kind::Extension),
            ("Força", Kind::Force),
            ("Alongamento", Kind::Extension),
            ("Deformação", Kind::Strain),
            ("Tensão", Kind::Other),
        ];
        for (name, found) in cases {
            assert_eq!(kind(&Heading::parse(name).name), Some(found), "{name}");
        }
        let cases = [
            ("经向", Direction::Warp),
            ("纬向", Direction::Weft),
            ("縦", Direction::Warp),
            ("Çözgü yönü", Direction::Warp),
            ("ATKI", Direction::Weft),
            ("Urdume", Direction::Warp),
            ("Trama", Direction::Weft),
        ];
        for (label, direction) in cases {
            assert_eq!(directions(label), [direction], "{label}");
        }
    }

    #[test]
    fn labels_name_directions_tests_and_specimens() {
        assert_eq!(directions("B-warp-1"), [Direction::Warp]);
        assert_eq!(directions("Schuss"), [Direction::Weft]);
        assert_eq!(tests("FB2 pure bending"), [Test::Bending]);
        for label in ["Specimen 1", "Sample #2", "3", "Probe 1", "試料1", "warp 2", "Test_03"] {
            assert!(is_specimen(label), "{label}");
        }
        for label in ["warp", "before washing", "fabric A 1"] {
            assert!(!is_specimen(label), "{label}");
        }
        assert!(is_part("Cycle 2") && is_part("Recovery") && !is_part("Specimen 1"));
    }
}
