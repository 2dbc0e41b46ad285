//! Options of a stored run, and the watcher of its progress.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::limits::Limits;
use drape_dynamics::Step;
use drape_frames::Frame;

/// Options of a run whose results are stored.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// Limits at which the run ends with a checkpoint.
    pub limits: Limits,
    /// File of the program. A run is resumed only by a program with the same bytes.
    pub program: PathBuf,
    /// Whether the results of an earlier run are replaced.
    pub replace: bool,
    /// Flag that aborts the current step.
    pub give_up: Arc<AtomicBool>,
}

/// Watcher of a run.
pub trait Watcher {
    /// Is called after a `step` with the fraction `done` of the run, 0 to 1. The fraction never
    /// falls, and reaches 1 only after the last step.
    fn step(&mut self, step: &Step, done: f64);

    /// Is called when a [`Frame`] has been written.
    fn frame(&mut self, _frame: &Frame) {}

    /// Returns `true` to end the run after this step with a checkpoint.
    fn is_interrupted(&self) -> bool;
}
