//! Scale: the range of the values that a map shows, and its colours.

/// Fraction of the values that the range leaves out. Large values at single vertices, such as sewn
/// corners, would make the other colours pale.
const BEYOND: f64 = 0.005;

/// Smallest range, so that rounding errors of cloth at rest are not shown as values.
const RANGE_MIN: f64 = 1e-6;

/// Returns the range of nearly all `values`, rounded up to 1, 2 or 5 times a power of ten. It is
/// symmetric about zero if `is_signed`, and begins at zero otherwise.
pub(crate) fn range(values: impl Iterator<Item = f64>, is_signed: bool) -> [f64; 2] {
    let mut sizes: Vec<f64> = values.map(f64::abs).collect();
    let place = ((1.0 - BEYOND) * sizes.len() as f64) as usize;
    let place = place.min(sizes.len().saturating_sub(1));
    let size =
        if sizes.is_empty() { 0.0 } else { *sizes.select_nth_unstable_by(place, f64::total_cmp).1 };
    let high = rounded_up(size.max(RANGE_MIN));
    [if is_signed { -high } else { 0.0 }, high]
}

/// Returns the least of 1, 2 and 5 times a power of ten that is not below `size`, a positive
/// number.
///
/// ```
/// assert_eq!(drape_export::rounded_up(0.3), 0.5);
/// ```
#[must_use]
pub fn rounded_up(size: f64) -> f64 {
    let power = 10.0_f64.powf(size.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|step| *step >= size).unwrap_or(size)
}

/// Colours of a scale from zero upwards, at equal distances.
const SEQUENTIAL: &[[u8; 3]] =
    &[[37, 35, 92], [32, 99, 141], [33, 153, 134], [122, 199, 82], [250, 228, 66]];

/// Colours of a scale about zero, at equal distances.
const DIVERGING: &[[u8; 3]] = &[[33, 92, 172], [246, 246, 244], [186, 38, 48]];

/// Returns the colours at equal distances on a scale. Between them the colour is linear.
pub(crate) fn stops(is_signed: bool) -> &'static [[u8; 3]] {
    if is_signed { DIVERGING } else { SEQUENTIAL }
}

/// Returns the colour at `fraction` of a scale, as six digits.
pub(crate) fn colour(fraction: f64, is_signed: bool) -> String {
    let stops = stops(is_signed);
    let place = fraction.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let lower = (place as usize).min(stops.len() - 2);
    let part = place - lower as f64;
    let [red, green, blue] = [0, 1, 2].map(|k| {
        let [low, high] = [lower, lower + 1].map(|stop| f64::from(stops[stop][k]));
        (low + part * (high - low)).round() as u8
    });
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_ends_at_a_round_number_and_leaves_outliers_out() {
        let mut values = vec![0.3; 999];
        values.push(-70.0);
        assert_eq!(range(values.iter().copied(), true), [-0.5, 0.5]);
        assert_eq!(range(values.iter().copied(), false), [0.0, 0.5]);
        assert_eq!(range([].into_iter(), false), [0.0, 1e-6]);
    }

    #[test]
    fn colours_are_linear_between_their_stops() {
        assert_eq!(colour(0.0, true), "#215cac");
        assert_eq!(colour(0.5, true), "#f6f6f4");
        assert_eq!(colour(0.125, false), "#234375");
        assert_eq!(colour(7.0, false), "#fae442");
    }
}
