//! Files that commands write: complete or not at all.

use std::fs::{File, OpenOptions};
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Writes a file, through a temporary one so that no reader sees half of it; creates its folder.
pub(crate) fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    write_by(path, |to| to.write_all(content.as_ref()).map_err(|error| failed(path, &error)))
}

/// Returns the failure of a file that cannot be written.
fn failed(path: &Path, error: &std::io::Error) -> Failure {
    Failure::Output(format!("cannot write {}: {error}", path.display()))
}

/// Writes a file likewise, whose content is made as it is written.
pub(crate) fn write_by<E>(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> Result<(), E>,
) -> Result<(), Failure>
where
    Failure: From<E>,
{
    let failed = |error| failed(path, &error);
    let temporary = path.with_extension("part");
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    refuse_irregular(path)?;
    let mut file = BufWriter::new(create_anew(&temporary).map_err(failed)?);
    let written = content(&mut file).map_err(Failure::from).and_then(|()| {
        file.flush().and_then(|()| std::fs::rename(&temporary, path)).map_err(failed)
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
fn refuse_irregular(path: &Path) -> Result<(), Failure> {
    match std::fs::metadata(path) {
        Ok(found) if !found.is_file() => {
            let message = format!("cannot write {}: it is there and is no file", path.display());
            Err(Failure::Output(message))
        }
        _ => Ok(()),
    }
}

/// Removes the files of a numbered sequence that are there, up to the first that is not.
pub(crate) fn remove_following(paths: impl IntoIterator<Item = PathBuf>) -> Result<(), Failure> {
    for path in paths.into_iter().take_while(|path| path.is_file()) {
        std::fs::remove_file(&path).map_err(|error| {
            Failure::Output(format!("cannot remove {}: {error}", path.display()))
        })?;
    }
    Ok(())
}

/// Refuses to replace a file that is there already, unless that is allowed, with a remedy.
pub(crate) fn refuse_existing(path: &Path, force: bool, help: &str) -> Result<(), Failure> {
    if path.exists() && !force {
        return Err(Failure::Usage(format!("{} exists; {help}", path.display())));
    }
    Ok(())
}
