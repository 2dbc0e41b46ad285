//! Number of a sheet: as written, in SI, and in the laboratory's unit.

use std::marker::PhantomData;

use drape_input::{
    Dimension, FromLiteral, Literal, NumberWithUnit, Quantity, Refusal, ValueError,
    deserialize_literal, parse_quantity,
};
use serde::{Deserialize, Deserializer};

use crate::scatter::{self, ValueWithDeviation};

/// Number of the file with its key path, for checks.
#[derive(Clone, Debug, Default)]
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

/// Number of the dimension `D` in a file: a bare number in the laboratory's unit, or a text with a
/// number, a unit and a standard deviation.
#[derive(Clone, Debug)]
pub(crate) struct Stated<D> {
    /// Number, without a key path.
    measured: Measured,
    dimension: PhantomData<D>,
}

impl<D> Stated<D> {
    /// Returns the number, which stands at the key path `key`.
    pub(crate) fn at(&self, key: impl Into<String>) -> Measured {
        Measured { key: key.into(), ..self.measured.clone() }
    }
}

impl<D: Dimension> FromLiteral for Stated<D> {
    const FORMS: &'static [&'static str] = &["a number", "text with a number and its unit"];

    fn from_literal(value: &Literal) -> Result<Self, Refusal> {
        let measured = match value {
            Literal::Text(text) => parse_measured(text, D::QUANTITY)?,
            Literal::Table => {
                return Err(refusal(
                    "is a table where a number is needed",
                    "write the value of each direction into [warp] and [weft], or into a key such as \
                     B_warp and B_weft",
                ));
            }
            value => {
                let number = value.number().ok_or(Refusal::Form)?;
                let si = number * D::QUANTITY.laboratory().factor;
                let written = number.to_string();
                Measured { si, laboratory: number, number, written, ..Measured::default() }
            }
        };

        if !measured.number.is_finite() {
            let message = format!("{} is not a finite number", measured.written);
            let help = "write the measured value, or remove the line if it was not measured";
            return Err(refusal(message, help));
        }
        if let Some(deviation) = measured.deviation.filter(|stated| !is_deviation(*stated)) {
            let message = format!(
                "{}: a standard deviation of {deviation} is not zero or more",
                measured.written
            );
            return Err(refusal(message, "write the value, ± and its standard deviation"));
        }
        Ok(Self { measured, dimension: PhantomData })
    }

    fn stand_in() -> Self {
        Self { measured: Measured::default(), dimension: PhantomData }
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Stated<D> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserialize_literal(deserializer)
    }
}

/// Parses the number in `text`, of `quantity`, with its unit and its standard deviation.
fn parse_measured(text: &str, quantity: Quantity) -> Result<Measured, ValueError> {
    let (value, deviation) = match scatter::parse(text, quantity) {
        None => (parse_quantity(text, quantity)?, None),
        Some(parted) => {
            let ValueWithDeviation { value, deviation } = parted?;
            (value, Some(deviation))
        }
    };

    // A number in the laboratory's unit is not converted twice, so that its digits stay.
    let NumberWithUnit { number, unit } = value;
    let (si, laboratory_unit) = (number * unit.factor, quantity.laboratory());
    let laboratory = if unit == laboratory_unit { number } else { si / laboratory_unit.factor };
    Ok(Measured { si, laboratory, deviation, number, written: text.into(), key: String::new() })
}

/// Returns whether `stated` can be a standard deviation.
fn is_deviation(stated: f64) -> bool {
    stated.is_finite() && stated >= 0.0
}

/// Returns the refusal with `message` and the remedy `help`.
pub(crate) fn refusal(message: impl Into<String>, help: impl Into<String>) -> Refusal {
    Refusal::Reason(ValueError { message: message.into(), help: help.into(), intended_value: None })
}
