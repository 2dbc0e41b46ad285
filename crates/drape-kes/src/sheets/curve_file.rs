//! A `[[curve]]` of a sheet and the table file that it names, made into a curve in SI.
//!
//! Each axis is read once, as numbers with their parsed unit; conversion and checks use that unit.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostics, closest};

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::sheets::findings::Findings;
use crate::sheets::section::{Choice, ColumnOrLength, Section};
use crate::sheets::suspect::{AsWritten, AxesAsWritten, Keys, examine};
use crate::sheets::table::{Column, Table};
use crate::test::{Direction, Test};
use drape_input::{Quantity, Unit, parse_unit};

const CURVE_KEYS: [&str; 7] = ["name", "test", "direction", "file", "deformation", "load", "slack"];
const DEFORMATION_KEYS: [&str; 3] = ["column", "unit", "gauge"];
const LOAD_KEYS: [&str; 3] = ["column", "unit", "width"];

const TEST: Choice<'_, Test> = Choice {
    key: "test",
    values: &[Test::Tensile, Test::Shear, Test::Bending, Test::LoopBending],
    name: Test::name,
};
const DIRECTION: Choice<'_, Direction> =
    Choice { key: "direction", values: &[Direction::Warp, Direction::Weft], name: Direction::name };

/// Column of one axis, as the sheet names it, with its key paths for messages.
struct AxisKeys {
    column: Column,
    unit: Option<String>,
    /// Gauge of a deformation, or width of a load.
    size: Option<ColumnOrLength>,
    unit_key: String,
    size_key: String,
}

/// Numbers of an axis as written, with their unit.
struct Numbers {
    unit: Unit,
    numbers: Vec<f64>,
}

impl Numbers {
    fn as_written(&self, size: Option<f64>) -> AsWritten {
        let largest = self.numbers.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        AsWritten { largest, unit: self.unit, size }
    }
}

/// Axis in SI, with the numbers that it was written in.
struct AxisValues {
    si: Vec<f64>,
    written: AsWritten,
}

/// Reads the curve that a section describes; `None` after reporting why there is none.
pub(crate) fn read(section: &Section<'_>, findings: &mut Findings<'_>) -> Option<Curve> {
    section.allow(&CURVE_KEYS, findings);
    let test = section.required_choice(&TEST, findings);
    let direction = section.required_choice(&DIRECTION, findings);
    let name = section.text("name", findings);
    let slack = section.flag("slack", findings);
    let file = section.required_text("file", "\"tensile-warp.csv\"", findings);
    let deformation = axis(section, "deformation", &DEFORMATION_KEYS, findings);
    let load = axis(section, "load", &LOAD_KEYS, findings);
    let (test, direction, file) = (test?, direction?, file?);
    let (deformation, load) = (deformation?, load?);

    let table = open(&file, &section.key("file"), findings)?;
    let deformation = deformations(test, &deformation, &table, findings)?;
    let load = loads(test, &load, &table, findings)?;
    match Curve::new(test, direction, deformation.si, load.si) {
        Ok(mut curve) => {
            if let Some(name) = name {
                curve.name = name;
            }
            (curve.gauge, curve.slack) = (deformation.written.size, slack);
            if let Some(line) = table.truncated() {
                let message = format!("line {line} of {} breaks off", table.path().display());
                findings.warn(&section.key("file"), message, "it was left out");
            }
            let keys = Keys {
                file: section.key("file"),
                deformation: section.key("deformation"),
                load: section.key("load"),
            };
            let written = AxesAsWritten { deformation: deformation.written, load: load.written };
            examine(curve, &written, &keys, findings)
        }
        Err(error) => {
            let help = match error {
                Error::TooFewPoints { .. } => "write one point per line",
                _ => "check that the right column is named",
            };
            findings.errors.push(table.finding(error.to_string()).help(help));
            None
        }
    }
}

/// Reads the keys of an axis; the last of them is that of its gauge or width.
fn axis(
    section: &Section<'_>,
    key: &str,
    keys: &[&str; 3],
    findings: &mut Findings<'_>,
) -> Option<AxisKeys> {
    let example = "{ column = \"name in the header\", unit = \"…\" }";
    let axis = section.required_section(key, example, findings)?;
    axis.allow(keys, findings);
    let unit = axis.text("unit", findings);
    let size = axis.column_or_length(keys[2], findings);
    let column = axis.column("column", findings)?;
    Some(AxisKeys { column, unit, size, unit_key: axis.key("unit"), size_key: axis.key(keys[2]) })
}

/// Opens the table file, which is beside the sheet.
fn open(file: &str, key: &str, findings: &mut Findings<'_>) -> Option<Table> {
    let sheet = findings.document.path();
    let path = sheet.parent().map_or_else(|| PathBuf::from(file), |folder| folder.join(file));
    if path.is_file() {
        return collect(Table::read(&path), findings);
    }
    let help = suggestion(&path, file);
    findings.error(key, format!("there is no file {}", path.display()), help);
    None
}

/// Suggests the file that was meant by a name that does not exist.
fn suggestion(path: &Path, written: &str) -> String {
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

/// Reads the deformations, with the gauge where there is one.
fn deformations(
    test: Test,
    axis: &AxisKeys,
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let accepted: &[Quantity] = match test {
        Test::Tensile => &[Quantity::Ratio, Quantity::Length],
        Test::Shear => &[Quantity::Angle],
        Test::Bending => &[Quantity::Curvature],
        Test::LoopBending => &[Quantity::Length],
    };
    let written = numbers(axis, accepted, table, findings)?;
    let Numbers { unit, numbers } = &written;
    let gauge = sizes(axis, numbers.len(), table, findings)?;
    let first = gauge.as_ref().map(|gauge| gauge[0]);
    if unit.quantity != Quantity::Length {
        let si = numbers.iter().map(|&number| number * unit.factor).collect();
        return Some(AxisValues { si, written: written.as_written(first) });
    }
    let Some(gauge) = gauge else {
        let help = "add gauge = \"5 cm\", or the name of the column that holds it in metres";
        findings.error(&axis.size_key, "is missing: a clamp distance needs it", help);
        return None;
    };
    let strain = numbers.iter().zip(&gauge).map(|(&d, &length)| d * unit.factor / length - 1.0);
    Some(AxisValues { si: strain.collect(), written: written.as_written(first) })
}

/// Reads the loads per width.
fn loads(
    test: Test,
    axis: &AxisKeys,
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let accepted = match test {
        Test::Bending => [Quantity::MomentPerWidth, Quantity::Moment],
        _ => [Quantity::ForcePerWidth, Quantity::Force],
    };
    let written = numbers(axis, &accepted, table, findings)?;
    let Numbers { unit, numbers } = &written;
    let width = sizes(axis, numbers.len(), table, findings)?;
    let per_width = unit.quantity == accepted[0];
    match (per_width, width) {
        (true, None) => {
            let si = numbers.iter().map(|&load| load * unit.factor).collect();
            Some(AxisValues { si, written: written.as_written(None) })
        }
        (false, Some(width)) => {
            let pairs = numbers.iter().zip(&width);
            let si = pairs.map(|(&load, &w)| load * unit.factor / w).collect();
            Some(AxisValues { si, written: written.as_written(Some(width[0])) })
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

/// Reads the numbers of a column, and their unit from the sheet or from the header of the file.
fn numbers(
    axis: &AxisKeys,
    accepted: &[Quantity],
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<Numbers> {
    let column = collect(table.find(&axis.column), findings)?;
    let Some(text) = axis.unit.as_deref().or(table.unit(column)) else {
        let unit = accepted[0].laboratory().spelling;
        let help = format!("add unit = \"{unit}\", or the unit that was used");
        findings.error(&axis.unit_key, "is missing, and the column's header names none", help);
        return None;
    };
    let unit = match parse_unit(text, accepted) {
        Ok(unit) => unit,
        Err(error) => {
            findings.error(&axis.unit_key, error.message, error.help);
            return None;
        }
    };
    Some(Numbers { unit, numbers: collect(table.numbers(column), findings)? })
}

/// Reads a gauge or a width for each row, in metres; the inner `None` where none is given.
fn sizes(
    axis: &AxisKeys,
    rows: usize,
    table: &Table,
    findings: &mut Findings<'_>,
) -> Option<Option<Vec<f64>>> {
    match &axis.size {
        None => Some(None),
        Some(ColumnOrLength::Length(length)) => Some(Some(vec![*length; rows])),
        Some(ColumnOrLength::Column(column)) => {
            let column = collect(table.find(column), findings)?;
            let sizes = collect(table.numbers(column), findings)?;
            if let Some(size) = sizes.iter().find(|&&size| size <= 0.0) {
                let message = format!("{}: the file has a length of {size} m", axis.size_key);
                findings.errors.push(table.finding(message).help("a length is positive"));
                return None;
            }
            Some(Some(sizes))
        }
    }
}

/// Returns a result, or `None` after collecting its mistakes.
fn collect<T>(result: Result<T, Diagnostics>, findings: &mut Findings<'_>) -> Option<T> {
    result.map_err(|Diagnostics(mistakes)| findings.errors.extend(mistakes)).ok()
}
