//! Manifest: the list of all points of a study.

use serde_json::{Map, Value, json};

use crate::axes::value_of;
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
