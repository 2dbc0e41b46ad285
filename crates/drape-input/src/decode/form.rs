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
/// assert_eq!(message, "column: is true or false where a name in quotes, or a number from 1 is needed");
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
        let Self::Reason(ValueError { message, help, meant }) = self else { return Ok(()) };
        write!(f, "{message}{BETWEEN}{help}")?;
        meant.as_ref().map_or(Ok(()), |meant| write!(f, "{BETWEEN}{meant}"))
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
        Some(Self::Reason(ValueError { message, help, meant: parts.next() }))
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
