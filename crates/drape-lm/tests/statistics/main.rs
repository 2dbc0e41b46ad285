//! Standard errors, intervals, links and losses against answers known by other means.

mod covariance;
mod linked;
mod loss;
mod nonsense;
mod profile;

use drape_lm::{Parameter, ResidualFunction};

fn starts(values: &[f64]) -> Vec<Parameter> {
    values.iter().map(|&value| Parameter::new(value)).collect()
}

/// Scatter of zero mean in steps of one fifth, uncorrelated with a line.
fn scatter(i: usize) -> f64 {
    f64::from((i * 7 % 11) as u32) / 5.0 - 1.0
}

/// Straight line through scattered points, with weights.
fn line(weights: &[f64]) -> ResidualFunction<impl Fn(&[f64], &mut [f64]) + use<>> {
    let line = ResidualFunction::new(22, |p, r| {
        for (i, r) in r.iter_mut().enumerate() {
            *r = p[0] + p[1] * i as f64 - (3.0 - 0.5 * i as f64 + scatter(i));
        }
    });
    line.with_weights(weights.to_vec())
}
