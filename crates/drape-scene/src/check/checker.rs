//! Checker: the file of a scene and the mistakes that have been found in it.

use std::ops::RangeInclusive;
use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document, closest};

use crate::file::SceneFile;

/// File of a scene that is being checked, with the mistakes found so far.
pub(crate) struct Checker<'a> {
    /// Content of the file.
    pub(crate) file: &'a SceneFile,
    /// Folder of the file.
    pub(crate) folder: &'a Path,
    /// Fabrics and patterns given along with the scene, by the paths by which it names them.
    pub(crate) documents: &'a [Document],
    /// Unit of the lengths of the file, in m.
    pub(crate) unit: f64,
    document: &'a Document,
    mistakes: Vec<Diagnostic>,
}

/// Name that is not among those that there are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnknownName<'a> {
    pub(crate) name: &'a str,
    pub(crate) known: &'a [&'a str],
    /// Kind of the names, in the plural.
    pub(crate) kind: &'a str,
}

impl<'a> Checker<'a> {
    /// Begins to check a file, whose unit is looked up at once.
    pub(crate) fn new(
        document: &'a Document,
        file: &'a SceneFile,
        documents: &'a [Document],
    ) -> Self {
        let folder = document.path().parent().unwrap_or(Path::new(""));
        let mistakes = Vec::new();
        let mut checker = Self { file, folder, documents, unit: 1.0, document, mistakes };
        let units = [("m", 1.0), ("cm", 0.01), ("mm", 0.001)];
        checker.unit = checker.choice("length", file.length.as_deref(), &units);
        checker
    }

    /// Document of the file.
    pub(crate) fn document(&self) -> &'a Document {
        self.document
    }

    /// Document given along with the scene for a path.
    pub(crate) fn given(&self, path: &Path) -> Option<&'a Document> {
        self.documents.iter().find(|given| given.path() == path)
    }

    /// Adds a mistake at a key, with a remedy, and returns its index.
    pub(crate) fn fail(&mut self, key: &str, message: impl Into<String>, help: &str) -> usize {
        self.mistakes.push(self.document.at(key, message.into()).help(help));
        self.mistakes.len() - 1
    }

    /// Adds a mistake at a key whose message says the remedy.
    pub(crate) fn fail_with(&mut self, key: &str, error: &impl ToString) {
        self.mistakes.push(self.document.at(key, error.to_string()));
    }

    /// Adds a mistake of the whole file, with a remedy.
    pub(crate) fn fail_file(&mut self, message: impl Into<String>, help: &str) {
        let mistake = Diagnostic::new(self.document.path(), message.into());
        self.mistakes.push(mistake.help(help));
    }

    /// Adds mistakes of another file.
    pub(crate) fn extend(&mut self, mistakes: Diagnostics) {
        self.mistakes.extend(mistakes.0);
    }

    /// Returns the mistakes that have been found, if there are some.
    pub(crate) fn finish(&mut self) -> Result<(), Diagnostics> {
        Diagnostics::check(std::mem::take(&mut self.mistakes))
    }

    /// Adds a mistake about an unknown name, with the nearest of those that there are or else all.
    pub(crate) fn unknown(
        &mut self,
        key: &str,
        message: impl Into<String>,
        unknown: UnknownName<'_>,
    ) {
        let UnknownName { name, known, kind } = unknown;
        let help = match closest(name, known.iter().copied()) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => format!("the {kind} are: {}", known.join(", ")),
        };
        self.fail(key, message, &help);
    }

    /// Returns whether a number is within a range; if not, adds a mistake.
    pub(crate) fn within(
        &mut self,
        key: &str,
        value: f64,
        range: RangeInclusive<f64>,
        help: &str,
    ) -> bool {
        let sound = range.contains(&value);
        if !sound {
            let (low, high) = range.into_inner();
            self.fail(key, format!("{value} is not between {low} and {high}"), help);
        }
        sound
    }

    /// Returns the choice that a word names, or the first when there is no word.
    pub(crate) fn choice<T: Copy>(
        &mut self,
        key: &str,
        word: Option<&str>,
        choices: &[(&str, T)],
    ) -> T {
        let found = choices.iter().find(|(name, _)| word.is_none_or(|word| word == *name));
        if let (None, Some(word)) = (found, word) {
            let names: Vec<&str> = choices.iter().map(|c| c.0).collect();
            let help = format!("one of {}", names.join(", "));
            self.fail(key, format!("there is no \"{word}\""), &help);
        }
        found.unwrap_or(&choices[0]).1
    }
}
