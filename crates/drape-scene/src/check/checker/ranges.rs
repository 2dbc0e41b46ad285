//! Check of ranges: every number of a spec against the range that its key declares.
//!
//! The declarations are read from the schema of scenes, which is made of the fields of the spec. A
//! range between two keys, such as a time that is at least one step, is checked where the value of
//! the key is checked.

use std::sync::LazyLock;

use drape_input::{KeyPath, KeyStep, figure};
use serde_json::Value as Schema;
use toml::Value;

use crate::check::checker::Checker;
use crate::spec::schema::scene_schema;

/// Schema of scenes.
static SCHEMA: LazyLock<Schema> = LazyLock::new(scene_schema);

/// Checks that all numbers of the spec of `checker` are finite and in the ranges of their keys, and
/// that no needed text is empty.
pub(crate) fn check_ranges(checker: &mut Checker<'_>) {
    let declaration = Declaration { parts: vec![&SCHEMA] };
    let Ok(root) = Value::try_from(checker.spec.without_held()) else { return };
    check_value(checker, &mut KeyPath::default(), &root, &declaration);
}

/// Declaration of a key: the schema at its field, and the schemas to which that one refers.
struct Declaration<'a> {
    /// Schemas, the one at the field first.
    parts: Vec<&'a Schema>,
}

/// Declaration of a key, and of the numbers in it.
#[derive(Clone, Copy)]
struct Declared<'a> {
    key: &'a Declaration<'a>,
    number: &'a Declaration<'a>,
}

impl<'a> Declared<'a> {
    /// Returns the declaration of a key with one number.
    fn alone(key: &'a Declaration<'a>) -> Self {
        Self { key, number: key }
    }
}

/// Range of a number.
struct Range {
    least: f64,
    most: f64,
    /// Whether the number must be above `least`.
    is_open: bool,
    /// Unit of the number, with a space before it.
    unit: String,
}

impl<'a> Declaration<'a> {
    /// Returns the declaration that begins with the schema `first`.
    fn new(first: &'a Schema) -> Self {
        let mut parts = vec![first];
        let mut next = 0;
        while let Some(part) = parts.get(next).copied() {
            next += 1;
            let name = part.get("$ref").and_then(Schema::as_str);
            let name = name.and_then(|name| name.strip_prefix("#/$defs/"));
            parts.extend(name.and_then(|name| SCHEMA["$defs"].get(name)));
            parts.extend(part.get("anyOf").and_then(Schema::as_array).into_iter().flatten());
        }
        Self { parts }
    }

    /// Returns the value of `keyword` in the first part that has it.
    fn get(&self, keyword: &str) -> Option<&'a Schema> {
        self.parts.iter().find_map(|part| part.get(keyword))
    }

    /// Returns the declaration of the key `name` of the table.
    fn key(&self, name: &str) -> Option<Self> {
        let property = self.parts.iter().find_map(|part| part.get("properties")?.get(name));
        property.or_else(|| self.get("additionalProperties")).map(Self::new)
    }

    /// Returns whether the table needs the key `name`.
    fn needs(&self, name: &str) -> bool {
        let mut required = self.parts.iter().filter_map(|part| part.get("required")?.as_array());
        required.any(|names| names.iter().any(|needed| needed == name))
    }

    /// Returns the range of the number.
    fn range(&self) -> Range {
        let number = |keyword: &str| self.get(keyword).and_then(Schema::as_f64);
        let open = number("exclusiveMinimum");
        let closed = number("leastMetres").or(number("minimum"));
        Range {
            least: closed.or(open).unwrap_or(f64::NEG_INFINITY),
            most: number("mostMetres").or(number("maximum")).unwrap_or(f64::INFINITY),
            is_open: closed.is_none() && open.is_some(),
            unit: match self.get("unit").and_then(Schema::as_str) {
                Some(unit) if !unit.is_empty() => format!(" {unit}"),
                _ => String::new(),
            },
        }
    }

    /// Returns the sentence of the key, without the full stop.
    fn sentence(&self) -> String {
        let text = self.get("description").and_then(Schema::as_str).unwrap_or_default();
        text.replace('\n', " ").trim_end_matches('.').to_owned()
    }
}

impl Range {
    /// Returns what is wrong with `number`, or `None` if it is in the range.
    fn fault(&self, number: f64) -> Option<String> {
        let Self { least, most, is_open, unit } = self;
        let is_above = if *is_open { number > *least } else { number >= *least };
        if number.is_finite() && is_above && number <= *most {
            return None;
        }

        let value = format!("{}{unit}", figure(number));
        Some(match (number.is_finite(), least.is_finite(), most.is_finite()) {
            (false, ..) => format!("{} is not a finite number", figure(number)),
            (_, true, true) => {
                format!("{value} is not between {} and {}{unit}", figure(*least), figure(*most))
            }
            (_, true, false) if *is_open => format!("{value} is not above {}", figure(*least)),
            (_, true, false) => format!("{value} is not {} or more", figure(*least)),
            (_, false, _) => format!("{value} is not {} or less", figure(*most)),
        })
    }
}

/// Checks `value`, whose key has the path `path` and the `declaration`, and all values in it.
fn check_value(
    checker: &mut Checker<'_>,
    path: &mut KeyPath,
    value: &Value,
    declaration: &Declaration<'_>,
) {
    match value {
        Value::Table(table) => {
            for (name, value) in table {
                let Some(inner) = declaration.key(name) else { continue };
                path.steps.push(KeyStep::Name(name.clone()));
                if value.as_str() == Some("") && declaration.needs(name) {
                    checker.fail(&path.to_string(), "is empty", inner.sentence());
                }
                check_value(checker, path, value, &inner);
                path.steps.pop();
            }
        }
        Value::Array(list) => {
            let Some(items) = declaration.get("items").map(Declaration::new) else { return };
            for (index, value) in list.iter().enumerate() {
                // A list of numbers is one value to the reader, and has one sentence.
                match value {
                    Value::Float(number) => check_number(
                        checker,
                        path,
                        *number,
                        Declared { key: declaration, number: &items },
                    ),
                    Value::Integer(number) => {
                        let declared = Declared { key: declaration, number: &items };
                        check_number(checker, path, *number as f64, declared);
                    }
                    _ => {
                        path.steps.push(KeyStep::Index(index));
                        check_value(checker, path, value, &items);
                        path.steps.pop();
                    }
                }
            }
        }
        Value::Float(number) => check_number(checker, path, *number, Declared::alone(declaration)),
        Value::Integer(number) => {
            check_number(checker, path, *number as f64, Declared::alone(declaration));
        }
        Value::String(_) | Value::Boolean(_) | Value::Datetime(_) => {}
    }
}

/// Checks `number`, whose key has the path `path`, against what is `declared`.
fn check_number(checker: &mut Checker<'_>, path: &KeyPath, number: f64, declared: Declared<'_>) {
    let Some(fault) = declared.number.range().fault(number) else { return };
    let key = path.to_string();

    // What was written is repeated where the unit makes it another number.
    let written = checker.written(&key).filter(|written| written.starts_with('"'));
    let message = written.map_or(fault.clone(), |written| format!("{written} is wrong: {fault}"));
    let mut help = declared.key.sentence();
    if declared.number.get("mostMetres").is_some() {
        help += "; is the unit right? write it with one, such as \"30 cm\", or set length = \"cm\"";
    }
    checker.fail(&key, message, &help);
}
