//! Request of a run: its scene and options, with which `drape resume` creates the simulation again.

use std::path::{Path, PathBuf};

use drape::input::Setting;
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::{file, input};

/// Name of its file.
const NAME: &str = "run.json";

/// Options of a run: its scene, its end and the interval of its checkpoints.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct RunRequest {
    /// Scene, as a whole path, or `-` for standard input.
    pub(crate) scene: PathBuf,
    /// End of the run, in s, if it is not that of the scene.
    pub(crate) until: Option<f64>,
    /// Time between two checkpoints, in s.
    pub(crate) checkpoint_every: f64,
    /// Whether the state is hashed after each step.
    #[serde(default)]
    pub(crate) state_hash: bool,
    /// Keys of the scene that were set on the command line, each as KEY=VALUE.
    #[serde(default)]
    pub(crate) set: Vec<String>,
}

impl RunRequest {
    /// Makes the request of a scene.
    pub(crate) fn new(scene: &Path, until: Option<f64>, checkpoint_every: f64) -> Self {
        let scene = whole_path(scene);
        Self { scene, until, checkpoint_every, state_hash: false, set: Vec::new() }
    }

    /// Returns the keys of the scene that were set.
    pub(crate) fn settings(&self) -> Result<Vec<Setting>, Failure> {
        let settings = self.set.iter().map(|text| {
            text.parse().map_err(|error| Failure::Usage(format!("{NAME}: set: {error}")))
        });
        settings.collect()
    }

    /// Gives the scene another place.
    pub(crate) fn move_scene(&mut self, scene: &Path) {
        self.scene = whole_path(scene);
    }

    /// Writes it to a folder.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| Failure::Output(error.to_string()))?;
        file::write(&folder.join(NAME), text + "\n")
    }

    /// Reads that of a folder.
    pub(crate) fn read(folder: &Path) -> Result<Self, Failure> {
        let fail = |reason: String| {
            Failure::Usage(format!(
                "{}: {reason}; a folder that `drape run` has begun has it",
                folder.join(NAME).display()
            ))
        };
        let text = std::fs::read(folder.join(NAME)).map_err(|error| fail(error.to_string()))?;
        serde_json::from_slice(&text).map_err(|error| fail(error.to_string()))
    }

    /// Returns whether a folder holds a run that was begun and has not ended.
    pub(crate) fn is_interrupted(folder: &Path) -> bool {
        let ended = status_of(folder).is_some_and(|status| status != "interrupted");
        folder.join(NAME).is_file() && !ended
    }
}

/// Returns a path from the root of the file system; that of standard input stays.
fn whole_path(scene: &Path) -> PathBuf {
    let whole = std::path::absolute(scene).ok().filter(|_| !input::is_standard(scene));
    whole.unwrap_or_else(|| scene.to_owned())
}

/// Returns the `status` of a run's summary; `None` without a summary.
pub(crate) fn status_of(folder: &Path) -> Option<String> {
    let text = std::fs::read(folder.join("summary.json")).ok()?;
    let summary: serde_json::Value = serde_json::from_slice(&text).ok()?;
    Some(summary["status"].as_str()?.to_owned())
}
