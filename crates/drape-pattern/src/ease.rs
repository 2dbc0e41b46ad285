//! Limits of the ease of a seam: how much longer one side may be than the other.

/// Largest ratio of the lengths of a seam's sides that can be cut.
///
/// The fullest gathers of clothes have about 4. With more, the nodes that are squeezed into one arc
/// of the shorter side would lie closer to each other than cloth is thick.
pub const MAX_EASE: f64 = 5.0;

/// Ratio of the lengths of a seam's sides that is allowed where a file gives none.
pub const DEFAULT_EASE: f64 = 1.1;
