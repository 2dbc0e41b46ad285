//! Value of several fabrics: measured, by the laws, and the differences from the first fabric.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use crate::check;
use crate::error::Error;
use crate::parameter::Units;

/// Two numbers count as equal within this many standard deviations of their difference. The
/// differences of 95 out of 100 repeated measurements lie within it.
pub(super) const SCATTER: f64 = 1.96;

/// Value of several fabrics, in SI.
///
/// ```
/// use drape_report::{ComparedNumber, ComparedValue, Units};
///
/// let law = |law: f64| ComparedNumber { law: Some(law), ..ComparedNumber::default() };
/// let mass = ComparedValue {
///     symbol: "W".to_owned(),
///     name: "mass per area".to_owned(),
///     direction: String::new(),
///     units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
///     numbers: vec![law(0.1), law(0.23)],
///     is_comparable: true,
/// };
/// assert_eq!(mass.difference(1).map(|difference| difference.ratio), Some(2.3));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedValue {
    /// Symbol, as in "B".
    pub symbol: String,
    /// Name, as in "bending rigidity".
    pub name: String,
    /// Direction, as in "warp". The text may be empty.
    pub direction: String,
    /// Units.
    pub units: Units,
    /// Numbers of each fabric.
    pub numbers: Vec<ComparedNumber>,
    /// Whether the tests were alike. Values that were read at different loads have no difference.
    pub is_comparable: bool,
}

/// Numbers of one fabric for a value, in SI.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ComparedNumber {
    /// Measured value, from the sheet or from its curve.
    pub measured: Option<f64>,
    /// Standard deviation of the measurement, where it is known.
    pub deviation: Option<f64>,
    /// Value of the law.
    pub law: Option<f64>,
    /// Whether the value of the law was assumed, because no measurement determines it.
    pub is_assumed: bool,
}

impl ComparedNumber {
    /// Returns the value of the `law`, unless it was assumed.
    fn fitted(&self) -> Option<f64> {
        self.law.filter(|_| !self.is_assumed)
    }
}

/// Difference between a fabric and the first fabric.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// Value of the fabric divided by the value of the first fabric.
    pub ratio: f64,
    /// Kind of the compared values.
    pub of: Compared,
    /// Whether both values agree within their scatter: the difference is at most 1.96 times its
    /// standard deviation. `None` where a standard deviation is not known.
    pub is_within_scatter: Option<bool>,
}

/// Kind of the values that a difference compares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Compared {
    /// Measured values of both fabrics.
    Measured,
    /// Values of the laws of both fabrics.
    Laws,
    /// A measured value of one fabric and the value of the law of the other fabric.
    Mixed,
}

impl ComparedValue {
    /// Returns the [`Difference`] between the fabric `index` and the first fabric. Measured values
    /// are compared where both fabrics have one, else values of laws. Returns `None` where a value
    /// is missing or assumed, where the first value is zero, or where the tests were not alike.
    #[must_use]
    pub fn difference(&self, index: usize) -> Option<Difference> {
        if !self.is_comparable || index == 0 {
            return None;
        }
        let (first, second) = (self.numbers.first()?, self.numbers.get(index)?);

        // Values of one kind are better to compare than a measured value and a law.
        let measured = first.measured.zip(second.measured);
        let laws = first.fitted().zip(second.fitted());
        let (values, of) = if let Some(values) = measured {
            (values, Compared::Measured)
        } else if let Some(values) = laws {
            (values, Compared::Laws)
        } else {
            let known = |number: &ComparedNumber| number.measured.or(number.fitted());
            (known(first).zip(known(second))?, Compared::Mixed)
        };
        let ratio = (values.0 != 0.0).then(|| values.1 / values.0);
        let ratio = ratio.filter(|ratio| ratio.is_finite())?;

        // Only measurements have a standard deviation.
        let deviations = first.deviation.zip(second.deviation);
        let is_within_scatter = deviations
            .filter(|_| of == Compared::Measured)
            .map(|(a, b)| (values.1 - values.0).abs() <= SCATTER * a.hypot(b));
        Some(Difference { ratio, of, is_within_scatter })
    }

    /// Returns the `symbol` and the `direction`.
    pub(super) fn title(&self) -> String {
        format!("{} {}", self.symbol, self.direction)
    }

    /// Refuses texts that cannot be shown, and `units` and `numbers` out of range.
    pub(super) fn check(&self) -> Result<(), Error> {
        for text in [&self.symbol, &self.name, &self.direction] {
            check::text("a text of a compared value", text)?;
        }
        self.units.check()?;
        let numbers =
            self.numbers.iter().flat_map(|number| [number.measured, number.deviation, number.law]);
        numbers.flatten().try_for_each(|number| check::number(|| self.title(), number))
    }

    /// Returns the differences between all fabrics and the first fabric, by
    /// [`ComparedValue::difference`].
    #[must_use]
    pub fn differences(&self) -> Vec<Option<Difference>> {
        (0..self.numbers.len()).map(|index| self.difference(index)).collect()
    }
}

impl Serialize for ComparedValue {
    /// Writes the value with its [`ComparedValue::differences`].
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut value = serializer.serialize_struct("ComparedValue", 6)?;
        value.serialize_field("symbol", &self.symbol)?;
        value.serialize_field("name", &self.name)?;
        value.serialize_field("direction", &self.direction)?;
        value.serialize_field("units", &self.units)?;
        value.serialize_field("numbers", &self.numbers)?;
        value.serialize_field("differences", &self.differences())?;
        value.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(numbers: &[ComparedNumber]) -> ComparedValue {
        ComparedValue {
            symbol: "B".to_owned(),
            name: "bending rigidity".to_owned(),
            direction: "warp".to_owned(),
            units: Units::si("N·m"),
            numbers: numbers.to_vec(),
            is_comparable: true,
        }
    }

    fn number(measured: f64, deviation: f64, law: f64) -> ComparedNumber {
        let known = |number: f64| Some(number).filter(|number| !number.is_nan());
        ComparedNumber {
            measured: known(measured),
            deviation: known(deviation),
            law: known(law),
            is_assumed: false,
        }
    }

    #[test]
    fn measured_values_are_compared_before_laws() {
        let of = |first, other| value(&[first, other]).difference(1).expect("a difference");
        let none = f64::NAN;
        let measured = of(number(2.0, none, 9.0), number(3.0, none, 9.0));
        assert_eq!((measured.ratio, measured.of), (1.5, Compared::Measured));
        let laws = of(number(2.0, none, 9.0), number(none, none, 18.0));
        assert_eq!((laws.ratio, laws.of), (2.0, Compared::Laws));
        let mixed = of(number(2.0, none, none), number(none, none, 5.0));
        assert_eq!((mixed.ratio, mixed.of), (2.5, Compared::Mixed));
    }

    #[test]
    fn a_difference_within_the_scatter_of_both_is_known_as_such() {
        let within = |two: f64| {
            let numbers = [number(10.0, 0.3, 10.0), number(two, 0.4, 10.0)];
            value(&numbers).difference(1).expect("a difference").is_within_scatter
        };
        // The standard deviation of the difference is 0.5.
        assert_eq!(within(10.97), Some(true));
        assert_eq!(within(10.99), Some(false));
        let unknown = value(&[number(10.0, 0.3, 1.0), number(11.0, f64::NAN, 1.0)]);
        assert_eq!(unknown.difference(1).expect("a difference").is_within_scatter, None);
    }

    #[test]
    fn what_cannot_be_compared_has_no_difference() {
        let none = f64::NAN;
        assert_eq!(value(&[number(0.0, none, none), number(1.0, none, none)]).difference(1), None);
        assert_eq!(value(&[number(1.0, none, none), number(none, none, none)]).difference(1), None);
        assert_eq!(value(&[number(1.0, none, none)]).difference(1), None);
        let assumed = ComparedNumber { is_assumed: true, ..number(none, none, 1.0) };
        assert_eq!(value(&[assumed, assumed]).difference(1), None);
        assert_eq!(value(&[number(1.0, none, 1.0), assumed]).difference(1), None);
        let numbers = [number(1.0, none, none), number(2.0, none, none)];
        let unlike = ComparedValue { is_comparable: false, ..value(&numbers) };
        assert_eq!(unlike.differences(), [None, None]);
    }
}
