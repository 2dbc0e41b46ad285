//! Which of several models the data bear out.

use super::Report;

/// Akaike's information criterion for small samples, up to a constant of the data; the least is the best
/// [Hurvich & Tsai 1989].
///
/// ```math
/// n\ln\frac{S}{n} + 2k + \frac{2k(k+1)}{n - k - 1}
/// ```
///
/// with the sum `$S$` of `$n$` squared residuals and `$k$` = free parameters and one for the noise. Models may be
/// compared when they were fitted to the same data with the same weights and the same loss; a difference
/// beyond ten leaves the worse one no support, one below two says nothing. Nothing where there are not two
/// residuals more than parameters, or where the sum is not a number.
///
/// It takes the residuals for independent: where a model misses the data systematically, neighbours are not,
/// and differences come out too large.
#[must_use]
pub fn akaike(report: &Report, residuals: usize, free_parameters: usize) -> Option<f64> {
    let (n, k) = (residuals as f64, free_parameters as f64 + 1.0);
    let spare = n - k - 1.0;
    let value = n * (report.sum / n).ln() + 2.0 * k + 2.0 * k * (k + 1.0) / spare;
    (spare > 0.0 && !value.is_nan()).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lm::Stop;

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
        // With 20 residuals the fourth parameter costs 2 + 2·5·6/14 − 2·4·5/15 = 3.619: a reduction of the
        // sum by the factor exp(−3.619/20) just pays for it.
        let three = akaike(&report(1.0), 20, 3).expect("enough residuals");
        let pays = (-3.619_047_619_f64 / 20.0).exp();
        for (sum, better) in [(pays * 1.001, false), (pays * 0.999, true)] {
            let four = akaike(&report(sum), 20, 4).expect("enough residuals");
            assert_eq!(four < three, better, "{four} against {three}");
        }
    }

    #[test]
    fn too_few_residuals_compare_nothing() {
        assert_eq!(akaike(&report(1.0), 5, 3), None);
        assert!(akaike(&report(1.0), 6, 3).is_some());
        assert_eq!(akaike(&report(f64::NAN), 20, 3), None);
        assert_eq!(akaike(&report(0.0), 20, 3), Some(f64::NEG_INFINITY));
    }
}
