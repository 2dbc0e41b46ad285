//! Fit of one curve: selection of a law, weighted fit, uncertainty.
//!
//! The fits of `curves` end here; reports and `fabric` read the [`CurveFit`].

use drape_kes::{Curve, Direction, Test};
use drape_lm::{Problem, Stop};
use nalgebra::DMatrix;

use crate::regression::candidate::{Candidate, Choice};
use crate::regression::estimate::{Estimate, ValueEstimate};
use crate::regression::functional::Functional;
use crate::regression::noise::load_noise;
use crate::regression::residuals::{ForwardModel, Residuals};
use crate::regression::search::{SearchResult, refine};
use crate::regression::selection::Selection;
use crate::regression::uncertainty::{FitEnd, Independence, Uncertainty, uncertainty};
use crate::settings::Intervals;

/// Fit of a law to a measured curve: quality, parameters, candidates, loads.
///
/// ```
/// use drape_fit::{FitSettings, identify_shear};
/// use drape_kes::{Curve, Direction, Test};
///
/// // An elastic fabric of 30 N/(m·rad), sheared to 8° and back to −8°.
/// let angles: Vec<f64> =
///     (0..=80).chain((-80..80).rev()).map(|i| (0.1 * f64::from(i)).to_radians()).collect();
/// let forces = angles.iter().map(|angle| 30.0 * angle.sin()).collect();
/// let curve = Curve::new(Test::Shear, Direction::Warp, angles, forces).expect("it moves");
///
/// let fit = identify_shear(&curve, &FitSettings::default())?.fit;
/// assert!(fit.misfit < 1e-9 && fit.r_squared > 0.999_999);
/// let stiffness = &fit.parameters[0];
/// assert!(stiffness.name == "stiffness" && (stiffness.value / 30.0 - 1.0).abs() < 1e-6);
/// # Ok::<(), drape_fit::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CurveFit {
    /// Name of the curve.
    pub name: String,
    /// Test of the curve.
    pub test: Test,
    /// Yarns along which the strip was loaded.
    pub direction: Direction,
    /// Root mean square residual over the range of the measured load, without weights; a ratio.
    pub misfit: f64,
    /// Root mean square residual, in the unit of the load.
    pub rms: f64,
    /// Root mean square residual over the range of the measured load, with the weights of the fit;
    /// a ratio.
    pub weighted_misfit: f64,
    /// Coefficient of determination `$R^2$`, without weights.
    pub r_squared: f64,
    /// Correlation of the residuals of neighbouring points, a ratio.
    ///
    /// Zero for a law that leaves nothing but noise, near one for a law that misses the curve
    /// systematically.
    pub autocorrelation: f64,
    /// Number of independent residuals with the same information.
    ///
    /// `$n(1-\rho)/(1+\rho)$` with the autocorrelation `$\rho$`, where that is more than chance.
    pub effective_points: f64,
    /// Number of repeats whose scatter is in the errors of the parameters; 0 for a single curve.
    pub repeats: usize,
    /// Number of iterations of the best start.
    pub iterations: usize,
    /// Number of evaluations of the law along the history, over all starts of all candidates.
    pub evaluations: usize,
    /// Reason why the search stopped.
    pub stop: Stop,
    /// Noise of the load, a standard deviation over the range of the measured load; a ratio.
    ///
    /// A misfit of its size leaves nothing of the curve to a better law.
    pub noise: f64,
    /// Fitted parameters.
    pub parameters: Vec<Estimate>,
    /// KES values of the law; none for a test that has none.
    pub values: Vec<ValueEstimate>,
    /// Correlations of the parameters, in their order; `None` where one is undetermined.
    pub correlations: Vec<Vec<Option<f64>>>,
    /// Laws that were compared, in the order of preference.
    pub candidates: Vec<Candidate>,
    /// Index of the selected candidate.
    pub chosen: usize,
    /// Reason of the selection.
    pub choice: Choice,
    /// Deformation at each point of the curve, in the unit that [`Test`] has for it.
    pub deformation: Vec<f64>,
    /// Measured load at each point, per width, in the unit that [`Test`] has for it.
    pub measured: Vec<f64>,
    /// Load of the law at each point, in the unit of `measured`.
    pub load: Vec<f64>,
    /// Half width of the 95 % band around the load of the law at each point, in the unit of
    /// `measured`.
    ///
    /// It comes from the errors of the parameters that the curve determines. Zero at points that
    /// were not used.
    pub band: Vec<f64>,
    /// Remarks on the curve and its law, one sentence each, without a full stop.
    pub remarks: Vec<String>,
    /// Branch of each point, from zero; a reversal belongs to the branch that it ends.
    pub branches: Vec<usize>,
    /// Covariances of the parameters; zero for those that are undetermined.
    #[serde(skip)]
    pub(crate) covariance: DMatrix<f64>,
    /// Half width of a 95 % interval over the standard error.
    #[serde(skip)]
    pub(crate) quantile: f64,
}

/// Law with its fit.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Identified<L> {
    /// Identified law.
    pub law: L,
    /// Fit of the law to the curve.
    pub fit: CurveFit,
}

/// Weights and intervals of the fit of a selected law.
pub(crate) struct FitOptions {
    /// Weights of the squared residuals; empty for none.
    pub(crate) weights: Vec<f64>,
    /// Areas, slopes and widths that a law meets even if it misses the curve systematically.
    pub(crate) functionals: Vec<Functional>,
    pub(crate) intervals: Intervals,
}

/// Number of points of a curve on which laws are compared.
///
/// Laws are told apart by the shape of a curve. A thousand points show the shape as well as ten
/// thousand, in a tenth of the time.
pub(crate) const COMPARED_POINTS: usize = 1500;

/// Fits the selected law to `curve` with its weights.
///
/// The `selection` was made without weights, on the curve or on some of its points: a criterion of
/// weighted residuals would take the noise of heavy points for structure. `forward` returns the
/// loads of the selected law at all points of the curve.
pub(crate) fn fit_curve<'a>(
    curve: &Curve,
    selection: Selection,
    forward: impl FnOnce(usize) -> Box<dyn ForwardModel + 'a>,
    options: FitOptions,
) -> CurveFit {
    let forward = forward(selection.chosen);
    let noise = load_noise(curve);
    let systematic = systematic_part(selection.candidates[selection.chosen].misfit, noise);
    let problem = Residuals::new(curve, &*forward)
        .with_functionals(options.functionals, systematic)
        .with_weights(options.weights);

    // The weights change the minimum only slightly, so the search continues from the selection.
    let unweighted = selection.result.report.parameters.clone();
    let result = refine(&problem, selection.result);
    let mut load = vec![0.0; curve.load().len()];
    forward.loads(&result.report.parameters, &mut load);
    let weights = problem.weights();
    let weighted = !weights.is_empty();
    let end = FitEnd {
        parameters: &result.parameters,
        report: &result.report,
        unweighted: if weighted { &unweighted } else { &result.report.parameters },
    };

    let uncertainty = uncertainty(&problem, &end, options.intervals);
    let mut fit = CurveFit::new(curve, result, uncertainty, load);
    if weighted {
        fit.weighted_misfit = fit.rms_with(weights) / curve.load_range().span();
    }
    fit.evaluations += selection.evaluations;
    (fit.candidates, fit.chosen) = (selection.candidates, selection.chosen);
    fit.choice = selection.choice;
    fit
}

/// Misfit over the noise of the load up to which the residuals of a law are nothing but noise.
///
/// The noise is known to 8 % from a curve of two hundred points, so chance hardly exceeds it.
const NOISE_MARGIN: f64 = 1.3;

/// Returns the part of a squared `misfit` that is not `noise`, from 0 to 1.
fn systematic_part(misfit: f64, noise: f64) -> f64 {
    let noise = NOISE_MARGIN * noise;
    if misfit > noise { 1.0 - (noise / misfit).powi(2) } else { 0.0 }
}

impl CurveFit {
    /// Collects the fit of `curve` by one law from the `load` of the law at each point.
    ///
    /// A load that equals the measured load to the last bit marks a point that was not used.
    pub(crate) fn new(
        curve: &Curve,
        result: SearchResult,
        uncertainty: Uncertainty,
        load: Vec<f64>,
    ) -> Self {
        let span = curve.load_range().span();
        let residuals: Vec<f64> = load.iter().zip(curve.load()).map(|(a, b)| a - b).collect();
        let n = residuals.len() as f64;
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = curve.load().iter().sum::<f64>() / n;
        let variance: f64 = curve.load().iter().map(|load| (load - mean).powi(2)).sum();

        let count = uncertainty.estimates.len();
        let independence =
            Independence::from_residuals(&residuals).for_parameters(count, residuals.len());
        let rms = (square / n).sqrt();
        Self {
            name: curve.name.clone(),
            test: curve.test,
            direction: curve.direction,
            misfit: rms / span,
            rms,
            weighted_misfit: rms / span,
            r_squared: 1.0 - square / variance,
            autocorrelation: independence.correlation,
            effective_points: independence.effective_count,
            repeats: 0,
            iterations: result.report.iterations,
            evaluations: result.evaluations,
            stop: result.report.stop,
            noise: load_noise(curve),
            parameters: uncertainty.estimates,
            values: Vec::new(),
            correlations: uncertainty.correlations,
            candidates: Vec::new(),
            chosen: 0,
            choice: Choice::Only,
            deformation: curve.deformation().to_vec(),
            measured: curve.load().to_vec(),
            band: uncertainty.band.iter().map(|width| width * span).collect(),
            load,
            remarks: Vec::new(),
            branches: branch_of_each_point(curve),
            covariance: uncertainty.covariance,
            quantile: uncertainty.quantile,
        }
    }

    /// Returns the `load` of the law less the `measured` load at each point, in SI.
    pub fn residuals(&self) -> impl Iterator<Item = f64> {
        self.load.iter().zip(&self.measured).map(|(law, measured)| law - measured)
    }

    /// Returns the root mean square residual with the `weights` of the points, in SI.
    fn rms_with(&self, weights: &[f64]) -> f64 {
        let square: f64 = self.residuals().zip(weights).map(|(r, weight)| weight * r * r).sum();
        let total: f64 = weights.iter().take(self.load.len()).sum();
        (square / total).sqrt()
    }

    /// Returns the value of each parameter, in the order of `parameters`.
    pub(crate) fn parameter_values(&self) -> Vec<f64> {
        self.parameters.iter().map(|estimate| estimate.value).collect()
    }

    /// Returns Akaike's criterion of the selected law; `None` if there are too few points.
    #[must_use]
    pub fn criterion(&self) -> Option<f64> {
        self.candidates.get(self.chosen)?.criterion
    }
}

/// Returns the index of the branch of each point of `curve`.
pub(crate) fn branch_of_each_point(curve: &Curve) -> Vec<usize> {
    let mut branches = vec![0; curve.load().len()];
    for (index, branch) in curve.branches().iter().enumerate() {
        // The first point of a later branch is the reversal, which ends the branch before.
        let first = branch.points.start + usize::from(index > 0);
        branches[first..branch.points.end].fill(index);
    }
    branches
}

#[cfg(test)]
mod tests {
    use drape_kes::{Direction, Test};

    use super::*;

    #[test]
    fn a_reversal_ends_the_branch_before() {
        let curvature = vec![0.0, 1.0, 2.0, 1.0, 0.0, -1.0, 0.0];
        let moment = curvature.clone();
        let curve = Curve::new(Test::Bending, Direction::Warp, curvature, moment).expect("a loop");
        assert_eq!(branch_of_each_point(&curve), [0, 0, 0, 1, 1, 1, 2]);
    }
}
