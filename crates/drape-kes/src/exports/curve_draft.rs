//! Draft of a `[[curve]]`: keys with their reasons, verified by the reader of sheets.

use drape_input::{Diagnostics, Document, toml_string};

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::exports::evidence::Reasoned;
use crate::exports::files::Files;
use crate::sheets::sheet::Sheet;
use crate::test::{Direction, Test};

/// Column of the comments behind keys.
const COMMENTS: usize = 34;

/// Key of a sheet with its value as TOML, and the reason for it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    pub(crate) name: &'static str,
    pub(crate) value: String,
    pub(crate) why: String,
}

impl Key {
    /// Returns the key `name` with `value` as TOML, for the reason `why`.
    pub(crate) fn new(
        name: &'static str,
        value: impl Into<String>,
        why: impl Into<String>,
    ) -> Self {
        Self { name, value: value.into(), why: why.into() }
    }
}

/// Drafted `[[curve]]`.
#[derive(Clone, Debug)]
pub(crate) struct CurveDraft {
    pub(crate) test: Reasoned<Test>,
    /// Direction, or the reason why none is known.
    pub(crate) direction: Result<Reasoned<Direction>, String>,
    /// Names of the files, relative to the folder of the sheet.
    pub(crate) files: Vec<String>,
    /// Keys of the layout.
    pub(crate) layout: Vec<Key>,
    /// Keys of the deformation and of the load.
    pub(crate) axes: [Vec<Key>; 2],
    /// Remarks above the section.
    pub(crate) remarks: Vec<String>,
}

impl CurveDraft {
    /// Returns the section as TOML.
    pub(crate) fn to_toml(&self) -> String {
        let mut text = String::from("[[curve]]\n");
        self.remarks.iter().for_each(|remark| text += &format!("# {}\n", single_line(remark)));
        text += &line("test", &toml_string(self.test.value.name()), &self.test.why);
        text += &match &self.direction {
            Ok(direction) => {
                line("direction", &toml_string(direction.value.name()), &direction.why)
            }
            Err(reason) => {
                let why = format!("or \"weft\": {reason}");
                line("direction", &toml_string(Direction::Warp.name()), &why)
            }
        };

        let files: Vec<String> = self.files.iter().map(|file| toml_string(file)).collect();
        text += &match files.as_slice() {
            [file] => line("file", file, ""),
            files => {
                let why = "taken for repeats: same test, same direction, same layout";
                line("file", &format!("[{}]", files.join(", ")), why)
            }
        };

        self.layout.iter().for_each(|key| text += &line(key.name, &key.value, &key.why));
        for (name, keys) in ["deformation", "load"].into_iter().zip(&self.axes) {
            if !keys.is_empty() {
                text += &inline_table(name, keys);
            }
        }
        text
    }

    /// Returns the texts about the curve: names of its files, titles of its tables, and reasons.
    pub(crate) fn texts(&self) -> Vec<String> {
        let keys = self.layout.iter().flat_map(|key| [key.value.clone(), key.why.clone()]);
        let direction = self.direction.as_ref().ok().map(|direction| direction.why.clone());
        let reasons = std::iter::once(self.test.why.clone()).chain(direction);
        self.files.iter().cloned().chain(keys).chain(reasons).collect()
    }

    /// Reads the section as the section of a sheet beside `files`.
    pub(crate) fn read(&self, files: &Files) -> Result<Vec<Curve>, Diagnostics> {
        read(&self.to_toml(), files).map(|sheet| sheet.curves)
    }

    /// Returns the section as a comment.
    pub(crate) fn to_comment(&self) -> String {
        comment_out(&self.to_toml())
    }
}

/// Returns the lines of `text` as comments.
pub(crate) fn comment_out(text: &str) -> String {
    text.lines().map(|line| format!("# {line}\n")).collect()
}

/// Reads `text` as a part of a sheet beside `files`.
pub(crate) fn read(text: &str, files: &Files) -> Result<Sheet, Diagnostics> {
    let text = format!("name = \"draft\"\n{text}");
    let document = Document::new(files.folder.join("sheet.toml"), text);
    let document = document.with_access(&files.access);
    Sheet::from_document(&document).map_err(|error| match error {
        Error::Input(mistakes) => mistakes,
        error => document.at("curve", error.to_string()).into(),
    })
}

/// Returns the line `name = value   # why`.
pub(crate) fn line(name: &str, value: &str, why: &str) -> String {
    let key = format!("{name} = {value}");
    let why = single_line(why);
    if why.is_empty() { key + "\n" } else { format!("{key:<COMMENTS$} # {why}\n") }
}

/// Returns the axis `name` as an inline table of `keys`, with the reasons of the keys in the lines
/// above.
fn inline_table(name: &str, keys: &[Key]) -> String {
    let pairs: Vec<String> =
        keys.iter().map(|key| format!("{} = {}", key.name, key.value)).collect();
    let reasons = keys.iter().filter(|key| !key.why.is_empty());
    let reasons: String =
        reasons.map(|key| format!("# {}: {}\n", key.name, single_line(&key.why))).collect();
    format!("{reasons}{name} = {{ {} }}\n", pairs.join(", "))
}

/// Returns `text` without control characters, so that it may stand in a comment of TOML.
pub(crate) fn single_line(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}
