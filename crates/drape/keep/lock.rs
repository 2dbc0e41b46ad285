//! Lock of a folder: one run writes to it at a time.

use std::fs::{File, TryLockError};
use std::path::Path;

use crate::failure::Failure;

/// Lock of a folder, until it is dropped or its process ends, however it does.
pub(crate) struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock of a folder, which is created.
    pub(crate) fn take(folder: &Path) -> Result<Self, Failure> {
        let fail = |error: std::io::Error| {
            Failure::Output(format!("cannot write {}: {error}", folder.display()))
        };
        std::fs::create_dir_all(folder).map_err(fail)?;
        let mut options = File::options();
        let file = options.write(true).create(true).truncate(false).open(folder.join("run.lock"));
        let file = file.map_err(fail)?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(Failure::Usage(format!(
                "another run is writing to {}; wait for its end, or give another folder with -o",
                folder.display()
            ))),
            Err(TryLockError::Error(error)) => Err(fail(error)),
        }
    }
}
