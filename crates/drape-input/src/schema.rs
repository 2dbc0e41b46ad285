//! JSON Schema of numbers that may stand with a unit, and what schemas of files have in common.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use crate::given::{Dimension, Given, TextOr};
use crate::unit::Quantity;

/// Number with its exponent, as a regular expression.
const NUMBER: &str = r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?";

impl<D: Dimension> JsonSchema for Given<D> {
    fn schema_name() -> Cow<'static, str> {
        let token = D::TOKEN;
        token.rsplit(':').next().unwrap_or(token).into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let quantity = D::QUANTITY;
        let [bare, unit] = D::EXAMPLES;
        json_schema!({
            "description": format!("{}, such as {bare} or \"{unit}\"", capital(quantity.name())),
            "anyOf": [
                { "type": "number" },
                { "type": "string", "pattern": pattern(quantity) },
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

/// Returns a word with a capital.
fn capital(word: &str) -> String {
    let (first, rest) = word.split_at(word.len().min(1));
    first.to_uppercase() + rest
}

/// Returns the texts of a number with a unit, as a regular expression.
fn pattern(quantity: Quantity) -> String {
    let units: Vec<String> = quantity.spellings().map(unit_pattern).collect();
    format!("^\\s*{NUMBER}\\s*({})\\s*$", units.join("|"))
}

/// Returns the texts of a unit in all of its spellings.
fn unit_pattern(spelling: &str) -> String {
    let spelling = spelling.replace("deg", "°");
    let mut pattern = String::new();
    for letter in spelling.chars() {
        match letter {
            '.' => pattern.push_str("[.·*× ]"),
            '2' => pattern.push_str(r"(\^?2|²)"),
            '3' => pattern.push_str(r"\^?3"),
            '-' => pattern.push_str("[-⁻−]"),
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

/// Returns the JSON Schema of a file with a title.
#[must_use]
pub fn schema_of<T: JsonSchema>(title: &str) -> serde_json::Value {
    let mut schema = schemars::schema_for!(T);
    schema.insert("title".into(), title.into());
    schema.into()
}
