//! Numbers: every numeric key of the schemas, with values that arithmetic stumbles over.

use serde_json::Value as Json;
use toml::{Table, Value};

use crate::guard::{Sweep, is_full};
use crate::readers;

/// Scene with a table of most kinds.
pub const CLOTH: &str = r#"spacing = 0.015
[fabric.plain]
file = "plain.toml"
[[panel]]
name = "cloth"
fabric = "plain"
rectangle = [0.15, 0.15]
center = [0, 0.5, 0]
noise = { amplitude = 1e-4 }
stack = { count = 2, step = [0, 0, 0.1] }
[[panel]]
name = "round"
fabric = "plain"
disc = 0.1
hole = 0.04
center = [3, 0.5, 0]
[[pin]]
panel = "cloth"
edge = "top"
[[pin]]
panel = "round"
points = [[0.05, 0]]
radius = 0.02
[[collider.sphere]]
radius = 0.05
[[collider.box]]
size = [0.1, 0.1, 0.1]
center = [1, 0, 0]
[[collider.cylinder]]
radius = 0.1
height = 0.1
center = [2, 0, 0]
[[collider.plane]]
center = [0, -1, 0]
[air]
[contact]
[time]
step = 0.005
end = 0.05
[solver]
[output]
"#;

/// The same at rest.
const RESTING: &str = "[settle]\n";

/// Pattern of two panels that are sewn.
const PATTERN: &str = r#"length = "mm"
[panel.front]
grain = 0
rectangle = [300, 300]
origin = [0, 0, 0]
[panel.back]
grain = 0
rectangle = [300, 300]
origin = [0, 0, 100]
[seam.side]
sides = [["front.left"], ["back.left"]]
"#;

/// Values as TOML writes them.
const NUMBERS: [&str; 9] =
    ["nan", "inf", "-inf", "-0.0", "5e-324", "1e308", "-1.0", "0.0", "1e-300"];

/// The same for whole numbers.
const WHOLE: [&str; 4] = ["-1", "0", "9223372036854775807", "-9223372036854775808"];

/// Kind of a numeric key.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Float,
    Whole,
}

/// Step on the way to a key.
#[derive(Clone, Debug)]
enum Part {
    Key(String),
    Index(usize),
    /// Any key of a table by names.
    Name,
}

/// Numeric key of a schema.
struct Numeric {
    path: Vec<Part>,
    kind: Kind,
}

/// Reader of a schema.
struct Walk<'a> {
    schema: &'a Json,
    found: Vec<Numeric>,
}

impl<'a> Walk<'a> {
    fn numeric(schema: &'a Json) -> Vec<Numeric> {
        let mut walk = Self { schema, found: Vec::new() };
        walk.visit(schema, &mut Vec::new(), &mut Vec::new());
        walk.found
    }

    fn visit(&mut self, own: &'a Json, path: &mut Vec<Part>, open: &mut Vec<&'a str>) {
        let name = own["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/"));
        if let Some(name) = name {
            // A definition may hold itself.
            if !open.contains(&name) {
                open.push(name);
                self.visit(&self.schema["$defs"][name], path, open);
                open.pop();
            }
            return;
        }
        match own["type"].as_str() {
            Some("number") => self.found.push(Numeric { path: path.clone(), kind: Kind::Float }),
            Some("integer") => self.found.push(Numeric { path: path.clone(), kind: Kind::Whole }),
            _ => {}
        }
        for choice in ["anyOf", "oneOf", "allOf"].iter().filter_map(|key| own[*key].as_array()) {
            choice.iter().for_each(|choice| self.visit(choice, path, open));
        }
        for (key, inner) in own["properties"].as_object().into_iter().flatten() {
            self.inner(Part::Key(key.clone()), inner, path, open);
        }
        if own["items"].is_object() {
            self.inner(Part::Index(0), &own["items"], path, open);
        }
        for (index, item) in own["prefixItems"].as_array().into_iter().flatten().enumerate() {
            self.inner(Part::Index(index), item, path, open);
        }
        if own["additionalProperties"].is_object() {
            self.inner(Part::Name, &own["additionalProperties"], path, open);
        }
    }

    fn inner(
        &mut self,
        part: Part,
        schema: &'a Json,
        path: &mut Vec<Part>,
        open: &mut Vec<&'a str>,
    ) {
        path.push(part);
        self.visit(schema, path, open);
        path.pop();
    }
}

/// Puts a value at a path; tables and lists that are not there are made.
fn put(whole: &mut Value, path: &[Part], value: &Value) {
    let Some((first, rest)) = path.split_first() else {
        *whole = value.clone();
        return;
    };
    match first {
        Part::Index(index) => {
            if !whole.is_array() {
                *whole = Value::Array(Vec::new());
            }
            let items = whole.as_array_mut().expect("a list");
            while items.len() <= *index {
                items.push(Value::Float(0.0));
            }
            // All numbers of a short list have their turn as the first; tables are all changed.
            match rest.is_empty() {
                true => put(&mut items[*index], rest, value),
                false => items.iter_mut().for_each(|item| put(item, rest, value)),
            }
        }
        Part::Key(_) | Part::Name => {
            if !whole.is_table() {
                *whole = Value::Table(Table::new());
            }
            let table = whole.as_table_mut().expect("a table");
            let key = match first {
                Part::Key(key) => key.clone(),
                _ => table.keys().next().cloned().unwrap_or_else(|| "any".to_owned()),
            };
            put(table.entry(key).or_insert(Value::Boolean(false)), rest, value);
        }
    }
}

/// Tries every numeric key of a schema in a text.
fn try_numbers(name: &'static str, schema: &Json, text: &str, reader: fn(&str) -> bool) {
    assert!(reader(text), "{name} is right before it is made wrong:\n{text}");
    let keys = Walk::numeric(schema);
    assert!(keys.len() > 10, "{} keys", keys.len());
    let mut sweep = Sweep::new(name);
    let stride = if is_full() { 1 } else { 5 };
    let values = |kind: Kind| match kind {
        Kind::Float => NUMBERS.iter().chain(&WHOLE[..0]),
        Kind::Whole => WHOLE.iter().chain(&NUMBERS[..0]),
    };
    let cases = keys.iter().flat_map(|key| values(key.kind).map(move |value| (key, *value)));
    for (key, value) in cases.step_by(stride) {
        let parsed: Table = format!("x = {value}").parse().expect("TOML");
        let mut whole = Value::Table(text.parse().expect("TOML"));
        put(&mut whole, &key.path, &parsed["x"]);
        let changed = toml::to_string(&whole).expect("TOML");
        sweep.case(|| format!("{:?} = {value}", key.path), move || reader(&changed));
    }
    sweep.end();
}

fn schema(kind: &str) -> Json {
    let path = readers::shipped("crates/drape/schemas").join(format!("{kind}.json"));
    let text = std::fs::read_to_string(path).expect("it ships");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn of_scenes() {
    let scene = |text: &str| readers::scene(text, readers::FABRIC);
    try_numbers("numbers of a scene", &schema("scene"), CLOTH, scene);
    let resting = format!("{CLOTH}{RESTING}");
    try_numbers("numbers of a scene at rest", &schema("scene"), &resting, scene);
}

#[test]
fn of_fabrics() {
    try_numbers("numbers of a fabric", &schema("fabric"), readers::FABRIC, readers::fabric);
}

#[test]
fn of_sheets() {
    let sheet = |text: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("bending.csv"), readers::CURVE).expect("written");
        std::fs::write(folder.path().join("sheet.toml"), text).expect("written");
        readers::sheet(&folder.path().join("sheet.toml"))
    };
    try_numbers("numbers of a sheet", &schema("sheet"), readers::SHEET, sheet);
}

#[test]
fn of_patterns() {
    let pattern = |text: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("pattern.toml");
        std::fs::write(&file, text).expect("written");
        readers::pattern(&file)
    };
    try_numbers("numbers of a pattern", &schema("pattern"), PATTERN, pattern);
}
