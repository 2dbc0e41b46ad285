//! State of a reading: the mistakes so far, and the keys that structures need.

use std::collections::BTreeSet;
use std::ops::Range;

/// Mistake of a text whose line has not been looked up yet.
#[derive(Default)]
pub(crate) struct Fault {
    /// Bytes of the text that the mistake covers.
    pub(crate) span: Option<Range<usize>>,
    /// Key path of the value. Empty for the whole text.
    pub(crate) key: String,
    /// Message, without the key path.
    pub(crate) message: String,
    pub(crate) help: String,
    /// Change at the key path that corrects the mistake.
    pub(crate) change: Option<Change>,
}

/// Change that corrects a mistake at a key path.
pub(crate) enum Change {
    /// Replacement of the value by this value, in TOML.
    Value(String),
    /// Move of the value to this key path.
    Renamed(String),
}

/// State of a reading.
pub(crate) struct ReadingState {
    /// Unit of bare lengths in the text, in m.
    pub(super) length_unit: f64,
    /// Mistakes so far.
    pub(super) faults: Vec<Fault>,
    /// Key paths of wrong and missing values.
    pub(super) keys: BTreeSet<String>,
    /// Names of structures, each with a key that the structure needs.
    pub(super) needed: BTreeSet<(&'static str, &'static str)>,
    /// Addresses of values that are wrong.
    pub(super) wrong: BTreeSet<usize>,
    /// Whether this is the last reading, which leaves wrong values out and records no mistakes.
    pub(super) is_last: bool,
}

impl ReadingState {
    /// Returns the state before a reading of a text whose bare lengths are in `length_unit`, in m.
    pub(super) fn new(length_unit: f64) -> Self {
        Self {
            length_unit,
            faults: Vec::new(),
            keys: BTreeSet::new(),
            needed: BTreeSet::new(),
            wrong: BTreeSet::new(),
            is_last: false,
        }
    }
}
