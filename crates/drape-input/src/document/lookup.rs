//! Looking up values of a document by their key paths.

use crate::document::Document;
use crate::node::key_path::{KeyPart, key_parts};
use crate::node::{Node, Value};

impl Document {
    /// Returns whether the document has a value at the key path `key`.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.find(key).is_some_and(|located| located.is_value)
    }

    /// Returns the value at the key path `key`, if it is a text.
    #[must_use]
    pub fn text_at(&self, key: &str) -> Option<String> {
        self.find(key).filter(|located| located.is_value)?.node.as_text()
    }

    /// Returns the text of the value at the key path `key`, or `None` if the text has no such
    /// value.
    #[must_use]
    pub fn written(&self, key: &str) -> Option<&str> {
        let located = self.find(key).filter(|located| located.is_value)?;
        self.text.get(located.node.text.clone()?)
    }

    /// Returns the value at the key path `key`, or the innermost value on the way to it. Returns
    /// `None` if the document does not even have the first key.
    pub(super) fn find(&self, key: &str) -> Option<LocatedValue<'_>> {
        let (innermost, is_value) = innermost_value(&self.content().root, key);
        let node = innermost?;
        let place = node.first_element_behind(self.text.len());
        let setting = place.map(|place| place - 1 - self.text.len());
        Some(LocatedValue { node, is_value, setting })
    }
}

/// Value at a key path, or the innermost value on the way to it.
pub(super) struct LocatedValue<'a> {
    pub(super) node: &'a Node,
    /// Whether `node` is the value at the key path.
    pub(super) is_value: bool,
    /// Index of the setting that replaced an element of `node`, if `node` is a list.
    pub(super) setting: Option<usize>,
}

/// Returns the innermost value on the way from `root` along the key path `key`, and whether it is
/// the value at `key`. Returns no value if `root` does not have the first key.
fn innermost_value<'a>(root: &'a Node, key: &str) -> (Option<&'a Node>, bool) {
    let mut node = root;
    let mut innermost = None;
    for KeyPart { name, indices } in key_parts(key) {
        let Some(entry) = node.entry(name) else { return (innermost, false) };
        node = &entry.node;
        innermost = Some(node);
        for index in indices {
            let Value::List(elements) = &node.value else { return (innermost, false) };
            let Some(element) = elements.get(index) else { return (innermost, false) };
            node = element;
            innermost = Some(node);
        }
    }
    (innermost, true)
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
