//! Quantiles of Student's t distribution, for `covariance` and `profile`.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// Largest number of degrees of freedom in the computation. Larger numbers are replaced by this
/// one.
///
/// The quantile is then too large by at most one part in ten thousand.
const MOST_DEGREES: usize = 10_000;
/// Number of bisections for the angle of the quantile, enough for all bits of an `f64`.
const HALVINGS: usize = 55;

/// Returns the two-sided quantile of Student's t distribution, in standard errors.
///
/// The fraction `level` of all estimates deviates by no more than the quantile. With few `degrees`
/// of freedom the standard error itself is uncertain, and the quantile at 95 % is larger than 1.96,
/// the quantile of the normal distribution. Returns NaN if `degrees` is 0 or `level` is not between
/// 0 and 1.
///
/// ```
/// let deviation = drape_lm::student_quantile(0.95, 10);
/// assert!((deviation - 2.228_139).abs() < 1e-6);
/// ```
#[must_use]
pub fn student_quantile(level: f64, degrees: usize) -> f64 {
    if degrees == 0 || !(0.0..1.0).contains(&level) {
        return f64::NAN;
    }
    let degrees = degrees.min(MOST_DEGREES);
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if probability(middle, degrees) < level {
            low = middle;
        } else {
            high = middle;
        }
    }
    (0.5 * (low + high)).tan() * (degrees as f64).sqrt()
}

/// Returns the probability of a deviation up to `$t = \sqrt\nu\tan\theta$` \[AS64, eqs. 26.7.3–4\],
/// where `$\theta$` is `angle` and `$\nu$` is `degrees`.
///
/// ```math
/// \sin\theta\left(1 + \tfrac12\cos^2\theta + \tfrac{1\cdot3}{2\cdot4}\cos^4\theta + \dots\right)
/// \quad\text{for even } \nu
/// ```
///
/// and a similar finite sum for odd `$\nu$`. Both sums are exact up to rounding.
fn probability(angle: f64, degrees: usize) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let odd = degrees % 2 == 1;
    let mut term = if odd { cosine } else { 1.0 };
    let mut sum = 0.0;
    // Every second power of the cosine below `degrees − 1`.
    let mut power = if odd { 1 } else { 0 };
    while power + 2 <= degrees {
        sum += term;
        power += 2;
        let power = power as f64;
        term *= cosine * cosine * (power - 1.0) / power;
    }
    if odd { FRAC_2_PI * (angle + sine * sum) } else { sine * sum }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quantiles_agree_with_published_tables() {
        // Two-sided 95 % and 99 % points, tabulated to five digits.
        for (degrees, at_95, at_99) in [
            (1, 12.7062, 63.6567),
            (2, 4.30265, 9.92484),
            (3, 3.18245, 5.84091),
            (4, 2.77645, 4.60409),
            (5, 2.57058, 4.03214),
            (10, 2.22814, 3.16927),
            (30, 2.04227, 2.75000),
            (120, 1.97993, 2.61742),
        ] {
            for (level, exact) in [(0.95, at_95), (0.99, at_99)] {
                let found = student_quantile(level, degrees);
                assert!(
                    (found / exact - 1.0).abs() < 3e-6,
                    "{found} against {exact} with {degrees}"
                );
            }
        }
        // The quantile approaches the quantile of the normal distribution.
        assert!((student_quantile(0.95, usize::MAX) / 1.959_964 - 1.0).abs() < 1.3e-4);
    }

    #[test]
    fn nonsense_has_no_quantile() {
        assert!(student_quantile(0.95, 0).is_nan());
        assert!(student_quantile(1.0, 3).is_nan());
        assert!(student_quantile(f64::NAN, 3).is_nan());
    }
}
