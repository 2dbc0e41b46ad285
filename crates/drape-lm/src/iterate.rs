//! Current point of the iteration with the linear model of its residuals.
//!
//! `minimise` computes steps with an [`Iterate`] and moves it. `covariance` takes the Jacobian at
//! the minimum from it.

use nalgebra::{DMatrix, DVector};

use crate::difference::{Difference, Evaluated};
use crate::loss::Loss;
use crate::problem::{Parameter, Problem};
use crate::trust_region::TrustRegion;

/// Current point, its residuals and their linear model.
pub(crate) struct Iterate<'a, P: ?Sized> {
    problem: &'a P,
    parameters: &'a [Parameter],
    loss: Loss,
    /// Square roots of the weights of the residuals. Empty if every weight is one.
    weight_roots: Vec<f64>,
    /// Values of the parameters.
    pub(crate) values: Vec<f64>,
    /// Residuals times the roots of their weights.
    pub(crate) residuals: DVector<f64>,
    /// Sum of the losses of `residuals`.
    pub(crate) sum: f64,
    /// Jacobian of the least squares problem that has the gradient of the loss.
    jacobian: DMatrix<f64>,
    /// Residuals of this least squares problem, its right-hand side.
    right: DVector<f64>,
    /// Scale of each parameter: the largest norm that its column has had \[Mor78\].
    scale: Vec<f64>,
    /// Indices of the parameters that may move in this step.
    free: Vec<usize>,
    /// Decomposition of the scaled columns of the free parameters, if there are any and all are
    /// finite.
    region: Option<TrustRegion>,
    /// Components of `right` along the left singular vectors of `region`.
    projected: DVector<f64>,
    /// Formula for derivatives that the problem does not compute itself.
    pub(crate) difference: Difference,
    /// Number of evaluations of the residuals.
    pub(crate) evaluations: usize,
}

/// Residuals at a trial point, with the sum of their losses.
pub(crate) struct Trial {
    /// Sum of the losses, infinite if a loss is NaN.
    pub(crate) sum: f64,
    /// Residuals times the roots of their weights.
    pub(crate) residuals: DVector<f64>,
}

impl<'a, P: Problem + ?Sized> Iterate<'a, P> {
    /// Creates the iterate of `problem` at the values `start`, without a linear model yet.
    pub(crate) fn new(
        problem: &'a P,
        parameters: &'a [Parameter],
        start: &[f64],
        loss: Loss,
    ) -> Self {
        let (residual_count, parameter_count) = (problem.residual_count(), parameters.len());
        let mut iterate = Self {
            problem,
            parameters,
            loss,
            weight_roots: problem.weights().iter().take(residual_count).map(|w| w.sqrt()).collect(),
            values: Vec::new(),
            residuals: DVector::zeros(residual_count),
            sum: 0.0,
            jacobian: DMatrix::zeros(residual_count, parameter_count),
            right: DVector::zeros(residual_count),
            scale: vec![0.0; parameter_count],
            free: Vec::new(),
            region: None,
            projected: DVector::zeros(0),
            difference: Difference::Forward,
            evaluations: 0,
        };

        let trial = iterate.evaluate(start);
        iterate.accept(start.to_vec(), trial);
        iterate
    }

    /// Evaluates the weighted residuals at `values`.
    pub(crate) fn evaluate(&mut self, values: &[f64]) -> Trial {
        let mut residuals = DVector::zeros(self.residuals.len());
        self.problem.residuals(values, residuals.as_mut_slice());
        self.evaluations += 1;
        for (residual, root) in residuals.iter_mut().zip(&self.weight_roots) {
            *residual *= root;
        }
        let sum = residuals.iter().map(|r| self.loss.value(*r)).sum::<f64>();
        // NaN compares as neither smaller nor larger, and must count as larger.
        Trial { sum: if sum.is_nan() { f64::INFINITY } else { sum }, residuals }
    }

    /// Moves the current point to `values`, where `trial` was evaluated.
    pub(crate) fn accept(&mut self, values: Vec<f64>, trial: Trial) {
        (self.values, self.sum, self.residuals) = (values, trial.sum, trial.residuals);
    }

    /// Computes the Jacobian of the weighted residuals at the current point.
    ///
    /// The derivatives come from [`Problem::jacobian`], or else from differences.
    pub(crate) fn differentiate(&mut self) -> &DMatrix<f64> {
        if !self.problem.jacobian(&self.values, &mut self.jacobian) {
            let unweighted = self.unweighted();
            let point = Evaluated { values: &self.values, residuals: &unweighted };
            self.evaluations +=
                self.difference.jacobian(self.problem, self.parameters, point, &mut self.jacobian);
        }
        for (i, root) in self.weight_roots.iter().enumerate() {
            self.jacobian.row_mut(i).scale_mut(*root);
        }
        &self.jacobian
    }

    /// Updates the Jacobian, `scale`, `free` and the decomposition at the current point.
    pub(crate) fn linearise(&mut self) {
        self.differentiate();

        // With a robust loss each row is weighted so that the gradient is the gradient of the loss.
        self.right.copy_from(&self.residuals);
        if self.loss != Loss::Squares {
            for (i, residual) in self.right.iter_mut().enumerate() {
                let root = self.loss.weight(*residual).sqrt();
                *residual *= root;
                self.jacobian.row_mut(i).scale_mut(root);
            }
        }

        for (j, scale) in self.scale.iter_mut().enumerate() {
            *scale = scale.max(self.jacobian.column(j).norm());
        }
        self.free = (0..self.parameters.len()).filter(|&j| self.can_move(j)).collect();
        self.region = None;
        if self.free.is_empty() || !self.jacobian.iter().all(|slope| slope.is_finite()) {
            return;
        }

        let mut scaled = self.jacobian.select_columns(&self.free);
        for (mut column, &j) in scaled.column_iter_mut().zip(&self.free) {
            column.unscale_mut(self.scale[j]);
        }
        self.region = TrustRegion::new(scaled);
        if let Some(region) = &self.region {
            self.projected = region.project(&self.right);
        }
    }

    /// Returns the residuals at the current point without weights. They are evaluated again if
    /// `residuals` has weights.
    fn unweighted(&mut self) -> Vec<f64> {
        let mut residuals = self.residuals.as_slice().to_vec();
        if !self.weight_roots.is_empty() {
            self.problem.residuals(&self.values, &mut residuals);
            self.evaluations += 1;
        }
        residuals
    }

    /// Returns whether parameter `j` affects the residuals and is not held at a bound by the
    /// gradient.
    fn can_move(&self, j: usize) -> bool {
        let column = self.jacobian.column(j);
        let slope = column.dot(&self.right);
        let parameter = &self.parameters[j];
        let held = (self.values[j] <= parameter.lower && slope > 0.0)
            || (self.values[j] >= parameter.upper && slope < 0.0);
        !held && !parameter.is_fixed() && column.norm_squared() > 0.0
    }

    /// Returns whether [`Iterate::linearise`] succeeded, or no parameter may move.
    pub(crate) fn is_linearised(&self) -> bool {
        self.region.is_some() || self.free.is_empty()
    }

    /// Returns the largest cosine between the residuals and a free column of the Jacobian.
    pub(crate) fn gradient(&self) -> f64 {
        let norm = self.right.norm();
        let columns = self.free.iter().map(|&j| self.jacobian.column(j));
        columns
            .map(|column| column.dot(&self.right).abs() / (column.norm() * norm))
            .fold(0.0, f64::max)
    }

    /// Returns the damping at which the step is as long as `radius`, or 0 if the undamped step is
    /// shorter than `radius`.
    pub(crate) fn damping(&self, radius: f64) -> f64 {
        let region = self.region.as_ref();
        region.map_or(0.0, |region| region.damping(&self.projected, radius))
    }

    /// Returns the step with the given `damping`, projected on the bounds. It is zero for
    /// parameters that are held.
    pub(crate) fn step(&self, damping: f64) -> Vec<f64> {
        let mut step = self.solve(&self.projected, damping);
        self.project(&mut step);
        step
    }

    /// Returns the step of all parameters for `projected` residuals, without regard to the bounds.
    fn solve(&self, projected: &DVector<f64>, damping: f64) -> Vec<f64> {
        let mut step = vec![0.0; self.values.len()];
        if let Some(region) = &self.region {
            let solution = region.step(projected, damping);
            for (&j, change) in self.free.iter().zip(solution.iter()) {
                step[j] = change / self.scale[j];
            }
        }
        step
    }

    /// Projects `step` on the bounds.
    pub(crate) fn project(&self, step: &mut [f64]) {
        for ((step, parameter), value) in step.iter_mut().zip(self.parameters).zip(&self.values) {
            *step = parameter.clamp(value + *step) - value;
        }
    }

    /// Returns the second-order correction of `step`, half the geodesic acceleration
    /// \[TS12, eq. 10\].
    ///
    /// The second derivative of the residuals along `step` takes one evaluation at a fraction of
    /// `step`. Returns `None` if the residuals at this point are not finite.
    pub(crate) fn acceleration(&mut self, step: &[f64], damping: f64) -> Option<Vec<f64>> {
        /// Fraction of the step at which the second directional derivative is probed.
        ///
        /// The third derivative matters for a large fraction, rounding for a small one. \[TS12\]
        /// take the same fraction.
        const PROBE: f64 = 0.1;

        let short_step: Vec<f64> = step.iter().map(|change| PROBE * change).collect();
        let Trial { sum, residuals: mut probed } = self.evaluate(&self.shifted(&short_step));
        if !sum.is_finite() {
            return None;
        }
        if self.loss != Loss::Squares {
            for (probed, residual) in probed.iter_mut().zip(self.residuals.iter()) {
                *probed *= self.loss.weight(*residual).sqrt();
            }
        }

        // The residuals at the probe, less their linear prediction, give the second derivative.
        let slope = &self.jacobian * DVector::from_column_slice(step);
        let curvature = ((probed - &self.right) / PROBE - slope) * (2.0 / PROBE);
        let projected = self.region.as_ref()?.project(&curvature);
        let acceleration = self.solve(&projected, damping);
        Some(acceleration.into_iter().map(|change| 0.5 * change).collect())
    }

    /// Returns the reduction of the sum of squares that the linear model predicts for `step`.
    pub(crate) fn predicted_reduction(&self, step: &[f64]) -> f64 {
        let change = &self.jacobian * DVector::from_column_slice(step);
        -(2.0 * self.right.dot(&change) + change.norm_squared())
    }

    /// Returns the values after `step`, moved inside the bounds.
    pub(crate) fn shifted(&self, step: &[f64]) -> Vec<f64> {
        let moved = self.values.iter().zip(step).map(|(value, change)| value + change);
        moved.zip(self.parameters).map(|(value, parameter)| parameter.clamp(value)).collect()
    }

    /// Returns the length of `step` in the scaled norm.
    pub(crate) fn length(&self, step: &[f64]) -> f64 {
        // A parameter without effect adds no length, whatever its value.
        let pairs = step.iter().zip(&self.scale).filter(|(_, s)| **s > 0.0);
        pairs.map(|(v, s)| (v * s).powi(2)).sum::<f64>().sqrt()
    }
}
