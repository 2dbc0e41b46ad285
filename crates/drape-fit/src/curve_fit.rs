//! How a curve is fitted, and what comes of it.

use drape_kes::{Curve, Direction, Test};

use crate::choice::{Candidate, Model, choose};
use crate::estimate::Estimate;
use crate::search::{Found, Residuals, refine};
use crate::statistics::{Independence, Statistics, statistics};
use crate::{Error, Intervals};
use drape_lm::{Problem, Stop};

/// How well a law follows a measured curve, and with which parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFit {
    /// The curve's name.
    pub name: String,
    /// The test.
    pub test: Test,
    /// The yarns along which the strip was loaded.
    pub direction: Direction,
    /// Root mean square residual over the range of the measured load, a ratio; all points count alike.
    pub misfit: f64,
    /// Root mean square residual, in the unit of the load.
    pub rms: f64,
    /// The same with the weights of the fit, over the range of the measured load, a ratio.
    pub weighted_misfit: f64,
    /// Part of the variance of the load that the law explains, `$R^2$`; all points count alike.
    pub determination: f64,
    /// Correlation of the residuals of neighbouring points, a ratio: zero for a law that leaves nothing but
    /// noise, near one for a law that misses the curve systematically.
    pub autocorrelation: f64,
    /// Number of independent residuals that would tell as much: `$n(1-\rho)/(1+\rho)$` with the
    /// autocorrelation `$\rho$`, where that is more than chance.
    pub independent: f64,
    /// Steps of the best start.
    pub iterations: usize,
    /// Evaluations of the law along the whole history, over all starts of all candidates.
    pub evaluations: usize,
    /// Why the search ended.
    pub stop: Stop,
    /// The fitted parameters.
    pub parameters: Vec<Estimate>,
    /// Correlations of the parameters, in their order; nothing where one is not determined.
    pub correlations: Vec<Vec<Option<f64>>>,
    /// The laws that were compared, in the order of preference.
    pub candidates: Vec<Candidate>,
    /// Which of them was taken.
    pub chosen: usize,
    /// The deformation at each point of the curve, in its unit.
    pub deformation: Vec<f64>,
    /// The load measured there, in its unit.
    pub measured: Vec<f64>,
    /// The law's load there, in the same unit.
    pub load: Vec<f64>,
    /// Half width of the band around the law's load that contains the true law's with 95 %, in the same unit:
    /// what the errors of the parameters that the curve determines leave open. Zero at points that were not used.
    pub band: Vec<f64>,
    /// The branch that each point belongs to, counted from zero; a turn belongs to the branch it ends.
    pub branches: Vec<usize>,
}

/// A fitted law with its fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified<L> {
    /// The law.
    pub law: L,
    /// How well it follows the curve.
    pub fit: CurveFit,
}

/// Chooses among models, and fits the one chosen with its weights.
///
/// The choice is made, and its criterion computed, with all points counting alike: a criterion of weighted
/// residuals would take the noise of heavy points for structure.
pub(crate) fn fit(
    curve: &Curve,
    models: &[Model<'_>],
    (weights, intervals): (Vec<f64>, Intervals),
) -> CurveFit {
    let choice = choose(curve, models);
    let model = &models[choice.chosen];
    let problem = Residuals::new(curve, &*model.predict).weighted(weights);
    let unweighted = choice.found.report.parameters.clone();
    let found = refine(&problem, choice.found);
    let mut load = vec![0.0; curve.load().len()];
    model.predict.loads(&found.report.parameters, &mut load);
    let weighted = !problem.weights().is_empty();
    let compared = if weighted { &unweighted } else { &found.report.parameters };
    let statistics = statistics(&problem, &found.named, &found.report, (compared, intervals));
    let mut fit = CurveFit::new(curve, found, statistics, load);
    fit.evaluations += choice.evaluations;
    (fit.candidates, fit.chosen) = (choice.candidates, choice.chosen);
    fit
}

impl CurveFit {
    /// The fit of a curve by one law, with the law's loads; a load equal to the measured one to the last bit
    /// marks a point that was not used.
    pub(crate) fn new(curve: &Curve, found: Found, statistics: Statistics, load: Vec<f64>) -> Self {
        let (low, high) = curve.load_range();
        let residuals: Vec<f64> = load.iter().zip(curve.load()).map(|(a, b)| a - b).collect();
        let n = residuals.len() as f64;
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = curve.load().iter().sum::<f64>() / n;
        let variance: f64 = curve.load().iter().map(|load| (load - mean).powi(2)).sum();
        let independence = Independence::of(&residuals);
        let rms = (square / n).sqrt();
        Self {
            name: curve.name.clone(),
            test: curve.test,
            direction: curve.direction,
            misfit: rms / (high - low),
            rms,
            weighted_misfit: found.report.rms,
            determination: 1.0 - square / variance,
            autocorrelation: independence.correlation,
            independent: independence.count,
            iterations: found.report.iterations,
            evaluations: found.evaluations,
            stop: found.report.stop,
            parameters: statistics.estimates,
            correlations: statistics.correlations,
            candidates: Vec::new(),
            chosen: 0,
            deformation: curve.deformation().to_vec(),
            measured: curve.load().to_vec(),
            band: statistics.band.iter().map(|width| width * (high - low)).collect(),
            load,
            branches: branches(curve),
        }
    }

    /// The law's load less the measured one at each point, in the unit of the load.
    pub fn residuals(&self) -> impl Iterator<Item = f64> {
        self.load.iter().zip(&self.measured).map(|(law, measured)| law - measured)
    }

    /// The values of the parameters.
    pub(crate) fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|estimate| estimate.value).collect()
    }

    /// Akaike's criterion of the law taken, [`lm::akaike`](drape_lm::akaike), from the independent residuals;
    /// nothing where they are too few.
    #[must_use]
    pub fn criterion(&self) -> Option<f64> {
        self.candidates.get(self.chosen)?.criterion
    }
}

/// The branch of each point.
pub(crate) fn branches(curve: &Curve) -> Vec<usize> {
    let mut branches = vec![0; curve.load().len()];
    for (index, branch) in curve.branches().iter().enumerate() {
        // The first point of a later branch is the turn, which ends the one before.
        let first = branch.points.start + usize::from(index > 0);
        branches[first..branch.points.end].fill(index);
    }
    branches
}

/// Checks that a curve is of the right test and has a load that changes.
pub(crate) fn expect(curve: &Curve, wanted: Test) -> Result<(), Error> {
    let name = curve.name.clone();
    if curve.test != wanted {
        return Err(Error::WrongTest { name, found: curve.test, wanted });
    }
    let (low, high) = curve.load_range();
    if low == high {
        return Err(Error::NoLoad { name, load: low });
    }
    Ok(())
}

/// Slope and intercept of the straight line through points, by least squares.
pub(crate) fn line(points: impl Iterator<Item = (f64, f64)> + Clone) -> Option<(f64, f64)> {
    let count = points.clone().count() as f64;
    let (sx, sy) = points.clone().fold((0.0, 0.0), |(sx, sy), (x, y)| (sx + x, sy + y));
    let (mx, my) = (sx / count, sy / count);
    let (xx, xy) = points
        .fold((0.0, 0.0), |(xx, xy), (x, y)| (xx + (x - mx).powi(2), xy + (x - mx) * (y - my)));
    let slope = xy / xx;
    slope.is_finite().then_some((slope, my - slope * mx))
}
