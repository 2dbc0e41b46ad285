//! Store: checkpoints in a folder, written whole or not at all; the last two are kept.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::checkpoint::Checkpoint;
use crate::error::{Damage, Error};

/// Number of checkpoints that are kept: where the newest one is damaged, the one before it is read.
const KEPT: usize = 2;

/// Name of the temporary file of a checkpoint, which is renamed once it is complete.
const TEMPORARY: &str = "checkpoint.part";

/// Folder with checkpoints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Store {
    folder: PathBuf,
}

/// Checkpoints of a folder.
#[derive(Debug)]
pub struct StoredCheckpoints {
    /// Newest one that is intact.
    pub newest: Option<Checkpoint>,
    /// Newer ones that are not, the newest first.
    pub damaged: Vec<DamagedCheckpoint>,
}

/// Checkpoint whose bytes have changed since it was written, or that is incomplete.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DamagedCheckpoint {
    /// File.
    pub path: PathBuf,
    /// Fault.
    pub fault: Damage,
}

/// File of a checkpoint.
struct Numbered {
    number: u32,
    path: PathBuf,
}

impl StoredCheckpoints {
    /// Removes those that are damaged, so that they are not among the two that are kept.
    ///
    /// # Errors
    /// When one cannot be removed.
    pub fn remove_damaged(&self) -> Result<(), Error> {
        for DamagedCheckpoint { path, .. } in &self.damaged {
            let fail = |reason| Error::Write { path: path.clone(), reason };
            fs::remove_file(path).map_err(fail)?;
        }
        Ok(())
    }
}

impl Store {
    /// Store in a folder, which need not be there before the first checkpoint is written.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// Writes a checkpoint as the newest one, and then removes all but the last two. When it
    /// returns, the checkpoint outlasts a loss of power.
    ///
    /// # Errors
    /// When a file cannot be written; the checkpoints before it are then as they were.
    pub fn write(&self, checkpoint: &Checkpoint) -> Result<(), Error> {
        let mut files = self.files()?;
        let number = files.first().map_or(0, |newest| newest.number).saturating_add(1);
        let path = self.folder.join(format!("checkpoint-{number:08}.bin"));
        let temporary = self.folder.join(TEMPORARY);
        let write = || -> io::Result<()> {
            let mut to = BufWriter::new(File::create(&temporary)?);
            checkpoint.encode(&mut to)?;
            to.into_inner().map_err(|error| error.into_error())?.sync_all()?;
            fs::rename(&temporary, &path)?;
            sync_folder(&self.folder)
        };
        if let Err(reason) = write() {
            // The failure is told, not that of the removal.
            let _ = fs::remove_file(&temporary);
            return Err(Error::Write { path, reason });
        }
        files.insert(0, Numbered { number, path });
        for Numbered { path, .. } in files.into_iter().skip(KEPT) {
            fs::remove_file(&path).map_err(|reason| Error::Write { path, reason })?;
        }
        Ok(())
    }

    /// Reads the newest checkpoint that is intact.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn read(&self) -> Result<StoredCheckpoints, Error> {
        let mut damaged = Vec::new();
        for Numbered { path, .. } in self.files()? {
            let bytes = fs::read(&path);
            let unreadable = |error: io::Error| Damage::Unreadable { reason: error.to_string() };
            match bytes.map_err(unreadable).and_then(|bytes| Checkpoint::decode(&bytes)) {
                Ok(newest) => return Ok(StoredCheckpoints { newest: Some(newest), damaged }),
                Err(fault) => damaged.push(DamagedCheckpoint { path, fault }),
            }
        }
        Ok(StoredCheckpoints { newest: None, damaged })
    }

    /// Returns whether there is no checkpoint, intact or not.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.files().is_ok_and(|files| files.is_empty())
    }

    /// Removes all checkpoints, and what is left of one that was not finished.
    ///
    /// # Errors
    /// When a file cannot be removed.
    pub fn clear(&self) -> Result<(), Error> {
        let files = self.files()?.into_iter().map(|file| file.path);
        for path in files.chain([self.folder.join(TEMPORARY)]) {
            match fs::remove_file(&path) {
                Err(reason) if reason.kind() != io::ErrorKind::NotFound => {
                    return Err(Error::Write { path, reason });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Returns the files of checkpoints, the newest first.
    fn files(&self) -> Result<Vec<Numbered>, Error> {
        let fail = |reason| Error::Read { path: self.folder.clone(), reason };
        let entries = match fs::read_dir(&self.folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            other => other.map_err(fail)?,
        };
        let mut files = Vec::new();
        for entry in entries {
            let path = entry.map_err(fail)?.path();
            files.extend(number_of(&path).map(|number| Numbered { number, path }));
        }
        files.sort_by_key(|file| std::cmp::Reverse(file.number));
        Ok(files)
    }
}

/// Returns the number in the name of a checkpoint.
fn number_of(path: &Path) -> Option<u32> {
    let name = path.file_name()?.to_str()?;
    let digits = name.strip_prefix("checkpoint-")?.strip_suffix(".bin")?;
    let is_number = digits.len() >= 8 && digits.bytes().all(|digit| digit.is_ascii_digit());
    is_number.then(|| digits.parse().ok())?
}

/// Makes the names of a folder outlast a loss of power.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identity::Identity;

    fn numbered(number: u64) -> Checkpoint {
        let mut checkpoint = Checkpoint::new(Identity::new("test"));
        checkpoint.put("number", &number).expect("it is encoded");
        checkpoint
    }

    fn newest(store: &Store) -> Option<u64> {
        let found = store.read().expect("the folder is read");
        found.newest.map(|own| own.get("number").expect("a number"))
    }

    #[test]
    fn the_last_two_are_kept_and_the_last_is_read() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        assert!(store.is_empty() && newest(&store).is_none());
        for number in 1..=5 {
            store.write(&numbered(number)).expect("it is written");
            assert_eq!(newest(&store), Some(number));
            assert!(!store.is_empty());
        }
        let mut names: Vec<_> = fs::read_dir(folder.path())
            .expect("a folder")
            .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"))
            .collect();
        names.sort();
        assert_eq!(names, ["checkpoint-00000004.bin", "checkpoint-00000005.bin"]);
        store.clear().expect("it is cleared");
        assert!(store.is_empty());
    }

    #[test]
    fn damage_and_a_write_that_was_cut_off_lead_to_the_one_before() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        store.write(&numbered(1)).expect("it is written");
        store.write(&numbered(2)).expect("it is written");
        fs::write(folder.path().join(TEMPORARY), b"DRAPECK").expect("it is written");
        assert_eq!(newest(&store), Some(2));
        let last = folder.path().join("checkpoint-00000002.bin");
        let mut bytes = fs::read(&last).expect("it is read");
        let middle = bytes.len() / 2;
        bytes[middle] ^= 16;
        fs::write(&last, &bytes).expect("it is written");
        let found = store.read().expect("the folder is read");
        assert_eq!(found.damaged.len(), 1);
        assert_eq!(found.damaged[0].path, last);
        assert_eq!(newest(&store), Some(1));
        found.remove_damaged().expect("it is removed");
        assert!(!last.exists() && store.read().expect("the folder is read").damaged.is_empty());
        fs::write(&last, &bytes).expect("it is written");
        // The next one is newer than both.
        store.write(&numbered(3)).expect("it is written");
        assert_eq!(newest(&store), Some(3));
        assert!(folder.path().join("checkpoint-00000003.bin").exists());
    }

    #[test]
    fn files_of_other_names_are_not_touched() {
        let folder = tempfile::tempdir().expect("a folder");
        let names = ["checkpoint-7.bin", "checkpoint-+0000001.bin", "checkpoint-abcdefgh.bin"];
        let paths = names.map(|name| folder.path().join(name));
        paths.iter().for_each(|path| fs::write(path, "theirs").expect("written"));
        Store::new(folder.path()).clear().expect("it can be read");
        assert!(paths.iter().all(|path| path.is_file() && number_of(path).is_none()));
    }

    #[test]
    #[cfg(unix)]
    fn a_folder_that_cannot_be_synchronised_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(sync_folder(folder.path()).is_ok());
        assert!(sync_folder(&folder.path().join("missing")).is_err());
    }

    #[test]
    fn numbers_go_on_beyond_eight_digits() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        let planted = folder.path().join("checkpoint-99999999.bin");
        fs::write(&planted, b"nothing").expect("it is written");
        fs::write(folder.path().join("checkpoint-+9999999.bin"), b"nothing")
            .expect("it is written");
        for number in 1..=3 {
            store.write(&numbered(number)).expect("it is written");
            assert_eq!(newest(&store), Some(number));
        }
        assert!(!planted.exists() && folder.path().join("checkpoint-100000002.bin").exists());
    }

    #[test]
    fn a_folder_in_place_of_a_checkpoint_is_told() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        store.write(&numbered(1)).expect("it is written");
        fs::create_dir(folder.path().join("checkpoint-00000002.bin")).expect("it is made");
        let found = store.read().expect("the folder is read");
        assert!(matches!(found.damaged[0].fault, Damage::Unreadable { .. }));
        assert_eq!(newest(&store), Some(1));
    }

    #[test]
    fn a_folder_that_is_not_there_has_no_checkpoints() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path().join("missing"));
        assert!(store.is_empty() && newest(&store).is_none());
        store.clear().expect("nothing is to be removed");
    }

    #[test]
    fn a_file_in_place_of_the_folder_is_told() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("file");
        fs::write(&file, b"text").expect("it is written");
        let store = Store::new(&file);
        assert!(matches!(store.read(), Err(Error::Read { path, .. }) if path == file));
        assert!(matches!(store.write(&numbered(1)), Err(Error::Read { .. })));
        assert!(!store.is_empty(), "nobody knows");
    }

    #[test]
    fn a_checkpoint_that_cannot_be_removed_is_told() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        let place = folder.path().join("checkpoint-00000001.bin");
        fs::create_dir(&place).expect("it is made");
        assert!(matches!(store.clear(), Err(Error::Write { path, .. }) if path == place));
    }
}
