//! Mistakes of an input, each with its place and its remedy.
//!
//! `document` reports mistakes of TOML. The crates that define a structure report mistakes of its
//! values. A program prints all mistakes, and puts their remedies in its own words.

pub(crate) mod advice;
pub(crate) mod edit;
pub(crate) mod remedy;
pub(crate) mod subject;
pub(crate) mod value_error;

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use self::advice::{Advice, joined};
use self::edit::Edit;
use self::remedy::Remedy;
use self::subject::Subject;
use crate::figure::cut;
use crate::node::key_path::KeyPath;

/// One mistake of an input, with its place and its remedy.
///
/// ```
/// use drape_input::Diagnostic;
///
/// let mistake = Diagnostic::new("curve.csv", "the force is empty").on_line(7).help("fill it in");
/// assert_eq!(mistake.to_string(), "curve.csv:7: the force is empty\n  help: fill it in");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// File with the mistake. Empty for a value that is in no file.
    pub file: PathBuf,
    /// Key path of the wrong value, if the mistake concerns one.
    pub key: Option<KeyPath>,
    /// Line of the mistake, from 1, if the mistake has a place in the text.
    pub line: Option<usize>,
    /// Column of the mistake, from 1, in characters.
    pub column: Option<usize>,
    /// Bytes of the text that the mistake covers.
    pub span: Option<Range<usize>>,
    /// Description of the mistake, with the wrong value.
    pub message: String,
    /// Remedy as a text, if one is known.
    pub help: Option<String>,
    /// Remedy that a program puts in its own words, if one is known. It stands behind the text.
    pub remedy: Option<Remedy>,
    /// Part of the input that the mistake concerns, if it has a name.
    pub subject: Option<Subject>,
    /// Changes of files that together are the remedy. Empty if a program cannot make the remedy
    /// alone. If there are several remedies, these changes are the first one.
    pub edits: Vec<Edit>,
}

impl Diagnostic {
    /// Creates a mistake that concerns the whole of `file`.
    #[must_use]
    pub fn new(file: impl Into<PathBuf>, message: impl Into<String>) -> Self {
        Self {
            file: file.into(),
            key: None,
            line: None,
            column: None,
            span: None,
            message: shorten(message.into()),
            help: None,
            remedy: None,
            subject: None,
            edits: Vec::new(),
        }
    }

    /// Adds the remedy `help`: a text, a [`Remedy`], or both.
    #[must_use]
    pub fn help(mut self, help: impl Into<Advice>) -> Self {
        let Advice { text, remedy } = help.into();
        self.help = (!text.is_empty() || remedy.is_none()).then(|| shorten(text));
        self.remedy = remedy;
        self
    }

    /// Returns the mistake with its [`Remedy`] as a text. `words` are the words of a program for
    /// it.
    #[must_use]
    pub fn in_words(mut self, words: impl FnOnce(&Remedy) -> String) -> Self {
        if let Some(remedy) = self.remedy.take() {
            let text = self.help.unwrap_or_default();
            self.help = Some(joined(&text, &words(&remedy)));
        }
        self
    }

    /// Adds `subject`, the part of the input that the mistake concerns.
    #[must_use]
    pub fn about(mut self, subject: Subject) -> Self {
        self.subject = Some(subject);
        self
    }

    /// Adds `edits`, the changes that together are the remedy.
    #[must_use]
    pub fn with_edits(mut self, edits: impl IntoIterator<Item = Edit>) -> Self {
        self.edits = edits.into_iter().collect();
        self
    }

    /// Adds the `line` of the mistake, from 1.
    #[must_use]
    pub fn on_line(mut self, line: usize) -> Self {
        self.line = Some(line);
        self
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.file.as_os_str().is_empty() {
            write!(f, "{}", self.file.display())?;
            if let Some(line) = self.line {
                write!(f, ":{line}")?;
            }
            if let Some(column) = self.column {
                write!(f, ":{column}")?;
            }
            f.write_str(": ")?;
        }
        f.write_str(&self.message)?;
        let help = self.help.as_deref();
        match (&self.remedy, help) {
            (Some(remedy), help) => {
                write!(f, "\n  help: {}", joined(help.unwrap_or_default(), &remedy.to_string()))
            }
            (None, Some(help)) => write!(f, "\n  help: {help}"),
            (None, None) => Ok(()),
        }
    }
}

impl std::error::Error for Diagnostic {}

/// Returns `text`, cut if it quotes so much of an input that nobody would read it.
fn shorten(text: String) -> String {
    /// Largest number of letters of a message or a remedy.
    const LETTERS_MAX: usize = 1000;

    if text.len() <= LETTERS_MAX { text } else { cut(&text, LETTERS_MAX) }
}

/// All mistakes of an input, in the order of the text: the error type of this crate.
///
/// ```
/// use drape_input::{Diagnostic, Diagnostics};
///
/// assert_eq!(Diagnostics::check(Vec::new()), Ok(()));
/// let later = Diagnostic::new("a.toml", "too late").on_line(9);
/// let earlier = Diagnostic::new("a.toml", "too early").on_line(2);
/// let mistakes = Diagnostics::check(vec![later, earlier]).expect_err("there are two");
/// assert_eq!(mistakes.0[0].line, Some(2));
/// assert_eq!(mistakes.to_string(), "a.toml:2: too early\na.toml:9: too late");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl Diagnostics {
    /// Returns `Ok` if `mistakes` is empty.
    ///
    /// # Errors
    /// The `mistakes`, sorted by file and line, without duplicates.
    pub fn check(mut mistakes: Vec<Diagnostic>) -> Result<(), Self> {
        if mistakes.is_empty() {
            return Ok(());
        }
        mistakes.sort_by(|a, b| (&a.file, a.line, a.column).cmp(&(&b.file, b.line, b.column)));
        mistakes.dedup();
        Err(Self(mistakes))
    }

    /// Returns the mistakes with their [`Remedy`] as a text. `words` are the words of a program for
    /// a remedy.
    #[must_use]
    pub fn in_words(self, words: impl Fn(&Remedy) -> String) -> Self {
        Self(self.0.into_iter().map(|mistake| mistake.in_words(&words)).collect())
    }

    /// Returns the mistakes that are shown: the first 20.
    #[must_use]
    pub fn shown(&self) -> &[Diagnostic] {
        /// Largest number of mistakes of an input that are shown.
        const SHOWN_MAX: usize = 20;

        &self.0[..self.0.len().min(SHOWN_MAX)]
    }

    /// Returns the number of mistakes that are not [`shown`](Self::shown) in words, or `None` if
    /// all are shown.
    #[must_use]
    pub fn hidden_count_text(&self) -> Option<String> {
        match self.0.len() - self.shown().len() {
            0 => None,
            1 => Some("and 1 more mistake".into()),
            count => Some(format!("and {count} more mistakes")),
        }
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(mistake: Diagnostic) -> Self {
        Self(vec![mistake])
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.shown().iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{diagnostic}")?;
        }
        match self.hidden_count_text() {
            Some(count) => write!(f, "\n{count}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Diagnostics {}
