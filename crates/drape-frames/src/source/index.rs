//! Index: the content of `frames.csv`, a line for each frame.

use std::path::Path;

use serde::Deserialize;

use crate::error::Error;
use crate::text::read_complete_lines;

/// Line of `frames.csv`, which describes one frame.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct IndexEntry {
    /// Number of the frame, from 0.
    pub(crate) number: usize,
    /// Time of the frame, in s.
    pub(crate) time: f64,
    /// Growth fraction of the minimum separation, above 0 and at most 1.
    pub(crate) growth: f64,
    /// Number of the frame whose file has the bodies, or `None` in a run without bodies.
    pub(crate) bodies: Option<usize>,
    /// Number of vertices of the cloth under pressure of contact, or `None` if pressures were not
    /// stored.
    #[serde(default)]
    pub(crate) touched: Option<usize>,
    /// Hash of the files of the frame, or `None` in folders of older versions.
    #[serde(default)]
    pub(crate) hash: Option<String>,
}

/// Reads the complete lines of the file `path`. The last line may be incomplete if the run was
/// killed.
pub(crate) fn read(path: &Path) -> Result<Vec<IndexEntry>, Error> {
    let text = read_complete_lines(path)?;
    let mut entries: Vec<IndexEntry> = Vec::new();
    let mut table = csv::Reader::from_reader(text.as_bytes());
    for (index, entry) in table.deserialize().enumerate() {
        let line = index + 2;
        let entry: IndexEntry =
            entry.map_err(|error| Error::malformed(path, line, error.to_string()))?;
        let IndexEntry { number, time, growth, bodies, .. } = entry;

        // Each line is the next frame, and its bodies were stored with it or earlier.
        if number != index || bodies.is_some_and(|bodies| bodies > number) {
            let reason = "the frames are not numbered one after the other";
            return Err(Error::malformed(path, line, reason));
        }
        if !time.is_finite() || entries.last().is_some_and(|last| last.time > time) {
            let reason = format!("{time} s is no time after that of the frame before");
            return Err(Error::malformed(path, line, reason));
        }
        if !(growth > 0.0 && growth <= 1.0) {
            let reason = format!("{growth} is no fraction of a distance");
            return Err(Error::malformed(path, line, reason));
        }
        entries.push(entry);
    }
    Ok(entries)
}
