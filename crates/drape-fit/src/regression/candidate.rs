//! Law that was compared with others on one curve, and the reason of the selection.

use std::fmt;

/// Law that was compared with others on one curve.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Candidate {
    /// Name of the law, in words.
    pub law: String,
    /// Number of fitted parameters.
    pub parameters: usize,
    /// Root mean square residual over the range of the load, without weights; a ratio.
    pub misfit: f64,
    /// Akaike's corrected criterion, [`drape_lm::akaike`]; `None` if there are too few points.
    ///
    /// Its logarithm counts the independent residuals (`CurveFit::effective_points`) of the
    /// candidate with the smallest residual, not all: the quasi-likelihood criterion of \[BA02,
    /// §2.5\]. Residuals of a law that misses the curve systematically are correlated, and each
    /// would vote for any law with more parameters. For independent noise both are the same. Where
    /// even the best law misses the curve, so few residuals are independent that the criterion can
    /// hardly tell laws apart: there [`Candidate::SMALLER`] decides.
    pub criterion: Option<f64>,
    /// Root mean square error, over the range of the load, of the prediction of the last cycle from
    /// all others; `None` where there is one cycle.
    ///
    /// A law is selected only if it predicts better than all laws of higher preference.
    pub prediction: Option<f64>,
}

impl Candidate {
    /// Lead in Akaike's criterion that a law of lower preference must have.
    ///
    /// A lead of four to seven leaves the other law considerably less support \[BA02, §2.6\]. The
    /// criterion alone selects a second friction element that is not there in one of six noisy
    /// loops, because its length is free to fit the noise; with this lead it is one in a hundred.
    pub const LEAD: f64 = 6.0;

    /// Ratio of the misfits of two laws below which the law with the smaller misfit is certainly
    /// better, if both misfits are larger than the noise of the load.
    ///
    /// The laws compared have one or two parameters more or less, each of which reduces the misfit
    /// of a curve of a hundred points by half a per cent if it fits nothing but noise. A fifth is
    /// the structure of the curve.
    pub const SMALLER: f64 = 0.8;

    /// Largest misfit of a law that follows a curve, a ratio.
    ///
    /// It is the residual error of the laws on woven fabrics \[NB04\]. Repeated tests of one fabric
    /// scatter by some 5 %.
    pub const FOLLOWS: f64 = 0.02;

    /// Returns whether the law follows the curve: its `misfit` is at most [`Candidate::FOLLOWS`].
    #[must_use]
    pub fn follows(&self) -> bool {
        self.misfit <= Self::FOLLOWS
    }

    /// Returns whether the law predicts the last cycle worse than `other`.
    pub(crate) fn predicts_worse(&self, other: &Self) -> bool {
        other.prediction.is_some() && self.prediction > other.prediction
    }
}

/// Reason why a law was selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Choice {
    /// It is the only law.
    Only,
    /// It is the first, in the order of preference, whose criterion is within [`Candidate::LEAD`]
    /// of the smallest, of those that predict better than all before them.
    Supported,
    /// Its misfit is larger than the noise, and less than [`Candidate::SMALLER`] times the misfit
    /// of the law that the criterion supports.
    Closer,
    /// It is the first that follows the curve, [`Candidate::follows`].
    Follows,
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Only => write!(f, "it is the only law"),
            Self::Supported => write!(
                f,
                "of the laws whose AICc is at most {} above the best, it is the first in the order of \
                 preference that predicts a last cycle no worse than the others",
                Candidate::LEAD
            ),
            Self::Closer => write!(
                f,
                "its misfit is smaller by more than a fifth than that of the law with the best AICc, \
                 and is not noise"
            ),
            Self::Follows => write!(
                f,
                "it is the first, in the order of preference, with a misfit of at most {:.0} %",
                100.0 * Candidate::FOLLOWS
            ),
        }
    }
}
