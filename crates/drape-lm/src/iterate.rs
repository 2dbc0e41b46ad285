//! Current point of the iteration with the linear model of its residuals.
//!
//! `minimise` asks it for steps and moves it; `covariance` uses it for the Jacobian at the minimum.

use nalgebra::{DMatrix, DVector};

use crate::difference::{Difference, Evaluated};
use crate::loss::Loss;
use crate::problem::{Parameter, Problem};
use crate::trust_region::TrustRegion;

/// Fraction of a step at which the second directional derivative is probed.
///
/// Small enough for the third derivative not to matter, large enough for rounding not to;
/// \[TS12\] take the same.
const PROBE: f64 = 0.1;

/// Current point, its residuals and their linear model.
pub(crate) struct Iterate<'a, P> {
    problem: &'a P,
    parameters: &'a [Parameter],
    loss: Loss,
    /// Square roots of the weights of the residuals.
    roots: Vec<f64>,
    /// Values of the parameters.
    pub(crate) values: Vec<f64>,
    /// Residuals times the roots of their weights.
    pub(crate) residuals: DVector<f64>,
    /// Sum of their losses; in least squares, the weighted sum of squares.
    pub(crate) sum: f64,
    /// Jacobian and residuals of the least squares problem that has the gradient of the loss.
    jacobian: DMatrix<f64>,
    right: DVector<f64>,
    /// Scaling of \[Mor78\]: the largest norm of each column so far.
    scale: Vec<f64>,
    /// Parameters that may move in this step.
    free: Vec<usize>,
    region: Option<TrustRegion>,
    projected: DVector<f64>,
    pub(crate) difference: Difference,
    pub(crate) evaluations: usize,
}

/// Residuals at a trial point, with the sum of their losses.
pub(crate) struct Trial {
    /// Sum of the losses, infinite where it is not a number.
    pub(crate) sum: f64,
    /// Residuals times the roots of their weights.
    pub(crate) residuals: DVector<f64>,
}

impl<'a, P: Problem> Iterate<'a, P> {
    pub(crate) fn new(
        problem: &'a P,
        parameters: &'a [Parameter],
        start: &[f64],
        loss: Loss,
    ) -> Self {
        let (m, n) = (problem.residual_count(), parameters.len());
        let mut iterate = Self {
            problem,
            parameters,
            loss,
            roots: problem.weights().iter().take(m).map(|w| w.sqrt()).collect(),
            values: Vec::new(),
            residuals: DVector::zeros(m),
            sum: 0.0,
            jacobian: DMatrix::zeros(m, n),
            right: DVector::zeros(m),
            scale: vec![0.0; n],
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

    /// Evaluates the weighted residuals at a point.
    pub(crate) fn evaluate(&mut self, values: &[f64]) -> Trial {
        let mut residuals = DVector::zeros(self.residuals.len());
        self.problem.residuals(values, residuals.as_mut_slice());
        self.evaluations += 1;
        for (residual, root) in residuals.iter_mut().zip(&self.roots) {
            *residual *= root;
        }
        let sum = residuals.iter().map(|r| self.loss.value(*r)).sum::<f64>();
        // Not a number compares as neither better nor worse: it must count as worse.
        Trial { sum: if sum.is_nan() { f64::INFINITY } else { sum }, residuals }
    }

    /// Moves to a trial point.
    pub(crate) fn accept(&mut self, values: Vec<f64>, trial: Trial) {
        (self.values, self.sum, self.residuals) = (values, trial.sum, trial.residuals);
    }

    /// Computes the Jacobian of the weighted residuals at the current point.
    pub(crate) fn differentiate(&mut self) -> &DMatrix<f64> {
        if !self.problem.jacobian(&self.values, &mut self.jacobian) {
            let raw = self.unweighted();
            let point = Evaluated { parameters: &self.values, residuals: &raw };
            self.evaluations +=
                self.difference.jacobian(self.problem, self.parameters, point, &mut self.jacobian);
        }
        for (i, root) in self.roots.iter().enumerate() {
            self.jacobian.row_mut(i).scale_mut(*root);
        }
        &self.jacobian
    }

    /// Updates Jacobian, scaling, free parameters and decomposition at the current point.
    pub(crate) fn linearise(&mut self) {
        self.differentiate();
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

    /// Returns the residuals at the current point without weights.
    fn unweighted(&mut self) -> Vec<f64> {
        let mut raw = self.residuals.as_slice().to_vec();
        if !self.roots.is_empty() {
            self.problem.residuals(&self.values, &mut raw);
            self.evaluations += 1;
        }
        raw
    }

    /// Returns whether a parameter has an effect and the gradient does not hold it at a bound.
    fn can_move(&self, j: usize) -> bool {
        let column = self.jacobian.column(j);
        let slope = column.dot(&self.right);
        let parameter = &self.parameters[j];
        let held = (self.values[j] <= parameter.lower && slope > 0.0)
            || (self.values[j] >= parameter.upper && slope < 0.0);
        !held && !parameter.is_fixed() && column.norm_squared() > 0.0
    }

    /// Returns whether there is a linear model.
    pub(crate) fn is_linearised(&self) -> bool {
        self.region.is_some() || self.free.is_empty()
    }

    /// Returns the largest cosine between the residuals and a free column of the Jacobian.
    pub(crate) fn gradient(&self) -> f64 {
        let norm = self.right.norm();
        let cosine = |&j: &usize| {
            let column = self.jacobian.column(j);
            column.dot(&self.right).abs() / (column.norm() * norm)
        };
        self.free.iter().map(cosine).fold(0.0, f64::max)
    }

    /// Returns the damping at which the step has the length of the radius, zero where the undamped
    /// step is shorter.
    pub(crate) fn damping(&self, radius: f64) -> f64 {
        let region = self.region.as_ref();
        region.map_or(0.0, |region| region.damping(&self.projected, radius))
    }

    /// Returns the damped step, projected on the bounds; zero for parameters that are held.
    pub(crate) fn step(&self, damping: f64) -> Vec<f64> {
        let mut step = self.solve(&self.projected, damping);
        self.project(&mut step);
        step
    }

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

    /// Projects a step on the bounds.
    pub(crate) fn project(&self, step: &mut [f64]) {
        for ((step, parameter), value) in step.iter_mut().zip(self.parameters).zip(&self.values) {
            *step = parameter.clamp(value + *step) - value;
        }
    }

    /// Returns the second-order correction of a step, half the geodesic acceleration
    /// \[TS12, eq. 10\].
    ///
    /// The second derivative of the residuals along the step takes one evaluation at a fraction of
    /// it. `None` where the residuals have no value there.
    pub(crate) fn acceleration(&mut self, step: &[f64], damping: f64) -> Option<Vec<f64>> {
        let part: Vec<f64> = step.iter().map(|change| PROBE * change).collect();
        let Trial { sum, residuals: mut probed } = self.evaluate(&self.shifted(&part));
        if !sum.is_finite() {
            return None;
        }
        if self.loss != Loss::Squares {
            for (probed, residual) in probed.iter_mut().zip(self.residuals.iter()) {
                *probed *= self.loss.weight(*residual).sqrt();
            }
        }
        let slope = &self.jacobian * DVector::from_column_slice(step);
        let curvature = ((probed - &self.right) / PROBE - slope) * (2.0 / PROBE);
        let projected = self.region.as_ref()?.project(&curvature);
        let acceleration = self.solve(&projected, damping);
        Some(acceleration.into_iter().map(|change| 0.5 * change).collect())
    }

    /// Returns the reduction of the sum of squares that the linear model predicts for a step.
    pub(crate) fn predicted_reduction(&self, step: &[f64]) -> f64 {
        let change = &self.jacobian * DVector::from_column_slice(step);
        -(2.0 * self.right.dot(&change) + change.norm_squared())
    }

    /// Returns the values after a step, within the bounds.
    pub(crate) fn shifted(&self, step: &[f64]) -> Vec<f64> {
        let moved = self.values.iter().zip(step).map(|(value, change)| value + change);
        moved.zip(self.parameters).map(|(value, parameter)| parameter.clamp(value)).collect()
    }

    /// Returns the length of a step in the scaled norm.
    pub(crate) fn length(&self, step: &[f64]) -> f64 {
        // A parameter without effect has no length, whatever its value.
        let pairs = step.iter().zip(&self.scale).filter(|(_, s)| **s > 0.0);
        pairs.map(|(v, s)| (v * s).powi(2)).sum::<f64>().sqrt()
    }
}
