//! Values that may be written in several forms, such as a name, a number or a list of both.
//!
//! A type with such a value implements [`FromLiteral`]. [`Document`](crate::Document) gives the
//! type the value as it is written, and reports the mistake that the type answers with.
//!
//! `serde` has no channel for such an answer. The reader of a document therefore passes a sequence:
//! its first element is the value, and the request for a second element is the refusal. The error
//! of the request carries the reason.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, de};

use crate::diagnostic::value_error::ValueError;

/// Token by which [`Document`](crate::Document) recognises [`FromLiteral`].
pub(crate) const TOKEN: &str = "$drape-input:FromLiteral";

/// Type of a value that may be written in several forms.
///
/// ```
/// use drape_input::{Document, FromLiteral, Literal, Refusal, deserialize_literal};
///
/// /// Column of a table, by its name or its number.
/// #[derive(Debug, PartialEq)]
/// enum Column { Name(String), Number(i64) }
///
/// impl FromLiteral for Column {
///     const FORMS: &'static [&'static str] = &["a name in quotes", "a number from 1"];
///
///     fn from_literal(value: &Literal) -> Result<Self, Refusal> {
///         match value {
///             Literal::Text(name) => Ok(Self::Name(name.clone())),
///             Literal::Integer(number) if *number > 0 => Ok(Self::Number(*number)),
///             _ => Err(Refusal::Form),
///         }
///     }
///
///     fn stand_in() -> Self {
///         Self::Number(1)
///     }
/// }
///
/// #[derive(Debug, serde::Deserialize)]
/// struct File { #[serde(deserialize_with = "deserialize_literal")] column: Column }
///
/// let read = |text| Document::new("a.toml", text).decode::<File>();
/// assert_eq!(read("column = 2")?.column, Column::Number(2));
/// let message = read("column = true").expect_err("it is neither").0[0].message.clone();
/// let forms = "a name in quotes, or a number from 1";
/// assert_eq!(message, format!("column: is true or false where {forms} is needed"));
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
pub trait FromLiteral: Sized {
    /// Forms in which the value may be written, in words.
    const FORMS: &'static [&'static str];

    /// Returns the value that is written as `value`.
    ///
    /// # Errors
    /// [`Refusal`] if `value` has none of the [`FORMS`](Self::FORMS), or a wrong content.
    fn from_literal(value: &Literal) -> Result<Self, Refusal>;

    /// Returns a value that takes the place of a refused or missing one while the rest of a text is
    /// read.
    fn stand_in() -> Self;
}

/// Value as it is written in a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Literal {
    /// Text, or a date without quotes.
    Text(String),
    /// Whole number.
    Integer(i64),
    /// Number with a point or an exponent, or a whole number of too many digits.
    Float(f64),
    /// `true` or `false`.
    Flag(bool),
    /// List.
    List(Vec<Literal>),
    /// Table, without its content.
    Table,
}

impl Literal {
    /// Returns the number, if the value is one. The number may be infinite or NaN.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(number) => Some(*number as f64),
            Self::Float(number) => Some(*number),
            _ => None,
        }
    }
}

/// Reason why a [`FromLiteral`] refuses a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Refusal {
    /// The value has none of the forms of the type.
    Form,
    /// The value has a form of the type and a wrong content.
    Reason(ValueError),
}

impl From<ValueError> for Refusal {
    fn from(error: ValueError) -> Self {
        Self::Reason(error)
    }
}

/// Sign between the parts of a refusal that is passed as a text. TOML does not allow the sign in a
/// text.
const BETWEEN: char = '\0';

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Reason(ValueError { message, help, intended_value }) = self else {
            return Ok(());
        };
        write!(f, "{message}{BETWEEN}{help}")?;
        intended_value.as_ref().map_or(Ok(()), |text| write!(f, "{BETWEEN}{text}"))
    }
}

impl Refusal {
    /// Returns the refusal that [`Display`](fmt::Display) wrote as `text`.
    pub(crate) fn from_text(text: &str) -> Option<Self> {
        if text.is_empty() {
            return Some(Self::Form);
        }
        let mut parts = text.splitn(3, BETWEEN).map(str::to_owned);
        let (message, help) = (parts.next()?, parts.next()?);
        Some(Self::Reason(ValueError { message, help, intended_value: parts.next() }))
    }
}

/// Returns `forms` in one phrase, such as `a, b, or c`.
pub(crate) fn listed(forms: &[&str]) -> String {
    match forms {
        [] => String::new(),
        [form] => (*form).to_owned(),
        [forms @ .., last] => format!("{}, or {last}", forms.join(", ")),
    }
}

/// Reads a value of type `T`, for `#[serde(deserialize_with = "…")]` and for implementations of
/// [`Deserialize`].
///
/// # Errors
/// Errors of the `deserializer`. A [`Document`](crate::Document) reports a value that `T` refuses,
/// and continues with [`FromLiteral::stand_in`].
pub fn deserialize_literal<'de, T, D>(deserializer: D) -> Result<T, D::Error>
where
    T: FromLiteral,
    D: Deserializer<'de>,
{
    deserializer.deserialize_enum(TOKEN, T::FORMS, FormVisitor(PhantomData))
}

/// Visitor of a value and of the refusal of the value.
struct FormVisitor<T>(PhantomData<T>);

impl<'de, T: FromLiteral> Visitor<'de> for FormVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&listed(T::FORMS))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut answer: A) -> Result<T, A::Error> {
        let value = answer.next_element()?.ok_or_else(|| A::Error::custom("no value"))?;
        T::from_literal(&value).or_else(|refusal| {
            answer.next_element_seed(RefusalSeed(refusal))?;
            Ok(T::stand_in())
        })
    }

    fn visit_unit<E>(self) -> Result<T, E> {
        Ok(T::stand_in())
    }
}

/// Seed whose error is a refusal.
struct RefusalSeed(Refusal);

impl<'de> DeserializeSeed<'de> for RefusalSeed {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, _: D) -> Result<(), D::Error> {
        Err(D::Error::custom(self.0))
    }
}

impl<'de> Deserialize<'de> for Literal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LiteralVisitor)
    }
}

/// Visitor of a value as it is written.
struct LiteralVisitor;

impl<'de> Visitor<'de> for LiteralVisitor {
    type Value = Literal;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_str<E>(self, text: &str) -> Result<Literal, E> {
        Ok(Literal::Text(text.to_owned()))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Literal, E> {
        Ok(Literal::Integer(number))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Literal, E> {
        Ok(Literal::Float(number))
    }

    fn visit_bool<E>(self, flag: bool) -> Result<Literal, E> {
        Ok(Literal::Flag(flag))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Literal, A::Error> {
        let mut list = Vec::new();
        while let Some(element) = elements.next_element()? {
            list.push(element);
        }
        Ok(Literal::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Literal, A::Error> {
        while entries.next_entry::<de::IgnoredAny, de::IgnoredAny>()?.is_some() {}
        Ok(Literal::Table)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Document;

    /// Part of a whole in percent, or `"none"`.
    #[derive(Debug, PartialEq)]
    struct Share(f64);

    impl FromLiteral for Share {
        const FORMS: &'static [&'static str] = &["a number", "\"none\"", "a list of numbers"];

        fn from_literal(value: &Literal) -> Result<Self, Refusal> {
            match value {
                Literal::Text(word) if word == "none" => Ok(Self(0.0)),
                Literal::Text(word) => Err(crate::unknown_word(word, &["none"]).into()),
                Literal::List(items) => items
                    .iter()
                    .map(|item| item.number().ok_or(Refusal::Form))
                    .sum::<Result<_, _>>()
                    .map(Self),
                value => value.number().map(Self).ok_or(Refusal::Form),
            }
        }

        fn stand_in() -> Self {
            Self(1.0)
        }
    }

    impl<'de> Deserialize<'de> for Share {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserialize_literal(deserializer)
        }
    }

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        first: Share,
        second: Option<Share>,
        #[serde(default)]
        others: Vec<Share>,
    }

    #[test]
    fn every_form_is_read() {
        let text = "first = 1\nothers = [0.5, \"none\", [1, 2]]\n";
        let file: File = Document::new("a.toml", text).decode().expect("the text is right");
        let others = [0.5, 0.0, 3.0].map(Share).into();
        assert_eq!(file, File { first: Share(1.0), second: None, others });
    }

    #[test]
    fn refused_and_missing_values_are_reported_with_all_other_mistakes() {
        let text = "second = \"nome\"\nothers = [true, 2, { a = 1 }]\nthird = 1\n";
        let mistakes = Document::new("a.toml", text).decode::<File>().expect_err("it is wrong").0;
        let messages: Vec<String> = mistakes.iter().map(ToString::to_string).collect();
        let forms = "a number, \"none\", or a list of numbers";
        let expected = [
            format!("a.toml: first: is missing\n  help: add first = …, {forms}"),
            "a.toml:1:10: second: there is no \"nome\"\n  help: did you mean \"none\"?".to_owned(),
            format!(
                "a.toml:2:11: others[0]: is true or false where {forms} is needed\n  help: write {forms}"
            ),
            format!(
                "a.toml:2:20: others[2]: is a table where {forms} is needed\n  help: write {forms}"
            ),
            "a.toml:3:1: third: there is no such key\n  help: known here: first, second, others"
                .to_owned(),
        ];
        assert_eq!(messages, expected);
        let [edit] = mistakes[1].edits.as_slice() else { panic!("{:?}", mistakes[1]) };
        assert_eq!((edit.key.as_str(), edit.new.as_deref()), ("second", Some("\"none\"")));
    }
}
