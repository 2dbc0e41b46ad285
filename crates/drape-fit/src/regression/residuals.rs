//! Residuals of a law along a curve, as a least squares problem of drape-lm.

use drape_kes::Curve;
use drape_lm::{Parameter, Problem};
use nalgebra::DMatrix;

use crate::regression::functional::Functional;

/// Parameter of a law, with the name it has in reports.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NamedParameter {
    pub(crate) name: &'static str,
    pub(crate) parameter: Parameter,
}

impl NamedParameter {
    pub(crate) fn new(name: &'static str, parameter: Parameter) -> Self {
        Self { name, parameter }
    }
}

/// Loads that a law predicts along a curve.
pub(crate) trait ForwardModel: Sync + Send {
    /// Writes the loads with the parameters `p` to `out`.
    fn loads(&self, p: &[f64], out: &mut [f64]);

    /// Writes the derivatives of the loads by the parameters `p` to `out`. Returns `false` if the
    /// derivatives are unknown.
    fn jacobian(&self, _p: &[f64], _out: &mut DMatrix<f64>) -> bool {
        false
    }
}

impl<F: Fn(&[f64], &mut [f64]) + Sync + Send> ForwardModel for F {
    fn loads(&self, p: &[f64], out: &mut [f64]) {
        self(p, out);
    }
}

/// Problem whose first residuals belong to points, in the order of measurement.
pub(crate) trait PointProblem: Problem {
    /// Returns the number of points; by default `residual_count`.
    fn point_count(&self) -> usize {
        self.residual_count()
    }

    /// Returns the functionals of the points. Their residuals follow the residuals of the points.
    fn functionals(&self) -> &[Functional] {
        &[]
    }

    /// Returns the weight of the squared residual of each functional, over the weight of a point.
    fn functional_weight(&self) -> f64 {
        0.0
    }
}

/// Residuals of a forward model: of its loads over the range of the measured load, and of
/// functionals of its loads.
pub(crate) struct Residuals<'a> {
    load: &'a [f64],
    /// Reciprocal range of the load.
    scale: f64,
    model: &'a dyn ForwardModel,
    functionals: Vec<Functional>,
    /// Weight of the squared residual of each functional, over the weight of a point.
    functional_weight: f64,
    weights: Vec<f64>,
}

impl<'a> Residuals<'a> {
    pub(crate) fn new(curve: &'a Curve, model: &'a dyn ForwardModel) -> Self {
        let scale = 1.0 / curve.load_range().span();
        Self {
            load: curve.load(),
            scale,
            model,
            functionals: Vec::new(),
            functional_weight: 0.0,
            weights: Vec::new(),
        }
    }

    /// Returns the residuals with additional `functionals`.
    ///
    /// `systematic` is the part of the squared misfit of the law that is not noise, from 0 to 1. A
    /// functional has that part of the weight of all points together. A law whose residuals are
    /// nothing but noise needs no functionals, and would follow the noise of the few points with
    /// most weight.
    pub(crate) fn with_functionals(self, functionals: Vec<Functional>, systematic: f64) -> Self {
        let functionals = if systematic > 0.0 { functionals } else { Vec::new() };
        let functional_weight = systematic * self.load.len() as f64;
        Self { functionals, functional_weight, ..self }
    }

    /// Returns the residuals with `weights` for the squares of the points. Empty `weights` are
    /// equal weights.
    pub(crate) fn with_weights(self, mut weights: Vec<f64>) -> Self {
        if !weights.is_empty() {
            weights.resize(self.residual_count(), 1.0);
        }
        Self { weights, ..self }
    }

    /// Returns the root mean square residual of the points with the given `parameters`, a ratio,
    /// without weights.
    pub(crate) fn misfit(&self, parameters: &[f64]) -> f64 {
        let mut loads = vec![0.0; self.load.len()];
        self.model.loads(parameters, &mut loads);
        let square: f64 = loads.iter().zip(self.load).map(|(a, b)| (a - b).powi(2)).sum();
        (square / self.load.len() as f64).sqrt() * self.scale
    }
}

impl PointProblem for Residuals<'_> {
    fn point_count(&self) -> usize {
        self.load.len()
    }

    fn functionals(&self) -> &[Functional] {
        &self.functionals
    }

    fn functional_weight(&self) -> f64 {
        self.functional_weight
    }
}

impl Problem for Residuals<'_> {
    fn residual_count(&self) -> usize {
        self.load.len() + self.functionals.len()
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        let (points, others) = out.split_at_mut(self.load.len());
        self.model.loads(parameters, points);
        for (residual, functional) in others.iter_mut().zip(&self.functionals) {
            *residual = functional.deviation(points) * self.functional_weight.sqrt();
        }
        for (residual, load) in points.iter_mut().zip(self.load) {
            *residual = (*residual - load) * self.scale;
        }
    }

    fn jacobian(&self, parameters: &[f64], out: &mut DMatrix<f64>) -> bool {
        if !self.model.jacobian(parameters, out) {
            return false;
        }
        for (index, functional) in self.functionals.iter().enumerate() {
            for column in 0..out.ncols() {
                let slope = functional.slope(|point| out[(point, column)]);
                out[(self.load.len() + index, column)] = slope * self.functional_weight.sqrt();
            }
        }
        out.rows_mut(0, self.load.len()).scale_mut(self.scale);
        true
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }
}
