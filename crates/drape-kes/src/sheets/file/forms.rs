//! Values of a sheet that may be written in several forms, such as a column by its name or number.

use drape_input::{FromLiteral, Length, Literal, Refusal, deserialize_literal, unknown_word};
use serde::{Deserialize, Deserializer};

use crate::sheets::file::stated::{Stated, refusal};
use crate::sheets::model::Model;
use crate::tables::layout::{Column, Take};

/// Column of a table file, or one length for all rows.
#[derive(Clone, Debug)]
pub(crate) enum ColumnOrLength {
    Column(Column),
    /// Length, in metres.
    Length(f64),
}

/// Columns of an axis: no column, one column, or several columns with repeats.
#[derive(Clone, Debug, Default)]
pub(crate) struct Columns(pub(crate) Vec<Column>);

/// Names of one or more files.
#[derive(Clone, Debug)]
pub(crate) struct FileNames(pub(crate) Vec<String>);

/// Number of lines; 0 for `false`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineCount(pub(crate) usize);

/// Text of a record, which may be written as a whole number or a date.
#[derive(Clone, Debug)]
pub(crate) struct RecordText(pub(crate) String);

/// Implements [`Deserialize`] for types that implement [`FromLiteral`].
macro_rules! deserialize {
    ($($name:ty),*) => {
        $(
            impl<'de> Deserialize<'de> for $name {
                fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    deserialize_literal(deserializer)
                }
            }
        )*
    };
}

deserialize!(Column, ColumnOrLength, Columns, FileNames, LineCount, Model, RecordText, Take);

impl FromLiteral for Column {
    const FORMS: &'static [&'static str] = &["a name in quotes", "a number from 1"];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        match value {
            Literal::Text(name) => Ok(Self::Name(name.clone())),
            value => whole(value).map(Self::Number),
        }
    }

    fn stand_in() -> Self {
        Self::Number(1)
    }
}

impl FromLiteral for Columns {
    const FORMS: &'static [&'static str] = &["a column name", "its place from 1", "a list of them"];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        let columns = match value {
            Literal::List(items) => items.iter().map(Column::from_literal).collect(),
            value => Column::from_literal(value).map(|column| vec![column]),
        };
        columns.map(Self)
    }

    fn stand_in() -> Self {
        Self::default()
    }
}

impl FromLiteral for ColumnOrLength {
    const FORMS: &'static [&'static str] = &["a column name", "text such as \"5 cm\""];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        let length = match value {
            Literal::Text(text) if starts_with_number(text) => {
                Stated::<Length>::from_literal(value)?.at("").si
            }
            Literal::Text(name) => return Ok(Self::Column(Column::Name(name.clone()))),
            // A number without a unit is in metres.
            value => value.number().ok_or(Refusal::Form)?,
        };
        if length > 0.0 && length.is_finite() {
            return Ok(Self::Length(length));
        }
        let help = "write the length with its unit, such as \"5 cm\"";
        Err(refusal(format!("{length} m is not a positive length"), help))
    }

    fn stand_in() -> Self {
        Self::Length(1.0)
    }
}

impl FromLiteral for FileNames {
    const FORMS: &'static [&'static str] = &["text in quotes", "a list of such texts"];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        let items = match value {
            Literal::List(items) if !items.is_empty() => items.as_slice(),
            value => std::slice::from_ref(value),
        };
        let mut names = Vec::with_capacity(items.len());
        for item in items {
            let Literal::Text(name) = item else { return Err(Refusal::Form) };
            names.push(name.clone());
        }
        Ok(Self(names))
    }

    fn stand_in() -> Self {
        Self(Vec::new())
    }
}

impl FromLiteral for LineCount {
    const FORMS: &'static [&'static str] = &["a number of lines", "false"];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        match value {
            Literal::Flag(false) => Ok(Self(0)),
            value => whole(value).map(Self),
        }
    }

    fn stand_in() -> Self {
        Self(0)
    }
}

impl FromLiteral for Model {
    const FORMS: &'static [&'static str] = &["text in quotes"];

    /// Returns the law that `value` names. A former name is accepted.
    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        let Literal::Text(word) = value else { return Err(Refusal::Form) };
        Self::named(word).ok_or_else(|| unknown_word(word, &Self::ALL.map(Self::name)).into())
    }

    fn stand_in() -> Self {
        Self::FirstOrder
    }
}

impl FromLiteral for RecordText {
    const FORMS: &'static [&'static str] = &["text in quotes"];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        match value {
            Literal::Text(text) => Ok(Self(text.clone())),
            Literal::Integer(number) => Ok(Self(number.to_string())),
            _ => Err(Refusal::Form),
        }
    }

    fn stand_in() -> Self {
        Self(String::new())
    }
}

impl FromLiteral for Take {
    const FORMS: &'static [&'static str] = &["a number from 1", "a list such as [1, 3]", "\"all\""];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        match value {
            Literal::Text(text) if text == "all" => Ok(Self::All),
            Literal::List(items) if !items.is_empty() => {
                items.iter().map(whole).collect::<Result<_, _>>().map(Self::Numbers)
            }
            value => whole(value).map(|number| Self::Numbers(vec![number])),
        }
    }

    fn stand_in() -> Self {
        Self::Undeclared
    }
}

/// Returns the whole number `value`, which is not negative.
fn whole(value: &Literal) -> Result<usize, Refusal> {
    match value {
        Literal::Integer(number) => usize::try_from(*number).map_err(|_| Refusal::Form),
        _ => Err(Refusal::Form),
    }
}

/// Returns whether `text` begins with a digit, a sign or a point.
fn starts_with_number(text: &str) -> bool {
    text.trim_start().starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
}

/// Meaning of a length from which a deformation is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Zero {
    /// Extension of the specimen: zero at the gauge length.
    Extension,
    /// Distance of the clamps: the gauge length at the start.
    Distance,
    /// Position of a clamp: arbitrary at the start.
    Position,
}

#[cfg(feature = "schema")]
impl Zero {
    /// All meanings.
    pub(crate) const ALL: [Self; 3] = [Self::Extension, Self::Distance, Self::Position];

    /// Returns the name in sheets: `"extension"` for [`Zero::Extension`].
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Extension => "extension",
            Self::Distance => "distance",
            Self::Position => "position",
        }
    }
}
