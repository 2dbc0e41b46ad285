//! A quantity as a report writes it, before a page or a terminal gives it its form.

use crate::number::{Notation, percent, typeset};
use crate::parameter::{Interval, Parameter, Units};

/// A value with its error and unit, rounded together; the numbers are plain text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Shown {
    pub(crate) value: String,
    pub(crate) error: Option<String>,
    pub(crate) power: String,
    pub(crate) unit: String,
}

impl Shown {
    /// A value whose uncertainty is not known.
    pub(crate) fn bare(value: f64, unit: &str) -> Shown {
        let notation = Notation::of(value, None);
        Shown {
            value: notation.mantissa(value),
            error: None,
            power: notation.power(),
            unit: unit.to_owned(),
        }
    }

    /// A value in both of its units: the laboratory's, where there is one, and SI.
    pub(crate) fn both(value: f64, units: &Units) -> (Option<Shown>, Shown) {
        let kes = units.kes.as_ref();
        (kes.map(|unit| Shown::bare(value / unit.in_si, &unit.name)), Shown::bare(value, &units.si))
    }

    /// The value with its power of ten, and its error where there is one.
    pub(crate) fn number(&self) -> String {
        match (&self.error, self.power.is_empty()) {
            (Some(error), true) => format!("{} ± {error}", self.value),
            (Some(error), false) => format!("({} ± {error}){}", self.value, self.power),
            (None, _) => format!("{}{}", self.value, self.power),
        }
    }

    /// The same with the signs of print.
    pub(crate) fn print(&self) -> String {
        typeset(&self.number())
    }
}

/// A parameter as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ShownParameter<'a> {
    pub(crate) parameter: &'a Parameter,
    pub(crate) kes: Option<Shown>,
    pub(crate) si: Shown,
    pub(crate) relative: String,
    /// The interval in the laboratory's unit, or in SI where there is none.
    pub(crate) interval: String,
    pub(crate) reason: Option<&'a str>,
}

impl<'a> ShownParameter<'a> {
    pub(crate) fn new(parameter: &'a Parameter) -> ShownParameter<'a> {
        let kes = parameter.units.kes.as_ref();
        let in_kes = kes.map(|unit| scaled(parameter, unit.in_si, &unit.name));
        let (si, si_interval) = scaled(parameter, 1.0, &parameter.units.si);
        let (kes, interval) = match in_kes {
            Some((kes, interval)) => (Some(kes), interval),
            None => (None, si_interval),
        };
        ShownParameter {
            parameter,
            kes,
            si,
            relative: parameter.relative_error().map_or_else(String::new, percent),
            interval,
            reason: parameter.interval.reason(),
        }
    }

    /// The interval with the signs of print.
    pub(crate) fn print_interval(&self) -> String {
        typeset(&self.interval)
    }

    /// In the laboratory's unit, or in SI where there is none.
    pub(crate) fn first(&self) -> &Shown {
        self.kes.as_ref().unwrap_or(&self.si)
    }
}

/// A parameter and its interval in a unit, all rounded to the same place.
fn scaled(parameter: &Parameter, in_si: f64, unit: &str) -> (Shown, String) {
    let scale = |number: f64| number / in_si;
    // Four standard errors lie in a 95 % interval.
    let width = match parameter.interval {
        Interval::Between { lower, upper } => Some(0.25 * (upper - lower)),
        _ => None,
    };
    let uncertainty = parameter.standard_error.or(width).map(scale);
    let notation = Notation::of(scale(parameter.value), uncertainty);
    let write = |number: f64| notation.mantissa(scale(number));
    let power = notation.power();
    let interval = match parameter.interval {
        Interval::Between { lower, upper } => {
            format!("[{}, {}]{power}", write(lower), write(upper))
        }
        Interval::Above { lower, .. } => format!("> {}{power}", write(lower)),
        Interval::Below { upper, .. } => format!("< {}{power}", write(upper)),
        Interval::Unknown { .. } | Interval::Fixed { .. } => String::new(),
    };
    let shown = Shown {
        value: write(parameter.value),
        error: parameter.standard_error.map(write),
        power,
        unit: unit.to_owned(),
    };
    (shown, interval)
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
        assert_eq!(shown.interval, "< 9.250");
        assert_eq!(shown.reason, Some("the fit is as good without"));
    }
}
