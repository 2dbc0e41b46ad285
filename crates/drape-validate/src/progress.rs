//! Progress of a long case, reported to the caller.

/// Function that a long case calls after each of its simulations. Its argument is the number of all
/// simulations of the case.
pub type Progress<'a> = dyn Fn(u64) + Sync + 'a;
