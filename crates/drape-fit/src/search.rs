//! The search that every test shares: several starts, one history, one best set of parameters.

use drape_kes::Curve;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::choice::Predict;
use drape_lm::{self as lm, Parameter, Report, Settings};

/// Steps that every start is given before the best is chosen.
///
/// Enough to leave the start's own neighbourhood, and a small part of a full search.
const SCOUT_ITERATIONS: usize = 8;
/// Relative reduction of the sum at which a search that only compares laws ends: a hundredth of what changes
/// their criterion by one for ten thousand points.
const ROUGH: f64 = 1e-6;

/// A named parameter of a law.
pub(crate) type Named = (&'static str, Parameter);

/// The best end of a search from several starts.
#[derive(Clone)]
pub(crate) struct Found {
    /// The parameters with their names and bounds.
    pub(crate) named: Vec<Named>,
    pub(crate) report: Report,
    /// Evaluations over all starts.
    pub(crate) evaluations: usize,
}

/// Residuals of a law along a curve, over the range of the load.
pub(crate) struct Residuals<'a> {
    load: &'a [f64],
    scale: f64,
    predict: &'a dyn Predict,
    weights: Vec<f64>,
}

impl<'a> Residuals<'a> {
    pub fn new(curve: &'a Curve, predict: &'a dyn Predict) -> Self {
        let (low, high) = curve.load_range();
        Self { load: curve.load(), scale: 1.0 / (high - low), predict, weights: Vec::new() }
    }

    pub fn weighted(self, weights: Vec<f64>) -> Self {
        Self { weights, ..self }
    }
}

impl lm::Problem for Residuals<'_> {
    fn residual_count(&self) -> usize {
        self.load.len()
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        self.predict.loads(parameters, out);
        for (residual, load) in out.iter_mut().zip(self.load) {
            *residual = (*residual - load) * self.scale;
        }
    }

    fn jacobian(&self, parameters: &[f64], out: &mut DMatrix<f64>) -> bool {
        let known = self.predict.slopes(parameters, out);
        if known {
            *out *= self.scale;
        }
        known
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }
}

fn minimise(problem: &impl lm::Problem, named: &[Named], settings: &Settings) -> Report {
    let parameters: Vec<Parameter> = named.iter().map(|(_, p)| *p).collect();
    lm::minimise(problem, &parameters, settings)
}

/// The parameters starting where a search has ended.
fn restarted(named: &[Named], report: &Report) -> Vec<Named> {
    let restart = |(named, value): (&Named, &f64)| {
        let (name, mut parameter) = *named;
        parameter.start = *value;
        (name, parameter)
    };
    named.iter().zip(&report.parameters).map(restart).collect()
}

/// Searches from every start a little way, and from the best end on until laws can be compared.
///
/// The starts run side by side; the first of equally good ones is taken, so the number of threads does not
/// matter.
pub(crate) fn search(problem: &(impl lm::Problem + Sync), starts: &[Vec<Named>]) -> Found {
    let rough = |iterations: usize| Settings {
        iterations,
        reduction: ROUGH,
        polish: false,
        ..Settings::default()
    };
    let scouts: Vec<Found> = starts
        .par_iter()
        .map(|start| {
            let report = minimise(problem, start, &rough(SCOUT_ITERATIONS));
            Found { named: restarted(start, &report), evaluations: report.evaluations, report }
        })
        .collect();
    let evaluations = scouts.iter().map(|scout| scout.evaluations).sum();
    let best = scouts
        .into_iter()
        .min_by(|a, b| a.report.sum.total_cmp(&b.report.sum))
        .expect("every law gives at least one start");
    let best = Found { evaluations, ..best };
    if best.report.stop.converged() {
        return best;
    }
    go_on(problem, best, &rough(Settings::default().iterations))
}

/// Goes on from the end of a search until rounding stops it.
pub(crate) fn refine(problem: &impl lm::Problem, found: Found) -> Found {
    go_on(problem, found, &Settings::default())
}

fn go_on(problem: &impl lm::Problem, found: Found, settings: &Settings) -> Found {
    let mut report = minimise(problem, &found.named, settings);
    report.iterations += found.report.iterations;
    Found {
        named: restarted(&found.named, &report),
        evaluations: found.evaluations + report.evaluations,
        report,
    }
}
