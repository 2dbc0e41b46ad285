//! Runs in folders: their results, and the checkpoints from which they continue.
//!
//! A [`FolderRun`] writes frames and a summary. Beside them it writes `run.json` ([`RunRequest`]),
//! `status.json` (its progress), two checkpoints, and a lock file. The run ends at the end of its
//! scene, at its [`Limits`], or when its [`Watcher`] asks for it. A [`ResumableRun`] continues from
//! the last checkpoint.

mod checkpoint_writer;
mod error;
mod folder_run;
mod goal;
mod limits;
mod lock;
mod options;
mod request;
mod resumable_run;
mod space;
mod status;
mod stored_spec;
mod verdict;

pub use error::Error;
pub use folder_run::{EndedRun, FolderRun, end_at};
pub use goal::Goal;
pub use limits::{Limits, ReachedLimit};
pub use options::{RunOptions, Watcher};
pub use request::RunRequest;
pub use resumable_run::ResumableRun;
pub use space::describe_needs;
pub use status::{LostProcess, lost_process};
pub use stored_spec::scene_document;
pub use verdict::RunVerdict;
