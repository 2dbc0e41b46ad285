//! Information criterion that compares models fitted to the same data.

use crate::minimise::Report;

/// Returns Akaike's corrected information criterion, up to a constant of the data \[HT89\].
///
/// ```math
/// n\ln\frac{S}{n} + 2k + \frac{2k(k+1)}{n - k - 1}
/// ```
///
/// Here `$S$` is the sum of squares in `report`, `$n$` is `residual_count`, and `$k$` is
/// `free_parameter_count` plus one for the noise. The model with the smallest criterion is the
/// best. Two models may be compared when both were fitted to the same data with the same weights
/// and the same loss. A difference above ten leaves the worse model no support. A difference below
/// two says nothing \[BA02\].
///
/// Returns `None` if `residual_count` is at most `free_parameter_count` + 2, or if the sum is NaN.
///
/// The criterion assumes independent residuals. Where a model misses the data systematically,
/// neighbouring residuals are correlated, and differences of the criterion come out too large.
///
/// ```
/// # use drape_lm::{Parameter, Problem, MinimiserSettings, akaike, minimise};
/// # struct Mean([f64; 6]);
/// # impl Problem for Mean {
/// #     fn residual_count(&self) -> usize { 6 }
/// #     fn residuals(&self, p: &[f64], out: &mut [f64]) {
/// #         for (r, y) in out.iter_mut().zip(self.0) { *r = p[0] - y; }
/// #     }
/// # }
/// # let data = [1.0, 1.2, 0.9, 1.1, 1.0, 0.8];
/// let fit = minimise(&Mean(data), &[Parameter::new(0.0)], &MinimiserSettings::default());
/// let criterion = akaike(&fit, 6, 1).expect("six residuals are enough for one parameter");
/// assert!(criterion < 0.0);
/// ```
#[must_use]
pub fn akaike(report: &Report, residual_count: usize, free_parameter_count: usize) -> Option<f64> {
    let (n, k) = (residual_count as f64, free_parameter_count as f64 + 1.0);
    let denominator = n - k - 1.0;
    let criterion = n * (report.sum / n).ln() + 2.0 * k + 2.0 * k * (k + 1.0) / denominator;
    (denominator > 0.0 && !criterion.is_nan()).then_some(criterion)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::minimise::Stop;

    fn report(sum: f64) -> Report {
        Report {
            parameters: Vec::new(),
            rms: 0.0,
            sum,
            iterations: 0,
            evaluations: 0,
            stop: Stop::Reduction,
        }
    }

    #[test]
    fn a_parameter_must_pay_for_itself() {
        // With 20 residuals the fourth parameter costs 2 + 2·5·6/14 − 2·4·5/15 = 3.619: a reduction
        // of the sum by the factor exp(−3.619/20) just pays for it.
        let three = akaike(&report(1.0), 20, 3).expect("enough residuals");
        let pays = (-3.619_047_619_f64 / 20.0).exp();
        for (sum, better) in [(pays * 1.001, false), (pays * 0.999, true)] {
            let four = akaike(&report(sum), 20, 4).expect("enough residuals");
            assert_eq!(four < three, better, "{four} against {three}");
        }
    }

    #[test]
    fn at_a_mean_square_of_one_only_the_parameters_count() {
        // The logarithm is zero: with k = 4 and n = 20 the rest is 2·4 + 2·4·5/15.
        let value = akaike(&report(20.0), 20, 3).expect("enough residuals");
        assert!((value - 32.0 / 3.0).abs() < 1e-12, "{value}");
        // A mean square of e adds one for each residual.
        let larger = akaike(&report(20.0 * std::f64::consts::E), 20, 3).expect("enough residuals");
        assert!((larger - value - 20.0).abs() < 1e-12, "{larger} after {value}");
    }

    #[test]
    fn too_few_residuals_compare_nothing() {
        assert_eq!(akaike(&report(1.0), 5, 3), None);
        assert!(akaike(&report(1.0), 6, 3).is_some());
        assert_eq!(akaike(&report(f64::NAN), 20, 3), None);
        assert_eq!(akaike(&report(0.0), 20, 3), Some(f64::NEG_INFINITY));
    }
}
