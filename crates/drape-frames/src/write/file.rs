//! Files that are written as a whole.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde::Serialize;

use crate::error::Error;

/// Writes `content` to a temporary file and renames the file to `path`, so that a reader never sees
/// an incomplete file.
///
/// # Errors
/// [`Error::Write`] if the file cannot be written. The file that was at `path` then stays.
pub(crate) fn write_file(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    let temporary = path.with_extension("part");
    replace(path, &temporary, content).map_err(|error| {
        // The error of the removal is ignored: the first error is reported.
        let _ = fs::remove_file(&temporary);
        Error::unwritable(path, &error)
    })
}

/// Writes `content` as JSON to the file `path`.
///
/// # Errors
/// The errors of [`write_file`].
pub(crate) fn write_json(path: &Path, content: &impl Serialize) -> Result<(), Error> {
    write_file(path, |mut to| {
        serde_json::to_writer_pretty(&mut to, content)?;
        writeln!(to)
    })
}

/// Writes `content` to the new file `temporary`, and renames the file to `path`.
fn replace(
    path: &Path,
    temporary: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    remove_temporary(temporary)?;
    let mut to = BufWriter::new(fs::File::create_new(temporary)?);
    content(&mut to)?;
    to.into_inner().map_err(|error| error.into_error())?.sync_all()?;
    fs::rename(temporary, path)
}

/// Removes an incomplete temporary file at `path`, if there is one. If `path` is a symbolic link,
/// only the link is removed.
fn remove_temporary(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
