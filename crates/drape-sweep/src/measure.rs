//! Measures: values of the summaries that a study names. `convergence` estimates the error that the
//! grid leaves in a value.

pub(crate) mod convergence;

use drape_input::{Quantity, ValueError, parse_unit, round_digits};

/// Quantities whose units a measure may have.
const QUANTITIES: [Quantity; 8] = [
    Quantity::Ratio,
    Quantity::Length,
    Quantity::Angle,
    Quantity::Curvature,
    Quantity::Force,
    Quantity::Pressure,
    Quantity::Time,
    Quantity::Speed,
];

/// Value of the summaries of all runs, with a name and a unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Name of the column in the table, with the unit.
    pub name: String,
    /// Key in the summary, a path of names and numbers.
    pub key: String,
    /// Value of the unit in SI.
    factor: f64,
}

impl Measure {
    /// Creates the measure of the value at `key`. The name of its column is `name`, or else `key`,
    /// followed by the `unit`.
    pub(crate) fn new(
        key: &str,
        name: Option<&str>,
        unit: Option<&str>,
    ) -> Result<Self, ValueError> {
        let mut measure =
            Self { name: name.unwrap_or(key).to_owned(), key: key.to_owned(), factor: 1.0 };
        if let Some(unit) = unit {
            let unit = parse_unit(unit, &QUANTITIES)?;
            measure.name += &format!(" in {}", unit.spelling);
            measure.factor = unit.factor;
        }
        Ok(measure)
    }

    /// Returns `value`, a number of the summary in SI, in the unit of the measure with 12 digits.
    /// Other values stay as they are.
    pub(crate) fn in_unit(&self, value: String) -> String {
        match value.parse::<f64>() {
            Ok(number) if self.factor != 1.0 => round_digits(number / self.factor, 12).to_string(),
            _ => value,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_in_the_unit_that_the_name_has() {
        let ease = Measure::new("measures.openings.0.ease", Some("ease"), Some("mm"));
        let ease = ease.expect("a unit");
        assert_eq!(ease.name, "ease in mm");
        assert_eq!(ease.in_unit("0.4058423688330177".into()), "405.842368833");
        assert_eq!(ease.in_unit("-0.1".into()), "-100");
        let plain = Measure::new("steps", None, None).expect("none");
        assert_eq!((plain.name.as_str(), plain.in_unit("44".into())), ("steps", "44".into()));
        let error = Measure::new("steps", None, Some("mmm")).expect_err("no unit");
        assert!(error.help.contains("mm"), "{error:?}");
    }
}
