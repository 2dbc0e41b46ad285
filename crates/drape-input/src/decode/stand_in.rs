//! Stand-ins for values that are missing or wrong. A stand-in has the kind that a structure
//! expects.

use std::cell::Cell;

use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::forward_to_deserialize_any;

use crate::decode::form;
use crate::given;
use crate::spelling::one_of_words;

use super::stop::Stop;

/// Kind of value that a structure expects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ExpectedKind {
    Text,
    Number,
    /// Whole number.
    Whole,
    Flag,
    /// List, with its number of values if the number is fixed.
    List(Option<usize>),
    Table,
    /// Quantity, with the name of the quantity and two examples.
    Quantity(&'static str, [&'static str; 2]),
    /// Word among these.
    Choice(&'static [&'static str]),
    /// One of several forms, in words.
    Forms(&'static [&'static str]),
    /// Any kind.
    Anything,
}

impl ExpectedKind {
    /// Returns the kind in words, such as `a number`.
    pub(super) fn words(self) -> String {
        match self {
            Self::Text => "text in quotes".into(),
            Self::Number => "a number".into(),
            Self::Whole => "a whole number, 0 or more".into(),
            Self::Flag => "true or false".into(),
            Self::List(Some(2)) => "a list such as [1, 2]".into(),
            Self::List(Some(3)) => "a list such as [0, 1, 0]".into(),
            Self::List(Some(count)) => format!("a list of {count} values"),
            Self::List(None) => "a list".into(),
            Self::Table => "a table".into(),
            Self::Quantity(name, [bare, unit]) => {
                let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
                format!("{article} {name} such as {bare} or \"{unit}\"")
            }
            Self::Choice(words) => one_of_words(words),
            Self::Forms(forms) => form::listed(forms),
            Self::Anything => "a value".into(),
        }
    }
}

/// Deserialiser that provides a stand-in and records the kind that the structure expects.
#[derive(Clone, Copy)]
pub(super) struct StandIn<'a> {
    /// Kind that the structure expects.
    pub(super) expected: &'a Cell<ExpectedKind>,
}

impl StandIn<'_> {
    /// Records that the structure expects `kind`.
    fn note(self, kind: ExpectedKind) {
        self.expected.set(kind);
    }
}

/// Implements functions that record the kind `$kind` and visit the value `$value`.
macro_rules! stand_in {
    ($($function:ident $kind:expr, $visit:ident $value:expr;)*) => {
        $(
            fn $function<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
                self.note($kind);
                visitor.$visit($value)
            }
        )*
    };
}

impl<'de> Deserializer<'de> for StandIn<'_> {
    type Error = Stop;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.note(ExpectedKind::Anything);
        visitor.visit_unit()
    }

    stand_in! {
        deserialize_f64 ExpectedKind::Number, visit_f64 1.0;
        deserialize_u64 ExpectedKind::Whole, visit_u64 1;
        deserialize_i64 ExpectedKind::Whole, visit_i64 1;
        deserialize_bool ExpectedKind::Flag, visit_bool false;
        deserialize_str ExpectedKind::Text, visit_str "";
        deserialize_string ExpectedKind::Text, visit_str "";
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        visitor.visit_none()
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.note(ExpectedKind::List(None));
        visitor.visit_seq(StandInElements { count: 0, expected: self.expected })
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, count: usize, v: V) -> Result<V::Value, Stop> {
        let inner = Cell::new(ExpectedKind::Anything);
        self.note(ExpectedKind::List(Some(count)));
        v.visit_seq(StandInElements { count, expected: &inner })
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.note(ExpectedKind::Table);
        visitor.visit_map(StandInFields { keys: &[], expected: self.expected })
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Stop> {
        let inner = Cell::new(ExpectedKind::Anything);
        self.note(ExpectedKind::Table);
        visitor.visit_map(StandInFields { keys, expected: &inner })
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        choices: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Stop> {
        if name == form::TOKEN {
            self.note(ExpectedKind::Forms(choices));
            return visitor.visit_unit();
        }
        self.note(ExpectedKind::Choice(choices));
        let choice: StrDeserializer<'_, Stop> =
            choices.first().copied().unwrap_or_default().into_deserializer();
        visitor.visit_enum(choice)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Stop> {
        if let Some(token) = given::token(name) {
            self.note(ExpectedKind::Quantity(token.quantity.name(), token.examples));
            return visitor.visit_f64(1.0);
        }
        if name == given::TEXT_OR {
            self.note(ExpectedKind::Text);
            return visitor.visit_str("");
        }
        visitor.visit_newtype_struct(self)
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i128 u8 u16 u32 u128 f32 char bytes byte_buf unit unit_struct tuple_struct
        identifier ignored_any
    }
}

/// Stand-ins for the elements of a list.
struct StandInElements<'a> {
    /// Number of elements that remain.
    count: usize,
    expected: &'a Cell<ExpectedKind>,
}

impl<'de> SeqAccess<'de> for StandInElements<'_> {
    type Error = Stop;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Stop> {
        let Some(remaining) = self.count.checked_sub(1) else { return Ok(None) };
        self.count = remaining;
        seed.deserialize(StandIn { expected: self.expected }).map(Some)
    }
}

/// Stand-ins for the values of a structure.
struct StandInFields<'a> {
    /// Keys that remain.
    keys: &'static [&'static str],
    expected: &'a Cell<ExpectedKind>,
}

impl<'de> MapAccess<'de> for StandInFields<'_> {
    type Error = Stop;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Stop> {
        let Some((first, remaining)) = self.keys.split_first() else { return Ok(None) };
        self.keys = remaining;
        let key: StrDeserializer<'_, Stop> = (*first).into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Stop> {
        seed.deserialize(StandIn { expected: self.expected })
    }
}
