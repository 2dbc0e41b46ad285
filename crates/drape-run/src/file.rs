//! Files that are written completely or not at all, and the kinds of files.

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
    /// The file exists already: allow it to be replaced.
    #[error("{} exists; {help}", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
        /// Remedy.
        help: String,
    },
}

/// Writes `content` to the file at `path` and creates its folder. A temporary file ensures that no
/// reader sees half of the content.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Error> {
    write_by(path, |to| to.write_all(content.as_ref()).map_err(|error| failed(path, &error)))
}

/// Returns the `error` of a file at `path` that cannot be written.
fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::Write { path: path.to_owned(), reason: error.to_string() }
}

/// Writes a file as [`write()`] does. The closure `content` writes the content.
///
/// # Errors
/// A file that cannot be written, or the error of `content`.
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
        // The incomplete file is of no use. The first failure is reported, not a failure of the
        // removal.
        let _ = std::fs::remove_file(&temporary);
    }
    written
}

/// Creates a new file at `path`. An existing file is removed first. A link is removed itself, and
/// not the file to which it leads.
fn create_anew(path: &Path) -> std::io::Result<File> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => OpenOptions::new().write(true).create_new(true).open(path),
    }
}

/// Refuses to replace a folder, a pipe or a device at `path` by a file.
fn refuse_irregular(path: &Path) -> Result<(), Error> {
    match std::fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() => {
            Err(Error::Write { path: path.to_owned(), reason: "it is there and is no file".into() })
        }
        _ => Ok(()),
    }
}

/// Removes the existing files of the numbered sequence `paths`, up to the first file that does not
/// exist.
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

/// Refuses to replace an existing file at `path`, unless `force` allows it. The error contains the
/// remedy `help`.
///
/// # Errors
/// The file exists, and may not be replaced.
pub fn refuse_existing(path: &Path, force: bool, help: &str) -> Result<(), Error> {
    if path.exists() && !force {
        return Err(Error::Exists { path: path.to_owned(), help: help.into() });
    }
    Ok(())
}
