//! Aliases: key paths of a document that mean other key paths.
//!
//! A document whose keys may be spelt in several ways is decoded after each spelling has taken the
//! place of the key that it means. Messages, places and edits keep the spelling of the text.

use crate::diagnostic::Diagnostic;
use crate::document::Document;
use crate::node::key_path::{KeyPart, key_parts};
use crate::node::{Entry, Node, Value};
use crate::quoting::toml_key;

/// Key path of a document that means another key path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alias {
    /// Key path that the document has.
    pub written: String,
    /// Key path that the spelling stands for.
    pub intended_key: String,
}

impl Document {
    /// Returns the keys of the table at the key path `key`, in the order of the text. The empty
    /// path is the path of the whole document. Returns no keys if there is no table.
    #[must_use]
    pub fn keys(&self, key: &str) -> Vec<&str> {
        let node = if key.is_empty() {
            Some(&self.content().root)
        } else {
            self.find(key).filter(|located| located.is_value).map(|located| located.node)
        };
        let Some(Node { value: Value::Table(entries), .. }) = node else { return Vec::new() };
        let mut entries: Vec<&Entry> = entries.iter().collect();
        entries.sort_by_key(|entry| entry.span.start);
        entries.into_iter().map(|entry| entry.key.as_str()).collect()
    }

    /// Returns the document in which each alias of `aliases` has taken the place of the key path
    /// that it means, one after the other, and the mistakes: values that are there twice. The value
    /// of the second alias of a key path is left out.
    ///
    /// Key paths of the returned document are the intended ones. Its mistakes and edits have the
    /// key paths of the text.
    ///
    /// ```
    /// use drape_input::{Alias, Document};
    ///
    /// #[derive(serde::Deserialize)]
    /// struct Sheet { warp: Values }
    /// #[derive(serde::Deserialize)]
    /// struct Values { stiffness: f64 }
    ///
    /// let alias = Alias { written: "stiffness_warp".into(), intended_key: "warp.stiffness".into() };
    /// let document = Document::new("sheet.toml", "stiffness_warp = 2");
    /// let (document, mistakes) = document.with_aliases(&[alias]);
    /// assert!(mistakes.is_empty());
    /// assert_eq!(document.decode::<Sheet>()?.warp.stiffness, 2.0);
    /// let mistake = document.at("warp.stiffness", "2 is too small");
    /// assert_eq!(mistake.to_string(), "sheet.toml:1:18: stiffness_warp: 2 is too small");
    /// # Ok::<(), drape_input::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn with_aliases(mut self, aliases: &[Alias]) -> (Self, Vec<Diagnostic>) {
        let mut content = self.content().clone();
        let mut mistakes = Vec::new();
        for Alias { written, intended_key } in aliases {
            let text = written_path(&content.root, written);
            let Some(mut entry) = content.root.remove(written) else { continue };
            entry.written = Some(text.clone());

            // Of two values with one meaning the first one stays.
            let (first, is_there) =
                (written_path(&content.root, intended_key), content.root.has(intended_key));
            if is_there {
                let reason = if first == *intended_key {
                    format!("means {intended_key}, which is there too")
                } else {
                    format!("means {intended_key}, as {first} does")
                };
                let help = match entry.node.value {
                    Value::Table(_) => "put the values into one table",
                    _ => "keep one of them",
                };
                let mistake = self.placed(Some(entry.node.span), format!("{text}: {reason}"));
                mistakes.push(Diagnostic { key: Some(text.as_str().into()), ..mistake.help(help) });
            } else {
                content.root.insert(intended_key, entry);
            }
        }
        self.content = content.into();
        (self, mistakes)
    }

    /// Returns the key path that the text has for the value at the key path `key`.
    #[must_use]
    pub fn key_as_written(&self, key: &str) -> String {
        written_path(&self.content().root, key)
    }
}

/// Returns the key path that the text has for the value at the key path `key` in `root`.
fn written_path(root: &Node, key: &str) -> String {
    // Without an alias on the way, the key path is already the one of the text.
    let mut renamed_end = None;
    let parts: Vec<KeyPart<'_>> = key_parts(key).collect();
    let mut node = Some(root);
    for (index, part) in parts.iter().enumerate() {
        let entry = node.and_then(|node| node.entry(part.name));
        if let Some(written) = entry.and_then(|entry| entry.written.as_ref()) {
            renamed_end = Some((index, written));
        }
        node = part.find(node);
    }
    let Some((last, written)) = renamed_end else { return key.to_owned() };

    let mut path = written.clone();
    for (index, part) in parts.iter().enumerate().skip(last) {
        if index > last {
            path.push('.');
            path.push_str(&toml_key(part.name));
        }
        path.extend(part.indices.iter().map(|index| format!("[{index}]")));
    }
    path
}

impl Node {
    /// Returns whether the table has a value at the key path `key`, which has no indices.
    fn has(&self, key: &str) -> bool {
        key_parts(key).try_fold(self, |node, part| Some(&node.entry(part.name)?.node)).is_some()
    }

    /// Removes the entry at the key path `key`, which has no indices.
    fn remove(&mut self, key: &str) -> Option<Entry> {
        let mut names: Vec<KeyPart<'_>> = key_parts(key).collect();
        let last = names.pop()?;
        let mut node = self;
        for part in &names {
            let (entries, place) = node.place(part.name)?;
            node = &mut entries.get_mut(place.ok()?)?.node;
        }
        let (entries, place) = node.place(last.name)?;
        Some(entries.remove(place.ok()?))
    }

    /// Inserts `entry` at the key path `key`, which has no indices. Missing tables are added.
    /// Inserts nothing if the path leads through a value that is no table.
    fn insert(&mut self, key: &str, entry: Entry) -> Option<()> {
        let mut names: Vec<KeyPart<'_>> = key_parts(key).collect();
        let last = names.pop()?;
        let mut node = self;
        for part in &names {
            let (entries, place) = node.place(part.name)?;
            let index = place.unwrap_or_else(|index| {
                let span = entry.span.clone();
                let value = Value::Table(Vec::new());
                let table = Node { span: span.clone(), text: None, value };
                entries.insert(index, Entry::new(part.name.to_owned(), span, table));
                index
            });
            node = &mut entries[index].node;
        }
        let (entries, place) = node.place(last.name)?;
        let index = place.err()?;
        entries.insert(index, Entry { key: last.name.to_owned(), ..entry });
        Some(())
    }

    /// Returns the entries of the table, and the index of the key `name`, or the index at which the
    /// key would stand. Returns `None` if the value is no table.
    fn place(&mut self, name: &str) -> Option<(&mut Vec<Entry>, Result<usize, usize>)> {
        let Value::Table(entries) = &mut self.value else { return None };
        let place = entries.binary_search_by(|entry| entry.key.as_str().cmp(name));
        Some((entries, place))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Alias, Document};

    fn with_aliases(text: &str, aliases: &[(&str, &str)]) -> (Document, Vec<String>) {
        let aliases: Vec<Alias> = aliases
            .iter()
            .map(|(written, intended_key)| Alias {
                written: (*written).into(),
                intended_key: (*intended_key).into(),
            })
            .collect();
        let (document, mistakes) = Document::new("a.toml", text).with_aliases(&aliases);
        (document, mistakes.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn values_move_into_tables_and_keep_their_places() {
        let text = "[Kette]\n\"b 1\" = 2\n[x]\ny = [{ z = 3 }]\n";
        let aliases = [("Kette", "warp"), ("warp.\"b 1\"", "warp.b"), ("x.y", "list")];
        let (document, mistakes) = with_aliases(text, &aliases);
        assert!(mistakes.is_empty(), "{mistakes:?}");
        assert_eq!(document.keys(""), ["warp", "x", "list"]);
        let message_at = |key: &str| document.at(key, "is wrong").to_string();
        assert_eq!(message_at("warp.b"), "a.toml:2:9: Kette.\"b 1\": is wrong");
        assert_eq!(message_at("warp.c"), "a.toml:1:2: Kette.c: is wrong");
        assert_eq!(message_at("list[0].z"), "a.toml:4:12: x.y[0].z: is wrong");
        let edit = document.edit("warp.b", Some("5")).expect("it is in the text");
        assert_eq!((edit.key.as_str(), edit.old.as_deref()), ("Kette.\"b 1\"", Some("2")));
        let text = crate::apply_edits(text, &[edit]).expect("it fits");
        assert!(text.starts_with("[Kette]\n\"b 1\" = 5\n"), "{text}");
    }

    #[test]
    fn a_second_value_is_a_mistake_and_the_first_one_stays() {
        let text = "a = 1\nA = 2\nb = 3\nB = 4\n_b = 5\n";
        let (document, mistakes) = with_aliases(text, &[("A", "a"), ("B", "x.b"), ("_b", "x.b")]);
        let expected = [
            "a.toml:2:5: A: means a, which is there too\n  help: keep one of them",
            "a.toml:5:6: _b: means x.b, as B does\n  help: keep one of them",
        ];
        assert_eq!(mistakes, expected);
        let table: toml::Table = document.decode().expect("the rest is right");
        let expected = "a = 1\nb = 3\nx.b = 4\n".parse::<toml::Table>().expect("TOML");
        assert_eq!(table, expected);
    }

    #[test]
    fn an_alias_that_leads_nowhere_changes_nothing() {
        let (document, mistakes) = with_aliases("a = 1\n", &[("b", "c"), ("a.b", "c")]);
        assert!(mistakes.is_empty(), "{mistakes:?}");
        assert_eq!(document.keys(""), ["a"]);
        assert_eq!(document.keys("a"), [""; 0]);
    }
}
