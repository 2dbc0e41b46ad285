//! Fitted parameter, and value of a fitted law, with their uncertainty.

use std::fmt;

use drape_kes::Symbol;

/// Fitted parameter, in SI.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Estimate {
    /// Name of the parameter. [`parameter_key`](crate::parameter_key) has its key in a fabric file,
    /// whose unit it has. Others have no key: `zero` and `drift` of the load are in its unit;
    /// `free strain`, `state`, `toe_growth`, `slow` and `ratio` are ratios.
    pub name: &'static str,
    /// Value, in SI.
    pub value: f64,
    /// Standard error, or the reason why there is none.
    ///
    /// It holds for noise of one size at all points, whatever the weights, and is widened where the
    /// residuals of neighbouring points are correlated (`CurveFit::effective_points`).
    pub standard_error: Result<f64, Undetermined>,
    /// 95 % interval, or the reason why there is none.
    pub interval: Result<[f64; 2], Undetermined>,
    /// Value without weights: the difference to `value` is the effect of the weights.
    pub unweighted: f64,
}

impl Estimate {
    /// Returns whether the `interval` contains zero or is missing. The data then do not support the
    /// parameter.
    #[must_use]
    pub fn is_doubtful(&self) -> bool {
        self.interval.as_ref().map_or(true, |[lower, upper]| lower * upper <= 0.0)
    }
}

/// KES value of a fitted law, beside the value that is read from the curve.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ValueEstimate {
    /// Symbol of the value.
    pub symbol: Symbol,
    /// Value of the law, in the laboratory's unit. Values of a tensile law are values at the
    /// largest load of the curve.
    pub value: f64,
    /// Value that is read from the measured curve, in the laboratory's unit, or the reason why
    /// there is none.
    pub curve: Result<f64, String>,
    /// 95 % interval, in the laboratory's unit, or the reason why there is none.
    ///
    /// The interval follows from the errors of the parameters. It is widened until it contains the
    /// value that is read from the curve, with an equal error, so that it covers the misfit of the
    /// law.
    pub interval: Result<[f64; 2], Undetermined>,
}

impl ValueEstimate {
    /// Ratio of the ends of an interval beyond which the curve does not determine the value.
    pub const VAGUE: f64 = 10.0;

    /// Returns whether the curve determines the value: it has an interval whose upper end is at
    /// most [`ValueEstimate::VAGUE`] times its lower end.
    #[must_use]
    pub fn is_determined(&self) -> bool {
        let [lower, upper] = match self.interval {
            Ok(interval) => interval,
            Err(_) => return false,
        };
        lower > 0.0 && upper <= Self::VAGUE * lower
    }

    /// Returns the larger distance from the value to an end of its interval, over the value; `None`
    /// without an interval.
    #[must_use]
    pub fn relative_error(&self) -> Option<f64> {
        let [lower, upper] = *self.interval.as_ref().ok()?;
        Some((upper - self.value).max(self.value - lower) / self.value.abs())
    }
}

/// Reason why a parameter has no standard error or no interval.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Undetermined {
    /// Fixed parameter.
    Fixed,
    /// Parameter at this bound, in its unit: the minimum lies beyond.
    AtBound(f64),
    /// Parameter that can change together with these others, or alone if there are none, without
    /// any effect.
    Unidentifiable(Vec<&'static str>),
    /// No more points than parameters.
    TooFewPoints,
    /// Law without a derivative by the parameter there.
    NotSmooth,
    /// Interval without an end, or with a profile that could not be followed to the end.
    NoEnd,
}

impl Undetermined {
    /// Converts the `reason` of the minimiser, with the `names` of the parameters.
    pub(crate) fn named(reason: drape_lm::Undetermined, names: &[&'static str]) -> Self {
        match reason {
            drape_lm::Undetermined::Fixed => Self::Fixed,
            drape_lm::Undetermined::AtBound(bound) => Self::AtBound(bound),
            drape_lm::Undetermined::Unidentifiable(others) => {
                Self::Unidentifiable(others.iter().map(|&other| names[other]).collect())
            }
            drape_lm::Undetermined::NoDegreesOfFreedom => Self::TooFewPoints,
            _ => Self::NotSmooth,
        }
    }
}

impl fmt::Display for Undetermined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed => write!(f, "kept fixed"),
            Self::AtBound(bound) => write!(f, "at its bound {bound:.4e}"),
            Self::Unidentifiable(others) if others.is_empty() => {
                write!(f, "without effect on the curve")
            }
            Self::Unidentifiable(others) => {
                write!(f, "not told apart from {}", others.join(", "))
            }
            Self::TooFewPoints => write!(f, "too few points"),
            Self::NotSmooth => write!(f, "the law has no derivative there"),
            Self::NoEnd => write!(f, "the curve sets it no end"),
        }
    }
}
