//! Values of summaries, by their names.

use std::collections::BTreeMap;

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

/// Adds the values of a summary with their names, such as `strain.traction_max`. Of lists there are
/// those of measures, up to some length.
pub(super) fn flatten(name: &str, value: &Value, values: &mut Vec<(String, String)>) {
    let inner = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") };
    match value {
        Value::Object(entries) => {
            entries.iter().for_each(|(key, value)| flatten(&inner(key), value, values));
        }
        Value::Array(elements)
            if name.starts_with("measures") && elements.len() <= ELEMENTS_MAX =>
        {
            let elements = elements.iter().enumerate();
            elements.for_each(|(index, value)| flatten(&inner(&index.to_string()), value, values));
        }
        Value::Null | Value::Array(_) => {}
        value => values.push((name.to_owned(), cell(value))),
    }
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
            "strain": { "shear_max": 0.5 }, "measures": { "hem": { "heights": [1.0, 2.5] } },
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
                "settled=true",
                "status=ok",
                "strain.shear_max=0.5"
            ]
        );
    }
}
