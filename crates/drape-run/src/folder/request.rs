//! Request of a run: its scene and options, from which a run that goes on creates its simulation.

use std::path::{Path, PathBuf};

use drape_input::{Setting, SettingError};
use serde::{Deserialize, Serialize};

use super::Error;
use super::verdict::RunVerdict;
use crate::file;

/// Name of the file of the request.
const NAME: &str = "run.json";

/// Path of a scene without a file: a scene from standard input, or a text.
const STANDARD: &str = "-";

/// Options of a run: its scene, its end and the interval of its checkpoints.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RunRequest {
    /// Path of the scene from the root, or `-` for standard input.
    pub scene: PathBuf,
    /// End of the run, in s, if it differs from the end of the scene.
    pub until: Option<f64>,
    /// Time between two checkpoints, in s.
    pub checkpoint_every: f64,
    /// Whether the state is hashed after each step.
    #[serde(default)]
    pub state_hash: bool,
    /// Keys of the scene that were set beside its file, each as KEY=VALUE.
    #[serde(default)]
    pub set: Vec<String>,
    /// Hash of the scene and of all files that it names, as the run began; none in folders of older
    /// versions, and before a run begins.
    #[serde(default)]
    pub scene_hash: Option<String>,
}

/// Longest time between two checkpoints that a request may ask for, in s.
const CHECKPOINT_EVERY_MAX: f64 = 1e9;

impl RunRequest {
    /// Returns the request of a run of `scene` that ends at `until` and writes a checkpoint every
    /// `checkpoint_every` seconds.
    #[must_use]
    pub fn new(scene: &Path, until: Option<f64>, checkpoint_every: f64) -> Self {
        let scene = whole_path(scene);
        let (state_hash, set, scene_hash) = (false, Vec::new(), None);
        Self { scene, until, checkpoint_every, state_hash, set, scene_hash }
    }

    /// Returns the keys of the scene that were set, each as a [`Setting`].
    ///
    /// # Errors
    /// A text that sets no key.
    pub fn settings(&self) -> Result<Vec<Setting>, Error> {
        let settings = self.set.iter().map(|text| {
            let fail = |error: SettingError| Error::Damaged {
                path: NAME.into(),
                reason: error.to_string(),
            };
            text.parse().map_err(fail)
        });
        settings.collect()
    }

    /// Replaces the path of the scene by `scene`.
    pub fn move_scene(&mut self, scene: &Path) {
        self.scene = whole_path(scene);
    }

    /// Writes the request to a `folder`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        let text = serde_json::to_string_pretty(self).expect("a request always has a JSON form");
        Ok(file::write(&folder.join(NAME), text + "\n")?)
    }

    /// Reads the request of the run in a `folder`.
    ///
    /// # Errors
    /// No run was begun in the folder, or the file of the request is damaged.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(NAME);
        let fail = |reason: String| Error::Damaged { path: path.clone(), reason };
        // Reading a pipe would wait for ever.
        if !path.is_file() {
            let is_there = std::fs::symlink_metadata(&path).is_ok();
            let reason = if is_there { "it is no file" } else { "no such file" };
            return Err(Error::NotBegun { path, reason: reason.into() });
        }
        let text = std::fs::read(&path).map_err(|error| fail(error.to_string()))?;
        let request: Self =
            serde_json::from_slice(&text).map_err(|error| fail(error.to_string()))?;
        if !(0.0..=CHECKPOINT_EVERY_MAX).contains(&request.checkpoint_every) {
            let every = request.checkpoint_every;
            return Err(fail(format!("checkpoint_every = {every} is not a time from 0 to 1e9 s")));
        }
        Ok(request)
    }

    /// Returns whether the scene has no file, because it came from standard input (`-`) or
    /// is a text.
    #[must_use]
    pub fn has_no_file(&self) -> bool {
        self.scene.as_os_str() == STANDARD
    }

    /// Returns whether a `folder` holds a run that was begun and has not ended.
    #[must_use]
    pub fn is_interrupted(folder: &Path) -> bool {
        let ended = RunVerdict::read(folder).is_some_and(|verdict| !verdict.is_interrupted());
        folder.join(NAME).is_file() && !ended
    }
}

/// Returns the path `scene` from the root of the file system. The path of standard input stays.
fn whole_path(scene: &Path) -> PathBuf {
    let whole = std::path::absolute(scene).ok().filter(|_| scene.as_os_str() != STANDARD);
    whole.unwrap_or_else(|| scene.to_owned())
}
