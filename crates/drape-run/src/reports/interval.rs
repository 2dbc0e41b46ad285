//! Intervals of a fit as pages show them.

use drape_fit::Undetermined;
use drape_report::Interval;

/// Largest standard error and end of an interval that a page shows, in SI.
const LARGEST: f64 = 1e30;

/// Returns whether a page shows a `number`, which is at most [`LARGEST`].
pub(super) fn is_shown(number: &f64) -> bool {
    number.abs() <= LARGEST
}

/// Returns an `interval` in SI, where `factor` is the unit of its ends. An interval whose ends are
/// too large to show is unknown.
pub(super) fn interval(interval: &Result<[f64; 2], Undetermined>, factor: f64) -> Interval {
    match interval {
        Ok(ends) if !ends.iter().all(|end| is_shown(&(end * factor))) => {
            Interval::Unknown { reason: "not determined by this curve".into() }
        }
        Ok([lower, upper]) => Interval::Between { lower: lower * factor, upper: upper * factor },
        Err(Undetermined::Fixed) => Interval::Fixed { reason: Undetermined::Fixed.to_string() },
        Err(unknown) => Interval::Unknown { reason: unknown.to_string() },
    }
}
