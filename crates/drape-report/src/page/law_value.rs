//! Value of a fitted law beside the value of its curve, with the interval that decides how well the
//! law is known.

use serde::Serialize;

use crate::check;
use crate::error::Error;
use crate::parameter::{Interval, Units};

/// KES value of a fitted law, in SI, with the value of the measured curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LawValue {
    /// Symbol of the laboratory, as in "2HB".
    pub symbol: String,
    /// Name, as in "bending loop width".
    pub name: String,
    /// Units.
    pub units: Units,
    /// Value of the law, in SI.
    pub law: f64,
    /// Value that is read off the measured curve, in SI.
    pub curve: Option<f64>,
    /// Interval with 95 % confidence.
    pub interval: Interval,
}

impl LawValue {
    /// Returns the larger distance between the value of the `law` and an end of its `interval`,
    /// divided by the value. Returns `None` without an interval of two ends.
    #[must_use]
    pub fn relative_error(&self) -> Option<f64> {
        let Interval::Between { lower, upper } = self.interval else { return None };
        Some((upper - self.law).max(self.law - lower) / self.law.abs())
    }

    /// Returns whether the curve determines the value. It does if the `interval` has two ends above
    /// zero whose ratio is at most [`Interval::VAGUE`].
    #[must_use]
    pub fn is_determined(&self) -> bool {
        matches!(self.interval, Interval::Between { lower, .. } if lower > 0.0)
            && !self.interval.is_vague()
    }

    /// Refuses numbers that are not finite and an `interval` with exchanged ends.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        check::text("the symbol of a value", &self.symbol)?;
        check::text("the name of a value", &self.name)?;
        self.units.check()?;
        for number in [Some(self.law), self.curve].into_iter().flatten() {
            check::number(|| self.symbol.clone(), number)?;
        }
        self.interval.check(&self.symbol)
    }
}
