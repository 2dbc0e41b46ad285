//! Status of a run for other programs: `status.json`, written atomically.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use drape_dynamics::PhaseName;
use serde_json::{Value, json};

use crate::file;

/// Time between two updates.
const EVERY: Duration = Duration::from_secs(1);

/// Progress of a run after a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Advance {
    pub(super) phase: PhaseName,
    /// Part of the run that is done, 0 to 1.
    pub(super) done: f64,
    /// Time reached, in s.
    pub(super) time: f64,
}

/// File of the status. If a run panics, the file says so.
pub(super) struct StatusFile {
    path: PathBuf,
    begin: Instant,
    /// Time of the last update of the file.
    updated: Option<Instant>,
    steps: usize,
    last: Option<Advance>,
    is_over: bool,
}

impl StatusFile {
    /// Begins the status of a run in a `folder`.
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            path: folder.join("status.json"),
            begin: Instant::now(),
            updated: None,
            steps: 0,
            last: None,
            is_over: false,
        }
    }

    /// Returns the time at which the run began, `begin`.
    pub(super) fn begin(&self) -> Instant {
        self.begin
    }

    /// Takes the progress of a step, `advance`, into account. Returns whether the file was due for
    /// an update.
    pub(super) fn step(&mut self, advance: Advance) -> bool {
        self.steps += 1;
        self.last = Some(advance);
        let is_due = self.updated.is_none_or(|updated| updated.elapsed() >= EVERY);
        if is_due {
            self.updated = Some(Instant::now());
            self.write("running", None);
        }
        is_due
    }

    /// Writes the `outcome` of the run, with a `message`.
    pub(super) fn end(&mut self, outcome: &str, message: Option<String>) {
        self.is_over = true;
        self.write(outcome, message);
    }

    /// Writes the file with a `state` and a `message`. A status that cannot be written ends no run.
    fn write(&self, state: &str, message: Option<String>) {
        let seconds = self.begin.elapsed().as_secs_f64();
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs_f64();
        let remaining = self.last.filter(|last| last.done > 0.0 && state == "running");
        let remaining = remaining.map(|last| seconds * (1.0 - last.done) / last.done);

        let mut status = json!({
            "state": state,
            "process": std::process::id(),
            "updated": now.round(),
            "wall_seconds": seconds,
            "steps": self.steps,
        });

        let mut put = |key: &str, value: Value| status[key] = value;
        if let Some(Advance { phase, done, time }) = self.last {
            put("phase", json!(phase));
            put("done", json!(done));
            put("time", json!(time));
        }
        if let Some(remaining) = remaining {
            put("expected_end", json!((now + remaining).round()));
        }
        if let Some(message) = message {
            put("message", json!(message));
        }
        let _ = file::write(&self.path, format!("{status:#}\n"));
    }
}

impl Drop for StatusFile {
    fn drop(&mut self) {
        if !self.is_over {
            let panics = std::thread::panicking();
            self.write(if panics { "panicked" } else { "failed" }, None);
        }
    }
}
