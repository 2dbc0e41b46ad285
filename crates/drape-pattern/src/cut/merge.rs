//! Merge: what remains of a collapsed piece of a seam.

/// Two breakpoints that are sewn to each other and remain of a collapsed piece of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Merge {
    /// Number of the seam.
    pub seam: usize,
    /// Breakpoints of both sides.
    pub points: [usize; 2],
}
