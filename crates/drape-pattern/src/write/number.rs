//! Numbers of files that people edit: lengths in mm, to a ten-thousandth; letters that count.

use drape_input::{figure_in_decimals, round_decimals};

/// Returns the length `metres` as a number of mm.
pub(crate) fn millimetres(metres: f64) -> String {
    figure_in_decimals(1e3 * metres, 4)
}

/// Returns the length that is read back after `metres` was written, to the last bit.
pub(crate) fn as_written(metres: f64) -> f64 {
    0.001 * round_decimals(1e3 * metres, 4)
}

/// Returns the point `at`, in m, as an array of numbers of mm.
pub(crate) fn point(at: &[f64]) -> String {
    let all: Vec<String> = at.iter().map(|x| millimetres(*x)).collect();
    format!("[{}]", all.join(", "))
}

/// Returns the letters that count as `number`: A to Z, AA, AB and so on.
pub(crate) fn letters(number: usize) -> String {
    let last = char::from(b'A' + (number % 26) as u8).to_string();
    if number < 26 { last } else { letters(number / 26 - 1) + &last }
}
