//! Bisection: the number at which a condition changes.
//!
//! The bracket `$[a, b]$` is halved 60 times, which leaves the last bits of a double. Bisection
//! inverts the virgin curves of laws, the exact solutions and the closed forms of cases.

use std::ops::Range;

/// Halvings of the bracket: `$2^{-60}$` of it is below the rounding of its ends.
const HALVINGS: usize = 60;

/// Bracket of the argument at which a condition changes, in the unit of the argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bracket {
    /// Largest tried argument for which the condition holds.
    pub(crate) low: f64,
    /// Smallest tried argument for which the condition does not hold.
    pub(crate) high: f64,
}

/// Returns the bracket of the number in `range` up to which `holds` is true.
///
/// `holds` is true at the start of `range` and changes once.
#[must_use]
pub(crate) fn bisect(range: Range<f64>, holds: impl Fn(f64) -> bool) -> Bracket {
    let Range { start: mut low, end: mut high } = range;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    Bracket { low, high }
}
