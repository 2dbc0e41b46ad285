//! Files that commands write: complete or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
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
    let mut file = BufWriter::new(File::create(&temporary).map_err(failed)?);
    let written = content(&mut file).map_err(Failure::from).and_then(|()| {
        file.flush().and_then(|()| std::fs::rename(&temporary, path)).map_err(failed)
    });
    if written.is_err() {
        // What is left of it is of no use; the failure is told, not that of its removal.
        let _ = std::fs::remove_file(&temporary);
    }
    written
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
