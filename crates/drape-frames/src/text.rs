//! Text files of a run.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::Error;

/// Longest file that is read, in bytes; 4 million particles take a quarter of it.
const BYTES_MAX: u64 = 1 << 32;

/// Reads the text of a file, whose last line must be complete.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    let text = read(path)?;
    if !text.ends_with('\n') {
        let (line, reason) = (text.lines().count().max(1), "the file is cut off here".to_owned());
        return Err(Error::Malformed { path: path.to_owned(), line, reason });
    }
    Ok(text)
}

/// Reads the complete lines of a file.
pub(crate) fn read_complete_lines(path: &Path) -> Result<String, Error> {
    let mut text = read(path)?;
    text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
    Ok(text)
}

/// Opens a regular file: a pipe would wait for its writer, and a device may never end.
pub(crate) fn open(path: &Path) -> std::io::Result<File> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::other("it is no regular file"));
    }
    File::open(path)
}

fn read(path: &Path) -> Result<String, Error> {
    let fail = |error: std::io::Error| {
        let reason = error.to_string();
        Error::Unreadable { path: path.to_owned(), reason }
    };
    let file = open(path).map_err(fail)?;
    let bytes = file.metadata().map_err(fail)?.len();
    if bytes > BYTES_MAX {
        return Err(Error::TooLarge { path: path.to_owned(), bytes, limit: BYTES_MAX });
    }
    let mut text = String::new();
    file.take(BYTES_MAX).read_to_string(&mut text).map_err(fail)?;
    Ok(text)
}
