//! Files that a command writes.

use std::path::Path;

use crate::failure::Failure;

/// Writes to a temporary file first, so that a reader never sees half of it; makes the folder.
pub(crate) fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    let temporary = path.with_extension("part");
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let written = folder
        .map_or(Ok(()), std::fs::create_dir_all)
        .and_then(|()| std::fs::write(&temporary, content))
        .and_then(|()| std::fs::rename(&temporary, path));
    written.map_err(|error| Failure::Output(format!("cannot write {}: {error}", path.display())))
}
