//! Numbers rounded to their uncertainty, in plain or scientific notation.

/// Number of significant digits of a number without a known uncertainty.
const DIGITS: i32 = 4;

/// Number of significant digits of an uncertainty. The value is rounded to the decimal place of its
/// uncertainty.
const ERROR_DIGITS: i32 = 2;

/// Largest number of significant digits of a value, however small its uncertainty.
const MOST_DIGITS: i32 = 9;

/// Powers of ten that are written out instead of being split off.
const PLAIN: std::ops::Range<i32> = -3..5;

/// Notation in which a value, its error and its bounds are written together.
///
/// ```
/// use drape_input::Notation;
///
/// let notation = Notation::of(1258.34, Some(11.7));
/// assert_eq!([1258.34, 11.7].map(|number| notation.mantissa(number)), ["1258", "12"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Notation {
    /// Power of ten that is split off. 0 in plain notation.
    exponent: i32,
    decimals: usize,
}

impl Notation {
    /// Returns the notation that shows a `value` to the precision of its `uncertainty`.
    #[must_use]
    pub fn of(value: f64, uncertainty: Option<f64>) -> Notation {
        let error = uncertainty.filter(|error| *error > 0.0);
        let error_top = error.map(power_of_ten);
        let value_top = if value == 0.0 { error_top.unwrap_or(0) } else { power_of_ten(value) };
        let top = value_top.max(error_top.unwrap_or(value_top));
        let last = match error_top {
            // A value below its uncertainty still shows two digits where there is room.
            Some(error) if error > value_top => (value_top - 1).max(top - (DIGITS - 1)),
            Some(error) => {
                let last = error - (ERROR_DIGITS - 1);
                last.clamp(value_top - (MOST_DIGITS - 1), value_top - 1)
            }
            None => value_top - (DIGITS - 1),
        };
        let exponent = if PLAIN.contains(&top) { 0 } else { top };
        Notation { exponent, decimals: usize::try_from(exponent - last).unwrap_or(0) }
    }

    /// Returns a `number` in this notation, without the power of ten.
    #[must_use]
    pub fn mantissa(&self, number: f64) -> String {
        let text = format!("{:.*}", self.decimals, shift(number, -self.exponent));
        if text.trim_start_matches('-').chars().all(|c| "0.".contains(c)) {
            text.trim_start_matches('-').to_owned()
        } else {
            text
        }
    }

    /// Returns whether a `number` has at most nine digits before its decimal point in this
    /// notation.
    #[must_use]
    pub fn suits(&self, number: f64) -> bool {
        shift(number, -self.exponent).abs() < 10f64.powi(MOST_DIGITS)
    }

    /// Returns a `number` with its power of ten: in this notation, or with four significant digits
    /// where this notation would be too long.
    #[must_use]
    pub fn whole(&self, number: f64) -> String {
        if self.suits(number) {
            self.mantissa(number) + &self.power()
        } else {
            significant(number, DIGITS)
        }
    }

    /// Returns the power of ten as text: `e-5`, or nothing.
    #[must_use]
    pub fn power(&self) -> String {
        if self.exponent == 0 { String::new() } else { format!("e{}", self.exponent) }
    }
}

/// Returns a `number` times ten to a `power`, without intermediate overflow.
fn shift(number: f64, power: i32) -> f64 {
    let half = power / 2;
    number * 10f64.powi(half) * 10f64.powi(power - half)
}

/// Returns the power of ten of the leading digit of a `number` after rounding. Returns 0 for zero.
fn power_of_ten(number: f64) -> i32 {
    if number == 0.0 || !number.is_finite() {
        return 0;
    }
    // The formatter rounds before it chooses the power, so 9.99996 becomes 1.000e1.
    let text = format!("{:.*e}", (DIGITS - 1) as usize, number);
    text.rsplit_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

/// Returns a `value` with its `error` in one notation. The error has two digits.
///
/// ```
/// use drape_input::with_error;
///
/// assert_eq!(with_error(431.465_349_1, 1.234), "431.5 ± 1.2");
/// assert_eq!(with_error(-2.5e-9, 1e-10), "(-2.50 ± 0.10)e-9");
/// ```
#[must_use]
pub fn with_error(value: f64, error: f64) -> String {
    let notation = Notation::of(value, Some(error));
    let [number, error] = [value, error].map(|number| notation.mantissa(number));
    match notation.power() {
        power if power.is_empty() => format!("{number} ± {error}"),
        power => format!("({number} ± {error}){power}"),
    }
}

/// Returns a `number` with exactly `digits` significant digits, zeros included, in plain notation
/// where this is short.
///
/// ```
/// use drape_input::significant;
///
/// assert_eq!(significant(0.118, 4), "0.1180");
/// assert_eq!(significant(1.157e-5, 3), "1.16e-5");
/// ```
#[must_use]
pub fn significant(number: f64, digits: i32) -> String {
    let top = power_of_ten(number);
    let exponent = if PLAIN.contains(&top) { 0 } else { top };
    let decimals = usize::try_from(exponent - top + digits - 1).unwrap_or(0);
    let notation = Notation { exponent, decimals };
    notation.mantissa(number) + &notation.power()
}

/// Returns a `ratio` in per cent with three significant digits at most, such as "0.97 %".
///
/// ```
/// assert_eq!(drape_input::percent(0.1234), "12.3 %");
/// ```
#[must_use]
pub fn percent(ratio: f64) -> String {
    let percent = 100.0 * ratio;
    let size = percent.abs();
    if size != 0.0 && size < 0.01 {
        let bound = if percent < 0.0 { "> -0.01" } else { "< 0.01" };
        return format!("{bound} %");
    }
    if size >= 1e6 {
        let bound = if percent < 0.0 { "< -1e6" } else { "> 1e6" };
        return format!("{bound} %");
    }
    let decimals = match size {
        s if s >= 99.95 => 0,
        s if s >= 9.995 => 1,
        _ => 2,
    };
    format!("{percent:.decimals$} %")
}

/// Returns a `ratio` in per cent with its sign, such as "+0.97 %".
///
/// ```
/// assert_eq!(drape_input::signed_percent(0.0097), "+0.97 %");
/// ```
#[must_use]
pub fn signed_percent(ratio: f64) -> String {
    let sign = if ratio > 0.0 { "+" } else { "" };
    format!("{sign}{}", percent(ratio))
}

/// Returns a `text` with its numbers typeset: true minus signs, and powers of ten as superscripts.
///
/// ```
/// assert_eq!(drape_input::typeset("-1.16e-5"), "−1.16 × 10⁻⁵");
/// ```
#[must_use]
pub fn typeset(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let at = |index: usize| letters.get(index).copied().unwrap_or(' ');
    let mut printed = String::with_capacity(text.len());
    let mut in_power = false;
    for (index, &letter) in letters.iter().enumerate() {
        let number_before = index > 0 && matches!(at(index - 1), '0'..='9' | ')' | ']');
        let number_after = at(index + 1).is_ascii_digit();
        let power_after = number_after || at(index + 1) == '-' && at(index + 2).is_ascii_digit();
        if letter == 'e' && number_before && power_after {
            printed.push_str(" × 10");
            in_power = true;
        } else if in_power && (letter == '-' || letter.is_ascii_digit()) {
            printed.push(superscript(letter));
        } else {
            in_power = false;
            printed.push(if letter == '-' && number_after { '−' } else { letter });
        }
    }
    printed
}

/// Returns a minus sign or a digit, `letter`, as a superscript.
fn superscript(letter: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    letter.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_far_below_its_error_has_no_digit_beyond_the_errors() {
        let notation = Notation::of(0.29, Some(2510.0));
        assert_eq!([0.29, 2510.0].map(|x| notation.mantissa(x)), ["0", "2510"]);
    }

    #[test]
    fn a_value_is_rounded_to_its_error() {
        let shown = |value: f64, error: f64| {
            let notation = Notation::of(value, Some(error));
            let (value, error) = (notation.mantissa(value), notation.mantissa(error));
            format!("{value} ± {error} {}", notation.power())
        };
        assert_eq!(shown(1258.34, 11.7), "1258 ± 12 ");
        assert_eq!(shown(1.157_34e-5, 1.2e-7), "1.157 ± 0.012 e-5");
        assert_eq!(shown(0.123_456, 0.000_987), "0.12346 ± 0.00099 ");
        assert_eq!(shown(-24.94, 300.0), "-25 ± 300 ");
        assert_eq!(shown(0.0, 0.5), "0.00 ± 0.50 ");
        assert_eq!(shown(1e-5, 5.0), "0.000 ± 5.000 ");
        assert_eq!(shown(1e-310, 1e-2), "0.00000 ± 0.01000 ");
    }

    #[test]
    fn significant_digits_survive_rounding_up() {
        assert_eq!(significant(9.999_96, 4), "10.00");
        assert_eq!(significant(0.118, 4), "0.1180");
        assert_eq!(significant(99_999.6, 4), "1.000e5");
        assert_eq!(significant(1.157e-5, 3), "1.16e-5");
        assert_eq!(significant(0.0, 4), "0.000");
        assert_eq!(significant(1e-310, 2), "1.0e-310");
    }

    #[test]
    fn small_negatives_do_not_become_minus_zero() {
        let notation = Notation::of(12.0, Some(1.0));
        assert_eq!(notation.mantissa(-0.01), "0.0");
    }

    #[test]
    fn per_cents_keep_three_digits() {
        assert_eq!(percent(0.0097), "0.97 %");
        assert_eq!(percent(0.1234), "12.3 %");
        assert_eq!(percent(3.0), "300 %");
        assert_eq!(percent(1e-6), "< 0.01 %");
        assert_eq!(percent(0.0), "0.00 %");
        assert_eq!(percent(-1e305), "< -1e6 %");
    }

    #[test]
    fn print_has_true_minus_signs_and_powers() {
        assert_eq!(typeset("-1.16e-5"), "−1.16 × 10⁻⁵");
        assert_eq!(typeset("[-1.2, 3.4]e-5"), "[−1.2, 3.4] × 10⁻⁵");
        assert_eq!(typeset("(2 ± 1)e10"), "(2 ± 1) × 10¹⁰");
        assert_eq!(typeset("-0.5"), "−0.5");
    }
}
