//! Records: the outcome of each point.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Outcome of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// The run came to its end.
    #[serde(rename = "done")]
    Done,
    /// The run was refused or failed, and would fail again in this way.
    #[serde(rename = "job failed")]
    JobFailed,
    /// The process that ran the point failed several times. Another machine may succeed.
    #[serde(rename = "worker failed")]
    WorkerFailed,
}

/// Record of a point whose run has ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Key of the point.
    pub key: String,
    /// Outcome of the point.
    pub outcome: Outcome,
    /// Exit code of the last process, if it ended by itself.
    pub exit_code: Option<i32>,
    /// Number of earlier processes that failed for a reason other than the run itself.
    pub retries: u32,
    /// Wall-clock time of all processes of the point, in s.
    pub seconds: f64,
    /// Message of the last process. Empty if it printed none.
    pub message: String,
    /// Summary of the run, if the study keeps only the measures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub summary: Option<Value>,
}

impl Record {
    /// Returns the outcome of the point as the table shows it. `summary` is the summary of the run,
    /// if there is one.
    pub(crate) fn outcome_text(&self, summary: Option<&Value>) -> String {
        let status = summary.and_then(|summary| summary["status"].as_str());
        let text = match (self.outcome, status) {
            (Outcome::WorkerFailed, _) => "worker failed",
            (Outcome::JobFailed, None) => "refused",
            (_, status) => status.unwrap_or_default(),
        };
        text.to_owned()
    }
}

impl Outcome {
    /// Returns the outcome of a process with the given `exit_code`, which is `None` if a signal
    /// ended the process. A signal and a failure of files mean that the worker failed.
    #[must_use]
    pub fn from_exit_code(exit_code: Option<i32>) -> Self {
        match exit_code {
            Some(0) => Self::Done,
            None | Some(6 | 8 | 129..) => Self::WorkerFailed,
            Some(_) => Self::JobFailed,
        }
    }
}
