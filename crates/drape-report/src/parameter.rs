//! Parameters with their units, standard errors and intervals, as plain data.

use serde::Serialize;

use crate::check;
use crate::error::Error;

/// Unit of the laboratory, in which numbers are shown in addition to SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Unit {
    /// Name, as in "gf·cm²/cm".
    pub name: String,
    /// Size of the unit in SI, as in 9.80665e-5.
    pub in_si: f64,
}

/// Units of a quantity: SI, and the unit of the laboratory where there is one.
///
/// ```
/// use drape_report::Units;
///
/// let rigidity = Units::si("N·m").with_kes("gf·cm²/cm", 9.80665e-5);
/// assert_eq!(rigidity.kes.expect("it has one").name, "gf·cm²/cm");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Units {
    /// Name of the SI unit, as in "N·m". Empty for a ratio.
    pub si: String,
    /// Unit of the laboratory.
    pub kes: Option<Unit>,
}

impl Units {
    /// Returns the units of a quantity with the SI unit `name`, without a unit of the laboratory.
    #[must_use]
    pub fn si(name: &str) -> Units {
        Units { si: name.to_owned(), kes: None }
    }

    /// Returns the units with the unit `name` of the laboratory, which is `in_si` SI units.
    #[must_use]
    pub fn with_kes(self, name: &str, in_si: f64) -> Units {
        let kes = Some(Unit { name: name.to_owned(), in_si });
        Units { kes, ..self }
    }

    /// Returns the name and the size, in SI units, of the unit of the laboratory (`kes`), or of the
    /// SI unit where there is none.
    pub(crate) fn first(&self) -> (&str, f64) {
        self.kes.as_ref().map_or((&self.si, 1.0), |unit| (&unit.name, unit.in_si))
    }

    /// Returns the name of the SI unit where [`Units::first`] is another unit.
    pub(crate) fn second(&self) -> Option<&str> {
        self.kes.as_ref().map(|_| self.si.as_str())
    }

    /// Refuses names that cannot be shown and a size out of range, as [`Error`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        check::text("the name of a unit", &self.si)?;
        self.kes.as_ref().map_or(Ok(()), |unit| {
            check::text("the name of a unit", &unit.name)?;
            check::unit(unit.in_si)
        })
    }
}

/// Interval of a parameter with 95 % confidence, in SI, or the reason why it is missing.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Interval {
    /// Between two ends.
    Between {
        /// Lower end.
        lower: f64,
        /// Upper end.
        upper: f64,
    },
    /// Above a lower end. The data give no upper end.
    Above {
        /// Lower end.
        lower: f64,
        /// Reason why there is no upper end.
        reason: String,
    },
    /// Below an upper end. The data give no lower end.
    Below {
        /// Upper end.
        upper: f64,
        /// Reason why there is no lower end.
        reason: String,
    },
    /// Not determined by the data.
    Unknown {
        /// Reason: at a bound, not identifiable, no curve.
        reason: String,
    },
    /// Not fitted.
    Fixed {
        /// Reason: set by hand, tied to another parameter. The text may be empty.
        reason: String,
    },
}

impl Interval {
    /// Largest ratio of the ends of an interval. With a larger ratio the data do not determine a
    /// positive number.
    pub const VAGUE: f64 = 10.0;

    /// Returns whether both ends of the interval are positive and the upper end is more than
    /// [`Interval::VAGUE`] times the lower end.
    #[must_use]
    pub fn is_vague(&self) -> bool {
        matches!(*self, Self::Between { lower, upper } if lower > 0.0 && upper > Self::VAGUE * lower)
    }

    /// Refuses ends that are not finite or exchanged, and a reason that cannot be shown. The error
    /// names the interval by `name`.
    pub(crate) fn check(&self, name: &str) -> Result<(), Error> {
        if let Some(reason) = self.reason() {
            check::text("the reason for a missing interval", reason)?;
        }

        let bound = |value: f64| check::number(|| format!("the interval of {name}"), value);
        match *self {
            Self::Between { lower, upper } => {
                bound(lower)?;
                bound(upper)?;
                if lower > upper {
                    return Err(Error::OutOfRange {
                        what: "the upper end of an interval",
                        value: upper,
                        range: "at least its lower end",
                    });
                }
                Ok(())
            }
            Self::Above { lower, .. } => bound(lower),
            Self::Below { upper, .. } => bound(upper),
            Self::Unknown { .. } | Self::Fixed { .. } => Ok(()),
        }
    }

    /// Returns the `reason` why an end or the whole interval is missing.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Between { .. } => None,
            Self::Above { reason, .. }
            | Self::Below { reason, .. }
            | Self::Unknown { reason }
            | Self::Fixed { reason } => Some(reason.as_str()).filter(|reason| !reason.is_empty()),
        }
    }
}

/// Parameter with its uncertainty, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parameter {
    /// Name, as in "bending rigidity".
    pub name: String,
    /// Symbol; `k_b` is shown as k with the index b.
    pub symbol: String,
    /// Value, in SI.
    pub value: f64,
    /// Units.
    pub units: Units,
    /// Standard error, in SI.
    pub standard_error: Option<f64>,
    /// Interval with 95 % confidence.
    pub interval: Interval,
    /// Whether it belongs to the test and not to the fabric, as a zero or a drift does: then an
    /// error larger than the value does not count against the law.
    pub incidental: bool,
}

impl Parameter {
    /// Returns the `standard_error` over the magnitude of the `value`, a ratio. Returns `None`
    /// where the error is missing or the value is zero.
    #[must_use]
    pub fn relative_error(&self) -> Option<f64> {
        let size = self.value.abs();
        self.standard_error.map(|error| error / size).filter(|ratio| ratio.is_finite())
    }

    /// Returns whether the parameter was fitted and the data do not give both ends of its
    /// `interval`.
    #[must_use]
    pub fn is_undetermined(&self) -> bool {
        let fixed = matches!(self.interval, Interval::Fixed { .. });
        !fixed && self.interval.reason().is_some()
    }

    /// Refuses numbers that are not finite, a negative `standard_error` and an `interval` with
    /// exchanged ends.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        check::text("the name of a parameter", &self.name)?;
        check::text("the symbol of a parameter", &self.symbol)?;
        self.units.check()?;
        let name = &self.name;
        check::number(|| name.clone(), self.value)?;
        if let Some(error) = self.standard_error {
            check::number(|| format!("the standard error of {name}"), error)?;
            if error < 0.0 {
                return Err(Error::OutOfRange {
                    what: "a standard error",
                    value: error,
                    range: "0 or more",
                });
            }
        }
        self.interval.check(name)
    }
}
