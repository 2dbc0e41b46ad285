//! Numbers of a message, and numbers rounded to digits or decimals, without zeros at the end.

/// Returns `value` as a message shows it. The number has at most 12 digits, so that rounding does
/// not show, and an exponent if it is very large or very small.
///
/// ```
/// use drape_input::figure;
///
/// assert_eq!(figure(0.1 + 0.2), "0.3");
/// assert_eq!(figure(2.0), "2");
/// assert_eq!(figure(1e-7), "1e-7");
/// assert_eq!(figure(f64::NAN), "NaN");
/// ```
#[must_use]
pub fn figure(value: f64) -> String {
    if !value.is_finite() || value == 0.0 {
        return value.to_string();
    }
    let rounded = round_digits(value, 12);
    let plain = (1e-4..1e7).contains(&rounded.abs());
    if plain { rounded.to_string() } else { format!("{rounded:e}") }
}

/// Returns `value` rounded to a number of significant `digits`, which is at least 1.
///
/// ```
/// assert_eq!(drape_input::round_digits(15_762.4, 3), 15_800.0);
/// ```
#[must_use]
pub fn round_digits(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// Returns `value` rounded to a number of `decimals`. The result is never -0.
///
/// ```
/// assert_eq!(drape_input::round_decimals(2.345_6, 2), 2.35);
/// ```
#[must_use]
pub fn round_decimals(value: f64, decimals: i32) -> f64 {
    let fraction = 10_f64.powi(decimals);
    // The addition turns −0 into 0.
    (value * fraction).round() / fraction + 0.0
}

/// Returns `value` with at most `digits` significant digits, written as by [`figure`].
///
/// ```
/// use drape_input::figure_in_digits;
///
/// assert_eq!(figure_in_digits(1.0 / 3.0, 4), "0.3333");
/// assert_eq!(figure_in_digits(0.2, 4), "0.2");
/// assert_eq!(figure_in_digits(15_762.4, 3), "15800");
/// ```
#[must_use]
pub fn figure_in_digits(value: f64, digits: usize) -> String {
    figure(round_digits(value, digits))
}

/// Returns `value` with at most a number of `decimals`, without an exponent.
///
/// ```
/// use drape_input::figure_in_decimals;
///
/// assert_eq!(figure_in_decimals(3.456, 2), "3.46");
/// assert_eq!(figure_in_decimals(0.1 + 0.2, 2), "0.3");
/// assert_eq!(figure_in_decimals(-0.001, 2), "0");
/// ```
#[must_use]
pub fn figure_in_decimals(value: f64, decimals: i32) -> String {
    round_decimals(value, decimals).to_string()
}

/// Returns `value` with at most `digits` significant digits, or with all digits before the decimal
/// point if these are more. A count keeps its digits.
///
/// A number from 1e7 or below 1e-4 has an exponent.
///
/// ```
/// use drape_input::brief;
///
/// assert_eq!(brief(0.165_749, 3), "0.166");
/// assert_eq!(brief(40_401.0, 3), "40401");
/// assert_eq!(brief(1.36e-16, 3), "1.36e-16");
/// ```
#[must_use]
pub fn brief(value: f64, digits: usize) -> String {
    let size = value.abs();
    if !(1e-4..1e7).contains(&size) {
        return figure_in_digits(value, digits);
    }
    let decimals = digits as i32 - 1 - size.log10().floor() as i32;
    let text = format!("{value:.*}", decimals.max(0) as usize);
    figure(text.parse().unwrap_or(value))
}

/// Returns a `value` of a scale whose ends are `width` apart, with the decimals that tell values
/// apart.
///
/// ```
/// use drape_input::figure_in_range;
///
/// assert_eq!(figure_in_range(0.025, 0.05), "0.025");
/// assert_eq!(figure_in_range(2500.0, 5000.0), "2500");
/// assert_eq!(figure_in_range(1e-9, 1e-9), "1e-9");
/// ```
#[must_use]
pub fn figure_in_range(value: f64, width: f64) -> String {
    /// Largest number of decimals. A scale that needs more has exponents.
    const DECIMALS_MAX: i32 = 8;

    let decimals = 2 - width.log10().floor() as i32;
    if decimals > DECIMALS_MAX {
        return figure_in_digits(value, 3);
    }
    figure_in_decimals(value, decimals.max(0))
}
