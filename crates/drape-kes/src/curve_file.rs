//! A `[[curve]]` of a sheet and the table file it names, made into a curve in SI.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostics, closest};

use crate::section::{ColumnOrLength, Findings, Section};
use crate::suspect::{self, Factors, Keys};
use crate::table::{Column, Table};
use crate::unit::{self, Quantity, Unit};
use crate::{Curve, Direction, Error, Test};

const CURVE_KEYS: [&str; 7] = ["name", "test", "direction", "file", "deformation", "load", "slack"];
const DEFORMATION_KEYS: [&str; 3] = ["column", "unit", "gauge"];
const LOAD_KEYS: [&str; 3] = ["column", "unit", "width"];

const TESTS: [Test; 4] = [Test::Tensile, Test::Shear, Test::Bending, Test::LoopBending];
const DIRECTIONS: [Direction; 2] = [Direction::Warp, Direction::Weft];

/// How one axis of a curve is found in the file, with its key paths for messages.
struct Axis {
    column: Column,
    unit: Option<String>,
    /// The gauge of a deformation, or the width of a load.
    size: Option<ColumnOrLength>,
    unit_key: String,
    size_key: String,
}

/// The curve that a section describes, or nothing after reporting why not.
pub(crate) fn read(section: &Section<'_>, findings: &mut Findings<'_>) -> Option<Curve> {
    section.allow(&CURVE_KEYS, findings);
    let test = section.required_choice(("test", &TESTS), Test::name, findings);
    let direction = section.required_choice(("direction", &DIRECTIONS), Direction::name, findings);
    let name = section.text("name", findings);
    let slack = section.flag("slack", findings);
    let file = section.required_text("file", "\"tensile-warp.csv\"", findings);
    let deformation = axis(section, "deformation", &DEFORMATION_KEYS, findings);
    let load = axis(section, "load", &LOAD_KEYS, findings);
    let (test, direction, file) = (test?, direction?, file?);
    let (deformation, load) = (deformation?, load?);

    let table = open(&file, &section.key("file"), findings)?;
    let (strain, gauge) = deformations(test, &deformation, &table, findings)?;
    let force = loads(test, &load, &table, findings)?;
    let factors = Factors {
        deformation: factor(&deformation, &table, &strain),
        load: factor(&load, &table, &force),
    };
    match Curve::new(test, direction, strain, force) {
        Ok(mut curve) => {
            if let Some(name) = name {
                curve.name = name;
            }
            (curve.gauge, curve.slack) = (gauge, slack);
            if let Some(line) = table.truncated() {
                let message = format!("line {line} of {} breaks off", table.path().display());
                findings.warn(&section.key("file"), message, "it was left out");
            }
            let keys = Keys {
                file: section.key("file"),
                deformation: section.key("deformation"),
                load: section.key("load"),
            };
            suspect::examine(curve, &factors, &keys, findings)
        }
        Err(error) => {
            let help = match error {
                Error::TooShort { .. } => "write one point per line",
                _ => "check that the right column is named",
            };
            findings.errors.push(table.finding(error.to_string()).help(help));
            None
        }
    }
}

/// What the largest number of a column was multiplied by on its way to SI.
fn factor(axis: &Axis, table: &Table, si: &[f64]) -> f64 {
    let written = table.find(&axis.column).and_then(|place| table.numbers(place));
    let pairs = written.iter().flatten().zip(si);
    let largest = pairs.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    largest.map_or(1.0, |(written, si)| si / written)
}

/// An axis; the last of its keys is that of its gauge or width.
fn axis(
    section: &Section<'_>,
    key: &str,
    keys: &[&str; 3],
    findings: &mut Findings<'_>,
) -> Option<Axis> {
    let example = "{ column = \"name in the header\", unit = \"…\" }";
    let axis = section.required_section(key, example, findings)?;
    axis.allow(keys, findings);
    let unit = axis.text("unit", findings);
    let size = axis.column_or_length(keys[2], findings);
    let column = axis.column("column", findings)?;
    Some(Axis { column, unit, size, unit_key: axis.key("unit"), size_key: axis.key(keys[2]) })
}

/// The table file, which stands beside the sheet.
fn open(file: &str, key: &str, findings: &mut Findings<'_>) -> Option<Table> {
    let sheet = findings.document.path();
    let path = sheet.parent().map_or_else(|| PathBuf::from(file), |folder| folder.join(file));
    if path.is_file() {
        return found(Table::read(&path), findings);
    }
    let help = neighbour(&path, file);
    findings.error(key, format!("there is no file {}", path.display()), help);
    None
}

/// What could have been meant by the name of a file that is not there.
fn neighbour(path: &Path, written: &str) -> String {
    let mut names: Vec<String> = path
        .parent()
        .and_then(|folder| std::fs::read_dir(folder).ok())
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .filter(|name| !name.ends_with(".toml"))
        .collect();
    names.sort();
    match closest(written, names.iter().map(String::as_str)) {
        Some(close) => format!("did you mean \"{close}\"?"),
        None => "files are looked for beside the sheet".to_owned(),
    }
}

/// The deformations in SI, and the gauge where there is one.
fn deformations(
    test: Test,
    axis: &Axis,
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<(Vec<f64>, Option<f64>)> {
    let accepted: &[Quantity] = match test {
        Test::Tensile => &[Quantity::Ratio, Quantity::Length],
        Test::Shear => &[Quantity::Angle],
        Test::Bending => &[Quantity::Curvature],
        Test::LoopBending => &[Quantity::Length],
    };
    let (unit, numbers) = numbers(axis, accepted, table, findings)?;
    let gauge = sizes(axis, numbers.len(), table, findings)?;
    if unit.quantity != Quantity::Length {
        let length = gauge.map(|gauge| gauge[0]);
        return Some((numbers.iter().map(|&number| number * unit.factor).collect(), length));
    }
    let Some(gauge) = gauge else {
        let help = "add gauge = \"5 cm\", or the name of the column that holds it in metres";
        findings.error(&axis.size_key, "is missing: a clamp distance needs it", help);
        return None;
    };
    let strain = numbers.iter().zip(&gauge).map(|(&d, &length)| d * unit.factor / length - 1.0);
    Some((strain.collect(), Some(gauge[0])))
}

/// The loads per width in SI.
fn loads(test: Test, axis: &Axis, table: &Table, findings: &mut Findings<'_>) -> Option<Vec<f64>> {
    let accepted = match test {
        Test::Bending => [Quantity::MomentPerWidth, Quantity::Moment],
        _ => [Quantity::ForcePerWidth, Quantity::Force],
    };
    let (unit, numbers) = numbers(axis, &accepted, table, findings)?;
    let width = sizes(axis, numbers.len(), table, findings)?;
    let per_width = unit.quantity == accepted[0];
    match (per_width, width) {
        (true, None) => Some(numbers.iter().map(|&load| load * unit.factor).collect()),
        (false, Some(width)) => {
            Some(numbers.iter().zip(&width).map(|(&load, &w)| load * unit.factor / w).collect())
        }
        (true, Some(_)) => {
            let message = format!("given, but {} is per width already", unit.spelling);
            findings.error(
                &axis.size_key,
                message,
                "remove it, or give the unit of the whole load",
            );
            None
        }
        (false, None) => {
            let message = format!("is missing: a load in {} needs it", unit.spelling);
            let help = "add width = \"20 cm\", or the name of the column that holds it in metres";
            findings.error(&axis.size_key, message, help);
            None
        }
    }
}

/// The numbers of a column as written, and their unit, from the sheet or from the file's header.
fn numbers(
    axis: &Axis,
    accepted: &[Quantity],
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<(Unit, Vec<f64>)> {
    let place = found(table.find(&axis.column), findings)?;
    let Some(text) = axis.unit.as_deref().or(table.unit(place)) else {
        let unit = accepted[0].laboratory().spelling;
        let help = format!("add unit = \"{unit}\", or the unit that was used");
        findings.error(&axis.unit_key, "is missing, and the column's header names none", help);
        return None;
    };
    let unit = match unit::parse_unit(text, accepted) {
        Ok(unit) => unit,
        Err(error) => {
            findings.error(&axis.unit_key, error.message, error.help);
            return None;
        }
    };
    Some((unit, found(table.numbers(place), findings)?))
}

/// A gauge or a width for each row, in metres; none where none is given.
fn sizes(
    axis: &Axis,
    rows: usize,
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<Option<Vec<f64>>> {
    match &axis.size {
        None => Some(None),
        Some(ColumnOrLength::Length(length)) => Some(Some(vec![*length; rows])),
        Some(ColumnOrLength::Column(column)) => {
            let place = found(table.find(column), findings)?;
            let sizes = found(table.numbers(place), findings)?;
            if let Some(size) = sizes.iter().find(|&&size| size <= 0.0) {
                let message = format!("{}: the file has a length of {size} m", axis.size_key);
                findings.errors.push(table.finding(message).help("a length is positive"));
                return None;
            }
            Some(Some(sizes))
        }
    }
}

fn found<T>(result: Result<T, Diagnostics>, findings: &mut Findings<'_>) -> Option<T> {
    result.map_err(|Diagnostics(mistakes)| findings.errors.extend(mistakes)).ok()
}
