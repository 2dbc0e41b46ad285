//! Record of a run: the data that all frames share, and the summary.
//!
//! The summary says how the run went: phases, work of the solver, energy, strain, contact,
//! measures. This chapter reads the world and changes nothing in it.

pub(crate) mod snapshot;
pub(crate) mod state_hash;
pub(crate) mod step_hashes;
pub(crate) mod stopwatch;
pub(crate) mod summary;
pub(crate) mod topology;
