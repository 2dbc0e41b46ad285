//! Places of points: where each has its results, its lock and its record.

mod record;

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::error::Error;
use crate::point::Point;
use crate::study::{Keep, Study};

pub use record::{Outcome, Record};

/// Place of a point: `points/ab/KEY`, with its lock and its record beside it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PointStorage {
    key: String,
    folder: PathBuf,
}

/// Lock of a point, until it is dropped or its process ends, however it does.
#[derive(Debug)]
pub struct PointLock {
    file: File,
    path: PathBuf,
}

impl PointLock {
    /// Removes the file of the lock, which no one needs once the point has a record: whoever takes
    /// the lock looks for one first.
    pub fn remove(self) {
        // Where it cannot be removed it is in nobody's way.
        let _ = std::fs::remove_file(&self.path);
        drop(self.file);
    }
}

impl PointStorage {
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
    pub fn lock(&self) -> Result<Option<PointLock>, Error> {
        let path = self.folder.with_extension("lock");
        if let Some(shelf) = path.parent() {
            std::fs::create_dir_all(shelf).map_err(Error::io("create", shelf))?;
        }
        let file = File::options().write(true).create(true).truncate(false).open(&path);
        let file = file.map_err(Error::io("write", &path))?;
        match file.try_lock() {
            Ok(()) => Ok(Some(PointLock { file, path })),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(Error::io("lock", &path)(error)),
        }
    }

    /// Returns whether a process of the point is running, such as one that outlived its sweep: it
    /// holds the lock of its log.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        let file = File::options().write(true).open(self.log());
        file.is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
    }

    /// Returns the record of the point, if there is one that holds: that of a finished run has its
    /// summary in it, or beside it.
    #[must_use]
    pub fn record(&self) -> Option<Record> {
        let bytes = std::fs::read(self.record_file()).ok()?;
        let record: Record = serde_json::from_slice(&bytes).ok()?;
        let has_summary = || record.summary.is_some() || self.summary().is_some();
        let holds = record.outcome != Outcome::Done || has_summary();
        (record.key == self.key && holds).then_some(record)
    }

    /// Returns how the point ended, in the words of the table.
    #[must_use]
    pub fn outcome(&self) -> String {
        let Some(record) = self.record() else { return "not run".into() };
        record.word(self.summary_of(&record).as_ref())
    }

    /// Returns the summary of the run of a record, unless what ran it failed.
    pub(crate) fn summary_of(&self, record: &Record) -> Option<Value> {
        let is_own = record.outcome != Outcome::WorkerFailed;
        is_own.then(|| record.summary.clone().or_else(|| self.summary()))?
    }

    /// Returns the summary in the folder of its run.
    #[must_use]
    pub fn summary(&self) -> Option<Value> {
        let bytes = std::fs::read(self.folder.join("summary.json")).ok()?;
        let summary: Value = serde_json::from_slice(&bytes).ok()?;
        summary.get("status").is_some().then_some(summary)
    }

    /// Writes the summary of a fit or a test, with what it printed as measures.
    ///
    /// # Errors
    /// The text is not JSON, or the summary cannot be written.
    pub fn write_summary(&self, report: &[u8]) -> Result<(), Error> {
        let path = self.folder.join("summary.json");
        let report: Value = serde_json::from_slice(report)
            .map_err(|error| Error::io("write", &path)(error.into()))?;
        let text = json!({ "status": "ok", "measures": report }).to_string() + "\n";
        std::fs::write(&path, text).map_err(Error::io("write", &path))
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
    pub fn is_interrupted(&self) -> bool {
        let status = self.summary().map(|summary| summary["status"].clone());
        self.folder.join("run.json").is_file() && status.is_none_or(|is| is == "interrupted")
    }

    /// Puts the record of the point beside its folder, which keeps what it is to keep: of measures
    /// alone, nothing is left but the record, which has the summary.
    ///
    /// # Errors
    /// A file cannot be written or removed.
    pub fn finish(&self, record: &Record, keep: Keep) -> Result<(), Error> {
        let is_last = record.outcome != Outcome::WorkerFailed;
        let mut record = record.clone();
        if keep == Keep::Measures && is_last {
            record.summary = self.summary();
        }
        let path = self.record_file();
        let text = serde_json::to_string(&record).expect("a record has a JSON form") + "\n";
        let part = self.folder.with_extension("part");
        std::fs::write(&part, text).map_err(Error::io("write", &part))?;
        std::fs::rename(&part, &path).map_err(Error::io("write", &path))?;
        let log = self.log();
        removed(&log, std::fs::remove_file(&log))?;
        if is_last { self.prune(keep) } else { Ok(()) }
    }

    /// Removes what is not kept.
    fn prune(&self, keep: Keep) -> Result<(), Error> {
        let kept: &[&str] = match keep {
            Keep::All => return Ok(()),
            Keep::Last => &["summary.json", "last.obj", "fabric.toml"],
            Keep::Measures => return removed(&self.folder, std::fs::remove_dir_all(&self.folder)),
        };
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()).filter(|path| path.is_file()) {
            let name = path.file_name().unwrap_or_default();
            if kept.iter().all(|kept| name != *kept) {
                removed(&path, std::fs::remove_file(&path))?;
            }
        }
        Ok(())
    }

    fn record_file(&self) -> PathBuf {
        self.folder.with_extension("json")
    }
}

/// Returns what came of a removal; what is not there is removed.
fn removed(path: &Path, result: std::io::Result<()>) -> Result<(), Error> {
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

    /// Place in a folder, with files of its run.
    fn place(root: &Path, files: &[(&str, &str)]) -> PointStorage {
        let place = PointStorage { key: "ab12".into(), folder: root.join("ab12") };
        std::fs::create_dir_all(&place.folder).expect("a folder");
        for (name, text) in files {
            std::fs::write(place.folder.join(name), text).expect("a file");
        }
        place
    }

    #[test]
    fn a_run_is_finished_if_both_files_say_so_and_begun_if_it_was_cut_off() {
        let is = |files: &[(&str, &str)]| {
            let root = tempfile::tempdir().expect("a folder");
            let place = place(root.path(), files);
            (place.is_finished(), place.is_interrupted())
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
    fn of_measures_alone_the_record_is_kept_unless_a_worker_failed() {
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
        let own = place(root.path(), &files);
        own.finish(&record, Keep::Measures).expect("finished");
        assert!(own.folder.is_dir() && own.record() == Some(record.clone()));
        record.outcome = Outcome::Done;
        own.finish(&record, Keep::All).expect("finished");
        assert!(own.folder.is_dir() && own.record() == Some(record.clone()));
        own.finish(&record, Keep::Measures).expect("finished");
        record.summary = Some(json!({ "status": "ok" }));
        assert!(!own.folder.exists() && own.record() == Some(record));
    }

    #[test]
    fn what_is_in_the_way_of_a_removal_is_said() {
        let path = Path::new("here");
        let failed = |kind: std::io::ErrorKind| removed(path, Err(kind.into()));
        assert!(failed(std::io::ErrorKind::NotFound).is_ok() && removed(path, Ok(())).is_ok());
        assert!(failed(std::io::ErrorKind::PermissionDenied).is_err());
    }
}
