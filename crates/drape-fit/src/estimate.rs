//! A fitted parameter with what is known of its precision.

use std::fmt;

use drape_lm as lm;

/// A fitted parameter, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Its name.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its standard error, or why it has none.
    ///
    /// It is the one for noise of one size at all points, whatever the weights, and it is widened where the
    /// residuals of neighbouring points are alike ([`CurveFit::independent`](crate::CurveFit::independent)).
    pub error: Result<f64, Unknown>,
    /// Its 95 % interval, or why it has none.
    pub interval: Result<[f64; 2], Unknown>,
    /// The value with all points counting alike: the difference to `value` is the effect of the weights.
    pub unweighted: f64,
}

impl Estimate {
    /// Whether the interval has both signs, or is missing: the data do not bear the parameter out.
    #[must_use]
    pub fn is_doubtful(&self) -> bool {
        self.interval.as_ref().map_or(true, |[lower, upper]| lower * upper <= 0.0)
    }
}

/// Why a parameter has no standard error or no interval.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unknown {
    /// It was kept fixed.
    Fixed,
    /// It ended at this bound, in its unit: the data want it beyond.
    AtBound(f64),
    /// It can change together with these others, or alone if there are none, without any effect.
    Unidentifiable(Vec<&'static str>),
    /// There are not more points than parameters.
    TooFewPoints,
    /// The law has no derivative by it there.
    NotSmooth,
    /// The data set it no end, or its profile could not be followed to the end.
    NoEnd,
}

impl Unknown {
    pub(crate) fn new(reason: lm::Undetermined, names: &[&'static str]) -> Self {
        match reason {
            lm::Undetermined::Fixed => Self::Fixed,
            lm::Undetermined::AtBound(bound) => Self::AtBound(bound),
            lm::Undetermined::Unidentifiable(others) => {
                Self::Unidentifiable(others.iter().map(|&other| names[other]).collect())
            }
            lm::Undetermined::NoDegreesOfFreedom => Self::TooFewPoints,
            _ => Self::NotSmooth,
        }
    }
}

impl fmt::Display for Unknown {
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
