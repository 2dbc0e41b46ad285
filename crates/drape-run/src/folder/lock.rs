//! Lock of a folder. Only one run at a time writes to the folder.

use std::fs::{File, TryLockError};
use std::path::Path;

use super::Error;

/// Lock of a folder until the value is dropped or the process ends, by whatever cause.
pub(super) struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock of a `folder`, which is created.
    pub(super) fn take(folder: &Path) -> Result<Self, Error> {
        let fail = |reason| Error::Folder { folder: folder.to_owned(), reason };
        std::fs::create_dir_all(folder).map_err(fail)?;
        let mut options = File::options();
        let file = options.write(true).create(true).truncate(false).open(folder.join("run.lock"));
        let file = file.map_err(fail)?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(Error::Locked { folder: folder.to_owned() }),
            Err(TryLockError::Error(error)) => Err(fail(error)),
        }
    }
}
