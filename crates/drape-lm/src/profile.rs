//! Profile likelihood intervals, which use the loss itself in place of its linear model.
//!
//! [`profile`] takes the report of `minimise` and minimises again with one parameter held at trial
//! values.

#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::covariance::{Covariance, Undetermined};
use crate::minimise::{MinimiserSettings, Report, Stop, minimise};
use crate::problem::{Parameter, Problem};
use crate::student::student_quantile;

/// Relative tolerance on the deviation at an end.
///
/// The deviation is nearly proportional to the distance from the estimate. The error of an end is
/// therefore this fraction of the half width.
const TOLERANCE: f64 = 1e-4;
/// Relative reduction and relative step at which a fit of the other parameters stops.
///
/// The loss is flat around its minimum, so the error of the deviation is below [`TOLERANCE`].
const FIT_TOLERANCE: f64 = 1e-10;

/// Level of the intervals and settings of the fits along the profile.
///
/// ```
/// let settings = drape_lm::ProfileSettings { level: 0.99, ..Default::default() };
/// assert_eq!(settings.minimiser, drape_lm::MinimiserSettings::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct ProfileSettings {
    /// Probability that an interval contains the true value, 0 to 1. Default 0.95.
    pub level: f64,
    /// Settings of the minimisation whose report is profiled. Give the settings with which the
    /// report was found. Default [`MinimiserSettings::default`].
    pub minimiser: MinimiserSettings,
}

impl Default for ProfileSettings {
    /// Returns a level of 95 % and the default [`MinimiserSettings`].
    fn default() -> Self {
        Self { level: 0.95, minimiser: MinimiserSettings::default() }
    }
}

/// One end of an interval.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum End {
    /// Value at which the loss has risen to the level.
    At(f64),
    /// Bound of the parameter, where the loss is still below the level.
    AtBound(f64),
    /// Value at which the search ended with the loss still below the level. The data set no end.
    Unbounded(f64),
    /// Parameters with a lower loss than the report has. Minimise again with these parameters as
    /// the start.
    LowerMinimum(Vec<f64>),
    /// Value at which the fit of the other parameters did not converge, and the reason. The end is
    /// farther out.
    NotConverged(f64, Stop),
}

impl End {
    /// Returns the value of [`End::At`] or [`End::AtBound`], and `None` for an end that is not
    /// known.
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval {
    /// End below the estimate.
    pub lower: End,
    /// End above the estimate.
    pub upper: End,
}

impl Interval {
    /// Returns whether `value` is inside the interval. An end that is not known excludes nothing on
    /// its side.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        self.lower.value().is_none_or(|lower| value >= lower)
            && self.upper.value().is_none_or(|upper| value <= upper)
    }
}

/// Computes the profile likelihood interval of each of `parameters`, in their order, around the
/// minimum in `report`.
///
/// Each parameter is moved away from its estimate while all other parameters are fitted again,
/// until the loss has risen to the level \[Bat88, §6.1.2\]:
///
/// ```math
/// \sqrt{\frac{S(\theta_j) - S_{min}}{s^2}} = t_{\nu}
/// ```
///
/// Here `$S(\theta_j)$` is the least sum with parameter `$j$` held at `$\theta_j$`, `$s^2$` is the
/// variance of the residuals, and `$t_\nu$` is the quantile of Student's distribution.
///
/// Unlike a standard error, the interval holds for models that are curved over their errors, does
/// not depend on how the model is parameterised, respects bounds, and shows if it has no end. The
/// parameters are processed in parallel. The result does not depend on the number of threads.
///
/// # Errors
/// An entry of the result is [`Undetermined`], with the reason, if the parameter has no interval.
#[must_use]
pub fn profile(
    problem: &(impl Problem + Sync + ?Sized),
    parameters: &[Parameter],
    report: &Report,
    settings: &ProfileSettings,
) -> Vec<Result<Interval, Undetermined>> {
    let ProfileSettings { level, minimiser } = *settings;
    let covariance = Covariance::new(problem, parameters, report, minimiser.loss);
    let count = parameters.len();
    if report.parameters.len() != count {
        return vec![Err(Undetermined::OtherFit(report.parameters.len())); count];
    }
    let profile = Profile {
        problem,
        parameters,
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
    #[cfg(feature = "rayon")]
    let numbers = (0..count).into_par_iter();
    #[cfg(not(feature = "rayon"))]
    let numbers = 0..count;
    numbers.map(|j| profile.interval(j)).collect()
}

/// Fit whose parameters are profiled.
struct Profile<'a, P: ?Sized> {
    problem: &'a P,
    parameters: &'a [Parameter],
    /// Report of the fit.
    report: &'a Report,
    /// Settings of the fits with one parameter held.
    settings: MinimiserSettings,
    /// Deviation at the level, in standard deviations.
    quantile: f64,
    /// Linear model of the fit.
    covariance: &'a Covariance,
}

/// Point of a profile.
struct Point {
    /// Value of the parameter that is held.
    value: f64,
    /// Values of all parameters.
    parameters: Vec<f64>,
    /// Deviation at this point less the deviation at the level, in standard deviations.
    excess: f64,
}

impl<P: Problem + ?Sized> Profile<'_, P> {
    /// Returns the interval of parameter `j`, or the reason why it has none.
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

    /// Returns half the width of the interval of parameter `j` in the linear model. For a parameter
    /// at a bound it is a guess from the error that the parameter has if all others are known.
    fn first_step(&self, j: usize) -> f64 {
        let error = self.covariance.standard_error(j);
        let step = self.quantile * error.unwrap_or_else(|_| self.covariance.conditional_error(j));
        let size = self.report.parameters[j].abs().max(self.parameters[j].scale);
        // Shorter steps are rounding, and longer steps belong to a parameter without effect.
        step.clamp(1e3 * f64::EPSILON * size, size / f64::EPSILON)
    }

    /// Searches one end of the interval of parameter `j` outwards from the estimate, beginning with
    /// the step `first_step`.
    fn end(&self, j: usize, first_step: f64) -> End {
        /// Largest growth of the step from one trial to the next.
        const GROWTH: f64 = 4.0;
        /// Limit on the number of trials. With `GROWTH` they reach 1e12 standard errors.
        const OUTWARD_TRIALS: usize = 20;

        let parameter = &self.parameters[j];
        let estimate = self.report.parameters[j];
        let mut inside = Point {
            value: estimate,
            parameters: self.report.parameters.clone(),
            excess: -self.quantile,
        };
        let mut previous: Option<Point> = None;
        let mut step = first_step;
        let mut outside = None;

        for _ in 0..OUTWARD_TRIALS {
            let value = parameter.clamp(inside.value + step);
            if value == inside.value {
                return End::AtBound(value);
            }
            let guess = self.guess(j, value, &inside, previous.as_ref());
            let point = match self.point(j, value, guess) {
                Ok(point) => point,
                Err(end) => return end,
            };
            if point.excess >= 0.0 {
                outside = Some(point);
                break;
            }

            // The deviation is nearly linear in the value. The next trial aims a little beyond the
            // level, so that it is outside.
            let gained = point.excess - inside.excess;
            let aim = 1.1 * (value - inside.value) * -point.excess / gained;
            let longest = GROWTH * (value - inside.value);
            step = if gained > 0.0 && aim.abs() < longest.abs() { aim } else { longest };
            previous = Some(std::mem::replace(&mut inside, point));
        }

        match outside {
            Some(outside) => self.between(j, inside, outside),
            None => End::Unbounded(inside.value),
        }
    }

    /// Finds the value of parameter `j` at the level between `inside` and `outside`, by the
    /// Illinois method \[DJ71\].
    fn between(&self, j: usize, mut inside: Point, mut outside: Point) -> End {
        /// Limit on the number of trials. Five are usual.
        const BRACKET_TRIALS: usize = 60;

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

            // The excess of the end that stays is halved, so that both ends move.
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

    /// Extrapolates all parameters to the point of the profile where parameter `j` is `value`.
    ///
    /// The extrapolation goes through `first` and `second`, or follows the linear model from
    /// `first` if there is no `second`.
    fn guess(&self, j: usize, value: f64, first: &Point, second: Option<&Point>) -> Vec<f64> {
        let change = value - first.value;
        let mut guess = Vec::with_capacity(self.parameters.len());
        for (k, start) in first.parameters.iter().copied().enumerate() {
            let slope = match second {
                Some(second) => (second.parameters[k] - start) / (second.value - first.value),
                None => {
                    let covariance = self.covariance.covariance(k, j);
                    let variance = self.covariance.covariance(j, j);
                    covariance.zip(variance).map_or(0.0, |(kj, jj)| kj / jj)
                }
            };
            let expected = start + change * slope;
            guess.push(if expected.is_finite() { expected } else { start });
        }
        guess
    }

    /// Fits the other parameters, starting from `guess`, with parameter `j` held at `value`.
    ///
    /// # Errors
    /// The end of the interval, if the fit finds a lower minimum or does not converge.
    fn point(&self, j: usize, value: f64, guess: Vec<f64>) -> Result<Point, End> {
        /// Relative fall of the loss along the profile that is more than rounding and means that
        /// the report was not at the minimum.
        const LOWER: f64 = 1e-9;

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
        // Before it converges a fit has too large a loss. A loss below the level then proves that
        // the value is inside, but a loss above the level does not prove that it is outside.
        if !report.stop.converged() && !(excess < 0.0) {
            return Err(End::NotConverged(value, report.stop));
        }
        Ok(Point { value, parameters: report.parameters, excess })
    }

    /// Returns the deviation, in standard deviations, that a `rise` of the loss means.
    fn deviation(&self, rise: f64) -> f64 {
        let variance = self.covariance.rise_of_one_deviation();
        // An exact fit has no variance. Its loss rises beyond every level, or not at all.
        if rise > 0.0 { (rise / variance).sqrt() } else { 0.0 }
    }
}
