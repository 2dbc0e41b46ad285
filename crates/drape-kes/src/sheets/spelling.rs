//! Spellings of the KES values and of the two directions that laboratories write.

use crate::test::Direction;

/// Keys of the values, in the order in which laboratories print them.
pub(crate) const VALUES: [&str; 19] = [
    "LT", "WT", "RT", "EM", "G", "2HG", "2HG5", "B", "2HB", "LC", "WC", "RC", "MIU", "MMD", "SMD",
    "T0", "TM", "T", "W",
];

/// Keys of the values that have a direction.
pub(crate) const KEYS: [&str; 12] =
    ["B", "2HB", "G", "2HG", "2HG5", "LT", "WT", "RT", "EM", "MIU", "MMD", "SMD"];

/// Other spellings of the keys, in small letters without signs between the letters.
const ALTERNATIVES: [(&str, &str); 16] = [
    ("emt", "EM"),
    ("et", "EM"),
    ("hb", "2HB"),
    ("hg", "2HG"),
    ("hg5", "2HG5"),
    ("2hg05", "2HG"),
    ("2hg50", "2HG5"),
    ("to", "T0"),
    ("t05", "T0"),
    ("t50", "TM"),
    ("mu", "MIU"),
    ("μ", "MIU"),
    ("µ", "MIU"),
    ("weight", "W"),
    ("thickness", "T"),
    ("fmax", "FM"),
];

/// Key that a spelling stands for, with the direction that the spelling names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SpelledKey {
    pub(crate) key: &'static str,
    pub(crate) direction: Option<Direction>,
}

/// Returns the key and direction that `written` stands for; `None` where `written` is no value.
///
/// ```text
/// EMT   T_0   2HG_5   2hg5   B_warp   B-1 (warp)   B-2 (weft)
/// ```
pub(crate) fn value(written: &str) -> Option<SpelledKey> {
    if let Some(key) = key(written) {
        return Some(SpelledKey { key, direction: None });
    }
    let (start, end) = written.rsplit_once(['_', '-', ' ', '.'])?;
    let direction = match end {
        "1" => Direction::Warp,
        "2" => Direction::Weft,
        word => direction(word)?,
    };
    Some(SpelledKey { key: key(start)?, direction: Some(direction) })
}

/// Returns the key that `written` stands for, without a direction; `None` where `written` is no
/// value.
pub(crate) fn key(written: &str) -> Option<&'static str> {
    let is_letter = |letter: &char| !"_- .·".contains(*letter);
    let letters: String = written.to_lowercase().chars().filter(is_letter).collect();
    let exact = VALUES.into_iter().find(|key| key.to_lowercase() == letters);
    exact.or_else(|| {
        ALTERNATIVES.iter().find(|(spelling, _)| *spelling == letters).map(|(_, key)| *key)
    })
}

/// All names of the directions, as a regular expression.
#[cfg(feature = "schema")]
pub(crate) const DIRECTIONS: &str = "^([Ww][Aa][Rr][Pp]|[Ww][Ee][Ff][Tt]|[Ww][PpFf]|[Kk]ette|[Cc]ha[iî]ne|経|たて|\
     [Ff]ill(ing)?|[Ss]chuss|[Tt]rame|緯|よこ)$";

/// Returns the spellings of `key`, as a regular expression. A `directed` pattern allows a direction
/// behind the key.
#[cfg(feature = "schema")]
pub(crate) fn pattern(key: &str, directed: bool) -> String {
    /// Expression for the signs between two letters.
    const BETWEEN: &str = "[-_ .·]*";

    let alternatives = ALTERNATIVES.iter().filter(|(_, meant)| *meant == key);
    let spellings: Vec<String> = std::iter::once(key)
        .chain(alternatives.map(|(spelling, _)| *spelling))
        .map(|spelling| spelling.chars().map(letter_pattern).collect::<Vec<_>>().join(BETWEEN))
        .collect();
    let direction = DIRECTIONS.trim_start_matches('^').trim_end_matches('$');
    let direction = if directed { format!("([-_ .](1|2|{direction}))?") } else { String::new() };
    format!("^({}){BETWEEN}{direction}$", spellings.join("|"))
}

/// Returns the expression for a `letter` in either case.
#[cfg(feature = "schema")]
fn letter_pattern(letter: char) -> String {
    if letter.is_ascii_alphabetic() {
        format!("[{}{}]", letter.to_ascii_uppercase(), letter.to_ascii_lowercase())
    } else {
        letter.to_string()
    }
}

/// Returns the direction that `written` names in one of several languages.
pub(crate) fn direction(written: &str) -> Option<Direction> {
    match written.to_lowercase().as_str() {
        "warp" | "wp" | "kette" | "chaine" | "chaîne" | "経" | "たて" => Some(Direction::Warp),
        "weft" | "wf" | "filling" | "fill" | "schuss" | "trame" | "緯" | "よこ" => {
            Some(Direction::Weft)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spellings_in_use_are_understood() {
        let cases = [
            ("EMT", "EM"),
            ("T_0", "T0"),
            ("T_o", "T0"),
            ("2HG_5", "2HG5"),
            ("2hg5", "2HG5"),
            ("2HG0.5", "2HG"),
            ("T_m", "TM"),
            ("miu", "MIU"),
            ("Lt", "LT"),
            ("2-HB", "2HB"),
        ];
        for (written, key) in cases {
            assert_eq!(value(written), Some(SpelledKey { key, direction: None }), "{written}");
        }
        let of = |key, direction| Some(SpelledKey { key, direction: Some(direction) });
        assert_eq!(value("B_warp"), of("B", Direction::Warp));
        assert_eq!(value("EM-2"), of("EM", Direction::Weft));
        assert_eq!(value("2HG5_weft"), of("2HG5", Direction::Weft));
        for other in ["name", "source", "BB", "curve", "model", "warp", "colour"] {
            assert_eq!(value(other), None, "{other}");
        }
    }
}
