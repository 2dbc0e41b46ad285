//! Document: the text of a TOML file, which is decoded into a structure or searched for a key.
//!
//! Every crate that reads TOML uses [`Document`], so that all mistakes are reported in one form.

pub(crate) mod alias;
mod editing;
mod lookup;

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde::de::DeserializeOwned;
use toml::de::DeTable;

use crate::decode::{Change, Decoded, Fault, Faults, decode};
use crate::diagnostic::subject::Subject;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::figure::cut;
use crate::file_access::FileAccess;
use crate::file_access::allowed_folders::{AllowedFolders, ForbiddenPath};
use crate::file_access::size_limit::SizeLimit;
use crate::grammar::{GrammarMistake, grammar_mistakes};
use crate::node::Node;
use crate::node::key_path::KeyPath;
use crate::setting::{Setting, SettingError};

/// Limit on the size of TOML files. Sheets, fabrics and scenes have a few kilobytes.
const LIMIT: SizeLimit = SizeLimit::new("TOML files", 1 << 20);

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
    /// Files that the document may name, and how large they may be.
    access: FileAccess,
    /// Values that replace values of the text.
    settings: Vec<Setting>,
    /// Values of the text with the settings, once the text has been parsed.
    content: OnceLock<Content>,
    /// Lines of the text, once a place has been looked up.
    lines: OnceLock<Lines>,
}

impl Document {
    /// Creates a document from `text` in memory. `path` is used in messages, and to find files that
    /// the document names.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        let text: String = text.into();
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        let (content, lines) = (OnceLock::new(), OnceLock::new());
        let (access, settings) = (FileAccess::default(), Vec::new());
        Self { path: path.into(), text, access, settings, content, lines }
    }

    /// Creates a document of `table`, values that a program made, without a text. Mistakes in the
    /// values have keys and no lines.
    #[must_use]
    pub fn from_table(path: impl Into<PathBuf>, table: &toml::Table) -> Self {
        let mut document = Self::new(path, "");
        let root = Node::of_table(table);
        document.content = OnceLock::from(Content { root, mistakes: Vec::new() });
        document
    }

    /// Returns the document, which may also name the files and folders `allowed`.
    #[must_use]
    pub fn allowing(mut self, allowed: &[PathBuf]) -> Self {
        self.access.allowed = allowed.to_vec();
        self
    }

    /// Returns the document, whose files are read with the given `access`.
    #[must_use]
    pub fn with_access(mut self, access: &FileAccess) -> Self {
        self.access = access.clone();
        self
    }

    /// Returns the access to the files that the document names.
    #[must_use]
    pub fn access(&self) -> &FileAccess {
        &self.access
    }

    /// Returns the document after `settings` have replaced values of its text, one after the other.
    ///
    /// Lines and columns of mistakes still refer to the text. A mistake in a value that was set
    /// names the setting.
    ///
    /// # Errors
    /// A mistake for each setting whose key leads through a value that is no table, or to an
    /// element that does not exist. Mistakes of grammar are reported by [`decode`](Self::decode)
    /// instead.
    pub fn with_settings(mut self, settings: &[Setting]) -> Result<Self, Diagnostics> {
        let mut content = self.content().clone();
        let mut mistakes = Vec::new();
        for setting in settings.iter().filter(|_| content.mistakes.is_empty()) {
            let place = self.text.len() + 1 + self.settings.len();
            if let Err(error) = setting.apply(&mut content.root, place) {
                let message = format!("{setting}, {}: {}", setting.origin(), error.message);
                mistakes.push(Diagnostic::new(&self.path, message).help(error.help));
            }
            self.settings.push(setting.clone());
        }
        Diagnostics::check(mistakes)?;
        self.content = OnceLock::from(content);
        Ok(self)
    }

    /// Checks that `setting` can replace a value of the text. The text must have no mistakes of
    /// grammar.
    ///
    /// # Errors
    /// [`SettingError`] if the key of `setting` leads nowhere, as in
    /// [`with_settings`](Self::with_settings).
    pub fn accepts(&self, setting: &Setting) -> Result<(), SettingError> {
        setting.apply(&mut self.content().root.clone(), self.text.len() + 1)
    }

    /// Returns the settings that replace values of the text.
    #[must_use]
    pub fn settings(&self) -> &[Setting] {
        &self.settings
    }

    /// Returns all values of the document that are texts, in the order of their keys.
    #[must_use]
    pub fn texts(&self) -> Vec<&str> {
        self.content().root.texts()
    }

    /// Returns the path of the file `name`, which the document names relative to its folder.
    ///
    /// # Errors
    /// [`ForbiddenPath`] if the file is outside the folder of the document, the working folder and
    /// the allowed folders.
    pub fn beside(&self, name: impl AsRef<Path>) -> Result<PathBuf, ForbiddenPath> {
        let path = self.folder().join(name);
        self.permit(&path)?;
        Ok(path)
    }

    /// Checks that the document may name `path`, which is relative to the working folder. It may
    /// name every file in memory.
    ///
    /// # Errors
    /// [`ForbiddenPath`], as in [`beside`](Self::beside).
    pub fn permit(&self, path: &Path) -> Result<(), ForbiddenPath> {
        if self.access.held(path).is_some() {
            return Ok(());
        }
        AllowedFolders::new(self.folder(), &self.access.allowed).check(path)
    }

    /// Returns the folder of the document.
    fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Reads the file `path`.
    ///
    /// # Errors
    /// A mistake if the file is missing, is larger than one mebibyte, or is not UTF-8.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        Self::read_with(path, FileAccess::usual())
    }

    /// Reads the file `path`. The limit on its size is raised by the factor in `access`, and the
    /// files that the document names are read with the same `access`.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read), with the raised limit.
    pub fn read_with(path: impl AsRef<Path>, access: &FileAccess) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        let bytes = LIMIT.read(path, access)?;
        let text = str::from_utf8(&bytes).map_err(|error| {
            let message = format!("cannot read the file: {error}");
            Diagnostic::new(path, message).help("save it as UTF-8")
        })?;
        Ok(Self::new(path, text).with_access(access))
    }

    /// Returns the path that was given to [`new`](Self::new) or [`read`](Self::read).
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the text, without a byte-order mark.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Decodes the text into a structure of type `T`.
    ///
    /// # Errors
    /// All mistakes of grammar, spelling and type, with their places.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, Diagnostics> {
        let (value, faults) = self.decode_with_faults()?;
        Diagnostics::check(faults.into_mistakes())?;
        Ok(value)
    }

    /// Decodes the text into a structure of type `T` in spite of mistakes of spelling and type.
    ///
    /// Wrong values are left out, so that all other values can be checked. The [`Faults`] name the
    /// keys that were left out.
    ///
    /// # Errors
    /// The mistakes, if the text has mistakes of grammar, or if no structure can be made.
    pub fn decode_with_faults<T: DeserializeOwned>(&self) -> Result<(T, Faults), Diagnostics> {
        let content = self.content();
        if !content.mistakes.is_empty() {
            let mistakes = content.mistakes.iter().map(|mistake| {
                self.placed(mistake.span.clone(), mistake.message.clone()).help(&mistake.help)
            });
            return Err(sorted(mistakes.collect()));
        }

        let Decoded { value, faults, keys } = decode(&content.root);
        let mistakes = faults.into_iter().map(|fault| self.diagnostic(fault)).collect();
        match value {
            Some(value) => Ok((value, Faults::new(mistakes, keys))),
            None => Err(sorted(mistakes)),
        }
    }

    /// Returns `fault` with its line, its subject and the edits that correct it.
    fn diagnostic(&self, fault: Fault) -> Diagnostic {
        let Fault { span, key, message, help, change } = fault;
        let written = self.key_as_written(&key);
        let message = if key.is_empty() { message } else { format!("{written}: {message}") };
        let mut mistake = self.placed(span, message);
        mistake.key = (!key.is_empty()).then(|| KeyPath::from(written.as_str()));
        mistake.help = (!help.is_empty()).then_some(help);
        mistake.subject = Subject::from_key(&self.content().root, &key);
        mistake.edits = match change {
            Some(Change::Value(value)) => self.edit(&key, Some(&value)).into_iter().collect(),
            Some(Change::Renamed(new)) => self.renamed(&key, &new),
            None => Vec::new(),
        };
        mistake
    }

    /// Returns a mistake with the given `message` in the value at the key path `key`, such as
    /// `warp.traction.stiffness` or `curve[2].file`.
    ///
    /// A key with dots in it is quoted, as in TOML: `panel."simon.back".grain`. If the text has no
    /// such value, the place of the mistake is the innermost table on the way to `key`.
    #[must_use]
    pub fn at(&self, key: &str, message: impl Into<String>) -> Diagnostic {
        /// Largest number of letters of a key path in a message.
        const KEY_MAX: usize = 120;

        let written = self.key_as_written(key);
        let message = format!("{}: {}", cut(&written, KEY_MAX), message.into());
        let subject = Subject::from_key(&self.content().root, key);
        let path = Some(KeyPath::from(written.as_str()));
        let Some(located) = self.find(key) else {
            return Diagnostic { subject, key: path, ..self.placed(None, message) };
        };
        let span = Some(located.node.span.clone());
        let mut mistake = Diagnostic { subject, key: path, ..self.placed(span, message) };

        // The list may be in the text while a setting replaced one of its elements.
        let setting = located.setting.filter(|_| mistake.span.is_some());
        if let Some(setting) = setting.and_then(|index| self.settings.get(index)) {
            mistake.message += &format!(" ({}: {setting})", setting.origin());
        }
        mistake
    }

    /// Returns `mistake`, which was found in a structure of the content of this document, with the
    /// path of the document and the line and column of the key. Edits of the structure become edits
    /// of the document.
    ///
    /// A mistake that has a file already is returned as it is.
    #[must_use]
    pub fn locate(&self, mistake: &Diagnostic) -> Diagnostic {
        let Some(key) = mistake.key.as_ref().filter(|_| mistake.file.as_os_str().is_empty()) else {
            return mistake.clone();
        };
        let key = key.to_string();
        let message = mistake.message.strip_prefix(&format!("{key}: ")).unwrap_or(&mistake.message);
        let mut located = self.at(&key, message);
        located.help.clone_from(&mistake.help);
        located.remedy.clone_from(&mistake.remedy);
        located.subject = mistake.subject.clone().or(located.subject);
        located.edits = mistake
            .edits
            .iter()
            .filter_map(|edit| {
                let is_of_structure = edit.file.as_os_str().is_empty();
                let here = is_of_structure.then(|| self.edit(&edit.key, edit.new.as_deref()));
                here.unwrap_or_else(|| Some(edit.clone()))
            })
            .collect();
        located
    }

    /// Returns a mistake at `span`. A span behind the end of the text stands for a setting.
    fn placed(&self, span: Option<Range<usize>>, message: impl Into<String>) -> Diagnostic {
        let index = span.as_ref().and_then(|span| span.start.checked_sub(self.text.len() + 1));
        if let Some(setting) = index.and_then(|index| self.settings.get(index)) {
            let message = format!("{} ({}: {setting})", message.into(), setting.origin());
            return Diagnostic::new(&self.path, message);
        }

        let mut diagnostic = Diagnostic::new(&self.path, message);
        if let Some(span) = span.filter(|_| !self.text.is_empty()) {
            let lines = self.lines.get_or_init(|| Lines::new(&self.text));
            let line = lines.starts.partition_point(|&start| start <= span.start).max(1);
            let start = lines.starts[line - 1];
            let before = self.text.get(start..span.start).unwrap_or_default();
            let letters = if lines.is_ascii { before.len() } else { before.chars().count() };
            diagnostic.line = Some(line);
            diagnostic.column = Some(letters + 1);
            diagnostic.span = Some(span);
        }
        diagnostic
    }

    /// Returns the values of the text. The text is parsed once.
    fn content(&self) -> &Content {
        self.content.get_or_init(|| {
            let (table, errors) = DeTable::parse_recoverable(&self.text);
            let mistakes =
                if errors.is_empty() { Vec::new() } else { grammar_mistakes(&self.text) };
            Content { root: Node::root(table.get_ref()), mistakes }
        })
    }
}

/// Values of a text, and the mistakes of grammar in the text.
#[derive(Debug, Clone)]
struct Content {
    root: Node,
    mistakes: Vec<GrammarMistake>,
}

/// Lines of a text.
#[derive(Debug, Clone)]
struct Lines {
    /// First byte of each line.
    starts: Vec<usize>,
    /// Whether each letter of the text is one byte.
    is_ascii: bool,
}

impl Lines {
    /// Returns the lines of `text`.
    fn new(text: &str) -> Self {
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        Self { starts: std::iter::once(0).chain(ends).collect(), is_ascii: text.is_ascii() }
    }
}

/// Returns `mistakes` in the order of the text.
fn sorted(mistakes: Vec<Diagnostic>) -> Diagnostics {
    match Diagnostics::check(mistakes) {
        Err(mistakes) => mistakes,
        Ok(()) => Diagnostics(Vec::new()),
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
        assert_eq!(missing.message, "curve[0].file: is missing");
        assert_eq!(missing.line, Some(2), "{missing}");
    }

    #[test]
    fn texts_come_in_the_order_of_their_keys_from_tables_and_lists() {
        let text = "b = [\"2\", [\"3\"], 4]\na = \"1\"\n[c]\nd = { e = \"5\", f = true }\n[[g]]\nh = \"6\"";
        assert_eq!(Document::new("a.toml", text).texts(), ["1", "2", "3", "5", "6"]);
    }

    #[test]
    fn a_missing_file_names_its_neighbour() {
        let mistakes = Document::read("Cargo.tml").expect_err("there is no such file");
        let help = mistakes.0[0].help.clone().expect("a remedy");
        assert!(help.contains("Cargo.toml"), "{help}");
    }
}
