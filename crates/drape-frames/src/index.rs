//! Index: the content of `frames.csv`, a line for each frame.

use std::path::Path;

use serde::Deserialize;

use crate::error::Error;
use crate::text::read_complete_lines;

/// Line of `frames.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub(crate) struct Entry {
    /// Number of the frame, from 0.
    pub(crate) number: usize,
    /// Its time, in s.
    pub(crate) time: f64,
    /// Growth fraction of the minimum separation, above 0 and at most 1.
    pub(crate) growth: f64,
    /// Number of the frame whose file has the bodies; none without bodies.
    pub(crate) bodies: Option<usize>,
    /// Number of vertices of the cloth under pressure of contact; none where it was not stored.
    #[serde(default)]
    pub(crate) touched: Option<usize>,
}

/// Reads the lines of `frames.csv` that are complete: a run that is killed leaves its last one cut.
pub(crate) fn read(path: &Path) -> Result<Vec<Entry>, Error> {
    let text = read_complete_lines(path)?;
    let malformed = |line, reason| Error::Malformed { path: path.to_owned(), line, reason };
    let mut entries: Vec<Entry> = Vec::new();
    let mut table = csv::Reader::from_reader(text.as_bytes());
    for (index, entry) in table.deserialize().enumerate() {
        let line = index + 2;
        let entry: Entry = entry.map_err(|error| malformed(line, error.to_string()))?;
        let Entry { number, time, growth, bodies, .. } = entry;
        if number != index || bodies.is_some_and(|bodies| bodies > number) {
            return Err(malformed(line, "the frames are not numbered one after the other".into()));
        }
        if !time.is_finite() || entries.last().is_some_and(|last| last.time > time) {
            return Err(malformed(
                line,
                format!("{time} s is no time after that of the frame before"),
            ));
        }
        if !(growth > 0.0 && growth <= 1.0) {
            return Err(malformed(line, format!("{growth} is no fraction of a distance")));
        }
        entries.push(entry);
    }
    Ok(entries)
}
