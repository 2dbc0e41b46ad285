//! JSON Schema of numbers with or without a unit, and functions that all schemas of files use.
//!
//! A schema describes the form of a file: its keys, the kind of each value, and the range of bare
//! numbers. Conditions between different parts of a file are left to the checks.

use std::borrow::Cow;

use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::figure::figure;
use crate::given::{Dimension, Given, TextOr};
use crate::unit::Quantity;

/// Regular expression of a number with or without an exponent.
const NUMBER: &str = r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?";

impl<D: Dimension> JsonSchema for Given<D> {
    fn schema_name() -> Cow<'static, str> {
        let token = D::TOKEN;
        token.rsplit(':').next().unwrap_or(token).into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let quantity = D::QUANTITY;
        let [bare, unit] = D::EXAMPLES;
        let bare_unit = match D::UNIT {
            "" => String::new(),
            words => format!(", bare in {words}"),
        };
        json_schema!({
            "description": format!("{}{bare_unit}, such as {bare} or \"{unit}\"", capital(quantity.name())),
            "unit": resolved_unit(D::UNIT),
            "anyOf": [
                { "type": "number" },
                { "type": "string", "pattern": format!("^{}$", quantity_pattern(quantity)) },
            ],
        })
    }
}

impl<T: JsonSchema> JsonSchema for TextOr<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("TextOr{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let other = generator.subschema_for::<T>();
        json_schema!({ "anyOf": [{ "type": "string" }, other] })
    }
}

/// Returns the unit of a resolved number whose bare numbers are in `bare_unit`, in words.
fn resolved_unit(bare_unit: &str) -> String {
    bare_unit.replace("the unit of the file per second", "m/s").replace("the unit of the file", "m")
}

/// Returns `word` with a capital first letter.
fn capital(word: &str) -> String {
    let (first, others) = word.split_at(word.len().min(1));
    first.to_uppercase() + others
}

/// Returns the regular expression, without anchors, of a number with a unit of `quantity`.
fn quantity_pattern(quantity: Quantity) -> String {
    format!(r"\s*{NUMBER}\s*({})\s*", units_pattern(quantity))
}

/// Returns the regular expression, without anchors, of the units of `quantity`.
fn units_pattern(quantity: Quantity) -> String {
    quantity.spellings().map(spelling_pattern).collect::<Vec<_>>().join("|")
}

/// Returns the schema of a `quantity` in a sheet.
///
/// The value is a bare number in the laboratory's unit, or a text with a number, an optional unit,
/// and an optional standard deviation after `±`.
#[must_use]
pub fn laboratory_schema(quantity: Quantity) -> Value {
    let unit = units_pattern(quantity);
    let number = format!(r"\(?\s*{NUMBER}\s*({unit})?\s*");
    let deviation = format!(r"(±|\+/-|\+-)\s*{NUMBER}\s*(%|{unit})?\s*\)?\s*({unit})?\s*");
    let written = format!("^{number}({deviation})?$");
    json!({ "anyOf": [{ "type": "number" }, { "type": "string", "pattern": written }] })
}

/// Returns the schema of a unit of one of `quantities`.
#[must_use]
pub fn unit_schema(quantities: &[Quantity]) -> Value {
    let units: Vec<String> = quantities.iter().map(|&quantity| units_pattern(quantity)).collect();
    json!({ "type": "string", "pattern": format!(r"^\s*({})\s*$", units.join("|")) })
}

/// Returns the regular expression of all ways to write the unit with the normal form `spelling`.
fn spelling_pattern(spelling: &str) -> String {
    match spelling {
        "%" => return "(%|[Pp]ercent|pct)".into(),
        "deg" => return "(deg|degrees?|°)".into(),
        _ => {}
    }

    // Each letter is replaced by the letters that `normal_form` in `unit` takes for it.
    let spelling = spelling.replace("deg", "°");
    let mut pattern = String::new();
    for letter in spelling.chars() {
        match letter {
            '.' => pattern.push_str("[.·*× ]"),
            '2' => pattern.push_str(r"(\^?2|²)"),
            '3' => pattern.push_str(r"\^?3"),
            '-' => pattern.push_str(r"\^?[-⁻−]"),
            'u' => pattern.push_str("[uµμ]"),
            '°' => pattern.push_str("(deg|°)"),
            '/' | '(' | ')' => {
                pattern.push('\\');
                pattern.push(letter);
            }
            letter => pattern.push(letter),
        }
    }
    pattern
}

/// Returns a transform that limits the numbers of a schema, or of its lists, to the range from
/// `least` to `most`. Texts with units are not limited.
pub fn within(least: f64, most: f64) -> impl Fn(&mut Schema) {
    move |schema| {
        bound(schema, "minimum", least);
        bound(schema, "maximum", most);
    }
}

/// Returns a transform that limits the numbers of a schema, or of its lists, to at least `least`.
pub fn at_least(least: f64) -> impl Fn(&mut Schema) {
    move |schema| bound(schema, "minimum", least)
}

/// Returns a transform that limits the lengths of a schema, or of its lists, to the range from
/// `least` to `most`, in m, whatever the unit of the file: the keywords `leastMetres` and
/// `mostMetres`. Editors are told only that a length is positive.
pub fn between(least: f64, most: f64) -> impl Fn(&mut Schema) {
    move |schema| {
        bound(schema, "exclusiveMinimum", 0.0);
        bound(schema, "leastMetres", least);
        bound(schema, "mostMetres", most);
    }
}

/// Limits the numbers of `schema`, or of its lists, to values above 0.
pub fn positive(schema: &mut Schema) {
    bound(schema, "exclusiveMinimum", 0.0);
}

/// Returns a transform that makes a schema of a table require exactly one of `keys`, which are
/// separated by commas.
pub fn one_of(keys: &'static str) -> impl Fn(&mut Schema) {
    move |schema| {
        let each = keys.split(", ").map(|key| json!({ "required": [key] }));
        schema.insert("oneOf".into(), each.collect());
    }
}

/// Adds `keyword` with the value `limit` to `schema`, or to the items of its lists. In a schema
/// without a type the limit applies to the numbers.
fn bound(schema: &mut Schema, keyword: &str, limit: f64) {
    let is_list = schema.get("items").is_some()
        || schema.get("type").is_some_and(|kind| kind == "array" || kind[0] == "array");
    if !is_list {
        schema.insert(keyword.into(), limit.into());
        return;
    }
    if let Some(items) = schema.get_mut("items")
        && let Ok(items) = items.try_into()
    {
        bound(items, keyword, limit);
    }
}

/// Transform that removes null, which TOML does not have, from a schema.
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let Some(object) = schema.as_object_mut() else { return };
        if object.get("default").is_some_and(|value| value.is_null() || value.is_object()) {
            object.remove("default");
        }
        with_unit_of_default(object);
        with_enum(object);

        // An optional value has the types `[T, null]`, which becomes `T`.
        if let Some(Value::Array(kinds)) = object.get_mut("type") {
            kinds.retain(|kind| kind != "null");
            if let [kind] = &kinds[..] {
                let kind = kind.clone();
                object.insert("type".into(), kind);
            }
        }

        // An optional structure is any of `[T, null]`. The keywords of `T` move to the schema
        // itself.
        if let Some(Value::Array(parts)) = object.get_mut("anyOf") {
            parts.retain(|part| part.get("type").is_none_or(|kind| kind != "null"));
            if let [Value::Object(part)] = &parts[..] {
                let part = part.clone();
                object.remove("anyOf");
                for (key, value) in part {
                    object.entry(key).or_insert(value);
                }
            }
        }
    }
}

/// Writes the default of a length, which is in m, with its unit: bare lengths are in the unit of
/// the file.
fn with_unit_of_default(schema: &mut Map<String, Value>) {
    let is_length = schema.get("$ref").is_some_and(|name| name == "#/$defs/Length");
    let Some(metres) = schema.get("default").and_then(Value::as_f64).filter(|_| is_length) else {
        return;
    };
    let millimetres =
        if metres == 0.0 { json!(0) } else { json!(format!("{} mm", figure(1e3 * metres))) };
    schema.insert("default".into(), millimetres);
}

/// Writes words that each have a description as one list.
fn with_enum(schema: &mut Map<String, Value>) {
    let choices = schema.get("oneOf").and_then(Value::as_array).into_iter().flatten();
    let words: Option<Vec<Value>> = choices.map(|choice| choice.get("const").cloned()).collect();
    if let Some(words) = words.filter(|words| !words.is_empty()) {
        schema.remove("oneOf");
        schema.insert("enum".into(), Value::Array(words));
    }
}

/// Returns the JSON Schema of a file with the content `T`, with a `title` and a `description`.
///
/// `conditions` are further keywords of the whole schema, such as conditions between its tables.
#[must_use]
pub fn schema_of<T: JsonSchema>(
    title: &str,
    description: &str,
    conditions: Map<String, Value>,
) -> Value {
    let mut schema = schemars::schema_for!(T);
    WithoutNull.transform(&mut schema);
    schema.insert("title".into(), title.into());
    schema.insert("description".into(), description.into());
    for (keyword, value) in conditions {
        schema.insert(keyword, value);
    }
    schema.into()
}
