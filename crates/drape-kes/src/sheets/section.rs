//! Typed access to the tables of a TOML file, key by key, with all mistakes collected.
//!
//! A derived deserialiser stops at the first unknown key. A laboratory's sheet is written by hand,
//! so all of its mistakes are reported at once.

use drape_input::closest;
use toml::de::{DeTable, DeValue};

use crate::scatter;
use crate::sheets::findings::Findings;
use crate::sheets::spelling::{self, KEYS};
use crate::tables::layout::{Column, Take};
use crate::test::Direction;
use drape_input::{NumberWithUnit, Quantity, parse_quantity};

/// Table of the file, with its key path.
#[derive(Clone)]
pub(crate) struct Section<'t> {
    path: String,
    table: &'t DeTable<'t>,
    /// Direction that the keys of values name; `None` for keys without a direction.
    direction: Option<Direction>,
}

/// Number of the file: as written, in SI, and in the laboratory's unit.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// Value in SI.
    pub(crate) si: f64,
    /// Value in the laboratory's unit.
    pub(crate) laboratory: f64,
    /// Standard deviation that is stated with it, in SI.
    pub(crate) deviation: Option<f64>,
    /// Number as written, whatever its unit.
    pub(crate) number: f64,
    /// Text as written.
    pub(crate) written: String,
    /// Key path.
    pub(crate) key: String,
}

/// Column of a table file, or a length for all of its rows.
#[derive(Clone, Debug)]
pub(crate) enum ColumnOrLength {
    Column(Column),
    /// Length, in metres.
    Length(f64),
}

/// Key whose value is one of several words.
pub(crate) struct Choice<'a, T> {
    pub(crate) key: &'a str,
    /// Admissible values.
    pub(crate) values: &'a [T],
    /// Word for each of them.
    pub(crate) name: fn(T) -> &'static str,
}

impl<'t> Section<'t> {
    /// Returns the whole file.
    pub(crate) fn root(table: &'t DeTable<'t>) -> Self {
        Self { path: String::new(), table, direction: None }
    }

    /// Returns the key path of a key of this table.
    pub(crate) fn key(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// Reports every key that is not in a list.
    pub(crate) fn allow(&self, keys: &[&str], findings: &mut Findings<'_>) {
        for key in self.table.keys().map(|key| key.get_ref().as_ref()) {
            if !keys.contains(&key) {
                self.unknown(key, keys, findings);
            }
        }
    }

    /// Returns the table with the values of a direction for its keys.
    pub(crate) fn of(mut self, direction: Option<Direction>) -> Self {
        self.direction = direction;
        self
    }

    /// Returns whether a value is there, in any spelling, with that direction in its key.
    pub(crate) fn has_value(&self, key: &str, direction: Option<Direction>) -> bool {
        self.clone().of(direction).spelt(key).is_some()
    }

    /// Returns the key as it is written, in whatever spelling, and its value.
    fn spelt(&self, key: &str) -> Option<(&'t str, &'t DeValue<'t>)> {
        let means = |written: &str| {
            spelling::value(written)
                .is_some_and(|spelt| spelt.key == key && spelt.direction == self.direction)
        };
        let exact = |written: &str| written == key && self.direction.is_none();
        let pairs = || self.table.iter().map(|(k, value)| (k.get_ref().as_ref(), value.get_ref()));
        let found = pairs().find(|(k, _)| exact(k)).or_else(|| pairs().find(|(k, _)| means(k)))?;
        // `B = { warp = 0.1, weft = 0.08 }` has directions within.
        Some(found).filter(|(_, value)| !(value.is_table() && spelling::value(key).is_some()))
    }

    /// Returns the table of a direction, whatever it is called.
    pub(crate) fn directed(
        &self,
        direction: Direction,
        findings: &mut Findings<'_>,
    ) -> Option<Section<'t>> {
        let keys = self.table.keys().map(|key| key.get_ref().as_ref());
        let named: Vec<&str> = keys.filter(|k| spelling::direction(k) == Some(direction)).collect();
        if let [_, second, ..] = named.as_slice() {
            let message = format!("is the {} once more, beside [{}]", direction.name(), named[0]);
            findings.error(&self.key(second), message, "put the values into one table");
        }
        self.section(named.first()?, findings)
    }

    /// Reports every key that is neither in a list nor another spelling of a value in it, and every
    /// value that is there twice. Only at the top of a sheet a key names a direction, of a value that
    /// has one.
    pub(crate) fn allow_values(&self, keys: &[&str], findings: &mut Findings<'_>) {
        let mut seen: Vec<(spelling::Spelt, &str)> = Vec::new();
        for key in self.table.keys().map(|key| key.get_ref().as_ref()) {
            let spelt = spelling::value(key).filter(|spelt| {
                let directed = self.path.is_empty() && KEYS.contains(&spelt.key);
                keys.contains(&spelt.key) && (spelt.direction.is_none() || directed)
            });
            if let Some(spelt) = spelt {
                if self.get(key).is_some_and(|value| value.is_table()) {
                    let help =
                        format!("write {key} into [warp] and [weft], or {key}_warp and {key}_weft");
                    findings.error(&self.key(key), "is a table where a number is needed", help);
                }
                if let Some((_, first)) = seen.iter().find(|(other, _)| *other == spelt) {
                    let message = format!("is {} once more: {first} is there too", spelt.key);
                    findings.error(&self.key(key), message, "keep one of them");
                }
                seen.push((spelt, key));
            } else if !(keys.contains(&key) || self.path.is_empty() && is_table_of_values(key)) {
                self.unknown(key, keys, findings);
            }
        }
    }

    fn unknown(&self, key: &str, keys: &[&str], findings: &mut Findings<'_>) {
        let help = match closest(key, keys.iter().copied()) {
            Some(close) => format!("did you mean `{close}`?"),
            None => format!("known here: {}", keys.join(", ")),
        };
        findings.error(&self.key(key), "there is no such key", help);
    }

    fn get(&self, key: &str) -> Option<&'t DeValue<'t>> {
        self.table.get(key).map(|value| value.get_ref())
    }

    /// Returns whether a key is there; reports it with an example if not, unless it is there
    /// misspelt, which `allow` reports.
    fn has(&self, key: &str, example: &str, findings: &mut Findings<'_>) -> bool {
        let there = self.get(key).is_some();
        let misspelt = || {
            let mut keys = self.table.keys().map(|k| k.get_ref().as_ref());
            keys.any(|k: &str| k != key && closest(k, [key]).is_some())
        };
        if !there && !misspelt() {
            let help = format!("add a line such as {key} = {example}");
            findings.error(&self.key(key), "is missing", help);
        }
        there
    }

    fn wrong_kind(&self, key: &str, wanted: &str, findings: &mut Findings<'_>) {
        let found = match self.get(key) {
            Some(DeValue::String(_)) => "text",
            Some(DeValue::Integer(_) | DeValue::Float(_)) => "a number",
            Some(DeValue::Boolean(_)) => "true or false",
            Some(DeValue::Array(_)) => "a list",
            Some(DeValue::Table(_)) => "a table",
            _ => "something else",
        };
        let message = format!("is {found} where {wanted} is needed");
        findings.error(&self.key(key), message, format!("write {wanted}"));
    }

    /// Returns a text, if the key is there.
    pub(crate) fn text(&self, key: &str, findings: &mut Findings<'_>) -> Option<String> {
        match self.get(key)? {
            DeValue::String(text) => Some(text.to_string()),
            _ => {
                self.wrong_kind(key, "text in quotes", findings);
                None
            }
        }
    }

    /// Returns a text, or a whole number or a date as text, if the key is there.
    pub(crate) fn text_or_number(&self, key: &str, findings: &mut Findings<'_>) -> Option<String> {
        match self.get(key)? {
            DeValue::String(text) => Some(text.to_string()),
            DeValue::Integer(number) => Some(number.as_str().to_owned()),
            DeValue::Datetime(date) => Some(date.to_string()),
            _ => {
                self.wrong_kind(key, "text in quotes", findings);
                None
            }
        }
    }

    /// Returns one of several words, which must be there.
    pub(crate) fn required_choice<T: Copy>(
        &self,
        choice: &Choice<'_, T>,
        findings: &mut Findings<'_>,
    ) -> Option<T> {
        let example = format!("\"{}\"", (choice.name)(choice.values[0]));
        let written = self.required_text(choice.key, &example, findings)?;
        self.chosen(choice, &written, findings)
    }

    /// Returns one of several words, if the key is there.
    pub(crate) fn choice<T: Copy>(
        &self,
        choice: &Choice<'_, T>,
        findings: &mut Findings<'_>,
    ) -> Option<T> {
        let written = self.text(choice.key, findings)?;
        self.chosen(choice, &written, findings)
    }

    fn chosen<T: Copy>(
        &self,
        choice: &Choice<'_, T>,
        written: &str,
        findings: &mut Findings<'_>,
    ) -> Option<T> {
        let names: Vec<&str> = choice.values.iter().map(|&value| (choice.name)(value)).collect();
        if let Some(index) = names.iter().position(|name| *name == written) {
            return Some(choice.values[index]);
        }
        let help = match closest(written, names.iter().copied()) {
            Some(close) => format!("did you mean \"{close}\"?"),
            None => format!("it is one of {}", names.join(", ")),
        };
        findings.error(&self.key(choice.key), format!("\"{written}\" is not known"), help);
        None
    }

    /// Returns a text, which must be there.
    pub(crate) fn required_text(
        &self,
        key: &str,
        example: &str,
        findings: &mut Findings<'_>,
    ) -> Option<String> {
        self.has(key, example, findings).then(|| self.text(key, findings)).flatten()
    }

    /// Returns a truth value, `false` if the key is not there.
    pub(crate) fn flag(&self, key: &str, findings: &mut Findings<'_>) -> bool {
        match self.get(key) {
            None => false,
            Some(DeValue::Boolean(flag)) => *flag,
            Some(_) => {
                self.wrong_kind(key, "true or false", findings);
                false
            }
        }
    }

    /// Returns texts: one, or a list of them, which must be there.
    pub(crate) fn required_texts(
        &self,
        key: &str,
        example: &str,
        findings: &mut Findings<'_>,
    ) -> Option<Vec<String>> {
        if !self.has(key, example, findings) {
            return None;
        }
        let text = |value: &DeValue<'_>| value.as_str().map(str::to_owned);
        let texts = match self.get(key)? {
            DeValue::Array(items) => items.iter().map(|item| text(item.get_ref())).collect(),
            one => text(one).map(|text| vec![text]),
        };
        let texts = texts.filter(|texts: &Vec<String>| !texts.is_empty());
        if texts.is_none() {
            self.wrong_kind(key, "text in quotes, or a list of such texts", findings);
        }
        texts
    }

    /// Returns a whole number that is not negative, if the key is there; `false` is none.
    pub(crate) fn whole(&self, key: &str, findings: &mut Findings<'_>) -> Option<usize> {
        let value = match self.get(key)? {
            DeValue::Integer(number) => number.as_str().parse().ok(),
            DeValue::Boolean(false) => Some(0),
            _ => None,
        };
        if value.is_none() {
            self.wrong_kind(key, "a number of lines, such as 12", findings);
        }
        value
    }

    /// Returns a choice among several of a kind: a number from 1, a list of them, or `"all"`.
    pub(crate) fn take(&self, key: &str, findings: &mut Findings<'_>) -> Take {
        let Some(value) = self.get(key) else { return Take::Undeclared };
        let number = |value: &DeValue<'_>| match value {
            DeValue::Integer(number) => number.as_str().parse::<usize>().ok(),
            _ => None,
        };
        let take = match value {
            DeValue::String(text) if text == "all" => Some(Take::All),
            DeValue::Array(items) => {
                let numbers: Option<Vec<usize>> =
                    items.iter().map(|item| number(item.get_ref())).collect();
                numbers.filter(|numbers| !numbers.is_empty()).map(Take::These)
            }
            one => number(one).map(|number| Take::These(vec![number])),
        };
        if take.is_none() {
            self.wrong_kind(key, "a number from 1, a list such as [1, 3], or \"all\"", findings);
        }
        take.unwrap_or_default()
    }

    /// Returns a sheet of a spreadsheet, by its name or its number from 1, if the key is there.
    pub(crate) fn name_or_number(&self, key: &str, findings: &mut Findings<'_>) -> Option<Column> {
        let found = as_column(self.get(key)?);
        if found.is_none() {
            self.wrong_kind(key, "a name in quotes, or a number from 1", findings);
        }
        found
    }

    /// Returns columns, by their names or numbers from 1: none, one, or a list of them.
    pub(crate) fn columns(&self, key: &str, findings: &mut Findings<'_>) -> Vec<Column> {
        let Some(value) = self.get(key) else { return Vec::new() };
        let columns = match value {
            DeValue::Array(items) => items.iter().map(|item| as_column(item.get_ref())).collect(),
            one => as_column(one).map(|column| vec![column]),
        };
        if columns.is_none() {
            self.wrong_kind(key, "a column name, its place from 1, or a list of them", findings);
        }
        columns.unwrap_or_default()
    }

    /// Returns whether a key is there.
    pub(crate) fn declares(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// Returns a finite number, bare in the laboratory's unit or text with its unit.
    pub(crate) fn measured(
        &self,
        key: &str,
        quantity: Quantity,
        findings: &mut Findings<'_>,
    ) -> Option<Measured> {
        let own = quantity.laboratory();
        let (spelt, value) = self.spelt(key)?;
        let key = spelt;
        let mut deviation = None;
        let (number, unit, written) = match value {
            DeValue::String(text) => {
                let parsed = match scatter::parse(text, quantity) {
                    None => parse_quantity(text, quantity),
                    Some(parted) => parted.map(|parted| {
                        deviation = Some(parted.deviation);
                        parted.value
                    }),
                };
                match parsed {
                    Ok(NumberWithUnit { number, unit }) => (number, unit, text.to_string()),
                    Err(error) => {
                        findings.error(&self.key(key), error.message, error.help);
                        return None;
                    }
                }
            }
            value => {
                let Some(number) = bare_number(value) else {
                    self.wrong_kind(key, "a number, or text with a number and its unit", findings);
                    return None;
                };
                (number, own, number.to_string())
            }
        };
        if !number.is_finite() {
            let help = "write the measured value, or remove the line if it was not measured";
            findings.error(&self.key(key), format!("{written} is not a finite number"), help);
            return None;
        }
        if let Some(stated) = deviation.filter(|stated| !(stated.is_finite() && *stated >= 0.0)) {
            let message =
                format!("{written}: a standard deviation of {stated} is not zero or more");
            findings.error(
                &self.key(key),
                message,
                "write the value, ± and its standard deviation",
            );
            return None;
        }
        let si = number * unit.factor;
        let laboratory = if unit == own { number } else { si / own.factor };
        Some(Measured { si, laboratory, deviation, number, written, key: self.key(key) })
    }

    /// Returns a table inside this one, if the key is there.
    pub(crate) fn section(&self, key: &str, findings: &mut Findings<'_>) -> Option<Section<'t>> {
        match self.get(key)? {
            DeValue::Table(table) => Some(Section { path: self.key(key), table, direction: None }),
            _ => {
                self.wrong_kind(key, "a table", findings);
                None
            }
        }
    }

    /// Returns the tables of an array of tables.
    pub(crate) fn sections(&self, key: &str, findings: &mut Findings<'_>) -> Vec<Section<'t>> {
        let items: Vec<_> = match self.get(key) {
            None => return Vec::new(),
            Some(DeValue::Array(array)) => array.iter().map(|item| item.get_ref()).collect(),
            // Anything else fails the test below.
            Some(other) => vec![other],
        };
        let whole = items.len();
        let sections: Vec<_> = items
            .into_iter()
            .enumerate()
            .filter_map(|(index, item)| {
                let path = format!("{}[{index}]", self.key(key));
                item.as_table().map(|table| Section { path, table, direction: None })
            })
            .collect();
        if sections.len() < whole || !matches!(self.get(key), Some(DeValue::Array(_))) {
            self.wrong_kind(key, &format!("a list of [[{key}]] tables"), findings);
            return Vec::new();
        }
        sections
    }

    /// Returns a length with its unit (a bare number is in metres), or a column in metres.
    pub(crate) fn column_or_length(
        &self,
        key: &str,
        findings: &mut Findings<'_>,
    ) -> Option<ColumnOrLength> {
        let length = match self.get(key)? {
            DeValue::String(text) if starts_with_number(text) => {
                self.measured(key, Quantity::Length, findings)?.si
            }
            DeValue::String(name) => {
                return Some(ColumnOrLength::Column(Column::Name(name.to_string())));
            }
            value => {
                let Some(length) = bare_number(value) else {
                    self.wrong_kind(key, "a column name, or text such as \"5 cm\"", findings);
                    return None;
                };
                length
            }
        };
        if length > 0.0 && length.is_finite() {
            return Some(ColumnOrLength::Length(length));
        }
        let help = "write the length with its unit, such as \"5 cm\"";
        findings.error(&self.key(key), format!("{length} m is not a positive length"), help);
        None
    }
}

fn as_column(value: &DeValue<'_>) -> Option<Column> {
    match value {
        DeValue::String(name) => Some(Column::Name(name.to_string())),
        DeValue::Integer(number) => number.as_str().parse().ok().map(Column::Number),
        _ => None,
    }
}

/// Returns whether a key is that of a table of values.
fn is_table_of_values(key: &str) -> bool {
    key == "mean" || spelling::direction(key).is_some()
}

fn starts_with_number(text: &str) -> bool {
    text.trim_start().starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
}

fn bare_number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(|integer| integer as f64),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}
