//! Columns as written, converted to deformation and load per width in SI.
//!
//! A length `$d$` is a strain by its gauge `$l$`, whichever zero it has:
//!
//! ```math
//! \varepsilon = d/l \;\text{(extension)}, \qquad d/l - 1 \;\text{(distance of the clamps)}, \qquad
//! (d - d_0)/l \;\text{(position of a clamp)}
//! ```
//!
//! In shear the length is that across the strip, and the angle its arc tangent.

use drape_input::Diagnostic;

use crate::sheets::axis::{AxisKeys, Zero, deformations, loads};
use crate::sheets::checks::suspect::AsWritten;
use crate::sheets::findings::Findings;
use crate::sheets::section::ColumnOrLength;
use crate::tables::columns::named;
use crate::tables::heading::words::Words;
use crate::tables::heading::{self, Kind};
use crate::tables::series::Series;
use crate::tables::stated::{GAUGE, WIDTH};
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

/// Largest first length, over the gauge, of an extension: a slack strip may begin below zero.
const FIRST_EXTENSION: f64 = 0.3;
/// Largest difference of the first length to the gauge, over it, of a distance of clamps.
const FIRST_DISTANCE: f64 = 0.3;

/// Axis in SI, with the numbers that it was written in.
pub(crate) struct AxisValues {
    pub(crate) si: Vec<f64>,
    pub(crate) written: AsWritten,
    /// What it was taken for, in words.
    pub(crate) reading: String,
}

/// Column of a series.
#[derive(Clone, Copy)]
struct AxisColumn<'a> {
    series: &'a Series,
    column: usize,
}

/// Numbers of a column with their unit.
struct Numbers {
    unit: Unit,
    numbers: Vec<f64>,
    /// Name of the column for the reading.
    column: String,
    kind: Option<Kind>,
}

impl Numbers {
    fn as_written(&self, size: Option<f64>, zero: Option<Zero>) -> AsWritten {
        let largest = self.numbers.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let first = self.numbers[0];
        AsWritten { largest, first, unit: self.unit, size, zero }
    }
}

/// Reads the deformations, with the gauge where there is one.
pub(crate) fn deformation(
    test: Test,
    axis: &AxisKeys,
    series: &Series,
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let column = series.pair.deformation;
    let written = numbers(axis, deformations(test), &AxisColumn { series, column }, findings)?;
    let sign = sign(axis);
    let name = format!("deformation from {} in {}", written.column, written.unit.spelling);
    if written.unit.quantity != Quantity::Length {
        let gauge = sizes(axis, series, findings)?.map(|gauge| gauge[0]);
        let factor = sign * written.unit.factor;
        let si = written.numbers.iter().map(|&number| number * factor).collect();
        let written = written.as_written(gauge, None);
        return Some(AxisValues { si, written, reading: name });
    }
    let given = sizes(axis, series, findings)?;
    let Some((gauge, of_gauge)) = or_of_file(given, series, GAUGE, findings)? else {
        let help = "add gauge = \"5 cm\", or the name of the column that holds it";
        findings.error(&axis.size_key, "is missing: a clamp distance needs it", help);
        return None;
    };
    let factor = written.unit.factor;
    let first = written.numbers[0] * factor / gauge[0];
    let zero = match test {
        // The arch of loop bending is measured by the distance of its clamps, from any start.
        Test::LoopBending => axis.zero.unwrap_or(Zero::Distance),
        _ => zero(axis, &written, first, findings)?,
    };
    let strain = |(&number, &length): (&f64, &f64)| {
        let d = number * factor;
        let strain = match zero {
            Zero::Extension => d / length,
            Zero::Distance => d / length - 1.0,
            Zero::Position => (d - written.numbers[0] * factor) / length,
        };
        sign * if test == Test::Shear { strain.atan() } else { strain }
    };
    let si = written.numbers.iter().zip(&gauge).map(strain).collect();
    let why = match axis.zero {
        Some(_) => "as declared".to_owned(),
        None => format!("which begins at {first:.2} of the gauge"),
    };
    let reading = format!("{name}, {} {why} of {:.4} mm{of_gauge}", article(zero), 1e3 * gauge[0]);
    let written = written.as_written(Some(gauge[0]), Some(zero));
    Some(AxisValues { si, written, reading })
}

fn article(zero: Zero) -> &'static str {
    match zero {
        Zero::Extension => "an extension",
        Zero::Distance => "a distance of clamps",
        Zero::Position => "a position of a clamp",
    }
}

/// Returns the zero of a length: the declared one, or the one that its first value and its name
/// agree on.
fn zero(
    axis: &AxisKeys,
    written: &Numbers,
    first: f64,
    findings: &mut Findings<'_>,
) -> Option<Zero> {
    if let Some(zero) = axis.zero {
        return Some(zero);
    }
    let by_value = if first.abs() <= FIRST_EXTENSION {
        Some(Zero::Extension)
    } else if (first - 1.0).abs() <= FIRST_DISTANCE {
        Some(Zero::Distance)
    } else {
        None
    };
    let found = match (written.kind, by_value) {
        (Some(Kind::Extension | Kind::Strain), Some(Zero::Extension)) => by_value,
        (Some(Kind::Extension | Kind::Strain), _) => None,
        // A place that begins at the gauge by chance is the same strain either way.
        (Some(Kind::Position), Some(Zero::Extension)) if first == 0.0 => by_value,
        (Some(Kind::Position), _) => Some(Zero::Position),
        (_, found) => found,
    };
    if found.is_none() {
        let message = format!(
            "{} begins at {first:.3} of the gauge: an extension would begin near 0, a distance of the clamps near 1",
            written.column
        );
        let help = "say what it is: zero = \"extension\", \"distance\" or \"position\" (of a clamp), or correct the gauge";
        findings.error(&axis.key, message, help);
    }
    found
}

/// Reads the loads per width.
pub(crate) fn load(
    test: Test,
    axis: &AxisKeys,
    series: &Series,
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let accepted = loads(test);
    let written =
        numbers(axis, accepted, &AxisColumn { series, column: series.pair.load }, findings)?;
    let width = sizes(axis, series, findings)?;
    let per_width = written.unit.quantity == accepted[0];
    let name = format!("load from {} in {}", written.column, written.unit.spelling);
    let sign = sign(axis);
    let unit = written.unit;
    if per_width {
        if width.is_some() {
            let message = format!("given, but {} is per width already", unit.spelling);
            let help = "remove it, or give the unit of the whole load";
            findings.error(&axis.size_key, message, help);
            return None;
        }
        let si = written.numbers.iter().map(|&load| sign * (load * unit.factor)).collect();
        return Some(AxisValues { si, written: written.as_written(None, None), reading: name });
    }
    let Some((width, of_width)) = or_of_file(width, series, WIDTH, findings)? else {
        let message = format!("is missing: a load in {} needs it", unit.spelling);
        let help = "add width = \"20 cm\", or the name of the column that holds it";
        findings.error(&axis.size_key, message, help);
        return None;
    };
    let pairs = written.numbers.iter().zip(&width);
    let si = pairs.map(|(&load, &w)| sign * (load * unit.factor / w)).collect();
    let reading = format!("{name} over a width of {:.4} mm{of_width}", 1e3 * width[0]);
    Some(AxisValues { si, written: written.as_written(Some(width[0]), None), reading })
}

fn sign(axis: &AxisKeys) -> f64 {
    if axis.reversed == Some(true) { -1.0 } else { 1.0 }
}

/// Reads the numbers of a column, and their unit from the sheet or from the header of the file.
fn numbers(
    axis: &AxisKeys,
    accepted: &[Quantity],
    of: &AxisColumn<'_>,
    findings: &mut Findings<'_>,
) -> Option<Numbers> {
    let AxisColumn { series, column } = *of;
    let heading = series.block.headings.get(column);
    let unit = match axis.unit {
        Some(unit) => unit,
        None => {
            let Some(text) = series.unit(column) else {
                let unit = accepted[0].laboratory().spelling;
                let help = format!("add unit = \"{unit}\", or the unit that was used");
                let message = "is missing, and the column's header names none";
                findings.error(&axis.unit_key, message, help);
                return None;
            };
            match parse_unit(text, accepted) {
                Ok(unit) => unit,
                Err(error) => {
                    let message =
                        format!("column {}: {}", series.block.column_name(column), error.message);
                    let help = format!(
                        "{}; declare the right one: unit = \"{}\"",
                        error.help,
                        accepted[0].laboratory().spelling
                    );
                    let finding = Diagnostic::new(&series.path, message).help(help);
                    let line = series.block.units_line.or(series.block.header_line);
                    findings.errors.push(Diagnostic { line, ..finding });
                    return None;
                }
            }
        }
    };
    let numbers = findings.collect(series.numbers(column))?;
    if numbers.is_empty() {
        let finding = Diagnostic::new(&series.path, "the table has no rows of numbers");
        findings.errors.push(finding.help("a curve needs at least two points, one per line"));
        return None;
    }
    Some(Numbers {
        unit,
        numbers,
        column: match heading.filter(|heading| !heading.name.is_empty()) {
            Some(heading) => format!("column {} \"{}\"", column + 1, heading.name),
            None => format!("column {}", column + 1),
        },
        kind: heading.and_then(|heading| heading::kind(&heading.name)),
    })
}

/// Reads the gauge or the width that the sheet gives, for each row, in metres; the inner `None` where it gives
/// none.
fn sizes(
    axis: &AxisKeys,
    series: &Series,
    findings: &mut Findings<'_>,
) -> Option<Option<Vec<f64>>> {
    match &axis.size {
        None => Some(None),
        Some(ColumnOrLength::Length(length)) => Some(Some(vec![*length; series.block.rows.len()])),
        Some(ColumnOrLength::Column(column)) => match named(&series.block, column) {
            Ok(columns) => lengths(series, columns[0], findings).map(Some),
            Err(reason) => {
                let finding = Diagnostic::new(&series.path, reason.message).help(reason.help);
                findings.errors.push(Diagnostic { line: reason.line, ..finding });
                None
            }
        },
    }
}

/// Returns the gauge or the width of each row, in metres, with its place in the file; that of the sheet has no
/// place, and goes before that of the file. The inner `None` says that neither gives one.
fn or_of_file(
    given: Option<Vec<f64>>,
    series: &Series,
    words: Words,
    findings: &mut Findings<'_>,
) -> Option<Option<(Vec<f64>, String)>> {
    if let Some(sizes) = given {
        return Some(Some((sizes, String::new())));
    }
    if let Some(found) = series.stated(words) {
        let place = format!(", \"{}\" on line {}", found.name, found.line);
        return Some(Some((vec![found.length; series.block.rows.len()], place)));
    }
    let Some(column) = series.size_column(words) else { return Some(None) };
    let place = format!(", column {}", series.block.column_name(column));
    lengths(series, column, findings).map(|lengths| Some((lengths, place)))
}

/// Reads the lengths of a column, in metres; a column without a unit is in metres.
fn lengths(series: &Series, column: usize, findings: &mut Findings<'_>) -> Option<Vec<f64>> {
    let name = series.block.column_name(column);
    let unit = match series.unit(column).map(|unit| parse_unit(unit, &[Quantity::Length])) {
        None => 1.0,
        Some(Ok(unit)) => unit.factor,
        Some(Err(error)) => {
            let message = format!("column {name}: {}", error.message);
            findings.errors.push(Diagnostic::new(&series.path, message).help(error.help));
            return None;
        }
    };
    let lengths = findings.collect(series.numbers(column))?;
    if let Some(wrong) = lengths.iter().position(|&length| length <= 0.0) {
        let message = format!("column {name} has a length of {}", lengths[wrong]);
        let finding = Diagnostic::new(&series.path, message).help("a length is positive");
        findings.errors.push(finding.on_line(series.block.rows[wrong].line));
        return None;
    }
    Some(lengths.into_iter().map(|length| unit * length).collect())
}
