//! KES values of a fitted law with their intervals, beside the values that are read from the curve.
//!
//! The error of a value `$v$` of the law follows from the covariances `$C$` of its parameters,
//!
//! ```math
//! \sigma_v^2 = \nabla v^T\,C\,\nabla v
//! ```
//!
//! and contains nothing of the misfit of the law. The value that is read from the curve needs no
//! law. Its error is the noise of the points at which it is read. The interval contains both: the
//! value of the law with the smaller of the two errors, and the reading with its error.

use drape_kes::{Curve, EvaluationPoints, Symbol, Test};

use crate::regression::curve_fit::CurveFit;
use crate::regression::estimate::{Undetermined, ValueEstimate};
use crate::settings::FitSettings;
use crate::values::of_law::LawValue;

/// Step of a central difference over the size of a parameter: the cube root of the rounding of the
/// values, whose bisections end at 1e-16.
const STEP: f64 = 1e-5;

/// Half width of a 95 % interval of a normal variate over its standard deviation.
const NORMAL_QUANTILE: f64 = 1.96;

/// Returns the KES values of the law of `fit`, where `values` returns the values of the law with
/// other parameters.
///
/// A test without a recovery has no resilience RT.
pub(crate) fn value_estimates(
    curve: &Curve,
    fit: &CurveFit,
    settings: &FitSettings,
    values: impl Fn(&[f64]) -> Vec<LawValue>,
) -> Vec<ValueEstimate> {
    let parameters = fit.parameter_values();
    let gradient = gradient(fit, &parameters, &values);
    let readings = curve.values(&evaluation_points(curve, settings));

    let mut estimates = Vec::new();
    for (index, law) in values(&parameters).into_iter().enumerate() {
        let reading = readings.iter().find(|reading| reading.symbol == law.symbol);
        let (Some(value), Some(reading)) = (law.value, reading) else { continue };
        if matches!(reading.value, Err(drape_kes::Error::NoRecovery)) {
            continue;
        }
        let reading = reading.value.as_ref().map(|value| *value).map_err(ToString::to_string);
        let half = half_width(fit, &gradient, index);
        let interval = half.ok_or(Undetermined::NotSmooth).map(|half| match reading {
            Ok(read) => {
                let noise = reading_noise(curve, fit, law.symbol, settings) / law.symbol.factor();
                let noise = NORMAL_QUANTILE * noise;
                let half = half.min(noise);
                [(value - half).min(read - noise), (value + half).max(read + noise)]
            }
            Err(_) => [value - half, value + half],
        });
        estimates.push(ValueEstimate { symbol: law.symbol, value, curve: reading, interval });
    }
    estimates
}

/// Returns the standard deviation of the value `symbol` that is read from `curve`, in SI, due to
/// the noise of the load.
///
/// The work under a branch is a sum over its points. LT is read at one point too, the largest load.
/// The width of a loop is the difference of two loads. A slope is taken between the means of two
/// loads. Loops have two sides.
fn reading_noise(curve: &Curve, fit: &CurveFit, symbol: Symbol, settings: &FitSettings) -> f64 {
    let noise = fit.noise * curve.load_range().span();
    match symbol {
        Symbol::TwoHb | Symbol::TwoHg | Symbol::TwoHg5 => noise,
        Symbol::B => slope_noise(noise, settings.bending_points.slope),
        Symbol::G => slope_noise(noise, settings.shear_points.slope),
        Symbol::Lt | Symbol::Wt | Symbol::Rt | Symbol::Em => tensile_noise(curve, noise, symbol),
    }
}

/// Returns the standard deviation of a slope between two deformations, for a `noise` of the load.
fn slope_noise(noise: f64, [from, to]: [f64; 2]) -> f64 {
    noise / ((to - from) * std::f64::consts::SQRT_2)
}

/// Returns the standard deviation of a tensile value that is read from `curve`, in SI, for a
/// `noise` of the load, in N/m.
fn tensile_noise(curve: &Curve, noise: f64, symbol: Symbol) -> f64 {
    let Ok(values) = curve.tensile_values() else { return f64::INFINITY };
    let branches = curve.branches();
    let [loading, recovery] = [0, 1].map(|branch| {
        let points = branches.get(branch).map_or(1, |branch| branch.points.len());
        noise * values.extension / (points as f64).sqrt()
    });
    let of_work = loading / values.work;
    // An error of the largest strain adds a strip of the largest load to the work of both branches.
    let of_strain = extension_noise(curve);
    let strip = values.maximum_tension * of_strain / values.work;
    match symbol {
        Symbol::Em => of_strain,
        Symbol::Wt => values.work * of_work.hypot(strip),
        Symbol::Lt => {
            let of_extension = strip - of_strain / values.extension;
            let of_load = noise / values.maximum_tension;
            values.linearity * of_work.hypot(of_load).hypot(of_extension)
        }
        _ => {
            let resilience = values.resilience.unwrap_or(0.0);
            let of_recovery = recovery / values.work;
            of_recovery.hypot(resilience * of_work).hypot((1.0 - resilience) * strip)
        }
    }
}

/// Returns the standard deviation of the largest strain of a tensile `curve`, a ratio.
///
/// A smoothed path turns where the lines through some ten points before and after the turn end. The
/// end of such a line errs by `$2/\sqrt n$` of the noise, the mean of two ends by less than half.
fn extension_noise(curve: &Curve) -> f64 {
    let path = curve.preparation().and_then(|preparation| preparation.path.as_ref());
    path.map_or(0.0, |path| if path.smoothed { 0.5 * path.noise } else { path.noise })
}

/// Returns the points at which the values of `curve` are read. The values of a tensile curve are
/// read at its largest load, so that curve and law are compared at equal load.
fn evaluation_points(curve: &Curve, settings: &FitSettings) -> EvaluationPoints {
    EvaluationPoints {
        maximum_tension: largest_load(curve),
        bending: settings.bending_points,
        shear: settings.shear_points,
    }
}

/// Returns the load at the end of the first loading of a tensile `curve`, in N/m. For other curves
/// returns the largest load.
pub(crate) fn largest_load(curve: &Curve) -> f64 {
    let of_tension = (curve.test == Test::Tensile).then(|| curve.tensile_values().ok()).flatten();
    of_tension.map_or(curve.load_range().high, |values| values.maximum_tension)
}

/// Returns the derivatives of the values by each of the `parameters` that the curve determines;
/// `None` for the other parameters.
fn gradient(
    fit: &CurveFit,
    parameters: &[f64],
    values: &impl Fn(&[f64]) -> Vec<LawValue>,
) -> Vec<Option<Vec<f64>>> {
    let mut gradient = Vec::with_capacity(parameters.len());
    for index in 0..parameters.len() {
        if fit.covariance[(index, index)] <= 0.0 {
            gradient.push(None);
            continue;
        }
        let step = STEP * parameters[index].abs().max(f64::MIN_POSITIVE);
        let [high, low] = [1.0, -1.0].map(|sign| {
            let mut moved = parameters.to_vec();
            moved[index] += sign * step;
            values(&moved)
        });
        let slopes = high.iter().zip(&low).map(|(high, low)| {
            let rise = high.value.zip(low.value).map(|(high, low)| high - low);
            rise.map_or(f64::NAN, |rise| rise / (2.0 * step))
        });
        gradient.push(Some(slopes.collect()));
    }
    gradient
}

/// Returns half the width of the 95 % interval of the value with the index `value`; `None` if it
/// has no derivative.
fn half_width(fit: &CurveFit, gradient: &[Option<Vec<f64>>], value: usize) -> Option<f64> {
    let known: Vec<(usize, f64)> = gradient
        .iter()
        .enumerate()
        .filter_map(|(index, slopes)| Some((index, slopes.as_ref()?[value])))
        .collect();
    let mut variance = 0.0;
    for (i, a) in &known {
        for (j, b) in &known {
            variance += a * b * fit.covariance[(*i, *j)];
        }
    }
    let half = fit.quantile * variance.max(0.0).sqrt();
    half.is_finite().then_some(half)
}
