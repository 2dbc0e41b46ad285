//! Numbers of files that people edit: lengths in mm, to a ten-thousandth; letters that count.

/// Returns the length `metres` as a number of mm.
pub(crate) fn millimetres(metres: f64) -> String {
    decimal(1e3 * metres, 1e4)
}

/// Returns the length that is read back after `metres` was written, to the last bit.
pub(crate) fn as_written(metres: f64) -> f64 {
    0.001 * rounded(1e3 * metres, 1e4)
}

/// Returns the point `at`, in m, as an array of numbers of mm.
pub(crate) fn point(at: &[f64]) -> String {
    let all: Vec<String> = at.iter().map(|x| millimetres(*x)).collect();
    format!("[{}]", all.join(", "))
}

/// Returns `value` rounded to a multiple of `1 / fraction`.
pub(crate) fn decimal(value: f64, fraction: f64) -> String {
    format!("{}", rounded(value, fraction))
}

/// Returns `value` rounded to a multiple of `1 / fraction`.
fn rounded(value: f64, fraction: f64) -> f64 {
    // The addition turns −0 into 0.
    (value * fraction).round() / fraction + 0.0
}

/// Returns the letters that count as `number`: A to Z, AA, AB and so on.
pub(crate) fn letters(number: usize) -> String {
    let last = char::from(b'A' + (number % 26) as u8).to_string();
    if number < 26 { last } else { letters(number / 26 - 1) + &last }
}
