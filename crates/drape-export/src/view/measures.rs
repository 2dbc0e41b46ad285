//! Measures of a run as tables with units, from its summary.

use serde_json::{Map, Value, json};

use super::quantity::{Quantity, Unit};

/// Largest number of rows of a table; a run with thousands of edges would bury the others.
const ROWS_MAX: usize = 200;

/// Keys of the summary that the first table has.
const RUN: [&str; 6] =
    ["status", "settled", "simulated_seconds", "particles", "speed_max", "imbalance"];

/// Tables of the summary, in their order, with their titles.
const TABLES: [(&str, &str); 3] =
    [("strain", "strain at the end"), ("contact", "contact"), ("energy", "balance of the energy")];

/// Titles of tables of measures of garments.
const GARMENT_TABLES: [(&str, &str); 4] = [
    ("free_edges", "edges that are not sewn"),
    ("openings", "openings"),
    ("strain", "strain of the garment"),
    ("pressure", "pressure of contact"),
];

/// Columns of tables, in their order.
const COLUMNS: [&str; 3] = ["warp", "weft", "shear"];

/// Keys of texts that name an item of a list.
const NAMES: [&str; 3] = ["name", "edge", "edges"];

/// Table: rows of cells. The first cell of a row is its name. A row of one cell is the heading of
/// the rows that follow.
#[derive(Debug, Clone, PartialEq, Default)]
struct Table {
    title: String,
    /// Names of the columns of values, if they have names.
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Returns the results in `summary` as tables of text for the page.
///
/// Each table is an object of `title`, `columns` and `rows`. Keys without a plain name in this
/// crate are shown as they are.
pub(super) fn tables(summary: &Value) -> Vec<Value> {
    let mut tables = Vec::new();
    let mut run = Table { title: "run".to_owned(), ..Table::default() };
    for key in RUN {
        run.add(&[], key, &summary[key]);
    }
    tables.push(run);
    let measures = summary["measures"].as_object();
    tables.extend(measures.map(garment_tables).unwrap_or_default());
    for (key, title) in TABLES {
        tables.push(Table::new(&[], key, title, &summary[key]));
    }
    let filled = tables.into_iter().filter(|table| !table.rows.is_empty());
    filled.map(Table::json).collect()
}

/// Returns the tables of the `measures` of garments: a table of the numbers, and a table of each
/// list or object.
fn garment_tables(measures: &Map<String, Value>) -> Vec<Table> {
    let mut numbers = Table { title: "garment".to_owned(), ..Table::default() };
    let mut others = Vec::new();
    for key in ordered(&[], measures) {
        let value = &measures[key];
        if matches!(value, Value::Object(_) | Value::Array(_)) {
            let known = GARMENT_TABLES.iter().find(|(table, _)| *table == key);
            let title = known.map_or_else(|| spoken(key), |(_, title)| (*title).to_owned());
            others.push(Table::new(&[], key, &title, value));
        } else {
            numbers.add(&[], key, value);
        }
    }
    let mut tables = vec![numbers];
    tables.append(&mut others);
    tables
}

impl Table {
    /// Returns the table `title` of `value`, which has the key `key` below the keys `above`.
    fn new(above: &[&str], key: &str, title: &str, value: &Value) -> Table {
        let mut table = Table { title: title.to_owned(), ..Table::default() };
        let path: Vec<&str> = above.iter().copied().chain([key]).collect();
        match value {
            Value::Object(map) => {
                if !table.add_columns(&path, map) {
                    let keys = ordered(&path, map);
                    keys.into_iter().for_each(|key| table.add(&path, key, &map[key]));
                }
            }
            Value::Array(items) if items.iter().any(Value::is_object) => {
                table.add_items(&path, items);
            }
            other => table.add(above, key, other),
        }
        table
    }

    /// Adds the objects in `map` as columns if there are several objects and all have equal keys
    /// with simple values. Returns whether columns were added.
    fn add_columns(&mut self, path: &[&str], map: &Map<String, Value>) -> bool {
        let mut columns: Vec<(&str, &Map<String, Value>)> = Vec::new();
        for (key, value) in map {
            let Value::Object(column) = value else { return false };
            columns.push((key, column));
        }
        // The directions of a cloth come in their usual order.
        columns.sort_by_key(|(key, _)| COLUMNS.iter().position(|column| column == key));
        let [(outer, first), _, ..] = columns[..] else { return false };
        let is_alike = |column: &Map<String, Value>| {
            column.len() == first.len()
                && first.keys().all(|key| column.get(key).is_some_and(is_simple))
        };
        if !columns.iter().all(|(_, column)| is_alike(column)) {
            return false;
        }
        self.columns = columns.iter().map(|(key, _)| spoken(key)).collect();
        let below = |outer, key| path.iter().copied().chain([outer, key]).collect::<Vec<&str>>();
        let above: Vec<&str> = path.iter().copied().chain([outer]).collect();
        for key in ordered(&above, first) {
            let cells =
                columns.iter().map(|(outer, column)| text(unit(&below(outer, key)), &column[key]));
            self.rows.push([name(&below(outer, key))].into_iter().chain(cells).collect());
        }
        true
    }

    /// Adds `items` of the list at `path`, each below a heading with its name.
    fn add_items(&mut self, path: &[&str], items: &[Value]) {
        for (item, number) in items.iter().zip(1..) {
            let Value::Object(map) = item else {
                self.rows.push(vec![number.to_string(), text(Unit::None, item)]);
                continue;
            };
            let named = NAMES.iter().find_map(|key| Some((*key, words(map.get(*key)?)?)));
            let (key, heading) = named.unwrap_or(("", number.to_string()));
            self.rows.push(vec![heading]);
            for other in ordered(path, map).into_iter().filter(|other| *other != key) {
                self.add(path, other, &map[other]);
            }
        }
    }

    /// Adds the rows of `value`, which has the key `key` below the keys `above`. Adds nothing for
    /// null.
    fn add(&mut self, above: &[&str], key: &str, value: &Value) {
        let path: Vec<&str> = above.iter().copied().chain([key]).collect();
        match value {
            Value::Null => {}
            Value::Object(map) => {
                self.rows.push(vec![spoken(key)]);
                ordered(&path, map).into_iter().for_each(|key| self.add(&path, key, &map[key]));
            }
            Value::Array(items) if items.iter().any(Value::is_object) => {
                self.rows.push(vec![spoken(key)]);
                self.add_items(&path, items);
            }
            simple => self.rows.push(vec![name(&path), text(unit(&path), simple)]),
        }
    }

    fn json(mut self) -> Value {
        let left_out = self.rows.len().saturating_sub(ROWS_MAX);
        if left_out > 0 {
            self.rows.truncate(ROWS_MAX);
            self.rows.push(vec![format!("{left_out} more rows are in summary.json")]);
        }
        json!({ "title": self.title, "columns": self.columns, "rows": self.rows })
    }
}

/// Returns the keys of `map`, which is at `path`. Keys with plain names come first, in the order of
/// [`Quantity::rank`].
fn ordered<'a>(path: &[&str], map: &'a Map<String, Value>) -> Vec<&'a str> {
    let mut keys: Vec<&str> = map.keys().map(String::as_str).collect();
    keys.sort_by_key(|key| {
        let path: Vec<&str> = path.iter().copied().chain([*key]).collect();
        Quantity::rank(&path)
    });
    keys
}

/// Returns whether `value` is neither an object nor a list.
fn is_simple(value: &Value) -> bool {
    !matches!(value, Value::Object(_) | Value::Array(_))
}

/// Returns `value` as words if it is a text or a list of texts.
fn words(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Array(items) => {
            let texts: Option<Vec<&str>> = items.iter().map(Value::as_str).collect();
            texts.filter(|texts| !texts.is_empty()).map(|texts| texts.join(", "))
        }
        _ => None,
    }
}

/// Returns the plain name of the last key of `path`.
fn name(path: &[&str]) -> String {
    let key = path.last().copied().unwrap_or_default();
    match Quantity::of(path) {
        Some(quantity) => quantity.name.to_owned(),
        None => spoken(Unit::of_unknown(key).1),
    }
}

/// Returns the unit of the value at `path`.
fn unit(path: &[&str]) -> Unit {
    let key = path.last().copied().unwrap_or_default();
    Quantity::of(path).map_or_else(|| Unit::of_unknown(key).0, |quantity| quantity.unit)
}

/// Returns `key` as words.
fn spoken(key: &str) -> String {
    key.replace('_', " ")
}

/// Returns `value` in `unit` as text.
fn text(unit: Unit, value: &Value) -> String {
    match value {
        Value::Null => "none".to_owned(),
        Value::String(text) => text.clone(),
        Value::Bool(yes) => if *yes { "yes" } else { "no" }.to_owned(),
        Value::Number(number) => {
            number.as_f64().map_or_else(|| number.to_string(), |value| unit.written(value))
        }
        Value::Array(values) => {
            let all: Vec<String> = values.iter().map(|value| text(unit, value)).collect();
            all.join(", ")
        }
        Value::Object(map) => {
            let all = map.iter().map(|(key, value)| {
                let (unit, key) = Unit::of_unknown(key);
                format!("{} {}", spoken(key), text(unit, value))
            });
            all.collect::<Vec<_>>().join(", ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the table with a title, as rows of texts, with its columns first.
    fn table(tables: &[Value], title: &str) -> Vec<Vec<String>> {
        let table = tables.iter().find(|table| table["title"] == title).expect(title);
        let cells = |row: &Value| serde_json::from_value(row.clone()).expect("texts");
        let rows = table["rows"].as_array().expect("rows").iter().map(cells);
        let columns: Vec<String> = cells(&table["columns"]);
        Some(columns).filter(|columns| !columns.is_empty()).into_iter().chain(rows).collect()
    }

    #[test]
    fn a_summary_is_told_in_tables_with_names_and_units() {
        let summary = json!({
            "status": "ok", "particles": 6561, "settled": true, "wall_seconds": 3.5,
            "simulated_seconds": 3.5, "strain": { "traction_max": 0.012_345_678 },
            "contact": { "min_distance": 0.000_156_71, "intersections": 0, "grown": 1.0 },
            "energy": { "kinetic": 1.8e-3, "gravity": -2.25 },
            "measures": {
                "seam_gap_max": 0.0,
                "free_edges": [{ "edge": "hem.left", "height_mean": 0.4213, "length": 0.128 }],
                "openings": [
                    { "edges": ["hem.left", "hem.right"], "length": 0.631, "ease": -0.0081, "body": null },
                    { "edges": ["neck.top"], "folds": 4 },
                ],
                "strain": {
                    "shear": { "max": 0.4237, "min": -0.4089 }, "warp": { "max": 0.0364, "min": -0.0776 },
                },
            },
        });
        let tables = tables(&summary);
        let titles: Vec<&Value> = tables.iter().map(|table| &table["title"]).collect();
        let expected = [
            "run",
            "garment",
            "edges that are not sewn",
            "openings",
            "strain of the garment",
            "strain at the end",
            "contact",
            "balance of the energy",
        ];
        assert_eq!(titles, expected);
        let run = [
            ["status", "ok"],
            ["at rest", "yes"],
            ["simulated time", "3.5 s"],
            ["particles", "6561"],
        ];
        assert_eq!(table(&tables, "run"), run);
        assert_eq!(table(&tables, "garment"), [["widest gap of a seam", "0 mm"]]);
        let openings: [&[&str]; 5] = [
            &["hem.left, hem.right"],
            &["length", "631 mm"],
            &["ease", "−8.1 mm"],
            &["neck.top"],
            &["folds", "4"],
        ];
        assert_eq!(table(&tables, "openings"), openings);
        let strain: [&[&str]; 3] = [
            &["warp", "shear"],
            &["smallest", "−7.76 %", "−23.4°"],
            &["largest", "3.64 %", "24.3°"],
        ];
        assert_eq!(table(&tables, "strain of the garment"), strain);
        let energy = [["kinetic", "1.8 mJ"], ["gravity", "−2.25 J"]];
        assert_eq!(table(&tables, "balance of the energy"), energy);
    }

    #[test]
    fn keys_that_nobody_knows_are_words_and_no_json() {
        let summary = json!({
            "measures": {
                "sway_deg": 12.25, "odd": { "deep": { "one_mm": 2.5, "two": [1, -2.5] }, "text": "x" },
                "list": [{ "what": true, "nested": [{ "name": "a", "b": 1 }] }, 3],
                "sides": { "left": { "a": 1 }, "right": { "a": null } },
                "plain": [0.25, 0.5],
            },
            "contact": { "new_count": 3 },
        });
        let tables = tables(&summary);
        assert_eq!(table(&tables, "garment"), [["sway", "12.2°"]]);
        let odd: [&[&str]; 4] =
            [&["deep"], &["one", "2.5 mm"], &["two", "1, −2.5"], &["text", "x"]];
        assert_eq!(table(&tables, "odd"), odd);
        let list: [&[&str]; 6] =
            [&["1"], &["nested"], &["a"], &["b", "1"], &["what", "yes"], &["2", "3"]];
        assert_eq!(table(&tables, "list"), list);
        assert_eq!(table(&tables, "sides"), [&["left", "right"][..], &["a", "1", "none"]]);
        assert_eq!(table(&tables, "plain"), [["plain", "0.25, 0.5"]]);
        assert_eq!(table(&tables, "contact"), [["new count", "3"]]);
        for cell in tables
            .iter()
            .flat_map(|table| table["rows"].as_array().expect("rows"))
            .flat_map(|row| row.as_array().expect("cells"))
        {
            let text = cell.as_str().expect("a text");
            assert!(!text.contains(['{', '[', '"', '_']), "{text}");
        }
    }

    #[test]
    fn a_long_list_says_how_many_rows_it_leaves_out() {
        let edges: Vec<Value> =
            (0..150).map(|k| json!({ "edge": k.to_string(), "length": 1 })).collect();
        let tables = tables(&json!({ "measures": { "free_edges": edges } }));
        let rows = table(&tables, "edges that are not sewn");
        assert_eq!(rows.len(), ROWS_MAX + 1);
        assert_eq!(rows[ROWS_MAX], ["100 more rows are in summary.json"]);
    }
}
