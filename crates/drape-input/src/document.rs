//! Text of a TOML file: decoded into a structure, or searched for the place of a key.
//!
//! Every crate that reads TOML goes through [`Document`], so all mistakes look alike.

pub(crate) mod size_limit;

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde::de::DeserializeOwned;
use toml::de::DeTable;

use crate::allowed_folders::{AllowedFolders, ForbiddenPath};
use crate::decode::{Change, Decoded, Fault, Faults, decode};
use crate::diagnostic::edit::Edit;
use crate::diagnostic::subject::Subject;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::figure::cut;
use crate::grammar::{GrammarMistake, grammar_mistakes};
use crate::node::key_path::{Part, parts};
use crate::node::{Node, Value};
use crate::setting::{Setting, SettingError};
use crate::spelling::closest;
use size_limit::SizeLimit;

/// Limit of TOML files: sheets, fabrics and scenes have a few kilobytes.
const LIMIT: SizeLimit = SizeLimit::new("TOML files", 1 << 20);

/// Largest number of letters of a key path in a message.
const KEY_MAX: usize = 120;

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
    /// Files and folders that it may name beside those of its own folder and the working folder.
    allowed: Vec<PathBuf>,
    /// Values that take the place of those of the text.
    settings: Vec<Setting>,
    content: OnceLock<Content>,
    lines: OnceLock<Lines>,
}

impl Document {
    /// Creates a document from text in memory; `path` is used in messages only.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        let text: String = text.into();
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        let (content, lines) = (OnceLock::new(), OnceLock::new());
        Self { path: path.into(), text, allowed: Vec::new(), settings: Vec::new(), content, lines }
    }

    /// Returns the document, which may name other files and those in other folders too.
    #[must_use]
    pub fn allowing(mut self, allowed: &[PathBuf]) -> Self {
        self.allowed = allowed.to_vec();
        self
    }

    /// Returns the files and folders that it may name beside those of its own and the working folder.
    #[must_use]
    pub fn allowed(&self) -> &[PathBuf] {
        &self.allowed
    }

    /// Returns the document with values that take the place of those of its text, one after the
    /// other. Lines and columns stay those of the text; a mistake in a value that was set says so.
    ///
    /// # Errors
    /// A key leads nowhere: through a value that is no table, or to an element that is not there.
    /// Mistakes of the text itself are left to [`decode`](Self::decode).
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

    /// Checks that a value can take the place of one of the text, which has no mistakes of grammar.
    ///
    /// # Errors
    /// The key leads nowhere, as in [`with_settings`](Self::with_settings).
    pub fn accepts(&self, setting: &Setting) -> Result<(), SettingError> {
        setting.apply(&mut self.content().root.clone(), self.text.len() + 1)
    }

    /// Values that take the place of those of the text.
    #[must_use]
    pub fn settings(&self) -> &[Setting] {
        &self.settings
    }

    /// Returns all values that are texts, in the order of their keys.
    #[must_use]
    pub fn texts(&self) -> Vec<&str> {
        self.content().root.texts()
    }

    /// Returns the path of a file that the document names, which is seen from its folder.
    ///
    /// # Errors
    /// The file is not below its folder, the working folder or a folder that is allowed.
    pub fn beside(&self, name: impl AsRef<Path>) -> Result<PathBuf, ForbiddenPath> {
        let path = self.folder().join(name);
        self.permit(&path)?;
        Ok(path)
    }

    /// Checks a path, seen from the working folder, as [`beside`](Self::beside) does.
    ///
    /// # Errors
    /// As for [`beside`](Self::beside).
    pub fn permit(&self, path: &Path) -> Result<(), ForbiddenPath> {
        AllowedFolders::new(self.folder(), &self.allowed).check(path)
    }

    fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Reads a file.
    ///
    /// # Errors
    /// The file is missing, larger than a mebibyte unless limits are raised, or not UTF-8.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let path = path.as_ref();
        let fail = |message: String| Diagnostic::new(path, message);
        let metadata = std::fs::metadata(path).map_err(|e| {
            fail(format!("cannot open the file: {e}")).help(missing_file_help(path))
        })?;
        if !metadata.is_file() {
            return Err(fail("this is not a file".into()).help("name a TOML file").into());
        }
        if let Err(refused) = LIMIT.check(metadata.len()) {
            return Err(fail(refused.to_string()).help(refused.help()).into());
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
    /// All mistakes of grammar, spelling or type, with their places.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, Diagnostics> {
        let (value, faults) = self.decode_with_faults()?;
        Diagnostics::check(faults.into_mistakes())?;
        Ok(value)
    }

    /// Decodes the text into a structure in spite of mistakes of spelling and type: what is wrong is
    /// left out, so that the rest can be checked.
    ///
    /// # Errors
    /// The mistakes, if they are of grammar, or no structure can be made.
    pub fn decode_with_faults<T: DeserializeOwned>(&self) -> Result<(T, Faults), Diagnostics> {
        let content = self.content();
        if !content.mistakes.is_empty() {
            let told = |GrammarMistake { span, message, help }: &GrammarMistake| {
                self.locate(span.clone(), message.clone()).help(help.clone())
            };
            return Err(sorted(content.mistakes.iter().map(told).collect()));
        }
        let Decoded { value, faults, keys } = decode(&content.root);
        let mistakes: Vec<Diagnostic> = faults.into_iter().map(|fault| self.told(fault)).collect();
        value.map_or_else(
            || Err(sorted(mistakes.clone())),
            |value| Ok((value, Faults::new(mistakes.clone(), keys))),
        )
    }

    /// Returns the mistake of a fault.
    fn told(&self, fault: Fault) -> Diagnostic {
        let Fault { span, key, message, help, change } = fault;
        let mut mistake = self.locate(span, message);
        mistake.help = (!help.is_empty()).then_some(help);
        mistake.subject = Subject::of_key(&self.content().root, &key);
        mistake.edits = match change {
            Some(Change::Value(value)) => self.edit(&key, Some(&value)).into_iter().collect(),
            Some(Change::Renamed(new)) => self.renamed(&key, &new),
            None => Vec::new(),
        };
        mistake
    }

    /// Returns the change of the value at a key path to another one, in TOML, or its removal.
    ///
    /// Returns `None` where the file cannot be changed so: the value was set beside the text, or is
    /// a table with a heading of its own.
    #[must_use]
    pub fn edit(&self, key: &str, new: Option<&str>) -> Option<Edit> {
        let old = match self.find(key) {
            Some(place) if place.is_whole => {
                let text = place.node.text.clone().filter(|_| place.set.is_none());
                Some(text.and_then(|span| self.text.get(span))?.to_owned())
            }
            _ => None,
        };
        let (file, key) = (self.path.clone(), key.to_owned());
        (old.is_some() || new.is_some()).then(|| Edit {
            file,
            key,
            old,
            new: new.map(str::to_owned),
        })
    }

    /// Returns the changes that move a value to another key path; none where the file cannot be
    /// changed so.
    #[must_use]
    pub fn renamed(&self, key: &str, new: &str) -> Vec<Edit> {
        let file = || self.path.clone();
        let Some(place) = self.find(key).filter(|place| place.is_whole) else { return Vec::new() };
        let values = match &place.node.text {
            Some(value) => Some(vec![(String::new(), value.clone())]),
            None => place.node.values(),
        };
        let add = |(path, span): (String, Range<usize>)| {
            let value = self.text.get(span)?.to_owned();
            Some(Edit { file: file(), key: format!("{new}{path}"), old: None, new: Some(value) })
        };
        let added: Option<Vec<Edit>> =
            values.and_then(|values| values.into_iter().map(add).collect());
        let old = self.edit(key, None).and_then(|edit| edit.old);
        let removed = Edit { file: file(), key: key.to_owned(), old, new: None };
        added.map_or_else(Vec::new, |added| [vec![removed], added].concat())
    }

    /// Returns whether the text has a value at a key path.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.find(key).is_some_and(|place| place.is_whole)
    }

    /// Returns a mistake in the value at a key path such as `warp.traction.stiffness` or
    /// `curve[2].file`.
    ///
    /// A key with dots in it is quoted, as in TOML: `panel."simon.back".grain`. If the value is not in
    /// the text, the innermost table that is gives the place.
    #[must_use]
    pub fn at(&self, key: &str, message: impl Into<String>) -> Diagnostic {
        let message = format!("{}: {}", cut(key, KEY_MAX), message.into());
        let subject = Subject::of_key(&self.content().root, key);
        let Some(place) = self.find(key) else {
            return Diagnostic { subject, ..self.locate(None, message) };
        };
        let mut mistake =
            Diagnostic { subject, ..self.locate(Some(place.node.span.clone()), message) };
        // Of a list of the text, elements may have been set.
        let set = place.set.filter(|_| mistake.span.is_some());
        if let Some(setting) = set.and_then(|index| self.settings.get(index)) {
            mistake.message += &format!(" ({}: {setting})", setting.origin());
        }
        mistake
    }

    /// Returns a mistake with the place of a span; places behind the text stand for its settings.
    fn locate(&self, span: Option<Range<usize>>, message: impl Into<String>) -> Diagnostic {
        let place = span.as_ref().and_then(|span| span.start.checked_sub(self.text.len() + 1));
        if let Some(setting) = place.and_then(|index| self.settings.get(index)) {
            let message = format!("{} ({}: {setting})", message.into(), setting.origin());
            return Diagnostic::new(&self.path, message);
        }
        let mut diagnostic = Diagnostic::new(&self.path, message);
        if let Some(span) = span {
            let lines = self.lines.get_or_init(|| Lines::of(&self.text));
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

    /// Returns the values of the text, which is parsed once.
    fn content(&self) -> &Content {
        self.content.get_or_init(|| {
            let (table, errors) = DeTable::parse_recoverable(&self.text);
            let right = errors.is_empty();
            Content {
                root: Node::root(table.get_ref()),
                mistakes: if right { Vec::new() } else { grammar_mistakes(&self.text) },
            }
        })
    }

    /// Returns the place of the value at a key path, or of the innermost table on the way to it.
    fn find(&self, key: &str) -> Option<Place<'_>> {
        let mut node = &self.content().root;
        let mut found = None;
        for Part { name, indices } in parts(key) {
            let Some(entry) = node.entry(name) else { return self.place(found, false) };
            node = &entry.node;
            for index in indices {
                found = Some(node);
                let Value::List(elements) = &node.value else { return self.place(found, false) };
                let Some(element) = elements.get(index) else { return self.place(found, false) };
                node = element;
            }
            found = Some(node);
        }
        self.place(found, true)
    }

    /// Returns the place of a value that was found, if one was.
    fn place<'a>(&self, found: Option<&'a Node>, is_whole: bool) -> Option<Place<'a>> {
        let node = found?;
        let set = node.first_element_behind(self.text.len());
        let set = set.map(|place| place - 1 - self.text.len());
        Some(Place { node, is_whole, set })
    }
}

/// Values of a text, and its mistakes of grammar.
#[derive(Debug, Clone)]
struct Content {
    root: Node,
    mistakes: Vec<GrammarMistake>,
}

/// Lines of a text.
#[derive(Debug, Clone)]
struct Lines {
    /// First byte of each.
    starts: Vec<usize>,
    /// Whether each letter of the text is a byte.
    is_ascii: bool,
}

impl Lines {
    fn of(text: &str) -> Self {
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        Self { starts: std::iter::once(0).chain(ends).collect(), is_ascii: text.is_ascii() }
    }
}

/// Place of a value, or of a table that it should be in.
struct Place<'a> {
    node: &'a Node,
    /// Whether it is the value itself.
    is_whole: bool,
    /// Number of the setting of an element, if the value is a list.
    set: Option<usize>,
}

/// Returns mistakes in the order of the text.
fn sorted(mistakes: Vec<Diagnostic>) -> Diagnostics {
    match Diagnostics::check(mistakes) {
        Err(mistakes) => mistakes,
        Ok(()) => Diagnostics(Vec::new()),
    }
}

/// Returns advice on a path that does not exist: the file beside it that was probably meant.
#[must_use]
pub fn missing_file_help(path: &Path) -> String {
    let folder = folder_of(path);
    match similar_file(path) {
        Some(name) => format!("did you mean {}?", folder.join(name).display()),
        None if !folder.is_dir() => format!("there is no folder {}", folder.display()),
        None => format!("looked in {}", folder.display()),
    }
}

/// Returns the name of the file beside a path that does not exist that was probably meant.
#[must_use]
pub fn similar_file(path: &Path) -> Option<String> {
    let entries = std::fs::read_dir(folder_of(path)).ok()?;
    let mut names: Vec<String> =
        entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    let wanted = path.file_name()?.to_string_lossy().into_owned();
    closest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
}

/// Returns the folder of a path.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
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
    fn a_key_path_leads_into_lists_of_lists() {
        let document = Document::new("a.toml", "sides = [[1, 2], [3, 4]]");
        let column = |key: &str| document.at(key, "").column;
        assert_eq!(column("sides[1]"), Some(18));
        assert_eq!(column("sides[1][1]"), Some(22));
        assert_eq!(column("sides[1][2]"), Some(18));
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
    fn an_edit_has_the_value_that_stands_there_unless_it_was_set_or_has_a_heading() {
        let text = "a = 1 # one\nb = { c = [2, \"x\"] }\n[d]\ne.f = 3\n[[g]]\nh = 4\n";
        let document = Document::new("a.toml", text);
        let old = |key: &str| document.edit(key, Some("0")).map(|edit| edit.old);
        let some = |text: &str| Some(Some(text.to_owned()));
        assert_eq!([old("a"), old("b.c[1]"), old("d.e.f")], [some("1"), some("\"x\""), some("3")]);
        assert_eq!([old("b"), old("g[0].h")], [some("{ c = [2, \"x\"] }"), some("4")]);
        assert_eq!([old("d.x"), old("g[1].h")], [Some(None), Some(None)]);
        assert_eq!([old("d"), old("d.e"), old("g"), old("g[0]")], [const { None }; 4]);
        assert_eq!(document.edit("d.x", None), None, "there is nothing to remove");
        let set = document.with_settings(&["a=7".parse().expect("it is one")]).expect("it fits");
        assert_eq!(set.edit("a", Some("0")), None);
    }

    #[test]
    fn slips_of_the_pen_have_their_remedies_as_edits() {
        let text = "[[curve]]\nfil = \"x\"\n[[curve]]\nfil = { a = 1 }\nfile = \"y\"\n";
        let document = Document::new("a.toml", format!("dt = 1\n{text}"));
        let mistakes = document.decode::<Outer>().expect_err("there are slips").0;
        let edits = |index: usize| -> Vec<_> {
            let edits = mistakes[index].edits.iter();
            edits
                .map(|edit| (edit.key.as_str(), edit.old.as_deref(), edit.new.as_deref()))
                .collect()
        };
        let of_first =
            [("curve[0].fil", Some("\"x\""), None), ("curve[0].file", None, Some("\"x\""))];
        assert_eq!(edits(0), of_first, "{:?}", mistakes[0]);
        assert_eq!(edits(1), [], "there is a file already: {:?}", mistakes[1]);

        // A table takes all of its values along.
        let text = "[solvr]\nmethod = \"newton\"\nlinear.size = [1, 2] # two\n";
        let edits = Document::new("a.toml", text).renamed("solvr", "solver");
        let changed = crate::apply_edits(text, &edits).expect("they fit");
        let expected = "[solver]\nlinear.size = [1, 2]\nmethod = \"newton\"\n";
        let table = |text: &str| Document::new("a.toml", text).decode::<toml::Table>();
        assert_eq!(table(&changed), table(expected), "{changed}");
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
