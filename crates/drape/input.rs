//! Files that commands read, with `-` for standard input.
//!
//! Standard input is read once; messages name it `<standard input>`, and relative paths in it are
//! seen from the current folder.

use std::borrow::Cow;
use std::io::Read;
use std::path::Path;
use std::sync::OnceLock;

use drape::input::{Diagnostic, Diagnostics, Document};

/// Name of standard input in messages.
const NAME: &str = "<standard input>";

/// Most bytes of standard input that are read; drafts of patterns have some hundred kilobytes.
const LARGEST: u64 = 1 << 24;

/// Text of standard input, or why there is none.
static TEXT: OnceLock<Result<String, String>> = OnceLock::new();

/// Returns whether a path stands for standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads a file, or standard input.
pub(crate) fn document(path: &Path) -> Result<Document, Diagnostics> {
    if !is_standard(path) {
        return Document::read(path);
    }
    match TEXT.get_or_init(read) {
        Ok(text) => Ok(Document::new(NAME, text)),
        Err(message) => {
            let help = "pipe a file in UTF-8 into it, or name the file in place of -";
            Err(Diagnostic::new(NAME, message).help(help).into())
        }
    }
}

fn read() -> Result<String, String> {
    let mut bytes = Vec::new();
    let read = std::io::stdin().lock().take(LARGEST + 1).read_to_end(&mut bytes);
    read.map_err(|error| format!("cannot be read: {error}"))?;
    if bytes.len() as u64 > LARGEST {
        return Err(format!("has more than {LARGEST} bytes"));
    }
    String::from_utf8(bytes).map_err(|_| "is not UTF-8".into())
}

/// Returns the text of a file that a message names, if it can be read.
pub(crate) fn source(path: &Path) -> Option<Cow<'static, str>> {
    if path.as_os_str() == NAME {
        let text = TEXT.get().and_then(|text| text.as_ref().ok());
        return text.map(|text| Cow::Borrowed(text.as_str()));
    }
    std::fs::read_to_string(path).ok().map(Cow::Owned)
}

/// Returns the path by which messages name a file.
pub(crate) fn shown(path: &Path) -> &Path {
    if is_standard(path) { Path::new(NAME) } else { path }
}

/// Returns the path by which results of a file are named.
pub(crate) fn named(path: &Path) -> &Path {
    if is_standard(path) { Path::new("standard-input") } else { path }
}
