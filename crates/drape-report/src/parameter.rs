use serde::Serialize;

use crate::check;
use crate::error::ReportError;

/// A unit in which numbers are also shown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Unit {
    /// Its name, as in "gf·cm²/cm".
    pub name: String,
    /// One of it in SI, as in 9.80665e-5.
    pub in_si: f64,
}

/// The units of a quantity: SI, and the laboratory's where it has one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Units {
    /// The SI unit's name, as in "N·m"; empty for a bare number.
    pub si: String,
    /// The laboratory's unit.
    pub kes: Option<Unit>,
}

impl Units {
    /// A quantity that has no unit of the laboratory.
    pub fn si(name: &str) -> Units {
        Units { si: name.to_owned(), kes: None }
    }

    /// The same quantity in the laboratory's unit, which is `in_si` SI units.
    pub fn with_kes(self, name: &str, in_si: f64) -> Units {
        let kes = Some(Unit { name: name.to_owned(), in_si });
        Units { kes, ..self }
    }

    pub(crate) fn check(&self) -> Result<(), ReportError> {
        check::text("the name of a unit", &self.si)?;
        self.kes.as_ref().map_or(Ok(()), |unit| {
            check::text("the name of a unit", &unit.name)?;
            check::unit(unit.in_si)
        })
    }
}

/// Where a parameter lies with 95 % confidence, in SI, or why that cannot be said.
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
    /// Above a lower end; the data set no upper one.
    Above {
        /// Lower end.
        lower: f64,
        /// Why there is no upper end.
        reason: String,
    },
    /// Below an upper end; the data set no lower one.
    Below {
        /// Upper end.
        upper: f64,
        /// Why there is no lower end.
        reason: String,
    },
    /// Anywhere: the data do not tell.
    Unknown {
        /// Why: at a bound, not identifiable, no curve.
        reason: String,
    },
    /// Not asked: the parameter was not fitted.
    Fixed {
        /// Why: set by hand, tied to another one; may be empty.
        reason: String,
    },
}

impl Interval {
    /// Why an end or the whole interval is missing.
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

/// A parameter with its uncertainty, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parameter {
    /// What it is, as in "bending rigidity".
    pub name: String,
    /// Its symbol; `k_b` is shown as k with the index b.
    pub symbol: String,
    /// Its value, in SI.
    pub value: f64,
    /// Its units.
    pub units: Units,
    /// Its standard error, in SI.
    pub standard_error: Option<f64>,
    /// Its 95 % interval.
    pub interval: Interval,
    /// Whether it belongs to the test and not to the fabric, as a zero or a drift does: then nobody minds that it
    /// is small beside its error.
    pub incidental: bool,
}

impl Parameter {
    /// Standard error over the size of the value, a ratio; none where either is missing or zero.
    pub fn relative_error(&self) -> Option<f64> {
        let size = self.value.abs();
        self.standard_error.map(|error| error / size).filter(|ratio| ratio.is_finite())
    }

    /// Whether the data were asked for its interval and did not give all of it.
    pub fn is_undetermined(&self) -> bool {
        let fixed = matches!(self.interval, Interval::Fixed { .. });
        !fixed && self.interval.reason().is_some()
    }

    /// Refuses numbers that are none, a negative standard error, an interval that is upside down.
    pub fn check(&self) -> Result<(), ReportError> {
        check::text("the name of a parameter", &self.name)?;
        check::text("the symbol of a parameter", &self.symbol)?;
        self.units.check()?;
        let name = &self.name;
        check::number(|| name.clone(), self.value)?;
        if let Some(error) = self.standard_error {
            check::number(|| format!("the standard error of {name}"), error)?;
            if error < 0.0 {
                return Err(ReportError::OutOfRange {
                    what: "a standard error",
                    value: error,
                    range: "0 or more",
                });
            }
        }
        if let Some(reason) = self.interval.reason() {
            check::text("the reason for a missing interval", reason)?;
        }
        let bound = |value: f64| check::number(|| format!("the interval of {name}"), value);
        match self.interval {
            Interval::Between { lower, upper } => {
                bound(lower)?;
                bound(upper)?;
                if lower > upper {
                    return Err(ReportError::OutOfRange {
                        what: "the upper end of an interval",
                        value: upper,
                        range: "at least its lower end",
                    });
                }
                Ok(())
            }
            Interval::Above { lower, .. } => bound(lower),
            Interval::Below { upper, .. } => bound(upper),
            Interval::Unknown { .. } | Interval::Fixed { .. } => Ok(()),
        }
    }
}
