//! JSON Schema of sheets, built from the keys, words and quantities of the reader.

use drape_input::{Quantity, laboratory_schema, unit_schema};
use serde_json::{Map, Value, json};

use crate::sheets::axis::{deformation_quantities, load_quantities};
use crate::sheets::file::forms::Zero;
use crate::sheets::model::Model;
use crate::sheets::spelling::{DIRECTIONS, KEYS, pattern};
use crate::tables::grid::Separator;
use crate::tables::number::Decimal;
use crate::test::{Direction, Test};

/// Tests of curves.
const TESTS: [Test; 4] = [Test::Tensile, Test::Shear, Test::Bending, Test::LoopBending];
/// Directions of curves.
const DIRECTION_WORDS: [Direction; 2] = [Direction::Warp, Direction::Weft];

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
    let mut keys = value_schemas(|_| true, true);
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
        "model": choice_schema(&Model::ALL.map(Model::name), "Law that bending and shear are fitted with; selected by the data if missing."),
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

/// Returns the schema of a choice among `words`, with `description`.
fn choice_schema(words: &[&str], description: &str) -> Value {
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
        "test": choice_schema(&TESTS.map(Test::name), "Test that it comes from."),
        "direction": choice_schema(&DIRECTION_WORDS.map(Direction::name), "Yarns along which the strip was cut."),
        "file": {
            "anyOf": [{ "type": "string" }, files],
            "description": "Table file beside the sheet, or several with repeats of the test.",
        },
        "deformation": axis_schema("Column of the deformation; detected if missing.", json!({
            "gauge": size_schema("Length of the specimen with its unit, or the column with the length, in metres if the column has no unit; needed for a length only; the gauge of the file if missing."),
            "zero": choice_schema(&Zero::ALL.map(Zero::name), "Zero of a length: an extension, the distance of the clamps, or a position; detected if missing."),
        })),
        "load": axis_schema("Column of the load; detected if missing.", json!({
            "width": size_schema("Width of the specimen with its unit, or the column with the width, in metres if the column has no unit, for loads of a whole specimen; the width of the file if missing."),
        })),
        "slack": { "type": "boolean", "description": "Whether the strip hung slack at the start, so that the zeros of strain and force are fitted; `false` if missing." },
        "zero_strain": json!({ "anyOf": [{ "type": "number" }, { "type": "string" }], "description": "Strain of the file at which a tensile strip is taut and carries nothing, in percent: positive for a strip that hung slack before, negative for one under a pretension. The curve counts from there; from its first point if missing." }),
        "encoding": text_schema("Encoding of the file; detected if missing."),
        "separator": choice_schema(&Separator::ALL.map(Separator::name), "Sign between columns; detected if missing."),
        "decimal": choice_schema(&Decimal::ALL.map(Decimal::name), "Decimal sign; detected if missing."),
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
        "properties": properties,
        "additionalProperties": false,
        "required": ["test", "direction", "file"],
        "allOf": TESTS.iter().map(|&test| json!({
            "if": { "properties": { "test": { "const": test.name() } } },
            "then": { "properties": {
                "deformation": { "properties": { "unit": unit_schema(deformation_quantities(test)) } },
                "load": { "properties": { "unit": unit_schema(load_quantities(test)) } },
            } },
        })).collect::<Vec<Value>>(),
    })
}

/// Returns the schema of an axis of a curve, with `description`. Beside the keys of every axis the
/// axis has the keys of `properties`.
fn axis_schema(description: &str, properties: Value) -> Value {
    let column = json!({ "anyOf": [{ "type": "string" }, { "type": "integer", "minimum": 0 }] });
    let columns = json!({
        "anyOf": [column, { "type": "array", "items": column }],
        "description": "Column, by its name or its place from 1, or a list of them with repeats; detected if missing.",
    });
    let mut keys = Map::new();
    extend(&mut keys, properties);
    let keys_of_every_axis = json!({
        "column": columns,
        "unit": { "type": "string", "description": "Unit of the column; that of its header if missing." },
        "reversed": { "type": "boolean", "description": "Whether the sign is the opposite one; `false` if missing." },
    });
    extend(&mut keys, keys_of_every_axis);
    json!({
        "type": "object",
        "description": description,
        "properties": keys,
        "additionalProperties": false,
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use drape_input::Document;

    use super::*;
    use crate::error::Error;
    use crate::sheets::sheet::Sheet;

    /// Returns the keys that the reader of sheets knows in the table at the key path `path`, which
    /// begins after `text`.
    fn known_keys(text: &str) -> BTreeSet<String> {
        let text = format!("{text}unheard_of_key = 1\n");
        let Err(Error::Input(mistakes)) = Sheet::from_document(&Document::new("a.toml", text))
        else {
            panic!("the key is unknown")
        };
        let helps = mistakes.0.iter().filter_map(|mistake| mistake.help.as_deref());
        let known = helps.filter_map(|help| help.strip_prefix("known here: ")).next();
        known.expect("the keys are listed").split(", ").map(str::to_owned).collect()
    }

    /// Returns the keys in `place` of a schema, all of which have a description.
    fn described_keys(place: &Value) -> BTreeSet<String> {
        let Value::Object(properties) = &place["properties"] else { panic!("{place}") };
        for (key, property) in properties {
            assert!(property["description"].is_string(), "{key}");
        }
        properties.keys().cloned().collect()
    }

    #[test]
    fn the_schema_describes_the_keys_that_the_reader_knows() {
        let schema = sheet_schema();
        assert_eq!(described_keys(&schema), known_keys(""));
        let [values, curve] = ["Values", "Curve"].map(|name| &schema["$defs"][name]);
        for table in ["[warp]\n", "[weft]\n", "[mean]\n"] {
            assert_eq!(described_keys(values), known_keys(table), "{table}");
        }
        assert_eq!(described_keys(curve), known_keys("[[curve]]\n"));
        for axis in ["deformation", "load"] {
            let known = known_keys(&format!("[[curve]]\n[curve.{axis}]\n"));
            assert_eq!(described_keys(&curve["properties"][axis]), known, "{axis}");
        }
    }
}
