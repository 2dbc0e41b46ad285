//! Decoding of a TOML text into a structure, with all mistakes of the text at once.
//!
//! A derived deserialiser stops at the first mistake. This decoder continues: where a value is
//! wrong or missing, it records the mistake and passes a stand-in to the structure. The text is
//! read a few times:
//!
//! 1. `serde` only reveals that a structure needs a key when the key is missing. Each reading that
//!    ends at a missing key records the key. The next reading uses a stand-in for this key in every
//!    such structure. The number of these readings is the number of different keys that are
//!    missing, and does not depend on the length of the text.
//! 2. The reading that reaches the end has recorded all mistakes.
//! 3. If there are mistakes, a last reading leaves wrong values out, so that their keys have their
//!    defaults. The resulting structure can be checked further. [`Faults`] knows the keys that were
//!    left out, about which no further mistake should be reported.
//!
//! `state` holds the findings of a reading, `reader` reads the values of the text, `stand_in`
//! creates stand-ins, and `stop` lists the reasons that end a reading.

pub(crate) mod form;
mod reader;
mod stand_in;
mod state;
mod stop;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Bound;

use serde::de::DeserializeOwned;

use crate::diagnostic::Diagnostic;
use crate::node::Node;
use crate::node::key_path::KeyPath;

pub(crate) use self::state::{Change, Fault};

use self::reader::{Reader, ValuePath};
use self::state::ReadingState;
use self::stop::Stop;

/// Mistakes of a decoded text, with the keys whose values were left out.
#[derive(Debug, Clone, Default)]
pub struct Faults {
    mistakes: Vec<Diagnostic>,
    keys: BTreeSet<String>,
}

impl Faults {
    /// Returns the faults of a text with the given `mistakes`, whose values at `keys` were left
    /// out.
    pub(crate) fn new(mistakes: Vec<Diagnostic>, keys: BTreeSet<String>) -> Self {
        Self { mistakes, keys }
    }

    /// Returns whether the value at the key path `key`, a value in it, or a value around it was
    /// left out. Nothing is then known about the value.
    #[must_use]
    pub fn cover(&self, key: &str) -> bool {
        if self.keys.is_empty() {
            return false;
        }
        let mut ends = key.char_indices().filter(|(_, letter)| matches!(letter, '.' | '['));
        let is_inside = ends.any(|(end, _)| self.keys.contains(&key[..end]));

        // Keys that begin with `key` are neighbours in the set. Of them, `disc` and `disc[0]` cover
        // `disc`, but `discus` does not.
        let mut longer = self
            .keys
            .range::<str, _>((Bound::Included(key), Bound::Unbounded))
            .map_while(|covered| covered.strip_prefix(key));
        let is_around = longer.any(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
        is_inside || is_around
    }

    /// Returns whether there is a mistake in the value at the key path `key`, or in a value in it.
    #[must_use]
    pub fn concern(&self, key: &str) -> bool {
        let outer = KeyPath::from(key).steps;
        let mut keys = self.mistakes.iter().filter_map(|mistake| mistake.key.as_ref());
        keys.any(|path| path.steps.starts_with(&outer))
    }

    /// Replaces the message of the mistake at `key`, if there is one, by the message, the remedy
    /// and the edits of `answer`.
    pub fn explain(&mut self, key: &str, answer: &Diagnostic) {
        let path = KeyPath::from(key);
        for mistake in &mut self.mistakes {
            if mistake.key.as_ref() == Some(&path) {
                mistake.message.clone_from(&answer.message);
                mistake.help.clone_from(&answer.help);
                mistake.remedy.clone_from(&answer.remedy);
                mistake.edits.clone_from(&answer.edits);
            }
        }
    }

    /// Returns the mistakes as a list of [`Diagnostic`]s.
    #[must_use]
    pub fn into_mistakes(self) -> Vec<Diagnostic> {
        self.mistakes
    }

    /// Returns whether there are no mistakes.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mistakes.is_empty()
    }
}

/// Result of decoding a text.
pub(crate) struct Decoded<T> {
    /// Structure, if one could be made.
    pub(crate) value: Option<T>,
    /// Mistakes of the text.
    pub(crate) faults: Vec<Fault>,
    /// Keys whose values were left out.
    pub(crate) keys: BTreeSet<String>,
}

/// Units of bare lengths that the key `length` of a text names, in m.
const LENGTH_UNITS: [(&str, f64); 3] = [("m", 1.0), ("cm", 0.01), ("mm", 0.001)];

/// Returns the unit of bare lengths in a text with the content `root`, in m: the metre where the
/// text names no unit, or none that is known.
fn length_unit(root: &Node) -> f64 {
    let word = root.entry("length").and_then(|entry| entry.node.as_text());
    let unit = LENGTH_UNITS.iter().find(|(name, _)| word.as_deref() == Some(name));
    unit.map_or(1.0, |(_, metres)| *metres)
}

/// Decodes `root`, the content of a text, into a structure of type `T`.
pub(crate) fn decode<T: DeserializeOwned>(root: &Node) -> Decoded<T> {
    let state_cell = RefCell::new(ReadingState::new(length_unit(root)));
    loop {
        let reader = Reader { node: root, path: &ValuePath::root(), state: &state_cell };
        let reading = T::deserialize(reader);

        let mut state = state_cell.borrow_mut();
        let value = match reading {
            Ok(value) => Some(value),
            Err(Stop::Needs { structure, key }) => {
                // The reading is repeated with a stand-in, unless there was one already.
                if state.needed.insert((structure, key)) {
                    if !state.is_last {
                        state.faults.clear();
                        state.wrong.clear();
                        state.keys.clear();
                    }
                    continue;
                }
                None
            }
            Err(Stop::Other(message)) => {
                if !state.is_last {
                    state.faults.push(Fault { message, ..Fault::default() });
                }
                None
            }
            Err(Stop::Missing(_)) => None,
        };

        if state.faults.is_empty() || state.is_last || value.is_none() {
            let faults = std::mem::take(&mut state.faults);
            return Decoded { value, faults, keys: std::mem::take(&mut state.keys) };
        }
        state.is_last = true;
    }
}

#[cfg(test)]
mod tests {
    use super::Faults;

    #[test]
    fn faults_cover_what_is_inside_and_around_them() {
        let faults = Faults::new(Vec::new(), ["panel[1].disc".to_owned()].into());
        for key in ["panel[1].disc", "panel[1].disc[0]", "panel[1]", "panel"] {
            assert!(faults.cover(key), "{key}");
        }
        for key in ["panel[1].discus", "panel[10]", "panel[1].dis", "panel[0].disc", "time"] {
            assert!(!faults.cover(key), "{key}");
        }
    }
}
