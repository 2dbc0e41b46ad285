//! Search from several starts, for every test alike.
//!
//! `selection` compares laws by rough searches, and `curve_fit` refines the selected law.

use drape_lm::{MinimiserSettings, Parameter, Problem, Report, Stop, minimise};

use crate::regression::residuals::NamedParameter;
use crate::threads;

/// Iterations of every start before the best is chosen.
///
/// Enough to leave the start's own neighbourhood, and a small part of a full search.
const SCREENING_ITERATIONS: usize = 8;
/// Relative reduction of the sum at which a search that only compares laws ends.
///
/// It is a hundredth of the change that moves their criterion by one for ten thousand points.
const COMPARISON_REDUCTION: f64 = 1e-6;

/// Iterations of a search before parameters that creep towards a bound are moved there.
const CREEPING_ITERATIONS: usize = 60;
/// Rounds of a search, after each of which parameters that creep towards a bound are moved there.
const ROUNDS: usize = 6;
/// Distance from a bound, over the size of the bound or of the parameter, below which a parameter
/// is tried there.
const NEAR_BOUND: f64 = 2e-3;

/// Relative rise of the sum that a parameter may cost that is moved to its bound: of a thousand
/// points less than a thousandth of one.
const NEGLIGIBLE: f64 = 1e-6;

/// Best end of a search from several starts.
#[derive(Clone)]
pub(crate) struct SearchResult {
    /// Parameters, starting from where the search ended.
    pub(crate) parameters: Vec<NamedParameter>,
    pub(crate) report: Report,
    /// Number of evaluations over all starts.
    pub(crate) evaluations: usize,
}

/// Minimises `problem` over the parameters `named`.
fn minimise_named(
    problem: &impl Problem,
    named: &[NamedParameter],
    settings: &MinimiserSettings,
) -> Report {
    let parameters: Vec<Parameter> = named.iter().map(|named| named.parameter).collect();
    minimise(problem, &parameters, settings)
}

/// Returns the parameters `named` that start at the end of a search.
fn with_start(named: &[NamedParameter], report: &Report) -> Vec<NamedParameter> {
    let mut restarted = named.to_vec();
    for (named, value) in restarted.iter_mut().zip(&report.parameters) {
        named.parameter.start = *value;
    }
    restarted
}

/// Searches from each of `starts` for a few iterations, and from the best end until laws can be
/// compared.
///
/// The starts run in parallel. The first of equally good ends is taken, so the result does not
/// depend on the number of threads.
pub(crate) fn multistart(
    problem: &(impl Problem + Sync),
    starts: &[Vec<NamedParameter>],
) -> SearchResult {
    let screening = MinimiserSettings {
        iterations: SCREENING_ITERATIONS,
        reduction: COMPARISON_REDUCTION,
        polish: false,
        ..MinimiserSettings::default()
    };
    let screened = threads::map(starts, |start| {
        let report = minimise_named(problem, start, &screening);
        SearchResult {
            parameters: with_start(start, &report),
            evaluations: report.evaluations,
            report,
        }
    });
    let evaluations = screened.iter().map(|result| result.evaluations).sum();

    let best = screened
        .into_iter()
        .min_by(|a, b| a.report.sum.total_cmp(&b.report.sum))
        .expect("every law has at least one start");
    let best = SearchResult { evaluations, ..best };
    if best.report.stop.converged() {
        return best;
    }
    let comparison =
        MinimiserSettings { iterations: MinimiserSettings::default().iterations, ..screening };
    resume(problem, best, &comparison)
}

/// Continues from the end `result` of a search down to rounding.
///
/// If the minimum lies beyond a bound, a curved valley may lead to the bound at a shallow angle,
/// and each step then goes a part of the distance. Such parameters are moved to the bound, and the
/// search continues with the other parameters, as long as the sum hardly rises.
pub(crate) fn refine(problem: &impl Problem, result: SearchResult) -> SearchResult {
    let short =
        MinimiserSettings { iterations: CREEPING_ITERATIONS, ..MinimiserSettings::default() };
    let mut best = resume(problem, result, &short);

    for _ in 0..ROUNDS {
        let moved = moved_to_bounds(&best.parameters);
        let creeps = moved.is_some();
        let start = SearchResult {
            parameters: moved.unwrap_or_else(|| best.parameters.clone()),
            ..best.clone()
        };
        if !creeps && best.report.stop.converged() {
            return best;
        }
        let next = resume(problem, start, &short);
        if next.report.sum <= best.report.sum * (1.0 + NEGLIGIBLE) {
            best = next;
        } else if best.report.stop.converged() {
            // The minimum lies just within the bounds.
            return best;
        } else {
            best = resume(problem, best, &short);
        }
    }

    if best.report.stop.converged() {
        return best;
    }
    let sum = best.report.sum;
    let mut last = resume(problem, best, &MinimiserSettings::default());
    if !last.report.stop.converged() && last.report.sum >= sum * (1.0 - NEGLIGIBLE) {
        // Hundreds of steps along a flat valley have changed nothing that the curve can tell.
        last.report.stop = Stop::Reduction;
    }
    last
}

/// Returns the parameters with each parameter near a bound moved to the bound; `None` if no
/// parameter is near a bound.
fn moved_to_bounds(named: &[NamedParameter]) -> Option<Vec<NamedParameter>> {
    let mut moved = named.to_vec();
    let mut any = false;
    for NamedParameter { parameter, .. } in &mut moved {
        for bound in [parameter.lower, parameter.upper] {
            let near = NEAR_BOUND * bound.abs().max(parameter.scale);
            if parameter.start != bound && (parameter.start - bound).abs() <= near {
                parameter.start = bound;
                any = true;
            }
        }
    }
    any.then_some(moved)
}

/// Continues the search from the end `result`.
fn resume(
    problem: &impl Problem,
    result: SearchResult,
    settings: &MinimiserSettings,
) -> SearchResult {
    let mut report = minimise_named(problem, &result.parameters, settings);
    report.iterations += result.report.iterations;
    SearchResult {
        parameters: with_start(&result.parameters, &report),
        evaluations: result.evaluations + report.evaluations,
        report,
    }
}
