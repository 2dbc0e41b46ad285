//! Files that are written complete or not at all, and what kind a file is.

mod kind;

use std::fs::{File, OpenOptions};
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

pub use kind::FileKind;

/// Reason why a file was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file cannot be written: check space and permissions.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Reason, in words.
        reason: String,
    },
    /// A file of an earlier result cannot be removed: check permissions.
    #[error("cannot remove {}: {reason}", path.display())]
    Remove {
        /// The file.
        path: PathBuf,
        /// Reason, in words.
        reason: String,
    },
    /// The file is there already: allow it to be replaced.
    #[error("{} exists; {help}", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
        /// Remedy.
        help: String,
    },
}

/// Writes a file, through a temporary one so that no reader sees half of it; creates its folder.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Error> {
    write_by(path, |to| to.write_all(content.as_ref()).map_err(|error| failed(path, &error)))
}

/// Returns the error of a file that cannot be written.
fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::Write { path: path.to_owned(), reason: error.to_string() }
}

/// Writes a file likewise, whose content is made as it is written.
///
/// # Errors
/// A file that cannot be written, or the error of what makes its content.
pub fn write_by<E: From<Error>>(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> Result<(), E>,
) -> Result<(), E> {
    let failed = |error| failed(path, &error);
    let temporary = path.with_extension("part");
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    refuse_irregular(path)?;
    let mut file = BufWriter::new(create_anew(&temporary).map_err(failed)?);
    let written = content(&mut file).and_then(|()| {
        file.flush().and_then(|()| std::fs::rename(&temporary, path)).map_err(failed)?;
        Ok(())
    });
    if written.is_err() {
        // What is left of it is of no use; the failure is told, not that of its removal.
        let _ = std::fs::remove_file(&temporary);
    }
    written
}

/// Creates a file that is not there; what is there is removed first, a link itself and not what it
/// leads to.
fn create_anew(path: &Path) -> std::io::Result<File> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => OpenOptions::new().write(true).create_new(true).open(path),
    }
}

/// Refuses to put a file in the place of a folder, a pipe or a device.
fn refuse_irregular(path: &Path) -> Result<(), Error> {
    match std::fs::metadata(path) {
        Ok(found) if !found.is_file() => {
            Err(Error::Write { path: path.to_owned(), reason: "it is there and is no file".into() })
        }
        _ => Ok(()),
    }
}

/// Removes the files of a numbered sequence that are there, up to the first that is not.
///
/// # Errors
/// A file that cannot be removed.
pub fn remove_following(paths: impl IntoIterator<Item = PathBuf>) -> Result<(), Error> {
    for path in paths.into_iter().take_while(|path| path.is_file()) {
        let removed = std::fs::remove_file(&path).map_err(|error| error.to_string());
        removed.map_err(|reason| Error::Remove { path, reason })?;
    }
    Ok(())
}

/// Refuses to replace a file that is there already, unless that is allowed, with a remedy.
///
/// # Errors
/// The file is there, and may not be replaced.
pub fn refuse_existing(path: &Path, force: bool, help: &str) -> Result<(), Error> {
    if path.exists() && !force {
        return Err(Error::Exists { path: path.to_owned(), help: help.into() });
    }
    Ok(())
}
