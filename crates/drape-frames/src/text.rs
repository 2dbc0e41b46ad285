//! Text files of a run, and the opening of files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::Error;

/// Reads the complete lines of the file `path`. A last line without a line break is left out.
pub(crate) fn read_complete_lines(path: &Path) -> Result<String, Error> {
    let mut text = read_text(path)?;
    text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
    Ok(text)
}

/// Opens the file `path`, which must be a regular file: a pipe would wait for its writer, and a
/// device may never end.
pub(crate) fn open(path: &Path) -> std::io::Result<File> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::other("it is no regular file"));
    }
    File::open(path)
}

/// Reads the text of the file `path`.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    /// Size of the largest file that is read, in bytes. A frame of 4 million particles takes a
    /// quarter.
    const BYTES_MAX: u64 = 1 << 32;

    let file = open(path).map_err(|error| Error::unreadable(path, &error))?;
    let bytes = file.metadata().map_err(|error| Error::unreadable(path, &error))?.len();
    if bytes > BYTES_MAX {
        return Err(Error::TooLarge { path: path.to_owned(), bytes, limit: BYTES_MAX });
    }
    let mut text = String::new();
    file.take(BYTES_MAX)
        .read_to_string(&mut text)
        .map_err(|error| Error::unreadable(path, &error))?;
    Ok(text)
}
