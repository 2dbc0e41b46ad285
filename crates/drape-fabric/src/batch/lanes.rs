//! The number of connectors in a batch, and operations on one number per lane.

/// Number of connectors that are evaluated side by side.
///
/// The number affects only the speed. Eight vectors of four numbers are enough to hide the latency
/// of the exponentials. With more lanes, a rare case in one connector, such as a strain that passes
/// the end of the toe, would delay more of the connectors beside it.
pub const LANES: usize = 32;

/// One number for each connector of a batch.
pub type Lanes = [f64; LANES];

/// Returns whether `condition` holds in any lane, by a sum of bits without a branch per lane.
#[inline(always)]
pub(crate) fn any(condition: impl Fn(usize) -> bool) -> bool {
    (0..LANES).fold(0_u64, |bits, lane| bits | u64::from(condition(lane))) != 0
}

/// Returns `$\max(x, 0)$`, and NaN for a NaN `x`.
#[inline(always)]
pub(crate) fn positive(x: f64) -> f64 {
    if x < 0.0 { 0.0 } else { x }
}
