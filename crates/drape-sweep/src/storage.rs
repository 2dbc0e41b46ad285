//! Storage of points: the folder, the lock and the record of each point.

mod record;

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::error::Error;
use crate::point::Point;
use crate::study::{Keep, Study};

pub use record::{Outcome, Record};

/// Storage of a point: the folder `points/ab/KEY` with the results, and the lock and the record
/// beside it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PointStorage {
    /// Key of the point.
    key: String,
    folder: PathBuf,
}

/// Lock of a point. The lock is released when it is dropped, or when its process ends in any way.
#[derive(Debug)]
pub struct PointLock {
    file: File,
    path: PathBuf,
}

impl PointLock {
    /// Removes the file of the lock. The file is not needed once the point has a record, because a
    /// process that takes the lock first looks for a record.
    pub fn remove(self) {
        // A file that cannot be removed does no harm.
        let _ = std::fs::remove_file(&self.path);
        drop(self.file);
    }
}

impl PointStorage {
    /// Returns the storage of `point` of `study`.
    #[must_use]
    pub fn new(study: &Study, point: &Point) -> Self {
        // Subfolders by the first two digits keep the folder of a large study short.
        let prefix = point.key.get(..2).unwrap_or_default();
        let folder = study.output().join("points").join(prefix).join(&point.key);
        Self { key: point.key.clone(), folder }
    }

    /// Returns the folder `points/ab/KEY` with the results of the run.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns the file `KEY.log` with the messages of the run, which exists while the run goes on.
    #[must_use]
    pub fn log(&self) -> PathBuf {
        self.folder.with_extension("log")
    }

    /// Takes the lock of the point. Returns `None` if another process has the lock.
    ///
    /// # Errors
    /// [`Error::Io`] if the folder or the file of the lock cannot be written.
    pub fn lock(&self) -> Result<Option<PointLock>, Error> {
        let path = self.folder.with_extension("lock");
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(Error::io("create", parent))?;
        }
        let file = File::options().write(true).create(true).truncate(false).open(&path);
        let file = file.map_err(Error::io("write", &path))?;
        match file.try_lock() {
            Ok(()) => Ok(Some(PointLock { file, path })),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(Error::io("lock", &path)(error)),
        }
    }

    /// Returns whether a process of the point is running, such as a process that outlived its
    /// sweep. The process holds a lock on the file [`log`](Self::log).
    #[must_use]
    pub fn is_busy(&self) -> bool {
        let file = File::options().write(true).open(self.log());
        file.is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
    }

    /// Returns the record of the point, or `None` if there is no valid record. The record of a
    /// finished run is valid if the summary is in the record or in the folder.
    #[must_use]
    pub fn record(&self) -> Option<Record> {
        let bytes = std::fs::read(self.record_file()).ok()?;
        let record: Record = serde_json::from_slice(&bytes).ok()?;
        let is_valid =
            record.outcome != Outcome::Done || record.summary.is_some() || self.summary().is_some();
        (record.key == self.key && is_valid).then_some(record)
    }

    /// Returns the outcome of the point as the table shows it, such as `ok` or `not run`.
    #[must_use]
    pub fn outcome(&self) -> String {
        let Some(record) = self.record() else { return "not run".into() };
        record.outcome_text(self.summary_of(&record).as_ref())
    }

    /// Returns the summary of the run with the given `record`, or `None` if the worker failed.
    pub(crate) fn summary_of(&self, record: &Record) -> Option<Value> {
        // After a failure of the worker a summary in the folder may be an earlier one.
        if record.outcome == Outcome::WorkerFailed {
            return None;
        }
        record.summary.clone().or_else(|| self.summary())
    }

    /// Returns the content of `summary.json` in the folder, if it has a status.
    #[must_use]
    pub fn summary(&self) -> Option<Value> {
        let bytes = std::fs::read(self.folder.join("summary.json")).ok()?;
        let summary: Value = serde_json::from_slice(&bytes).ok()?;
        summary.get("status").is_some().then_some(summary)
    }

    /// Writes the summary of a fit or a test. `report` is the JSON that the command printed. Its
    /// values become the measures.
    ///
    /// # Errors
    /// [`Error::Io`] if `report` is not JSON, or if the summary cannot be written.
    pub fn write_summary(&self, report: &[u8]) -> Result<(), Error> {
        let path = self.folder.join("summary.json");
        let report: Value = serde_json::from_slice(report)
            .map_err(|error| Error::io("write", &path)(error.into()))?;
        let text = json!({ "status": "ok", "measures": report }).to_string() + "\n";
        std::fs::write(&path, text).map_err(Error::io("write", &path))
    }

    /// Returns whether the folder holds a complete run: both `status.json` and `summary.json` say
    /// `ok`.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        let state = std::fs::read(self.folder.join("status.json")).ok();
        let state = state.and_then(|bytes| serde_json::from_slice::<Value>(&bytes).ok());
        state.is_some_and(|state| state["state"] == "ok")
            && self.summary().is_some_and(|summary| summary["status"] == "ok")
    }

    /// Returns whether the folder holds a run that was begun, as `run.json` shows, and did not end.
    #[must_use]
    pub fn is_interrupted(&self) -> bool {
        let status = self.summary().map(|summary| summary["status"].clone());
        let has_ended = status.is_some_and(|status| status != "interrupted");
        self.folder.join("run.json").is_file() && !has_ended
    }

    /// Writes `record` beside the folder of the point, and removes the files that `keep` does not
    /// name.
    ///
    /// With [`Keep::Measures`] the record contains the summary, and the folder is removed. If the
    /// worker failed, no results are removed.
    ///
    /// # Errors
    /// [`Error::Io`] if a file cannot be written or removed.
    pub fn finish(&self, record: &Record, keep: Keep) -> Result<(), Error> {
        let is_final = record.outcome != Outcome::WorkerFailed;
        let mut record = record.clone();
        if keep == Keep::Measures && is_final {
            record.summary = self.summary();
        }

        // The record is renamed once it is complete, so that no process reads a part of it.
        let path = self.record_file();
        let text = serde_json::to_string(&record).expect("a record has a JSON form") + "\n";
        let part = self.folder.with_extension("part");
        std::fs::write(&part, text).map_err(Error::io("write", &part))?;
        std::fs::rename(&part, &path).map_err(Error::io("write", &path))?;

        let log = self.log();
        check_removal(&log, std::fs::remove_file(&log))?;
        if is_final { self.prune(keep) } else { Ok(()) }
    }

    /// Removes the files of the folder that `keep` does not name.
    fn prune(&self, keep: Keep) -> Result<(), Error> {
        let kept: &[&str] = match keep {
            Keep::All => return Ok(()),
            Keep::Last => &["summary.json", "last.obj", "fabric.toml"],
            Keep::Measures => {
                return check_removal(&self.folder, std::fs::remove_dir_all(&self.folder));
            }
        };
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()).filter(|path| path.is_file()) {
            let name = path.file_name().unwrap_or_default();
            if kept.iter().all(|kept| name != *kept) {
                check_removal(&path, std::fs::remove_file(&path))?;
            }
        }
        Ok(())
    }

    /// Returns the file `KEY.json` of the record.
    fn record_file(&self) -> PathBuf {
        self.folder.with_extension("json")
    }
}

/// Returns the error of the removal of `path`, if it failed. A file that did not exist counts as
/// removed.
fn check_removal(path: &Path, result: std::io::Result<()>) -> Result<(), Error> {
    match result {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(Error::io("remove", path)(error))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a storage in the folder `root` with the given `files` of its run.
    fn storage(root: &Path, files: &[(&str, &str)]) -> PointStorage {
        let storage = PointStorage { key: "ab12".into(), folder: root.join("ab12") };
        std::fs::create_dir_all(&storage.folder).expect("a folder");
        for (name, text) in files {
            std::fs::write(storage.folder.join(name), text).expect("a file");
        }
        storage
    }

    #[test]
    fn a_run_is_finished_if_both_files_say_so_and_begun_if_it_was_cut_off() {
        let is = |files: &[(&str, &str)]| {
            let root = tempfile::tempdir().expect("a folder");
            let stored = storage(root.path(), files);
            (stored.is_finished(), stored.is_interrupted())
        };
        let run = ("run.json", "{}");
        let [ok, stopped] = [r#"{"status": "ok"}"#, r#"{"status": "interrupted"}"#];
        let state = |text| ("status.json", text);
        let summary = |text| ("summary.json", text);
        assert_eq!(is(&[]), (false, false));
        assert_eq!(is(&[run]), (false, true));
        assert_eq!(is(&[run, summary(stopped)]), (false, true));
        assert_eq!(is(&[summary(stopped)]), (false, false));
        assert_eq!(is(&[run, state(r#"{"state": "ok"}"#), summary(ok)]), (true, false));
        assert_eq!(is(&[run, state(r#"{"state": "running"}"#), summary(ok)]), (false, false));
        assert_eq!(is(&[run, state(r#"{"state": "ok"}"#), summary(stopped)]), (false, true));
    }

    #[test]
    fn with_measures_only_the_record_is_kept_unless_a_worker_failed() {
        let root = tempfile::tempdir().expect("a folder");
        let files = [("summary.json", r#"{"status": "ok"}"#)];
        let mut record = Record {
            key: "ab12".into(),
            outcome: Outcome::WorkerFailed,
            exit_code: None,
            retries: 3,
            seconds: 1.0,
            message: String::new(),
            summary: None,
        };
        let stored = storage(root.path(), &files);
        stored.finish(&record, Keep::Measures).expect("finished");
        assert!(stored.folder.is_dir() && stored.record() == Some(record.clone()));
        record.outcome = Outcome::Done;
        stored.finish(&record, Keep::All).expect("finished");
        assert!(stored.folder.is_dir() && stored.record() == Some(record.clone()));
        stored.finish(&record, Keep::Measures).expect("finished");
        record.summary = Some(json!({ "status": "ok" }));
        assert!(!stored.folder.exists() && stored.record() == Some(record));
    }

    #[test]
    fn a_removal_that_fails_is_an_error() {
        let path = Path::new("here");
        let failed = |kind: std::io::ErrorKind| check_removal(path, Err(kind.into()));
        assert!(
            failed(std::io::ErrorKind::NotFound).is_ok() && check_removal(path, Ok(())).is_ok()
        );
        assert!(failed(std::io::ErrorKind::PermissionDenied).is_err());
    }
}
