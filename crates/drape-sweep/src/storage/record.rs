//! Records: what came of a point.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// How a point ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// Its run came to its end.
    #[serde(rename = "done")]
    Done,
    /// Its run was refused or failed, and would fail so again.
    #[serde(rename = "job failed")]
    JobFailed,
    /// What ran it failed, several times; another machine may do better.
    #[serde(rename = "worker failed")]
    WorkerFailed,
}

/// Record of a point whose run has ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Key of the point.
    pub key: String,
    /// How it ended.
    pub outcome: Outcome,
    /// Exit code of the last process, if it ended by itself.
    pub exit_code: Option<i32>,
    /// Number of processes that ended otherwise than by their work before that.
    pub retries: u32,
    /// Wall-clock time of all its processes, in s.
    pub seconds: f64,
    /// Message of the last process; empty where it had none.
    pub message: String,
    /// Summary of its run, where nothing else is kept of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub summary: Option<Value>,
}

impl Record {
    /// Returns how the point ended, in the words of the table; its run has a summary or none.
    pub(crate) fn word(&self, summary: Option<&Value>) -> String {
        let status = summary.and_then(|summary| summary["status"].as_str());
        let word = match (self.outcome, status) {
            (Outcome::WorkerFailed, _) => "worker failed",
            (Outcome::JobFailed, None) => "refused",
            (_, status) => status.unwrap_or_default(),
        };
        word.to_owned()
    }
}

impl Outcome {
    /// Returns how a process ended, by its exit code; `None` for one that a signal ended, which
    /// stands for a worker that failed, as do failures of files.
    #[must_use]
    pub fn from_exit_code(exit_code: Option<i32>) -> Self {
        match exit_code {
            Some(0) => Self::Done,
            None | Some(6 | 8 | 129..) => Self::WorkerFailed,
            Some(_) => Self::JobFailed,
        }
    }
}
