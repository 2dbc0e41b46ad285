//! Standard errors, intervals, correlations and the confidence band of one fit.
//!
//! `curve_fit` and the loop-bending fit call [`uncertainty`] at the end of a search. The covariance
//! itself comes from drape-lm.

use std::ops::Range;

use drape_lm::{
    Covariance, Interval, Loss, Parameter, ProfileSettings, Report, profile, student_quantile,
};
use nalgebra::{DMatrix, DVector};

use crate::regression::estimate::{Estimate, Undetermined};
use crate::regression::residuals::{NamedParameter, PointProblem};
use crate::settings::Intervals;

/// Level of the intervals.
const LEVEL: f64 = 0.95;
/// Step of central differences over the size of the parameter: the cube root of the rounding unit.
const STEP: f64 = 6e-6;
/// Smallest size of a parameter for a step, over its scale.
const LEAST_SIZE: f64 = 0.01;
/// Correlation of neighbours, times the root of the number of points, below which the points count
/// as independent.
///
/// Chance exceeds it in one of forty curves of independent noise.
const CHANCE: f64 = 2.0;

/// Ratio of bounds above which a parameter is estimated on the logarithmic scale.
///
/// It is two decades; all scale parameters here have more.
const DECADES: f64 = 100.0;

/// Correlation of the residuals, and the number of independent residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Independence {
    /// Correlation of the residuals of neighbouring points.
    pub(crate) correlation: f64,
    /// Number of independent residuals whose mean has the same variance.
    pub(crate) effective_count: f64,
    /// Number of independent residuals whose variance is known as well.
    pub(crate) effective_squares: f64,
}

impl Independence {
    /// Computes the independence of `residuals` in the order of measurement, taken as an
    /// autoregressive process of first order with correlation `$\rho$`.
    ///
    /// `$n(1-\rho)/(1+\rho)$` residuals are independent, and `$n(1-\rho^2)/(1+\rho^2)$` squares
    /// \[Bar35\].
    pub(crate) fn from_residuals(residuals: &[f64]) -> Self {
        let n = residuals.len() as f64;
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let pairs: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        let correlation = if square > 0.0 { pairs / square } else { 0.0 };
        let [effective_count, effective_squares] =
            [correlation, correlation * correlation].map(|kept| {
                if correlation * n.sqrt() > CHANCE { n * (1.0 - kept) / (1.0 + kept) } else { n }
            });
        Self { correlation, effective_count, effective_squares }
    }

    /// Returns the independence of the residuals of a law with the given number of `parameters`: at
    /// least two more residuals than parameters count as independent.
    ///
    /// The residuals of a law that is too stiff for a curve are alike over whole branches, and the
    /// formulas then leave one independent residual of a hundred. A curve that determines six
    /// parameters contains more information.
    pub(crate) fn for_parameters(self, parameters: usize, residuals: usize) -> Self {
        let least = (parameters + 2).min(residuals) as f64;
        Self {
            effective_count: self.effective_count.max(least),
            effective_squares: self.effective_squares.max(least),
            ..self
        }
    }
}

/// End of a search.
pub(crate) struct FitEnd<'a> {
    pub(crate) parameters: &'a [NamedParameter],
    pub(crate) report: &'a Report,
    /// Values of the parameters without weights.
    pub(crate) unweighted: &'a [f64],
}

/// Parameters with their errors and correlations, and the confidence band of the model.
pub(crate) struct Uncertainty {
    pub(crate) estimates: Vec<Estimate>,
    pub(crate) correlations: Vec<Vec<Option<f64>>>,
    /// Half width of the 95 % band of the model at each point, in the unit of the residuals.
    pub(crate) band: Vec<f64>,
    /// Covariances of the parameters; zero for those that are undetermined.
    pub(crate) covariance: DMatrix<f64>,
    /// Half width of a 95 % interval over the standard error.
    pub(crate) quantile: f64,
}

impl Uncertainty {
    /// Returns the uncertainty of some `parameters`, with the band of some `residuals`.
    pub(crate) fn select(
        &self,
        parameters: impl Iterator<Item = usize>,
        residuals: Range<usize>,
    ) -> Self {
        let chosen: Vec<usize> = parameters.collect();
        let correlations = chosen
            .iter()
            .map(|&i| chosen.iter().map(|&j| self.correlations[i][j]).collect())
            .collect();
        Self {
            estimates: chosen.iter().map(|&i| self.estimates[i].clone()).collect(),
            correlations,
            band: self.band[residuals].to_vec(),
            covariance: self.covariance.select_rows(&chosen).select_columns(&chosen),
            quantile: self.quantile,
        }
    }
}

/// Computes the uncertainty of a fit of `problem` at its `end`.
///
/// With residuals `$r$` of one variance and weights `$W$` the covariance is the sandwich estimator
///
/// ```math
/// \sigma^2 A^{-1} B A^{-1}, \qquad A = J^T W J, \quad B = J^T W^2 J
/// ```
///
/// which is `$\sigma^2 (J^TJ)^{-1}$` where all weights are one. A functional `$c$` of the points,
/// whose residual has the weight `$n$`, adds `$n\,cc^T$` to `$W$`.
pub(crate) fn uncertainty(
    problem: &(impl PointProblem + Sync),
    end: &FitEnd<'_>,
    intervals: Intervals,
) -> Uncertainty {
    let report = end.report;
    let parameters: Vec<Parameter> = end.parameters.iter().map(|named| named.parameter).collect();
    let names: Vec<&'static str> = end.parameters.iter().map(|named| named.name).collect();
    let count = parameters.len();

    let mut residuals = vec![0.0; problem.residual_count()];
    problem.residuals(&report.parameters, &mut residuals);
    residuals.truncate(problem.point_count());
    let independence =
        Independence::from_residuals(&residuals).for_parameters(count, residuals.len());

    let covariance = Covariance::new(problem, &parameters, report, Loss::Squares);
    // An undetermined parameter is taken as known.
    let is_determined: Vec<bool> =
        (0..count).map(|j| covariance.undetermined(j).is_none()).collect();
    let jacobian = derivatives(problem, &parameters, &report.parameters, &is_determined);
    let sandwich = sandwich(&covariance, problem, &residuals, &jacobian);
    let widening = residuals.len() as f64 / independence.effective_count;
    let degrees = (independence.effective_squares - count as f64).max(1.0) as usize;
    let quantile = student_quantile(LEVEL, degrees);

    let profiles = (intervals == Intervals::Profile).then(|| {
        let settings = ProfileSettings { level: LEVEL, ..ProfileSettings::default() };
        profile(problem, &parameters, report, &settings)
    });
    let mut estimates = Vec::with_capacity(count);
    for (j, parameter) in parameters.iter().enumerate() {
        let value = report.parameters[j];
        let standard_error = match covariance.standard_error(j) {
            Ok(_) => Ok((widening * sandwich[(j, j)]).max(0.0).sqrt()),
            Err(reason) => Err(Undetermined::named(reason, &names)),
        };
        let half = standard_error.clone().map(|error| error * quantile);
        let interval = match profiles.as_ref().map(|profiles| &profiles[j]) {
            None => half.map(|half| wald_interval(value, half, parameter)),
            Some(Ok(profile)) => {
                // A profile assumes independent residuals without weights.
                let stretch = match (&half, &covariance.half_width(j, LEVEL)) {
                    (Ok(half), Ok(independent)) if *independent > 0.0 => half / independent,
                    _ => widening.sqrt(),
                };
                stretch_interval(profile, value, stretch, parameter)
            }
            Some(Err(reason)) => Err(Undetermined::named(reason.clone(), &names)),
        };
        let (name, unweighted) = (names[j], end.unweighted[j]);
        estimates.push(Estimate { name, value, standard_error, interval, unweighted });
    }

    let mut correlations = vec![vec![None; count]; count];
    for (i, row) in correlations.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            let sizes = (sandwich[(i, i)] * sandwich[(j, j)]).sqrt();
            *entry = covariance.correlation(i, j).map(|independent| {
                if sizes > 0.0 { (sandwich[(i, j)] / sizes).clamp(-1.0, 1.0) } else { independent }
            });
        }
    }
    let covariance = &sandwich * widening;
    Uncertainty {
        estimates,
        correlations,
        band: band(&jacobian, &covariance).map(|error| quantile * error).collect(),
        covariance,
        quantile,
    }
}

/// Returns the standard errors of the model at each residual, from its `jacobian` and the
/// `covariance` of the parameters.
fn band(jacobian: &DMatrix<f64>, covariance: &DMatrix<f64>) -> impl Iterator<Item = f64> {
    let jacobian_covariance = jacobian * covariance;
    let variances = (0..jacobian.nrows()).map(|i| jacobian_covariance.row(i).dot(&jacobian.row(i)));
    variances.map(|variance| variance.max(0.0).sqrt()).collect::<Vec<_>>().into_iter()
}

/// Returns the interval of half the width `half` on either side of `value`, on the logarithmic
/// scale for a scale parameter.
///
/// If a length is known to a half, the search finds twice the length as easily as half the length.
/// The interval on the logarithm contains the truth, while the other interval is too short above
/// and extends below zero.
fn wald_interval(value: f64, half: f64, parameter: &Parameter) -> [f64; 2] {
    if parameter.lower > 0.0 && parameter.upper >= DECADES * parameter.lower {
        let factor = (half / value).exp();
        return [value / factor, value * factor];
    }
    [value - half, value + half]
}

/// Returns the interval of `profile`, with its distances from `value` stretched to the actual
/// noise.
fn stretch_interval(
    profile: &Interval,
    value: f64,
    stretch: f64,
    parameter: &Parameter,
) -> Result<[f64; 2], Undetermined> {
    let mut ends = [0.0; 2];
    for (stretched, end) in ends.iter_mut().zip([&profile.lower, &profile.upper]) {
        let end = end.value().ok_or(Undetermined::NoEnd)?;
        *stretched = (value + stretch * (end - value)).clamp(parameter.lower, parameter.upper);
    }
    Ok(ends)
}

/// Returns the covariance of the parameters for noise of one size at all points; zero for
/// undetermined parameters.
fn sandwich(
    covariance: &Covariance,
    problem: &impl PointProblem,
    residuals: &[f64],
    jacobian: &DMatrix<f64>,
) -> DMatrix<f64> {
    let (count, weights) = (jacobian.ncols(), problem.weights());
    let variance = covariance.residual_deviation.powi(2);
    let mut inverse =
        DMatrix::from_fn(count, count, |i, j| covariance.covariance(i, j).unwrap_or(0.0));
    let plain = weights.is_empty() && problem.functionals().is_empty();
    if plain || !(variance > 0.0 && variance.is_finite()) {
        return inverse;
    }
    inverse /= variance;

    // The product of the weights with the Jacobian.
    let mut weighted = jacobian.clone();
    for (i, weight) in weights.iter().take(residuals.len()).enumerate() {
        weighted.row_mut(i).scale_mut(*weight);
    }
    let weight = problem.functional_weight();
    for functional in problem.functionals() {
        for column in 0..count {
            let slope = functional.slope(|point| jacobian[(point, column)]);
            functional.for_each(|point, c| weighted[(point, column)] += weight * c * slope);
        }
    }

    let middle = weighted.tr_mul(&weighted);
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    let spare = residuals.len().saturating_sub(count).max(1) as f64;
    &inverse * middle * &inverse * (square / spare)
}

/// Returns the derivatives of the residuals of the points by the parameters that are `wanted`; zero
/// by the other parameters.
fn derivatives(
    problem: &impl PointProblem,
    parameters: &[Parameter],
    values: &[f64],
    wanted: &[bool],
) -> DMatrix<f64> {
    let rows = problem.residual_count();
    let mut jacobian = DMatrix::zeros(rows, parameters.len());
    if problem.jacobian(values, &mut jacobian) {
        for (_, mut column) in jacobian.column_iter_mut().enumerate().filter(|(j, _)| !wanted[*j]) {
            column.fill(0.0);
        }
        return jacobian.resize_vertically(problem.point_count(), 0.0);
    }

    let (mut high, mut low) = (DVector::zeros(rows), DVector::zeros(rows));
    let mut trial = values.to_vec();
    for (j, parameter) in parameters.iter().enumerate().filter(|(j, _)| wanted[*j]) {
        let step = STEP * values[j].abs().max(LEAST_SIZE * parameter.scale);
        let ends = [values[j] + step, values[j] - step]
            .map(|end| end.clamp(parameter.lower, parameter.upper));
        for (end, out) in ends.iter().zip([&mut high, &mut low]) {
            trial[j] = *end;
            problem.residuals(&trial, out.as_mut_slice());
        }
        trial[j] = values[j];
        jacobian.set_column(j, &((&high - &low) / (ends[0] - ends[1])));
    }
    jacobian.resize_vertically(problem.point_count(), 0.0)
}

#[cfg(test)]
mod tests {
    use drape_lm::{MinimiserSettings, Problem, minimise};

    use super::*;

    /// Noisy points on a line. Every second one has four times the weight of the others.
    struct Line {
        weights: Vec<f64>,
    }

    impl PointProblem for Line {}

    impl Problem for Line {
        fn residual_count(&self) -> usize {
            self.weights.len()
        }

        fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
            for (i, residual) in out.iter_mut().enumerate() {
                let noise = [0.1, -0.2, 0.3, -0.1, -0.1][i % 5];
                *residual = parameters[0] + (parameters[1] - 1.0) * i as f64 - noise;
            }
        }

        fn weights(&self) -> &[f64] {
            &self.weights
        }
    }

    #[test]
    fn profiles_of_a_weighted_line_are_its_standard_errors() {
        let line = Line { weights: (0..40).map(|i| [1.0, 4.0][i % 2]).collect() };
        let parameters = ["offset", "slope"].map(|name| {
            let parameter = Parameter::new(0.5).between(-10.0, 10.0);
            NamedParameter { name, parameter }
        });
        let own = parameters.each_ref().map(|named| named.parameter);
        let report = minimise(&line, &own, &MinimiserSettings::default());
        let unweighted = &report.parameters;
        let end = FitEnd { parameters: &parameters, report: &report, unweighted };
        let [wald, profile] = [Intervals::Wald, Intervals::Profile]
            .map(|intervals| uncertainty(&line, &end, intervals).estimates);
        for (wald, profile) in wald.iter().zip(&profile) {
            let [wald, profile] =
                [wald, profile].map(|own| own.interval.clone().expect("an interval"));
            let width = wald[1] - wald[0];
            assert!(
                (0..2).all(|k| (wald[k] - profile[k]).abs() < 1e-3 * width),
                "{wald:?} {profile:?}"
            );
        }
    }

    #[test]
    fn neighbours_that_are_alike_count_less() {
        let alternating: Vec<f64> = (0..100).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        assert_eq!(Independence::from_residuals(&alternating).effective_count, 100.0);
        // Each value ten times: nine of ten neighbours are equal.
        let blocks: Vec<f64> =
            (0..100).map(|i| if (i / 10) % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let blocks = Independence::from_residuals(&blocks);
        // 90 pairs of one sign less 9 of the other, of 100.
        assert!((blocks.correlation - 0.81).abs() < 1e-12, "{blocks:?}");
        assert!((blocks.effective_count - 19.0 / 1.81).abs() < 1e-9, "{blocks:?}");
    }
}
