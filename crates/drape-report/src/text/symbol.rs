//! Symbols with an index.

/// Symbol split at its underscore. `k_t` is a k with the index t.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Symbol<'a> {
    pub(crate) base: &'a str,
    pub(crate) index: &'a str,
}

impl<'a> Symbol<'a> {
    /// Returns the symbol `text` split at its first underscore.
    pub(crate) fn new(text: &'a str) -> Symbol<'a> {
        let (base, index) = text.split_once('_').unwrap_or((text, ""));
        Symbol { base, index }
    }
}
