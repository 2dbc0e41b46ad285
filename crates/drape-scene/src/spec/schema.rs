//! JSON Schema of scenes: the schemas of their tables, and the conditions between tables.

use serde_json::{Map, Value, json};

use crate::spec::SceneSpec;

/// Returns the JSON Schema of scenes.
#[must_use]
pub fn scene_schema() -> Value {
    let about = "Scene of drape: cloth, bodies, contact, time. Lengths are in the unit of the file, y is up.";
    let conditions = json!({
        "dependentRequired": { "motion": ["settle"] },
        "allOf": [steps_vary(), steps_in_time(), edges()],
    });
    let Value::Object(conditions) = conditions else { return Value::Object(Map::new()) };
    drape_input::schema_of::<SceneSpec>("Scene of drape", about, conditions)
}

/// Returns the condition of a scene whose key in a table has a value that a schema accepts.
fn has(table: &str, key: &str, accepted: Value) -> Value {
    json!({
        "required": [table],
        "properties": { table: { "required": [key], "properties": { key: accepted } } },
    })
}

/// Limits of steps are for steps that vary.
fn steps_vary() -> Value {
    let limited = ["step_min", "step_max"].map(|key| has("time", key, json!(true)));
    json!({
        "if": { "anyOf": limited },
        "then": { "anyOf": [{ "required": ["settle"] }, has("time", "error", json!(true))] },
    })
}

/// The error of steps is for steps in time.
fn steps_in_time() -> Value {
    let inertia = has("settle", "inertia", json!({ "const": true }));
    json!({
        "if": { "allOf": [{ "required": ["settle"] }, has("time", "error", json!(true))] },
        "then": { "anyOf": [{ "required": ["motion"] }, inertia] },
    })
}

/// Panels that a scene describes itself have four edges.
fn edges() -> Value {
    let edge = json!({ "properties": { "edge": { "enum": ["top", "bottom", "left", "right"] } } });
    json!({
        "if": { "not": { "required": ["garment"] } },
        "then": { "properties": { "pin": { "items": edge } } },
    })
}
