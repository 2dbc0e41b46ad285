//! Reading of patterns from files.
//!
//! [`Pattern::read`] recognises the format by the ending of the path and by the content: the
//! project's TOML (`toml_file`), JSON of GarmentCode and its predecessor (`garmentcode`), JSON of
//! FreeSewing (`freesewing`), drawings in SVG (`svg`), and DXF of pattern makers' programs (`dxf`,
//! ASTM D6673). `svg_path` reads the path data of SVG, which is also a key of the TOML. Each reader
//! converts lengths to m and angles to rad, makes [`Panel`](crate::Panel)s and seams, and collects
//! all mistakes with their places and remedies. A [`Request`] holds facts that a file may not
//! state, such as the unit of a drawing. `panel` and `pattern` check outlines and seams. The
//! chapter hands on a checked [`Pattern`] to `cut`.

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

use drape_input::{Diagnostic, Diagnostics, Document, FileAccess, SizeLimit};
use serde_json::Value;

use crate::error::Error;
use crate::pattern::Pattern;
use crate::sketch::Sketch;
use diagnostic::{foreign_file, syntax};

pub use request::Request;
pub use seams::{PatternTable, SeamKeys};
#[cfg(feature = "schema")]
pub use toml_file::keys::pattern_schema;
pub use unit::Unit;

/// Size limit of pattern files: drafts with all their drawings have some hundred kilobytes.
const LIMIT: SizeLimit = SizeLimit::new("patterns", 1 << 24);

/// Endings of the files that hold patterns.
const ENDINGS: [&str; 4] = ["toml", "json", "svg", "dxf"];

impl Pattern {
    /// Reads the pattern file `path`: the project's TOML, JSON of GarmentCode or FreeSewing, or a
    /// drawing in SVG or DXF.
    ///
    /// # Errors
    /// All mistakes of the file, each with its place and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::read_as(&Request::new(path.as_ref()))
    }

    /// Reads the pattern file of `request`, with the unit and the size that `request` states.
    ///
    /// # Errors
    /// All mistakes of the file, each with its place and a remedy.
    pub fn read_as(request: &Request) -> Result<Self, Error> {
        if let Some(diagnostic) = Self::foreign(&request.path) {
            return Err(Diagnostics::from(diagnostic).into());
        }
        let document = match ending(&request.path).as_str() {
            "json" | "svg" | "dxf" => document(&request.path, &request.access)?,
            _ => Document::read_with(&request.path, &request.access)?,
        };
        Ok(parse(&document, request)?)
    }

    /// Returns the pattern of `document` in any of the formats. The ending of its path, which need
    /// not exist, says which: `.toml`, `.json`, `.svg` or `.dxf`. The content decides between the
    /// two formats in JSON, and for a path without an ending.
    ///
    /// # Errors
    /// All mistakes of the text, each with its place and a remedy.
    pub fn parse(document: &Document) -> Result<Self, Diagnostics> {
        parse(document, &Request::new(document.path()))
    }

    /// Returns the pattern of `document`, with the unit and the size that `request` states. The
    /// path of `request` is not read.
    ///
    /// # Errors
    /// All mistakes of the text, each with its place and a remedy.
    pub fn parse_as(document: &Document, request: &Request) -> Result<Self, Diagnostics> {
        parse(document, request)
    }

    /// Returns whether `path` has the ending of a file that holds nothing but patterns.
    #[must_use]
    pub fn is_drawing(path: &Path) -> bool {
        matches!(ending(path).as_str(), "json" | "svg" | "dxf")
    }

    /// Returns a diagnostic if only the program of a pattern maker reads the file `path`. It says
    /// how to export DXF or SVG from that program. Returns `None` for other files.
    #[must_use]
    pub fn foreign(path: &Path) -> Option<Diagnostic> {
        foreign_file(path)
    }

    /// Returns whether `document` is in a format that holds nothing but patterns.
    #[must_use]
    pub fn is_drawing_text(document: &Document) -> bool {
        format(document) != "toml"
    }
}

impl Sketch {
    /// Returns the lines of the pattern in `document`, in spite of its mistakes.
    #[must_use]
    pub fn parse(document: &Document) -> Self {
        let mut sketch = Self::default();
        // Whoever reads the pattern reports the mistakes.
        let _ = parse_into(document, &Request::new(document.path()), &mut sketch);
        sketch
    }

    /// Returns the lines of the pattern in the file of `request`, in spite of its mistakes. The
    /// sketch is empty if the file cannot be read.
    #[must_use]
    pub fn read(request: &Request) -> Self {
        document(&request.path, &request.access)
            .map(|document| Self::parse(&document))
            .unwrap_or_default()
    }
}

/// Returns the pattern of `document`.
fn parse(document: &Document, request: &Request) -> Result<Pattern, Diagnostics> {
    parse_into(document, request, &mut Sketch::default())
}

/// Returns the pattern of `document`, and adds its lines to `sketch`, also where they are wrong.
fn parse_into(
    document: &Document,
    request: &Request,
    sketch: &mut Sketch,
) -> Result<Pattern, Diagnostics> {
    let format = format(document);
    check_format(document, request, &format)?;
    match format.as_str() {
        "toml" => parse_toml(document, sketch),
        "svg" => svg::read(document, request, sketch),
        "dxf" => dxf::read(document, request, sketch),
        _ => parse_json(document, sketch),
    }
}

/// Returns the mistake of a `document` whose `format` is unknown or does not go with `request`.
fn check_format(document: &Document, request: &Request, format: &str) -> Result<(), Diagnostics> {
    if let Some(diagnostic) = foreign_file(document.path()) {
        return Err(diagnostic.into());
    }
    if !ENDINGS.contains(&format) {
        let help = "patterns are *.toml, *.json of GarmentCode or FreeSewing, *.svg and *.dxf";
        let message = format!("files *.{format} hold no pattern");
        return Err(Diagnostic::new(document.path(), message).help(help).into());
    }

    // A unit or size that would have no effect is a mistake, not a silent choice.
    let refused = if request.unit.is_some() && matches!(format, "toml" | "json") {
        Some((
            "unit",
            "the unit is asked for, and the format states it itself",
            "leave the unit out; it is for *.svg and *.dxf",
        ))
    } else if request.size.is_some() && format != "dxf" {
        Some((
            "size",
            "a size is asked for, and the format has none",
            "leave the size out; it is for graded *.dxf",
        ))
    } else {
        None
    };
    match refused {
        Some((key, message, help)) => {
            let edit = request.edit_out(key);
            Err(Diagnostic::new(document.path(), message).help(help).with_edits(edit).into())
        }
        None => Ok(()),
    }
}

/// Returns the pattern of `document` in the project's format, which may add to another file.
fn parse_toml(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let file = toml_file::decode(document)?;
    let base = match file.base_request() {
        Ok(Some(from)) => self::document(&from.path, &from.access)
            .and_then(|base| parse_into(&base, &from, sketch)),
        Ok(None) => return file.pattern(None, sketch),
        Err(mistakes) => Err(mistakes),
    };
    match base {
        Ok(base) => file.pattern(Some(base), sketch),
        Err(mistakes) => Err(file.without_base(mistakes)),
    }
}

/// Returns the pattern of `document` in JSON.
fn parse_json(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let value: Value = serde_json::from_str(document.text())
        .map_err(|error| syntax(document, &error).help("correct the JSON"))?;
    if value.get("pattern").is_some() {
        garmentcode::read(document, sketch)
    } else if value.get("parts").is_some() || value.get("stacks").is_some() {
        freesewing::read(document, sketch)
    } else {
        let help = "GarmentCode's specifications have \"pattern\", FreeSewing's drafts \"parts\" or \
                    \"stacks\"";
        let message = "this JSON holds no pattern";
        Err(Diagnostic::new(document.path(), message).help(help).into())
    }
}

/// Returns the format of `document`, by the ending of its path. A path without an ending leaves the
/// format to the text.
fn format(document: &Document) -> String {
    let ending = ending(document.path());
    if !ending.is_empty() {
        return ending;
    }
    let text = document.text().trim_start();
    let format = match text.as_bytes().first() {
        Some(b'{') => "json",
        Some(b'<') => "svg",
        // Group codes 0 and 999 begin a drawing and a comment.
        _ if matches!(text.lines().next().map(str::trim), Some("0" | "999")) => "dxf",
        _ => "toml",
    };
    format.into()
}

/// Returns the ending of `path`, in small letters.
fn ending(path: &Path) -> String {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.unwrap_or_default().to_ascii_lowercase()
}

/// Returns the document of the file `path`. Programs write patterns, so that the file may be larger
/// than a file that a person writes.
fn document(path: &Path, access: &FileAccess) -> Result<Document, Diagnostics> {
    let bytes = LIMIT.read(path, access)?;
    match String::from_utf8(bytes.into_owned()) {
        Ok(text) => Ok(Document::new(path, text).with_access(access)),
        // Older programs write DXF in the code page of their country; only names can have such
        // letters.
        Err(error) if ending(path) == "dxf" => {
            let text: String = error.into_bytes().into_iter().map(char::from).collect();
            Ok(Document::new(path, text).with_access(access))
        }
        Err(_) => {
            let message = "the file is not UTF-8";
            Err(Diagnostic::new(path, message).help("save it as UTF-8").into())
        }
    }
}
