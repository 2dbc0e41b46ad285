//! Text of a TOML file: decoded into a structure, or searched for the place of a key.
//!
//! Every crate that reads TOML goes through [`Document`], so all mistakes look alike.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::spelling::closest;

/// Largest TOML file that is read, in bytes.
///
/// Sheets, fabrics and scenes have a few kilobytes; the limit keeps a wrong path from filling the
/// memory.
const LARGEST: u64 = 1 << 20;

/// Text of a TOML file with its path.
///
/// ```
/// use drape_input::Document;
///
/// let document = Document::new("scene.toml", "[time]\nstep = 0.0\n");
/// let mistake = document.at("time.step", "0 s is not a positive time").help("write 0.005");
/// assert_eq!((mistake.line, mistake.column), (Some(2), Some(8)));
/// ```
#[derive(Debug, Clone)]
pub struct Document {
    path: PathBuf,
    text: String,
}

impl Document {
    /// Creates a document from text in memory; `path` is used in messages only.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        let text: String = text.into();
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        Self { path: path.into(), text }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// The file is missing, larger than a mebibyte, or not UTF-8.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        let fail = |message: String| Diagnostic::new(path, message);
        let metadata = std::fs::metadata(path)
            .map_err(|e| fail(format!("cannot open the file: {e}")).help(suggestion(path)))?;
        if !metadata.is_file() {
            return Err(fail("this is not a file".into()).help("name a TOML file").into());
        }
        if metadata.len() > LARGEST {
            return Err(fail(format!(
                "the file has {} bytes, more than {LARGEST}",
                metadata.len()
            ))
            .help("a TOML input has a few kilobytes: is this the right file?")
            .into());
        }
        let text = std::fs::read_to_string(path)
            .map_err(|e| fail(format!("cannot read the file: {e}")).help("save it as UTF-8"))?;
        Ok(Self::new(path, text))
    }

    /// Returns the path, as given.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the text, without a byte-order mark.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Decodes the text into a structure.
    ///
    /// # Errors
    /// The first mistake of grammar, spelling or type, with its place.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, Diagnostics> {
        toml::from_str(&self.text).map_err(|error| {
            let message = error.message();
            let headline = message.split(", expected").next().unwrap_or(message);
            let mut diagnostic = self.locate(error.span(), headline);
            let words: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
            if message.starts_with("unknown field") {
                let known = words.iter().skip(1).copied();
                diagnostic = match closest(words.first().unwrap_or(&""), known) {
                    Some(word) => diagnostic.help(format!("did you mean `{word}`?")),
                    None if words.len() > 1 => {
                        diagnostic.help(format!("known here: {}", words[1..].join(", ")))
                    }
                    None => diagnostic.help("remove it"),
                };
            } else if message.starts_with("missing field") {
                diagnostic = diagnostic.help("add it");
            } else if message != headline {
                let expected = message[headline.len()..].trim_start_matches(", ");
                diagnostic = diagnostic.help(expected.to_owned());
            }
            diagnostic.into()
        })
    }

    /// Returns a mistake in the value at a key path such as `warp.traction.stiffness` or
    /// `curve[2].file`.
    ///
    /// A key with dots in it is quoted, as in TOML: `panel."simon.back".grain`. If the value is not in
    /// the text, the innermost table that is gives the place.
    #[must_use]
    pub fn at(&self, key: &str, message: impl Into<String>) -> Diagnostic {
        let message = format!("{key}: {}", message.into());
        self.locate(self.find(key), message)
    }

    /// Returns a mistake with the place of a span.
    fn locate(&self, span: Option<Range<usize>>, message: impl Into<String>) -> Diagnostic {
        let mut diagnostic = Diagnostic::new(&self.path, message);
        if let Some(span) = span {
            let before = self.text.get(..span.start).unwrap_or(&self.text);
            diagnostic.line = Some(before.matches('\n').count() + 1);
            let start_of_line = before.rfind('\n').map_or(0, |end| end + 1);
            diagnostic.column = Some(before[start_of_line..].chars().count() + 1);
            diagnostic.span = Some(span);
        }
        diagnostic
    }

    /// Returns the span of the value at a key path.
    fn find(&self, key: &str) -> Option<Range<usize>> {
        let table = DeTable::parse(&self.text).ok()?;
        let mut place = None;
        let mut value: Option<&Spanned<DeValue<'_>>> = None;
        for Part { name, index } in parts(key) {
            let table = match value {
                None => table.get_ref(),
                Some(value) => value.get_ref().as_table()?,
            };
            let Some((found_key, found)) = table.iter().find(|(k, _)| k.get_ref() == name) else {
                return place;
            };
            value = Some(found);
            // A table is shown by its name, any other value by itself.
            place = Some(if found.get_ref().is_table() { found_key.span() } else { found.span() });
            if let Some(index) = index {
                let Some(element) = found.get_ref().as_array().and_then(|a| a.get(index)) else {
                    return place;
                };
                value = Some(element);
                place = Some(element.span());
            }
        }
        place
    }
}

/// Key of a key path, with the index of an element if it is an array.
struct Part<'a> {
    name: &'a str,
    index: Option<usize>,
}

/// Splits a key path at its dots outside of quotes.
fn parts(key: &str) -> impl Iterator<Item = Part<'_>> {
    let mut quoted = false;
    let pieces = key.split(move |letter: char| {
        quoted ^= letter == '"';
        letter == '.' && !quoted
    });
    pieces.map(|piece| match piece.strip_prefix('"').and_then(|rest| rest.split_once('"')) {
        Some((name, rest)) => Part { name, index: index(rest) },
        None => match piece.split_once('[') {
            Some((name, rest)) => Part { name, index: index(rest) },
            None => Part { name: piece, index: None },
        },
    })
}

/// Returns the number in brackets.
fn index(text: &str) -> Option<usize> {
    text.trim_matches(['[', ']']).parse().ok()
}

/// Suggests the file that was meant by a path that does not exist.
fn suggestion(path: &Path) -> String {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(entries) = std::fs::read_dir(folder) else {
        return format!("there is no folder {}", folder.display());
    };
    let mut names: Vec<String> =
        entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    let wanted = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    match closest(&wanted, names.iter().map(String::as_str)) {
        Some(name) => format!("did you mean {}?", folder.join(name).display()),
        None => format!("looked in {}", folder.display()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Outer {
        dt: f64,
        #[serde(default)]
        curve: Vec<Inner>,
    }

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Inner {
        file: String,
    }

    fn mistake(text: &str) -> Diagnostic {
        Document::new("a.toml", text).decode::<Outer>().expect_err("the text is wrong").0.remove(0)
    }

    #[test]
    fn grammar_spelling_and_type_are_located() {
        let wrong_type = mistake("# a comment\ndt = \"fast\"");
        assert_eq!((wrong_type.line, wrong_type.column), (Some(2), Some(6)), "{wrong_type}");
        let unknown = mistake("dt = 1\n[[curve]]\nfile = \"x\"\nfil = 2");
        assert_eq!(unknown.line, Some(4), "{unknown}");
        assert_eq!(unknown.help.as_deref(), Some("did you mean `file`?"));
        let grammar = mistake("dt = 1\nx = = 2");
        assert_eq!(grammar.line, Some(2), "{grammar}");
        let missing = mistake("dt = 1\n[[curve]]\n");
        assert!(missing.message.contains("missing field `file`"), "{missing}");
        assert_eq!(missing.line, Some(2), "{missing}");
    }

    #[test]
    fn a_key_path_finds_its_line_also_in_arrays_and_for_absent_keys() {
        let text = "dt = 1\n[[curve]]\nfile = \"x\"\n[[curve]]\nfile = \"y\"\n[a.b]\nc = { d = 3 }";
        let document = Document::new("a.toml", text);
        let line = |key: &str| document.at(key, "").line;
        assert_eq!(line("dt"), Some(1));
        assert_eq!(line("curve[1].file"), Some(5));
        assert_eq!(line("curve[1].unit"), Some(4));
        assert_eq!(line("a.b.c.d"), Some(7));
        assert_eq!(line("a.b.e"), Some(6));
        assert_eq!(line("nothing"), None);
    }

    #[test]
    fn a_key_with_dots_is_found_in_quotes() {
        let text = "[panel.\"simon.back\"]\ngrain = 3\nfold = [\n1,\n2]";
        let document = Document::new("a.toml", text);
        let line = |key: &str| document.at(key, "").line;
        assert_eq!(line("panel.\"simon.back\".grain"), Some(2));
        assert_eq!(line("panel.\"simon.back\".fold[1]"), Some(5));
        assert_eq!(line("panel.\"simon.back\""), Some(1));
    }

    #[test]
    fn a_missing_file_names_its_neighbour() {
        let mistakes = Document::read("Cargo.tml").expect_err("there is no such file");
        let help = mistakes.0[0].help.clone().expect("a remedy");
        assert!(help.contains("Cargo.toml"), "{help}");
    }
}
