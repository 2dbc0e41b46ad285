//! Quantities as text, before a page or a terminal lays them out.

use drape_input::{Notation, percent, significant, typeset};

use super::law_value::LawValue;
use crate::parameter::{Interval, Parameter, Units};

/// Number of significant digits of a number without a known uncertainty.
const DIGITS: i32 = 4;

/// Words for an interval that says nothing.
const NOT_DETERMINED: &str = "not determined by this curve";

/// Value with its error and unit, rounded together, as plain text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Shown {
    pub(crate) value: String,
    pub(crate) error: Option<String>,
    pub(crate) power: String,
    pub(crate) unit: String,
}

impl Shown {
    /// Returns a `value` in a `unit`, without a known uncertainty.
    pub(crate) fn bare(value: f64, unit: &str) -> Shown {
        Shown::with_error(value, None, unit)
    }

    /// Returns a `value` in a `unit` with its `error`, where the error is known. Both are rounded
    /// to the same decimal place.
    pub(crate) fn with_error(value: f64, error: Option<f64>, unit: &str) -> Shown {
        let notation = Notation::of(value, error);
        Shown {
            value: notation.mantissa(value),
            error: error.map(|error| notation.mantissa(error)),
            power: notation.power(),
            unit: unit.to_owned(),
        }
    }

    /// Returns the `value` with its power of ten, and with its `error` where there is one.
    pub(crate) fn number(&self) -> String {
        match (&self.error, self.power.is_empty()) {
            (Some(error), true) => format!("{} ± {error}", self.value),
            (Some(error), false) => format!("({} ± {error}){}", self.value, self.power),
            (None, _) => format!("{}{}", self.value, self.power),
        }
    }

    /// Returns the text of [`Shown::number`], typeset.
    pub(crate) fn print(&self) -> String {
        typeset(&self.number())
    }
}

/// Value in SI and in the unit of the laboratory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ShownValue {
    /// Value in the unit of the laboratory, where there is one.
    pub(crate) kes: Option<Shown>,
    pub(crate) si: Shown,
}

impl ShownValue {
    /// Returns a `value`, given in SI, in its `units`.
    pub(crate) fn new(value: f64, units: &Units) -> ShownValue {
        ShownValue::with_error(value, None, units)
    }

    /// Returns a `value`, given in SI, with its `error` in its `units`.
    pub(crate) fn with_error(value: f64, error: Option<f64>, units: &Units) -> ShownValue {
        let scaled = |in_si: f64, unit: &str| {
            Shown::with_error(value / in_si, error.map(|error| error / in_si), unit)
        };
        ShownValue {
            kes: units.kes.as_ref().map(|unit| scaled(unit.in_si, &unit.name)),
            si: scaled(1.0, &units.si),
        }
    }

    /// Returns the value in the unit of the laboratory ([`ShownValue::kes`]), or in SI where there
    /// is none.
    pub(crate) fn first(&self) -> &Shown {
        self.kes.as_ref().unwrap_or(&self.si)
    }

    /// Returns the value in SI where [`ShownValue::first`] is in another unit.
    pub(crate) fn second(&self) -> Option<&Shown> {
        self.kes.as_ref().map(|_| &self.si)
    }
}

/// Ratio or difference as text, and whether it is marked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Marked {
    pub(crate) text: String,
    /// Whether the ratio or difference is beyond the limit.
    pub(crate) apart: bool,
}

/// Parameter as text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ShownParameter<'a> {
    pub(crate) parameter: &'a Parameter,
    pub(crate) kes: Option<Shown>,
    pub(crate) si: Shown,
    pub(crate) relative: String,
    /// Interval in the unit of the laboratory, or in SI where there is none.
    pub(crate) interval: String,
    pub(crate) reason: Option<&'a str>,
}

impl<'a> ShownParameter<'a> {
    /// Returns the text of a `parameter`.
    pub(crate) fn new(parameter: &'a Parameter) -> ShownParameter<'a> {
        let estimate = Estimate {
            value: parameter.value,
            standard_error: parameter.standard_error,
            interval: &parameter.interval,
            is_positive: !parameter.incidental && parameter.value > 0.0,
        };
        let kes = parameter.units.kes.as_ref();
        let in_kes = kes.map(|unit| estimate.scaled(unit.in_si, &unit.name));
        let in_si = estimate.scaled(1.0, &parameter.units.si);
        let (kes, interval) = match in_kes {
            Some(Scaled { shown, interval }) => (Some(shown), interval),
            None => (None, in_si.interval),
        };
        ShownParameter {
            parameter,
            kes,
            si: in_si.shown,
            relative: parameter.relative_error().map_or_else(String::new, percent),
            interval,
            reason: parameter.interval.reason(),
        }
    }

    /// Returns the `interval`, typeset.
    pub(crate) fn print_interval(&self) -> String {
        typeset(&self.interval)
    }

    /// Returns the value in the unit of the laboratory (`kes`), or in SI where there is none.
    pub(crate) fn first(&self) -> &Shown {
        self.kes.as_ref().unwrap_or(&self.si)
    }
}

/// Value of a law as text, in the unit of the laboratory, or in SI where there is none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ShownLawValue<'a> {
    pub(crate) value: &'a LawValue,
    pub(crate) law: Shown,
    pub(crate) curve: Option<Shown>,
    pub(crate) relative: String,
    pub(crate) interval: String,
}

impl<'a> ShownLawValue<'a> {
    /// Returns the text of a `value`.
    pub(crate) fn new(value: &'a LawValue) -> ShownLawValue<'a> {
        let estimate = Estimate {
            value: value.law,
            standard_error: None,
            interval: &value.interval,
            is_positive: true,
        };
        let (unit, in_si) = value.units.first();
        let Scaled { shown, interval } = estimate.scaled(in_si, unit);
        ShownLawValue {
            value,
            law: shown,
            curve: value.curve.map(|curve| Shown::bare(curve / in_si, unit)),
            relative: value.relative_error().map_or_else(String::new, percent),
            interval: match value.interval.reason() {
                Some(reason) if interval.is_empty() => reason.to_owned(),
                Some(reason) => format!("{interval}: {reason}"),
                None => interval,
            },
        }
    }

    /// Returns the `interval`, typeset.
    pub(crate) fn print_interval(&self) -> String {
        typeset(&self.interval)
    }
}

/// Number in SI with its uncertainty.
struct Estimate<'a> {
    value: f64,
    standard_error: Option<f64>,
    interval: &'a Interval,
    /// Whether the number can only be positive. An interval that reaches zero then has no lower
    /// end.
    is_positive: bool,
}

/// Number and its interval in one unit, rounded to the same decimal place.
struct Scaled {
    shown: Shown,
    interval: String,
}

impl Estimate<'_> {
    /// Returns the number in a `unit`, which is `in_si` SI units.
    fn scaled(&self, in_si: f64, unit: &str) -> Scaled {
        let scale = |number: f64| number / in_si;
        // A 95 % interval is four standard errors wide.
        let width = match *self.interval {
            Interval::Between { lower, upper } => Some(0.25 * (upper - lower)),
            _ => None,
        };

        let uncertainty = self.standard_error.or(width).map(scale);
        let notation = Notation::of(scale(self.value), uncertainty);
        let write = |number: f64| notation.mantissa(scale(number));
        let power = notation.power();
        let interval = match *self.interval {
            _ if self.is_positive && self.interval.is_vague() => NOT_DETERMINED.to_owned(),
            Interval::Between { lower, upper } if self.is_positive && lower <= 0.0 => {
                format!("below {}", notation.whole(scale(upper)))
            }
            Interval::Between { lower, upper } => match [lower, upper].map(scale) {
                bounds if bounds.iter().all(|bound| notation.suits(*bound)) => {
                    format!("[{}, {}]{power}", write(lower), write(upper))
                }
                [lower, upper] => {
                    format!("[{}, {}]", significant(lower, DIGITS), significant(upper, DIGITS))
                }
            },
            Interval::Above { lower, .. } => format!("above {}", notation.whole(scale(lower))),
            Interval::Below { upper, .. } => format!("below {}", notation.whole(scale(upper))),
            Interval::Unknown { .. } | Interval::Fixed { .. } => String::new(),
        };

        let shown = Shown {
            value: write(self.value),
            error: self.standard_error.map(write),
            power,
            unit: unit.to_owned(),
        };
        Scaled { shown, interval }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_is_written_in_both_units_with_one_rounding_each() {
        let parameter = Parameter {
            name: "bending rigidity".to_owned(),
            symbol: "k_b".to_owned(),
            value: 0.118 * 9.80665e-5,
            units: Units::si("N·m").with_kes("gf·cm²/cm", 9.80665e-5),
            standard_error: Some(0.0023 * 9.80665e-5),
            interval: Interval::Between { lower: 0.1135 * 9.80665e-5, upper: 0.1227 * 9.80665e-5 },
            incidental: false,
        };
        let shown = ShownParameter::new(&parameter);
        assert_eq!(shown.first().number(), "0.1180 ± 0.0023");
        assert_eq!(shown.si.number(), "(1.157 ± 0.023)e-5");
        assert_eq!(shown.interval, "[0.1135, 0.1227]");
        assert_eq!(shown.relative, "1.95 %");
    }

    #[test]
    fn an_interval_with_one_end_says_which() {
        let parameter = Parameter {
            name: "slip length".to_owned(),
            symbol: "x_f".to_owned(),
            value: 4.0,
            units: Units::si("1/m"),
            standard_error: None,
            interval: Interval::Below {
                upper: 9.25,
                reason: "the fit is as good without".to_owned(),
            },
            incidental: false,
        };
        let shown = ShownParameter::new(&parameter);
        assert_eq!(shown.interval, "below 9.250");
        assert_eq!(shown.reason, Some("the fit is as good without"));
        let wide = Interval::Between { lower: 0.5, upper: 7.9e47 };
        let parameter = Parameter { interval: wide, standard_error: Some(2.5), ..parameter };
        assert_eq!(ShownParameter::new(&parameter).interval, "not determined by this curve");
        let signed = Parameter { incidental: true, ..parameter.clone() };
        assert_eq!(ShownParameter::new(&signed).interval, "[0.5000, 7.900e47]");
        let to_zero = Interval::Between { lower: -1.0, upper: 9.0 };
        let parameter = Parameter { interval: to_zero, ..parameter };
        assert_eq!(ShownParameter::new(&parameter).interval, "below 9.0");
        let far = Interval::Below { upper: 7.9e47, reason: String::new() };
        let parameter = Parameter { interval: far, ..parameter };
        assert_eq!(ShownParameter::new(&parameter).interval, "below 7.900e47");
    }
}
