//! Decoding of a TOML text into a structure, with all of its mistakes at once.
//!
//! A derived deserialiser stops at the first mistake. This one goes on: where a value is wrong or
//! missing it writes the mistake down and hands over a stand-in. It reads the text a few times:
//!
//! 1. `serde` does not say which keys a structure needs before one is missing. Each reading that
//!    ends at a missing key teaches that this structure needs it; the next one stands in for it in
//!    every such structure. There are as many of these readings as needed keys are missing
//!    somewhere, at most as many as the structures have, whatever the length of the text.
//! 2. The reading that comes to the end has written down all mistakes.
//! 3. If there are some, a last one leaves wrong values out, so that keys have their defaults where
//!    they have some. What it makes can be checked further: [`Faults`] knows the keys that were left
//!    out, about which nothing more is to be said.
//!
//! `state` is what a reading has found, `reader` reads the values of the text, `stand_in` makes others; `stop` is what ends a reading.

mod reader;
mod stand_in;
mod state;
mod stop;

use std::cell::RefCell;
use std::collections::BTreeSet;

use serde::de::DeserializeOwned;

use crate::diagnostic::Diagnostic;
use crate::node::Node;

pub(crate) use self::state::{Change, Fault};

use self::reader::{Path, Reader};
use self::state::State;
use self::stop::Stop;

/// Mistakes of a decoded text, with the keys whose values were left out.
#[derive(Debug, Clone, Default)]
pub struct Faults {
    mistakes: Vec<Diagnostic>,
    keys: BTreeSet<String>,
}

impl Faults {
    pub(crate) fn new(mistakes: Vec<Diagnostic>, keys: BTreeSet<String>) -> Self {
        Self { mistakes, keys }
    }

    /// Returns whether the value at a key path, or one in it, or one that it is in, was left out:
    /// then nothing more is known of it.
    #[must_use]
    pub fn cover(&self, key: &str) -> bool {
        if self.keys.is_empty() {
            return false;
        }
        let bounded = |long: &str, short: &str| {
            long.strip_prefix(short)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let ends = key.char_indices().filter(|(_, letter)| matches!(letter, '.' | '['));
        let outer = ends.map(|(end, _)| &key[..end]).any(|outer| self.keys.contains(outer));
        let from = || {
            self.keys.range::<str, _>((std::ops::Bound::Included(key), std::ops::Bound::Unbounded))
        };
        let inner = from().take_while(|own| own.starts_with(key)).any(|own| bounded(own, key));
        outer || inner
    }

    /// Returns the mistakes.
    #[must_use]
    pub fn into_mistakes(self) -> Vec<Diagnostic> {
        self.mistakes
    }

    /// Returns whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mistakes.is_empty()
    }
}

/// Structure that was decoded, if it could be, with its mistakes.
pub(crate) struct Decoded<T> {
    pub(crate) value: Option<T>,
    pub(crate) faults: Vec<Fault>,
    /// Keys whose values were left out.
    pub(crate) keys: BTreeSet<String>,
}

/// Decodes a text.
pub(crate) fn decode<T: DeserializeOwned>(root: &Node) -> Decoded<T> {
    let state = RefCell::new(State::default());
    loop {
        let read = T::deserialize(Reader { node: root, path: &Path::root(), state: &state });
        let mut now = state.borrow_mut();
        let value = match read {
            Ok(value) => Some(value),
            Err(Stop::Needs { structure, key }) => {
                // A key that is needed although it was stood in for cannot be helped.
                if now.needed.insert((structure, key)) {
                    if !now.is_last {
                        now.faults.clear();
                        now.wrong.clear();
                        now.keys.clear();
                    }
                    continue;
                }
                None
            }
            Err(Stop::Other(message)) => {
                if !now.is_last {
                    now.faults.push(Fault { message, ..Fault::default() });
                }
                None
            }
            Err(Stop::Missing(_)) => None,
        };
        if now.faults.is_empty() || now.is_last || value.is_none() {
            let State { faults, keys, .. } = std::mem::take(&mut *now);
            return Decoded { value, faults, keys };
        }
        now.is_last = true;
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
