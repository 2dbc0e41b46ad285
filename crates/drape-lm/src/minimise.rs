//! Levenberg–Marquardt iteration: damped Gauss–Newton steps, projected on the bounds.
//!
//! [`minimise`] is the entry point of the crate. `iterate` holds the current point and computes the
//! steps.

use std::ops::ControlFlow;

use crate::check::{InvalidInput, Refusal, refusal};
use crate::difference::Difference;
use crate::iterate::Iterate;
use crate::loss::Loss;
use crate::problem::{Parameter, Problem};

/// First radius of the trust region over the scaled length of the starting values.
///
/// A large radius trusts the linear model far from the data. A small radius converges slowly. Of
/// the 54 starts of the NIST reference problems, 53 are solved for all radii from 0.2 to 3.6,
/// except for one start at 0.9. The last start, the far start of MGH10, has a model 500 times the
/// data: it is solved for all radii from 0.6 to 0.8, and for only some radii outside this range.
const FIRST_RADIUS: f64 = 0.7;
/// Largest second-order part of a step over its first-order part.
///
/// For a larger ratio the linear model is not trusted, and the radius is halved without an
/// evaluation of the sum. This rule keeps parameters from diverging into flat regions. \[TS12\]
/// advise 0.75, and less for hard problems. With 0.75 two of the 54 starts are not solved. With 0.3
/// curved valleys are followed too slowly.
const LARGEST_ACCELERATION: f64 = 0.45;
/// Least ratio of actual to predicted reduction at which a step is accepted.
const ACCEPTED_GAIN: f64 = 1e-4;
/// Ratio of actual to predicted reduction below which the radius shrinks \[Mor78\].
const POOR_GAIN: f64 = 0.25;
/// Ratio of actual to predicted reduction above which the radius grows \[Mor78\].
const GOOD_GAIN: f64 = 0.75;
/// Factor on the radius after a step for which the linear model was poor.
const SHRINK: f64 = 0.5;
/// Factor on the radius after a step for which the linear model was good.
const GROW: f64 = 2.0;
/// Relative reduction below which central differences replace forward ones.
///
/// Far from the minimum the eight digits of forward differences are enough and cost half as much.
/// Near the minimum the gradient is a small difference of large numbers.
const CENTRAL_BELOW: f64 = 1e-3;
/// Largest relative change of a sum that may be rounding, for up to some ten thousand residuals.
const ROUNDING: f64 = 1e-13;
/// Cosine between the residuals and a column of the Jacobian above which a point is no minimum.
const SLOPING: f64 = 1e-3;
/// Largest norm of the residuals that may be rounding, over the scaled length of the parameters.
/// Cosines with smaller residuals mean nothing.
const RESIDUAL_ROUNDING: f64 = 1e-13;
/// Limit on the number of undamped steps at the end.
///
/// One or two are usual. Where the residuals are large, each step gains only a factor of two or
/// three, and a dozen steps gain four digits.
const POLISH_STEPS: usize = 12;

/// Stopping criteria and loss.
///
/// ```
/// use drape_lm::{Loss, MinimiserSettings};
///
/// let loss = Loss::Huber { size: 0.1 };
/// let settings = MinimiserSettings { loss, ..MinimiserSettings::default() };
/// assert!(settings.polish);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct MinimiserSettings {
    /// Relative reduction of the sum at which to stop. Both the actual reduction by a step and the
    /// reduction that the linear model predicts must be this small. Default 1e-14.
    pub reduction: f64,
    /// Length of a step over the length of the parameters at which to stop, in the scaled norm.
    /// Default 1e-14.
    pub step: f64,
    /// Cosine between the residuals and every column of the Jacobian at which to stop. Default
    /// 1e-14.
    pub gradient: f64,
    /// Limit on the number of steps, accepted or rejected. Default 300.
    pub iterations: usize,
    /// Function of a residual whose sum is minimised. Default [`Loss::Squares`].
    pub loss: Loss,
    /// Whether the minimisation ends with undamped steps, which cost a few evaluations and gain the
    /// last digits. Default `true`.
    pub polish: bool,
}

impl Default for MinimiserSettings {
    /// Returns settings for [`Loss::Squares`] with tolerances near rounding: on small problems the
    /// last digits cost little.
    fn default() -> Self {
        Self {
            reduction: 1e-14,
            step: 1e-14,
            gradient: 1e-14,
            iterations: 300,
            loss: Loss::Squares,
            polish: true,
        }
    }
}

/// Reason why the iteration stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Stop {
    /// Convergence: the sum no longer falls.
    Reduction,
    /// Convergence: the parameters no longer move.
    Step,
    /// Convergence: the residuals are orthogonal to every change of the free parameters.
    Gradient,
    /// Convergence: all residuals are zero.
    Exact,
    /// Limit on the number of iterations.
    Iterations,
    /// Failure of all steps, however short, to achieve the predicted reduction.
    Stalled,
    /// Residuals at the starting values, or derivatives at the best point, that are not finite.
    NotFinite,
    /// Problem without parameters or without residuals.
    Empty,
    /// Refusal of the input, before the residuals were evaluated.
    Invalid {
        /// Index of the parameter that is refused, or `None` if weights are refused.
        parameter: Option<usize>,
        /// Reason of the refusal.
        reason: InvalidInput,
    },
    /// Request by the function that watches the iterations.
    Interrupted,
}

impl Stop {
    /// Returns `true` for the four reasons that mean a minimum to within rounding: `Reduction`,
    /// `Step`, `Gradient` and `Exact`.
    #[must_use]
    pub fn converged(self) -> bool {
        matches!(self, Self::Reduction | Self::Step | Self::Gradient | Self::Exact)
    }
}

/// State of a minimisation before a step.
#[derive(Clone, Copy, Debug)]
pub struct Iteration<'a> {
    /// Number of steps so far, accepted or rejected.
    pub number: usize,
    /// Best parameters so far.
    pub parameters: &'a [f64],
    /// Sum of the losses at `parameters`.
    pub sum: f64,
    /// Number of evaluations of the residuals so far.
    pub evaluations: usize,
}

/// Result of a minimisation.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Best parameters found, in the order of the parameters that were given.
    pub parameters: Vec<f64>,
    /// Root of the weighted mean square residual at `parameters`, `$\sqrt{\sum_i w_i r_i^2/n}$`
    /// over all `$n$` residuals, in the unit of the residuals. NaN if nothing was evaluated.
    pub rms: f64,
    /// Sum of the losses at `parameters`. For [`Loss::Squares`] it is the weighted sum of squares.
    pub sum: f64,
    /// Number of steps, accepted or rejected.
    pub iterations: usize,
    /// Number of evaluations of the residuals, including the evaluations for differences.
    pub evaluations: usize,
    /// Reason why the iteration stopped.
    pub stop: Stop,
}

/// Minimises the weighted sum of squared residuals of `problem`, or the sum of another loss, within
/// the bounds of `parameters`.
///
/// Each step solves \[Lev44, Mar63\]
///
/// ```math
/// \min_v \left\| \begin{pmatrix} J \\ \sqrt\lambda\,D \end{pmatrix} v
///   + \begin{pmatrix} r \\ 0 \end{pmatrix} \right\|, \qquad \|D v\| \le \Delta
/// ```
///
/// by a singular value decomposition, so that the condition number is not squared. `$D$` holds the
/// largest norm that each column of `$J$` has had, which makes the method independent of the units
/// of the parameters. The damping `$\lambda$` follows from the radius `$\Delta$` of the trust
/// region. The radius follows from the ratio of actual to predicted reduction \[Mor78\]. A damped
/// step is corrected by the second derivative of the residuals along the step, which takes one
/// evaluation. Curved valleys then take fewer steps. A step whose correction is too large is
/// rejected \[TS12\].
///
/// A parameter at a bound is held while the gradient points outwards. The step of the free
/// parameters is projected on the bounds, and the reduction is predicted for the projected step.
/// The last steps are undamped: near its minimum the sum is too flat to separate parameters that
/// the linear model still separates.
///
/// A report is returned in every case. [`Report::stop`] says whether it is a minimum
/// ([`Stop::converged`]), or why not.
///
/// ```
/// use drape_lm::{Parameter, Problem, MinimiserSettings, minimise};
///
/// /// Rosenbrock's valley.
/// struct Valley;
///
/// impl Problem for Valley {
///     fn residual_count(&self) -> usize { 2 }
///     fn residuals(&self, p: &[f64], r: &mut [f64]) {
///         (r[0], r[1]) = (10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]);
///     }
/// }
///
/// let start = [-1.2, 1.0].map(Parameter::new);
/// let report = minimise(&Valley, &start, &MinimiserSettings::default());
/// assert!(report.stop.converged() && (report.parameters[1] - 1.0).abs() < 1e-10);
/// ```
#[must_use]
pub fn minimise(
    problem: &(impl Problem + ?Sized),
    parameters: &[Parameter],
    settings: &MinimiserSettings,
) -> Report {
    minimise_watched(problem, parameters, settings, &mut |_| ControlFlow::Continue(()))
}

/// Minimises as [`minimise`] does, and calls `watch` before each step. The minimisation ends with
/// [`Stop::Interrupted`] and the best parameters so far when `watch` returns
/// [`ControlFlow::Break`].
///
/// ```
/// use std::ops::ControlFlow;
///
/// use drape_lm::{MinimiserSettings, Parameter, ResidualFunction, Stop, minimise_watched};
///
/// let root_of_two = ResidualFunction::new(1, |p, residuals| residuals[0] = p[0] * p[0] - 2.0);
/// let start = [Parameter::new(100.0)];
/// let settings = MinimiserSettings::default();
/// let report = minimise_watched(&root_of_two, &start, &settings, &mut |iteration| {
///     // One per cent is good enough here.
///     if iteration.sum < 1e-4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// });
/// assert_eq!(report.stop, Stop::Interrupted);
/// assert!((report.parameters[0] - 2.0f64.sqrt()).abs() < 0.01);
/// ```
#[must_use]
pub fn minimise_watched(
    problem: &(impl Problem + ?Sized),
    parameters: &[Parameter],
    settings: &MinimiserSettings,
    watch: &mut dyn FnMut(Iteration<'_>) -> ControlFlow<()>,
) -> Report {
    if let Some(Refusal { parameter, reason }) = refusal(problem, parameters) {
        let stop = Stop::Invalid { parameter, reason };
        let parameters = parameters.iter().map(|parameter| parameter.start).collect();
        let (rms, sum) = (f64::NAN, f64::NAN);
        return Report { parameters, rms, sum, iterations: 0, evaluations: 0, stop };
    }
    let start: Vec<f64> = parameters.iter().map(|p| p.clamp(p.start)).collect();
    let mut iterate = Iterate::new(problem, parameters, &start, settings.loss);
    if parameters.is_empty() || iterate.residuals.is_empty() {
        return report(&iterate, 0, Stop::Empty);
    }
    if !iterate.sum.is_finite() {
        return report(&iterate, 0, Stop::NotFinite);
    }

    iterate.linearise();
    let size = iterate.length(&start);
    let mut radius = FIRST_RADIUS * if size > 0.0 { size } else { 1.0 };

    for iteration in 0..settings.iterations {
        if iterate.sum == 0.0 {
            return report(&iterate, iteration, Stop::Exact);
        }
        let state = Iteration {
            number: iteration,
            parameters: &iterate.values,
            sum: iterate.sum,
            evaluations: iterate.evaluations,
        };
        if watch(state).is_break() {
            return report(&iterate, iteration, Stop::Interrupted);
        }
        if !iterate.is_linearised() {
            return report(&iterate, iteration, Stop::NotFinite);
        }
        if iterate.gradient() <= settings.gradient {
            return polish(iterate, settings, iteration, Stop::Gradient);
        }

        let damping = iterate.damping(radius);
        let step = iterate.step(damping);
        let length = iterate.length(&step);
        let short = length <= settings.step * iterate.length(&iterate.values);
        let predicted = iterate.predicted_reduction(&step) / iterate.sum;

        // A step without a usable correction is too long for the linear model.
        let Some(step) = corrected(&mut iterate, &step, damping) else {
            if short {
                return no_step(iterate, settings, iteration + 1);
            }
            radius = SHRINK * length;
            continue;
        };

        let values = iterate.shifted(&step);
        let trial = iterate.evaluate(&values);
        let actual = 1.0 - trial.sum / iterate.sum;
        let gain = actual / predicted;

        if predicted > 0.0 && gain > ACCEPTED_GAIN {
            iterate.accept(values, trial);
            if predicted.max(actual) <= settings.reduction {
                return polish(iterate, settings, iteration + 1, Stop::Reduction);
            }
            if short {
                return polish(iterate, settings, iteration + 1, Stop::Step);
            }

            // Near the minimum the gradient needs the digits of central differences.
            if actual < CENTRAL_BELOW {
                iterate.difference = Difference::Central;
            }
            iterate.linearise();

            if gain < POOR_GAIN {
                radius = SHRINK * length;
            } else if gain > GOOD_GAIN || damping == 0.0 {
                radius = GROW * length;
            }
            continue;
        }

        // The step is rejected. At the minimum the prediction is below the rounding of the sum,
        // which means convergence.
        if predicted <= settings.reduction && actual.abs() <= ROUNDING {
            return polish(iterate, settings, iteration + 1, Stop::Reduction);
        }
        if short {
            return no_step(iterate, settings, iteration + 1);
        }

        // The rejection may be due to errors of the forward differences.
        if iterate.difference == Difference::Forward {
            iterate.difference = Difference::Central;
            iterate.linearise();
        }
        radius = SHRINK * length;
    }
    report(&iterate, settings.iterations, Stop::Iterations)
}

/// Returns the damped `step` with its second-order correction, or `None` if the correction is too
/// large or is not finite. An undamped `step` is returned without a correction.
fn corrected(
    iterate: &mut Iterate<impl Problem + ?Sized>,
    step: &[f64],
    damping: f64,
) -> Option<Vec<f64>> {
    if damping == 0.0 {
        return Some(step.to_vec());
    }
    let acceleration = iterate.acceleration(step, damping)?;
    // The correction is half the acceleration, and the criterion is about the whole acceleration.
    if !(2.0 * iterate.length(&acceleration) <= LARGEST_ACCELERATION * iterate.length(step)) {
        return None;
    }
    let mut corrected: Vec<f64> = step.iter().zip(&acceleration).map(|(v, a)| v + a).collect();
    iterate.project(&mut corrected);
    Some(corrected)
}

/// Returns the report for an `iterate` that no step can improve. The reason is [`Stop::Step`], or
/// [`Stop::Stalled`] if both the gradient and the residuals are too large for a minimum.
fn no_step(
    iterate: Iterate<impl Problem + ?Sized>,
    settings: &MinimiserSettings,
    iterations: usize,
) -> Report {
    let floor = RESIDUAL_ROUNDING * iterate.length(&iterate.values);
    if iterate.gradient() > SLOPING && iterate.residuals.norm() > floor {
        return report(&iterate, iterations, Stop::Stalled);
    }
    polish(iterate, settings, iterations, Stop::Step)
}

/// Returns the report of `iterate` after undamped steps, if the `settings` ask for them. The steps
/// go on as long as they shrink and the sum rises by no more than rounding.
fn polish(
    mut iterate: Iterate<impl Problem + ?Sized>,
    settings: &MinimiserSettings,
    iterations: usize,
    stop: Stop,
) -> Report {
    /// Ratio of the lengths of successive undamped steps above which the steps are rounding.
    const POLISH_SHRINK: f64 = 0.9;
    /// Relative length below which an undamped step is the last one.
    const POLISH_LENGTH: f64 = 1e-12;

    if !settings.polish {
        return report(&iterate, iterations, stop);
    }
    iterate.difference = Difference::Central;
    let mut last_length = f64::INFINITY;
    for _ in 0..POLISH_STEPS {
        iterate.linearise();
        let step = iterate.step(0.0);
        let length = iterate.length(&step);
        if !(length < POLISH_SHRINK * last_length) {
            break;
        }
        last_length = length;

        let values = iterate.shifted(&step);
        let trial = iterate.evaluate(&values);
        if !(trial.sum <= iterate.sum * (1.0 + ROUNDING)) {
            break;
        }
        iterate.accept(values, trial);
        if length <= POLISH_LENGTH * iterate.length(&iterate.values) {
            break;
        }
    }
    report(&iterate, iterations, stop)
}

/// Returns the report of the current point of `iterate`.
fn report(iterate: &Iterate<impl Problem + ?Sized>, iterations: usize, stop: Stop) -> Report {
    let count = iterate.residuals.len().max(1) as f64;
    Report {
        parameters: iterate.values.clone(),
        rms: (iterate.residuals.norm_squared() / count).sqrt(),
        sum: iterate.sum,
        iterations,
        evaluations: iterate.evaluations,
        stop,
    }
}
