//! Numbers and quoted texts for people, with as many digits and letters as a reader needs.
//!
//! `rounding` has [`figure`], a number in a message, and numbers of few digits, `notation` numbers
//! with their uncertainty and per cents, and `amount` durations and sizes of memory. Messages,
//! pages and tables of all crates use these functions, so that a number looks alike everywhere.

mod amount;
mod notation;
mod rounding;

pub use amount::{duration_in_words, size_in_words};
pub use notation::{Notation, percent, signed_percent, significant, typeset, with_error};
pub use rounding::{
    brief, figure, figure_in_decimals, figure_in_digits, figure_in_range, round_decimals,
    round_digits,
};

/// Returns a number with two digits that is no larger than `value`, for advice to stay below
/// `value`.
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

/// Returns a number with two digits that is no smaller than `value`, for advice to reach `value`.
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

/// Returns the number with two digits that is nearest to `value`.
///
/// The number is not below `value` if `direction` is 1, and not above `value` if `direction` is -1.
fn two_digits(value: f64, direction: f64) -> String {
    let mut number = round_digits(value, 2);
    if direction * (number - value) < 0.0 {
        // More than half of the last digit, but less than a whole one, leads to the next number.
        let digit = 10_f64.powf(number.abs().log10().floor() - 1.0);
        number = round_digits(number + direction * 0.55 * digit, 2);
    }
    figure(if direction * (number - value) < 0.0 { value } else { number })
}

/// Returns `count` with its noun in the right number.
///
/// ```
/// use drape_input::counted;
///
/// assert_eq!(counted(1, "body", "bodies"), "1 body");
/// assert_eq!(counted(2, "body", "bodies"), "2 bodies");
/// ```
#[must_use]
pub fn counted(count: usize, singular: &str, plural: &str) -> String {
    format!("{count} {}", if count == 1 { singular } else { plural })
}

/// Returns `text` with its numbers written as [`figure`] writes them, for messages of errors that
/// do not use [`figure`].
///
/// ```
/// let message = "a spacing of 0.12400000000000001 m in a_0.5.toml";
/// assert_eq!(drape_input::tidy(message), "a spacing of 0.124 m in a_0.5.toml");
/// ```
#[must_use]
pub fn tidy(text: &str) -> String {
    /// Number of letters above which a decimal number has digits that are only rounding.
    const DIGITS_MAX: usize = 15;

    let mut tidied = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(|letter: char| letter.is_ascii_digit()) {
        let length = rest[start..].find(|letter: char| !(letter.is_ascii_digit() || letter == '.'));
        let end = length.map_or(rest.len(), |length| start + length);
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

/// Returns `values` in brackets, as TOML writes a list of numbers.
///
/// ```
/// assert_eq!(drape_input::figures(&[1.0, 0.1 + 0.2]), "[1, 0.3]");
/// ```
#[must_use]
pub fn figures(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|&value| figure(value)).collect();
    format!("[{}]", values.join(", "))
}

/// Returns the beginning of `text`, or all of `text` if it is short enough for a message.
///
/// ```
/// assert_eq!(drape_input::excerpt("plain"), "plain");
/// assert_eq!(drape_input::excerpt(&"x".repeat(90)).chars().count(), 61);
/// ```
#[must_use]
pub fn excerpt(text: &str) -> String {
    /// Largest number of letters of a text that a message quotes.
    const LETTERS_MAX: usize = 60;

    cut(text, LETTERS_MAX)
}

/// Returns `text` if it has at most `letter_count` letters. If not, returns its first
/// `letter_count` letters and `…`.
pub(crate) fn cut(text: &str, letter_count: usize) -> String {
    match text.char_indices().nth(letter_count) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
