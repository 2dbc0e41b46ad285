//! Measures of a run as rows of text, from its summary.

use serde_json::Value;

/// Most rows that are shown.
const ROWS_MAX: usize = 80;

/// Returns names and values of what a summary tells of the result.
pub(super) fn rows(summary: &Value) -> Vec<[String; 2]> {
    let mut rows = Vec::new();
    for key in ["status", "particles", "simulated_seconds", "settled", "strain", "measures"] {
        add(key, &summary[key], &mut rows);
    }
    rows.truncate(ROWS_MAX);
    rows
}

fn add(name: &str, value: &Value, rows: &mut Vec<[String; 2]>) {
    match value {
        Value::Null => {}
        Value::Object(map) => {
            for (key, value) in map {
                let key = key.replace('_', " ");
                let name = if name == "measures" { key } else { format!("{name} · {key}") };
                add(&name, value, rows);
            }
        }
        Value::Array(values) => {
            let all: Vec<String> = values.iter().map(text).collect();
            rows.push([name.replace('_', " "), all.join(", ")]);
        }
        _ => rows.push([name.replace('_', " "), text(value)]),
    }
}

fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Bool(yes) => if *yes { "yes" } else { "no" }.to_owned(),
        Value::Number(number) => match number.as_f64() {
            Some(value) if value.fract() != 0.0 => significant(value),
            _ => number.to_string(),
        },
        _ => value.to_string(),
    }
}

/// Returns a number with four significant digits.
fn significant(value: f64) -> String {
    let digits = 3 - value.abs().log10().floor() as i32;
    match digits {
        0..=8 => format!("{value:.*}", digits as usize),
        _ => format!("{value:.3e}"),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_summary_is_told_in_rows_of_names_and_values() {
        let summary = json!({
            "status": "ok", "particles": 6561, "settled": true, "wall_seconds": 3.5,
            "strain": { "warp_max": 0.012345678 },
            "measures": { "drape": { "coefficient": 43.21987, "box": [1, -2.5] }, "tiny": 1.5e-7 },
        });
        let expected = [
            ["status", "ok"],
            ["particles", "6561"],
            ["settled", "yes"],
            ["strain · warp max", "0.01235"],
            ["drape · box", "1, -2.500"],
            ["drape · coefficient", "43.22"],
            ["tiny", "1.500e-7"],
        ];
        assert_eq!(rows(&summary), expected.map(|row| row.map(str::to_owned)));
    }
}
