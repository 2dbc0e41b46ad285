//! Search from several starts, for every test alike.
//!
//! `selection` compares laws by rough searches; `curve_fit` refines the one that was selected.

use drape_lm::{Parameter, Problem, Report, Settings, minimise};
use rayon::prelude::*;

use crate::regression::residuals::NamedParameter;

/// Iterations of every start before the best is chosen.
///
/// Enough to leave the start's own neighbourhood, and a small part of a full search.
const SCREENING_ITERATIONS: usize = 8;
/// Relative reduction of the sum at which a search that only compares laws ends.
///
/// It is a hundredth of the change that moves their criterion by one for ten thousand points.
const COMPARISON_REDUCTION: f64 = 1e-6;

/// Best end of a search from several starts.
#[derive(Clone)]
pub(crate) struct SearchResult {
    /// Parameters, starting from where the search ended.
    pub(crate) parameters: Vec<NamedParameter>,
    pub(crate) report: Report,
    /// Number of evaluations over all starts.
    pub(crate) evaluations: usize,
}

fn minimise_named(problem: &impl Problem, named: &[NamedParameter], settings: &Settings) -> Report {
    let parameters: Vec<Parameter> = named.iter().map(|named| named.parameter).collect();
    minimise(problem, &parameters, settings)
}

/// Returns the parameters with the end of a search as their start.
fn restarted(named: &[NamedParameter], report: &Report) -> Vec<NamedParameter> {
    let restart = |(named, value): (&NamedParameter, &f64)| {
        let mut named = *named;
        named.parameter.start = *value;
        named
    };
    named.iter().zip(&report.parameters).map(restart).collect()
}

/// Searches from every start for a few iterations, and from the best end until laws can be
/// compared.
///
/// The starts run in parallel. The first of equally good ones is taken, so the result does not
/// depend on the number of threads.
pub(crate) fn multistart(
    problem: &(impl Problem + Sync),
    starts: &[Vec<NamedParameter>],
) -> SearchResult {
    let rough = |iterations: usize| Settings {
        iterations,
        reduction: COMPARISON_REDUCTION,
        polish: false,
        ..Settings::default()
    };
    let screened: Vec<SearchResult> = starts
        .par_iter()
        .map(|start| {
            let report = minimise_named(problem, start, &rough(SCREENING_ITERATIONS));
            SearchResult {
                parameters: restarted(start, &report),
                evaluations: report.evaluations,
                report,
            }
        })
        .collect();
    let evaluations = screened.iter().map(|result| result.evaluations).sum();
    let best = screened
        .into_iter()
        .min_by(|a, b| a.report.sum.total_cmp(&b.report.sum))
        .expect("every law has at least one start");
    let best = SearchResult { evaluations, ..best };
    if best.report.stop.converged() {
        return best;
    }
    resume(problem, best, &rough(Settings::default().iterations))
}

/// Continues from the end of a search down to rounding.
pub(crate) fn refine(problem: &impl Problem, result: SearchResult) -> SearchResult {
    resume(problem, result, &Settings::default())
}

fn resume(problem: &impl Problem, result: SearchResult, settings: &Settings) -> SearchResult {
    let mut report = minimise_named(problem, &result.parameters, settings);
    report.iterations += result.report.iterations;
    SearchResult {
        parameters: restarted(&result.parameters, &report),
        evaluations: result.evaluations + report.evaluations,
        report,
    }
}
