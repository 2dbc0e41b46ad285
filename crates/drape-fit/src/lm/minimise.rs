//! The iteration: damped Gauss–Newton steps, projected on the bounds.

use super::jacobian::Difference;
use super::search::Search;
use super::{Loss, Parameter, Problem};

/// First radius over the length of the parameters at the start.
///
/// Large trusts the linear model far from the data, small creeps. Of the 54 starts of the NIST reference
/// problems, 53 are solved for radii from 0.2 to 3.6, but for one more at 0.9; the far start of MGH10, where the
/// model is 500 times the data, is solved for some radii and not for others, and for all from 0.6 to 0.8.
const FIRST_RADIUS: f64 = 0.7;
/// Longest second-order part of a step, over the first-order part, that is taken.
///
/// Beyond it the linear model is not trusted and the radius is halved, unseen whether the sum would have
/// fallen: that keeps parameters from running off into flat regions. Transtrum and Sethna advise 0.75, and
/// less for hard problems; with 0.75 two of the 54 starts are lost, with 0.3 canyons are followed too slowly.
const STRAIGHT: f64 = 0.45;
/// Least part of the predicted reduction that a step must bring to be taken.
const ACCEPTED_GAIN: f64 = 1e-4;
/// Parts of the predicted reduction below which the radius shrinks and above which it grows [Moré 1978].
const POOR_GAIN: f64 = 0.25;
const GOOD_GAIN: f64 = 0.75;
/// Change of the radius where the linear model was poor, and where it was good.
const SHRINK: f64 = 0.5;
const GROW: f64 = 2.0;
/// Relative reduction below which central differences replace forward ones: far away their eight digits are
/// enough and cost half, near the minimum the gradient is a small difference.
const NEAR: f64 = 1e-3;
/// Relative change of a sum that is only rounding, for up to some ten thousand residuals.
const ROUNDING: f64 = 1e-13;
/// Cosine between the residuals and a derivative that is no minimum.
const SLOPING: f64 = 1e-3;
/// Norm of the residuals, over that of the parameters times their derivatives, that is only rounding: there
/// the cosines mean nothing.
const RESIDUAL_ROUNDING: f64 = 1e-13;
/// Undamped steps at the end. One or two are usual; where the residuals are large each brings a factor of two
/// or three only, and a dozen brings four digits.
const LAST_STEPS: usize = 12;
/// A last step that is not shorter than this part of the one before it is made of rounding.
const SHORTER: f64 = 0.9;
/// A last step that is shorter than this part of the parameters is the last.
const LAST_LENGTH: f64 = 1e-12;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Stop when neither the last step nor the next one predicted reduces the sum of squares by more than
    /// this part.
    pub reduction: f64,
    /// Stop when a step is shorter than this part of the parameters, in the scaled norm.
    pub step: f64,
    /// Stop when the cosine between the residuals and every column of the Jacobian is below this.
    pub gradient: f64,
    /// Stop after this many steps taken or refused.
    pub iterations: usize,
    /// How much a large residual counts.
    pub loss: Loss,
    /// Whether to end with undamped steps, which cost a few evaluations and bring the last digits.
    pub polish: bool,
}

impl Default for Settings {
    /// As far as rounding lets it go: the problems here are small, and the last digits cost little.
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

/// Why the iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The sum of squares no longer falls.
    Reduction,
    /// The parameters no longer move.
    Step,
    /// The residuals are orthogonal to every change of the free parameters.
    Gradient,
    /// All residuals are zero.
    Exact,
    /// The limit on iterations was reached.
    Iterations,
    /// No step, however short, brought what the linear model promised.
    Stalled,
    /// The residuals at the starting values, or the derivatives at the best point, are not all finite.
    NotFinite,
    /// There are no parameters or no residuals.
    Empty,
}

impl Stop {
    /// Whether the parameters are a minimum as far as rounding can tell.
    pub fn converged(self) -> bool {
        matches!(self, Self::Reduction | Self::Step | Self::Gradient | Self::Exact)
    }
}

/// Where the iteration ended, and how it got there.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The best parameters found.
    pub parameters: Vec<f64>,
    /// Root of the weighted mean square residual there, in the unit of the residuals.
    pub rms: f64,
    /// Sum of the losses there: in least squares, the weighted sum of squares.
    pub sum: f64,
    /// Steps taken or refused.
    pub iterations: usize,
    /// Evaluations of the residuals, those for differences included.
    pub evaluations: usize,
    /// Why it ended.
    pub stop: Stop,
}

/// Minimises the weighted sum of squared residuals, or of another loss, within the bounds.
///
/// Each step solves
///
/// ```math
/// \min_v \left\| \begin{pmatrix} J \\ \sqrt\lambda\,D \end{pmatrix} v
///   + \begin{pmatrix} r \\ 0 \end{pmatrix} \right\|, \qquad \|D v\| \le \Delta
/// ```
///
/// by singular values, so that the condition number is not squared. `$D$` holds the largest norm each column
/// of `$J$` has had, which makes the method independent of the units of the parameters; the damping
/// `$\lambda$` follows from the radius `$\Delta$`, which follows from how well the last steps were predicted
/// [Moré 1978]. A damped step is bent by the second derivative of the residuals along it, at the price of one
/// evaluation: narrow curved canyons are followed in fewer steps, and a step that bends too much is not taken
/// [Transtrum & Sethna 2012]. Parameters at a bound that the gradient pushes outwards are held; the step of
/// the others is cut at the bounds, and the prediction is made for the step as cut. The last steps are
/// undamped: the sum is flat at its minimum and cannot tell parameters apart that the linear model still can.
pub fn minimise(problem: &impl Problem, parameters: &[Parameter], settings: &Settings) -> Report {
    let start: Vec<f64> = parameters.iter().map(|p| p.clamp(p.start)).collect();
    let mut search = Search::new(problem, parameters, &start, settings.loss);
    if parameters.is_empty() || search.residuals.is_empty() {
        return report(&search, 0, Stop::Empty);
    }
    if !search.sum.is_finite() {
        return report(&search, 0, Stop::NotFinite);
    }
    search.linearise();
    let size = search.length(&start);
    let mut radius = FIRST_RADIUS * if size > 0.0 { size } else { 1.0 };
    for iteration in 0..settings.iterations {
        if search.sum == 0.0 {
            return report(&search, iteration, Stop::Exact);
        }
        if !search.is_linearised() {
            return report(&search, iteration, Stop::NotFinite);
        }
        if search.gradient() <= settings.gradient {
            return finish(search, settings, iteration, Stop::Gradient);
        }
        let damping = search.damping(radius);
        let step = search.step(damping);
        let length = search.length(&step);
        let short = length <= settings.step * search.length(&search.at);
        let predicted = search.predicted(&step) / search.sum;
        let Some(bent) = bent(&mut search, &step, damping) else {
            if short {
                return stand(search, settings, iteration + 1);
            }
            radius = SHRINK * length;
            continue;
        };
        let trial = search.shifted(&bent);
        let (sum, residuals) = search.evaluate(&trial);
        let actual = 1.0 - sum / search.sum;
        let gain = actual / predicted;
        if predicted > 0.0 && gain > ACCEPTED_GAIN {
            search.accept(trial, sum, residuals);
            if predicted.max(actual) <= settings.reduction {
                return finish(search, settings, iteration + 1, Stop::Reduction);
            }
            if short {
                return finish(search, settings, iteration + 1, Stop::Step);
            }
            if actual < NEAR {
                search.difference = Difference::Central;
            }
            search.linearise();
            if gain < POOR_GAIN {
                radius = SHRINK * length;
            } else if gain > GOOD_GAIN || damping == 0.0 {
                radius = GROW * length;
            }
            continue;
        }
        // Refused. At the bottom the promise is below the rounding of the sum: that is convergence.
        if predicted <= settings.reduction && actual.abs() <= ROUNDING {
            return finish(search, settings, iteration + 1, Stop::Reduction);
        }
        if short {
            return stand(search, settings, iteration + 1);
        }
        if search.difference == Difference::Forward {
            search.difference = Difference::Central;
            search.linearise();
        }
        radius = SHRINK * length;
    }
    report(&search, settings.iterations, Stop::Iterations)
}

/// A damped step with its second-order part; nothing where that is too long or has no value.
fn bent(search: &mut Search<impl Problem>, step: &[f64], damping: f64) -> Option<Vec<f64>> {
    if damping == 0.0 {
        return Some(step.to_vec());
    }
    let bend = search.bend(step, damping)?;
    // The bend is half the second derivative, and the criterion is for all of it.
    if !(2.0 * search.length(&bend) <= STRAIGHT * search.length(step)) {
        return None;
    }
    let mut bent: Vec<f64> = step.iter().zip(&bend).map(|(v, a)| v + a).collect();
    search.cut(&mut bent);
    Some(bent)
}

/// Ends where no step can be taken: at a minimum, unless the gradient or the residuals say otherwise.
fn stand(search: Search<impl Problem>, settings: &Settings, iterations: usize) -> Report {
    let floor = RESIDUAL_ROUNDING * search.length(&search.at);
    if search.gradient() > SLOPING && search.residuals.norm() > floor {
        return report(&search, iterations, Stop::Stalled);
    }
    finish(search, settings, iterations, Stop::Step)
}

/// Takes undamped steps as long as they become shorter and the sum rises by no more than rounding.
fn finish(
    mut search: Search<impl Problem>,
    settings: &Settings,
    iterations: usize,
    stop: Stop,
) -> Report {
    if !settings.polish {
        return report(&search, iterations, stop);
    }
    search.difference = Difference::Central;
    let mut last = f64::INFINITY;
    for _ in 0..LAST_STEPS {
        search.linearise();
        let step = search.step(0.0);
        let length = search.length(&step);
        if !(length < SHORTER * last) {
            break;
        }
        last = length;
        let trial = search.shifted(&step);
        let (sum, residuals) = search.evaluate(&trial);
        if !(sum <= search.sum * (1.0 + ROUNDING)) {
            break;
        }
        search.accept(trial, sum, residuals);
        if length <= LAST_LENGTH * search.length(&search.at) {
            break;
        }
    }
    report(&search, iterations, stop)
}

fn report(search: &Search<impl Problem>, iterations: usize, stop: Stop) -> Report {
    let count = search.residuals.len().max(1) as f64;
    Report {
        parameters: search.at.clone(),
        rms: (search.residuals.norm_squared() / count).sqrt(),
        sum: search.sum,
        iterations,
        evaluations: search.evaluations,
        stop,
    }
}
