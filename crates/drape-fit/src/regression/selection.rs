//! Model selection: which of several laws the data of one curve support.
//!
//! `curve_fit` calls it before it fits the selected law with its weights.

use drape_kes::Curve;
use drape_lm::{Report, akaike};

use crate::error::Error;
use crate::regression::candidate::{Candidate, Choice};
use crate::regression::noise::load_noise;
use crate::regression::residuals::{ForwardModel, NamedParameter, Residuals};
use crate::regression::search::{SearchResult, multistart};
use crate::regression::uncertainty::Independence;
use crate::threads;

/// Root mean square residual, over the range of the load, that no instrument resolves.
///
/// A converter with 24 bits has this resolution. Below it, rounding would decide between laws.
const RESOLUTION: f64 = 1e-7;

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
    pub(crate) choice: Choice,
    /// Fit of the selected law.
    pub(crate) result: SearchResult,
    /// Number of evaluations of the others.
    pub(crate) evaluations: usize,
}

/// Fits each of `models` to `curve` and selects one.
///
/// The criterion of the selected law is within [`Candidate::LEAD`] of the smallest criterion. It is
/// the first such law among laws that predict better than all laws before them. Another law
/// replaces it if its misfit is less than [`Candidate::SMALLER`] times the misfit of the selected
/// law and larger than the noise, unless that law predicts worse. A law that does not follow the
/// curve gives way to the first law that does, with the same exception. A law with more parameters
/// than the curve has points is never selected.
///
/// # Errors
/// [`Error::TooFewPoints`] if every law has more parameters than `curve` has points.
pub(crate) fn select(curve: &Curve, models: &[CandidateModel<'_>]) -> Result<Selection, Error> {
    let points = curve.load().len();
    let mut results = threads::map(models, |model| {
        multistart(&Residuals::new(curve, &*model.forward), &model.starts)
    });
    let misfits: Vec<f64> = models
        .iter()
        .zip(&results)
        .map(|(model, result)| {
            Residuals::new(curve, &*model.forward).misfit(&result.report.parameters)
        })
        .collect();

    // Correlated residuals of the closest law count as fewer independent points.
    let best = (0..models.len()).min_by(|&a, &b| misfits[a].total_cmp(&misfits[b]));
    let best = best.expect("there is a model");
    let effective = if models.len() > 1 && misfits[best] >= RESOLUTION {
        let most = results.iter().map(|result| result.parameters.len()).max().unwrap_or(0);
        let independence = residual_independence(curve, &models[best], &results[best]);
        independence.for_parameters(most, points).effective_count
    } else {
        points as f64
    };

    let mut candidates = Vec::with_capacity(models.len());
    for ((model, result), misfit) in models.iter().zip(&results).zip(&misfits) {
        let count = result.parameters.len();
        let square = misfit.max(RESOLUTION).powi(2);
        // For residuals of size one the criterion is its penalty for the parameters.
        let report = Report { sum: points as f64, ..result.report.clone() };
        let penalty = akaike(&report, points, count);
        candidates.push(Candidate {
            law: model.name.clone(),
            parameters: count,
            misfit: *misfit,
            criterion: penalty.map(|penalty| effective * square.ln() + penalty),
            prediction: model.prediction,
        });
    }

    // A law of lower preference must predict better as well.
    let mut criteria = Vec::with_capacity(candidates.len());
    for (i, candidate) in candidates.iter().enumerate() {
        let is_eligible = candidate.prediction.is_none()
            || !candidates[..i].iter().any(|other| other.prediction <= candidate.prediction);
        criteria.push(candidate.criterion.filter(|_| is_eligible));
    }
    let least = criteria.iter().copied().flatten().fold(f64::INFINITY, f64::min);
    // With too few points for any criterion, the law of highest preference is supported.
    let supported = criteria
        .iter()
        .position(|criterion| criterion.is_some_and(|c| c <= least + Candidate::LEAD))
        .unwrap_or(0);

    let mut chosen = supported;
    let mut choice = if models.len() > 1 { Choice::Supported } else { Choice::Only };
    if let Some(closer) = much_closer(&candidates, chosen, load_noise(curve)) {
        (chosen, choice) = (closer, Choice::Closer);
    }
    if let Some(first) = first_that_follows(&candidates, chosen) {
        (chosen, choice) = (first, Choice::Follows);
    }
    if candidates[chosen].parameters > points {
        chosen = determined(&candidates, curve)?;
    }
    let all: usize = results.iter().map(|result| result.evaluations).sum();
    let result = results.swap_remove(chosen);
    Ok(Selection { candidates, chosen, choice, evaluations: all - result.evaluations, result })
}

/// Returns the first of `candidates` with at most one parameter for each point of `curve`.
///
/// # Errors
/// [`Error::TooFewPoints`] if there is none.
fn determined(candidates: &[Candidate], curve: &Curve) -> Result<usize, Error> {
    let points = curve.load().len();
    let fewest = candidates.iter().map(|candidate| candidate.parameters).min().unwrap_or(0);
    candidates
        .iter()
        .position(|candidate| candidate.parameters <= points)
        .ok_or_else(|| Error::TooFewPoints { name: curve.name.clone(), points, needed: fewest })
}

/// Returns the first law that certainly follows the curve closer than the law `chosen`; `None` if
/// there is none.
fn much_closer(candidates: &[Candidate], chosen: usize, noise: f64) -> Option<usize> {
    let chosen = &candidates[chosen];
    let are_closer: Vec<bool> = candidates
        .iter()
        .map(|other| {
            other.misfit < Candidate::SMALLER * chosen.misfit
                && other.misfit > noise
                && !other.predicts_worse(chosen)
        })
        .collect();
    let closer = || candidates.iter().zip(&are_closer).filter(|(_, is_closer)| **is_closer);
    let least = closer().map(|(other, _)| other.misfit).fold(f64::INFINITY, f64::min);
    // The first closer law is taken that no other closer law beats by the same factor.
    candidates
        .iter()
        .zip(are_closer)
        .position(|(other, is_closer)| is_closer && Candidate::SMALLER * other.misfit <= least)
}

/// Returns the first law that follows the curve, if the law `chosen` does not; `None` otherwise.
fn first_that_follows(candidates: &[Candidate], chosen: usize) -> Option<usize> {
    let chosen = &candidates[chosen];
    if chosen.follows() {
        return None;
    }
    candidates.iter().position(|other| other.follows() && !other.predicts_worse(chosen))
}

/// Returns the independence of the residuals of `model` on `curve`.
fn residual_independence(
    curve: &Curve,
    model: &CandidateModel<'_>,
    result: &SearchResult,
) -> Independence {
    let mut residuals = vec![0.0; curve.load().len()];
    model.forward.loads(&result.report.parameters, &mut residuals);
    for (residual, load) in residuals.iter_mut().zip(curve.load()) {
        *residual -= load;
    }
    Independence::from_residuals(&residuals)
}

#[cfg(test)]
mod tests {
    use drape_kes::{Direction, Test};
    use drape_lm::Parameter;

    use super::*;

    /// Number of points of the curve.
    const POINTS: usize = 400;

    /// Line with a slow wave that no law has, a quadratic part, and noise of a sawtooth.
    fn wavy(wave: f64, quadratic: f64, noise: f64) -> Curve {
        let x: Vec<f64> = (0..POINTS).map(|i| i as f64 / (POINTS - 1) as f64).collect();
        let load = |(i, x): (usize, &f64)| {
            let sawtooth = noise * ((i * 7 % 10) as f64 / 4.5 - 1.0);
            x + wave * (6.0 * x).sin() + quadratic * x * x + sawtooth
        };
        let loads = x.iter().enumerate().map(load).collect();
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
    fn a_law_whose_misfit_is_a_fifth_smaller_wins_although_both_miss_the_curve() {
        // The residuals of both laws are a wave, and count as few. The law of fewer parameters used
        // to win with any misfit; users saw a law that follows their curve and were given another.
        for (quadratic, told_apart) in [(0.13, false), (1.0, true)] {
            let curve = wavy(0.02, quadratic, 0.0);
            let models = models(&curve);
            let selection = select(&curve, &models).expect("points");
            let misfits = [0, 1].map(|i| selection.candidates[i].misfit);
            assert!(misfits[1] < Candidate::SMALLER * misfits[0], "{misfits:?}");
            let criteria = [0, 1].map(|i| selection.candidates[i].criterion.expect("one"));
            assert_eq!(criteria[0] - criteria[1] > Candidate::LEAD, told_apart, "{criteria:?}");
            assert_eq!(selection.chosen, 1, "{misfits:?}");
        }
    }

    #[test]
    fn correlated_residuals_count_as_the_independent_ones_among_them() {
        // A wave of which a parabola takes a twentieth off the misfit.
        let curve = wavy(0.02, -0.01, 0.0);
        let models = models(&curve);
        let selection = select(&curve, &models).expect("points");
        let misfits = [0, 1].map(|i| selection.candidates[i].misfit);
        // Were all residuals independent, the parabola would be selected.
        let lead = 2.0 * POINTS as f64 * (misfits[0] / misfits[1]).ln();
        assert!(lead > 2.0 * Candidate::LEAD, "{lead} {misfits:?}");
        assert!(misfits[1] > Candidate::SMALLER * misfits[0], "{misfits:?}");
        assert_eq!(selection.chosen, 0, "{misfits:?}");
    }

    #[test]
    fn within_the_noise_the_criterion_alone_decides() {
        // A quadratic part of a twentieth of the noise, which no misfit shows.
        let curve = wavy(0.0, 0.001, 0.02);
        assert_eq!(select(&curve, &models(&curve)).expect("points").chosen, 0);
        // One that the criterion finds although it takes less than a fifth off the misfit.
        let curve = wavy(0.0, 0.1, 0.02);
        let models = models(&curve);
        let selection = select(&curve, &models).expect("points");
        let misfits = [0, 1].map(|i| selection.candidates[i].misfit);
        assert!(misfits[1] > Candidate::SMALLER * misfits[0], "{misfits:?}");
        assert_eq!(selection.chosen, 1, "{misfits:?}");
    }

    #[test]
    fn a_law_that_predicts_worse_does_not_win_by_its_misfit() {
        let curve = wavy(0.02, 1.0, 0.0);
        for (predictions, wanted) in [([0.01, 0.02], 0), ([0.02, 0.01], 1)] {
            let mut models = models(&curve);
            for (model, prediction) in models.iter_mut().zip(predictions) {
                model.prediction = Some(prediction);
            }
            assert_eq!(select(&curve, &models).expect("points").chosen, wanted, "{predictions:?}");
        }
    }
}
