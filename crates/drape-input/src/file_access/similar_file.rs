//! Remedies for a path that does not exist.

use std::path::Path;

use crate::spelling::closest;

/// Returns the remedy for `path`, which does not exist: the file that was probably meant, or the
/// folder that was searched.
#[must_use]
pub fn missing_file_help(path: &Path) -> String {
    let folder = folder_of(path);
    match similar_file(path) {
        Some(name) => format!("did you mean {}?", folder.join(name).display()),
        None if !folder.is_dir() => format!("there is no folder {}", folder.display()),
        None => format!("looked in {}", folder.display()),
    }
}

/// Returns the name of the file in the folder of `path` that was probably meant, if `path` does not
/// exist and a name is similar.
#[must_use]
pub fn similar_file(path: &Path) -> Option<String> {
    let entries = std::fs::read_dir(folder_of(path)).ok()?;
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    let wanted = path.file_name()?.to_string_lossy().into_owned();
    closest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
}

/// Returns the folder of `path`, which is `.` for a bare name.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
