//! Headings of columns: name and unit, and the words that tell what a column holds.

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
    /// Splits a heading into name and unit.
    ///
    /// ```text
    /// Load (N)   Load [N]   荷重（N）   Load / N   Load, N   Load in N   Load_N   Load N
    /// ```
    pub(crate) fn parse(cell: &str) -> Self {
        // The half-width dot of Shift_JIS, in a file without another Japanese sign: gf･cm.
        let cell = cell.replace('¥', "･");
        let cell = cell.trim().trim_matches('"').trim();
        let named = |name: &str, unit: &str| Self {
            name: name.trim().trim_end_matches([':', ',', '/', '-', '_']).trim().to_owned(),
            unit: Some(unit.trim().to_owned()),
        };
        for (open, close) in [('[', ']'), ('(', ')'), ('（', '）'), ('［', '］'), ('<', '>')] {
            if let Some(inside) = cell.strip_suffix(close)
                && let Some((name, unit)) = split_bracket(inside, open, close)
            {
                return named(name, unit);
            }
        }
        for sign in [" / ", "/", ", ", " in ", " en ", ":", " ", "_"] {
            if let Some((name, unit)) =
                cell.split_once(sign).filter(|_| sign == "/").or_else(|| cell.rsplit_once(sign))
                && !name.trim().is_empty()
                && is_unit(unit.trim())
            {
                return named(name, unit);
            }
        }
        Self { name: cell.to_owned(), unit: None }
    }

    /// Returns whether a name in a sheet means this heading.
    pub(crate) fn is_named(&self, name: &str) -> bool {
        let same = |a: &str, b: &str| normal(a) == normal(b);
        same(&self.name, name) || {
            let whole = Self::parse(name);
            whole.unit.is_some() && whole.unit == self.unit && same(&self.name, &whole.name)
        }
    }
}

/// Splits `Load (max) (N` at the bracket that its end closes.
fn split_bracket(inside: &str, open: char, close: char) -> Option<(&str, &str)> {
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

/// Returns a name in small letters, without signs between its words.
pub(crate) fn normal(name: &str) -> String {
    let letter = |letter: char| match letter {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(letter as u32 - 0xfee0).unwrap_or(letter),
        '_' | '-' | '.' | ':' | '#' | '"' | '\u{a0}' | '\u{3000}' => ' ',
        other => other,
    };
    let name: String = name.chars().map(letter).collect::<String>().to_lowercase();
    name.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Kind of a column, by the words of its heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Strain,
    /// Lengthening of the specimen, zero at the start.
    Extension,
    /// Place of the moving clamp, whose zero is arbitrary.
    Position,
    /// Distance of the clamps, the gauge at the start.
    Distance,
    Angle,
    Curvature,
    Force,
    Moment,
    Cycle,
    Specimen,
    /// Something else, known by name: time, width, stress, temperature.
    Other,
}

/// Words of headings; the first line that has one of them decides, so that "cycle time" is a time,
/// and "bending moment" no bend.
///
/// The words are those of the instruments' programs in English, German, French, Italian, Spanish and
/// Japanese.
const WORDS: [(Kind, &[&str]); 11] = [
    (
        Kind::Other,
        &[
            "time",
            "zeit",
            "temps",
            "tiempo",
            "tempo",
            "時間",
            "stress",
            "spannung",
            "contrainte",
            "応力",
            "temperature",
            "temperatur",
            "温度",
            "width",
            "breite",
            "largeur",
            "幅",
            "thickness",
            "dicke",
            "épaisseur",
            "厚",
            "speed",
            "geschwindigkeit",
            "速度",
            "energy",
            "work",
            "仕事",
            "modulus",
            "area",
            "index",
            "remark",
            "note",
            "bemerkung",
            "備考",
            "specimen length",
            "date",
            "point",
        ],
    ),
    (Kind::Cycle, &["cycle", "zyklus", "zyklen", "ciclo", "サイクル", "回数", "loop no"]),
    (
        Kind::Distance,
        &[
            "distance",
            "grip separation",
            "jaw separation",
            "einspannlänge",
            "abstand",
            "つかみ間",
            "チャック間",
        ],
    ),
    (
        Kind::Strain,
        &[
            "strain",
            "dehnung",
            "déformation",
            "deformation",
            "deformazione",
            "deformación",
            "ひずみ",
            "歪",
            "伸び率",
            "伸長率",
            "伸度",
            "elongation (%)",
            "nominal strain",
        ],
    ),
    (
        Kind::Angle,
        &["angle", "winkel", "angolo", "ángulo", "せん断角", "角度", "ずり角", "φ", "phi"],
    ),
    (Kind::Curvature, &["curvature", "krümmung", "courbure", "curvatura", "曲率"]),
    (
        Kind::Moment,
        &["moment", "momento", "モーメント", "曲げ m", "drehmoment", "torque", "トルク"],
    ),
    (
        Kind::Force,
        &[
            "force", "load", "kraft", "charge", "forza", "carico", "fuerza", "carga", "荷重", "力",
            "張力", "tension",
        ],
    ),
    (
        Kind::Extension,
        &[
            "extension",
            "elongation",
            "verlängerung",
            "standardweg",
            "standard travel",
            "weg",
            "allongement",
            "allungamento",
            "elongación",
            "alargamiento",
            "伸び",
            "伸長",
            "変位",
            "displacement",
            "déplacement",
            "extensometer",
            "längenänderung",
            "travel",
            "verfahrweg",
        ],
    ),
    (
        Kind::Position,
        &[
            "position",
            "crosshead",
            "traverse",
            "traverso",
            "stroke",
            "ストローク",
            "クロスヘッド",
            "hub",
            "kolbenweg",
        ],
    ),
    (
        Kind::Specimen,
        &[
            "specimen",
            "sample",
            "probe",
            "prüfling",
            "échantillon",
            "éprouvette",
            "provino",
            "probeta",
            "試料",
            "試験片",
            "サンプル",
            "test",
            "repeat",
            "replicate",
            "run",
            "versuch",
            "essai",
            "prüfung",
        ],
    ),
];

/// Single letters that are symbols of a column.
const SYMBOLS: [(Kind, &[&str]); 5] = [
    (Kind::Strain, &["e", "ε", "eps"]),
    (Kind::Force, &["f", "p", "fs", "ft"]),
    (Kind::Curvature, &["k", "κ"]),
    (Kind::Moment, &["m"]),
    (Kind::Angle, &["φ", "γ", "θ"]),
];

/// Returns the kind of a column by its name; `None` where no word is known.
pub(crate) fn kind(name: &str) -> Option<Kind> {
    let name = normal(name);
    // "Crosshead position" is a place, "crosshead travel" a lengthening: the weaker word is last.
    let has = |words: &[&str]| words.iter().any(|word| has_word(&name, word));
    let by_word = WORDS.iter().find(|(_, words)| has(words)).map(|(kind, _)| *kind);
    by_word.or_else(|| {
        let letter = name.split(' ').next().unwrap_or("").trim_end_matches(char::is_numeric);
        SYMBOLS.iter().find(|(_, letters)| letters.contains(&letter)).map(|(kind, _)| *kind)
    })
}

/// Returns whether a name has a word: at the start of one of its words, or anywhere for the scripts
/// and languages that join words.
fn has_word(name: &str, word: &str) -> bool {
    let joins = |word: &str| !word.is_ascii() || JOINED.contains(&word);
    name.match_indices(word).any(|(place, _)| {
        let before = name[..place].chars().next_back();
        let after = name[place + word.len()..].chars().next();
        let starts = before.is_none_or(|letter| !letter.is_alphabetic());
        let ends = after.is_none_or(|letter| !letter.is_alphabetic() || letter == 's');
        joins(word) || (starts && (ends || word.len() > 4))
    })
}

/// German words that end others: Standardkraft, Prüfzeit, Schubwinkel.
const JOINED: [&str; 8] =
    ["kraft", "weg", "zeit", "winkel", "dehnung", "spannung", "abstand", "moment"];

/// Words of the two directions, in titles, names of sheets and headings.
const DIRECTIONS: [(Direction, &[&str]); 2] = [
    (
        Direction::Warp,
        &[
            "warp",
            "kette",
            "kettrichtung",
            "chaîne",
            "chaine",
            "ordito",
            "urdimbre",
            "たて",
            "タテ",
            "経",
            "经",
            "wale",
            "lengthwise",
            "machine direction",
            "md",
        ],
    ),
    (
        Direction::Weft,
        &[
            "weft",
            "filling",
            "fill",
            "woof",
            "schuss",
            "schussrichtung",
            "trame",
            "trama",
            "よこ",
            "ヨコ",
            "緯",
            "纬",
            "course",
            "widthwise",
            "crosswise",
            "cross direction",
            "cd",
        ],
    ),
];

/// Words of the tests, in titles and names of sheets.
const TESTS: [(Test, &[&str]); 3] = [
    (
        Test::Tensile,
        &[
            "tensile",
            "tension",
            "fb1 tensile",
            "zug",
            "zugversuch",
            "traction",
            "tens",
            "extensibility",
            "trazione",
            "tracción",
            "引張",
            "引っ張り",
            "拉伸",
        ],
    ),
    (
        Test::Shear,
        &["shear", "schub", "scher", "cisaillement", "taglio", "cizalla", "せん断", "剪断", "剪切"],
    ),
    (
        Test::Bending,
        &[
            "bending",
            "pure bending",
            "fb2",
            "biege",
            "biegung",
            "flexion",
            "flessione",
            "flexión",
            "bend",
            "曲げ",
            "弯曲",
        ],
    ),
];

/// Returns the directions that a label names.
pub(crate) fn directions(label: &str) -> Vec<Direction> {
    named(&DIRECTIONS, label)
}

/// Returns the tests that a label names.
pub(crate) fn tests(label: &str) -> Vec<Test> {
    named(&TESTS, label)
}

fn named<T: Copy>(known: &[(T, &[&str])], label: &str) -> Vec<T> {
    let label = normal(label);
    let has = |words: &[&str]| words.iter().any(|word| has_word(&label, word));
    known.iter().filter(|(_, words)| has(words)).map(|(found, _)| *found).collect()
}

/// Words of a part of one history.
const PARTS: [&str; 17] = [
    "cycle",
    "zyklus",
    "サイクル",
    "loading",
    "unloading",
    "recovery",
    "return",
    "belastung",
    "entlastung",
    "hin",
    "rück",
    "retour",
    "aller",
    "往",
    "復",
    "回復",
    "戻り",
];

/// Returns whether a label names a part of one history: a cycle, the way back.
pub(crate) fn is_part(label: &str) -> bool {
    let label = normal(label);
    PARTS.iter().any(|word| has_word(&label, word))
}

/// Words of a specimen of several, besides its number.
const SPECIMENS: [&str; 16] = [
    "specimen",
    "sample",
    "probe",
    "prüfling",
    "test",
    "versuch",
    "repeat",
    "replicate",
    "run",
    "échantillon",
    "éprouvette",
    "essai",
    "試料",
    "試験片",
    "n",
    "no",
];

/// Returns whether a label is that of one specimen of several: a number, with a word for specimens.
pub(crate) fn is_specimen(label: &str) -> bool {
    let label = normal(label);
    let has_number = label.contains(|letter: char| letter.is_ascii_digit());
    has_number
        && label.split(' ').all(|word| {
            let word = word
                .trim_matches(|letter: char| letter.is_ascii_digit() || "()[],;/".contains(letter));
            word.is_empty()
                || SPECIMENS.contains(&word)
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
