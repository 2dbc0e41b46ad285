//! Standard errors and correlations of the parameters from the linear model at the minimum.
//!
//! [`Covariance`] takes the report of `minimise`. `profile` starts from a [`Covariance`].

use nalgebra::{DMatrix, DVector};

use crate::difference::Difference;
use crate::iterate::Iterate;
use crate::loss::Loss;
use crate::minimise::Report;
use crate::problem::{Parameter, Problem};
use crate::student::student_quantile;

/// Singular value, over the largest one, below which a direction in the space of the parameters has
/// no effect. The columns of the Jacobian are first scaled to length one.
///
/// Central differences are good to ten digits, so a smaller singular value may be their error. If a
/// fit depended on a smaller one, its worst standard error would be a thousand million times its
/// best.
const RANK: f64 = 1e-9;
/// A parameter is undetermined if its component in a direction without effect is larger than this.
///
/// In a direction that mixes parameters the components are of order one. Rounding adds components
/// of order 1e-7.
const COMPONENT: f64 = 1e-3;

/// Reason why a parameter has no standard error or no interval.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Undetermined {
    /// Fixed parameter.
    #[error("the parameter is fixed")]
    Fixed,
    /// Parameter at this bound. The minimum lies beyond the bound, and the error around the bound
    /// is not symmetric.
    #[error("the parameter is at its bound {0:e}")]
    AtBound(f64),
    /// Parameter that can change together with the listed parameters without any effect on the
    /// residuals. If the list is empty, the parameter can change alone. Fix one of the parameters,
    /// or measure something that separates them.
    #[error("the data do not separate the parameter from parameters {0:?}")]
    Unidentifiable(Vec<usize>),
    /// No more residuals than free parameters, or a level that is not between 0 and 1.
    #[error("there are too few residuals, or the level is not between 0 and 1")]
    NoDegreesOfFreedom,
    /// Report of a fit with this other number of parameters.
    #[error("the report is of a fit with {0} parameters")]
    OtherFit(usize),
    /// Model without a derivative at the minimum.
    #[error("the model has no derivative at the minimum")]
    NotFinite,
}

/// Standard errors and correlations of fitted parameters.
///
/// Parameters are named by their index in the list that was minimised, from 0.
///
/// ```math
/// C = s^2 (J^T J)^{-1}, \qquad s^2 = \frac{\sum_i w_i r_i^2}{n - p}
/// ```
///
/// The inverse comes from the singular values of `$J$`, whose columns are first scaled to length
/// one \[Bat88, §2.2\]. Parameters that are fixed or at a bound are taken as known. Directions
/// without effect are left out, and the parameters that take part in such a direction have a reason
/// in place of an error. With a robust loss the variance `$s^2$` is
/// `$K^2\,\frac{\sum\psi^2/(n-p)}{\overline{\psi'}^2}$` with
/// `$K = 1 + \frac{p}{n}\,\mathrm{var}(\psi')/\overline{\psi'}^2$` \[Hub81, §7.6\].
///
/// The errors hold if the weighted residuals are independent and have one variance, and if the
/// model is nearly linear over the errors. [`profile`](crate::profile()) shows where the model is
/// not. Where a model misses its data systematically, the errors come out too small.
///
/// ```
/// # use drape_lm::{Covariance, Loss, Parameter, Problem, MinimiserSettings, minimise};
/// # struct Mean([f64; 4]);
/// # impl Problem for Mean {
/// #     fn residual_count(&self) -> usize { 4 }
/// #     fn residuals(&self, p: &[f64], out: &mut [f64]) {
/// #         for (r, y) in out.iter_mut().zip(self.0) { *r = p[0] - y; }
/// #     }
/// # }
/// // The mean of four measurements: its error is their standard deviation over √4.
/// let problem = Mean([1.0, 2.0, 3.0, 4.0]);
/// let start = [Parameter::new(0.0)];
/// let report = minimise(&problem, &start, &MinimiserSettings::default());
/// let covariance = Covariance::new(&problem, &start, &report, Loss::Squares);
/// let error = covariance.standard_error(0)?;
/// assert!((error - (5.0f64 / 3.0).sqrt() / 2.0).abs() < 1e-9);
/// # Ok::<(), drape_lm::Undetermined>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Covariance {
    /// Standard deviation of a residual of weight one, in the unit of the residuals.
    pub residual_deviation: f64,
    /// Number of residuals with a nonzero weight, less the rank of the Jacobian.
    pub degrees_of_freedom: usize,
    /// Reciprocal condition number of the scaled Jacobian of the free parameters, a ratio.
    pub reciprocal_condition: f64,
    /// Rise of the sum of the losses, over the variance, if a parameter is one standard error off.
    rise: f64,
    /// Standard error of each parameter if all other parameters are known.
    conditional: Vec<f64>,
    /// Covariances of the parameters. An entry counts only if both parameters are determined.
    matrix: DMatrix<f64>,
    /// Reason why each parameter is undetermined, if it is.
    undetermined: Vec<Option<Undetermined>>,
}

impl Covariance {
    /// Computes the covariance of `parameters` at the minimum in `report`, which [`minimise`] found
    /// with `loss`. With the report of a fit that has another number of parameters, every parameter
    /// is [`Undetermined::OtherFit`].
    ///
    /// [`minimise`]: crate::minimise()
    #[must_use]
    pub fn new(
        problem: &(impl Problem + ?Sized),
        parameters: &[Parameter],
        report: &Report,
        loss: Loss,
    ) -> Self {
        let n = parameters.len();
        let mut covariance = Self {
            residual_deviation: f64::NAN,
            degrees_of_freedom: 0,
            reciprocal_condition: 0.0,
            rise: 1.0,
            conditional: vec![0.0; n],
            matrix: DMatrix::zeros(n, n),
            undetermined: vec![Some(Undetermined::NotFinite); n],
        };
        let values = &report.parameters;
        if values.len() != n {
            covariance.undetermined.fill(Some(Undetermined::OtherFit(values.len())));
            return covariance;
        }

        // A parameter that is fixed or at a bound is taken as known.
        for (j, parameter) in parameters.iter().enumerate() {
            if parameter.is_fixed() {
                covariance.undetermined[j] = Some(Undetermined::Fixed);
            } else if values[j] <= parameter.lower || values[j] >= parameter.upper {
                covariance.undetermined[j] = Some(Undetermined::AtBound(values[j]));
            }
        }

        let mut iterate = Iterate::new(problem, parameters, values, loss);
        iterate.difference = Difference::Central;
        let jacobian = iterate.differentiate().clone();
        covariance.fill(&jacobian, &iterate.residuals, problem.weights(), loss);
        covariance
    }

    /// Fills in the errors and the reasons, from the weighted `jacobian` and `residuals`.
    ///
    /// The reason [`Undetermined::NotFinite`] marks the parameters that are free.
    fn fill(
        &mut self,
        jacobian: &DMatrix<f64>,
        residuals: &DVector<f64>,
        weights: &[f64],
        loss: Loss,
    ) {
        /// Limit on the iterations of the singular value decomposition, far more than it needs.
        const SVD_ITERATIONS: usize = 10_000;

        if !jacobian.iter().chain(residuals.iter()).all(|value| value.is_finite()) {
            return;
        }

        // The columns of the free parameters are scaled to length one, so that the singular values
        // do not depend on the units of the parameters.
        let free: Vec<usize> = (0..self.undetermined.len())
            .filter(|&j| self.undetermined[j] == Some(Undetermined::NotFinite))
            .collect();
        let norms: Vec<f64> = free.iter().map(|&j| jacobian.column(j).norm()).collect();
        let mut scaled = jacobian.select_columns(&free);
        for (mut column, norm) in scaled.column_iter_mut().zip(&norms) {
            if *norm > 0.0 {
                column.unscale_mut(*norm);
            }
        }

        // Rows of zeros complete the singular vectors if there are fewer residuals than parameters.
        let rows = scaled.nrows().max(free.len());
        let scaled = scaled.resize_vertically(rows, 0.0);
        let triangle = if free.is_empty() { scaled } else { scaled.qr().r() };
        let (mut singular, mut v_t) = (DVector::zeros(0), DMatrix::zeros(0, 0));
        if !free.is_empty() {
            let Some(svd) = triangle.try_svd(false, true, f64::EPSILON, SVD_ITERATIONS) else {
                return;
            };
            let Some(vectors) = svd.v_t else { return };
            (singular, v_t) = (svd.singular_values, vectors);
            self.reciprocal_condition = singular.min() / singular.max();
        }

        let floor = RANK * singular.iter().copied().fold(0.0, f64::max);
        let has_effect: Vec<bool> = singular.iter().map(|s| *s > floor).collect();
        let rank = has_effect.iter().filter(|has_effect| **has_effect).count();
        let weights = weights.iter().take(residuals.len());
        let count = residuals.len() - weights.filter(|weight| **weight == 0.0).count();
        self.degrees_of_freedom = count.saturating_sub(rank);
        if self.degrees_of_freedom == 0 {
            for &j in &free {
                self.undetermined[j] = Some(Undetermined::NoDegreesOfFreedom);
            }
            return;
        }

        let spread = Spread::new(residuals, Counts { residuals: count, rank }, loss);
        (self.residual_deviation, self.rise) = (spread.deviation, spread.influence_slope);
        if !(self.residual_deviation >= 0.0 && self.residual_deviation.is_finite()) {
            return;
        }
        for (error, column) in self.conditional.iter_mut().zip(jacobian.column_iter()) {
            *error = self.residual_deviation / column.norm();
        }

        for (a, &i) in free.iter().enumerate() {
            for (b, &j) in free.iter().enumerate() {
                let terms = (0..singular.len()).filter(|&k| has_effect[k]);
                let inverse: f64 =
                    terms.map(|k| v_t[(k, a)] * v_t[(k, b)] / singular[k].powi(2)).sum();
                self.matrix[(i, j)] =
                    inverse * self.residual_deviation.powi(2) / (norms[a] * norms[b]);
            }

            // The partners are the parameters that change together with `i` without any effect.
            let mut partners = Vec::new();
            let mut takes_part = false;
            for k in (0..singular.len()).filter(|&k| !has_effect[k]) {
                if v_t[(k, a)].abs() > COMPONENT {
                    takes_part = true;
                    let columns = (0..free.len()).filter(|&b| b != a);
                    let mixed = columns.filter(|&b| v_t[(k, b)].abs() > COMPONENT);
                    partners.extend(mixed.map(|b| free[b]));
                }
            }
            partners.sort_unstable();
            partners.dedup();
            self.undetermined[i] = takes_part.then_some(Undetermined::Unidentifiable(partners));
        }
    }

    /// Returns the reason why `parameter` is undetermined, or `None` if it is determined.
    #[must_use]
    pub fn undetermined(&self, parameter: usize) -> Option<&Undetermined> {
        self.undetermined.get(parameter)?.as_ref()
    }

    /// Returns the standard error of `parameter`, in the unit of the parameter.
    ///
    /// # Errors
    /// [`Undetermined`], with the reason, if `parameter` has no standard error.
    pub fn standard_error(&self, parameter: usize) -> Result<f64, Undetermined> {
        match self.undetermined.get(parameter) {
            Some(None) => Ok(self.matrix[(parameter, parameter)].sqrt()),
            Some(Some(reason)) => Err(reason.clone()),
            None => Err(Undetermined::Fixed),
        }
    }

    /// Returns the covariance of the parameters `i` and `j`, in the product of their units, or
    /// `None` if one of them is undetermined.
    #[must_use]
    pub fn covariance(&self, i: usize, j: usize) -> Option<f64> {
        let determined = [i, j].iter().all(|k| matches!(self.undetermined.get(*k), Some(None)));
        determined.then(|| self.matrix[(i, j)])
    }

    /// Returns the correlation of the parameters `i` and `j`, a ratio from −1 to 1, or `None` if
    /// one of them is undetermined.
    #[must_use]
    pub fn correlation(&self, i: usize, j: usize) -> Option<f64> {
        let covariance = self.covariance(i, j)?;
        let errors = (self.matrix[(i, i)] * self.matrix[(j, j)]).sqrt();
        Some(if errors > 0.0 { (covariance / errors).clamp(-1.0, 1.0) } else { f64::from(i == j) })
    }

    /// Returns the standard error that `parameter` has if all other parameters are known.
    ///
    /// The error is never larger than [`Covariance::standard_error`], and also exists at a bound.
    pub(crate) fn conditional_error(&self, parameter: usize) -> f64 {
        self.conditional[parameter]
    }

    /// Returns the rise of the sum of the losses if a parameter is one standard error off and all
    /// other parameters are fitted again. The rise is that large for every parameter.
    pub(crate) fn rise_of_one_deviation(&self) -> f64 {
        self.rise * self.residual_deviation.powi(2)
    }

    /// Returns half the width of the interval that contains the true value of `parameter` with the
    /// probability `level`, in the unit of the parameter.
    ///
    /// # Errors
    /// [`Undetermined`], with the reason, if `parameter` has no standard error.
    pub fn half_width(&self, parameter: usize, level: f64) -> Result<f64, Undetermined> {
        Ok(self.standard_error(parameter)? * student_quantile(level, self.degrees_of_freedom))
    }

    /// Returns the standard error of a function of the parameters from the `gradient` of this
    /// function, in the unit of the function. Fixed parameters contribute no error.
    ///
    /// # Errors
    /// [`Undetermined`], with the reason, for the first parameter that is undetermined and has a
    /// nonzero entry in `gradient`.
    pub fn propagated_error(&self, gradient: &[f64]) -> Result<f64, Undetermined> {
        let mut variance = 0.0;
        let slopes: Vec<(usize, f64)> =
            gradient.iter().copied().enumerate().filter(|(_, slope)| *slope != 0.0).collect();
        for &(i, a) in &slopes {
            match self.standard_error(i) {
                Ok(_) => {}
                Err(Undetermined::Fixed) => continue,
                Err(reason) => return Err(reason),
            }
            for &(j, b) in &slopes {
                variance += a * b * self.covariance(i, j).unwrap_or(0.0);
            }
        }
        Ok(variance.max(0.0).sqrt())
    }
}

/// Numbers from which the degrees of freedom follow.
#[derive(Clone, Copy)]
struct Counts {
    /// Number of residuals with a nonzero weight.
    residuals: usize,
    /// Rank of the Jacobian.
    rank: usize,
}

/// Spread of the residuals under a loss.
struct Spread {
    /// Standard deviation of a residual of weight one.
    deviation: f64,
    /// Mean slope of the influence function.
    influence_slope: f64,
}

impl Spread {
    /// Computes the spread of the weighted `residuals` under `loss` \[Hub81, §7.6\].
    fn new(residuals: &DVector<f64>, counts: Counts, loss: Loss) -> Self {
        let Counts { residuals: count, rank } = counts;
        let square: f64 = residuals.iter().map(|r| (r * loss.weight(*r)).powi(2)).sum();
        let spread = (square / (count - rank) as f64).sqrt();
        if loss == Loss::Squares {
            return Self { deviation: spread, influence_slope: 1.0 };
        }

        // A residual with zero weight is zero, where the influence function has the slope one.
        let idle = (residuals.len() - count) as f64;
        let slopes = residuals.iter().map(|r| loss.influence_slope(*r));
        let squared_slopes = slopes.clone().map(|slope| slope * slope);
        let mean = (slopes.sum::<f64>() - idle) / count as f64;
        let mean_square = (squared_slopes.sum::<f64>() - idle) / count as f64;
        let variance = mean_square / (mean * mean) - 1.0;
        let correction = 1.0 + rank as f64 / count as f64 * variance;
        Self { deviation: correction * spread / mean, influence_slope: mean }
    }
}
