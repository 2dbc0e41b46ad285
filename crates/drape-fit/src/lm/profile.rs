//! Intervals from the loss itself instead of its linear model.

use rayon::prelude::*;

use super::{
    Covariance, Parameter, Problem, Report, Settings, Stop, Undetermined, minimise,
    student_quantile,
};

/// How near the deviation at an end must come to that of the level, as a part of it.
///
/// The deviation is nearly proportional to the distance, so the ends are good to as much of the half width.
const NEAR: f64 = 1e-4;
/// Factor by which the first step outwards may grow, per trial.
const GROWTH: f64 = 4.0;
/// Trials outwards: with the growth, a million million standard errors.
const REACHES: usize = 20;
/// Trials between two values known to be inside and outside; five are usual.
const TRIALS: usize = 60;
/// Relative fall of the loss along the profile that is no rounding: the minimum was none.
const LOWER: f64 = 1e-9;
/// Relative reduction and step at which the others are minimised well enough: the loss is flat around its
/// minimum, so both leave the deviation better than [`NEAR`].
const TOLERANCE: f64 = 1e-10;

/// One end of an interval.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// The value at which the loss has risen to the level.
    At(f64),
    /// The bound of the parameter, where the loss is still below the level.
    AtBound(f64),
    /// The loss is still below the level here, so far out that the data set no end.
    Unbounded(f64),
    /// A lower loss than that of the fit was found with these parameters: start there again.
    LowerMinimum(Vec<f64>),
    /// The others could not be fitted with the parameter at this value; the end is farther out.
    NotConverged(f64, Stop),
}

impl End {
    /// The value of a closed end, or of the bound that closes it.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::At(value) | Self::AtBound(value) => Some(*value),
            _ => None,
        }
    }
}

/// An interval that contains the true parameter with the probability of its level.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// Below the estimate.
    pub lower: End,
    /// Above the estimate.
    pub upper: End,
}

impl Interval {
    /// Whether a value is inside; an end that was not found excludes nothing on its side.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        self.lower.value().is_none_or(|lower| value >= lower)
            && self.upper.value().is_none_or(|upper| value <= upper)
    }
}

/// Profile likelihood intervals of all parameters at a level such as 0.95.
///
/// Each parameter is moved away from its estimate while all others are fitted anew, until the loss has risen
/// to the level [Bates & Watts 1988, §6.1.2]:
///
/// ```math
/// \sqrt{\frac{S(\theta_j) - S_{min}}{s^2}} = t_{\nu}
/// ```
///
/// Unlike standard errors this holds for models that are curved over their errors, does not depend on how
/// the parameters are written, respects bounds, and shows where an interval has no end. Parameters are done
/// side by side, each by the same steps for any number of threads.
///
/// # Errors
/// In place of an interval, why a parameter has none at all.
pub fn profile(
    problem: &(impl Problem + Sync),
    parameters: &[Parameter],
    report: &Report,
    (level, settings): (f64, &Settings),
) -> Vec<Result<Interval, Undetermined>> {
    let covariance = Covariance::of(problem, parameters, report, settings.loss);
    let count = parameters.len().min(report.parameters.len());
    let profile = Profile {
        problem,
        parameters: &parameters[..count],
        report,
        settings: Settings { reduction: TOLERANCE, step: TOLERANCE, polish: false, ..*settings },
        quantile: student_quantile(level, covariance.degrees),
        covariance: &covariance,
    };
    (0..count).into_par_iter().map(|j| profile.interval(j)).collect()
}

struct Profile<'a, P> {
    problem: &'a P,
    parameters: &'a [Parameter],
    report: &'a Report,
    settings: Settings,
    quantile: f64,
    covariance: &'a Covariance,
}

/// A point of the profile: the parameters, and the deviation less that of the level.
struct Point {
    value: f64,
    parameters: Vec<f64>,
    excess: f64,
}

impl<P: Problem> Profile<'_, P> {
    fn interval(&self, j: usize) -> Result<Interval, Undetermined> {
        match self.covariance.reason(j) {
            Some(Undetermined::AtBound(_)) if self.covariance.degrees > 0 => {}
            Some(reason) => return Err(reason.clone()),
            None => {}
        }
        if !self.quantile.is_finite() {
            return Err(Undetermined::NoFreedom);
        }
        let step = self.first_step(j);
        Ok(Interval { lower: self.end(j, -step), upper: self.end(j, step) })
    }

    /// Half the width of the interval of the linear model; from a bound, a guess to be corrected.
    fn first_step(&self, j: usize) -> f64 {
        let error = self.covariance.standard_error(j);
        let step = self.quantile * error.unwrap_or_else(|_| self.covariance.error_alone(j));
        let size = self.report.parameters[j].abs().max(self.parameters[j].scale);
        // Shorter steps than this are rounding, and longer ones are of a parameter without effect.
        step.clamp(1e3 * f64::EPSILON * size, size / f64::EPSILON)
    }

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
        for _ in 0..REACHES {
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
            // The deviation is nearly straight: aim at the level, a little beyond to come out.
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

    /// The value at the level, from one on either side of it, by false position with the Illinois weights.
    fn between(&self, j: usize, mut inside: Point, mut outside: Point) -> End {
        let (mut inner, mut outer) = (inside.excess, outside.excess);
        for _ in 0..TRIALS {
            if inside.excess.abs().min(outside.excess) <= NEAR * self.quantile {
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

    /// Where the others are expected: on the line through two points, or as the linear model has it.
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

    /// Fits the others with one parameter at a value.
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
        // Short of the minimum the loss is too large: good enough to be inside, not to be outside.
        if !report.stop.converged() && !(excess < 0.0) {
            return Err(End::NotConverged(value, report.stop));
        }
        Ok(Point { value, parameters: report.parameters, excess })
    }

    /// Rise of the loss in standard deviations.
    fn deviation(&self, rise: f64) -> f64 {
        let variance = self.covariance.rise_of_one_deviation();
        (rise.max(0.0) / variance).sqrt()
    }
}
