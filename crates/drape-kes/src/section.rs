//! Reads the tables of a TOML file key by key, and collects everything that is wrong with them.
//!
//! A derived deserialiser stops at the first unknown key. A laboratory's sheet is written by hand, so all
//! of its slips are worth finding at once, each with its line, column, value and remedy.

use std::ops::Range;
use std::path::PathBuf;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::Diagnostic;
use crate::spelling;
use crate::table::Column;
use crate::unit::{self, Quantity};

/// The file being read and what was found wrong with it so far.
pub(crate) struct Findings<'t> {
    pub(crate) path: PathBuf,
    pub(crate) text: &'t str,
    pub(crate) errors: Vec<Diagnostic>,
    pub(crate) warnings: Vec<Diagnostic>,
}

impl Findings<'_> {
    /// A finding at a place of the file.
    pub(crate) fn at(&self, span: &Range<usize>, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(&self.path, message).at_offset(self.text, span.start)
    }

    pub(crate) fn error(
        &mut self,
        span: &Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let finding = self.at(span, message).with_help(help);
        self.errors.push(finding);
    }
}

/// One table of the file, with the name it has in messages.
#[derive(Clone)]
pub(crate) struct Section<'t> {
    pub(crate) name: String,
    pub(crate) span: Range<usize>,
    table: &'t DeTable<'t>,
}

/// A number of the file: in SI, as written, and where.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// In SI.
    pub(crate) si: f64,
    /// In the laboratory's unit.
    pub(crate) laboratory: f64,
    /// The number as written, whatever its unit.
    pub(crate) number: f64,
    /// The text as written.
    pub(crate) written: String,
    pub(crate) span: Range<usize>,
}

/// A column of a table file, or a number that holds for all of its rows.
#[derive(Clone, Debug)]
pub(crate) enum ColumnOrLength {
    Column(Column),
    /// In metres.
    Length(f64),
}

impl<'t> Section<'t> {
    pub(crate) fn new(name: &str, span: Range<usize>, table: &'t DeTable<'t>) -> Self {
        Self {
            name: name.to_owned(),
            span,
            table,
        }
    }

    /// Reports every key that is not in the list.
    pub(crate) fn allow(&self, keys: &[&str], findings: &mut Findings<'_>) {
        let mut unknown: Vec<_> = self
            .table
            .keys()
            .filter(|key| !keys.contains(&key.get_ref().as_ref()))
            .collect();
        unknown.sort_by_key(|key| key.span().start);
        for key in unknown {
            let written = key.get_ref().as_ref();
            let hint = spelling::closest(written, keys.iter().copied())
                .map(|close| format!("did you mean \"{close}\"? "))
                .unwrap_or_default();
            findings.error(
                &key.span(),
                format!("{} has no key \"{written}\"", self.name),
                format!("{hint}keys here: {}", keys.join(", ")),
            );
        }
    }

    fn get(&self, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        self.table.get(key)
    }

    fn missing(&self, key: &str, example: &str, findings: &mut Findings<'_>) {
        findings.error(
            &self.span,
            format!("{} has no \"{key}\"", self.name),
            format!("add a line such as {key} = {example}"),
        );
    }

    fn wrong_kind(&self, key: &str, wanted: &str, findings: &mut Findings<'_>) {
        if let Some(value) = self.get(key) {
            let written = findings.text[value.span()].to_owned();
            findings.error(
                &value.span(),
                format!("{} is {written} where {wanted} is needed", self.field(key)),
                format!("write {wanted}"),
            );
        }
    }

    /// A key with the name of its table, for messages.
    pub(crate) fn field(&self, key: &str) -> String {
        format!("{}: {key}", self.name)
    }

    pub(crate) fn text(
        &self,
        key: &str,
        findings: &mut Findings<'_>,
    ) -> Option<(String, Range<usize>)> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::String(text) => Some((text.to_string(), value.span())),
            _ => {
                self.wrong_kind(key, "text in quotes", findings);
                None
            }
        }
    }

    pub(crate) fn required_text(
        &self,
        key: &str,
        example: &str,
        findings: &mut Findings<'_>,
    ) -> Option<(String, Range<usize>)> {
        if self.get(key).is_none() {
            self.missing(key, example, findings);
        }
        self.text(key, findings)
    }

    pub(crate) fn flag(&self, key: &str, findings: &mut Findings<'_>) -> bool {
        match self.get(key).map(Spanned::get_ref) {
            None => false,
            Some(DeValue::Boolean(flag)) => *flag,
            Some(_) => {
                self.wrong_kind(key, "true or false", findings);
                false
            }
        }
    }

    /// A number, bare in the laboratory's unit or a string with its unit; it must be finite.
    pub(crate) fn measured(
        &self,
        key: &str,
        quantity: Quantity,
        findings: &mut Findings<'_>,
    ) -> Option<Measured> {
        let value = self.get(key)?;
        let span = value.span();
        let written = findings.text[span.clone()]
            .trim_matches(['"', '\''])
            .to_owned();
        let parsed = match value.get_ref() {
            DeValue::String(text) => unit::parse_quantity(text, quantity),
            DeValue::Integer(_) | DeValue::Float(_) => match bare_number(value.get_ref()) {
                Some(number) => Ok((number, quantity.laboratory())),
                None => return self.not_finite(key, &written, &span, findings),
            },
            _ => {
                self.wrong_kind(
                    key,
                    "a number, or text with a number and its unit",
                    findings,
                );
                return None;
            }
        };
        match parsed {
            Ok((number, _)) if !number.is_finite() => {
                self.not_finite(key, &written, &span, findings)
            }
            Ok((number, unit)) => {
                let own = quantity.laboratory();
                let same = unit == own;
                let si = number * unit.factor;
                let laboratory = if same { number } else { si / own.factor };
                Some(Measured {
                    si,
                    laboratory,
                    number,
                    written,
                    span,
                })
            }
            Err(error) => {
                let message = format!("{}: {}", self.field(key), error.message);
                findings.error(&span, message, error.help);
                None
            }
        }
    }

    fn not_finite<T>(
        &self,
        key: &str,
        written: &str,
        span: &Range<usize>,
        findings: &mut Findings<'_>,
    ) -> Option<T> {
        findings.error(
            span,
            format!(
                "{} is {written}, which is not a finite number",
                self.field(key)
            ),
            "write the measured value, or remove the line if it was not measured",
        );
        None
    }

    /// A table inside this one.
    pub(crate) fn section(
        &self,
        key: &str,
        name: &str,
        findings: &mut Findings<'_>,
    ) -> Option<Section<'t>> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::Table(table) => Some(Section::new(name, value.span(), table)),
            _ => {
                self.wrong_kind(key, "a table", findings);
                None
            }
        }
    }

    pub(crate) fn required_section(
        &self,
        key: &str,
        example: &str,
        findings: &mut Findings<'_>,
    ) -> Option<Section<'t>> {
        if self.get(key).is_none() {
            self.missing(key, example, findings);
        }
        let name = format!("{}: {key}", self.name);
        self.section(key, &name, findings)
    }

    /// The tables of an array of tables.
    pub(crate) fn sections(&self, key: &str, findings: &mut Findings<'_>) -> Vec<Section<'t>> {
        let Some(value) = self.get(key) else {
            return Vec::new();
        };
        let DeValue::Array(array) = value.get_ref() else {
            let wanted = format!("one or more [[{key}]] tables");
            self.wrong_kind(key, &wanted, findings);
            return Vec::new();
        };
        let mut sections = Vec::new();
        for (index, item) in array.iter().enumerate() {
            if let DeValue::Table(table) = item.get_ref() {
                let name = format!("{key} {}", index + 1);
                sections.push(Section::new(&name, item.span(), table));
            } else {
                self.wrong_kind(key, "a list of tables", findings);
            }
        }
        sections
    }

    /// A column, by its name or by its place from 1.
    pub(crate) fn column(
        &self,
        key: &str,
        findings: &mut Findings<'_>,
    ) -> Option<(Column, Range<usize>)> {
        let Some(value) = self.get(key) else {
            self.missing(key, "\"name in the header\"", findings);
            return None;
        };
        let column = match value.get_ref() {
            DeValue::String(name) => Some(Column::Name(name.to_string())),
            DeValue::Integer(place) => place.as_str().parse().ok().map(Column::Place),
            _ => None,
        };
        if column.is_none() {
            self.wrong_kind(key, "a column name, or its place from 1", findings);
        }
        Some((column?, value.span()))
    }

    /// A length with its unit (a bare number is in metres), or the column that holds it in metres.
    pub(crate) fn column_or_length(
        &self,
        key: &str,
        findings: &mut Findings<'_>,
    ) -> Option<ColumnOrLength> {
        let value = self.get(key)?;
        let length = match value.get_ref() {
            DeValue::String(text) if starts_with_number(text) => {
                self.measured(key, Quantity::Length, findings)?.si
            }
            DeValue::String(name) => {
                return Some(ColumnOrLength::Column(Column::Name(name.to_string())));
            }
            DeValue::Integer(_) | DeValue::Float(_) => bare_number(value.get_ref())?,
            _ => {
                self.wrong_kind(key, "a column name, or text such as \"5 cm\"", findings);
                return None;
            }
        };
        if length > 0.0 && length.is_finite() {
            return Some(ColumnOrLength::Length(length));
        }
        let written = findings.text[value.span()].to_owned();
        findings.error(
            &value.span(),
            format!("{} is {written}; a length is positive", self.field(key)),
            "write the length with its unit, such as \"5 cm\"",
        );
        None
    }
}

fn starts_with_number(text: &str) -> bool {
    text.trim_start()
        .starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
}

fn bare_number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}

/// The error of a file that is not TOML at all.
pub(crate) fn syntax_error(
    path: &std::path::Path,
    text: &str,
    error: &toml::de::Error,
) -> Diagnostic {
    let finding = Diagnostic::new(path, format!("not valid TOML: {}", error.message()))
        .with_help("text goes in quotes, numbers do not");
    match error.span() {
        Some(span) => finding.at_offset(text, span.start),
        None => finding,
    }
}
