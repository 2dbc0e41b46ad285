//! Values of summaries, by their names.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use crate::measure::Measure;

/// Most elements of a list of a summary's measures that have columns.
const ELEMENTS_MAX: usize = 32;

/// Returns the values of the measures that a study names, in their units.
pub(super) fn chosen(measures: &[Measure], values: Vec<(String, String)>) -> Vec<(String, String)> {
    let values: BTreeMap<String, String> = values.into_iter().collect();
    let value =
        |own: &Measure| Some((own.name.clone(), own.in_unit(values.get(&own.key)?.clone())));
    measures.iter().filter_map(value).collect()
}

/// Fields of an element of a list that name it: the first that is there, or the last two together.
const NAMES: [&[&str]; 5] = [&["title"], &["symbol"], &["name"], &["of"], &["test", "direction"]];

/// Adds the values of a summary with their names, such as `strain.traction_max`. Of lists there are
/// those of measures, up to some length; their elements have names or numbers.
pub(super) fn flatten(name: &str, value: &Value, values: &mut Vec<(String, String)>) {
    let inner = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") };
    match value {
        Value::Object(entries) => {
            entries.iter().for_each(|(key, value)| flatten(&inner(key), value, values));
        }
        Value::Array(elements)
            if name.starts_with("measures") && elements.len() <= ELEMENTS_MAX =>
        {
            let names = names(elements);
            names.iter().zip(elements).for_each(|(own, value)| flatten(&inner(own), value, values));
        }
        Value::Null | Value::Array(_) => {}
        value => values.push((name.to_owned(), cell(value))),
    }
}

/// Returns the names of the elements of a list: by their fields, if these tell all of them apart,
/// else their numbers.
fn names(elements: &[Value]) -> Vec<String> {
    let name = |element: &Value| {
        let texts = |fields: &&[&str]| {
            let texts = fields.iter().map(|field| element.get(field)?.as_str());
            Some(texts.collect::<Option<Vec<_>>>()?.join("."))
        };
        NAMES.iter().find_map(texts).unwrap_or_default()
    };
    let names: Vec<String> = elements.iter().map(name).collect();
    let known: BTreeSet<&String> = names.iter().filter(|name| !name.is_empty()).collect();
    if known.len() == names.len() {
        return names;
    }
    (0..elements.len()).map(|index| index.to_string()).collect()
}

/// Returns a value as a cell: texts without quotes.
pub(super) fn cell(value: &Value) -> String {
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
