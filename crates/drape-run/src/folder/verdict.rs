//! Verdict of a run: how it ended, read from its summary.

use std::path::Path;

use serde::Deserialize;

/// How the run in a folder ended.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct RunVerdict {
    /// The [`Status`](drape_dynamics::Status) as the summary states it, such as `ok`.
    pub status: String,
    /// Why the run ended so, if the summary says it.
    pub reason: Option<String>,
    /// Warnings about the result.
    #[serde(default)]
    pub warnings: Vec<String>,
}

impl RunVerdict {
    /// Reads the verdict from the summary of the run in `folder`. Returns `None` if the run has no
    /// summary that can be read: it has not ended.
    #[must_use]
    pub fn read(folder: &Path) -> Option<RunVerdict> {
        let path = folder.join("summary.json");
        // Reading a pipe would wait for ever.
        let is_file = std::fs::metadata(&path).is_ok_and(|metadata| metadata.is_file());
        let text = is_file.then(|| std::fs::read(&path).ok())??;
        serde_json::from_slice(&text).ok()
    }

    /// Returns whether the run was interrupted, so that it can go on.
    #[must_use]
    pub fn is_interrupted(&self) -> bool {
        self.status == "interrupted"
    }

    /// Returns whether the run ended as its scene asks.
    #[must_use]
    pub fn is_ok(&self) -> bool {
        self.status == "ok"
    }

    /// Returns whether surfaces intersected in the run.
    #[must_use]
    pub fn is_intersecting(&self) -> bool {
        self.status == "certificate failed"
    }
}
