//! Record of a run: frames, their files, and the summary.
//!
//! A frame has the positions of all particles and of the bodies' vertices at one time. The topology
//! is common to all frames and is stored once. The summary says how the run went: phases, work of
//! the solver, energy, strain, contact, measures. This chapter reads the world and writes files,
//! but changes nothing in the world.

mod array;
pub(crate) mod frame;
mod manifest;
pub(crate) mod recorder;
pub(crate) mod snapshot;
pub(crate) mod state_hash;
pub(crate) mod step_hashes;
pub(crate) mod stopwatch;
pub(crate) mod summary;
pub(crate) mod topology;
