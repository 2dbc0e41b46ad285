//! Options of a run that is kept, and the watcher that is told of its progress.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::limits::Limits;
use drape_dynamics::{Frame, Step};

/// Options of a run that is kept.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// Limits at which it ends with a checkpoint.
    pub limits: Limits,
    /// File of the program. A run is resumed only by a program with the same bytes.
    pub program: PathBuf,
    /// Whether the results of an earlier run are replaced.
    pub replace: bool,
    /// Flag that gives up the step in hand.
    pub give_up: Arc<AtomicBool>,
}

/// Watcher of a run.
pub trait Watcher {
    /// Is called after a step, with how much of the run is done, 0 to 1: it never falls, and is 1 after
    /// the last step alone.
    fn step(&mut self, step: &Step, done: f64);

    /// Is called when a frame has been written.
    fn frame(&mut self, _frame: &Frame) {}

    /// Returns whether the run is to end after this step, with a checkpoint.
    fn is_interrupted(&self) -> bool;
}
