use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document};
use serde_json::Value;

use crate::mistake::{Error, Mistake};
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Sizes that a panel of a garment has, in m. Others are slips of the unit.
const SIZES: std::ops::RangeInclusive<f64> = 0.02..=3.0;

/// Largest JSON file that is read, in bytes: drafts with all their drawings have some hundred kilobytes.
const LARGEST: u64 = 1 << 24;

impl Pattern {
    /// Reads a pattern: the project's own in TOML, GarmentCode's or FreeSewing's in JSON.
    ///
    /// # Errors
    /// All mistakes of the file, each with its place and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let document = match json(path) {
            Some(text) => Document::new(path, text),
            None => Document::read(path)?,
        };
        Ok(Self::parse(&document)?)
    }

    /// The pattern of a document in any of the formats, told apart by the ending of its path and by what the
    /// text holds.
    ///
    /// # Errors
    /// All mistakes of the text, each with its place and a remedy.
    pub fn parse(document: &Document) -> Result<Self, Diagnostics> {
        let ending = document.path().extension().and_then(|e| e.to_str()).unwrap_or_default();
        if ending.eq_ignore_ascii_case("toml") {
            return crate::file::read(document);
        }
        if !is_json(document.path()) {
            let help = "patterns are *.toml, or *.json of GarmentCode or FreeSewing";
            let message = format!("files *.{ending} hold no pattern");
            return Err(Diagnostic::new(document.path(), message).help(help).into());
        }
        let value: Value = serde_json::from_str(document.text())
            .map_err(|error| syntax(document, &error).help("correct the JSON"))?;
        match (value.get("pattern"), value.get("parts")) {
            (Some(_), _) => crate::garmentcode::read(document),
            (None, Some(_)) => crate::freesewing::read(document),
            (None, None) => {
                let help =
                    "GarmentCode's specifications have \"pattern\", FreeSewing's drafts \"parts\"";
                let message = "this JSON holds no pattern";
                Err(Diagnostic::new(document.path(), message).help(help).into())
            }
        }
    }
}

/// Whether a path ends like that of a JSON file.
fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"))
}

/// The text of a JSON file, which may be larger than those that people write; nothing if it cannot be read.
fn json(path: &Path) -> Option<String> {
    let small = std::fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() <= LARGEST);
    (is_json(path) && small).then(|| std::fs::read_to_string(path).ok()).flatten()
}

/// A mistake of grammar or type in JSON.
pub(crate) fn syntax(document: &Document, error: &serde_json::Error) -> Diagnostic {
    let text = error.to_string();
    let message = text.split(" at line ").next().unwrap_or(&text);
    let mut diagnostic = Diagnostic::new(document.path(), message).on_line(error.line());
    diagnostic.column = Some(error.column());
    diagnostic
}

/// A mistake of a pattern in a file.
pub(crate) fn diagnostic(document: &Document, mistake: &Mistake) -> Diagnostic {
    Diagnostic::new(document.path(), mistake.to_string()).help(mistake.help())
}

/// Whether the size of a panel can only come of a wrong unit.
pub(crate) fn unit_slip(panel: &Panel) -> Option<Mistake> {
    let size = panel.size();
    (!SIZES.contains(&size)).then(|| Mistake::Size { panel: panel.name().into(), size })
}
