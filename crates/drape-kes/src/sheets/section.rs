//! Typed access to the tables of a TOML file, key by key. All mistakes are collected.
//!
//! A derived deserialiser stops at the first unknown key. A laboratory's sheet is written by hand,
//! so all mistakes are reported at once.

use drape_input::closest;
use toml::de::{DeTable, DeValue};

use crate::scatter;
use crate::sheets::findings::Findings;
use crate::sheets::spelling::{self, KEYS};
use crate::tables::layout::{Column, Take};
use crate::test::Direction;
use drape_input::{NumberWithUnit, Quantity, parse_quantity};

/// Table of the file, with the key path of the table.
#[derive(Clone)]
pub(crate) struct Section<'t> {
    path: String,
    table: &'t DeTable<'t>,
    /// Direction that the keys of values name. `None` reads keys without a direction.
    direction: Option<Direction>,
}

/// Number of the file: as written, in SI, and in the laboratory's unit.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// Value in SI.
    pub(crate) si: f64,
    /// Value in the laboratory's unit.
    pub(crate) laboratory: f64,
    /// Standard deviation that the text states, in SI.
    pub(crate) deviation: Option<f64>,
    /// Number as written, in the unit that is written with it.
    pub(crate) number: f64,
    /// Text as written.
    pub(crate) written: String,
    /// Key path.
    pub(crate) key: String,
}

/// Returns the value of `measured` in the laboratory's unit.
pub(crate) fn laboratory_value(measured: Option<Measured>) -> Option<f64> {
    measured.map(|measured| measured.laboratory)
}

/// Column of a table file, or one length for all rows.
#[derive(Clone, Debug)]
pub(crate) enum ColumnOrLength {
    Column(Column),
    /// Length, in metres.
    Length(f64),
}

/// Key whose value is one of a list of words.
pub(crate) struct Choice<'a, T> {
    pub(crate) key: &'a str,
    /// Admissible values.
    pub(crate) values: &'a [T],
    /// Returns the word of an admissible value.
    pub(crate) name: fn(T) -> &'static str,
}

impl<'t> Section<'t> {
    /// Returns the section of the whole file.
    pub(crate) fn root(table: &'t DeTable<'t>) -> Self {
        Self { path: String::new(), table, direction: None }
    }

    /// Returns the key path of `key` in this table.
    pub(crate) fn key(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// Reports every key of this table that is not among `keys`.
    pub(crate) fn allow(&self, keys: &[&str], findings: &mut Findings<'_>) {
        for key in self.table.keys().map(|key| key.get_ref().as_ref()) {
            if !keys.contains(&key) {
                self.report_unknown(key, keys, findings);
            }
        }
    }

    /// Returns the section that reads the values whose keys name `direction`.
    pub(crate) fn with_direction(mut self, direction: Option<Direction>) -> Self {
        self.direction = direction;
        self
    }

    /// Returns whether the value `key` is there, in any spelling, with `direction` in its key.
    pub(crate) fn has_value(&self, key: &str, direction: Option<Direction>) -> bool {
        self.clone().with_direction(direction).find_value(key).is_some()
    }

    /// Returns the spelling of the value `key` in the file, and the TOML value.
    fn find_value(&self, key: &str) -> Option<(&'t str, &'t DeValue<'t>)> {
        // An exact spelling wins over every other spelling.
        let exact = self.table.get_key_value(key).filter(|_| self.direction.is_none());
        let (written, value) = exact.or_else(|| {
            self.table.iter().find(|(written, _)| {
                spelling::value(written.get_ref())
                    .is_some_and(|spelt| spelt.key == key && spelt.direction == self.direction)
            })
        })?;
        // The table `B = { warp = 0.1, weft = 0.08 }` is no value: it has a direction in each key.
        let found = (written.get_ref().as_ref(), value.get_ref());
        Some(found).filter(|(_, value)| !(value.is_table() && spelling::value(key).is_some()))
    }

    /// Returns the table of `direction`, by any of its names. A second table of `direction` is
    /// reported.
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

    /// Reports every key that is neither among `keys` nor another spelling of a value among `keys`,
    /// and every value that stands twice. Only at the top of a sheet a key may name a direction.
    pub(crate) fn allow_values(&self, keys: &[&str], findings: &mut Findings<'_>) {
        let mut seen: Vec<(spelling::SpelledKey, &str)> = Vec::new();
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
                self.report_unknown(key, keys, findings);
            }
        }
    }

    /// Reports the unknown key `key`, with the closest of `keys` or all `keys`.
    fn report_unknown(&self, key: &str, keys: &[&str], findings: &mut Findings<'_>) {
        let help = match closest(key, keys.iter().copied()) {
            Some(close) => format!("did you mean `{close}`?"),
            None => format!("known here: {}", keys.join(", ")),
        };
        findings.error(&self.key(key), "there is no such key", help);
    }

    /// Returns the TOML value of `key`.
    fn get(&self, key: &str) -> Option<&'t DeValue<'t>> {
        self.table.get(key).map(|value| value.get_ref())
    }

    /// Returns whether `key` is there. A missing key is reported with an `example`, unless it is
    /// misspelt, because [`Section::allow`] reports the misspelt key.
    fn require(&self, key: &str, example: &str, findings: &mut Findings<'_>) -> bool {
        if self.get(key).is_some() {
            return true;
        }
        let mut keys = self.table.keys().map(|written| written.get_ref().as_ref());
        let is_misspelt =
            keys.any(|written: &str| written != key && closest(written, [key]).is_some());
        if !is_misspelt {
            let help = format!("add a line such as {key} = {example}");
            findings.error(&self.key(key), "is missing", help);
        }
        false
    }

    /// Reports that the value of `key` has another type than `wanted`.
    fn report_wrong_type(&self, key: &str, wanted: &str, findings: &mut Findings<'_>) {
        let actual = match self.get(key) {
            Some(DeValue::String(_)) => "text",
            Some(DeValue::Integer(_) | DeValue::Float(_)) => "a number",
            Some(DeValue::Boolean(_)) => "true or false",
            Some(DeValue::Array(_)) => "a list",
            Some(DeValue::Table(_)) => "a table",
            _ => "something else",
        };
        let message = format!("is {actual} where {wanted} is needed");
        findings.error(&self.key(key), message, format!("write {wanted}"));
    }

    /// Returns the text of `key`, if the key is there.
    pub(crate) fn text(&self, key: &str, findings: &mut Findings<'_>) -> Option<String> {
        match self.get(key)? {
            DeValue::String(text) => Some(text.to_string()),
            _ => {
                self.report_wrong_type(key, "text in quotes", findings);
                None
            }
        }
    }

    /// Returns the text of `key`, if the key is there. A whole number or a date is returned as
    /// text.
    pub(crate) fn text_or_number(&self, key: &str, findings: &mut Findings<'_>) -> Option<String> {
        match self.get(key)? {
            DeValue::String(text) => Some(text.to_string()),
            DeValue::Integer(number) => Some(number.as_str().to_owned()),
            DeValue::Datetime(date) => Some(date.to_string()),
            _ => {
                self.report_wrong_type(key, "text in quotes", findings);
                None
            }
        }
    }

    /// Returns the word of `choice`, whose key must be there.
    pub(crate) fn required_choice<T: Copy>(
        &self,
        choice: &Choice<'_, T>,
        findings: &mut Findings<'_>,
    ) -> Option<T> {
        let example = format!("\"{}\"", (choice.name)(choice.values[0]));
        let written = self.required_text(choice.key, &example, findings)?;
        self.choose(choice, &written, findings)
    }

    /// Returns the word of `choice`, if its key is there.
    pub(crate) fn choice<T: Copy>(
        &self,
        choice: &Choice<'_, T>,
        findings: &mut Findings<'_>,
    ) -> Option<T> {
        let written = self.text(choice.key, findings)?;
        self.choose(choice, &written, findings)
    }

    /// Returns the value of `choice` whose word is `written`. An unknown word is reported.
    pub(crate) fn choose<T: Copy>(
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

    /// Returns the text of `key`, which must be there.
    pub(crate) fn required_text(
        &self,
        key: &str,
        example: &str,
        findings: &mut Findings<'_>,
    ) -> Option<String> {
        self.require(key, example, findings).then(|| self.text(key, findings)).flatten()
    }

    /// Returns the truth value of `key`; `false` if the key is missing.
    pub(crate) fn flag(&self, key: &str, findings: &mut Findings<'_>) -> bool {
        match self.get(key) {
            None => false,
            Some(DeValue::Boolean(flag)) => *flag,
            Some(_) => {
                self.report_wrong_type(key, "true or false", findings);
                false
            }
        }
    }

    /// Returns the texts of `key`, which must be there: one text, or a list of texts.
    pub(crate) fn required_texts(
        &self,
        key: &str,
        example: &str,
        findings: &mut Findings<'_>,
    ) -> Option<Vec<String>> {
        if !self.require(key, example, findings) {
            return None;
        }
        let texts = match self.get(key)? {
            DeValue::Array(items) => items.iter().map(|item| owned_text(item.get_ref())).collect(),
            value => owned_text(value).map(|text| vec![text]),
        };
        let texts = texts.filter(|texts: &Vec<String>| !texts.is_empty());
        if texts.is_none() {
            self.report_wrong_type(key, "text in quotes, or a list of such texts", findings);
        }
        texts
    }

    /// Returns the number of lines that `key` gives, if the key is there; `false` counts as 0.
    pub(crate) fn whole(&self, key: &str, findings: &mut Findings<'_>) -> Option<usize> {
        let value = match self.get(key)? {
            DeValue::Integer(number) => number.as_str().parse().ok(),
            DeValue::Boolean(false) => Some(0),
            _ => None,
        };
        if value.is_none() {
            self.report_wrong_type(key, "a number of lines, such as 12", findings);
        }
        value
    }

    /// Returns the choice among numbered tables, specimens or cycles of `key`: a number from 1, a
    /// list of numbers, or `"all"`.
    pub(crate) fn take(&self, key: &str, findings: &mut Findings<'_>) -> Take {
        let Some(value) = self.get(key) else { return Take::Undeclared };
        let take = match value {
            DeValue::String(text) if text == "all" => Some(Take::All),
            DeValue::Array(items) => {
                let numbers: Option<Vec<usize>> =
                    items.iter().map(|item| parse_whole(item.get_ref())).collect();
                numbers.filter(|numbers| !numbers.is_empty()).map(Take::Numbers)
            }
            value => parse_whole(value).map(|number| Take::Numbers(vec![number])),
        };
        if take.is_none() {
            self.report_wrong_type(
                key,
                "a number from 1, a list such as [1, 3], or \"all\"",
                findings,
            );
        }
        take.unwrap_or_default()
    }

    /// Returns the sheet of a spreadsheet that `key` gives, by name or by number from 1, if the key
    /// is there.
    pub(crate) fn name_or_number(&self, key: &str, findings: &mut Findings<'_>) -> Option<Column> {
        let column = parse_column(self.get(key)?);
        if column.is_none() {
            self.report_wrong_type(key, "a name in quotes, or a number from 1", findings);
        }
        column
    }

    /// Returns the columns of `key`, by name or by number from 1: no column, one column, or a list
    /// of columns.
    pub(crate) fn columns(&self, key: &str, findings: &mut Findings<'_>) -> Vec<Column> {
        let Some(value) = self.get(key) else { return Vec::new() };
        let columns = match value {
            DeValue::Array(items) => {
                items.iter().map(|item| parse_column(item.get_ref())).collect()
            }
            value => parse_column(value).map(|column| vec![column]),
        };
        if columns.is_none() {
            self.report_wrong_type(
                key,
                "a column name, its place from 1, or a list of them",
                findings,
            );
        }
        columns.unwrap_or_default()
    }

    /// Returns whether `key` is there.
    pub(crate) fn declares(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// Returns the finite number of `key`, if the key is there: a number in the laboratory's unit,
    /// or a text with a number and its unit.
    pub(crate) fn measured(
        &self,
        key: &str,
        quantity: Quantity,
        findings: &mut Findings<'_>,
    ) -> Option<Measured> {
        let laboratory_unit = quantity.laboratory();
        let (key, value) = self.find_value(key)?;

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
                    self.report_wrong_type(
                        key,
                        "a number, or text with a number and its unit",
                        findings,
                    );
                    return None;
                };
                (number, laboratory_unit, number.to_string())
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
        let laboratory = if unit == laboratory_unit { number } else { si / laboratory_unit.factor };
        Some(Measured { si, laboratory, deviation, number, written, key: self.key(key) })
    }

    /// Returns the table of `key` inside this table, if the key is there.
    pub(crate) fn section(&self, key: &str, findings: &mut Findings<'_>) -> Option<Section<'t>> {
        match self.get(key)? {
            DeValue::Table(table) => Some(Section { path: self.key(key), table, direction: None }),
            _ => {
                self.report_wrong_type(key, "a table", findings);
                None
            }
        }
    }

    /// Returns the tables of the array of tables `key`.
    pub(crate) fn sections(&self, key: &str, findings: &mut Findings<'_>) -> Vec<Section<'t>> {
        let items: Vec<_> = match self.get(key) {
            None => return Vec::new(),
            Some(DeValue::Array(array)) => array.iter().map(|item| item.get_ref()).collect(),
            // A value that is no array fails the test below.
            Some(value) => vec![value],
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
            self.report_wrong_type(key, &format!("a list of [[{key}]] tables"), findings);
            return Vec::new();
        }
        sections
    }

    /// Returns the length of `key` with its unit, or the column of lengths in metres. A number
    /// without unit is in metres.
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
                    self.report_wrong_type(
                        key,
                        "a column name, or text such as \"5 cm\"",
                        findings,
                    );
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

/// Returns a copy of a text.
fn owned_text(value: &DeValue<'_>) -> Option<String> {
    value.as_str().map(str::to_owned)
}

/// Parses a whole number that is not negative.
fn parse_whole(value: &DeValue<'_>) -> Option<usize> {
    match value {
        DeValue::Integer(number) => number.as_str().parse::<usize>().ok(),
        _ => None,
    }
}

/// Parses a column, a name or a number from 1.
fn parse_column(value: &DeValue<'_>) -> Option<Column> {
    match value {
        DeValue::String(name) => Some(Column::Name(name.to_string())),
        DeValue::Integer(number) => number.as_str().parse().ok().map(Column::Number),
        _ => None,
    }
}

/// Returns whether `key` names a table of values: a direction, or the mean of both.
fn is_table_of_values(key: &str) -> bool {
    key == "mean" || spelling::direction(key).is_some()
}

/// Returns whether `text` begins with a digit, a sign or a point.
fn starts_with_number(text: &str) -> bool {
    text.trim_start().starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
}

/// Returns the number of an integer or a float; `None` for a `value` of another type.
fn bare_number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(|integer| integer as f64),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}
