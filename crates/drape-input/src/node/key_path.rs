//! Key paths as messages write them, such as `panel[1].rectangle`.
//!
//! `document` and `subject` follow key paths through the values of a text. `edit` follows them
//! through a text that is changed.

use std::fmt;

use crate::quoting::toml_key;

/// Key of a key path, with the indices that follow it.
pub(crate) struct KeyPart<'a> {
    pub(crate) name: &'a str,
    /// Index of an element of the array at `name`, then of an element of this element, and so on.
    pub(crate) indices: Vec<usize>,
}

/// Splits the key path `key` at its dots outside of quotes.
pub(crate) fn key_parts(key: &str) -> impl Iterator<Item = KeyPart<'_>> {
    let mut quoted = false;
    let pieces = key.split(move |letter: char| {
        quoted ^= letter == '"';
        letter == '.' && !quoted
    });
    pieces.map(|piece| match piece.strip_prefix('"').and_then(|rest| rest.split_once('"')) {
        Some((name, rest)) => KeyPart { name, indices: indices(rest) },
        None => {
            let (name, rest) = piece.split_once('[').unwrap_or((piece, ""));
            KeyPart { name, indices: indices(rest) }
        }
    })
}

/// Returns the numbers that stand in brackets in `text`.
fn indices(text: &str) -> Vec<usize> {
    text.split(['[', ']']).filter_map(|number| number.parse().ok()).collect()
}

/// Path of keys and numbers that leads to a value, such as `panel[2].center`.
///
/// [`Display`](fmt::Display) writes the path as messages do, and as a
/// [`Setting`](crate::Setting) takes it. [`From`] reads this form.
///
/// ```
/// use drape_input::{KeyPath, KeyStep};
///
/// let path = KeyPath::from("garment[0].panel.\"left.front\".turn");
/// assert_eq!(path.steps[1], KeyStep::Index(0));
/// assert_eq!(path.steps[3], KeyStep::Name("left.front".into()));
/// assert_eq!(path.to_string(), "garment[0].panel.\"left.front\".turn");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct KeyPath {
    /// Steps from the whole input to the value.
    pub steps: Vec<KeyStep>,
}

/// Step of a [`KeyPath`].
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum KeyStep {
    /// Key of a table.
    Name(String),
    /// Number of an element of a list, from 0.
    Index(usize),
}

impl From<&str> for KeyPath {
    fn from(text: &str) -> Self {
        let mut steps = Vec::new();
        for KeyPart { name, indices } in key_parts(text).filter(|_| !text.is_empty()) {
            steps.push(KeyStep::Name(name.to_owned()));
            steps.extend(indices.into_iter().map(KeyStep::Index));
        }
        Self { steps }
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, step) in self.steps.iter().enumerate() {
            match step {
                KeyStep::Name(name) if number == 0 => f.write_str(&toml_key(name))?,
                KeyStep::Name(name) => write!(f, ".{}", toml_key(name))?,
                KeyStep::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
