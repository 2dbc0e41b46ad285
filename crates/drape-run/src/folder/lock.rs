//! Lock of a folder. Only one run at a time writes to the folder.

use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

use super::Error;

/// Name of the file that is locked.
pub(super) const NAME: &str = "run.lock";

/// Lock of a folder until the value is dropped or the process ends, by whatever cause.
pub(super) struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock of a `folder`, which is created.
    ///
    /// # Errors
    /// [`Error::Locked`] if another run has the lock, or [`Error::Folder`] if the lock cannot be
    /// written, or is no file.
    pub(super) fn take(folder: &Path) -> Result<Self, Error> {
        let fail = |reason| Error::Folder { folder: folder.to_owned(), reason };
        std::fs::create_dir_all(folder).map_err(fail)?;
        let file = open(&folder.join(NAME)).map_err(fail)?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(Error::Locked { folder: folder.to_owned() }),
            Err(TryLockError::Error(error)) => Err(fail(error)),
        }
    }
}

/// Returns whether a process holds the lock of `folder`. A lock that cannot be opened counts as
/// held, unless it is missing.
pub(super) fn is_held(folder: &Path) -> bool {
    let path = folder.join(NAME);
    match std::fs::symlink_metadata(&path) {
        Err(error) => error.kind() != io::ErrorKind::NotFound,
        Ok(metadata) if !metadata.is_file() => true,
        // A lock that is taken here is free again when the file is closed.
        Ok(_) => File::open(&path).map_or(true, |file| file.try_lock().is_err()),
    }
}

/// Opens the file `path` for a lock, and creates it if it is missing.
///
/// # Errors
/// The file cannot be opened, or is a link, a folder, a pipe or a device: a link leads to a file of
/// somebody else, and opening a pipe would wait for ever.
fn open(path: &Path) -> io::Result<File> {
    if std::fs::symlink_metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        let what = "a link, a folder, a pipe or a device, and no file; move it away";
        return Err(io::Error::other(format!("{NAME} in it is {what}")));
    }
    File::options().write(true).create(true).truncate(false).open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_run_has_the_lock_at_a_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let lock = Lock::take(folder.path()).expect("it is free");
        assert!(matches!(Lock::take(folder.path()), Err(Error::Locked { .. })));
        drop(lock);
        assert!(Lock::take(folder.path()).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_file_is_not_locked() {
        let folder = tempfile::tempdir().expect("a folder");
        let (place, theirs) = (folder.path().join(NAME), folder.path().join("theirs"));
        std::fs::write(&theirs, "theirs").expect("written");
        for target in [theirs.as_path(), Path::new("/dev/null"), Path::new("missing")] {
            std::os::unix::fs::symlink(target, &place).expect("linked");
            assert!(matches!(Lock::take(folder.path()), Err(Error::Folder { .. })), "{target:?}");
            std::fs::remove_file(&place).expect("removed");
        }
        std::fs::create_dir(&place).expect("made");
        assert!(matches!(Lock::take(folder.path()), Err(Error::Folder { .. })));
    }
}
