//! Progress of a long case, told to the caller.

/// Function that is called after each simulation of a long case, with the number of all of them.
pub type Progress<'a> = dyn Fn(u64) + Sync + 'a;
