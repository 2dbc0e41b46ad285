//! Reading of patterns from files.
//!
//! [`Pattern::read`] tells the format by the ending of the path and by the content: the project's
//! own TOML (`toml_file`), JSON of GarmentCode and its predecessor (`garmentcode`), JSON of
//! FreeSewing (`freesewing`); `svg_path` reads the path data of SVG, which is also a key of the
//! TOML. Each reader mirrors its file with serde, converts lengths to m and angles to rad, makes
//! [`Panel`](crate::Panel)s and seams of it, and collects all mistakes with their places and
//! remedies. Checks of outlines and seams are in `panel` and `pattern`; the chapter hands on a
//! checked [`Pattern`] to `cut`.

mod diagnostic;
mod freesewing;
mod garmentcode;
mod svg_path;
mod toml_file;

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document};
use serde_json::Value;

use crate::error::Error;
use crate::pattern::Pattern;
use diagnostic::syntax;

/// Largest JSON file that is read, in bytes; drafts with all their drawings have some hundred
/// kilobytes.
const LARGEST: u64 = 1 << 24;

impl Pattern {
    /// Reads a pattern: the project's own format in TOML, GarmentCode's or FreeSewing's in JSON.
    ///
    /// # Errors
    /// All mistakes of the file, each with its place and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let document = match read_json(path) {
            Some(text) => Document::new(path, text),
            None => Document::read(path)?,
        };
        Ok(Self::parse(&document)?)
    }

    /// Returns the pattern of a document in any of the formats, told apart by the ending of its
    /// path and by its content.
    ///
    /// # Errors
    /// All mistakes of the text, each with its place and a remedy.
    pub fn parse(document: &Document) -> Result<Self, Diagnostics> {
        let ending = document.path().extension().and_then(|e| e.to_str()).unwrap_or_default();
        if ending.eq_ignore_ascii_case("toml") {
            return toml_file::read(document);
        }
        if !is_json(document.path()) {
            let help = "patterns are *.toml, or *.json of GarmentCode or FreeSewing";
            let message = format!("files *.{ending} hold no pattern");
            return Err(Diagnostic::new(document.path(), message).help(help).into());
        }
        let value: Value = serde_json::from_str(document.text())
            .map_err(|error| syntax(document, &error).help("correct the JSON"))?;
        match (value.get("pattern"), value.get("parts")) {
            (Some(_), _) => garmentcode::read(document),
            (None, Some(_)) => freesewing::read(document),
            (None, None) => {
                let help =
                    "GarmentCode's specifications have \"pattern\", FreeSewing's drafts \"parts\"";
                let message = "this JSON holds no pattern";
                Err(Diagnostic::new(document.path(), message).help(help).into())
            }
        }
    }
}

/// Returns whether a path has the ending of a JSON file.
fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"))
}

/// Returns the text of a JSON file, which may be larger than files that people write; `None` if it
/// cannot be read.
fn read_json(path: &Path) -> Option<String> {
    let small = std::fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() <= LARGEST);
    (is_json(path) && small).then(|| std::fs::read_to_string(path).ok()).flatten()
}
