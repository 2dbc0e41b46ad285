//! Texts near a table, the nearest first, and the test and direction that they name.

use std::path::Path;

use crate::sheets::spelling;
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::{self, normal};
use crate::tables::series::Series;
use crate::test::{Direction, Test};

/// Value with the reason why it was taken.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Told<T> {
    pub(crate) value: T,
    pub(crate) why: String,
}

/// Texts about a table, the nearest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evidence {
    scopes: Vec<Scope>,
    /// Whether a text names the Kawabata instruments.
    pub(crate) is_kes: bool,
    /// Whether a text names an arch between two clamps.
    pub(crate) is_arch: bool,
}

/// Text with its place, in words.
#[derive(Clone, Debug)]
struct Scope {
    text: String,
    place: String,
    /// Whether it is the name of the file or of its folder.
    is_path: bool,
}

impl Scope {
    fn new(text: String, place: String) -> Self {
        Self { text, place, is_path: false }
    }
}

/// Words of the key of a line that says the direction.
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
/// Words of the key of a line that says the test.
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
/// Words of lines about yarns, which name both directions in turn.
const YARN: [&str; 10] =
    ["density", "yarn", "count", "ends", "picks", "thread", "faden", "garn", "密度", "糸"];
/// Words of the Kawabata instruments.
const KES: [&str; 7] = ["kes", "kesf", "fb1", "fb2", "fb3", "kato", "カトーテック"];
/// Words of an arch between two clamps.
const ARCH: [&str; 4] = ["loop", "arch", "buckling", "ループ"];
/// Words of the tests that a sheet takes as values.
const OTHER_TESTS: [(&str, &[&str]); 2] = [
    (
        "compression",
        &["compression", "compressional", "fb3", "druck", "圧縮", "压缩", "compressione"],
    ),
    ("surface", &["surface", "fb4", "friction", "roughness", "表面", "oberfläche", "摩擦"]),
];

impl Evidence {
    /// Collects the texts about a series: its columns, its title, its sheet, the lines above, the
    /// names of the file and its folder.
    pub(crate) fn of_series(series: &Series, path: &Path) -> Self {
        let Series { block, pair, around, .. } = series;
        let mut scopes = Vec::new();
        let mut add = |text: String, place: String| scopes.push(Scope::new(text, place));
        add(pair.label.clone(), format!("the title \"{}\" of the columns", pair.label));
        let names = [pair.deformation, pair.load].map(|column| block.headings.get(column));
        let names: Vec<&str> = names.into_iter().flatten().map(|h| h.name.as_str()).collect();
        let names = names.join(" ");
        add(names.clone(), format!("the headings \"{names}\""));
        let title = block.title();
        add(title.clone(), format!("the title \"{title}\""));
        let mut evidence = Self { scopes, ..Self::default() };
        evidence.add_lines(&block.above);
        evidence.add_place(&block.sheet, &around.rows, path);
        evidence
    }

    /// Collects the texts about a whole sheet of a file.
    pub(crate) fn of_rows(sheet: &str, rows: &[Row], path: &Path) -> Self {
        let mut evidence = Self::default();
        evidence.add_place(sheet, rows, path);
        evidence
    }

    fn add_place(&mut self, sheet: &str, rows: &[Row], path: &Path) {
        self.scopes.push(Scope::new(parted(sheet), format!("the sheet \"{sheet}\"")));
        self.add_lines(rows);
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().and_then(Path::file_name);
        let folder = folder.map(|name| name.to_string_lossy().into_owned());
        for (text, place) in [(stem, "the name of the file"), (folder, "the name of its folder")] {
            let scope = Scope::new(parted(&text.unwrap_or_default()), place.into());
            self.scopes.push(Scope { is_path: true, ..scope });
        }
        let mut words: Vec<String> = self.scopes.iter().map(|scope| normal(&scope.text)).collect();
        words.extend(rows.iter().map(|row| normal(&of_row(row))));
        let names =
            |known: &[&str]| words.iter().any(|text| known.iter().any(|word| has(text, word)));
        (self.is_kes, self.is_arch) = (names(&KES), names(&ARCH));
    }

    /// Adds the lines that are titles, or that say direction or test by their key.
    fn add_lines(&mut self, rows: &[Row]) {
        for row in rows {
            let cells: Vec<String> = row.filled().map(|(_, cell)| Cell::text(cell)).collect();
            let key = normal(cells.first().map_or("", String::as_str));
            let keyed = |keys: &[&str]| keys.iter().any(|word| has(&key, word));
            let told = cells.len() == 1 || keyed(&DIRECTION_KEYS) || keyed(&TEST_KEYS);
            if told && cells.len() <= 4 && !YARN.iter().any(|word| has(&key, word)) {
                let text = cells.join(" ");
                let place = format!("line {}, \"{text}\"", row.line);
                self.scopes.push(Scope::new(text, place));
            }
        }
        rows.windows(2).for_each(|pair| self.add_values_below(&pair[0], &pair[1]));
    }

    /// Adds the values that stand below keys of direction or test.
    fn add_values_below(&mut self, keys: &Row, values: &Row) {
        let is_table = keys.filled().count() > 1 && keys.numbers() == 0;
        if !is_table || values.line != keys.line + 1 {
            return;
        }
        for (column, key) in keys.filled() {
            let key = normal(&key.text());
            let is_keyed = DIRECTION_KEYS.iter().chain(&TEST_KEYS).any(|word| has(&key, word));
            let value = values.cells.get(column).filter(|cell| !cell.is_empty());
            if let Some(value) = value.filter(|_| is_keyed) {
                let text = value.text();
                let place = format!("line {}, \"{text}\"", values.line);
                self.scopes.push(Scope::new(text, place));
            }
        }
    }

    /// Returns the text that says that the strip was cut at 45° to its yarns; `None` where there is
    /// none, or a nearer text of the file says warp or weft. The names of the file and of its
    /// folder are equally near.
    pub(crate) fn bias(&self) -> Option<String> {
        for Scope { text, place, .. } in self.scopes.iter().filter(|scope| !scope.is_path) {
            if heading::is_bias(text) {
                return Some(place.clone());
            }
            if heading::directions(text).len() == 1 {
                return None;
            }
        }
        let mut names = self.scopes.iter().filter(|scope| scope.is_path);
        names.find(|scope| heading::is_bias(&scope.text)).map(|scope| scope.place.clone())
    }

    /// Returns the direction that the nearest text names; `Err` holds why there is none.
    pub(crate) fn direction(&self) -> Result<Told<Direction>, String> {
        let of_text = |text: &str| {
            let mut found = heading::directions(text);
            let tokens = normal(text);
            let tokens =
                tokens.split(' ').map(|word| word.trim_end_matches(|c: char| c.is_ascii_digit()));
            for direction in tokens.filter_map(spelling::direction) {
                if !found.contains(&direction) {
                    found.push(direction);
                }
            }
            found
        };
        self.nearest(of_text).map_err(|both| match both {
            Some(place) => format!("{place} names both directions, and nothing nearer names one"),
            None => "neither its titles nor the names of file and folder say warp or weft".into(),
        })
    }

    /// Returns the test of a curve that the nearest text names; `None` where none does.
    pub(crate) fn test(&self) -> Option<Told<Test>> {
        self.nearest(heading::tests).ok()
    }

    /// Returns the test without curves in a sheet that a text names.
    pub(crate) fn other_test(&self) -> Option<Told<&'static str>> {
        let of_text = |text: &str| {
            let text = normal(text);
            let named = |(_, words): &&(&str, &[&str])| words.iter().any(|word| has(&text, word));
            OTHER_TESTS.iter().filter(named).map(|(name, _)| *name).collect()
        };
        self.nearest(of_text).ok()
    }

    /// Returns what the nearest text names that names one; `Err` holds a place that names several.
    fn nearest<T: Copy>(&self, of: impl Fn(&str) -> Vec<T>) -> Result<Told<T>, Option<String>> {
        let mut several = None;
        for Scope { text, place, .. } in &self.scopes {
            match of(text).as_slice() {
                [] => {}
                [value] => return Ok(Told { value: *value, why: format!("by {place}") }),
                _ => _ = several.get_or_insert_with(|| place.clone()),
            }
        }
        Err(several)
    }
}

/// Returns the texts of a row, a blank between.
fn of_row(row: &Row) -> String {
    row.filled().map(|(_, cell)| cell.text()).collect::<Vec<_>>().join(" ")
}

fn has(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(place, _)| {
        let before = text[..place].chars().next_back();
        let after = text[place + word.len()..].chars().next();
        !word.is_ascii()
            || (before.is_none_or(|letter| !letter.is_alphabetic())
                && after.is_none_or(|letter| !letter.is_alphabetic() || word.len() > 4))
    })
}

/// Parts the words of a name where small letters meet capitals, and letters meet digits after them.
fn parted(name: &str) -> String {
    let mut parted = String::with_capacity(name.len() + 4);
    let mut before = ' ';
    for letter in name.chars() {
        let capital = before.is_lowercase() && letter.is_uppercase();
        if capital || (before.is_ascii_digit() && letter.is_alphabetic()) {
            parted.push(' ');
        }
        parted.push(letter);
        before = letter;
    }
    parted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    fn of(path: &str, text: &str) -> Evidence {
        let rows = Separator::Semicolon.split(text).expect("it splits");
        Evidence::of_rows("", &rows, Path::new(path))
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
