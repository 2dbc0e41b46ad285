//! Advice: a text for the user of an input, and a remedy that a program puts in its own words.

use std::fmt;

use crate::diagnostic::remedy::Remedy;

/// Text for the user of an input, with a [`Remedy`] behind it if there is one.
///
/// ```
/// use drape_input::{Advice, Remedy};
///
/// let advice = Advice::from("undo the change").with(Remedy::RunAnew);
/// assert_eq!(advice.in_words(|_| "press Start".into()), "undo the change; press Start");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Advice {
    /// Text. Empty if the remedy says all.
    pub text: String,
    /// Remedy, if one is known that a program puts in its own words.
    pub remedy: Option<Remedy>,
}

impl Advice {
    /// Adds `remedy` behind the text.
    #[must_use]
    pub fn with(self, remedy: Remedy) -> Self {
        Self { remedy: Some(remedy), ..self }
    }

    /// Returns the text and the remedy in a line. `words` are the words of a program for a remedy.
    #[must_use]
    pub fn in_words(&self, words: impl FnOnce(&Remedy) -> String) -> String {
        match &self.remedy {
            Some(remedy) => joined(&self.text, &words(remedy)),
            None => self.text.clone(),
        }
    }
}

/// Returns `text` and the words of a remedy in a line.
pub(crate) fn joined(text: &str, remedy: &str) -> String {
    let separator = match text.chars().last() {
        None => "",
        Some('?') => " ",
        Some(_) => "; ",
    };
    format!("{text}{separator}{remedy}")
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(Remedy::to_string))
    }
}

impl From<String> for Advice {
    fn from(text: String) -> Self {
        Self { text, remedy: None }
    }
}

impl From<&str> for Advice {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl From<&String> for Advice {
    fn from(text: &String) -> Self {
        text.clone().into()
    }
}

impl From<Remedy> for Advice {
    fn from(remedy: Remedy) -> Self {
        Self { text: String::new(), remedy: Some(remedy) }
    }
}
