//! Values of a draft as lines of a sheet, each with its source; what a sheet does not take is a
//! comment.

use std::collections::BTreeMap;
use std::path::Path;

use drape_input::{Quantity, figure, toml_string};

use crate::exports::curve_draft::{commented, line, plain, read};
use crate::exports::found::in_words;
use crate::results::item::Item;
use crate::results::sheet_value::{Converted, SheetValue};
use crate::test::Direction;

/// Values that have no direction and that a fabric should have, with an example.
const WANTED: [(&str, &[&str], &str); 2] = [
    ("W", &["W"], "# W = 12.0      # mg/cm2, the mass per area"),
    ("T", &["T", "T0"], "# T = 0.40      # mm, the thickness"),
];

/// Lines of values, with their count and what is to be told.
#[derive(Default)]
pub(crate) struct ValueLines {
    pub(crate) text: String,
    pub(crate) values: usize,
    /// What each value was taken for, a line each.
    pub(crate) readings: Vec<String>,
    pub(crate) notes: Vec<String>,
}

/// Writes the values of a fabric whose sheet lies in a folder.
pub(crate) fn value_lines(converted: &Converted, folder: &Path) -> ValueLines {
    let mut lines = ValueLines { notes: converted.notes.clone(), ..ValueLines::default() };
    let mut groups: BTreeMap<Option<Direction>, Vec<&SheetValue>> = BTreeMap::new();
    converted
        .values
        .iter()
        .for_each(|value| groups.entry(value.direction).or_default().push(value));
    groups.entry(None).or_default();
    for (direction, values) in groups {
        let head = direction.map_or(String::new(), |d| format!("\n[{}]\n", d.name()));
        lines.text += &head;
        let mut taken: Vec<&SheetValue> = Vec::new();
        for value in values {
            lines.add(value, &head, folder, &mut taken);
        }
        if direction.is_none() {
            for (_, _, example) in missing(&taken) {
                lines.text += &format!("{example}: none was read in the files\n");
            }
            for unused in &converted.unused {
                lines.text += &format!("# {}\n", plain(unused));
                lines.notes.push(unused.clone());
            }
        }
        lines.values += taken.len();
    }
    lines
}

/// Returns the values that a fabric should have and has not.
fn missing(taken: &[&SheetValue]) -> Vec<(&'static str, &'static [&'static str], &'static str)> {
    let has = |keys: &[&str]| taken.iter().any(|value| keys.contains(&value.key));
    WANTED.into_iter().filter(|(_, keys, _)| !has(keys)).collect()
}

impl ValueLines {
    /// Adds the line of a value below a head; a comment where it is refused.
    fn add<'v>(
        &mut self,
        value: &'v SheetValue,
        head: &str,
        folder: &Path,
        taken: &mut Vec<&'v SheetValue>,
    ) {
        let one = line(value.key, &value.written(), &value.why);
        match read(&format!("{head}{one}"), folder) {
            Ok(_) => {
                taken.push(value);
                self.text += &one;
                let direction = value.direction.map_or(String::new(), |d| format!(" {}", d.name()));
                let written = value.written().trim_matches('"').to_owned();
                self.readings.push(format!("{}{direction} = {written}: {}", value.key, value.why));
            }
            Err(mistakes) => {
                let words: Vec<String> = mistakes.0.iter().map(in_words).collect();
                let words = plain(&words.join("; "));
                self.notes.push(format!("{}: {} is not taken: {words}", value.why, value.key));
                self.text += &format!("{}#   not taken: {words}\n", commented(&one));
            }
        }
    }
}

impl SheetValue {
    /// Returns the value as TOML: a number, or a text with its standard deviation and its unit.
    fn written(&self) -> String {
        let number = figure(self.number);
        let deviation = self.deviation.map(|deviation| format!(" ± {}", figure(deviation)));
        // A ratio without a unit is a ratio, and LT is one.
        let unit = self.unit.filter(|unit| *unit != "-" || !self.is_bare_ratio());
        match (deviation, unit) {
            (None, None) => number,
            (deviation, unit) => {
                let unit = unit.map_or(String::new(), |unit| format!(" {unit}"));
                toml_string(&format!("{number}{}{unit}", deviation.unwrap_or_default()))
            }
        }
    }

    fn is_bare_ratio(&self) -> bool {
        let item = Item::Key(self.key);
        item.quantity() == Some(Quantity::Ratio) && item.is_bare_ratio()
    }
}
