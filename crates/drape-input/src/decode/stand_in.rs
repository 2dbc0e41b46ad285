//! Stand-ins for values that are missing or wrong, of whatever kind is asked for.

use std::cell::Cell;

use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::forward_to_deserialize_any;

use crate::given;

use super::stop::Stop;

/// Kind of value that a structure asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Text,
    Number,
    Whole,
    Flag,
    /// List, of so many values if that is fixed.
    List(Option<usize>),
    Table,
    /// Quantity, with its name and examples.
    Quantity(&'static str, [&'static str; 2]),
    Anything,
}

impl Kind {
    /// Returns the kind in words.
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
            Self::Anything => "a value".into(),
        }
    }
}

/// Stand-in, which notes the kind of value that it was asked for.
#[derive(Clone, Copy)]
pub(super) struct StandIn<'a> {
    pub(super) asked: &'a Cell<Kind>,
}

impl StandIn<'_> {
    fn note(self, kind: Kind) {
        self.asked.set(kind);
    }
}

/// Implements functions that hand over one value.
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
        self.note(Kind::Anything);
        visitor.visit_unit()
    }

    stand_in! {
        deserialize_f64 Kind::Number, visit_f64 1.0;
        deserialize_u64 Kind::Whole, visit_u64 1;
        deserialize_i64 Kind::Whole, visit_i64 1;
        deserialize_bool Kind::Flag, visit_bool false;
        deserialize_str Kind::Text, visit_str "";
        deserialize_string Kind::Text, visit_str "";
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        visitor.visit_none()
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.note(Kind::List(None));
        visitor.visit_seq(Elements { count: 0, asked: self.asked })
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, count: usize, v: V) -> Result<V::Value, Stop> {
        let inner = Cell::new(Kind::Anything);
        self.note(Kind::List(Some(count)));
        v.visit_seq(Elements { count, asked: &inner })
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Stop> {
        self.note(Kind::Table);
        visitor.visit_map(Fields { keys: &[], asked: self.asked })
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Stop> {
        let inner = Cell::new(Kind::Anything);
        self.note(Kind::Table);
        visitor.visit_map(Fields { keys, asked: &inner })
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Stop> {
        if let Some((quantity, examples)) = given::of_token(name) {
            self.note(Kind::Quantity(quantity.name(), examples));
            return visitor.visit_f64(1.0);
        }
        if name == given::TEXT_OR {
            self.note(Kind::Text);
            return visitor.visit_str("");
        }
        visitor.visit_newtype_struct(self)
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i128 u8 u16 u32 u128 f32 char bytes byte_buf unit unit_struct tuple_struct enum
        identifier ignored_any
    }
}

/// Stand-ins for the elements of a list.
struct Elements<'a> {
    count: usize,
    asked: &'a Cell<Kind>,
}

impl<'de> SeqAccess<'de> for Elements<'_> {
    type Error = Stop;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Stop> {
        let Some(left) = self.count.checked_sub(1) else { return Ok(None) };
        self.count = left;
        seed.deserialize(StandIn { asked: self.asked }).map(Some)
    }
}

/// Stand-ins for the values of a structure.
struct Fields<'a> {
    keys: &'static [&'static str],
    asked: &'a Cell<Kind>,
}

impl<'de> MapAccess<'de> for Fields<'_> {
    type Error = Stop;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Stop> {
        let Some((first, rest)) = self.keys.split_first() else { return Ok(None) };
        self.keys = rest;
        let key: StrDeserializer<'_, Stop> = (*first).into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Stop> {
        seed.deserialize(StandIn { asked: self.asked })
    }
}
