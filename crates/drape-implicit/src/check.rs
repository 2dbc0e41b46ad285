//! Checks of lists and steps, which every entry shares.

use crate::error::Error;

/// Checks that the list called `name` has the `expected` length.
pub(crate) fn check_length(name: &'static str, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found { Ok(()) } else { Err(Error::Dimension { name, expected, found }) }
}

/// Checks that the length `dt` of a step, in s, is positive and finite.
pub(crate) fn check_step(dt: f64) -> Result<(), Error> {
    if dt > 0.0 && dt.is_finite() { Ok(()) } else { Err(Error::StepLength { dt }) }
}
