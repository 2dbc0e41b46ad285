//! Files that commands read, with `-` for standard input.
//!
//! Standard input is read once. Messages name it `<standard input>`, and relative paths in it start
//! at the current folder.

use std::borrow::Cow;
use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use drape::input::{Diagnostic, Diagnostics, Document, FileAccess, Setting, SizeLimit};
use drape::run::file::FileKind;
use drape::run::{LostProcess, lost_process};

use crate::console::note;

/// Name of standard input in messages.
const NAME: &str = "<standard input>";

/// Size limit of standard input. Patterns have an equal limit.
const LIMIT: SizeLimit = SizeLimit::new("inputs", 1 << 24);

/// Name of the file of a sheet in its folder.
pub(crate) const SHEET_FILE: &str = "sheet.toml";

/// Text of standard input, or the reason why it cannot be read.
static TEXT: OnceLock<Result<String, String>> = OnceLock::new();

/// Access to files that `--allow-path` and `--raise-limits` give.
static ACCESS: OnceLock<FileAccess> = OnceLock::new();

/// Gives all input of the command the access `access` to files. Only the first call has an effect.
pub(crate) fn set_access(access: FileAccess) {
    let _ = ACCESS.set(access);
}

/// Returns the access to files that [`set_access`] gave to all input of the command.
pub(crate) fn access() -> &'static FileAccess {
    ACCESS.get().unwrap_or_else(FileAccess::usual)
}

/// Returns the command-line options `--allow-path` and `--raise-limits` of this process, for a
/// worker process that reads the same input.
pub(crate) fn options() -> Vec<OsString> {
    let FileAccess { allowed, size_factor: factor, .. } = access();
    let paths = allowed.iter().map(|path| {
        let absolute = std::path::absolute(path).unwrap_or_else(|_| path.clone());
        ["--allow-path".into(), absolute.into_os_string()]
    });
    let raised = (*factor > 1).then(|| ["--raise-limits".into(), factor.to_string().into()]);
    paths.chain(raised).flatten().collect()
}

/// Values of `--set`, which replace values in the files of a command.
static SETTINGS: OnceLock<Vec<Setting>> = OnceLock::new();

/// Lets `settings` replace values in the files that the command names. Only the first call has an
/// effect.
pub(crate) fn set_values(settings: &[Setting]) {
    let _ = SETTINGS.set(settings.to_vec());
}

/// Returns the kind of the file or folder at `path`, `None` if it has no known kind.
pub(crate) fn kind(path: &Path) -> Option<FileKind> {
    FileKind::of(path, access())
}

/// Returns whether `path` is `-`, which stands for standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Returns the path of a sheet's file. `path` names the file or its folder.
pub(crate) fn sheet_file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join(SHEET_FILE) } else { path.to_owned() }
}

/// Refuses a file or folder at `path` whose kind is not in `wanted`.
pub(crate) fn expect(path: &Path, wanted: &[FileKind]) -> Result<(), Diagnostics> {
    if is_standard(path) { Ok(()) } else { FileKind::expect(path, wanted) }
}

/// Refuses a `folder` that holds no run, and tells of a run whose process is gone.
pub(crate) fn expect_run(folder: &Path) -> Result<(), Diagnostics> {
    expect(folder, &[FileKind::Run])?;
    tell_lost_process(folder);
    Ok(())
}

/// Tells if the process that ran the scene in `folder` is gone although the run has not ended.
pub(crate) fn tell_lost_process(folder: &Path) {
    if let Some(LostProcess { number }) = lost_process(folder) {
        let process = number.map_or(String::new(), |number| format!(" {number}"));
        note(format_args!(
            "the process{process} that ran the scene in {place} is gone, and the run has not ended; go on with \
             `drape resume {place}`",
            place = folder.display()
        ));
    }
}

/// Reads the file at `path`, or standard input, and applies the settings of [`set_values`]. Refuses
/// a kind of file that is not in `wanted`.
pub(crate) fn document_of_kind(path: &Path, wanted: &[FileKind]) -> Result<Document, Diagnostics> {
    expect(path, wanted)?;
    let document = document(path)?;
    FileKind::expect_document(&document, wanted)?;
    Ok(document)
}

/// Reads the file at `path`, or standard input, and applies the settings of [`set_values`].
pub(crate) fn document(path: &Path) -> Result<Document, Diagnostics> {
    let settings = SETTINGS.get().map_or(&[][..], Vec::as_slice);
    if !is_standard(path) {
        return Document::read_with(path, access())?.with_settings(settings);
    }
    match TEXT.get_or_init(read) {
        Ok(text) => Document::new(NAME, text).with_access(access()).with_settings(settings),
        Err(message) => {
            let help = "pipe a file in UTF-8 into it, or name the file in place of -";
            Err(Diagnostic::new(NAME, message).help(help).into())
        }
    }
}

/// Reads standard input to its end, at most [`LIMIT`].
fn read() -> Result<String, String> {
    let mut bytes = Vec::new();
    let limit = LIMIT.bytes(access());
    let result = std::io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes);
    result.map_err(|error| format!("cannot be read: {error}"))?;
    if bytes.len() as u64 > limit {
        return Err(format!("has more than {limit} bytes, which --raise-limits changes"));
    }
    String::from_utf8(bytes).map_err(|_| "is not UTF-8".into())
}

/// Returns the text of the file that a message names as `path`, if it can be read.
pub(crate) fn source(path: &Path) -> Option<Cow<'static, str>> {
    if path.as_os_str() == NAME {
        let text = TEXT.get().and_then(|text| text.as_ref().ok());
        return text.map(|text| Cow::Borrowed(text.as_str()));
    }
    let is_file = std::fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
    is_file.then(|| std::fs::read_to_string(path).ok()).flatten().map(Cow::Owned)
}

/// Parses `text` as the document at `path` and applies the settings of [`set_values`].
pub(crate) fn with_settings(path: &Path, text: &str) -> Result<Document, Diagnostics> {
    let settings = SETTINGS.get().map_or(&[][..], Vec::as_slice);
    Document::new(path, text).with_access(access()).with_settings(settings)
}

/// Returns the name of the file at `path` in messages.
pub(crate) fn message_path(path: &Path) -> &Path {
    if is_standard(path) { Path::new(NAME) } else { path }
}

/// Returns the path from which the results of the file at `path` take their names.
pub(crate) fn path_for_results(path: &Path) -> &Path {
    if is_standard(path) { Path::new("standard-input") } else { path }
}
