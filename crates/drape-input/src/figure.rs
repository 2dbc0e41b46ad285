//! Numbers and quoted texts in messages: with the digits they have, and no longer than can be read.

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
