//! Settings: values of keys that replace values of a text.

use std::fmt;

use toml::de::DeTable;

use crate::figure::excerpt;
use crate::node::{Entry, Node, Value};

/// Value that replaces the value at a key of a text, such as `time.end=2.0` on a command line.
///
/// The key is a path of names and numbers with dots between them, such as `panel.0.rectangle`.
/// Messages write this key as `panel[0].rectangle`, which is accepted too. A name with dots in it
/// is quoted. The value is TOML: texts are in quotes.
///
/// ```
/// use drape_input::{Document, Setting};
///
/// let step = "time.step=0.01".parse::<Setting>().expect("a key and a value");
/// let document = Document::new("scene.toml", "[time]\nstep = 0.005\n").with_settings(&[step])?;
/// let scene: toml::Table = document.decode()?;
/// assert_eq!(scene["time"]["step"].as_float(), Some(0.01));
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
#[derive(Debug, Clone)]
pub struct Setting {
    /// Names and numbers of the key.
    path: Vec<String>,
    /// Key as it was written.
    key: String,
    /// Value as it was written.
    value: String,
    node: Node,
    /// Origin of the setting, as messages name it.
    origin: String,
}

/// Mistake in a setting, with its remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingError {
    /// Description of the mistake.
    pub message: String,
    /// Remedy for the user.
    pub help: String,
}

impl Setting {
    /// Creates a setting from `key` and `value`, which is TOML.
    ///
    /// # Errors
    /// [`SettingError`] if `key` is not a path of names and numbers, or `value` is not TOML.
    pub fn new(key: &str, value: &str) -> Result<Self, SettingError> {
        let (key, value) = (key.trim(), value.trim());
        let path = path(key).ok_or_else(|| SettingError {
            message: format!("\"{}\" is no key", excerpt(key)),
            help: "write names and numbers with dots between them, such as panel.0.rectangle; a \
                   name with dots in it stands in quotes"
                .into(),
        })?;

        // A value with a line break could add further keys: the text must have a single entry.
        let text = format!("value = {value}\n");
        let table = DeTable::parse(&text).ok().map(|table| Node::root(table.get_ref()));
        let node = table.and_then(|table| match table.value {
            Value::Table(mut entries) if entries.len() == 1 => entries.pop(),
            _ => None,
        });
        let node = node.ok_or_else(|| SettingError {
            message: format!("\"{}\" is no value of TOML", excerpt(value)),
            help: format!(
                "write a number, true or false, a list such as [1, 2], or a text in quotes: \
                 '{}=\"{}\"'",
                excerpt(key),
                excerpt(value.trim_matches(['"', '\'']))
            ),
        })?;

        let origin = "set on the command line".into();
        Ok(Self { path, key: key.into(), value: value.into(), node: node.node, origin })
    }

    /// Returns the setting with the given `origin`, which messages name. Without this call the
    /// origin is "set on the command line".
    #[must_use]
    pub fn with_origin(self, origin: &str) -> Self {
        Self { origin: origin.into(), ..self }
    }

    /// Returns the origin, such as "set on the command line", as messages name it.
    #[must_use]
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Returns the key as it was given to [`new`](Self::new).
    #[must_use]
    pub fn key(&self) -> &str {
        &self.key
    }

    /// Returns the value as it was given to [`new`](Self::new).
    #[must_use]
    pub fn value(&self) -> &str {
        &self.value
    }

    /// Puts the value into `root`, the content of a text. New values have the place `place`, which
    /// stands for the setting.
    pub(crate) fn apply(&self, root: &mut Node, place: usize) -> Result<(), SettingError> {
        let mut value = self.node.clone();
        value.move_to(place);
        let mut node = root;
        let mut outer = String::new();
        for name in &self.path {
            let kind = node.kind();
            node = match &mut node.value {
                Value::Table(entries) => child(entries, name, place),
                Value::List(elements) => element(elements, name, &outer)?,
                _ => {
                    let message = format!("{outer} is {kind}, and no table");
                    return Err(SettingError { message, help: format!("set {outer} itself") });
                }
            };
            outer = if outer.is_empty() { name.clone() } else { format!("{outer}.{name}") };
        }
        *node = value;
        Ok(())
    }
}

impl std::str::FromStr for Setting {
    type Err = SettingError;

    fn from_str(text: &str) -> Result<Self, SettingError> {
        let mut quoted = false;
        let equals = text.find(|letter| {
            quoted ^= letter == '"';
            letter == '=' && !quoted
        });
        let (key, value) = equals.map(|at| (&text[..at], &text[at + 1..])).ok_or_else(|| {
            let message = format!("\"{}\" has no =", excerpt(text));
            SettingError { message, help: "write KEY=VALUE, such as time.end=2.0".into() }
        })?;
        Self::new(key, value)
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}

impl fmt::Display for SettingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message, self.help)
    }
}

impl std::error::Error for SettingError {}

/// Returns the value of the key `name` of a table with the given `entries`. If there is none, an
/// empty table with the place `place` is added.
fn child<'a>(entries: &'a mut Vec<Entry>, name: &str, place: usize) -> &'a mut Node {
    let index = entries.binary_search_by(|entry| entry.key.as_str().cmp(name));
    let index = index.unwrap_or_else(|index| {
        let node = Node { span: place..place, text: None, value: Value::Table(Vec::new()) };
        entries.insert(index, Entry::new(name.into(), place..place, node));
        index
    });
    &mut entries[index].node
}

/// Returns the element with the number `name` of the list at the key path `outer`.
fn element<'a>(
    elements: &'a mut [Node],
    name: &str,
    outer: &str,
) -> Result<&'a mut Node, SettingError> {
    let count = elements.len();
    let Ok(index) = name.parse::<usize>() else {
        let message = format!("{outer} is a list, and \"{}\" is no number", excerpt(name));
        let help = format!("write the number of an element, from 0, such as {outer}.0");
        return Err(SettingError { message, help });
    };
    elements.get_mut(index).ok_or_else(|| match count {
        0 => SettingError {
            message: format!("{outer} is an empty list"),
            help: format!("set {outer} itself"),
        },
        _ => SettingError {
            message: format!("{outer} has no element {index}"),
            help: format!("its elements have the numbers 0 to {}", count - 1),
        },
    })
}

/// Returns the names and numbers of `key`, or `None` if it is no key path.
fn path(key: &str) -> Option<Vec<String>> {
    let mut steps = Vec::new();
    let mut rest = key;
    loop {
        // A name ends at a dot or bracket, or at the closing quote.
        let name;
        let is_quoted = rest.starts_with('"');
        (name, rest) = match rest.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"')?,
            None => rest.split_at(rest.find(['.', '[']).unwrap_or(rest.len())),
        };
        let name = name.trim();
        if name.is_empty() || (!is_quoted && name.contains(['"', ']', '='])) {
            return None;
        }
        steps.push(name.to_owned());

        // Numbers in brackets may follow the name.
        while let Some(bracket) = rest.strip_prefix('[') {
            let (number, after) = bracket.split_once(']')?;
            steps.push(number.trim().parse::<usize>().ok()?.to_string());
            rest = after;
        }

        if rest.is_empty() {
            return Some(steps);
        }
        rest = rest.strip_prefix('.')?;
    }
}

#[cfg(test)]
mod tests {
    use crate::{Document, Setting};

    const TEXT: &str = "a = 1\n[time]\nstep = 0.1 # s\n[[panel]]\nname = \"p\"\nsize = [1, 2]\n";

    fn with(settings: &[&str]) -> Result<String, String> {
        let settings: Result<Vec<Setting>, _> = settings.iter().map(|text| text.parse()).collect();
        let settings = settings.map_err(|error| error.to_string())?;
        let document = Document::new("s.toml", TEXT).with_settings(&settings);
        let document = document.map_err(|mistakes| mistakes.to_string())?;
        let table: toml::Table = document.decode().map_err(|mistakes| mistakes.to_string())?;
        Ok(toml::to_string(&table).expect("a table is TOML").replace('\n', " "))
    }

    #[test]
    fn values_take_the_place_of_those_of_the_text() {
        let set = |text| with(&[text]).expect("it can be set");
        assert!(set("time.step=0.2").contains("step = 0.2"));
        assert!(set("panel.0.size.1 = 5").contains("size = [1, 5]"));
        assert!(set("panel[0].size=[3]").contains("size = [3]"));
        assert!(set("settle.speed=1e-3").contains("[settle] speed = 0.001"));
        assert!(set("\"a.b\".c='x=y'").contains("[\"a.b\"] c = \"x=y\""));
        assert!(set("\"a=b\".\"c]\"=2").contains("[\"a=b\"] \"c]\" = 2"));
        assert!(with(&["a=2", "a=3"]).expect("the last one stays").contains("a = 3"));
    }

    #[test]
    fn a_document_keeps_its_settings_in_their_order() {
        let settings = ["time.step=0.2", "a = 3"].map(|text| text.parse().expect("a setting"));
        let document = Document::new("s.toml", TEXT);
        assert!(document.settings().is_empty());
        let document = document.with_settings(&settings).expect("they can be set");
        let kept: Vec<String> = document.settings().iter().map(Setting::to_string).collect();
        assert_eq!(kept, ["time.step=0.2", "a=3"]);
    }

    #[test]
    fn a_setting_that_is_none_has_a_remedy() {
        for (text, part) in [
            ("time.step", "has no ="),
            ("time..step=1", "is no key"),
            ("panel[x].size=1", "is no key"),
            ("=1", "is no key"),
            ("a]=1", "is no key"),
            ("model=kes", "'model=\"kes\"'"),
            ("a=1\nb=2", "is no value"),
            ("a=", "is no value"),
            ("panel.1.size=1", "numbers 0 to 0"),
            ("panel.p.size=1", "such as panel.0"),
            ("time.step.x=1", "set time.step itself"),
        ] {
            let error = with(&[text]).expect_err("it is wrong");
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(with(&["model=\"kes\"", "panel.0.size=1", "time.step=1"]).is_ok());
    }

    #[test]
    fn places_of_the_rest_stay_and_what_was_set_is_named() {
        let set: Setting = "time.end=-1".parse().expect("a setting");
        let document = Document::new("s.toml", TEXT).with_settings(&[set]).expect("it can be set");
        let rest = document.at("panel[0].size", "too small");
        assert_eq!((rest.line, rest.column), (Some(6), Some(8)));
        let mistake = document.at("time.end", "-1 s is in the past");
        assert_eq!((mistake.line, &mistake.span), (None, &None));
        let origin = "set on the command line: time.end=-1";
        assert!(mistake.message.contains(origin), "{mistake}");
        // A mistake of a list of which an element was set has its line, and names what was set.
        let set: Setting = "panel.0.size.1=-2".parse().expect("a setting");
        let set = set.with_origin("set by the study");
        let document = Document::new("s.toml", TEXT).with_settings(&[set]).expect("it can be set");
        let mistake = document.at("panel[0].size", "too small");
        assert_eq!(mistake.line, Some(6));
        let end = "too small (set by the study: panel.0.size.1=-2)";
        assert!(mistake.message.ends_with(end), "{mistake}");
        assert_eq!(document.at("panel[0].name", "wrong").message, "panel[0].name: wrong");
    }
}
