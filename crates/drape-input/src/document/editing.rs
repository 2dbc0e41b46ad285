//! Edits of the text of a document.

use crate::diagnostic::edit::Edit;
use crate::document::Document;

impl Document {
    /// Returns the edit that replaces the value at the key path `key` by `new`, in TOML, or removes
    /// the value if `new` is `None`.
    ///
    /// Returns `None` if `new` is `None` and there is no value to remove: the value is not in the
    /// text, was set, or is a table with a heading.
    #[must_use]
    pub fn edit(&self, key: &str, new: Option<&str>) -> Option<Edit> {
        let old = match self.find(key) {
            Some(located) if located.is_value => {
                let text = located.node.text.clone().filter(|_| located.setting.is_none());
                Some(text.and_then(|span| self.text.get(span))?.to_owned())
            }
            _ => None,
        };
        let (file, key) = (self.path.clone(), self.key_as_written(key));
        (old.is_some() || new.is_some()).then(|| Edit {
            file,
            key,
            old,
            new: new.map(str::to_owned),
        })
    }

    /// Returns the edits that move the value at the key path `key` to the key path `new`. Returns
    /// no edits if the value is not in the text.
    #[must_use]
    pub fn renamed(&self, key: &str, new: &str) -> Vec<Edit> {
        let Some(located) = self.find(key).filter(|located| located.is_value) else {
            return Vec::new();
        };
        let values = match &located.node.text {
            Some(value) => Some(vec![(String::new(), value.clone())]),
            None => located.node.values(),
        };

        let Some(values) = values else { return Vec::new() };

        // The old key is removed first. A table with a heading moves value by value.
        let file = self.path.clone();
        let old = self.edit(key, None).and_then(|edit| edit.old);
        let (key, new) = (self.key_as_written(key), self.key_as_written(new));
        let mut edits = vec![Edit { file, key, old, new: None }];
        for (path, span) in values {
            let Some(value) = self.text.get(span) else { return Vec::new() };
            let (file, key) = (self.path.clone(), format!("{new}{path}"));
            edits.push(Edit { file, key, old: None, new: Some(value.to_owned()) });
        }
        edits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Curves {
        dt: f64,
        curve: Vec<Curve>,
    }

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Curve {
        file: String,
    }

    #[test]
    fn an_edit_has_the_value_that_stands_there_unless_it_was_set_or_has_a_heading() {
        let text = "a = 1 # one\nb = { c = [2, \"x\"] }\n[d]\ne.f = 3\n[[g]]\nh = 4\n";
        let document = Document::new("a.toml", text);
        let old = |key: &str| document.edit(key, Some("0")).map(|edit| edit.old);
        let some = |text: &str| Some(Some(text.to_owned()));
        assert_eq!([old("a"), old("b.c[1]"), old("d.e.f")], [some("1"), some("\"x\""), some("3")]);
        assert_eq!([old("b"), old("g[0].h")], [some("{ c = [2, \"x\"] }"), some("4")]);
        assert_eq!([old("d.x"), old("g[1].h")], [Some(None), Some(None)]);
        assert_eq!([old("d"), old("d.e"), old("g"), old("g[0]")], [const { None }; 4]);
        assert_eq!(document.edit("d.x", None), None, "there is nothing to remove");
        let set = document.with_settings(&["a=7".parse().expect("it is one")]).expect("it fits");
        assert_eq!(set.edit("a", Some("0")), None);
    }

    #[test]
    fn slips_of_the_pen_have_their_remedies_as_edits() {
        let text = "[[curve]]\nfil = \"x\"\n[[curve]]\nfil = { a = 1 }\nfile = \"y\"\n";
        let document = Document::new("a.toml", format!("dt = 1\n{text}"));
        let mistakes = document.decode::<Curves>().expect_err("there are slips").0;
        let edits = |index: usize| -> Vec<_> {
            let edits = mistakes[index].edits.iter();
            edits
                .map(|edit| (edit.key.as_str(), edit.old.as_deref(), edit.new.as_deref()))
                .collect()
        };
        let of_first =
            [("curve[0].fil", Some("\"x\""), None), ("curve[0].file", None, Some("\"x\""))];
        assert_eq!(edits(0), of_first, "{:?}", mistakes[0]);
        assert_eq!(edits(1), [], "there is a file already: {:?}", mistakes[1]);

        // A table takes all of its values along.
        let text = "[solvr]\nmethod = \"newton\"\nlinear.size = [1, 2] # two\n";
        let edits = Document::new("a.toml", text).renamed("solvr", "solver");
        let changed = crate::apply_edits(text, &edits).expect("they fit");
        let expected = "[solver]\nlinear.size = [1, 2]\nmethod = \"newton\"\n";
        let table = |text: &str| Document::new("a.toml", text).decode::<toml::Table>();
        assert_eq!(table(&changed), table(expected), "{changed}");
    }
}
