//! JSON Schemas as tables of keys.
//!
//! A schema says of a key what it holds, its range, its default, and in its description the rest:
//! its unit as `…, in UNIT.` at the end of a sentence, and what takes its place as `…; DEFAULT if
//! missing.`.

use std::collections::VecDeque;

use serde_json::Value;

/// Key of a table, with all that its schema says of it.
#[derive(Debug, Clone, Default)]
pub struct Key {
    pub name: String,
    /// Kind of the value and its unit, in words.
    pub kind: String,
    pub range: String,
    pub default: String,
    pub description: String,
}

/// Table of keys.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Headers in TOML by which the table is written, such as `[[panel]]`; none of the whole file.
    pub headers: Vec<String>,
    pub description: String,
    pub keys: Vec<Key>,
}

/// Schema of a file.
#[derive(Debug, Clone, Copy)]
pub struct Schema<'a>(pub &'a Value);

/// Table that is yet to be read: its header, and its schema.
struct Open<'a> {
    path: String,
    list: bool,
    name: String,
    schema: &'a Value,
    description: String,
}

impl<'a> Schema<'a> {
    /// Returns the tables, the whole file first, each schema once with all of its headers.
    pub fn tables(self) -> Vec<Table> {
        let whole = Open {
            path: String::new(),
            list: false,
            name: String::new(),
            schema: self.0,
            description: text(&self.0["description"]),
        };
        let (mut tables, mut names): (Vec<Table>, Vec<String>) = (Vec::new(), Vec::new());
        let mut open = VecDeque::from([whole]);
        while let Some(own) = open.pop_front() {
            let header = match (own.path.as_str(), own.list) {
                ("", _) => None,
                (path, true) => Some(format!("[[{path}]]")),
                (path, false) => Some(format!("[{path}]")),
            };
            let known = names.iter().position(|name| !name.is_empty() && *name == own.name);
            if let Some(known) = known {
                tables[known].headers.extend(header);
                continue;
            }
            let mut table = Table {
                headers: header.into_iter().collect(),
                description: own.description.clone(),
                keys: Vec::new(),
            };
            let mut inner = Vec::new();
            let properties = own.schema["properties"].as_object().expect("a table has keys");
            for (name, schema) in properties {
                table.keys.push(self.key(own.schema, name, schema));
                inner.extend(self.inner(&own.path, name, schema));
            }
            tables.push(table);
            names.push(own.name);
            // Depth first: the tables in a table follow it.
            inner.into_iter().rev().for_each(|inner| open.push_front(inner));
        }
        tables
    }

    /// Follows a reference.
    fn followed(self, schema: &'a Value) -> (&'a Value, &'a str) {
        let name = schema["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/"));
        name.map_or((schema, ""), |name| (&self.0["$defs"][name], name))
    }

    /// Returns the table that a key opens, if it does.
    fn inner(self, path: &str, key: &str, schema: &'a Value) -> Option<Open<'a>> {
        let dotted = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        let (own, name) = self.followed(schema);
        let opened = |path: String, list: bool, schema: &'a Value, name: &str| Open {
            path,
            list,
            name: name.to_owned(),
            schema,
            description: text(&schema["description"]),
        };
        if own["properties"].is_object() {
            return Some(opened(dotted, false, own, name));
        }
        let choices = own["anyOf"].as_array().into_iter().flatten();
        for (choice, name) in choices.map(|choice| self.followed(choice)) {
            if choice["properties"].is_object() {
                return Some(opened(dotted, false, choice, name));
            }
        }
        let (item, name) = self.followed(&own["items"]);
        if item["properties"].is_object() {
            return Some(opened(dotted, true, item, name));
        }
        let (value, name) = self.followed(&own["additionalProperties"]);
        value["properties"]
            .is_object()
            .then(|| opened(format!("{dotted}.NAME"), false, value, name))
    }

    /// Reads a key of a table.
    fn key(self, table: &Value, name: &str, schema: &'a Value) -> Key {
        let description = text(&schema["description"]);
        let (description, missing) = split_default(&description);
        let (kind, unit) = self.kind(schema);
        let unit = stated_unit(&description).unwrap_or(unit);
        let kind = if unit.is_empty() { kind } else { format!("{kind}, {unit}") };
        Key {
            name: name.to_owned(),
            kind,
            range: self.range(schema),
            default: default(table, name, schema, missing),
            description,
        }
    }

    /// Returns the kind of a value, and its unit.
    fn kind(self, schema: &'a Value) -> (String, String) {
        let (own, name) = self.followed(schema);
        let plain = |kind: &str| (kind.to_owned(), String::new());
        if own["enum"].is_array() || own["const"].is_string() {
            return plain("word");
        }
        if own["properties"].is_object() {
            return plain("table");
        }
        if let Some(choices) = own["anyOf"].as_array() {
            if choices.iter().any(|choice| choice["pattern"].is_string()) {
                return dimension(name, &text(&own["description"]));
            }
            let mut kinds: Vec<String> = choices.iter().map(|own| self.kind(own).0).collect();
            kinds.dedup();
            return plain(&kinds.join(" or "));
        }
        match own["type"].as_str() {
            Some("array") => self.list(own),
            Some("object") => {
                let (value, _) = self.followed(&own["additionalProperties"]);
                let (kind, unit) = self.kind(&own["additionalProperties"]);
                match value["properties"].is_object() {
                    true => plain("tables by names"),
                    false => (format!("{} by names", plural(&kind)), unit),
                }
            }
            Some("string") => plain("text"),
            Some("boolean") => plain("`true`, `false`"),
            Some("integer") => plain("whole number"),
            Some("number") => plain("number"),
            _ if own["const"].is_boolean() => plain("`false`"),
            _ if own.as_bool() == Some(true) => plain("value"),
            _ => panic!("a kind that the reference has no word for: {own}"),
        }
    }

    /// Returns the kind of a list, and the unit of what is in it.
    fn list(self, own: &'a Value) -> (String, String) {
        let (item, _) = self.followed(&own["items"]);
        let (kind, unit) = self.kind(&own["items"]);
        let many = plural(&kind);
        let kind = match (own["minItems"].as_u64(), own["maxItems"].as_u64()) {
            (Some(least), Some(most)) if least == most => format!("{least} {many}"),
            _ if item["properties"].is_object() => "list of tables".into(),
            _ if kind.contains(" or ") => "list of such".into(),
            _ => format!("list of {many}"),
        };
        (kind, unit)
    }

    /// Returns the range of a value, or the words that it may be.
    fn range(self, schema: &'a Value) -> String {
        let (own, _) = self.followed(schema);
        if let Some(words) = own["enum"].as_array() {
            return words
                .iter()
                .map(|word| format!("`{}`", toml_value(word)))
                .collect::<Vec<_>>()
                .join(", ");
        }
        if own["items"].is_object() {
            let count = match (own["minItems"].as_u64(), own["maxItems"].as_u64()) {
                (None, Some(most)) => format!("at most {most}"),
                _ => String::new(),
            };
            let each = self.range(&own["items"]);
            return if count.is_empty() { each } else { count };
        }
        // A reference may stand beside the limits.
        let limit = |key: &str| schema[key].as_f64().or(own[key].as_f64());
        if let (Some(least), Some(most)) = (limit("leastMetres"), limit("mostMetres")) {
            return format!("{} m to {} m", figure(least), figure(most));
        }
        let least =
            limit("minimum").map(|x| ("≥", x)).or(limit("exclusiveMinimum").map(|x| (">", x)));
        let most =
            limit("maximum").map(|x| ("≤", x)).or(limit("exclusiveMaximum").map(|x| ("<", x)));
        match (least, most) {
            (Some(("≥", least)), Some(("≤", most))) => {
                format!("{} to {}", figure(least), figure(most))
            }
            (least, most) => {
                let told =
                    least.into_iter().chain(most).map(|(sign, x)| format!("{sign} {}", figure(x)));
                told.collect::<Vec<_>>().join(", ")
            }
        }
    }
}

/// Returns the text of a value on one line.
fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().replace('\n', " ")
}

/// Returns the kind of a number of a dimension, and the unit of bare ones.
fn dimension(name: &str, description: &str) -> (String, String) {
    let before = description.split(", such as").next().unwrap_or_default();
    let (kind, unit) = before.split_once(", bare in ").unwrap_or((before, ""));
    let kind = if name.is_empty() { "number" } else { kind };
    (kind.to_lowercase(), unit.to_owned())
}

/// Returns the plural of a kind.
fn plural(kind: &str) -> String {
    match kind {
        kind if kind.starts_with("list of ") => kind.replacen("list", "lists", 1),
        kind if kind.starts_with("2 ") => format!("pairs of {}", &kind[2..]),
        kind if kind.ends_with(" by names") => format!("tables of {kind}"),
        kind if kind.starts_with("3 ") => format!("triples of {}", &kind[2..]),
        kind => format!("{kind}s"),
    }
}

/// Returns a number as a person writes it.
fn figure(value: f64) -> String {
    let size = value.abs();
    match size == 0.0 || (1e-3..1e5).contains(&size) {
        true => format!("{value}"),
        false => format!("{value:e}"),
    }
}

/// Splits a description from what takes the place of a key that is missing.
fn split_default(description: &str) -> (String, Option<String>) {
    let Some((before, rest)) = description.split_once(" if missing") else {
        return (description.to_owned(), None);
    };
    let (before, default) = before.rsplit_once("; ").expect("a semicolon before the default");
    (format!("{before}{rest}"), Some(default.to_owned()))
}

/// Returns the unit that a description states at the end of a sentence or a part of it.
fn stated_unit(description: &str) -> Option<String> {
    const UNITS: [&str; 22] = [
        "m",
        "s",
        "degrees",
        "degrees/s",
        "m/s",
        "m/s²",
        "kg/m²",
        "kg/m³",
        "N/m",
        "N/m³",
        "N·m",
        "N",
        "1/m",
        "mm",
        "µm",
        "percent",
        "mg/cm²",
        "gf·cm/cm²",
        "gf/cm",
        "gf·cm/cm",
        "gf·cm²/cm",
        "gf/(cm·deg)",
    ];
    let places =
        description.match_indices(", in ").map(|(at, found)| &description[at + found.len()..]);
    let units = places.filter_map(|rest| {
        let rest = rest
            .strip_prefix("the unit of the file per second")
            .map(|_| "unit of the file/s")
            .or_else(|| {
                UNITS.into_iter().find(|unit| {
                    rest.strip_prefix(unit).is_some_and(|after| {
                        after.is_empty()
                            || after.starts_with(['.', ',', ';', ':']) && !after.starts_with(".c")
                    })
                })
            });
        rest.map(str::to_owned)
    });
    units.last()
}

/// Returns what a key is where a file does not have it.
fn default(table: &Value, name: &str, schema: &Value, missing: Option<String>) -> String {
    let names =
        |list: &Value| list.as_array().is_some_and(|list| list.iter().any(|own| own == name));
    if names(&table["required"]) {
        return "**required**".into();
    }
    if let Some(missing) = missing {
        return missing;
    }
    let value = &schema["default"];
    if !value.is_null()
        && *value != serde_json::json!([])
        && *value != serde_json::json!({})
        && value != ""
    {
        let value = toml_value(value);
        return format!("`{value}`");
    }
    let choices = table["oneOf"].as_array().into_iter().flatten();
    if choices.into_iter().any(|choice| names(&choice["required"])) {
        return "one of the two".into();
    }
    "none".into()
}

/// Returns a value as TOML writes it.
fn toml_value(value: &Value) -> String {
    match value {
        Value::Array(items) => {
            format!("[{}]", items.iter().map(toml_value).collect::<Vec<_>>().join(", "))
        }
        Value::Number(number) => figure(number.as_f64().expect("a number of a file")),
        other => other.to_string(),
    }
}
