//! Values of a TOML text with their places. `document` searches these values, and `decode` reads
//! them.

pub(crate) mod key_path;

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::quoting::toml_key;

/// Value with its place in the text.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    /// Bytes of the text that a message points to: the name or heading of a table, or any other
    /// value itself.
    pub(crate) span: Range<usize>,
    /// Bytes of the value itself. `None` for a table with a heading, and for a value that was set.
    pub(crate) text: Option<Range<usize>>,
    pub(crate) value: Value,
}

/// Content of a TOML value.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Flag(bool),
    /// Date or time, as it is written.
    Date(String),
    List(Vec<Node>),
    /// Entries in the order of their keys.
    Table(Vec<Entry>),
}

/// Key of a table with its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) key: String,
    /// Key path that the text has for the value, if the text writes another one than `key`.
    pub(crate) written: Option<String>,
    pub(crate) span: Range<usize>,
    pub(crate) node: Node,
}

impl Entry {
    /// Returns the entry of `node` at `span`, whose `key` is the one in the text.
    pub(crate) fn new(key: String, span: Range<usize>, node: Node) -> Self {
        Self { key, written: None, span, node }
    }
}

impl Node {
    /// Returns the table that is the content of a whole text.
    pub(crate) fn root(table: &DeTable<'_>) -> Self {
        Self { span: 0..0, text: None, value: Value::Table(entries(table)) }
    }

    /// Returns the node of `table`, values without a text.
    pub(crate) fn of_table(table: &toml::Table) -> Self {
        let mut entries: Vec<Entry> = table
            .iter()
            .map(|(key, value)| Entry::new(key.clone(), 0..0, Self::of_value(value)))
            .collect();
        entries.sort_by(|a, b| a.key.cmp(&b.key));
        Self { span: 0..0, text: None, value: Value::Table(entries) }
    }

    /// Returns the node of `value`, which has no text.
    fn of_value(value: &toml::Value) -> Self {
        let value = match value {
            toml::Value::String(text) => Value::Text(text.clone()),
            toml::Value::Integer(number) => Value::Integer(*number),
            toml::Value::Float(number) => Value::Float(*number),
            toml::Value::Boolean(flag) => Value::Flag(*flag),
            toml::Value::Datetime(date) => Value::Date(date.to_string()),
            toml::Value::Array(list) => Value::List(list.iter().map(Self::of_value).collect()),
            toml::Value::Table(table) => return Self::of_table(table),
        };
        Self { span: 0..0, text: None, value }
    }

    /// Returns the node of `value`.
    fn new(value: &Spanned<DeValue<'_>>) -> Self {
        let span = value.span();
        let value = match value.get_ref() {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(number) => {
                match i64::from_str_radix(number.as_str(), number.radix()) {
                    Ok(integer) => Value::Integer(integer),
                    Err(_) => Value::Float(number.as_str().parse().unwrap_or(f64::INFINITY)),
                }
            }
            DeValue::Float(number) => Value::Float(number.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(list) => Value::List(list.iter().map(Self::new).collect()),
            DeValue::Table(table) => Value::Table(entries(table)),
        };
        Self { text: Some(span.clone()), span, value }
    }

    /// Returns the entry of `key`, if the value is a table that has this key.
    pub(crate) fn entry(&self, key: &str) -> Option<&Entry> {
        let Value::Table(entries) = &self.value else { return None };
        let index = entries.binary_search_by(|entry| entry.key.as_str().cmp(key)).ok()?;
        entries.get(index)
    }

    /// Returns the content, if the value is a text.
    pub(crate) fn as_text(&self) -> Option<String> {
        match &self.value {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    /// Sets the place of the value, and of all values in it, to the byte `place`.
    pub(crate) fn move_to(&mut self, place: usize) {
        self.span = place..place;
        self.text = None;
        match &mut self.value {
            Value::List(elements) => elements.iter_mut().for_each(|node| node.move_to(place)),
            Value::Table(entries) => entries.iter_mut().for_each(|entry| {
                entry.span = place..place;
                entry.node.move_to(place);
            }),
            _ => {}
        }
    }

    /// Returns the place of the first element of a list, or of a list in this list, that is behind
    /// a text of `text_length` bytes. Such an element was set.
    pub(crate) fn first_element_behind(&self, text_length: usize) -> Option<usize> {
        let Value::List(elements) = &self.value else { return None };
        elements.iter().find_map(|element| {
            let start = element.span.start;
            if start > text_length {
                Some(start)
            } else {
                element.first_element_behind(text_length)
            }
        })
    }

    /// Returns all texts in the value, in the order of their keys.
    pub(crate) fn texts(&self) -> Vec<&str> {
        match &self.value {
            Value::Text(text) => vec![text],
            Value::List(elements) => elements.iter().flat_map(Self::texts).collect(),
            Value::Table(entries) => entries.iter().flat_map(|entry| entry.node.texts()).collect(),
            _ => Vec::new(),
        }
    }

    /// Returns the values of a table and of the tables in it. Each value has its key path, relative
    /// to the table, and its bytes in the text. Returns `None` if the value is no table, or if one
    /// of the values has no bytes.
    pub(crate) fn values(&self) -> Option<Vec<(String, Range<usize>)>> {
        let Value::Table(entries) = &self.value else { return None };
        let mut values = Vec::new();
        for Entry { key, node, .. } in entries {
            let key = toml_key(key);
            match &node.text {
                Some(text) => values.push((format!(".{key}"), text.clone())),
                None => {
                    let inner = node.values()?.into_iter();
                    values.extend(inner.map(|(path, text)| (format!(".{key}{path}"), text)));
                }
            }
        }
        Some(values)
    }

    /// Returns the kind of the value in words, such as `a number`.
    pub(crate) fn kind(&self) -> &'static str {
        match &self.value {
            Value::Text(_) => "text",
            Value::Integer(_) | Value::Float(_) => "a number",
            Value::Flag(_) => "true or false",
            Value::Date(_) => "a date",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }
}

/// Returns the entries of `table` in the order of their keys.
fn entries(table: &DeTable<'_>) -> Vec<Entry> {
    let mut entries = Vec::with_capacity(table.len());
    for (key, value) in table.iter() {
        let mut node = Node::new(value);

        // A table with a heading begins before the end of its key, and is not in one piece.
        if value.span().start < key.span().end {
            node.text = None;
            if let Value::List(tables) = &mut node.value {
                tables.iter_mut().for_each(|table| table.text = None);
            }
        }
        if matches!(node.value, Value::Table(_)) {
            node.span = key.span();
        }
        entries.push(Entry::new(key.get_ref().to_string(), key.span(), node));
    }
    entries.sort_by(|a, b| a.key.cmp(&b.key));
    entries
}
