//! Which of several laws a curve bears out.

use drape_kes::Curve;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::search::{Found, Named, Residuals, search};
use crate::statistics::Independence;
use drape_lm::{self as lm, Report};

/// Lead in Akaike's criterion that a law less preferred must have.
///
/// A lead of four to seven leaves the other law considerably less support [Burnham & Anderson 2002, §2.6]. The
/// criterion alone takes a second friction element that is not there in one of six noisy loops, because its
/// length is free to find the noise; with this lead it is one in a hundred.
const LEAD: f64 = 6.0;
/// Root mean square residual, over the range of the load, that no instrument resolves: that of a converter
/// with 24 bits. Below it, rounding would decide between laws.
const RESOLUTION: f64 = 1e-7;

/// A law that was compared with others on one curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The law, in words.
    pub law: String,
    /// Number of fitted parameters.
    pub parameters: usize,
    /// Root mean square residual over the range of the load, all points counting alike; a ratio.
    pub misfit: f64,
    /// Akaike's criterion for small samples, [`lm::akaike`]; nothing where the points are too few.
    ///
    /// Its logarithm counts the independent residuals ([`CurveFit::independent`](crate::CurveFit::independent))
    /// of the candidate that leaves the least, not all: the quasi-likelihood criterion of [Burnham &
    /// Anderson 2002, §2.5]. Residuals of a law that misses the curve systematically are alike, and each would
    /// vote for any law with more parameters. For independent noise both are the same.
    pub criterion: Option<f64>,
    /// Root mean square error over the range of the load with which the law, fitted to all cycles but the last,
    /// predicts that one; where there are several. A law is taken only if it predicts better than all that are
    /// preferred to it.
    pub prediction: Option<f64>,
}

/// A law that a curve may be fitted with.
pub(crate) struct Model<'a> {
    pub name: String,
    pub starts: Vec<Vec<Named>>,
    /// Error with which the law predicts what it was not fitted to, if that was tried.
    pub prediction: Option<f64>,
    pub predict: Box<dyn Predict + 'a>,
}

/// What a law predicts along a curve.
pub(crate) trait Predict: Sync + Send {
    /// Writes the loads with some parameters.
    fn loads(&self, p: &[f64], out: &mut [f64]);

    /// Writes the derivatives of the loads by the parameters, if the law knows them.
    fn slopes(&self, _p: &[f64], _out: &mut DMatrix<f64>) -> bool {
        false
    }
}

impl<F: Fn(&[f64], &mut [f64]) + Sync + Send> Predict for F {
    fn loads(&self, p: &[f64], out: &mut [f64]) {
        self(p, out);
    }
}

/// The law chosen, and what it was compared with.
pub(crate) struct Choice {
    pub candidates: Vec<Candidate>,
    pub chosen: usize,
    /// The fit of the law chosen.
    pub found: Found,
    /// Evaluations of the others.
    pub evaluations: usize,
}

/// Fits every law and takes the first whose criterion is within [`LEAD`] of the least, of those that predict
/// better than all before them.
pub(crate) fn choose(curve: &Curve, models: &[Model<'_>]) -> Choice {
    let points = curve.load().len();
    let mut found: Vec<Found> = models
        .par_iter()
        .map(|model| search(&Residuals::new(curve, &*model.predict), &model.starts))
        .collect();
    let independent =
        if models.len() > 1 { independent(curve, models, &found) } else { points as f64 };
    let candidate = |(model, found): (&Model<'_>, &Found)| {
        let count = found.named.len();
        let square = found.report.rms.max(RESOLUTION).powi(2);
        // The criterion of residuals of size one is its price of the parameters.
        let report = Report { sum: points as f64, ..found.report.clone() };
        let price = lm::akaike(&report, points, count);
        Candidate {
            law: model.name.clone(),
            parameters: count,
            misfit: found.report.rms,
            criterion: price.map(|price| independent * square.ln() + price),
            prediction: model.prediction,
        }
    };
    let candidates: Vec<Candidate> = models.iter().zip(&found).map(candidate).collect();
    // A law less preferred must predict better as well.
    let stands = |i: usize| {
        let better = |other: &Candidate| other.prediction <= candidates[i].prediction;
        candidates[i].prediction.is_none() || !candidates[..i].iter().any(better)
    };
    let criterion = |i: usize| candidates[i].criterion.filter(|_| stands(i));
    let least = (0..candidates.len()).filter_map(criterion).fold(f64::INFINITY, f64::min);
    let near = |i: &usize| criterion(*i).is_some_and(|criterion| criterion <= least + LEAD);
    // Too few points for any criterion: the law most preferred.
    let chosen = (0..candidates.len()).find(near).unwrap_or(0);
    let all: usize = found.iter().map(|found| found.evaluations).sum();
    let found = found.swap_remove(chosen);
    Choice { candidates, chosen, evaluations: all - found.evaluations, found }
}

/// Number of independent residuals of the law that leaves the least.
fn independent(curve: &Curve, models: &[Model<'_>], found: &[Found]) -> f64 {
    let pairs = models.iter().zip(found);
    let best = pairs.min_by(|(_, a), (_, b)| a.report.sum.total_cmp(&b.report.sum));
    let (model, found) = best.expect("there are several models");
    let mut residuals = vec![0.0; curve.load().len()];
    if found.report.rms < RESOLUTION {
        return residuals.len() as f64;
    }
    model.predict.loads(&found.report.parameters, &mut residuals);
    for (residual, load) in residuals.iter_mut().zip(curve.load()) {
        *residual -= load;
    }
    Independence::of(&residuals).count
}
