//! Reading of patterns from files.
//!
//! [`Pattern::read`] tells the format by the ending of the path and by the content: the project's
//! own TOML (`toml_file`), JSON of GarmentCode and its predecessor (`garmentcode`), JSON of
//! FreeSewing (`freesewing`), drawings in SVG (`svg`), and DXF of pattern makers' programs (`dxf`,
//! ASTM D6673); `svg_path` reads the path data of SVG, which is also a key of the TOML. Each reader
//! converts lengths to m and angles to rad, makes [`Panel`](crate::Panel)s and seams of the file,
//! and collects all mistakes with their places and remedies. What a file may not say itself, such
//! as the unit of a drawing, is in a [`Request`]. Checks of outlines and seams are in `panel` and
//! `pattern`; the chapter hands on a checked [`Pattern`] to `cut`.

mod chains;
mod diagnostic;
mod dxf;
mod fit;
mod freesewing;
mod garmentcode;
mod marks;
mod request;
mod seams;
mod size;
mod svg;
mod svg_path;
mod toml_file;
mod unit;

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document, SizeLimit};
use serde_json::Value;

use crate::error::Error;
use crate::pattern::Pattern;
use crate::sketch::Sketch;
use diagnostic::{foreign, syntax};

pub use request::Request;
pub use seams::{PatternTable, SeamKeys};
#[cfg(feature = "schema")]
pub use toml_file::keys::pattern_schema;
pub use unit::Unit;

/// Limit of pattern files: drafts with all their drawings have some hundred kilobytes.
const LIMIT: SizeLimit = SizeLimit::new("patterns", 1 << 24);

/// Endings of the files that hold patterns.
const ENDINGS: [&str; 4] = ["toml", "json", "svg", "dxf"];

impl Pattern {
    /// Reads a pattern: the project's own format in TOML, GarmentCode's or FreeSewing's in JSON, a
    /// drawing in SVG or DXF.
    ///
    /// # Errors
    /// All mistakes of the file, each with its place and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::read_as(&Request::new(path.as_ref()))
    }

    /// Reads a pattern with what its file may not say itself.
    ///
    /// # Errors
    /// All mistakes of the file, each with its place and a remedy.
    pub fn read_as(request: &Request) -> Result<Self, Error> {
        if let Some(answer) = Self::foreign(&request.path) {
            return Err(Diagnostics::from(answer).into());
        }
        let document = match ending(&request.path).as_str() {
            "json" | "svg" | "dxf" => document(&request.path)?,
            _ => Document::read(&request.path)?,
        };
        Ok(parse(&document, request)?)
    }

    /// Returns the pattern of a document in any of the formats, told apart by the ending of its
    /// path and by its content.
    ///
    /// # Errors
    /// All mistakes of the text, each with its place and a remedy.
    pub fn parse(document: &Document) -> Result<Self, Diagnostics> {
        parse(document, &Request::new(document.path()))
    }

    /// Returns the pattern of a document with what it may not say itself; the path of the request is
    /// not read.
    ///
    /// # Errors
    /// All mistakes of the text, each with its place and a remedy.
    pub fn parse_as(document: &Document, request: &Request) -> Result<Self, Diagnostics> {
        parse(document, request)
    }

    /// Returns whether a path has the ending of a file that holds nothing but patterns.
    #[must_use]
    pub fn is_drawing(path: &Path) -> bool {
        matches!(ending(path).as_str(), "json" | "svg" | "dxf")
    }

    /// Returns the answer to a path of a file that only the program of a pattern maker reads, with how
    /// to get DXF or SVG from that program; `None` for other files.
    #[must_use]
    pub fn foreign(path: &Path) -> Option<Diagnostic> {
        foreign(path)
    }

    /// Returns whether a document is in a format that holds nothing but patterns.
    #[must_use]
    pub fn is_drawing_text(document: &Document) -> bool {
        format(document) != "toml"
    }
}

impl Sketch {
    /// Returns the lines of a document that holds a pattern, in spite of its mistakes.
    #[must_use]
    pub fn parse(document: &Document) -> Self {
        let mut sketch = Self::default();
        // The mistakes are told by those who read the pattern.
        let _ = parse_into(document, &Request::new(document.path()), &mut sketch);
        sketch
    }

    /// Returns the lines of a file that holds a pattern, in spite of its mistakes.
    #[must_use]
    pub fn read(path: &Path) -> Self {
        document(path).map(|document| Self::parse(&document)).unwrap_or_default()
    }
}

/// Returns the pattern of a document.
fn parse(document: &Document, request: &Request) -> Result<Pattern, Diagnostics> {
    parse_into(document, request, &mut Sketch::default())
}

/// Returns the pattern of a document, and adds its lines to a sketch, also where they are wrong.
fn parse_into(
    document: &Document,
    request: &Request,
    sketch: &mut Sketch,
) -> Result<Pattern, Diagnostics> {
    let ending = format(document);
    if let Some(answer) = foreign(document.path()) {
        return Err(answer.into());
    }
    if !ENDINGS.contains(&ending.as_str()) {
        let help = "patterns are *.toml, *.json of GarmentCode or FreeSewing, *.svg and *.dxf";
        let message = format!("files *.{ending} hold no pattern");
        return Err(Diagnostic::new(document.path(), message).help(help).into());
    }
    if request.unit.is_some() && matches!(ending.as_str(), "toml" | "json") {
        let message = "the unit is asked for, and the format states it itself";
        let help = "leave the unit out; it is for *.svg and *.dxf";
        let edit = request.edit_out("unit");
        return Err(Diagnostic::new(document.path(), message).help(help).with_edits(edit).into());
    }
    if request.size.is_some() && ending != "dxf" {
        let message = "a size is asked for, and the format has none";
        let help = "leave the size out; it is for graded *.dxf";
        let edit = request.edit_out("size");
        return Err(Diagnostic::new(document.path(), message).help(help).with_edits(edit).into());
    }
    match ending.as_str() {
        "toml" => {
            let file = toml_file::decode(document)?;
            let base = match file.from() {
                Ok(Some(from)) => {
                    let base = self::document(&from.path);
                    base.and_then(|base| parse_into(&base, &from, sketch))
                }
                Ok(None) => return file.pattern(None, sketch),
                Err(mistakes) => Err(mistakes),
            };
            match base {
                Ok(base) => file.pattern(Some(base), sketch),
                Err(mistakes) => Err(file.without_base(mistakes)),
            }
        }
        "svg" => svg::read(document, request, sketch),
        "dxf" => dxf::read(document, request, sketch),
        _ => json(document, sketch),
    }
}

/// Returns the pattern of a document in JSON.
fn json(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let value: Value = serde_json::from_str(document.text())
        .map_err(|error| syntax(document, &error).help("correct the JSON"))?;
    let has = |key: &str| value.get(key).is_some();
    if has("pattern") {
        garmentcode::read(document, sketch)
    } else if has("parts") || has("stacks") {
        freesewing::read(document, sketch)
    } else {
        let help = "GarmentCode's specifications have \"pattern\", FreeSewing's drafts \"parts\" or \
                    \"stacks\"";
        let message = "this JSON holds no pattern";
        Err(Diagnostic::new(document.path(), message).help(help).into())
    }
}

/// Returns the format of a document, by the ending of its path, or if that has none by its text.
fn format(document: &Document) -> String {
    let ending = ending(document.path());
    if !ending.is_empty() {
        return ending;
    }
    let text = document.text().trim_start();
    let kind = match text.as_bytes().first() {
        Some(b'{') => "json",
        Some(b'<') => "svg",
        // Group codes 0 and 999 begin a drawing and a comment.
        _ if matches!(text.lines().next().map(str::trim), Some("0" | "999")) => "dxf",
        _ => "toml",
    };
    kind.into()
}

/// Returns the ending of a path, in small letters.
fn ending(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Returns the document of a file that programs write, which may be larger than files that people
/// write.
fn document(path: &Path) -> Result<Document, Diagnostics> {
    let size = std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file).map(|m| m.len());
    let Some(size) = size else {
        // The reader of other files says what is missing.
        return Document::read(path);
    };
    if let Err(refused) = LIMIT.check(size) {
        return Err(Diagnostic::new(path, refused.to_string()).help(refused.help()).into());
    }
    let bytes = std::fs::read(path).map_err(|error| {
        Diagnostic::new(path, format!("cannot read the file: {error}")).help("make it readable")
    })?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Document::new(path, text)),
        // Older programs write DXF in the code page of their country; only names can have such
        // letters.
        Err(error) if ending(path) == "dxf" => {
            let text: String = error.into_bytes().into_iter().map(char::from).collect();
            Ok(Document::new(path, text))
        }
        Err(_) => {
            let message = "the file is not UTF-8";
            Err(Diagnostic::new(path, message).help("save it as UTF-8").into())
        }
    }
}
