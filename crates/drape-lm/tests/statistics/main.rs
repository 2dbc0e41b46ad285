//! Standard errors, intervals, links and losses against answers known by other means.

mod covariance;
mod linked;
mod loss;
mod nonsense;
mod profile;

use drape_lm::{Parameter, Problem};

/// Problem from a function of the parameters.
struct Model<F> {
    count: usize,
    weights: Vec<f64>,
    residuals: F,
}

impl<F: Fn(&[f64], &mut [f64])> Problem for Model<F> {
    fn residual_count(&self) -> usize {
        self.count
    }
    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        (self.residuals)(parameters, out);
    }
    fn weights(&self) -> &[f64] {
        &self.weights
    }
}

fn model<F: Fn(&[f64], &mut [f64])>(count: usize, residuals: F) -> Model<F> {
    Model { count, weights: Vec::new(), residuals }
}

fn starts(values: &[f64]) -> Vec<Parameter> {
    values.iter().map(|&value| Parameter::new(value)).collect()
}

/// Scatter of zero mean in steps of one fifth, uncorrelated with a line.
fn scatter(i: usize) -> f64 {
    f64::from((i * 7 % 11) as u32) / 5.0 - 1.0
}

/// Straight line through scattered points, with weights.
fn line(weights: &[f64]) -> Model<impl Fn(&[f64], &mut [f64]) + use<>> {
    Model {
        count: 22,
        weights: weights.to_vec(),
        residuals: |p: &[f64], r: &mut [f64]| {
            for (i, r) in r.iter_mut().enumerate() {
                *r = p[0] + p[1] * i as f64 - (3.0 - 0.5 * i as f64 + scatter(i));
            }
        },
    }
}
