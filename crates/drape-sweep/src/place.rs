//! Places of points: where each has its results, its lock and its record.

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::error::Error;
use crate::point::Point;
use crate::record::{Outcome, Record};
use crate::study::{Keep, Study};

/// Place of a point: `points/ab/KEY`, with its lock and its record beside it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    key: String,
    folder: PathBuf,
}

/// Lock of a point, until it is dropped or its process ends, however it does.
#[derive(Debug)]
pub struct PlaceLock {
    _file: File,
}

impl Place {
    /// Returns the place of a point of a study.
    #[must_use]
    pub fn new(study: &Study, point: &Point) -> Self {
        let shelf = point.key.get(..2).unwrap_or_default();
        let folder = study.output().join("points").join(shelf).join(&point.key);
        Self { key: point.key.clone(), folder }
    }

    /// Folder of the results of its run.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// File of the messages of its run, while it goes.
    #[must_use]
    pub fn log(&self) -> PathBuf {
        self.folder.with_extension("log")
    }

    /// Takes the lock of the point; returns `None` while another process has it.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn lock(&self) -> Result<Option<PlaceLock>, Error> {
        let path = self.folder.with_extension("lock");
        if let Some(shelf) = path.parent() {
            std::fs::create_dir_all(shelf).map_err(Error::io("create", shelf))?;
        }
        let file = File::options().write(true).create(true).truncate(false).open(&path);
        let file = file.map_err(Error::io("write", &path))?;
        match file.try_lock() {
            Ok(()) => Ok(Some(PlaceLock { _file: file })),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(Error::io("lock", &path)(error)),
        }
    }

    /// Returns whether a run is writing to the folder, as one may that outlived its sweep.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        let file = File::options().write(true).open(self.folder.join("run.lock"));
        file.is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
    }

    /// Returns the record of the point, if there is one that holds: that of a finished run has its
    /// summary beside it.
    #[must_use]
    pub fn record(&self) -> Option<Record> {
        let bytes = std::fs::read(self.record_file()).ok()?;
        let record: Record = serde_json::from_slice(&bytes).ok()?;
        let holds = record.outcome != Outcome::Done || self.summary().is_some();
        (record.key == self.key && holds).then_some(record)
    }

    /// Returns the summary of its run.
    #[must_use]
    pub fn summary(&self) -> Option<Value> {
        let bytes = std::fs::read(self.folder.join("summary.json")).ok()?;
        let summary: Value = serde_json::from_slice(&bytes).ok()?;
        summary.get("status").is_some().then_some(summary)
    }

    /// Returns whether its folder holds a run that came to its end, to the last file.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        let state = std::fs::read(self.folder.join("status.json")).ok();
        let state = state.and_then(|bytes| serde_json::from_slice::<Value>(&bytes).ok());
        state.is_some_and(|state| state["state"] == "ok")
            && self.summary().is_some_and(|summary| summary["status"] == "ok")
    }

    /// Returns whether its folder holds a run that was begun and was cut off.
    #[must_use]
    pub fn is_begun(&self) -> bool {
        let status = self.summary().map(|summary| summary["status"].clone());
        self.folder.join("run.json").is_file() && status.is_none_or(|is| is == "interrupted")
    }

    /// Puts the record of the point beside its folder, which keeps what it is to keep.
    ///
    /// # Errors
    /// A file cannot be written or removed.
    pub fn finish(&self, record: &Record, keep: Keep) -> Result<(), Error> {
        self.prune(keep)?;
        let path = self.record_file();
        let text = serde_json::to_string_pretty(record).expect("a record has a JSON form") + "\n";
        let part = self.folder.with_extension("part");
        std::fs::write(&part, text).map_err(Error::io("write", &part))?;
        std::fs::rename(&part, &path).map_err(Error::io("write", &path))?;
        let log = self.log();
        match std::fs::remove_file(&log) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(Error::io("remove", &log)(error))
            }
            _ => Ok(()),
        }
    }

    /// Removes what is not kept.
    fn prune(&self, keep: Keep) -> Result<(), Error> {
        let kept: &[&str] = match keep {
            Keep::All => return Ok(()),
            Keep::Last => &["summary.json", "last.obj"],
            Keep::Measures => &["summary.json"],
        };
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()).filter(|path| path.is_file()) {
            let name = path.file_name().unwrap_or_default();
            if kept.iter().all(|kept| name != *kept) {
                std::fs::remove_file(&path).map_err(Error::io("remove", &path))?;
            }
        }
        Ok(())
    }

    fn record_file(&self) -> PathBuf {
        self.folder.with_extension("json")
    }
}
