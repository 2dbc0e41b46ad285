//! Refusal of input that no minimisation can begin with.
//!
//! `minimise` checks the parameters and the weights before it evaluates the residuals.

use std::fmt;

use crate::problem::{Parameter, Problem};

/// Reason why an input is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum InvalidInput {
    /// Lower bound above the upper bound.
    ReversedBounds,
    /// Bound that is not a number, a lower bound of +∞, or an upper bound of −∞.
    BoundNotANumber,
    /// Start that is not a number, or an infinite start that no bound makes finite.
    StartNotFinite,
    /// Scale that is not a positive finite number.
    ScaleNotPositive,
    /// List of weights that is neither empty nor as long as the list of residuals.
    WeightCount,
    /// Weight that is negative or not finite.
    WeightNotFinite,
}

impl fmt::Display for InvalidInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ReversedBounds => "the lower bound is above the upper bound",
            Self::BoundNotANumber => "a bound is not a number, or leaves no number",
            Self::StartNotFinite => "the start is not a finite number",
            Self::ScaleNotPositive => "the scale is not a positive finite number",
            Self::WeightCount => "there are fewer or more weights than residuals",
            Self::WeightNotFinite => "a weight is negative or not a finite number",
        })
    }
}

/// Input that is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Refusal {
    /// Index of the parameter that is refused, or `None` if weights are refused.
    pub(crate) parameter: Option<usize>,
    pub(crate) reason: InvalidInput,
}

/// Returns the first mistake in `parameters` and in the weights of `problem`, or `None` if there is
/// none.
pub(crate) fn refusal(
    problem: &(impl Problem + ?Sized),
    parameters: &[Parameter],
) -> Option<Refusal> {
    for (index, parameter) in parameters.iter().enumerate() {
        if let Some(reason) = parameter_mistake(parameter) {
            return Some(Refusal { parameter: Some(index), reason });
        }
    }
    let reason = weight_mistake(problem.weights(), problem.residual_count())?;
    Some(Refusal { parameter: None, reason })
}

/// Returns what is wrong with `parameter`, if anything is.
fn parameter_mistake(parameter: &Parameter) -> Option<InvalidInput> {
    let Parameter { start, lower, upper, scale } = *parameter;
    if lower.is_nan() || upper.is_nan() || lower == f64::INFINITY || upper == f64::NEG_INFINITY {
        return Some(InvalidInput::BoundNotANumber);
    }
    if lower > upper {
        return Some(InvalidInput::ReversedBounds);
    }
    if start.is_nan() || !parameter.clamp(start).is_finite() {
        return Some(InvalidInput::StartNotFinite);
    }
    let is_positive = scale > 0.0 && scale.is_finite();
    (!is_positive).then_some(InvalidInput::ScaleNotPositive)
}

/// Returns what is wrong with the `weights` of `residual_count` residuals, if anything is.
fn weight_mistake(weights: &[f64], residual_count: usize) -> Option<InvalidInput> {
    if !weights.is_empty() && weights.len() != residual_count {
        return Some(InvalidInput::WeightCount);
    }
    let are_weights = weights.iter().all(|weight| *weight >= 0.0 && weight.is_finite());
    (!are_weights).then_some(InvalidInput::WeightNotFinite)
}
