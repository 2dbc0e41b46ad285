//! The page of mistakes as data: files, changes, messages.

use std::collections::BTreeMap;

use drape::input::{Edit, EditError, apply_edits};

/// Files by their names.
#[derive(Debug, Clone, Default)]
pub struct Files(BTreeMap<String, String>);

/// Lines that take the place of others in a file.
#[derive(Debug, Clone, Default)]
pub struct Change {
    file: String,
    old: String,
    new: String,
}

/// Mistake with its answer.
#[derive(Debug, Clone, Default)]
pub struct Mistake {
    pub title: String,
    /// File that is read.
    pub checked: String,
    /// Change that makes the mistake.
    pub change: Change,
    /// Message, word for word.
    pub message: String,
    /// Change that the message advises.
    pub remedy: Change,
}

/// Page of mistakes.
#[derive(Debug, Clone, Default)]
pub struct Page {
    pub files: Files,
    pub mistakes: Vec<Mistake>,
}

impl Files {
    pub fn iter(&self) -> impl Iterator<Item = (&String, &String)> {
        self.0.iter()
    }

    /// Returns the files with a change, in the last place where the old lines are.
    pub fn with(&self, change: &Change) -> Self {
        let mut files = self.clone();
        let text = files.0.get_mut(&change.file).expect("the page has the file");
        let at = text.rfind(&change.old).expect(&change.old);
        text.replace_range(at..at + change.old.len(), &change.new);
        files
    }
}

impl Files {
    /// Returns the files with edits, or why they do not fit.
    pub fn edited(&self, edits: &[Edit]) -> Result<Self, EditError> {
        let mut files = self.clone();
        for edit in edits {
            let name = edit.file.to_str().expect("it is text");
            let text = files.0.get_mut(name).expect("the page has the file");
            *text = apply_edits(text, std::slice::from_ref(edit))?;
        }
        Ok(files)
    }
}

impl Change {
    fn parse(block: &str) -> Self {
        let mut change = Self::default();
        for line in block.lines() {
            let (sign, rest) = line.split_at(1);
            match (sign, rest.strip_prefix("-- ")) {
                ("-", Some(file)) => change.file = file.to_owned(),
                ("-", None) => change.old += &format!("{rest}\n"),
                ("+", _) => change.new += &format!("{rest}\n"),
                _ => panic!("a line of a change begins with - or +: {line:?}"),
            }
        }
        change
    }
}

impl Page {
    /// Reads the page.
    pub fn parse(text: &str) -> Self {
        let mut page = Self::default();
        let (files, mistakes) = text.split_once("\n## Mistakes\n").expect("two chapters");
        let blocks: Vec<&str> = files.split("```").collect();
        for pair in blocks.chunks_exact(2) {
            let name = pair[0].rsplit('`').nth(1).expect("a name before the text");
            page.files.0.insert(name.to_owned(), pair[1].trim_start().to_owned());
        }
        for part in mistakes.split("\n### ").skip(1) {
            let (title, rest) = part.split_once('\n').expect("a title");
            let checked = rest.split('`').nth(1).expect("a file that is checked");
            let block = |kind: &str, number: usize| {
                let block = rest.split(&format!("```{kind}\n")).nth(number).expect(title);
                block.split("\n```").next().expect("it ends")
            };
            page.mistakes.push(Mistake {
                title: title.to_owned(),
                checked: checked.to_owned(),
                change: Change::parse(block("diff", 1)),
                message: block("text", 1).to_owned(),
                remedy: Change::parse(block("diff", 2)),
            });
        }
        page
    }
}
