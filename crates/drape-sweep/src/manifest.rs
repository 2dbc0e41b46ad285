//! Manifest: the list of all points of a study.

use serde_json::{Map, Value, json};

use crate::point::Point;
use crate::study::Study;

/// Returns the manifest of the points of a study as JSON lines: number, key and values of each, by
/// the names of the axes.
#[must_use]
pub fn manifest(study: &Study, points: &[Point]) -> String {
    let line = |point: &Point| {
        let values = study.axes().zip(&point.levels);
        let values = values.map(|(axis, level)| (axis.name.clone(), value_of(level)));
        let set: Vec<String> = point.settings.iter().map(ToString::to_string).collect();
        let values: Map<String, Value> = values.collect();
        json!({ "point": point.index, "key": point.key, "values": values, "set": set }).to_string()
    };
    points.iter().map(|point| line(point) + "\n").collect()
}

/// Returns a value of TOML as one of JSON.
pub(crate) fn value_of(level: &str) -> Value {
    let table = toml::from_str::<toml::Table>(&format!("value = {level}"));
    let value = table.ok().and_then(|mut table| table.remove("value"));
    value.and_then(|value| serde_json::to_value(value).ok()).unwrap_or_else(|| level.into())
}
