//! Values of a TOML text with their places: what `document` searches and `decode` reads.

pub(crate) mod key_path;

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::quoting::toml_key;

/// Value with its place in the text.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    /// Bytes that a message points to: a table's name or header, any other value itself.
    pub(crate) span: Range<usize>,
    /// Bytes of the value itself; none of a table with a heading, or of a value that was set.
    pub(crate) text: Option<Range<usize>>,
    pub(crate) value: Value,
}

#[derive(Debug, Clone)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Flag(bool),
    Date,
    List(Vec<Node>),
    /// Entries in the order of their keys.
    Table(Vec<Entry>),
}

/// Key of a table with its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) span: Range<usize>,
    pub(crate) node: Node,
}

impl Node {
    /// Returns the content of a text.
    pub(crate) fn root(table: &DeTable<'_>) -> Self {
        Self { span: 0..0, text: None, value: Value::Table(entries(table)) }
    }

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
            DeValue::Datetime(_) => Value::Date,
            DeValue::Array(list) => Value::List(list.iter().map(Self::new).collect()),
            DeValue::Table(table) => Value::Table(entries(table)),
        };
        Self { text: Some(span.clone()), span, value }
    }

    /// Returns the entry of a key, if this is a table that has it.
    pub(crate) fn entry(&self, key: &str) -> Option<&Entry> {
        let Value::Table(entries) = &self.value else { return None };
        let index = entries.binary_search_by(|entry| entry.key.as_str().cmp(key)).ok()?;
        entries.get(index)
    }

    /// Returns the text, if it is one.
    pub(crate) fn as_text(&self) -> Option<String> {
        match &self.value {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    /// Gives the value, and all in it, one place.
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

    /// Returns the place of the first element of a list, or of a list in it, that is behind a text.
    pub(crate) fn first_element_behind(&self, text: usize) -> Option<usize> {
        let Value::List(elements) = &self.value else { return None };
        elements.iter().find_map(|element| match element.span.start > text {
            true => Some(element.span.start),
            false => element.first_element_behind(text),
        })
    }

    /// Returns all texts in the value.
    pub(crate) fn texts(&self) -> Vec<&str> {
        match &self.value {
            Value::Text(text) => vec![text],
            Value::List(elements) => elements.iter().flat_map(Self::texts).collect(),
            Value::Table(entries) => entries.iter().flat_map(|entry| entry.node.texts()).collect(),
            _ => Vec::new(),
        }
    }

    /// Returns the values of a table and of the tables in it, each with its key path behind the
    /// table's, and its bytes; `None` if some do not stand in one piece.
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

    /// Returns the kind of the value, in words.
    pub(crate) fn kind(&self) -> &'static str {
        match &self.value {
            Value::Text(_) => "text",
            Value::Integer(_) | Value::Float(_) => "a number",
            Value::Flag(_) => "true or false",
            Value::Date => "a date",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }
}

/// Returns the entries of a table.
fn entries(table: &DeTable<'_>) -> Vec<Entry> {
    let entry = |(key, value): (&Spanned<_>, &Spanned<DeValue<'_>>)| {
        let key: &Spanned<std::borrow::Cow<'_, str>> = key;
        let mut node = Node::new(value);
        // A table with a heading has the place of the heading.
        if value.span().start < key.span().end {
            node.text = None;
            if let Value::List(tables) = &mut node.value {
                tables.iter_mut().for_each(|table| table.text = None);
            }
        }
        if matches!(node.value, Value::Table(_)) {
            node.span = key.span();
        }
        Entry { key: key.get_ref().to_string(), span: key.span(), node }
    };
    let mut entries: Vec<Entry> = table.iter().map(entry).collect();
    entries.sort_by(|a, b| a.key.cmp(&b.key));
    entries
}
