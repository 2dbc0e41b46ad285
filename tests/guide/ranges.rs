//! Ranges that the schema of scenes states, against those that the program holds.

use std::path::Path;

use drape::scene::{Scene, scene_schema};
use toml::Value;

use crate::defaults::{CLOTH, SEWN, headed};
use crate::schema::{Key, Schema};

/// Returns numbers just outside of a stated range: `A to B`, `≥ A`, `> A`, `≤ B`.
fn outside(key: &Key) -> Vec<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let is_whole = key.kind.starts_with("whole number");
    let apart = |end: f64| if is_whole { 1.0 } else { 0.01 * end.abs().max(1e-3) };
    let below = |low: f64| low - apart(low);
    let above = |high: f64| high + apart(high);
    if let Some((low, high)) = key.range.split_once(" to ")
        && let (Some(low), Some(high)) = (number(low), number(high))
    {
        return vec![below(low), above(high)];
    }
    let bound =
        |sign: &str| key.range.split(',').find_map(|part| number(part.trim().strip_prefix(sign)?));
    let low = bound("≥").map(below).or(bound(">"));
    let high = bound("≤").map(above).or(bound("<"));
    low.into_iter().chain(high).collect()
}

/// Returns a number as the key takes it.
fn value(key: &Key, number: f64) -> Value {
    match key.kind.starts_with("whole number") {
        true => Value::Integer(number as i64),
        false => Value::Float(number),
    }
}

/// Returns what is said of a scene; empty where nothing is wrong.
fn said(text: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let document = drape::input::Document::new(root.join("scene.toml"), text);
    match Scene::from_documents(&document, &[]) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn numbers_outside_of_the_ranges_of_the_schema_are_refused() {
    let mut tried = 0;
    let mut accepted = Vec::new();
    for scene in [CLOTH, SEWN] {
        for table in Schema(&scene_schema()).tables() {
            let headers =
                if table.headers.is_empty() { vec![String::new()] } else { table.headers };
            let is_scalar = |key: &&Key| {
                !["list", "pair", "triple", "2 ", "3 "]
                    .iter()
                    .any(|many| key.kind.starts_with(many))
            };
            for (header, key) in headers
                .iter()
                .flat_map(|h| table.keys.iter().filter(is_scalar).map(move |key| (h, key)))
            {
                // Points that are near enough, in place of an edge.
                let scene = match key.name.as_str() {
                    "radius" if header == "[[pin]]" => {
                        scene.replace("edge = \"top\"", "points = [[0, 0]]")
                    }
                    _ => scene.to_owned(),
                };
                for number in outside(key) {
                    let mut whole = Value::Table(scene.parse().expect("TOML"));
                    let places = headed(&mut whole, header);
                    let Some(place) = places.into_iter().next() else { continue };
                    place.insert(key.name.clone(), value(key, number));
                    let text = toml::to_string(&whole).expect("TOML");
                    tried += 1;
                    if !said(&text).contains(&key.name) {
                        accepted.push(format!("{header} {} = {number}: {}", key.name, said(&text)));
                    }
                }
            }
        }
    }
    assert!(tried >= 60, "{tried} numbers");
    assert!(accepted.is_empty(), "{} of {tried}:\n{}", accepted.len(), accepted.join("\n"));
}
