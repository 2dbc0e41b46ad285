//! Values of a draft as lines of a sheet, each with its source. A value that the reader of sheets
//! refuses is written as a comment.

use std::collections::BTreeMap;

use drape_input::{Quantity, figure, toml_string};

use crate::exports::curve_draft::{comment_out, line, read, single_line};
use crate::exports::file_curves::describe_mistake;
use crate::exports::files::Files;
use crate::results::item::Item;
use crate::results::sheet_value::{ConvertedValues, DraftValue};
use crate::test::Direction;

/// Values without direction that a sheet should have: name, keys that give the value, and an
/// example.
const WANTED: [(&str, &[&str], &str); 2] = [
    ("W", &["W"], "# W = 12.0      # mg/cm2, the mass per area"),
    ("T", &["T", "T0"], "# T = 0.40      # mm, the thickness"),
];

/// Lines of values, with their count, readings and notes.
#[derive(Default)]
pub(crate) struct ValueLines {
    pub(crate) text: String,
    pub(crate) values: usize,
    /// Source and interpretation of each value, one line per value.
    pub(crate) readings: Vec<String>,
    pub(crate) notes: Vec<String>,
}

/// Writes the values `converted` of a fabric whose sheet lies beside `files`.
pub(crate) fn value_lines(converted: &ConvertedValues, files: &Files) -> ValueLines {
    let mut lines = ValueLines { notes: converted.notes.clone(), ..ValueLines::default() };
    let mut groups: BTreeMap<Option<Direction>, Vec<&DraftValue>> = BTreeMap::new();
    for value in &converted.values {
        groups.entry(value.direction).or_default().push(value);
    }
    groups.entry(None).or_default();

    for (direction, values) in groups {
        let head = direction.map_or(String::new(), |d| format!("\n[{}]\n", d.name()));
        lines.text += &head;
        let mut taken: Vec<&DraftValue> = Vec::new();
        for value in values {
            lines.add(value, &head, files, &mut taken);
        }

        if direction.is_none() {
            for (_, _, example) in missing(&taken) {
                lines.text += &format!("{example}: none was read in the files\n");
            }
            for unused in &converted.unused {
                lines.text += &format!("# {}\n", single_line(unused));
                lines.notes.push(unused.clone());
            }
        }
        lines.values += taken.len();
    }
    lines
}

/// Returns the values of [`WANTED`] that are not among `taken`.
fn missing(taken: &[&DraftValue]) -> Vec<(&'static str, &'static [&'static str], &'static str)> {
    WANTED
        .into_iter()
        .filter(|(_, keys, _)| !taken.iter().any(|value| keys.contains(&value.key)))
        .collect()
}

impl ValueLines {
    /// Adds the line of `value` below `head`. A value that the reader refuses is added as a
    /// comment.
    fn add<'v>(
        &mut self,
        value: &'v DraftValue,
        head: &str,
        files: &Files,
        taken: &mut Vec<&'v DraftValue>,
    ) {
        let value_line = line(value.key, &value.written(), &value.why);
        match read(&format!("{head}{value_line}"), files) {
            Ok(_) => {
                taken.push(value);
                self.text += &value_line;
                let direction = value.direction.map_or(String::new(), |d| format!(" {}", d.name()));
                let written = value.written().trim_matches('"').to_owned();
                self.readings.push(format!("{}{direction} = {written}: {}", value.key, value.why));
            }
            Err(mistakes) => {
                let words: Vec<String> = mistakes.0.iter().map(describe_mistake).collect();
                let words = single_line(&words.join("; "));
                self.notes.push(format!("{}: {} is not taken: {words}", value.why, value.key));
                self.text += &format!("{}#   not taken: {words}\n", comment_out(&value_line));
            }
        }
    }
}

impl DraftValue {
    /// Returns the value as TOML: a number, or a text with standard deviation and unit.
    fn written(&self) -> String {
        let number = figure(self.number);
        let deviation = self.deviation.map(|deviation| format!(" ± {}", figure(deviation)));
        // A ratio is a ratio by its quantity, so its sign for no unit is left out.
        let unit = self.unit.filter(|unit| *unit != "-" || !self.is_ratio());
        if deviation.is_none() && unit.is_none() {
            return number;
        }
        let unit = unit.map_or(String::new(), |unit| format!(" {unit}"));
        toml_string(&format!("{number}{}{unit}", deviation.unwrap_or_default()))
    }

    /// Returns whether a number of the value without unit is a ratio.
    fn is_ratio(&self) -> bool {
        let item = Item::Key(self.key);
        item.quantity() == Some(Quantity::Ratio) && item.is_ratio()
    }
}
