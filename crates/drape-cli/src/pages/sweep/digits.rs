//! Digits of means: a mean has as many digits as its standard deviation justifies.

use drape::sweep::Mean;

/// Returns the cell `mean ± deviation`. The standard deviation has two digits, and the mean has an
/// equal number of decimals.
pub(super) fn with_scatter(mean: Option<Mean>) -> String {
    let Some(Mean { value, deviation, .. }) = mean else { return "–".into() };
    match deviation {
        Some(deviation) if deviation > 0.0 && deviation >= 1e-12 * value.abs() => {
            match decimals(value, deviation) {
                Some(places) => format!("{value:.places$} ± {deviation:.places$}"),
                None => format!("{value:.3e} ± {deviation:.1e}"),
            }
        }
        _ => number(value),
    }
}

/// Returns `value` with the decimals of a mean whose standard deviation is `deviation`.
pub(super) fn like_scatter(value: f64, deviation: f64) -> String {
    match decimals(value, deviation).filter(|_| deviation >= 1e-12 * value.abs()) {
        Some(places) => format!("{value:.places$}"),
        None => number(value),
    }
}

/// Returns the number of decimals of a mean `value` with its `deviation`, or `None` if both are
/// written with an exponent.
fn decimals(value: f64, deviation: f64) -> Option<usize> {
    let places = places(deviation, 2);
    (places <= PLACES_MAX && value.abs().max(deviation) < 1e7).then_some(places)
}

/// Largest number of decimals of a cell.
const PLACES_MAX: usize = 6;

/// Returns `value` with four significant digits.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let places = places(value, 4);
    if places > PLACES_MAX || value.abs() >= 1e7 {
        return format!("{value:.3e}");
    }
    let text = format!("{value:.places$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Returns the number of decimals of `value` when it is written with `digits` significant digits.
fn places(value: f64, digits: i32) -> usize {
    let power = value.abs().log10().floor() as i32;
    usize::try_from(digits - 1 - power).unwrap_or(0)
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
        assert_eq!(cell(-2.5e-9, Some(1e-10)), "-2.500e-9 ± 1.0e-10");
        assert_eq!(cell(431.465_349_1, None), "431.5");
        assert_eq!(cell(3.0, Some(0.0)), "3");
        assert_eq!(cell(3e9, None), "3.000e9");
        assert_eq!(with_scatter(None), "–");
    }
}
