//! How well the data determine the parameters, from the linear model at the minimum.

use nalgebra::{DMatrix, DVector};

use super::jacobian::Difference;
use super::search::Search;
use super::{Loss, Parameter, Problem, Report, student_quantile};

/// Singular value of the derivatives, all scaled to length one, below which a direction has no effect.
///
/// Central differences are good to ten digits, so anything smaller may be their error. A fit that needs more
/// has standard errors a thousand million times those of its best parameter, and is no fit.
const RANK: f64 = 1e-9;
/// Part of a parameter in a direction without effect from which on it counts as undetermined.
///
/// In a direction that mixes parameters the parts are of order one; rounding mixes in 1e-7 of the others.
const PART: f64 = 1e-3;
/// Steps of the singular value decomposition's own iteration, far more than it needs.
const ROTATIONS: usize = 10_000;

/// Why a parameter has no standard error or no interval.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Undetermined {
    /// It was kept fixed.
    Fixed,
    /// It ended at this bound: the data want it beyond, and the error around the bound is not symmetric.
    AtBound(f64),
    /// It can change together with these others (or alone, if there are none) without any effect on the
    /// residuals: fix one of them, or measure something that tells them apart.
    Unidentifiable(Vec<usize>),
    /// There are not more residuals than free parameters, or the level is none.
    NoFreedom,
    /// The model has no derivative at the minimum.
    NotFinite,
}

/// Standard errors and correlations of fitted parameters.
///
/// ```math
/// C = s^2 (J^T J)^{-1}, \qquad s^2 = \frac{\sum_i w_i r_i^2}{n - p}
/// ```
///
/// from the singular values of `$J$`, whose columns are first scaled to length one. Parameters that are fixed
/// or at a bound are taken as known. Directions without effect are left out, and the parameters that take
/// part in them have no error but a reason. With a loss that is not least squares
/// the variance `$s^2$` is `$K^2\,\frac{\sum\psi^2/(n-p)}{\overline{\psi'}^2}$` with
/// `$K = 1 + \frac{p}{n}\,\mathrm{var}(\psi')/\overline{\psi'}^2$` [Huber 1981, §7.6].
///
/// It holds for residuals that are independent, of one variance after weighting, and a model that is nearly
/// linear over the errors; where it is not, [`super::profile`] shows it. Where a model misses its data
/// systematically the errors come out too small.
#[derive(Clone, Debug, PartialEq)]
pub struct Covariance {
    /// Standard deviation of a residual of weight one, in the unit of the residuals.
    pub deviation: f64,
    /// Residuals with a weight less the parameters that the data determine.
    pub degrees: usize,
    /// Smallest singular value over the largest, of the scaled derivatives by the free parameters.
    pub conditioning: f64,
    /// Rise of the sum of the losses, over the variance, where a parameter is one standard error off.
    rise: f64,
    /// Errors of the parameters if all others were known.
    alone: Vec<f64>,
    matrix: DMatrix<f64>,
    undetermined: Vec<Option<Undetermined>>,
}

impl Covariance {
    /// The covariance at the end of a minimisation with some loss.
    pub fn of(
        problem: &impl Problem,
        parameters: &[Parameter],
        report: &Report,
        loss: Loss,
    ) -> Self {
        let n = parameters.len().min(report.parameters.len());
        let mut covariance = Self {
            deviation: f64::NAN,
            degrees: 0,
            conditioning: 0.0,
            rise: 1.0,
            alone: vec![0.0; n],
            matrix: DMatrix::zeros(n, n),
            undetermined: vec![Some(Undetermined::NotFinite); n],
        };
        let parameters = &parameters[..n];
        let at = &report.parameters[..n];
        for (j, parameter) in parameters.iter().enumerate() {
            if parameter.is_fixed() {
                covariance.undetermined[j] = Some(Undetermined::Fixed);
            } else if at[j] <= parameter.lower || at[j] >= parameter.upper {
                covariance.undetermined[j] = Some(Undetermined::AtBound(at[j]));
            }
        }
        let mut search = Search::new(problem, parameters, at, loss);
        search.difference = Difference::Central;
        let jacobian = search.differentiate().clone();
        covariance.fill(&jacobian, &search.residuals, problem.weights(), loss);
        covariance
    }

    fn fill(
        &mut self,
        jacobian: &DMatrix<f64>,
        residuals: &DVector<f64>,
        weights: &[f64],
        loss: Loss,
    ) {
        let finite = |values: &DMatrix<f64>| values.iter().all(|value| value.is_finite());
        if !finite(jacobian) || !residuals.iter().all(|r| r.is_finite()) {
            return;
        }
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
        // Rows of zeros complete the singular vectors where there are fewer residuals than parameters.
        let rows = scaled.nrows().max(free.len());
        let scaled = scaled.resize_vertically(rows, 0.0);
        let triangle = if free.is_empty() { scaled } else { scaled.qr().r() };
        let (mut singular, mut v_t) = (DVector::zeros(0), DMatrix::zeros(0, 0));
        if !free.is_empty() {
            let Some(svd) = triangle.try_svd(false, true, f64::EPSILON, ROTATIONS) else {
                return;
            };
            let Some(vectors) = svd.v_t else { return };
            (singular, v_t) = (svd.singular_values, vectors);
            self.conditioning = singular.min() / singular.max();
        }
        let floor = RANK * singular.iter().copied().fold(0.0, f64::max);
        let effect: Vec<bool> = singular.iter().map(|s| *s > floor).collect();
        let rank = effect.iter().filter(|effect| **effect).count();
        let idle = |weight: &&f64| **weight == 0.0;
        let count = residuals.len() - weights.iter().take(residuals.len()).filter(idle).count();
        self.degrees = count.saturating_sub(rank);
        if self.degrees == 0 {
            for &j in &free {
                self.undetermined[j] = Some(Undetermined::NoFreedom);
            }
            return;
        }
        (self.deviation, self.rise) = deviation(residuals, (count, rank), loss);
        if !(self.deviation >= 0.0 && self.deviation.is_finite()) {
            return;
        }
        for (alone, column) in self.alone.iter_mut().zip(jacobian.column_iter()) {
            *alone = self.deviation / column.norm();
        }
        for (a, &i) in free.iter().enumerate() {
            for (b, &j) in free.iter().enumerate() {
                let terms = (0..singular.len()).filter(|&k| effect[k]);
                let inverse: f64 =
                    terms.map(|k| v_t[(k, a)] * v_t[(k, b)] / singular[k].powi(2)).sum();
                self.matrix[(i, j)] = inverse * self.deviation.powi(2) / (norms[a] * norms[b]);
            }
            let mut others = Vec::new();
            let mut takes_part = false;
            for k in (0..singular.len()).filter(|&k| !effect[k] && v_t[(k, a)].abs() > PART) {
                takes_part = true;
                others.extend((0..free.len()).filter(|&b| b != a && v_t[(k, b)].abs() > PART));
            }
            others.sort_unstable();
            others.dedup();
            let others = others.into_iter().map(|b| free[b]).collect();
            self.undetermined[i] = takes_part.then_some(Undetermined::Unidentifiable(others));
        }
    }

    /// Why a parameter is not determined; nothing where it is.
    #[must_use]
    pub fn reason(&self, parameter: usize) -> Option<&Undetermined> {
        self.undetermined.get(parameter)?.as_ref()
    }

    /// Standard error of a parameter, in its unit.
    ///
    /// # Errors
    /// Why it has none.
    pub fn standard_error(&self, parameter: usize) -> Result<f64, Undetermined> {
        match self.undetermined.get(parameter) {
            Some(None) => Ok(self.matrix[(parameter, parameter)].sqrt()),
            Some(Some(reason)) => Err(reason.clone()),
            None => Err(Undetermined::Fixed),
        }
    }

    /// Covariance of two parameters, in the product of their units; nothing where one is not determined.
    #[must_use]
    pub fn covariance(&self, i: usize, j: usize) -> Option<f64> {
        let known = |k: usize| matches!(self.undetermined.get(k), Some(None));
        (known(i) && known(j)).then(|| self.matrix[(i, j)])
    }

    /// Correlation of two parameters, a ratio from −1 to 1; nothing where one is not determined.
    #[must_use]
    pub fn correlation(&self, i: usize, j: usize) -> Option<f64> {
        let covariance = self.covariance(i, j)?;
        let errors = (self.matrix[(i, i)] * self.matrix[(j, j)]).sqrt();
        Some(if errors > 0.0 { (covariance / errors).clamp(-1.0, 1.0) } else { f64::from(i == j) })
    }

    /// Standard error of a parameter if all others were known: never larger than its own, and there at a bound.
    pub(super) fn error_alone(&self, parameter: usize) -> f64 {
        self.alone[parameter]
    }

    /// Rise of the sum of the losses where a parameter is one standard error off and the others follow.
    pub(super) fn rise_of_one_deviation(&self) -> f64 {
        self.rise * self.deviation.powi(2)
    }

    /// Half the width of the interval around the estimate of a parameter at a level such as 0.95, in the
    /// parameter's unit.
    ///
    /// # Errors
    /// Why it has none.
    pub fn half_width(&self, parameter: usize, level: f64) -> Result<f64, Undetermined> {
        Ok(self.standard_error(parameter)? * student_quantile(level, self.degrees))
    }

    /// Standard error of a function of the parameters from its derivatives by them, in the function's unit.
    ///
    /// # Errors
    /// Why the first parameter that matters and is not determined has no error. Fixed parameters have none
    /// to pass on.
    pub fn error_of(&self, gradient: &[f64]) -> Result<f64, Undetermined> {
        let mut variance = 0.0;
        let slopes = || gradient.iter().enumerate().filter(|(_, slope)| **slope != 0.0);
        for (i, a) in slopes() {
            match self.standard_error(i) {
                Ok(_) => {}
                Err(Undetermined::Fixed) => continue,
                Err(reason) => return Err(reason),
            }
            for (j, b) in slopes() {
                variance += a * b * self.covariance(i, j).unwrap_or(0.0);
            }
        }
        Ok(variance.max(0.0).sqrt())
    }
}

/// Standard deviation of a residual of weight one, from those of count less rank that are left to chance, and
/// the mean slope of the influence.
fn deviation(residuals: &DVector<f64>, (count, rank): (usize, usize), loss: Loss) -> (f64, f64) {
    let influence = |r: &f64| (r * loss.weight(*r)).powi(2);
    let square: f64 = residuals.iter().map(influence).sum();
    let spread = (square / (count - rank) as f64).sqrt();
    if loss == Loss::Squares {
        return (spread, 1.0);
    }
    let slopes = || residuals.iter().map(|r| loss.influence_slope(*r));
    // Residuals without weight are zero, and would count as one each.
    let idle = (residuals.len() - count) as f64;
    let mean = (slopes().sum::<f64>() - idle) / count as f64;
    let mean_square = (slopes().map(|slope| slope * slope).sum::<f64>() - idle) / count as f64;
    let variance = mean_square / (mean * mean) - 1.0;
    let correction = 1.0 + rank as f64 / count as f64 * variance;
    (correction * spread / mean, mean)
}
