//! Store: checkpoints in a folder.
//!
//! A checkpoint is written completely or not at all. The last two checkpoints are kept.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::checkpoint::Checkpoint;
use crate::error::{Damage, Error};

/// Number of checkpoints that are kept. If the newest one is damaged, the one before it is read.
const KEPT: usize = 2;

/// Name of the temporary file of a checkpoint. The file is renamed once it is complete.
const TEMPORARY: &str = "checkpoint.part";

/// Folder with checkpoints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Store {
    folder: PathBuf,
}

/// Newest checkpoints of a folder, as [`Store::read`] finds them.
#[derive(Debug)]
pub struct StoredCheckpoints {
    /// Newest intact checkpoint, if there is one.
    pub newest: Option<Checkpoint>,
    /// Damaged checkpoints that are newer than `newest`, the newest first.
    pub damaged: Vec<DamagedCheckpoint>,
}

/// Checkpoint that cannot be used because its bytes have changed or are incomplete.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DamagedCheckpoint {
    /// File of the checkpoint.
    pub path: PathBuf,
    /// Fault of the file.
    pub fault: Damage,
}

/// File of a checkpoint, with the number in its name.
struct CheckpointFile {
    number: u32,
    path: PathBuf,
}

impl StoredCheckpoints {
    /// Removes the `damaged` files, so that they do not count among the two checkpoints that are
    /// kept.
    ///
    /// # Errors
    /// [`Error::Write`] if a file cannot be removed.
    pub fn remove_damaged(&self) -> Result<(), Error> {
        for DamagedCheckpoint { path, .. } in &self.damaged {
            fs::remove_file(path).map_err(|reason| Error::Write { path: path.clone(), reason })?;
        }
        Ok(())
    }
}

impl Store {
    /// Returns the store in `folder`, which must exist before [`Store::write`] is called.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// Writes `checkpoint` as the newest one, and then removes all checkpoints but the last two.
    /// When the method returns, the checkpoint outlasts a loss of power.
    ///
    /// # Errors
    /// [`Error::Write`] or [`Error::Read`] if a file or the folder is not accessible, or
    /// [`Error::Irregular`]. A failure to write the checkpoint leaves the earlier checkpoints
    /// unchanged.
    pub fn write(&self, checkpoint: &Checkpoint) -> Result<(), Error> {
        let mut files = self.files()?;
        let number = files.first().map_or(0, |newest| newest.number).saturating_add(1);
        let path = self.folder.join(format!("checkpoint-{number:08}.bin"));
        let temporary = self.folder.join(TEMPORARY);
        if let Err(reason) = self.write_file(checkpoint, &temporary, &path) {
            // An error of the removal would hide the reason, which matters more.
            let _ = fs::remove_file(&temporary);
            return Err(Error::Write { path, reason });
        }

        files.insert(0, CheckpointFile { number, path });
        for CheckpointFile { path, .. } in files.into_iter().skip(KEPT) {
            fs::remove_file(&path).map_err(|reason| Error::Write { path, reason })?;
        }
        Ok(())
    }

    /// Writes `checkpoint` to the file `temporary` and renames this file to `path`.
    fn write_file(&self, checkpoint: &Checkpoint, temporary: &Path, path: &Path) -> io::Result<()> {
        // An incomplete file is removed and created anew: if a link has its name, the file to which
        // the link leads stays as it is.
        remove_if_there(temporary)?;
        let mut writer = BufWriter::new(File::create_new(temporary)?);
        checkpoint.encode(&mut writer)?;
        writer.into_inner().map_err(|error| error.into_error())?.sync_all()?;
        fs::rename(temporary, path)?;
        sync_folder(&self.folder)
    }

    /// Reads the newest intact checkpoint, and the faults of the damaged checkpoints that are
    /// newer.
    ///
    /// # Errors
    /// [`Error::Read`] if the folder cannot be read, or [`Error::Irregular`].
    pub fn read(&self) -> Result<StoredCheckpoints, Error> {
        let mut damaged = Vec::new();
        for CheckpointFile { path, .. } in self.files()? {
            let checkpoint = fs::read(&path)
                .map_err(|error| Damage::Unreadable { reason: error.to_string() })
                .and_then(|bytes| Checkpoint::decode(&bytes));
            match checkpoint {
                Ok(newest) => return Ok(StoredCheckpoints { newest: Some(newest), damaged }),
                Err(fault) => damaged.push(DamagedCheckpoint { path, fault }),
            }
        }
        Ok(StoredCheckpoints { newest: None, damaged })
    }

    /// Returns `true` if the folder has no checkpoint, neither intact nor damaged, and `false` if
    /// it cannot be read.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.files().is_ok_and(|files| files.is_empty())
    }

    /// Removes all checkpoints, and the temporary file of a checkpoint that was not completed.
    ///
    /// # Errors
    /// [`Error::Write`] if a file cannot be removed, [`Error::Read`] if the folder cannot be read,
    /// or [`Error::Irregular`].
    pub fn clear(&self) -> Result<(), Error> {
        let files = self.files()?.into_iter().map(|file| file.path);
        for path in files.chain([self.folder.join(TEMPORARY)]) {
            remove_if_there(&path).map_err(|reason| Error::Write { path, reason })?;
        }
        Ok(())
    }

    /// Returns the files of checkpoints, the newest first. A folder that does not exist has none.
    ///
    /// # Errors
    /// [`Error::Read`] if the folder cannot be read, or [`Error::Irregular`]: reading a pipe would
    /// wait for ever, and a link leads to a file that no run wrote here.
    fn files(&self) -> Result<Vec<CheckpointFile>, Error> {
        let entries = match fs::read_dir(&self.folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries,
        };
        let files = entries
            .and_then(checkpoint_files)
            .map_err(|reason| Error::Read { path: self.folder.clone(), reason })?;
        let is_irregular = |file: &&CheckpointFile| {
            fs::symlink_metadata(&file.path).is_ok_and(|metadata| !metadata.is_file())
        };
        match files.iter().find(is_irregular) {
            None => Ok(files),
            Some(file) => Err(Error::Irregular { path: file.path.clone() }),
        }
    }
}

/// Returns the files of checkpoints among `entries` of a folder, the newest first.
fn checkpoint_files(entries: fs::ReadDir) -> io::Result<Vec<CheckpointFile>> {
    let mut files = Vec::new();
    for entry in entries {
        let path = entry?.path();
        files.extend(checkpoint_number(&path).map(|number| CheckpointFile { number, path }));
    }
    files.sort_by_key(|file| std::cmp::Reverse(file.number));
    Ok(files)
}

/// Returns the number in the name of the file `path`, or `None` if it is no file of a checkpoint.
fn checkpoint_number(path: &Path) -> Option<u32> {
    let name = path.file_name()?.to_str()?;
    let digits = name.strip_prefix("checkpoint-")?.strip_suffix(".bin")?;
    let is_number = digits.len() >= 8 && digits.bytes().all(|digit| digit.is_ascii_digit());
    is_number.then(|| digits.parse().ok())?
}

/// Removes the file `path`, if there is one.
fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Makes the names of the files in `folder` outlast a loss of power.
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
        let stored = store.read().expect("the folder is read");
        stored.newest.map(|checkpoint| checkpoint.get("number").expect("a number"))
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
        assert!(paths.iter().all(|path| path.is_file() && checkpoint_number(path).is_none()));
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
    fn what_is_no_file_in_place_of_a_checkpoint_is_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        store.write(&numbered(1)).expect("it is written");
        let place = folder.path().join("checkpoint-00000002.bin");
        let is_refused = || {
            let refused = |error| matches!(error, Error::Irregular { path } if path == place);
            assert!(store.read().is_err_and(refused) && store.clear().is_err_and(refused));
            assert!(store.write(&numbered(3)).is_err_and(refused));
        };
        fs::create_dir(&place).expect("it is made");
        is_refused();
        fs::remove_dir(&place).expect("it is removed");
        #[cfg(unix)]
        {
            // Also a link to an intact checkpoint.
            let intact = folder.path().join("checkpoint-00000001.bin");
            std::os::unix::fs::symlink(intact, &place).expect("it is linked");
            is_refused();
            fs::remove_file(&place).expect("it is removed");
        }
        assert_eq!(newest(&store), Some(1));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_with_the_name_of_the_incomplete_file_is_replaced_itself() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let kept = folder.path().join("kept.txt");
        fs::write(&kept, "theirs").expect("it is written");
        std::os::unix::fs::symlink(&kept, folder.path().join(TEMPORARY)).expect("it is linked");
        let store = Store::new(folder.path());
        store.write(&numbered(1)).expect("it is written");
        assert_eq!(newest(&store), Some(1));
        assert_eq!(fs::read_to_string(&kept).expect("it is read"), "theirs");
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
    fn an_incomplete_file_that_cannot_be_removed_is_told() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::new(folder.path());
        let place = folder.path().join(TEMPORARY);
        fs::create_dir(&place).expect("it is made");
        assert!(matches!(store.clear(), Err(Error::Write { path, .. }) if path == place));
    }
}
