//! Values of summaries, with their names.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use crate::measure::Measure;

/// Returns the entries of `values` that `measures` name, in the units of the measures.
pub(super) fn measured_values(
    measures: &[Measure],
    values: Vec<(String, String)>,
) -> Vec<(String, String)> {
    let values: BTreeMap<String, String> = values.into_iter().collect();
    let mut measured = Vec::new();
    for measure in measures {
        if let Some(value) = values.get(&measure.key) {
            measured.push((measure.name.clone(), measure.in_unit(value.clone())));
        }
    }
    measured
}

/// Adds each value in `value`, a part of a summary, to `values`, with its name, such as
/// `strain.traction_max`. `name` is the name of `value`.
///
/// Only lists of measures are added, and only short ones. Their elements have names or numbers.
pub(super) fn flatten(name: &str, value: &Value, values: &mut Vec<(String, String)>) {
    /// Largest number of elements of a list that have columns.
    const ELEMENTS_MAX: usize = 32;

    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                flatten(&inner_name(name, key), value, values);
            }
        }
        Value::Array(elements)
            if name.starts_with("measures") && elements.len() <= ELEMENTS_MAX =>
        {
            for (key, value) in element_names(elements).iter().zip(elements) {
                flatten(&inner_name(name, key), value, values);
            }
        }
        Value::Null | Value::Array(_) => {}
        value => values.push((name.to_owned(), cell_text(value))),
    }
}

/// Returns the name of the value at `key` in the value `name`.
fn inner_name(name: &str, key: &str) -> String {
    if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") }
}

/// Returns the names of the `elements` of a list. The names are the numbers of the elements unless
/// fields of the elements give each of them another name.
fn element_names(elements: &[Value]) -> Vec<String> {
    let names: Vec<String> =
        elements.iter().map(|element| field_name(element).unwrap_or_default()).collect();
    let known: BTreeSet<&String> = names.iter().filter(|name| !name.is_empty()).collect();
    if known.len() == names.len() {
        return names;
    }
    (0..elements.len()).map(|index| index.to_string()).collect()
}

/// Returns the name that fields of `element` give it, if it has such fields.
fn field_name(element: &Value) -> Option<String> {
    /// Fields that name an element. The first ones that the element has are used.
    const NAME_FIELDS: [&[&str]; 5] =
        [&["title"], &["symbol"], &["name"], &["of"], &["test", "direction"]];

    NAME_FIELDS.iter().find_map(|fields| {
        let texts: Option<Vec<&str>> =
            fields.iter().map(|field| element.get(field)?.as_str()).collect();
        Some(texts?.join("."))
    })
}

/// Returns `value` as the text of a cell. Texts have no quotes.
pub(super) fn cell_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_a_summary_have_names() {
        let summary = serde_json::json!({
            "status": "ok", "frame_times": [0.0, 1.0], "cpu_seconds": null, "settled": true,
            "strain": { "shear_max": 0.5 }, "measures": {
                "hem": { "heights": [1.0, 2.5] },
                "loops": [
                    { "test": "shear", "direction": "warp", "distance": 0.1 },
                    { "test": "shear", "direction": "weft", "distance": 0.2 },
                ],
                "starts": [{ "name": "a", "x": 1 }, { "name": "a", "x": 2 }],
            },
        });
        let mut values = Vec::new();
        flatten("", &summary, &mut values);
        values.sort();
        let values: Vec<String> =
            values.into_iter().map(|(name, v)| format!("{name}={v}")).collect();
        assert_eq!(
            values,
            [
                "measures.hem.heights.0=1.0",
                "measures.hem.heights.1=2.5",
                "measures.loops.shear.warp.direction=warp",
                "measures.loops.shear.warp.distance=0.1",
                "measures.loops.shear.warp.test=shear",
                "measures.loops.shear.weft.direction=weft",
                "measures.loops.shear.weft.distance=0.2",
                "measures.loops.shear.weft.test=shear",
                "measures.starts.0.name=a",
                "measures.starts.0.x=1",
                "measures.starts.1.name=a",
                "measures.starts.1.x=2",
                "settled=true",
                "status=ok",
                "strain.shear_max=0.5"
            ]
        );
    }
}
