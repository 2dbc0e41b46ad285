//! Edits: changes of single values of a TOML file that correct a mistake.
//!
//! A [`Diagnostic`](crate::Diagnostic) has edits beside its remedy in words. [`apply_edits`] makes
//! edits in a text and keeps the comments and the layout of the text.

use std::fmt;
use std::path::PathBuf;

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

use crate::node::key_path::{KeyPart, key_parts};

/// Change of one value of a TOML file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Path of the file, as messages name it.
    pub file: PathBuf,
    /// Key path of the value, such as `seam.side.sides[1][0]`.
    pub key: String,
    /// Present value, in TOML. `None` if the key is to be added, or is a table with a heading.
    pub old: Option<String>,
    /// New value, in TOML. `None` if the key is to be removed.
    pub new: Option<String>,
}

/// Reason why an edit cannot be made in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EditError {
    /// The text is not valid TOML.
    Grammar,
    /// The new value is not valid TOML.
    Value {
        /// Key path of the edit.
        key: String,
    },
    /// The key path leads through a value that is no table, or to an element that does not exist.
    Place {
        /// Key path of the edit.
        key: String,
    },
    /// The present value differs from the old value: the text was changed since the mistake was
    /// found.
    Changed {
        /// Key path of the edit.
        key: String,
    },
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Grammar => f.write_str("the text has mistakes of grammar: correct them first"),
            Self::Value { key } => write!(f, "{key}: the new value is no TOML"),
            Self::Place { key } => write!(f, "{key}: the text has no place for it"),
            Self::Changed { key } => write!(f, "{key}: the text was changed: read it again"),
        }
    }
}

impl std::error::Error for EditError {}

/// Returns `text`, which is TOML, after the `edits` were made one after the other. The field `file`
/// of the edits is ignored.
///
/// ```
/// use drape_input::{Edit, apply_edits};
///
/// let text = "[seam.side]  # of the skirt\nsides = [[\"a.left\"], [\"b.right\"]]\n";
/// let (file, key) = ("skirt.toml".into(), "seam.side.reversed".into());
/// let edit = Edit { file, key, old: None, new: Some("true".into()) };
/// let expected = format!("{text}reversed = true\n");
/// assert_eq!(apply_edits(text, &[edit]), Ok(expected));
/// ```
///
/// # Errors
/// [`EditError`] for the first edit that does not fit the text.
pub fn apply_edits(text: &str, edits: &[Edit]) -> Result<String, EditError> {
    let mut document: DocumentMut = text.parse().map_err(|_| EditError::Grammar)?;
    for edit in edits {
        edit.apply(document.as_table_mut())?;
    }
    Ok(document.to_string())
}

/// Value in a document that may contain the value to be edited.
enum Container<'a> {
    /// Table with a heading or with dotted keys.
    Table(&'a mut Table),
    /// List of tables with headings.
    Tables(&'a mut ArrayOfTables),
    /// Table in braces.
    Inline(&'a mut InlineTable),
    /// Any other value, such as a list in brackets.
    Value(&'a mut Value),
}

/// Step of a key path.
enum KeyStep<'a> {
    Key(&'a str),
    Index(usize),
}

impl Edit {
    /// Makes the edit in the document `root`.
    fn apply(&self, root: &mut Table) -> Result<(), EditError> {
        let new = self.new.as_deref().map(str::parse::<Value>).transpose();
        let new = new.map_err(|_| EditError::Value { key: self.key.clone() })?;

        let mut steps: Vec<KeyStep<'_>> = Vec::new();
        let path: Vec<KeyPart<'_>> = key_parts(&self.key).collect();
        for KeyPart { name, indices } in &path {
            steps.push(KeyStep::Key(name));
            steps.extend(indices.iter().map(|index| KeyStep::Index(*index)));
        }

        let last = steps.pop().ok_or_else(|| self.misplaced())?;
        let mut container = Container::Table(root);
        for step in &steps {
            container = container.enter(step, new.is_some()).ok_or_else(|| self.misplaced())?;
        }
        if container.text(&last).as_deref().map(str::trim) != self.old.as_deref().map(str::trim) {
            return Err(EditError::Changed { key: self.key.clone() });
        }
        container.set(&last, new).ok_or_else(|| self.misplaced())
    }

    /// Returns the error of an edit whose key path leads nowhere.
    fn misplaced(&self) -> EditError {
        EditError::Place { key: self.key.clone() }
    }
}

impl<'a> Container<'a> {
    /// Returns the value to which `step` leads. If `adds` is set, a missing table is added.
    fn enter(self, step: &KeyStep<'_>, adds: bool) -> Option<Self> {
        match (self, step) {
            (Self::Table(table), KeyStep::Key(key)) => {
                if adds && !table.contains_key(key) {
                    // The new table is written like the table around it.
                    let mut added = Table::new();
                    added.set_implicit(true);
                    added.set_dotted(table.is_dotted());
                    table.insert(key, Item::Table(added));
                }
                Self::from_item(table.get_mut(key)?)
            }
            (Self::Tables(tables), KeyStep::Index(index)) => {
                tables.get_mut(*index).map(Self::Table)
            }
            (Self::Inline(table), KeyStep::Key(key)) => {
                if adds && !table.contains_key(key) {
                    table.insert(*key, Value::InlineTable(InlineTable::new()));
                }
                table.get_mut(key).map(Self::from_value)
            }
            (Self::Value(value), KeyStep::Index(index)) => {
                value.as_array_mut()?.get_mut(*index).map(Self::from_value)
            }
            _ => None,
        }
    }

    /// Returns the container of `item`, or `None` if `item` is empty.
    fn from_item(item: &'a mut Item) -> Option<Self> {
        match item {
            Item::Table(table) => Some(Self::Table(table)),
            Item::ArrayOfTables(tables) => Some(Self::Tables(tables)),
            Item::Value(value) => Some(Self::from_value(value)),
            Item::None => None,
        }
    }

    /// Returns the container of `value`.
    fn from_value(value: &'a mut Value) -> Self {
        match value {
            Value::InlineTable(table) => Self::Inline(table),
            value => Self::Value(value),
        }
    }

    /// Returns the TOML text of the value to which `step` leads. Returns `None` if there is no
    /// value, or if the value is a table with a heading.
    fn text(&self, step: &KeyStep<'_>) -> Option<String> {
        let value = match (self, step) {
            (Self::Table(table), KeyStep::Key(key)) => table.get(key)?.as_value()?,
            (Self::Inline(table), KeyStep::Key(key)) => table.get(key)?,
            (Self::Value(value), KeyStep::Index(index)) => value.as_array()?.get(*index)?,
            _ => return None,
        };
        Some(value.clone().decorated("", "").to_string())
    }

    /// Sets the value to which `step` leads to `new`, or removes the value if `new` is `None`.
    /// Returns `None` if `step` leads nowhere.
    fn set(self, step: &KeyStep<'_>, new: Option<Value>) -> Option<()> {
        // A value that exists keeps the spaces and comments around it.
        match (self, step, new) {
            (Self::Table(table), KeyStep::Key(key), Some(new)) => {
                match table.get_mut(key) {
                    Some(item) => replace(item.as_value_mut()?, new),
                    None => _ = table.insert(key, Item::Value(new)),
                }
                Some(())
            }
            (Self::Table(table), KeyStep::Key(key), None) => table.remove(key).map(drop),
            (Self::Inline(table), KeyStep::Key(key), Some(new)) => {
                match table.get_mut(key) {
                    Some(value) => replace(value, new),
                    None => _ = table.insert(*key, new),
                }
                Some(())
            }
            (Self::Inline(table), KeyStep::Key(key), None) => table.remove(key).map(drop),
            (Self::Value(value), KeyStep::Index(index), Some(new)) => {
                replace(value.as_array_mut()?.get_mut(*index)?, new);
                Some(())
            }
            (Self::Value(value), KeyStep::Index(index), None) => {
                let list = value.as_array_mut()?;
                (*index < list.len()).then(|| _ = list.remove(*index))
            }
            _ => None,
        }
    }
}

/// Replaces `value` by `new`, and keeps the spaces and comments around `value`.
fn replace(value: &mut Value, mut new: Value) {
    new.decor_mut().clone_from(value.decor());
    *value = new;
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"# A garment.
spacing = 0.02   # coarse
[[garment]]
pattern = "tube.toml"
panel.back.turn = [0, 180, 0]
[[panel]]
name = "mat"
motion = { times = [0, 1], shift = [[0, 0, 0], [0, 0, 8]] }
"#;

    fn edit(key: &str, old: Option<&str>, new: Option<&str>) -> Edit {
        let text = |value: Option<&str>| value.map(str::to_owned);
        Edit { file: "a.toml".into(), key: key.into(), old: text(old), new: text(new) }
    }

    /// Makes an edit and returns the lines that are new.
    fn made(key: &str, old: Option<&str>, new: Option<&str>) -> Vec<String> {
        let text = apply_edits(TEXT, &[edit(key, old, new)]).expect("it fits");
        let is_new = |line: &&str| !line.is_empty() && !TEXT.lines().any(|old| old == *line);
        text.lines().filter(is_new).map(str::to_owned).collect()
    }

    #[test]
    fn an_edit_changes_one_value_and_leaves_the_rest() {
        assert_eq!(made("spacing", Some("0.02"), Some("0.01")), ["spacing = 0.01   # coarse"]);
        let to = ["motion = { times = [0, 1], shift = [[0, 0, 0], [0, 0, 4]] }"];
        assert_eq!(made("panel[0].motion.shift[1][2]", Some("8"), Some("4")), to);
        assert_eq!(
            made("garment[0].panel.back.center", None, Some("[0, 0.5, 0]")),
            ["panel.back.center = [0, 0.5, 0]"]
        );
        assert_eq!(
            made("contact.surfaces", None, Some("false")),
            ["[contact]", "surfaces = false"]
        );
        let to = ["motion = { shift = [[0, 0, 0], [0, 0, 8]] }"];
        assert_eq!(made("panel[0].motion.times", Some("[0, 1]"), None), to);
    }

    #[test]
    fn an_edit_is_refused_where_it_does_not_fit() {
        let refused =
            |text: &str, edit: Edit| apply_edits(text, &[edit]).expect_err("it does not fit");
        let key = || "spacing".to_owned();
        let stale = refused(TEXT, edit("spacing", Some("0.03"), Some("0.01")));
        assert_eq!(stale, EditError::Changed { key: key() });
        let added = refused(TEXT, edit("spacing", None, Some("0.01")));
        assert_eq!(added, EditError::Changed { key: key() });
        let wrong = refused(TEXT, edit("spacing", Some("0.02"), Some("0,01")));
        assert_eq!(wrong, EditError::Value { key: key() });
        let nowhere = refused(TEXT, edit("spacing.x", None, Some("1")));
        assert_eq!(nowhere, EditError::Place { key: "spacing.x".into() });
        assert_eq!(refused("a = = 1", edit("a", None, Some("1"))), EditError::Grammar);
    }
}
