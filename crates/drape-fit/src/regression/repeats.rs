//! Uncertainty by repeats: the same law fitted to each specimen.
//!
//! Of `$n$` specimens whose parameters scatter by `$s$`, the mean has the standard error and
//! interval
//!
//! ```math
//! \frac{s}{\sqrt n}, \qquad \theta \pm t_{0.975,\,n-1}\,\frac{s}{\sqrt n}
//! ```
//!
//! The residuals of one curve contain no information about the next specimen, but the scatter does.
//! The wider interval counts.

use drape_kes::Curve;
use drape_lm::student_quantile;

use crate::error::Error;
use crate::regression::curve_fit::CurveFit;

/// Coverage of the intervals.
const LEVEL: f64 = 0.95;

/// Widens the errors of `fit`, a fit to the mean of the repeats of `curve`, by the scatter of the
/// fits to each repeat.
///
/// `identify` fits the selected law to one repeat. A repeat without such a fit is skipped. A
/// parameter that is fixed, or at a bound in the mean, keeps its reason.
pub(crate) fn with_scatter(
    curve: &Curve,
    mut fit: CurveFit,
    identify: impl Fn(&Curve) -> Result<CurveFit, Error>,
) -> CurveFit {
    let fits: Vec<CurveFit> = curve
        .repeats()
        .iter()
        .filter_map(|repeat| identify(repeat).ok())
        .filter(|of_repeat| {
            of_repeat.parameters.iter().map(|p| p.name).eq(fit.parameters.iter().map(|p| p.name))
        })
        .collect();
    fit.repeats = fits.len();
    if fits.len() < 2 {
        return fit;
    }

    let quantile = student_quantile(LEVEL, fits.len() - 1);
    for (index, estimate) in fit.parameters.iter_mut().enumerate() {
        let error = error_of_mean(fits.iter().map(|fit| fit.parameters[index].value));
        let (Ok(standard_error), Ok([low, high])) =
            (&mut estimate.standard_error, &mut estimate.interval)
        else {
            continue;
        };
        *standard_error = standard_error.max(error);
        *low = low.min(estimate.value - quantile * error);
        *high = high.max(estimate.value + quantile * error);
    }

    for estimate in &mut fit.values {
        let symbol = estimate.symbol;
        let all = fits.iter().flat_map(|fit| &fit.values);
        let values: Vec<f64> = all.filter(|v| v.symbol == symbol).map(|v| v.value).collect();
        if let (Ok([low, high]), true) = (&mut estimate.interval, values.len() == fits.len()) {
            let error = error_of_mean(values.iter().copied());
            *low = low.min(estimate.value - quantile * error);
            *high = high.max(estimate.value + quantile * error);
        }
    }
    fit
}

/// Returns the standard error of the mean of `values`.
fn error_of_mean(values: impl ExactSizeIterator<Item = f64> + Clone) -> f64 {
    let count = values.len() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let square: f64 = values.map(|value| (value - mean).powi(2)).sum();
    (square / (count - 1.0) / count).sqrt()
}
