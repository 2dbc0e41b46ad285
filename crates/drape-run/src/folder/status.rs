//! Status of a run for other programs: `status.json`, written atomically.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use drape_dynamics::PhaseName;
use serde_json::{Value, json};

use super::lock;
use super::verdict::RunVerdict;
use crate::file;

/// Name of the file.
const NAME: &str = "status.json";

/// State of a run that goes on.
const RUNNING: &str = "running";

/// Largest file that is read, in bytes.
const BYTES_MAX: u64 = 1 << 20;

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

/// File of the status. If a run that has started panics, the file says so. A run that is refused
/// before leaves the file as it is.
pub(super) struct StatusFile {
    path: PathBuf,
    begin: Instant,
    /// Time of the last update of the file.
    updated: Option<Instant>,
    steps: usize,
    last: Option<Advance>,
    /// Whether the run has started and not ended.
    is_running: bool,
}

impl StatusFile {
    /// Begins the status of a run in a `folder`.
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            path: folder.join(NAME),
            begin: Instant::now(),
            updated: None,
            steps: 0,
            last: None,
            is_running: false,
        }
    }

    /// Returns the time at which the run began, `begin`.
    pub(super) fn begin(&self) -> Instant {
        self.begin
    }

    /// Writes that the run goes on.
    pub(super) fn start(&mut self) {
        self.is_running = true;
        self.write(RUNNING, None);
    }

    /// Takes the progress of a step, `advance`, into account. Returns whether the file was due for
    /// an update.
    pub(super) fn step(&mut self, advance: Advance) -> bool {
        self.steps += 1;
        self.last = Some(advance);
        let is_due = self.updated.is_none_or(|updated| updated.elapsed() >= EVERY);
        if is_due {
            self.updated = Some(Instant::now());
            self.write(RUNNING, None);
        }
        is_due
    }

    /// Writes the `outcome` of the run, with a `message`.
    pub(super) fn end(&mut self, outcome: &str, message: Option<String>) {
        self.is_running = false;
        self.write(outcome, message);
    }

    /// Writes the file with a `state` and a `message`. A status that cannot be written ends no run.
    fn write(&self, state: &str, message: Option<String>) {
        let seconds = self.begin.elapsed().as_secs_f64();
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs_f64();
        let remaining = self.last.filter(|last| last.done > 0.0 && state == RUNNING);
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

/// Process that ran a scene and is gone, although `status.json` said that the run goes on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LostProcess {
    /// Number of the process, if the file states it.
    pub number: Option<u64>,
}

/// Returns the process that ran the scene in `folder`, if it is gone and the run has not ended. The
/// file `status.json` then says so too, if it can be written: its `state` becomes `killed`.
///
/// A process that is still there holds the lock of the folder.
#[must_use]
pub fn lost_process(folder: &Path) -> Option<LostProcess> {
    let path = folder.join(NAME);
    let mut status = read(&path).filter(|status| status["state"] == RUNNING)?;
    if lock::is_held(folder) {
        return None;
    }

    // The process may have been ended after its summary.
    let verdict = RunVerdict::read(folder);
    let number = status["process"].as_u64();
    match &verdict {
        Some(RunVerdict { status: ended, .. }) => status["state"] = json!(ended),
        None => {
            status["state"] = json!("killed");
            status["message"] = json!("the process was ended before the run");
        }
    }
    if let Some(entries) = status.as_object_mut() {
        entries.remove("expected_end");
    }
    let _ = file::write(&path, format!("{status:#}\n"));
    verdict.is_none().then_some(LostProcess { number })
}

/// Reads the status in the file `path`. Returns `None` if the file is none that a run writes.
fn read(path: &Path) -> Option<Value> {
    // Reading a pipe would wait for ever.
    std::fs::symlink_metadata(path).ok().filter(std::fs::Metadata::is_file)?;
    let mut text = Vec::new();
    File::open(path).ok()?.take(BYTES_MAX).read_to_end(&mut text).ok()?;
    serde_json::from_slice(&text).ok().filter(Value::is_object)
}

impl Drop for StatusFile {
    fn drop(&mut self) {
        if self.is_running {
            let panics = std::thread::panicking();
            self.write(if panics { "panicked" } else { "failed" }, None);
        }
    }
}
