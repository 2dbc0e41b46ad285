//! `drape fabric list`: the sheets in folders.

use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::kes::Sheet;
use serde_json::{Value, json};

use crate::commands::sheets;
use crate::failure::Failure;
use crate::say::{say, say_json};

/// Lists the sheets in `folders`, and reports the mistakes of all sheets at the end.
pub(super) fn list(folders: &[PathBuf], json: bool) -> Result<(), Failure> {
    let paths = sheets::find_sheets(folders)?;
    let sheets: Vec<_> = paths.iter().map(|path| (path, sheets::read(path))).collect();
    if json {
        let rows = sheets.iter().filter_map(|(path, sheet)| Some(row(path, sheet.as_ref().ok()?)));
        say_json(&rows.collect::<Vec<_>>())?;
    } else {
        table(&sheets)?;
    }
    let failed = sheets.into_iter().filter_map(|(_, sheet)| sheet.err());
    let mistakes: Vec<Diagnostic> = failed.flat_map(|mistakes| mistakes.0).collect();
    Ok(Diagnostics::check(mistakes)?)
}

/// Prints the table of the `sheets` that could be read.
fn table(sheets: &[(&PathBuf, Result<Sheet, Diagnostics>)]) -> Result<(), Failure> {
    say(format_args!("{:<44} {:>6} {:>7}  {:<38} sheet", "fabric", "g/m²", "mm", "measured"))?;
    let read = sheets.iter().filter_map(|(path, sheet)| Some((path, sheet.as_ref().ok()?)));
    for (path, sheet) in read {
        say(line(path, sheet))?;
    }
    Ok(())
}

/// Returns the names of the tests of which `sheet` has curves, followed by `values` if it has
/// values.
fn measured(sheet: &Sheet) -> Vec<&str> {
    let mut tests: Vec<&str> = sheet.curves.iter().map(|curve| curve.test.name()).collect();
    tests.dedup();
    if !sheet.warp.is_empty() || !sheet.weft.is_empty() {
        tests.push("values");
    }
    tests
}

/// Returns the `sheet` at `path` as JSON.
fn row(path: &Path, sheet: &Sheet) -> Value {
    json!({
        "sheet": path,
        "name": sheet.name,
        "density": sheet.density(),
        "thickness": sheet.thickness(),
        "measured": measured(sheet),
    })
}

/// Returns the line of the table for `sheet`: mass in g/m², thickness in mm, and what was measured.
fn number(value: Option<f64>, scale: f64, digits: usize) -> String {
    value.map_or("–".into(), |value| format!("{:.digits$}", value * scale))
}

fn line(path: &Path, sheet: &Sheet) -> String {
    format!(
        "{:<44} {:>6} {:>7}  {:<38} {}",
        sheet.name,
        number(sheet.density(), 1e3, 1),
        number(sheet.thickness(), 1e3, 3),
        measured(sheet).join(", "),
        path.display()
    )
}
