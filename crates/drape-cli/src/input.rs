//! Files that commands read, with `-` for standard input.
//!
//! Standard input is read once; messages name it `<standard input>`, and relative paths in it are
//! seen from the current folder.

use std::borrow::Cow;
use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use drape::input::{Diagnostic, Diagnostics, Document, Setting, SizeLimit, size_limit_factor};
use drape::run::file::FileKind;

/// Name of standard input in messages.
const NAME: &str = "<standard input>";

/// Limit of standard input, that of a pattern.
const LIMIT: SizeLimit = SizeLimit::new("inputs", 1 << 24);

/// Name of the file of a sheet in its folder.
pub(crate) const SHEET_FILE: &str = "sheet.toml";

/// Text of standard input, or why there is none.
static TEXT: OnceLock<Result<String, String>> = OnceLock::new();

/// Files and folders that the user allows input to name beside those of its own folder.
static ALLOWED: OnceLock<Vec<PathBuf>> = OnceLock::new();

/// Allows input to name these files, and those in these folders; the first call stays.
pub(crate) fn allow(paths: &[PathBuf]) {
    let _ = ALLOWED.set(paths.to_vec());
}

/// Returns what the user allows input to name.
pub(crate) fn allowed() -> &'static [PathBuf] {
    ALLOWED.get().map_or(&[], Vec::as_slice)
}

/// Returns the options by which another process may read what this one may.
pub(crate) fn options() -> Vec<OsString> {
    let whole = |path: &PathBuf| std::path::absolute(path).unwrap_or_else(|_| path.clone());
    let paths = allowed().iter().map(|path| ["--allow-path".into(), whole(path).into_os_string()]);
    let factor = size_limit_factor();
    let raised = (factor > 1).then(|| ["--raise-limits".into(), factor.to_string().into()]);
    paths.chain(raised).flatten().collect()
}

/// Values that the user sets in place of those of the files of a command.
static SETTINGS: OnceLock<Vec<Setting>> = OnceLock::new();

/// Sets values in place of those of the files that the command names; the first call stays.
pub(crate) fn set(settings: &[Setting]) {
    let _ = SETTINGS.set(settings.to_vec());
}

/// Returns whether a path stands for standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Returns the file of a sheet, by its path or that of its folder.
pub(crate) fn sheet_file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join(SHEET_FILE) } else { path.to_owned() }
}

/// Refuses a file or folder that is of another kind than those that a command takes.
pub(crate) fn expect(path: &Path, wanted: &[FileKind]) -> Result<(), Diagnostics> {
    if is_standard(path) { Ok(()) } else { FileKind::expect(path, wanted) }
}

/// Reads a file of one of some kinds, or standard input, with the values that the user sets.
pub(crate) fn document_of(path: &Path, wanted: &[FileKind]) -> Result<Document, Diagnostics> {
    expect(path, wanted)?;
    let document = document(path)?;
    FileKind::expect_document(&document, wanted)?;
    Ok(document)
}

/// Reads a file, or standard input, with the values that the user sets.
pub(crate) fn document(path: &Path) -> Result<Document, Diagnostics> {
    let settings = SETTINGS.get().map_or(&[][..], Vec::as_slice);
    if !is_standard(path) {
        return Document::read(path)?.allowing(allowed()).with_settings(settings);
    }
    match TEXT.get_or_init(read) {
        Ok(text) => Document::new(NAME, text).allowing(allowed()).with_settings(settings),
        Err(message) => {
            let help = "pipe a file in UTF-8 into it, or name the file in place of -";
            Err(Diagnostic::new(NAME, message).help(help).into())
        }
    }
}

fn read() -> Result<String, String> {
    let mut bytes = Vec::new();
    let most = LIMIT.bytes();
    let read = std::io::stdin().lock().take(most.saturating_add(1)).read_to_end(&mut bytes);
    read.map_err(|error| format!("cannot be read: {error}"))?;
    if bytes.len() as u64 > most {
        return Err(format!("has more than {most} bytes, which --raise-limits changes"));
    }
    String::from_utf8(bytes).map_err(|_| "is not UTF-8".into())
}

/// Returns the text of a file that a message names, if it can be read.
pub(crate) fn source(path: &Path) -> Option<Cow<'static, str>> {
    if path.as_os_str() == NAME {
        let text = TEXT.get().and_then(|text| text.as_ref().ok());
        return text.map(|text| Cow::Borrowed(text.as_str()));
    }
    let is_file = std::fs::metadata(path).is_ok_and(|found| found.is_file());
    is_file.then(|| std::fs::read_to_string(path).ok()).flatten().map(Cow::Owned)
}

/// Returns a document of a text, with the values that the user set.
pub(crate) fn with_settings(path: &Path, text: &str) -> Result<Document, Diagnostics> {
    let settings = SETTINGS.get().map_or(&[][..], Vec::as_slice);
    Document::new(path, text).allowing(allowed()).with_settings(settings)
}

/// Returns the path by which messages name a file.
pub(crate) fn shown(path: &Path) -> &Path {
    if is_standard(path) { Path::new(NAME) } else { path }
}

/// Returns the path by which results of a file are named.
pub(crate) fn named(path: &Path) -> &Path {
    if is_standard(path) { Path::new("standard-input") } else { path }
}
