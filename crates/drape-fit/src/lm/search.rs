//! The best point so far and the linear model there.

use nalgebra::{DMatrix, DVector};

use super::jacobian::{Difference, differences};
use super::region::Region;
use super::{Loss, Parameter, Problem};

/// Part of a step at which the curvature along it is measured.
///
/// Small enough for the third derivative not to matter, large enough for rounding not to; Transtrum and
/// Sethna take the same.
const REACH: f64 = 0.1;

/// The state of a minimisation.
pub(super) struct Search<'a, P> {
    problem: &'a P,
    parameters: &'a [Parameter],
    loss: Loss,
    /// Roots of the weights of the residuals.
    roots: Vec<f64>,
    pub at: Vec<f64>,
    /// Residuals times the roots of their weights.
    pub residuals: DVector<f64>,
    /// Sum of their losses: of their squares in least squares.
    pub sum: f64,
    /// Derivatives and residuals of the least squares problem that has the gradient of the loss.
    jacobian: DMatrix<f64>,
    right: DVector<f64>,
    /// Moré's scaling: the largest norm of each column so far.
    scale: Vec<f64>,
    /// Parameters that may move in this step.
    free: Vec<usize>,
    region: Option<Region>,
    projected: DVector<f64>,
    pub difference: Difference,
    pub evaluations: usize,
}

impl<'a, P: Problem> Search<'a, P> {
    pub fn new(problem: &'a P, parameters: &'a [Parameter], at: &[f64], loss: Loss) -> Self {
        let (m, n) = (problem.residual_count(), parameters.len());
        let mut search = Self {
            problem,
            parameters,
            loss,
            roots: problem.weights().iter().take(m).map(|w| w.sqrt()).collect(),
            at: Vec::new(),
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
        let (sum, residuals) = search.evaluate(at);
        search.accept(at.to_vec(), sum, residuals);
        search
    }

    /// Weighted residuals and the sum of their losses, infinite where that is not a number.
    pub fn evaluate(&mut self, at: &[f64]) -> (f64, DVector<f64>) {
        let mut residuals = DVector::zeros(self.residuals.len());
        self.problem.residuals(at, residuals.as_mut_slice());
        self.evaluations += 1;
        for (residual, root) in residuals.iter_mut().zip(&self.roots) {
            *residual *= root;
        }
        let sum = residuals.iter().map(|r| self.loss.value(*r)).sum::<f64>();
        // Not a number compares as neither better nor worse: it must count as worse.
        (if sum.is_nan() { f64::INFINITY } else { sum }, residuals)
    }

    pub fn accept(&mut self, at: Vec<f64>, sum: f64, residuals: DVector<f64>) {
        (self.at, self.sum, self.residuals) = (at, sum, residuals);
    }

    /// Derivatives of the weighted residuals at the present point.
    pub fn differentiate(&mut self) -> &DMatrix<f64> {
        if !self.problem.jacobian(&self.at, &mut self.jacobian) {
            let raw = self.unweighted();
            self.evaluations += differences(
                self.problem,
                self.parameters,
                (&self.at, &raw),
                self.difference,
                &mut self.jacobian,
            );
        }
        for (i, root) in self.roots.iter().enumerate() {
            self.jacobian.row_mut(i).scale_mut(*root);
        }
        &self.jacobian
    }

    /// Derivatives, scaling, free parameters and decomposition at the present point.
    pub fn linearise(&mut self) {
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
        self.region = Region::new(scaled);
        if let Some(region) = &self.region {
            self.projected = region.project(&self.right);
        }
    }

    /// The residuals at the present point as the problem gives them.
    fn unweighted(&mut self) -> Vec<f64> {
        let mut raw = self.residuals.as_slice().to_vec();
        if !self.roots.is_empty() {
            self.problem.residuals(&self.at, &mut raw);
            self.evaluations += 1;
        }
        raw
    }

    /// Whether a parameter has an effect and is not held at a bound by the gradient.
    fn can_move(&self, j: usize) -> bool {
        let column = self.jacobian.column(j);
        let slope = column.dot(&self.right);
        let parameter = &self.parameters[j];
        let held = (self.at[j] <= parameter.lower && slope > 0.0)
            || (self.at[j] >= parameter.upper && slope < 0.0);
        !held && !parameter.is_fixed() && column.norm_squared() > 0.0
    }

    /// Whether there is a linear model at all.
    pub fn is_linearised(&self) -> bool {
        self.region.is_some() || self.free.is_empty()
    }

    /// Largest cosine between the residuals and a free column.
    pub fn gradient(&self) -> f64 {
        let norm = self.right.norm();
        let cosine = |&j: &usize| {
            let column = self.jacobian.column(j);
            column.dot(&self.right).abs() / (column.norm() * norm)
        };
        self.free.iter().map(cosine).fold(0.0, f64::max)
    }

    /// Damping with which the step has the length of the radius; zero where the undamped step is shorter.
    pub fn damping(&self, radius: f64) -> f64 {
        let region = self.region.as_ref();
        region.map_or(0.0, |region| region.damping(&self.projected, radius))
    }

    /// The damped step, cut at the bounds; zero for parameters that are held.
    pub fn step(&self, damping: f64) -> Vec<f64> {
        let mut step = self.solve(&self.projected, damping);
        self.cut(&mut step);
        step
    }

    fn solve(&self, projected: &DVector<f64>, damping: f64) -> Vec<f64> {
        let mut step = vec![0.0; self.at.len()];
        if let Some(region) = &self.region {
            let solution = region.step(projected, damping);
            for (&j, change) in self.free.iter().zip(solution.iter()) {
                step[j] = change / self.scale[j];
            }
        }
        step
    }

    /// Cuts a step at the bounds.
    pub fn cut(&self, step: &mut [f64]) {
        for ((step, parameter), at) in step.iter_mut().zip(self.parameters).zip(&self.at) {
            *step = parameter.clamp(at + *step) - at;
        }
    }

    /// Half the second derivative along a step, as a step [Transtrum & Sethna 2012, eq. 10].
    ///
    /// The curvature of the residuals along the step is measured by one evaluation a part of the way along
    /// it. Nothing where the residuals have no value there.
    pub fn bend(&mut self, step: &[f64], damping: f64) -> Option<Vec<f64>> {
        let part: Vec<f64> = step.iter().map(|change| REACH * change).collect();
        let (sum, mut ahead) = self.evaluate(&self.shifted(&part));
        if !sum.is_finite() {
            return None;
        }
        if self.loss != Loss::Squares {
            for (ahead, residual) in ahead.iter_mut().zip(self.residuals.iter()) {
                *ahead *= self.loss.weight(*residual).sqrt();
            }
        }
        let slope = &self.jacobian * DVector::from_column_slice(step);
        let curvature = ((ahead - &self.right) / REACH - slope) * (2.0 / REACH);
        let projected = self.region.as_ref()?.project(&curvature);
        let bend = self.solve(&projected, damping);
        Some(bend.into_iter().map(|change| 0.5 * change).collect())
    }

    /// Reduction of the sum of squares that the linear model promises for a step.
    pub fn predicted(&self, step: &[f64]) -> f64 {
        let change = &self.jacobian * DVector::from_column_slice(step);
        -(2.0 * self.right.dot(&change) + change.norm_squared())
    }

    pub fn shifted(&self, step: &[f64]) -> Vec<f64> {
        let moved = self.at.iter().zip(step).map(|(value, change)| value + change);
        moved.zip(self.parameters).map(|(value, parameter)| parameter.clamp(value)).collect()
    }

    /// Length of a step in the scaled norm.
    pub fn length(&self, step: &[f64]) -> f64 {
        // A parameter without effect has no length, whatever its value.
        let pairs = step.iter().zip(&self.scale).filter(|(_, s)| **s > 0.0);
        pairs.map(|(v, s)| (v * s).powi(2)).sum::<f64>().sqrt()
    }
}
