//! Path data and lengths of SVG.

use drape_input::figure_in_decimals;

/// Returns a `length` in px with two decimals, finer than any printer at the usual size of a
/// figure.
pub(crate) fn px(length: f64) -> String {
    figure_in_decimals(length, 2)
}

/// Returns a line through `pixels` as path data.
pub(crate) fn line(pixels: impl Iterator<Item = [f64; 2]>) -> String {
    let mut data = String::new();
    for (index, [x, y]) in pixels.enumerate() {
        data.push(if index == 0 { 'M' } else { 'L' });
        data.push_str(&format!("{} {}", px(x), px(y)));
    }
    data
}

/// Returns dots at `pixels` as path data: lines without length, which a round line cap makes
/// visible.
pub(crate) fn dots(pixels: impl Iterator<Item = [f64; 2]>) -> String {
    pixels.map(|[x, y]| format!("M{} {}h0", px(x), px(y))).collect()
}

/// Half the length of a mark, in px.
const MARK: f64 = 16.0;

/// Returns short level lines at `pixels` as path data.
pub(crate) fn marks(pixels: impl Iterator<Item = [f64; 2]>) -> String {
    pixels.map(|[x, y]| format!("M{} {}h{}", px(x - MARK), px(y), px(2.0 * MARK))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short_and_never_minus_zero() {
        assert_eq!([px(12.0), px(-0.001), px(3.456), px(0.1)], ["12", "0", "3.46", "0.1"]);
    }
}
