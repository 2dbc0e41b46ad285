//! State of a reading: the mistakes found so far, and what the structures need.

use std::collections::BTreeSet;
use std::ops::Range;

/// Mistake of a text, before its line is looked up.
#[derive(Default)]
pub(crate) struct Fault {
    pub(crate) span: Option<Range<usize>>,
    /// Key path of the value; empty of the whole text.
    pub(crate) key: String,
    pub(crate) message: String,
    pub(crate) help: String,
    /// Change at the key path that remedies it.
    pub(crate) change: Option<Change>,
}

/// Change at a key path.
pub(crate) enum Change {
    /// Another value, in TOML.
    Value(String),
    /// Another key path.
    Renamed(String),
}

/// State of a reading.
#[derive(Default)]
pub(crate) struct State {
    pub(super) faults: Vec<Fault>,
    pub(super) keys: BTreeSet<String>,
    /// Names of structures with the keys that they need.
    pub(super) needed: BTreeSet<(&'static str, &'static str)>,
    /// Addresses of values that are wrong.
    pub(super) wrong: BTreeSet<usize>,
    /// Whether wrong values are left out, and mistakes are not written down again.
    pub(super) is_last: bool,
}
