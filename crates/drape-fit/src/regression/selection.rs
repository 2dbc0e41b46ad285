//! Model selection: which of several laws the data of one curve support.
//!
//! `curve_fit` calls it before it fits the selected law with its weights.

use drape_kes::Curve;
use drape_lm::{Report, akaike};
use rayon::prelude::*;

use crate::regression::residuals::{ForwardModel, NamedParameter, Residuals};
use crate::regression::search::{SearchResult, multistart};
use crate::regression::uncertainty::Independence;

/// Root mean square residual, over the range of the load, that no instrument resolves.
///
/// It is that of a converter with 24 bits. Below it, rounding would decide between laws.
const RESOLUTION: f64 = 1e-7;

/// Law that was compared with others on one curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Name of the law, in words.
    pub law: String,
    /// Number of fitted parameters.
    pub parameters: usize,
    /// Root mean square residual over the range of the load, without weights; a ratio.
    pub misfit: f64,
    /// Akaike's corrected criterion, [`drape_lm::akaike`]; `None` where the points are too few.
    ///
    /// Its logarithm counts the independent residuals (`CurveFit::effective_points`) of the
    /// candidate with the smallest residual, not all: the quasi-likelihood criterion of \[BA02,
    /// §2.5\]. Residuals of a law that misses the curve systematically are correlated, and each
    /// would vote for any law with more parameters. For independent noise both are the same.
    pub criterion: Option<f64>,
    /// Root mean square error, over the range of the load, of the prediction of the last cycle from
    /// all others; `None` where there is one cycle.
    ///
    /// A law is selected only if it predicts better than all laws of higher preference.
    pub prediction: Option<f64>,
}

impl Candidate {
    /// Lead in Akaike's criterion that a law of lower preference must have.
    ///
    /// A lead of four to seven leaves the other law considerably less support \[BA02, §2.6\]. The
    /// criterion alone selects a second friction element that is not there in one of six noisy
    /// loops, because its length is free to fit the noise; with this lead it is one in a hundred.
    pub const LEAD: f64 = 6.0;
}

/// Law to try on a curve.
pub(crate) struct CandidateModel<'a> {
    pub(crate) name: String,
    /// Initial guesses.
    pub(crate) starts: Vec<Vec<NamedParameter>>,
    /// Error of its prediction of a cycle that it was not fitted to, if that was tried.
    pub(crate) prediction: Option<f64>,
    pub(crate) forward: Box<dyn ForwardModel + 'a>,
}

/// Selected law, with the candidates.
pub(crate) struct Selection {
    pub(crate) candidates: Vec<Candidate>,
    pub(crate) chosen: usize,
    /// Fit of the selected law.
    pub(crate) result: SearchResult,
    /// Number of evaluations of the others.
    pub(crate) evaluations: usize,
}

/// Fits every law and selects the first whose criterion is within [`Candidate::LEAD`] of the smallest, of
/// those that predict better than all before them.
pub(crate) fn select(curve: &Curve, models: &[CandidateModel<'_>]) -> Selection {
    let points = curve.load().len();
    let mut results: Vec<SearchResult> = models
        .par_iter()
        .map(|model| multistart(&Residuals::new(curve, &*model.forward), &model.starts))
        .collect();
    let effective =
        if models.len() > 1 { effective_points(curve, models, &results) } else { points as f64 };
    let candidate = |(model, result): (&CandidateModel<'_>, &SearchResult)| {
        let count = result.parameters.len();
        let square = result.report.rms.max(RESOLUTION).powi(2);
        // For residuals of size one the criterion is its penalty for the parameters.
        let report = Report { sum: points as f64, ..result.report.clone() };
        let penalty = akaike(&report, points, count);
        Candidate {
            law: model.name.clone(),
            parameters: count,
            misfit: result.report.rms,
            criterion: penalty.map(|penalty| effective * square.ln() + penalty),
            prediction: model.prediction,
        }
    };
    let candidates: Vec<Candidate> = models.iter().zip(&results).map(candidate).collect();
    // A law of lower preference must predict better as well.
    let eligible = |i: usize| {
        let better = |other: &Candidate| other.prediction <= candidates[i].prediction;
        candidates[i].prediction.is_none() || !candidates[..i].iter().any(better)
    };
    let criterion = |i: usize| candidates[i].criterion.filter(|_| eligible(i));
    let least = (0..candidates.len()).filter_map(criterion).fold(f64::INFINITY, f64::min);
    let supported =
        |i: &usize| criterion(*i).is_some_and(|criterion| criterion <= least + Candidate::LEAD);
    // With too few points for any criterion, the law of highest preference.
    let chosen = (0..candidates.len()).find(supported).unwrap_or(0);
    let all: usize = results.iter().map(|result| result.evaluations).sum();
    let result = results.swap_remove(chosen);
    Selection { candidates, chosen, evaluations: all - result.evaluations, result }
}

/// Returns the number of independent residuals of the law with the smallest residual.
fn effective_points(curve: &Curve, models: &[CandidateModel<'_>], results: &[SearchResult]) -> f64 {
    let pairs = models.iter().zip(results);
    let best = pairs.min_by(|(_, a), (_, b)| a.report.sum.total_cmp(&b.report.sum));
    let (model, result) = best.expect("there are several models");
    let mut residuals = vec![0.0; curve.load().len()];
    if result.report.rms < RESOLUTION {
        return residuals.len() as f64;
    }
    model.forward.loads(&result.report.parameters, &mut residuals);
    for (residual, load) in residuals.iter_mut().zip(curve.load()) {
        *residual -= load;
    }
    Independence::of(&residuals).effective_count
}

#[cfg(test)]
mod tests {
    use drape_kes::{Direction, Test};
    use drape_lm::Parameter;

    use super::*;

    /// Number of points of the curve.
    const POINTS: usize = 400;

    /// Line with a slow wave that no law has, and with a small quadratic part.
    fn wavy(quadratic: f64) -> Curve {
        let x: Vec<f64> = (0..POINTS).map(|i| i as f64 / (POINTS - 1) as f64).collect();
        let load = |x: &f64| x + 0.02 * (6.0 * x).sin() + quadratic * x * x;
        let loads = x.iter().map(load).collect();
        Curve::new(Test::Bending, Direction::Warp, x, loads).expect("it is a curve")
    }

    fn models(curve: &Curve) -> Vec<CandidateModel<'_>> {
        let x = curve.deformation();
        let line = move |p: &[f64], out: &mut [f64]| {
            out.iter_mut().zip(x).for_each(|(load, x)| *load = p[0] + p[1] * x);
        };
        let parabola = move |p: &[f64], out: &mut [f64]| {
            out.iter_mut().zip(x).for_each(|(load, x)| *load = p[0] + (p[1] + p[2] * x) * x);
        };
        let model = |forward, count: usize| {
            let names = ["zero", "slope", "curvature"];
            let start = names[..count].iter();
            let start = start.map(|name| NamedParameter::new(name, Parameter::new(0.5))).collect();
            let name = format!("polynomial of {count}");
            CandidateModel { name, starts: vec![start], prediction: None, forward }
        };
        let laws: [Box<dyn ForwardModel>; 2] = [Box::new(line), Box::new(parabola)];
        laws.into_iter().zip([2, 3]).map(|(forward, count)| model(forward, count)).collect()
    }

    #[test]
    fn correlated_residuals_count_as_the_independent_ones_among_them() {
        let curve = wavy(-0.01);
        let models = models(&curve);
        let selection = select(&curve, &models);
        let misfits = [0, 1].map(|i| selection.candidates[i].misfit);
        // Were all residuals independent, the parabola would be selected.
        let lead = 2.0 * POINTS as f64 * (misfits[0] / misfits[1]).ln();
        assert!(lead > 2.0 * Candidate::LEAD, "{lead} {misfits:?}");
        assert_eq!(selection.chosen, 0, "{misfits:?}");
        // With a quadratic part that stands out of the wave it is.
        let curve = wavy(1.0);
        assert_eq!(select(&curve, &self::models(&curve)).chosen, 1);
    }
}
