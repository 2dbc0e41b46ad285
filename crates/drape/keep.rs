//! Runs that are kept in a folder: their results, and what they go on from.
//!
//! A [`KeptRun`] writes frames and a summary, and beside them `run.json` ([`RunRequest`]),
//! `status.json` (its progress), two checkpoints, and the file of its lock. It ends at the
//! [`Limits`] that are set to it, or when its [`Watcher`] asks it to; [`RunToResume`] goes on.

mod error;
mod goal;
mod keeper;
mod keeping;
mod limits;
mod lock;
mod request;
mod resume;
mod run;
mod space;
mod status;

pub use error::Error;
pub use goal::Goal;
pub use keeping::{Keeping, Watcher};
pub use limits::Limits;
pub use request::RunRequest;
pub use resume::RunToResume;
pub use run::{EndedRun, KeptRun, end_at};
pub use space::describe_needs;
