//! Numbers and quoted texts in messages: with the digits they have, and no longer than can be read.

/// Number of letters from which on a decimal number has more digits than it means.
const DIGITS_MAX: usize = 15;

/// Largest number of letters of a text that a message quotes.
const LETTERS_MAX: usize = 60;

/// Returns a number as a message shows it: at most 12 digits, so that rounding does not show, and
/// with an exponent where it is very large or very small.
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
    let rounded: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    let plain = (1e-4..1e7).contains(&rounded.abs());
    if plain { rounded.to_string() } else { format!("{rounded:e}") }
}

/// Returns a number no larger than a value, with two digits: for advice to stay below it.
///
/// ```
/// use drape_input::figure_below;
///
/// assert_eq!(figure_below(0.00199), "0.0019");
/// assert_eq!(figure_below(0.05), "0.05");
/// ```
#[must_use]
pub fn figure_below(value: f64) -> String {
    two_digits(value, -1.0)
}

/// Returns a number no smaller than a value, with two digits: for advice to reach it.
///
/// ```
/// use drape_input::figure_above;
///
/// assert_eq!(figure_above(0.00191), "0.002");
/// assert_eq!(figure_above(1.12e11), "1.2e11");
/// assert_eq!(figure_above(0.05), "0.05");
/// ```
#[must_use]
pub fn figure_above(value: f64) -> String {
    two_digits(value, 1.0)
}

/// Returns the nearest number with two digits that is not below a value, with the direction 1, or not
/// above it, with the direction -1.
fn two_digits(value: f64, direction: f64) -> String {
    let rounded = |value: f64| format!("{value:.1e}").parse().unwrap_or(value);
    let falls_short = |number: f64| direction * (number - value) < 0.0;
    let mut number: f64 = rounded(value);
    if falls_short(number) {
        // Half of the last digit, and less than a whole one: the next number.
        let digit = 10_f64.powf(number.abs().log10().floor() - 1.0);
        number = rounded(number + direction * 0.55 * digit);
    }
    figure(if falls_short(number) { value } else { number })
}

/// Returns a text in which numbers have the digits that [`figure`] gives them: for messages of
/// errors that know nothing of it.
///
/// ```
/// let message = "a spacing of 0.12400000000000001 m in a_0.5.toml";
/// assert_eq!(drape_input::tidy(message), "a spacing of 0.124 m in a_0.5.toml");
/// ```
#[must_use]
pub fn tidy(text: &str) -> String {
    let is_part = |letter: char| letter.is_ascii_digit() || letter == '.';
    let mut tidied = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(|letter: char| letter.is_ascii_digit()) {
        let end =
            rest[start..].find(|letter| !is_part(letter)).map_or(rest.len(), |end| start + end);
        let number = &rest[start..end];
        tidied.push_str(&rest[..start]);
        match number.parse() {
            Ok(value) if number.contains('.') && number.len() > DIGITS_MAX => {
                tidied.push_str(&figure(value));
            }
            _ => tidied.push_str(number),
        }
        rest = &rest[end..];
    }
    tidied.push_str(rest);
    tidied
}

/// Returns numbers in brackets, as TOML writes a list of them.
///
/// ```
/// assert_eq!(drape_input::figures(&[1.0, 0.1 + 0.2]), "[1, 0.3]");
/// ```
#[must_use]
pub fn figures(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|&value| figure(value)).collect();
    format!("[{}]", values.join(", "))
}

/// Returns the beginning of a text, all of it unless it is long.
///
/// ```
/// assert_eq!(drape_input::excerpt("plain"), "plain");
/// assert_eq!(drape_input::excerpt(&"x".repeat(90)).chars().count(), 61);
/// ```
#[must_use]
pub fn excerpt(text: &str) -> String {
    cut(text, LETTERS_MAX)
}

/// Returns at most so many letters of a text, with a sign where it was cut.
pub(crate) fn cut(text: &str, letters: usize) -> String {
    match text.char_indices().nth(letters) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
