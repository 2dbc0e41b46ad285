//! Manifest: the list of all points of a study.

use serde_json::{Map, Value, json};

use crate::axes::level_value;
use crate::point::Point;
use crate::study::Study;

/// Returns the manifest of `points` of `study`, with a line of JSON for each point: its number, its
/// key, its values by the names of the axes, and its settings.
#[must_use]
pub fn manifest(study: &Study, points: &[Point]) -> String {
    let mut manifest = String::new();
    for point in points {
        let levels = study.axes().zip(&point.levels);
        let values: Map<String, Value> =
            levels.map(|(axis, level)| (axis.name.clone(), level_value(level))).collect();
        let set: Vec<String> = point.settings.iter().map(ToString::to_string).collect();
        let line = json!({ "point": point.index, "key": point.key, "values": values, "set": set });
        manifest += &format!("{line}\n");
    }
    manifest
}
