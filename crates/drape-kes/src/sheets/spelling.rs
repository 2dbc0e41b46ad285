//! Spellings of the KES values and of the two directions that laboratories write.

use drape_input::{Alias, Diagnostic, Document, toml_key};

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

/// Returns `document` with the keys of a sheet in place of all other spellings, and the mistakes:
/// values that are there twice.
///
/// A table of a direction is `warp` or `weft`, a value whose key names a direction stands in this
/// table, and a value for both directions stands at the top.
pub(crate) fn with_known_keys(mut document: Document) -> (Document, Vec<Diagnostic>) {
    // Tables have their names before values move into them. A value in a table of its direction
    // precedes a value at the top.
    let steps = [table_aliases, inner_aliases, top_aliases, mean_aliases];
    let mut mistakes = Vec::new();
    for step in steps {
        let aliases = step(&document);
        let (aliased, twice) = document.with_aliases(&aliases);
        document = aliased;
        mistakes.extend(twice);
    }
    (document, mistakes)
}

/// Returns the alias of the key path `intended_key`, which `document` writes as `written`; `None`
/// if both are equal.
fn alias(written: String, intended_key: String) -> Option<Alias> {
    (written != intended_key).then_some(Alias { written, intended_key })
}

/// Returns the aliases of the tables of both directions in `document`.
fn table_aliases(document: &Document) -> Vec<Alias> {
    let keys = document.keys("").into_iter();
    keys.filter_map(|key| alias(toml_key(key), direction(key)?.name().to_owned())).collect()
}

/// Returns the aliases of the values in the tables of `document`. Their keys name no direction.
fn inner_aliases(document: &Document) -> Vec<Alias> {
    let mut aliases = Vec::new();
    for table in ["warp", "weft", "mean"] {
        for written in document.keys(table) {
            let known = key(written).filter(|known| KEYS.contains(known));
            let meant = known.map(|known| format!("{table}.{}", toml_key(known)));
            let written = format!("{table}.{}", toml_key(written));
            aliases.extend(meant.and_then(|meant| alias(written, meant)));
        }
    }
    aliases
}

/// Returns the aliases of the values at the top of `document`. Their keys may name a direction.
fn top_aliases(document: &Document) -> Vec<Alias> {
    let mut aliases = Vec::new();
    for written in document.keys("") {
        let meant = match value(written) {
            Some(SpelledKey { key, direction: None }) => Some(key.to_owned()),
            Some(SpelledKey { key, direction: Some(direction) }) => {
                KEYS.contains(&key).then(|| format!("{}.{key}", direction.name()))
            }
            None => None,
        };
        aliases.extend(meant.and_then(|meant| alias(toml_key(written), meant)));
    }
    aliases
}

/// Returns the aliases of the values in the table `mean` of `document`, which are values for both
/// directions, as those at the top are.
fn mean_aliases(document: &Document) -> Vec<Alias> {
    let keys = document.keys("mean").into_iter().filter(|key| KEYS.contains(key));
    keys.filter_map(|key| alias(format!("mean.{key}"), key.to_owned())).collect()
}

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
