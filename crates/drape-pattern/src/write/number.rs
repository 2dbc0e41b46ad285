//! Numbers of files that people edit: lengths in mm, to a ten-thousandth.

/// Returns a length in m as a number of mm.
pub(crate) fn millimetres(metres: f64) -> String {
    decimal(1e3 * metres, 1e4)
}

/// Returns a length in m as it is read from what was written, to the last bit.
pub(crate) fn as_written(metres: f64) -> f64 {
    0.001 * rounded(1e3 * metres, 1e4)
}

/// Returns a point in m as an array of numbers of mm.
pub(crate) fn point(at: &[f64]) -> String {
    let all: Vec<String> = at.iter().map(|x| millimetres(*x)).collect();
    format!("[{}]", all.join(", "))
}

/// Returns a number rounded to a fraction of one.
pub(crate) fn decimal(value: f64, fraction: f64) -> String {
    format!("{}", rounded(value, fraction))
}

fn rounded(value: f64, fraction: f64) -> f64 {
    // Not −0.
    (value * fraction).round() / fraction + 0.0
}
