//! Uncertainty by repeats: the same law fitted to each specimen.
//!
//! Of `$n$` specimens whose parameters scatter by `$s$`, the mean has the standard error and interval
//!
//! ```math
//! \frac{s}{\sqrt n}, \qquad \theta \pm t_{0.975,\,n-1}\,\frac{s}{\sqrt n}
//! ```
//!
//! The residuals of one curve know nothing of the next specimen; the scatter does. The wider of both
//! counts.

use drape_kes::Curve;
use drape_lm::student_quantile;

use crate::error::Error;
use crate::regression::curve_fit::CurveFit;

/// Coverage of the intervals.
const LEVEL: f64 = 0.95;

/// Widens the errors of a fit to the mean of repeats by the scatter of the fits to each of them.
///
/// `identify` fits the selected law to one repeat. A repeat that has no such fit is left out; a
/// parameter that is fixed, or at a bound in the mean, keeps its reason.
pub(crate) fn with_scatter(
    curve: &Curve,
    mut fit: CurveFit,
    identify: impl Fn(&Curve) -> Result<CurveFit, Error>,
) -> CurveFit {
    let names = |fit: &CurveFit| fit.parameters.iter().map(|p| p.name).collect::<Vec<_>>();
    let fits = curve.repeats().iter().filter_map(|repeat| identify(repeat).ok());
    let fits: Vec<CurveFit> = fits.filter(|of_repeat| names(of_repeat) == names(&fit)).collect();
    fit.repeats = fits.len();
    if fits.len() < 2 {
        return fit;
    }
    let count = fits.len() as f64;
    let quantile = student_quantile(LEVEL, fits.len() - 1);
    for (index, estimate) in fit.parameters.iter_mut().enumerate() {
        let values = || fits.iter().map(|fit| fit.parameters[index].value);
        let mean = values().sum::<f64>() / count;
        let square: f64 = values().map(|value| (value - mean).powi(2)).sum();
        let error = (square / (count - 1.0) / count).sqrt();
        let (Ok(own), Ok([low, high])) = (&mut estimate.standard_error, &mut estimate.interval)
        else {
            continue;
        };
        *own = own.max(error);
        *low = low.min(estimate.value - quantile * error);
        *high = high.max(estimate.value + quantile * error);
    }
    fit
}
