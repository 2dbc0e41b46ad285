//! Texts near a table, nearest texts first, and the test and direction that they name.

use std::path::Path;

use crate::sheets::spelling;
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::{self, normal};
use crate::tables::series::Series;
use crate::test::{Direction, Test};

/// Value with the reason for it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Reasoned<T> {
    pub(crate) value: T,
    pub(crate) why: String,
}

/// Texts about a table, nearest texts first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evidence {
    texts: Vec<Text>,
    /// Whether a text names the Kawabata instruments.
    pub(crate) is_kes: bool,
    /// Whether a text names an arch between two clamps.
    pub(crate) is_arch: bool,
}

/// Text with its place in words.
#[derive(Clone, Debug)]
struct Text {
    text: String,
    place: String,
    /// Whether the text is the name of the file or of its folder.
    is_path: bool,
}

impl Text {
    /// Returns a text that is no name of a file, at `place`.
    fn new(text: String, place: String) -> Self {
        Self { text, place, is_path: false }
    }
}

/// Words of a key whose value is the direction.
const DIRECTION_KEYS: [&str; 12] = [
    "direction",
    "richtung",
    "sens",
    "direzione",
    "dirección",
    "orientation",
    "dir",
    "方向",
    "たてよこ",
    "cut",
    "axis",
    "系列",
];
/// Words of a key whose value is the test.
const TEST_KEYS: [&str; 14] = [
    "test",
    "method",
    "methode",
    "prüfung",
    "prüfart",
    "essai",
    "prova",
    "ensayo",
    "mode",
    "試験",
    "測定",
    "項目",
    "measurement",
    "instrument",
];
/// Words of lines about yarns. Such a line names both directions in turn.
const YARN_WORDS: [&str; 10] =
    ["density", "yarn", "count", "ends", "picks", "thread", "faden", "garn", "密度", "糸"];
/// Words of the Kawabata instruments.
const KES_WORDS: [&str; 7] = ["kes", "kesf", "fb1", "fb2", "fb3", "kato", "カトーテック"];
/// Words of an arch between two clamps.
const ARCH_WORDS: [&str; 4] = ["loop", "arch", "buckling", "ループ"];
/// Words of the tests whose results a sheet takes as values.
const OTHER_TESTS: [(&str, &[&str]); 2] = [
    (
        "compression",
        &["compression", "compressional", "fb3", "druck", "圧縮", "压缩", "compressione"],
    ),
    ("surface", &["surface", "fb4", "friction", "roughness", "表面", "oberfläche", "摩擦"]),
];

impl Evidence {
    /// Collects the texts about `series`: its columns, its title, its sheet, the lines above, and
    /// the names of the file and its folder.
    pub(crate) fn from_series(series: &Series, path: &Path) -> Self {
        let Series { block, pair, around, .. } = series;
        let headings = [pair.deformation, pair.load].map(|column| block.headings.get(column));
        let names: Vec<&str> =
            headings.into_iter().flatten().map(|heading| heading.name.as_str()).collect();
        let names = names.join(" ");
        let title = block.title();
        let texts = vec![
            Text::new(pair.label.clone(), format!("the title \"{}\" of the columns", pair.label)),
            Text::new(names.clone(), format!("the headings \"{names}\"")),
            Text::new(title.clone(), format!("the title \"{title}\"")),
        ];
        let mut evidence = Self { texts, ..Self::default() };
        evidence.add_lines(&block.above);
        evidence.add_surroundings(&block.sheet, &around.rows, path);
        evidence
    }

    /// Collects the texts about a whole `sheet` of the file `path`.
    pub(crate) fn from_rows(sheet: &str, rows: &[Row], path: &Path) -> Self {
        let mut evidence = Self::default();
        evidence.add_surroundings(sheet, rows, path);
        evidence
    }

    /// Adds the name of the `sheet`, its `rows`, and the names of the file `path` and its folder.
    fn add_surroundings(&mut self, sheet: &str, rows: &[Row], path: &Path) {
        self.texts.push(Text::new(split_words(sheet), format!("the sheet \"{sheet}\"")));
        self.add_lines(rows);
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().and_then(Path::file_name);
        let folder = folder.map(|name| name.to_string_lossy().into_owned());

        for (text, place) in [(stem, "the name of the file"), (folder, "the name of its folder")] {
            let scope = Text::new(split_words(&text.unwrap_or_default()), place.into());
            self.texts.push(Text { is_path: true, ..scope });
        }

        // Words of the instruments count in every row.
        let mut names: Vec<String> = self.texts.iter().map(|text| normal(&text.text)).collect();
        names.extend(rows.iter().map(|row| normal(&row_text(row))));
        let has_any = [&KES_WORDS[..], &ARCH_WORDS].map(|words| {
            names.iter().any(|name| words.iter().any(|word| contains_word(name, word)))
        });
        [self.is_kes, self.is_arch] = has_any;
    }

    /// Adds the lines that are titles, or whose key names direction or test.
    fn add_lines(&mut self, rows: &[Row]) {
        for row in rows {
            let cells: Vec<String> = row.filled().map(|(_, cell)| Cell::text(cell)).collect();
            let key = normal(cells.first().map_or("", String::as_str));
            let is_evidence = cells.len() == 1 || is_keyed(&key);
            if is_evidence
                && cells.len() <= 4
                && !YARN_WORDS.iter().any(|word| contains_word(&key, word))
            {
                let text = cells.join(" ");
                let place = format!("line {}, \"{text}\"", row.line);
                self.texts.push(Text::new(text, place));
            }
        }
        rows.windows(2).for_each(|pair| self.add_values_below(&pair[0], &pair[1]));
    }

    /// Adds the values in the row `values` that stand below keys of direction or test in the row
    /// `keys`.
    fn add_values_below(&mut self, keys: &Row, values: &Row) {
        let is_table = keys.filled().count() > 1 && keys.numbers() == 0;
        if !is_table || values.line != keys.line + 1 {
            return;
        }
        for (column, key) in keys.filled() {
            let key = normal(&key.text());
            let value = values.cells.get(column).filter(|cell| !cell.is_empty());
            if let Some(value) = value.filter(|_| is_keyed(&key)) {
                let text = value.text();
                let place = format!("line {}, \"{text}\"", values.line);
                self.texts.push(Text::new(text, place));
            }
        }
    }

    /// Returns the place that names a strip cut at 45° to its yarns. Returns `None` if there is
    /// none, or if a nearer text of the file names warp or weft. The names of the file and its
    /// folder are equally near.
    pub(crate) fn bias(&self) -> Option<String> {
        for Text { text, place, .. } in self.texts.iter().filter(|scope| !scope.is_path) {
            if heading::is_bias(text) {
                return Some(place.clone());
            }
            if heading::directions(text).len() == 1 {
                return None;
            }
        }
        let mut names = self.texts.iter().filter(|scope| scope.is_path);
        names.find(|scope| heading::is_bias(&scope.text)).map(|scope| scope.place.clone())
    }

    /// Returns the direction that the nearest text names. `Err` holds the reason why no direction
    /// is known.
    pub(crate) fn direction(&self) -> Result<Reasoned<Direction>, String> {
        let nearest = self.nearest(|text| {
            let mut directions = heading::directions(text);
            let words = normal(text);
            let words =
                words.split(' ').map(|word| word.trim_end_matches(|c: char| c.is_ascii_digit()));
            for direction in words.filter_map(spelling::direction) {
                if !directions.contains(&direction) {
                    directions.push(direction);
                }
            }
            directions
        });
        nearest.map_err(|ambiguous| match ambiguous {
            Some(place) => format!("{place} names both directions, and nothing nearer names one"),
            None => "neither its titles nor the names of file and folder say warp or weft".into(),
        })
    }

    /// Returns the test of a curve that the nearest text names; `None` if no text names one test.
    pub(crate) fn test(&self) -> Option<Reasoned<Test>> {
        self.nearest(heading::tests).ok()
    }

    /// Returns the test without curves in a sheet that the nearest text names.
    pub(crate) fn other_test(&self) -> Option<Reasoned<&'static str>> {
        self.nearest(|text| {
            let text = normal(text);
            OTHER_TESTS
                .iter()
                .filter(|(_, words)| words.iter().any(|word| contains_word(&text, word)))
                .map(|(name, _)| *name)
                .collect()
        })
        .ok()
    }

    /// Returns the value of the nearest text in which `find` finds exactly one value. `Err` holds
    /// the nearest place with several values.
    fn nearest<T: Copy>(
        &self,
        find: impl Fn(&str) -> Vec<T>,
    ) -> Result<Reasoned<T>, Option<String>> {
        let mut ambiguous = None;
        for Text { text, place, .. } in &self.texts {
            match find(text).as_slice() {
                [] => {}
                [value] => return Ok(Reasoned { value: *value, why: format!("by {place}") }),
                _ => _ = ambiguous.get_or_insert_with(|| place.clone()),
            }
        }
        Err(ambiguous)
    }
}

/// Returns whether `key` names direction or test.
fn is_keyed(key: &str) -> bool {
    DIRECTION_KEYS.iter().chain(&TEST_KEYS).any(|word| contains_word(key, word))
}

/// Returns the texts of `row`, separated by blanks.
fn row_text(row: &Row) -> String {
    row.filled().map(|(_, cell)| cell.text()).collect::<Vec<_>>().join(" ")
}

/// Returns whether `text` has `word`. A short word must stand alone.
fn contains_word(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(place, _)| {
        let before = text[..place].chars().next_back();
        let after = text[place + word.len()..].chars().next();
        !word.is_ascii()
            || (before.is_none_or(|letter| !letter.is_alphabetic())
                && after.is_none_or(|letter| !letter.is_alphabetic() || word.len() > 4))
    })
}

/// Splits the words of `name` where small letters meet capitals, and where digits meet letters.
fn split_words(name: &str) -> String {
    let mut words = String::with_capacity(name.len() + 4);
    let mut before = ' ';
    for letter in name.chars() {
        let is_capital = before.is_lowercase() && letter.is_uppercase();
        if is_capital || (before.is_ascii_digit() && letter.is_alphabetic()) {
            words.push(' ');
        }
        words.push(letter);
        before = letter;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    fn of(path: &str, text: &str) -> Evidence {
        let rows = Separator::Semicolon.split(text).expect("it splits");
        Evidence::from_rows("", &rows, Path::new(path))
    }

    #[test]
    fn the_nearest_text_decides() {
        let evidence = of("weft/TensileWarp.csv", "Direction;Weft\n");
        let told = evidence.direction().expect("it is told");
        assert_eq!(told.value, Direction::Weft);
        assert!(told.why.contains("line 1"), "{}", told.why);
        assert_eq!(evidence.test().map(|told| told.value), Some(Test::Tensile));
        let told = of("weft/TensileWarp.csv", "").direction().expect("by its name");
        assert_eq!((told.value, told.why.as_str()), (Direction::Warp, "by the name of the file"));
        assert_eq!(of("a/FB2_WP1.txt", "").direction().map(|t| t.value), Ok(Direction::Warp));
    }

    #[test]
    fn a_strip_on_the_bias_is_no_warp_unless_a_nearer_text_says_so() {
        assert!(of("lab/warp_bias_45deg.csv", "").bias().is_some());
        assert!(of("bias/warp.csv", "").bias().is_some());
        assert!(of("lab/warp.csv", "Cut;45° to the warp\n").bias().is_some());
        assert_eq!(of("warp weft bias/a.csv", "Direction;Warp\n").bias(), None);
        assert_eq!(of("lab/warp 45.csv", "").bias(), None);
    }

    #[test]
    fn values_below_their_keys_name_test_and_direction() {
        let evidence = of("a/b.csv", "試験名;試験日\n織物たて引張;2024/5/1\n");
        assert_eq!(evidence.test().map(|told| told.value), Some(Test::Tensile));
        assert_eq!(evidence.direction().map(|told| told.value), Ok(Direction::Warp));
    }

    #[test]
    fn lines_about_yarns_and_both_directions_tell_nothing() {
        let text = "Warp density (1/cm);40\nWarp and weft tested\n";
        let reason = of("a/b.csv", text).direction().expect_err("it is not told");
        assert!(reason.contains("both directions"), "{reason}");
        assert!(of("a/b.csv", "Warp yarn\n").direction().is_err());
        assert!(of("a/b.csv", "KES-FB3;\n").other_test().is_some());
    }
}
