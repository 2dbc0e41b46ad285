//! Safety of a run: its lock, its request, checkpoints, limits, signals that end it, and its status
//! for other programs.
//!
//! A run keeps in its folder, beside its results, `run.json` (its request), `status.json` (its
//! progress), two checkpoints, and the file of its lock. [`Keeper`] writes them as the run goes.

mod keeper;
mod limits;
mod lock;
mod request;
pub(crate) mod signal;
mod status;

pub(crate) use keeper::{Keeper, Kept};
pub(crate) use limits::{Limits, positive};
pub(crate) use lock::Lock;
pub(crate) use request::{RunRequest, status_of};
pub(crate) use status::Advance;
