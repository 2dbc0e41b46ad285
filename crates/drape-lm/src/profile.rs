//! Profile likelihood intervals: from the loss itself in place of its linear model.
//!
//! Takes the report of `minimise` and minimises again with one parameter held at trial values.

use rayon::prelude::*;

use crate::covariance::{Covariance, Undetermined};
use crate::minimise::{MinimiserSettings, Report, Stop, minimise};
use crate::problem::{Parameter, Problem};
use crate::student::student_quantile;

/// Relative tolerance on the deviation at an end.
///
/// The deviation is nearly proportional to the distance, so the ends are good to the same fraction
/// of the half width.
const TOLERANCE: f64 = 1e-4;
/// Largest growth of the step outwards, per trial.
const GROWTH: f64 = 4.0;
/// Limit on the trials outwards: with the growth, 1e12 standard errors.
const OUTWARD_TRIALS: usize = 20;
/// Limit on the trials between a value inside and one outside; five are usual.
const BRACKET_TRIALS: usize = 60;
/// Relative fall of the loss along the profile that is no rounding: the fit was not at the minimum.
const LOWER: f64 = 1e-9;
/// Relative reduction and step at which the others are fitted well enough.
///
/// The loss is flat around its minimum, so both leave the deviation better than [`TOLERANCE`].
const FIT_TOLERANCE: f64 = 1e-10;

/// Level of the intervals, and settings of the fits along the profile.
///
/// ```
/// let settings = drape_lm::ProfileSettings { level: 0.99, ..Default::default() };
/// assert_eq!(settings.minimiser, drape_lm::MinimiserSettings::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileSettings {
    /// Probability that an interval contains the true value, 0 to 1.
    pub level: f64,
    /// Settings with which the fit was made.
    pub minimiser: MinimiserSettings,
}

impl Default for ProfileSettings {
    /// Returns a level of 95 % and the default settings of the minimiser.
    fn default() -> Self {
        Self { level: 0.95, minimiser: MinimiserSettings::default() }
    }
}

/// One end of an interval.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// Value at which the loss has risen to the level.
    At(f64),
    /// Bound of the parameter, where the loss is still below the level.
    AtBound(f64),
    /// Value at which the search ended with the loss below the level: the data set no end.
    Unbounded(f64),
    /// Parameters with a lower loss than that of the fit: start there again.
    LowerMinimum(Vec<f64>),
    /// Value at which the other parameters could not be fitted, and why; the end is farther out.
    NotConverged(f64, Stop),
}

impl End {
    /// Returns the value of a closed end, or of the bound that closes it.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::At(value) | Self::AtBound(value) => Some(*value),
            _ => None,
        }
    }
}

/// Interval that contains the true parameter with the probability of its level.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// End below the estimate.
    pub lower: End,
    /// End above the estimate.
    pub upper: End,
}

impl Interval {
    /// Returns whether a value is inside; an end that was not found excludes nothing on its side.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        self.lower.value().is_none_or(|lower| value >= lower)
            && self.upper.value().is_none_or(|upper| value <= upper)
    }
}

/// Computes the profile likelihood intervals of all parameters.
///
/// Each parameter is moved away from its estimate while all others are fitted again, until the loss
/// has risen to the level \[Bat88, §6.1.2\]:
///
/// ```math
/// \sqrt{\frac{S(\theta_j) - S_{min}}{s^2}} = t_{\nu}
/// ```
///
/// Unlike standard errors this holds for models that are curved over their errors, does not depend
/// on how the model is parameterised, respects bounds, and shows where an interval has no end.
/// Parameters are done in parallel, each by the same steps for any number of threads.
///
/// # Errors
/// In place of an interval, the reason why a parameter has none.
#[must_use]
pub fn profile(
    problem: &(impl Problem + Sync),
    parameters: &[Parameter],
    report: &Report,
    settings: &ProfileSettings,
) -> Vec<Result<Interval, Undetermined>> {
    let ProfileSettings { level, minimiser } = *settings;
    let covariance = Covariance::new(problem, parameters, report, minimiser.loss);
    let count = parameters.len().min(report.parameters.len());
    let profile = Profile {
        problem,
        parameters: &parameters[..count],
        report,
        settings: MinimiserSettings {
            reduction: FIT_TOLERANCE,
            step: FIT_TOLERANCE,
            polish: false,
            ..minimiser
        },
        quantile: student_quantile(level, covariance.degrees_of_freedom),
        covariance: &covariance,
    };
    (0..count).into_par_iter().map(|j| profile.interval(j)).collect()
}

struct Profile<'a, P> {
    problem: &'a P,
    parameters: &'a [Parameter],
    report: &'a Report,
    settings: MinimiserSettings,
    quantile: f64,
    covariance: &'a Covariance,
}

/// Point of a profile.
struct Point {
    /// Value of the parameter that is held.
    value: f64,
    /// All parameters.
    parameters: Vec<f64>,
    /// Deviation less that of the level, in standard deviations.
    excess: f64,
}

impl<P: Problem> Profile<'_, P> {
    fn interval(&self, j: usize) -> Result<Interval, Undetermined> {
        match self.covariance.undetermined(j) {
            Some(Undetermined::AtBound(_)) if self.covariance.degrees_of_freedom > 0 => {}
            Some(reason) => return Err(reason.clone()),
            None => {}
        }
        if !self.quantile.is_finite() {
            return Err(Undetermined::NoDegreesOfFreedom);
        }
        let step = self.first_step(j);
        Ok(Interval { lower: self.end(j, -step), upper: self.end(j, step) })
    }

    /// Returns half the width of the interval of the linear model; at a bound, a first guess.
    fn first_step(&self, j: usize) -> f64 {
        let error = self.covariance.standard_error(j);
        let step = self.quantile * error.unwrap_or_else(|_| self.covariance.conditional_error(j));
        let size = self.report.parameters[j].abs().max(self.parameters[j].scale);
        // Shorter steps are rounding, longer ones belong to a parameter without effect.
        step.clamp(1e3 * f64::EPSILON * size, size / f64::EPSILON)
    }

    /// Searches one end outwards from the estimate.
    fn end(&self, j: usize, first: f64) -> End {
        let parameter = &self.parameters[j];
        let estimate = self.report.parameters[j];
        let mut inside = Point {
            value: estimate,
            parameters: self.report.parameters.clone(),
            excess: -self.quantile,
        };
        let mut before: Option<Point> = None;
        let mut step = first;
        let mut outside = None;
        for _ in 0..OUTWARD_TRIALS {
            let value = parameter.clamp(inside.value + step);
            if value == inside.value {
                return End::AtBound(value);
            }
            let guess = self.guess(j, value, &inside, before.as_ref());
            let point = match self.point(j, value, guess) {
                Ok(point) => point,
                Err(end) => return end,
            };
            if point.excess >= 0.0 {
                outside = Some(point);
                break;
            }
            // The deviation is nearly linear: aim a little beyond the level, to end outside.
            let gained = point.excess - inside.excess;
            let aim = 1.1 * (value - inside.value) * -point.excess / gained;
            let most = GROWTH * (value - inside.value);
            step = if gained > 0.0 && aim.abs() < most.abs() { aim } else { most };
            before = Some(std::mem::replace(&mut inside, point));
        }
        match outside {
            Some(outside) => self.between(j, inside, outside),
            None => End::Unbounded(inside.value),
        }
    }

    /// Finds the value at the level from one on either side, by the Illinois method
    /// \[DJ71\].
    fn between(&self, j: usize, mut inside: Point, mut outside: Point) -> End {
        let (mut inner, mut outer) = (inside.excess, outside.excess);
        for _ in 0..BRACKET_TRIALS {
            if inside.excess.abs().min(outside.excess) <= TOLERANCE * self.quantile {
                break;
            }
            let part = inner / (inner - outer);
            let value = inside.value + part * (outside.value - inside.value);
            if value == inside.value || value == outside.value {
                break;
            }
            let guess = self.guess(j, value, &inside, Some(&outside));
            let point = match self.point(j, value, guess) {
                Ok(point) => point,
                Err(end) => return end,
            };
            if point.excess < 0.0 {
                (inner, outer) = (point.excess, 0.5 * outer);
                inside = point;
            } else {
                (outer, inner) = (point.excess, 0.5 * inner);
                outside = point;
            }
        }
        let nearer = if inside.excess.abs() < outside.excess { inside } else { outside };
        End::At(nearer.value)
    }

    /// Extrapolates the other parameters, through two points or by the linear model.
    fn guess(&self, j: usize, value: f64, from: &Point, other: Option<&Point>) -> Vec<f64> {
        let change = value - from.value;
        let slope = |k: usize| match other {
            Some(other) => (other.parameters[k] - from.parameters[k]) / (other.value - from.value),
            None => {
                let pair = |i| self.covariance.covariance(i, j);
                pair(k).zip(pair(j)).map_or(0.0, |(kj, jj)| kj / jj)
            }
        };
        let moved = |k: usize| {
            let expected = from.parameters[k] + change * slope(k);
            if expected.is_finite() { expected } else { from.parameters[k] }
        };
        (0..self.parameters.len()).map(moved).collect()
    }

    /// Fits the other parameters with one held at a value.
    fn point(&self, j: usize, value: f64, guess: Vec<f64>) -> Result<Point, End> {
        let mut parameters = self.parameters.to_vec();
        for (parameter, start) in parameters.iter_mut().zip(&guess) {
            parameter.start = *start;
        }
        parameters[j].start = value;
        parameters[j] = parameters[j].fixed();
        let report = minimise(self.problem, &parameters, &self.settings);
        let rise = report.sum - self.report.sum;
        if rise < -LOWER * self.report.sum {
            return Err(End::LowerMinimum(report.parameters));
        }
        let excess = self.deviation(rise) - self.quantile;
        // Before the minimum the loss is too large: that proves a value inside, not outside.
        if !report.stop.converged() && !(excess < 0.0) {
            return Err(End::NotConverged(value, report.stop));
        }
        Ok(Point { value, parameters: report.parameters, excess })
    }

    /// Returns a rise of the loss in standard deviations.
    fn deviation(&self, rise: f64) -> f64 {
        let variance = self.covariance.rise_of_one_deviation();
        // An exact fit has no variance: its loss rises beyond every level, or not at all.
        if rise > 0.0 { (rise / variance).sqrt() } else { 0.0 }
    }
}
