//! A `[[curve]]` of a sheet and the table file it names, made into a curve in SI.

use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::section::{ColumnOrLength, Findings, Section};
use crate::spelling;
use crate::table::{Column, Table};
use crate::unit::{self, Quantity, Unit};
use crate::{Curve, Diagnostic, Direction, Error, Test};

pub(crate) const CURVE_KEYS: [&str; 7] = [
    "name",
    "test",
    "direction",
    "file",
    "deformation",
    "load",
    "slack",
];
const DEFORMATION_KEYS: [&str; 3] = ["column", "unit", "gauge"];
const LOAD_KEYS: [&str; 3] = ["column", "unit", "width"];

const TESTS: [Test; 4] = [Test::Tensile, Test::Shear, Test::Bending, Test::LoopBending];
const DIRECTIONS: [Direction; 2] = [Direction::Warp, Direction::Weft];

/// How one axis of a curve is found in the file.
struct Axis {
    column: Column,
    column_span: Range<usize>,
    unit: Option<(String, Range<usize>)>,
    /// The gauge of a deformation, or the width of a load.
    size: Option<ColumnOrLength>,
    section_span: Range<usize>,
    name: String,
}

/// The curve that a section describes, or nothing after reporting why not.
pub(crate) fn read(section: &Section<'_>, findings: &mut Findings<'_>) -> Option<Curve> {
    let test = choice(section, "test", &TESTS, Test::name, findings);
    let direction = choice(section, "direction", &DIRECTIONS, Direction::name, findings);
    let name = section.text("name", findings);
    let slack = section.flag("slack", findings);
    let file = section.required_text("file", "\"tensile-warp.csv\"", findings);
    let deformation = axis(section, "deformation", &DEFORMATION_KEYS, "gauge", findings);
    let load = axis(section, "load", &LOAD_KEYS, "width", findings);
    let (test, direction, file) = (test?, direction?, file?);
    let (deformation, load) = (deformation?, load?);

    let table = open(&file, findings)?;
    let (strain, gauge) = deformations(test, &deformation, &table, findings)?;
    let force = loads(test, &load, &table, findings)?;
    match Curve::new(test, direction, strain, force) {
        Ok(mut curve) => {
            if let Some((name, _)) = name {
                curve.name = name;
            }
            (curve.gauge, curve.slack) = (gauge, slack);
            Some(curve)
        }
        Err(error) => {
            let help = match error {
                Error::TooShort { .. } => "a curve needs at least two points, one per line",
                _ => "check that the right column is named",
            };
            let path = sibling(&findings.path, &file.0);
            let finding = Diagnostic::new(path, error.to_string()).with_help(help);
            findings.errors.push(finding);
            None
        }
    }
}

/// One of a few words, with a suggestion when it is none of them.
fn choice<T: Copy>(
    section: &Section<'_>,
    key: &str,
    choices: &[T],
    name: fn(T) -> &'static str,
    findings: &mut Findings<'_>,
) -> Option<T> {
    let names: Vec<&str> = choices.iter().map(|&choice| name(choice)).collect();
    let example = format!("\"{}\"", names[0]);
    let (written, span) = section.required_text(key, &example, findings)?;
    if let Some(place) = names.iter().position(|name| *name == written) {
        return Some(choices[place]);
    }
    let hint = spelling::closest(&written, names.iter().copied())
        .map(|close| format!("did you mean \"{close}\"? "))
        .unwrap_or_default();
    findings.error(
        &span,
        format!(
            "{} is \"{written}\", which is not known",
            section.field(key)
        ),
        format!("{hint}it is one of {}", names.join(", ")),
    );
    None
}

fn axis(
    section: &Section<'_>,
    key: &str,
    keys: &[&str],
    size_key: &str,
    findings: &mut Findings<'_>,
) -> Option<Axis> {
    let example = "{ column = \"name in the header\", unit = \"…\" }";
    let axis = section.required_section(key, example, findings)?;
    axis.allow(keys, findings);
    let unit = axis.text("unit", findings);
    let size = axis.column_or_length(size_key, findings);
    let (column, column_span) = axis.column("column", findings)?;
    Some(Axis {
        column,
        column_span,
        unit,
        size,
        section_span: axis.span,
        name: axis.name,
    })
}

fn sibling(sheet: &Path, file: &str) -> PathBuf {
    sheet
        .parent()
        .map_or_else(|| PathBuf::from(file), |folder| folder.join(file))
}

/// The table file, which stands beside the sheet.
fn open(file: &(String, Range<usize>), findings: &mut Findings<'_>) -> Option<Table> {
    let path = sibling(&findings.path, &file.0);
    if !path.is_file() {
        let help = neighbours(&path, &file.0);
        findings.error(
            &file.1,
            format!("there is no file {}", path.display()),
            help,
        );
        return None;
    }
    Table::read(&path)
        .map_err(|finding| findings.errors.push(finding))
        .ok()
}

/// What could have been meant by the name of a file that is not there.
fn neighbours(path: &Path, written: &str) -> String {
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
    match spelling::closest(written, names.iter().map(String::as_str)) {
        Some(close) => format!("did you mean \"{close}\"? files are looked for beside the sheet"),
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
        return Some((
            numbers.iter().map(|&number| number * unit.factor).collect(),
            length,
        ));
    }
    let Some(gauge) = gauge else {
        findings.error(
            &axis.section_span,
            format!("{} is a clamp distance and has no \"gauge\"", axis.name),
            "add gauge = \"5 cm\", or the name of the column that holds it in metres",
        );
        return None;
    };
    let strain = numbers
        .iter()
        .zip(&gauge)
        .map(|(&d, &length)| d * unit.factor / length - 1.0);
    Some((strain.collect(), Some(gauge[0])))
}

/// The loads per width in SI.
fn loads(test: Test, axis: &Axis, table: &Table, findings: &mut Findings<'_>) -> Option<Vec<f64>> {
    let accepted: &[Quantity] = match test {
        Test::Bending => &[Quantity::MomentPerWidth, Quantity::Moment],
        _ => &[Quantity::ForcePerWidth, Quantity::Force],
    };
    let (unit, numbers) = numbers(axis, accepted, table, findings)?;
    let width = sizes(axis, numbers.len(), table, findings)?;
    let per_width = unit.quantity == accepted[0];
    match (per_width, width) {
        (true, None) => Some(numbers.iter().map(|&number| number * unit.factor).collect()),
        (false, Some(width)) => Some(
            numbers
                .iter()
                .zip(&width)
                .map(|(&load, &w)| load * unit.factor / w)
                .collect(),
        ),
        (true, Some(_)) => {
            findings.error(
                &axis.section_span,
                format!("{} is per width already and has a \"width\" too", axis.name),
                "remove width, or give the unit of the whole load",
            );
            None
        }
        (false, None) => {
            findings.error(
                &axis.section_span,
                format!(
                    "{} is a {} and has no \"width\"",
                    axis.name,
                    unit.quantity.name()
                ),
                "add width = \"20 cm\", or the name of the column that holds it in metres",
            );
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
    let (text, span) = match (&axis.unit, table.unit(place)) {
        (Some((text, span)), _) => (text.as_str(), span),
        (None, Some(text)) => (text, &axis.column_span),
        (None, None) => {
            let units = accepted[0].laboratory().spelling;
            findings.error(
                &axis.section_span,
                format!(
                    "{} has no unit, and the header of its column names none",
                    axis.name
                ),
                format!("add unit = \"{units}\" or the unit it was written in"),
            );
            return None;
        }
    };
    let unit = match unit::parse_unit(text, accepted) {
        Ok(unit) => unit,
        Err(error) => {
            findings.error(
                span,
                format!("{}: {}", axis.name, error.message),
                error.help,
            );
            return None;
        }
    };
    let numbers = found(table.numbers(place), findings)?;
    Some((
        unit,
        numbers.into_iter().map(|(_, number)| number).collect(),
    ))
}

/// A gauge or a width for each row, in metres.
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
            if let Some((line, size)) = sizes.iter().find(|(_, size)| *size <= 0.0) {
                let message = format!("{}: a length of {size} m in the file", axis.name);
                let finding = table.finding(message).at_line(*line);
                findings
                    .errors
                    .push(finding.with_help("a gauge or a width is positive"));
                return None;
            }
            Some(Some(sizes.into_iter().map(|(_, size)| size).collect()))
        }
    }
}

fn found<T>(result: Result<T, Diagnostic>, findings: &mut Findings<'_>) -> Option<T> {
    result.map_err(|finding| findings.errors.push(finding)).ok()
}
