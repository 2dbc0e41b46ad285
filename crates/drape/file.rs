//! Files that commands write: complete or not at all.

use std::path::Path;

use crate::failure::Failure;

/// Writes a file, through a temporary one so that no reader sees half of it; creates its folder.
pub(crate) fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    let temporary = path.with_extension("part");
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let written = folder
        .map_or(Ok(()), std::fs::create_dir_all)
        .and_then(|()| std::fs::write(&temporary, content))
        .and_then(|()| std::fs::rename(&temporary, path));
    written.map_err(|error| Failure::Output(format!("cannot write {}: {error}", path.display())))
}

/// Refuses to replace a file that is there already, unless that is allowed, with a remedy.
pub(crate) fn refuse_existing(path: &Path, force: bool, help: &str) -> Result<(), Failure> {
    if path.exists() && !force {
        return Err(Failure::Usage(format!("{} exists; {help}", path.display())));
    }
    Ok(())
}
