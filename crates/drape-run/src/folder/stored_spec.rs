//! Specs that are stored with their runs, so that a run that began without a file continues.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostics, Document};

use super::Error;
use crate::file;
use crate::scene_fabric::PlacedSpec;

/// Folder of the spec in the folder of a run.
const FOLDER: &str = "scene";

/// File of the spec in this folder.
const NAME: &str = "scene.toml";

impl PlacedSpec {
    /// Returns the path of the text of a spec that is stored in the folder `run` of a run.
    #[must_use]
    pub fn stored_path(run: &Path) -> PathBuf {
        run.join(FOLDER).join(NAME)
    }

    /// Writes the spec to the folder `run` of a run, with all that the spec holds. Files that the
    /// spec names are named from the root of the file system.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn store(&self, run: &Path) -> Result<(), Error> {
        let folder = run.join(FOLDER);
        let spec = self.spec.with_whole_paths(&self.folder);
        spec.save(&folder).map_err(|error| {
            Error::File(file::Error::Write { path: folder.clone(), reason: error.to_string() })
        })
    }
}

/// Reads the text of the scene at `path`. If `path` is the spec that the run in the folder `run`
/// stores, the text may name the files that it names.
///
/// # Errors
/// A file that cannot be read.
pub fn scene_document(path: &Path, run: &Path) -> Result<Document, Diagnostics> {
    let document = Document::read(path)?;
    let stored = std::path::absolute(PlacedSpec::stored_path(run)).ok();
    if stored.is_none() || std::path::absolute(path).ok() != stored {
        return Ok(document);
    }

    // The program itself has written these paths.
    let texts = document.texts().into_iter().map(PathBuf::from);
    let named: Vec<PathBuf> = texts.filter(|path| path.is_absolute()).collect();
    Ok(document.allowing(&named))
}
