//! Digits of means: a mean has as many digits as its standard deviation justifies.

use drape::input::{Notation, brief, with_error};
use drape::sweep::Mean;

/// Number of digits of a number without a standard deviation.
const DIGITS: usize = 4;

/// Returns the cell `mean ± deviation`. The standard deviation has two digits, and the mean has an
/// equal number of decimals.
pub(super) fn with_scatter(mean: Option<Mean>) -> String {
    let Some(Mean { value, deviation, .. }) = mean else { return "–".into() };
    match deviation {
        Some(deviation) if is_scatter(value, deviation) => with_error(value, deviation),
        _ => number(value),
    }
}

/// Returns `value` with the decimals of a mean whose standard deviation is `deviation`.
pub(super) fn like_scatter(value: f64, deviation: f64) -> String {
    if is_scatter(value, deviation) {
        Notation::of(value, Some(deviation)).whole(value)
    } else {
        number(value)
    }
}

/// Returns `value` with four significant digits, or with all digits before the decimal point.
pub(super) fn number(value: f64) -> String {
    brief(value, DIGITS)
}

/// Returns whether the `deviation` of a mean `value` is more than its rounding error.
fn is_scatter(value: f64, deviation: f64) -> bool {
    deviation > 0.0 && deviation >= 1e-12 * value.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_has_the_digits_that_its_scatter_leaves() {
        let cell = |value, deviation| with_scatter(Some(Mean { value, deviation, count: 3 }));
        assert_eq!(cell(431.465_349_1, Some(1.234)), "431.5 ± 1.2");
        assert_eq!(cell(431.465_349_1, Some(0.012_34)), "431.465 ± 0.012");
        assert_eq!(cell(431.465_349_1, Some(45.6)), "431 ± 46");
        assert_eq!(cell(-2.5e-9, Some(1e-10)), "(-2.50 ± 0.10)e-9");
        assert_eq!(cell(431.465_349_1, None), "431.5");
        assert_eq!(cell(3.0, Some(0.0)), "3");
        assert_eq!(cell(3e9, None), "3e9");
        assert_eq!(cell(40_401.0, None), "40401");
        assert_eq!(with_scatter(None), "–");
    }
}
