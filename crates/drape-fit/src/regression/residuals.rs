//! Residuals of a law along a curve, as a least squares problem of drape-lm.

use drape_kes::Curve;
use drape_lm::{Parameter, Problem};
use nalgebra::DMatrix;

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
    /// Writes the loads with the given parameters.
    fn loads(&self, p: &[f64], out: &mut [f64]);

    /// Writes the derivatives of the loads by the parameters; returns `false` if they are unknown.
    fn jacobian(&self, _p: &[f64], _out: &mut DMatrix<f64>) -> bool {
        false
    }
}

impl<F: Fn(&[f64], &mut [f64]) + Sync + Send> ForwardModel for F {
    fn loads(&self, p: &[f64], out: &mut [f64]) {
        self(p, out);
    }
}

/// Residuals of a forward model, over the range of the measured load.
pub(crate) struct Residuals<'a> {
    load: &'a [f64],
    /// Reciprocal range of the load.
    scale: f64,
    model: &'a dyn ForwardModel,
    weights: Vec<f64>,
}

impl<'a> Residuals<'a> {
    pub(crate) fn new(curve: &'a Curve, model: &'a dyn ForwardModel) -> Self {
        let scale = 1.0 / curve.load_range().span();
        Self { load: curve.load(), scale, model, weights: Vec::new() }
    }

    /// Returns the residuals with weights for their squares.
    pub(crate) fn weighted(self, weights: Vec<f64>) -> Self {
        Self { weights, ..self }
    }
}

impl Problem for Residuals<'_> {
    fn residual_count(&self) -> usize {
        self.load.len()
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        self.model.loads(parameters, out);
        for (residual, load) in out.iter_mut().zip(self.load) {
            *residual = (*residual - load) * self.scale;
        }
    }

    fn jacobian(&self, parameters: &[f64], out: &mut DMatrix<f64>) -> bool {
        let known = self.model.jacobian(parameters, out);
        if known {
            *out *= self.scale;
        }
        known
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }
}
