//! JSON Schema of sheets, built from the keys, words and quantities of the reader.

use drape_input::{Quantity, laboratory_schema, unit_schema};
use serde_json::{Map, Value, json};

use crate::sheets::axis::{
    DEFORMATION_KEYS, LOAD_KEYS, ZERO, deformation_quantities, load_quantities,
};
use crate::sheets::curve_file::{CURVE_KEYS, DECIMAL, DIRECTION, SEPARATOR, TEST};
use crate::sheets::section::Choice;
use crate::sheets::sheet::{MODEL, SHEET_KEYS};
use crate::sheets::spelling::{DIRECTIONS, KEYS, pattern};

/// Range of a number without a unit.
#[derive(Clone, Copy)]
enum Range {
    Positive,
    AtLeastZero,
    /// Above 0 and below a limit.
    Below(f64),
    /// Above 0, in percent.
    Percent,
}

/// Value of a sheet: its key, quantity, range and description.
type ValueKey = (&'static str, Quantity, Range, &'static str);

/// Values, in the order in which laboratories print values.
const VALUES: [ValueKey; 20] = [
    ("LT", Quantity::Ratio, Range::Below(2.0), "Linearity of the tensile curve, a ratio."),
    ("WT", Quantity::WorkPerArea, Range::Positive, "Tensile work, in gf·cm/cm²."),
    ("RT", Quantity::Ratio, Range::Percent, "Tensile resilience, in percent."),
    ("EM", Quantity::Ratio, Range::Positive, "Extension at the largest load, in percent."),
    ("G", Quantity::ShearStiffness, Range::Positive, "Shear stiffness, in gf/(cm·deg)."),
    (
        "2HG",
        Quantity::ForcePerWidth,
        Range::AtLeastZero,
        "Width of the shear loop at 0.5°, in gf/cm.",
    ),
    (
        "2HG5",
        Quantity::ForcePerWidth,
        Range::AtLeastZero,
        "Width of the shear loop at 5°, in gf/cm.",
    ),
    ("B", Quantity::BendingRigidity, Range::Positive, "Bending rigidity, in gf·cm²/cm."),
    (
        "2HB",
        Quantity::MomentPerWidth,
        Range::AtLeastZero,
        "Width of the bending loop, in gf·cm/cm.",
    ),
    ("LC", Quantity::Ratio, Range::Below(2.0), "Linearity of the compression curve, a ratio."),
    ("WC", Quantity::WorkPerArea, Range::Positive, "Compression work, in gf·cm/cm²."),
    ("RC", Quantity::Ratio, Range::Percent, "Compression resilience, in percent."),
    ("MIU", Quantity::Ratio, Range::Below(2.0), "Coefficient of friction of the surface, a ratio."),
    ("MMD", Quantity::Ratio, Range::Below(10.0), "Mean deviation of MIU, a ratio."),
    ("SMD", Quantity::Roughness, Range::Positive, "Roughness of the surface, in µm."),
    ("T0", Quantity::Length, Range::Positive, "Thickness under 0.5 gf/cm², in mm."),
    ("TM", Quantity::Length, Range::Positive, "Thickness under 50 gf/cm², in mm."),
    ("T", Quantity::Length, Range::Positive, "Thickness where only one is known, in mm."),
    ("W", Quantity::MassPerArea, Range::Positive, "Mass per area, in mg/cm²."),
    (
        "FM",
        Quantity::ForcePerWidth,
        Range::Positive,
        "Largest load of the tensile test, in gf/cm; 500 if missing.",
    ),
];

/// Returns the JSON Schema of a sheet.
#[must_use]
pub fn sheet_schema() -> Value {
    let description = "Values of one direction.";
    let directed_values = value_schemas(|key| KEYS.contains(&key), false);
    let mut keys = value_schemas(|key| SHEET_KEYS.contains(&key), true);
    let other_keys = json!({
        "name": { "type": "string", "description": "Name of the fabric." },
        "source": { "type": "string", "description": "Source: who measured it, when, and under which licence." },
        "customer": line_schema("Customer for whom the fabric was tested, for the head of a report."),
        "article": line_schema("Article: the customer's number or name of the fabric, for the head of a report."),
        "laboratory": line_schema("Laboratory that tested it, for the head of a report."),
        "date": {
            "type": "string",
            "pattern": r"^\d{4}(-\d{2}(-\d{2})?)?$",
            "description": "Date of the tests, for the head of a report: 2026-03-14, 2026-03 or 2026.",
        },
        "specimens": {
            "anyOf": [{ "type": "integer", "minimum": 1 }, { "type": "string", "minLength": 1 }],
            "description": "Specimens, for the head of a report: their number, or a text such as \"3 of 20 cm × 20 cm\".",
        },
        "model": choice_schema(&MODEL, "Law that bending and shear are fitted with; selected by the data if missing."),
        "warp": { "$ref": "#/$defs/Values", "description": "Values along the warp." },
        "weft": { "$ref": "#/$defs/Values", "description": "Values along the weft." },
        "mean": { "$ref": "#/$defs/Values", "description": "Values for both directions." },
        "curve": {
            "type": "array",
            "items": { "$ref": "#/$defs/Curve" },
            "description": "Curves, each in a table file beside the sheet.",
        },
    });

    extend(&mut keys.properties, other_keys);
    let directions = json!({ DIRECTIONS: { "$ref": "#/$defs/Values" } });
    extend(&mut keys.patterns, directions);

    let mut sheet = keys.schema();
    let whole = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Sheet of drape",
        "description": "What was measured of a fabric on the Kawabata Evaluation System (KES). Bare numbers are in the units of KES.",
        "required": ["name"],
        "$defs": { "Values": directed_values.schema_with(description), "Curve": curve_schema() },
    });
    extend(&mut sheet, whole);
    Value::Object(sheet)
}

/// Keys of a table: by name, and by pattern.
#[derive(Default)]
struct TableKeys {
    properties: Map<String, Value>,
    patterns: Map<String, Value>,
}

impl TableKeys {
    /// Returns the schema of a table that has only these keys.
    fn schema(self) -> Map<String, Value> {
        let Self { properties, patterns } = self;
        let mut schema = Map::new();
        let keywords = json!({
            "type": "object",
            "properties": properties,
            "patternProperties": patterns,
            "additionalProperties": false,
        });
        extend(&mut schema, keywords);
        schema
    }

    /// Returns the schema of a table that has only these keys, with `description`.
    fn schema_with(self, description: &str) -> Map<String, Value> {
        let mut schema = self.schema();
        schema.insert("description".into(), description.into());
        schema
    }
}

/// Adds the `keywords` of an object to `schema`.
fn extend(schema: &mut Map<String, Value>, keywords: Value) {
    if let Value::Object(keywords) = keywords {
        schema.extend(keywords);
    }
}

/// Returns the schemas of the values whose key is `in_list`, in all spellings. At the `top` of a
/// sheet a spelling may name a direction.
fn value_schemas(in_list: impl Fn(&str) -> bool, top: bool) -> TableKeys {
    let mut keys = TableKeys::default();
    for (key, quantity, range, description) in VALUES.into_iter().filter(|value| in_list(value.0)) {
        let mut schema = laboratory_schema(quantity);
        let limits = match range {
            Range::Positive => json!({ "exclusiveMinimum": 0 }),
            Range::AtLeastZero => json!({ "minimum": 0 }),
            Range::Below(limit) => json!({ "exclusiveMinimum": 0, "exclusiveMaximum": limit }),
            Range::Percent => json!({ "exclusiveMinimum": 0, "maximum": 100 }),
        };
        if let Value::Object(schema) = &mut schema {
            schema.insert("description".into(), description.into());
            extend(schema, limits);
        }
        keys.patterns.insert(pattern(key, top && KEYS.contains(&key)), schema.clone());
        keys.properties.insert(key.into(), schema);
    }
    keys
}

/// Returns the schema of one line of text, with `description`.
fn line_schema(description: &str) -> Value {
    json!({ "type": "string", "minLength": 1, "description": description })
}

/// Returns the schema of the words of `choice`, with `description`.
fn choice_schema<T: Copy>(choice: &Choice<'_, T>, description: &str) -> Value {
    let words: Vec<&str> = choice.values.iter().map(|&value| (choice.name)(value)).collect();
    json!({ "enum": words, "description": description })
}

/// Returns the schema of a text, with `description`.
fn text_schema(description: &str) -> Value {
    json!({ "type": "string", "description": description })
}

/// Returns the schema of a number of lines, with `description`.
fn line_count(description: &str) -> Value {
    let number = json!({ "type": "integer", "minimum": 0 });
    json!({ "anyOf": [number, { "const": false }], "description": description })
}

/// Returns the schema of a choice among numbered tables, specimens or cycles, with `description`.
fn take_schema(description: &str) -> Value {
    let number = json!({ "type": "integer", "minimum": 0 });
    let list = json!({ "type": "array", "items": number, "minItems": 1 });
    json!({ "anyOf": [number, list, { "const": "all" }], "description": description })
}

/// Returns the schema of a length of the specimen, with `description`.
fn size_schema(description: &str) -> Value {
    json!({
    "anyOf": [{ "type": "number", "exclusiveMinimum": 0 }, { "type": "string" }],
    "description": description,
    })
}

/// Returns the schema of a `[[curve]]`.
fn curve_schema() -> Value {
    let files = json!({ "type": "array", "items": { "type": "string" }, "minItems": 1 });
    let properties = json!({
        "name": text_schema("Name of the curve; its test and direction if missing."),
        "test": choice_schema(&TEST, "Test that it comes from."),
        "direction": choice_schema(&DIRECTION, "Yarns along which the strip was cut."),
        "file": {
            "anyOf": [{ "type": "string" }, files],
            "description": "Table file beside the sheet, or several with repeats of the test.",
        },
        "deformation": axis_schema(&DEFORMATION_KEYS, "Column of the deformation; detected if missing."),
        "load": axis_schema(&LOAD_KEYS, "Column of the load; detected if missing."),
        "slack": { "type": "boolean", "description": "Whether the strip hung slack at the start, so that the zeros of strain and force are fitted; `false` if missing." },
        "zero_strain": json!({ "anyOf": [{ "type": "number" }, { "type": "string" }], "description": "Strain of the file at which a tensile strip is taut and carries nothing, in percent: positive for a strip that hung slack before, negative for one under a pretension. The curve counts from there; from its first point if missing." }),
        "encoding": text_schema("Encoding of the file; detected if missing."),
        "separator": choice_schema(&SEPARATOR, "Sign between columns; detected if missing."),
        "decimal": choice_schema(&DECIMAL, "Decimal sign; detected if missing."),
        "header": line_count("Line of the header, from 1; false for none; detected if missing."),
        "skip": line_count("Number of lines to leave out at the start; detected if missing."),
        "sheet": {
            "anyOf": [{ "type": "string" }, { "type": "integer", "minimum": 0 }],
            "description": "Sheet of a spreadsheet, by its name or its number from 1; its only one if missing.",
        },
        "table": take_schema("Tables of the file that are repeats of the test, from 1; its only one if missing."),
        "specimen": take_schema("Specimens that are repeats of the test, by the numbers in their column; all if missing."),
        "cycle": take_schema("Cycles that are taken, from 1; all if missing."),
    });

    // The units of an axis depend on the test.
    json!({
        "type": "object",
        "description": "Measured curve, in a table file.",
        "properties": retain(&CURVE_KEYS, properties),
        "additionalProperties": false,
        "required": ["test", "direction", "file"],
        "allOf": TEST.values.iter().map(|&test| json!({
            "if": { "properties": { "test": { "const": test.name() } } },
            "then": { "properties": {
                "deformation": { "properties": { "unit": unit_schema(deformation_quantities(test)) } },
                "load": { "properties": { "unit": unit_schema(load_quantities(test)) } },
            } },
        })).collect::<Vec<Value>>(),
    })
}

/// Returns the schema of an axis of a curve that has the given `keys`, with `description`.
fn axis_schema(keys: &[&str], description: &str) -> Value {
    let column = json!({ "anyOf": [{ "type": "string" }, { "type": "integer", "minimum": 0 }] });
    let columns = json!({
    "anyOf": [column, { "type": "array", "items": column }],
    "description": "Column, by its name or its place from 1, or a list of them with repeats; detected if missing.",
    });
    let properties = json!({
    "column": columns,
        "unit": { "type": "string", "description": "Unit of the column; that of its header if missing." },
        "gauge": size_schema("Length of the specimen with its unit, or the column with it, in metres where that has no unit; needed for a length only; that of the file if missing."),
        "width": size_schema("Width of the specimen with its unit, or the column with it, in metres where that has no unit, for loads of a whole specimen; that of the file if missing."),
        "zero": choice_schema(&ZERO, "Zero of a length: an extension, the distance of the clamps, or a position; detected if missing."),
        "reversed": { "type": "boolean", "description": "Whether the sign is the opposite one; `false` if missing." },
    });
    json!({
        "type": "object",
        "description": description,
        "properties": retain(keys, properties),
        "additionalProperties": false,
    })
}

/// Returns the entries of `properties` that are among `keys`.
fn retain(keys: &[&str], properties: Value) -> Map<String, Value> {
    let Value::Object(properties) = properties else { return Map::new() };
    properties.into_iter().filter(|(key, _)| keys.contains(&key.as_str())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_of_a_sheet_and_a_curve_is_described() {
        let schema = sheet_schema();
        let has = |place: &Value, keys: &[&str]| {
            for key in keys {
                assert!(place[key]["description"].is_string(), "{key}");
            }
        };
        has(&schema["properties"], &SHEET_KEYS);
        let [values, curve] = ["Values", "Curve"].map(|name| &schema["$defs"][name]["properties"]);
        has(values, &KEYS);
        has(curve, &CURVE_KEYS);
        has(&curve["deformation"]["properties"], &DEFORMATION_KEYS);
        has(&curve["load"]["properties"], &LOAD_KEYS);
    }
}
