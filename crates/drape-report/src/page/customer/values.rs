//! Value of a report: measured, by the law, and the published range.

use serde::Serialize;

use crate::check;
use crate::error::Error;
use crate::page::compared_value::{ComparedNumber, ComparedValue, SCATTER};

/// Value of every fabric of a report, in SI, with the published range of similar fabrics.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedValue {
    /// Numbers of the fabrics.
    pub value: ComparedValue,
    /// Published range for each fabric; `None` where there is none.
    pub ranges: Vec<Option<[f64; 2]>>,
    /// Source of the ranges. Empty without ranges.
    pub source: String,
}

/// Difference between a law and the measured value, divided by the measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LawDifference {
    pub(super) ratio: f64,
    /// Whether the difference is within 1.96 times the standard deviation of the measurement.
    /// `None` where the standard deviation is not known.
    pub(super) is_within_scatter: Option<bool>,
}

impl ReportedValue {
    /// Returns the numbers of the fabric with the index `fabric`.
    pub(super) fn number(&self, fabric: usize) -> ComparedNumber {
        self.value.numbers.get(fabric).copied().unwrap_or_default()
    }

    /// Returns the published range for the fabric with the index `fabric`.
    pub(super) fn range(&self, fabric: usize) -> Option<[f64; 2]> {
        self.ranges.get(fabric).copied().flatten()
    }

    /// Returns the difference between the law of the fabric with the index `fabric` and the
    /// measured value. `None` where a value is missing or assumed.
    pub(super) fn difference(&self, fabric: usize) -> Option<LawDifference> {
        let ComparedNumber { measured, deviation, law, is_assumed } = self.number(fabric);
        let (measured, law) = measured.zip(law.filter(|_| !is_assumed))?;
        let ratio = (law - measured) / measured.abs();
        let is_within_scatter =
            deviation.map(|deviation| (law - measured).abs() <= SCATTER * deviation);
        let difference = LawDifference { ratio, is_within_scatter };
        ratio.is_finite().then_some(difference)
    }

    /// Refuses texts that cannot be shown and numbers that are not finite, as [`Error`].
    pub(super) fn check(&self) -> Result<(), Error> {
        self.value.check()?;
        check::text("the source of published ranges", &self.source)?;
        let ends = self.ranges.iter().flatten().flatten();
        ends.copied().try_for_each(|end| check::number(|| self.value.title(), end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;

    #[test]
    fn a_law_is_held_against_what_was_measured_and_its_scatter() {
        let difference = |measured: f64, deviation: Option<f64>, law: f64, is_assumed: bool| {
            let number =
                ComparedNumber { measured: Some(measured), deviation, law: Some(law), is_assumed };
            let value = ComparedValue {
                symbol: "B".to_owned(),
                name: String::new(),
                direction: String::new(),
                units: Units::si("N·m"),
                numbers: vec![number],
                is_comparable: true,
            };
            let value = ReportedValue { value, ranges: Vec::new(), source: String::new() };
            value.difference(0).map(|found| (found.ratio, found.is_within_scatter))
        };
        assert_eq!(difference(2.0, None, 2.5, false), Some((0.25, None)));
        assert_eq!(difference(2.0, Some(0.5), 2.5, false), Some((0.25, Some(true))));
        assert_eq!(difference(-2.0, Some(0.2), -2.5, false), Some((-0.25, Some(false))));
        assert_eq!(difference(2.0, None, 2.5, true), None, "an assumed law follows nothing");
        assert_eq!(difference(0.0, None, 2.5, false), None);
    }
}
