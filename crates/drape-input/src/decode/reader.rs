//! Reader: passes the values of a text to `serde`, and continues after wrong values.

use std::cell::{Cell, RefCell};

use serde::de::value::{SeqDeserializer, StrDeserializer, UnitDeserializer};
use serde::de::{DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::forward_to_deserialize_any;

use crate::decode::form::{self, Refusal};
use crate::diagnostic::value_error::ValueError;
use crate::figure::excerpt;
use crate::given::{self, Token};
use crate::node::{Entry, Node, Value};
use crate::quoting::{toml_key, toml_string};
use crate::spelling::{closest, unknown_word};
use crate::unit::{NumberWithUnit, parse_quantity};

use super::stand_in::{ExpectedKind, StandIn};
use super::state::{Change, Fault, ReadingState};
use super::stop::Stop;

/// Path of a value: the keys and indices that lead to the value.
pub(super) struct ValuePath<'a> {
    outer: Option<&'a ValuePath<'a>>,
    /// Last step of the path.
    step: PathStep<'a>,
}

/// Step from a value to a value in it.
#[derive(Clone, Copy)]
enum PathStep<'a> {
    /// No step: the value is the whole text.
    Root,
    /// Key, and the [`address`] of its value.
    Key(&'a str, usize),
    Index(usize),
}

impl ValuePath<'_> {
    /// Returns the path of the whole text.
    pub(super) fn root() -> Self {
        Self { outer: None, step: PathStep::Root }
    }

    /// Returns the path as messages write it, such as `panel[1].disc`.
    fn text(&self) -> String {
        let mut text = self.outer.map_or(String::new(), ValuePath::text);
        match self.step {
            PathStep::Root => {}
            PathStep::Key(key, _) => {
                if !text.is_empty() {
                    text.push('.');
                }
                text.push_str(&toml_key(&excerpt(key)));
            }
            PathStep::Index(index) => text.push_str(&format!("[{index}]")),
        }
        text
    }

    /// Returns the innermost path that ends with a key, and the address of its value.
    fn keyed(&self) -> Option<(&Self, usize)> {
        match self.step {
            PathStep::Key(_, address) => Some((self, address)),
            _ => self.outer?.keyed(),
        }
    }

    /// Returns the text of the path of `key` in the value.
    fn key_text(&self, key: &str) -> String {
        let text = self.text();
        let key = toml_key(&excerpt(key));
        if text.is_empty() { key } else { format!("{text}.{key}") }
    }
}

/// Returns the address of `node`, which identifies the value.
fn address(node: &Node) -> usize {
    std::ptr::from_ref(node) as usize
}

/// Deserialiser of a value of the text.
pub(super) struct Reader<'a> {
    pub(super) node: &'a Node,
    pub(super) path: &'a ValuePath<'a>,
    pub(super) state: &'a RefCell<ReadingState>,
}

/// Returns whether `word` means that a switch is on or off, or `None` if it means neither.
fn switch(word: &str) -> Option<bool> {
    match word.trim().to_ascii_lowercase().as_str() {
        "true" | "yes" | "on" => Some(true),
        "false" | "no" | "off" => Some(false),
        _ => None,
    }
}

impl<'a> Reader<'a> {
    /// Records the mistake that the value does not have the expected `kind`.
    fn fault_of_kind(&self, kind: ExpectedKind) {
        let wanted = kind.words();
        let short = match kind {
            ExpectedKind::Forms(_) => &wanted,
            _ => wanted.split_once(" such as").map_or(wanted.as_str(), |(short, _)| short),
        };
        let message = format!("is {} where {short} is needed", self.node.kind());
        let help = match (&self.node.value, self.path.step) {
            (Value::Table(_), PathStep::Key(key, _)) if kind == ExpectedKind::List(None) => {
                format!("write [[{}]], with two brackets: there may be several", toml_key(key))
            }
            _ => format!("write {wanted}"),
        };
        let intended_value = match &self.node.value {
            Value::Text(text) if kind == ExpectedKind::Flag => {
                switch(text).map(|on| on.to_string())
            }
            _ => None,
        };
        self.correctable_fault(message, help, intended_value);
    }

    /// Records a mistake in the value, with its `message` and the remedy `help`.
    fn fault(&self, message: String, help: String) {
        self.correctable_fault(message, help, None);
    }

    /// Records a mistake in the value, with its `message` and the remedy `help`. `intended_value`
    /// is the TOML text of the right value, if it is known.
    fn correctable_fault(&self, message: String, help: String, intended_value: Option<String>) {
        let mut state = self.state.borrow_mut();
        if let Some((path, address)) = self.path.keyed() {
            state.wrong.insert(address);
            state.keys.insert(path.text());
        }
        if state.is_last {
            return;
        }

        let key = self.path.text();
        let span = Some(self.node.span.clone());
        let change = intended_value.map(Change::Value);
        state.faults.push(Fault { span, key, message, help, change });
    }

    /// Records the mistake that `word` is none of `choices`.
    fn fault_of_choice(&self, word: &str, choices: &[&str]) {
        let ValueError { message, help, intended_value } = unknown_word(word, choices);
        self.correctable_fault(message, help, intended_value.as_deref().map(toml_string));
    }

    /// Records that the value does not have the expected `kind`, and calls `visit` with a stand-in.
    fn stand_in<V>(&self, kind: ExpectedKind, visit: impl FnOnce(StandIn<'_>) -> V) -> V {
        self.fault_of_kind(kind);
        visit(StandIn { expected: &Cell::new(kind) })
    }

    /// Reads a finite number.
    fn number<'de, V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        match self.node.value {
            Value::Integer(number) => visitor.visit_f64(number as f64),
            Value::Float(number) if number.is_finite() => visitor.visit_f64(number),
            Value::Float(number) => {
                self.fault_of_infinite(number);
                visitor.visit_f64(1.0)
            }
            _ => self.stand_in(ExpectedKind::Number, |stand_in| stand_in.deserialize_f64(visitor)),
        }
    }

    /// Records the mistake that `number` is infinite or NaN.
    fn fault_of_infinite(&self, number: f64) {
        let word = if number.is_nan() { "nan" } else { "inf" };
        self.fault(format!("{word} is not a finite number"), "write a finite number".into());
    }

    /// Returns the number, if the value is a finite number.
    fn bare_number(&self) -> Option<f64> {
        match self.node.value {
            Value::Integer(number) => Some(number as f64),
            Value::Float(number) => Some(number).filter(|number| number.is_finite()),
            _ => None,
        }
    }

    /// Returns the factor by which a bare number of the quantity of `token` is resolved.
    fn bare_factor(&self, token: &Token) -> f64 {
        if token.is_in_unit_of_file { self.state.borrow().length_unit } else { 1.0 }
    }

    /// Reads a whole number between `least` and `most`.
    fn whole<'de, V: Visitor<'de>>(
        self,
        least: i64,
        most: i64,
        visitor: V,
    ) -> Result<V::Value, Stop> {
        match self.node.value {
            Value::Integer(number) if (least..=most).contains(&number) => visitor.visit_i64(number),
            Value::Integer(number) => {
                let message = format!("{number} is not between {least} and {most}");
                self.fault(message, "write a whole number in this range".into());
                visitor.visit_i64(1)
            }
            Value::Float(number) => {
                let message = format!("{number} is not a whole number");
                self.fault(message, "write a whole number, without a point".into());
                visitor.visit_i64(1)
            }
            _ => self.stand_in(ExpectedKind::Whole, |stand_in| stand_in.deserialize_i64(visitor)),
        }
    }

    /// Reads a text.
    fn text<'de, V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        match &self.node.value {
            Value::Text(text) => visitor.visit_str(text),
            _ => self.stand_in(ExpectedKind::Text, |stand_in| stand_in.deserialize_str(visitor)),
        }
    }

    /// Reads the quantity of `token`: a bare number, or a text with a number and a unit.
    fn quantity<'de, V: Visitor<'de>>(self, token: &Token, visitor: V) -> Result<V::Value, Stop> {
        let Token { quantity, examples, resolved, .. } = *token;
        let text = match &self.node.value {
            Value::Integer(_) | Value::Float(_) => match (resolved, self.bare_number()) {
                (Some(_), Some(number)) => {
                    return visitor.visit_f64(number * self.bare_factor(token));
                }
                _ => return self.number(visitor),
            },
            Value::Text(text) => text,
            _ => {
                self.fault_of_kind(ExpectedKind::Quantity(quantity.name(), examples));
                return visitor.visit_f64(1.0);
            }
        };

        // A bare number in quotes would be taken in the laboratory's unit.
        let has_unit = text.trim().parse::<f64>().is_err();
        match parse_quantity(text, quantity) {
            Ok(NumberWithUnit { number, .. }) if !number.is_finite() => {
                self.fault_of_infinite(number);
                visitor.visit_f64(1.0)
            }
            Ok(NumberWithUnit { number, unit }) if has_unit && resolved.is_some() => {
                // An angle stays in degrees, so that a quarter turn is exact.
                let bare = resolved.unwrap_or(1.0);
                let is_bare = unit.factor == bare;
                visitor.visit_f64(if is_bare { number } else { number * unit.factor / bare })
            }
            Ok(NumberWithUnit { number, unit }) if has_unit => {
                visitor.visit_seq(SeqDeserializer::new([number, unit.factor].into_iter()))
            }
            Ok(_) => {
                let number = excerpt(text.trim());
                let message = format!("\"{number}\" has no unit");
                let help =
                    format!("write {number} without quotes, or a unit, as in \"{}\"", examples[1]);
                self.correctable_fault(message, help, Some(text.trim().to_owned()));
                visitor.visit_f64(1.0)
            }
            Err(error) => {
                let help = if error.message.contains("is not a unit") {
                    error.help
                } else {
                    format!("write {} or \"{}\"", examples[0], examples[1])
                };
                let intended_value = error.intended_value.map(|text| toml_string(&text));
                self.correctable_fault(error.message, help, intended_value);
                visitor.visit_f64(1.0)
            }
        }
    }
}

impl<'de> Deserializer<'de> for Reader<'_> {
    type Error = Stop;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        match &self.node.value {
            Value::Text(text) => visitor.visit_str(text),
            Value::Integer(number) => visitor.visit_i64(*number),
            Value::Float(number) => visitor.visit_f64(*number),
            Value::Flag(flag) => visitor.visit_bool(*flag),
            Value::Date(date) => visitor.visit_str(date),
            Value::List(_) => self.deserialize_seq(visitor),
            Value::Table(_) => self.deserialize_map(visitor),
        }
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.number(visitor)
    }

    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.number(visitor)
    }

    fn deserialize_u8<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.whole(0, u8::MAX.into(), visitor)
    }

    fn deserialize_u16<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.whole(0, u16::MAX.into(), visitor)
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.whole(0, u32::MAX.into(), visitor)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.whole(0, i64::MAX, visitor)
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.whole(i64::MIN, i64::MAX, visitor)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        match self.node.value {
            Value::Flag(flag) => visitor.visit_bool(flag),
            _ => self.stand_in(ExpectedKind::Flag, |stand_in| stand_in.deserialize_bool(visitor)),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.text(visitor)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.text(visitor)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.text(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        visitor.visit_some(self)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        visitor.visit_unit()
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        choices: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Stop> {
        if name == form::TOKEN {
            return visitor.visit_seq(Answer { reader: self, forms: choices, is_read: false });
        }
        let Value::Text(word) = &self.node.value else {
            return self.stand_in(ExpectedKind::Text, |stand_in| {
                stand_in.deserialize_enum(name, choices, visitor)
            });
        };
        let choice = choices.iter().find(|choice| *choice == word);
        if choice.is_none() {
            self.fault_of_choice(word, choices);
        }
        // A wrong word counts as the first choice.
        let choice: &str = choice.or(choices.first()).unwrap_or(&"");
        let choice: StrDeserializer<'_, Stop> = choice.into_deserializer();
        visitor.visit_enum(choice)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Stop> {
        match (given::token(name), &self.node.value) {
            (Some(token), _) => self.quantity(&token, visitor),
            (None, Value::Text(text)) if name == given::TEXT_OR => visitor.visit_str(text),
            _ => visitor.visit_newtype_struct(self),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        match &self.node.value {
            Value::List(nodes) => visitor.visit_seq(Elements { nodes, index: 0, reader: self }),
            _ => self
                .stand_in(ExpectedKind::List(None), |stand_in| stand_in.deserialize_seq(visitor)),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, count: usize, v: V) -> Result<V::Value, Stop> {
        match &self.node.value {
            Value::List(nodes) if nodes.len() == count => {
                v.visit_seq(Elements { nodes, index: 0, reader: self })
            }
            Value::List(nodes) => {
                let number = nodes.len();
                let message = format!("is a list of {number} where {count} values are needed");
                self.fault(message, format!("write {}", ExpectedKind::List(Some(count)).words()));
                StandIn { expected: &Cell::new(ExpectedKind::Anything) }.deserialize_tuple(count, v)
            }
            _ => self.stand_in(ExpectedKind::List(Some(count)), |stand_in| {
                stand_in.deserialize_tuple(count, v)
            }),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        match &self.node.value {
            Value::Table(entries) => {
                let entries = entries.iter().filter(|entry| !self.leaves_out(entry));
                let entries = entries.map(|entry| (entry.key.as_str(), Some(entry))).collect();
                visitor.visit_map(Entries { entries, next: 0, reader: self })
            }
            _ => self.stand_in(ExpectedKind::Table, |stand_in| stand_in.deserialize_map(visitor)),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Stop> {
        let Value::Table(entries) = &self.node.value else {
            return self.stand_in(ExpectedKind::Table, |stand_in| {
                stand_in.deserialize_struct(name, keys, visitor)
            });
        };
        let entries = self.struct_entries(name, keys, entries);
        match visitor.visit_map(Entries { entries, next: 0, reader: self }) {
            Err(Stop::Missing(key)) => Err(Stop::Needs { structure: name, key }),
            result => result,
        }
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i128 u128 char bytes byte_buf unit unit_struct tuple_struct
    }
}

impl<'a> Reader<'a> {
    /// Returns the entries of the structure `name`, which has the given `keys`.
    ///
    /// Unknown keys are recorded as mistakes. A misspelt key counts as the key that was probably
    /// meant. `None` stands for the entry of a needed key that is missing.
    fn struct_entries(
        &self,
        name: &'static str,
        keys: &'static [&'static str],
        entries: &'a [Entry],
    ) -> Vec<(&'a str, Option<&'a Entry>)> {
        let mut known: Vec<(&str, Option<&Entry>)> = Vec::with_capacity(entries.len());
        let mut unknown = Vec::new();
        for entry in entries {
            if keys.contains(&entry.key.as_str()) {
                known.push((&entry.key, Some(entry)));
            } else {
                unknown.push(entry);
            }
        }

        for entry in unknown {
            let near = closest(&entry.key, keys.iter().copied());
            let help = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None if keys.is_empty() => "remove it".into(),
                None => format!("known here: {}", keys.join(", ")),
            };

            let mut state = self.state.borrow_mut();
            if !state.is_last {
                let key = self.path.key_text(&entry.key);
                let message = "there is no such key".to_owned();
                let span = Some(entry.span.clone());
                let free = near.filter(|near| self.node.entry(near).is_none());
                let change = free.map(|near| Change::Renamed(self.path.key_text(near)));
                state.faults.push(Fault { span, key, message, help, change });
            }
            if let Some(near) = near.filter(|near| known.iter().all(|(key, _)| key != near)) {
                known.push((near, Some(entry)));
            }
        }

        // Keys without a value follow last, so that the structure receives a stand-in for each.
        known.retain(|(_, entry)| entry.is_none_or(|entry| !self.leaves_out(entry)));
        let state = self.state.borrow();
        for &key in keys {
            let is_missing = known.iter().all(|(present, _)| *present != key);
            if state.needed.contains(&(name, key)) && is_missing {
                known.push((key, None));
            }
        }
        known
    }

    /// Returns whether this is the last reading and leaves `entry` out because its value is wrong.
    fn leaves_out(&self, entry: &Entry) -> bool {
        let state = self.state.borrow();
        state.is_last && state.wrong.contains(&address(&entry.node))
    }

    /// Passes a stand-in for the missing `key` to `seed`, and records the mistake.
    fn read_missing<'de, T: DeserializeSeed<'de>>(
        &self,
        key: &str,
        seed: T,
    ) -> Result<T::Value, Stop> {
        let expected = Cell::new(ExpectedKind::Anything);
        let value = seed.deserialize(StandIn { expected: &expected })?;
        let path = self.path.key_text(key);
        let mut state = self.state.borrow_mut();
        if !state.is_last {
            let span = (!matches!(self.path.step, PathStep::Root)).then(|| self.node.span.clone());
            let help = format!("add {key} = …, {}", expected.get().words());
            let message = "is missing".to_owned();
            state.faults.push(Fault { span, key: path.clone(), message, help, ..Fault::default() });
        }
        state.keys.insert(path);
        Ok(value)
    }
}

/// Value that is passed to a [`FromLiteral`](form::FromLiteral), and the refusal of the form, if there is one.
struct Answer<'a> {
    reader: Reader<'a>,
    /// Forms in which the value may be written.
    forms: &'static [&'static str],
    /// Whether the form has the value.
    is_read: bool,
}

impl<'de> SeqAccess<'de> for Answer<'_> {
    type Error = Stop;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Stop> {
        let Reader { node, path, state } = self.reader;
        if !self.is_read {
            self.is_read = true;
            return seed.deserialize(Reader { node, path, state }).map(Some);
        }

        // A form that asks for a second element refuses the value, and its reason is an error.
        let nothing: UnitDeserializer<Stop> = ().into_deserializer();
        let reason = seed.deserialize(nothing).err().map(|stop| stop.to_string());
        match reason.as_deref().and_then(Refusal::from_text) {
            Some(Refusal::Reason(ValueError { message, help, intended_value })) => {
                let intended_value = intended_value.map(|text| toml_string(&text));
                self.reader.correctable_fault(message, help, intended_value);
            }
            _ => self.reader.fault_of_kind(ExpectedKind::Forms(self.forms)),
        }
        Ok(None)
    }
}

/// Elements of a list.
struct Elements<'a> {
    nodes: &'a [Node],
    index: usize,
    reader: Reader<'a>,
}

impl<'de> SeqAccess<'de> for Elements<'_> {
    type Error = Stop;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Stop> {
        let Some(node) = self.nodes.get(self.index) else { return Ok(None) };
        let path = ValuePath { outer: Some(self.reader.path), step: PathStep::Index(self.index) };
        self.index += 1;
        seed.deserialize(Reader { node, path: &path, state: self.reader.state }).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.nodes.len() - self.index)
    }
}

/// Entries of a table, each with the key that was meant.
struct Entries<'a> {
    entries: Vec<(&'a str, Option<&'a Entry>)>,
    /// Index of the entry whose key comes next.
    next: usize,
    reader: Reader<'a>,
}

impl<'de> MapAccess<'de> for Entries<'_> {
    type Error = Stop;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Stop> {
        let Some((key, _)) = self.entries.get(self.next) else { return Ok(None) };
        self.next += 1;
        let key: StrDeserializer<'_, Stop> = (*key).into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Stop> {
        let (key, entry) = self.entries[self.next - 1];
        let Some(entry) = entry else { return self.reader.read_missing(key, seed) };
        let step = PathStep::Key(key, address(&entry.node));
        let path = ValuePath { outer: Some(self.reader.path), step };
        let state = self.reader.state;
        seed.deserialize(Reader { node: &entry.node, path: &path, state })
    }
}
