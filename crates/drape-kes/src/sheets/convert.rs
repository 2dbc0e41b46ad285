//! Columns as written, converted to deformation and load per width in SI.
//!
//! A length `$d$` is converted to a strain by the gauge `$l$`:
//!
//! ```math
//! \varepsilon = d/l \;\text{(extension)}, \qquad d/l - 1 \;\text{(distance of the clamps)}, \qquad
//! (d - d_0)/l \;\text{(position of a clamp)}
//! ```
//!
//! In shear the length is measured across the strip, and the angle is the arc tangent of the
//! strain.

use drape_input::Diagnostic;

use crate::sheets::axis::{AxisKeys, deformation_quantities, load_quantities};
use crate::sheets::checks::suspect::AsWritten;
use crate::sheets::file::forms::{ColumnOrLength, Zero};
use crate::sheets::findings::Findings;
use crate::tables::columns::find_named;
use crate::tables::heading::words::Words;
use crate::tables::heading::{self, Kind};
use crate::tables::series::Series;
use crate::tables::stated::{GAUGE, WIDTH};
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

/// Axis in SI, with the numbers that it was written in.
pub(crate) struct AxisValues {
    pub(crate) si: Vec<f64>,
    pub(crate) written: AsWritten,
    /// What the axis was taken for, in words.
    pub(crate) reading: String,
}

/// Column of a series.
#[derive(Clone, Copy)]
struct AxisColumn<'a> {
    series: &'a Series,
    column: usize,
}

/// Numbers of a column with their unit, never empty.
struct Numbers {
    unit: Unit,
    numbers: Vec<f64>,
    /// Name of the column for the reading.
    column: String,
    kind: Option<Kind>,
}

impl Numbers {
    /// Returns the column and unit that `axis`, `"deformation"` or `"load"`, was read from.
    fn reading(&self, axis: &str) -> String {
        format!("{axis} from {} in {}", self.column, self.unit.spelling)
    }

    /// Returns the extremes of the numbers with their unit, and the `size` and `zero` that convert
    /// them.
    fn as_written(&self, size: Option<f64>, zero: Option<Zero>) -> AsWritten {
        let largest =
            self.numbers.iter().fold(0.0, |largest: f64, number| largest.max(number.abs()));
        let first = self.numbers[0];
        AsWritten { largest, first, unit: self.unit, size, zero }
    }
}

/// Gauges or widths of the rows of a table, in metres.
struct RowLengths {
    lengths: Vec<f64>,
    /// Place in the table file, as the end of a sentence; empty for a length that the sheet gives.
    origin: String,
}

/// Mistake that was added to the findings.
struct Reported;

/// Reads the deformations of `series`, with the gauge where there is one. Returns `None` after
/// reporting a mistake.
pub(crate) fn deformation(
    test: Test,
    axis: &AxisKeys,
    series: &Series,
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let column = AxisColumn { series, column: series.pair.deformation };
    let written = numbers(axis, deformation_quantities(test), &column, findings)?;
    if written.unit.quantity == Quantity::Length {
        return deformation_of_length(test, axis, (series, &written), findings);
    }
    let gauge = sizes(axis, series, findings).ok()?.map(|gauge| gauge[0]);
    let factor = sign(axis) * written.unit.factor;
    let si = written.numbers.iter().map(|&number| number * factor).collect();
    let reading = written.reading("deformation");
    Some(AxisValues { si, written: written.as_written(gauge, None), reading })
}

/// Converts the lengths `written` in a column of `series` to deformations. Returns `None` after
/// reporting a mistake.
fn deformation_of_length(
    test: Test,
    axis: &AxisKeys,
    (series, written): (&Series, &Numbers),
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let given = sizes(axis, series, findings).ok()?;
    let Some(gauge) = sizes_or_file(given, series, GAUGE, findings).ok()? else {
        let help = "add gauge = \"5 cm\", or the name of the column that holds it";
        findings.error(&axis.size_key, "is missing: a clamp distance needs it", help);
        return None;
    };

    // The first length tells an extension, which begins near zero, from a distance of clamps.
    let factor = written.unit.factor;
    let first = written.numbers[0] * factor / gauge.lengths[0];
    let zero = match test {
        // The arch of loop bending is measured by the distance of its clamps, from any start.
        Test::LoopBending => axis.zero.unwrap_or(Zero::Distance),
        _ => zero(axis, written, first, findings)?,
    };
    let sign = sign(axis);
    let mut si = Vec::with_capacity(written.numbers.len());
    for (&number, &length) in written.numbers.iter().zip(&gauge.lengths) {
        let d = number * factor;
        let strain = match zero {
            Zero::Extension => d / length,
            Zero::Distance => d / length - 1.0,
            Zero::Position => (d - written.numbers[0] * factor) / length,
        };
        si.push(sign * if test == Test::Shear { strain.atan() } else { strain });
    }

    let why = match axis.zero {
        Some(_) => "as declared".to_owned(),
        None => format!("which begins at {first:.2} of the gauge"),
    };
    let reading = format!(
        "{}, {} {why} of {:.4} mm{}",
        written.reading("deformation"),
        article(zero),
        1e3 * gauge.lengths[0],
        gauge.origin
    );
    Some(AxisValues {
        si,
        written: written.as_written(Some(gauge.lengths[0]), Some(zero)),
        reading,
    })
}

/// Returns `zero` in words, with its article.
fn article(zero: Zero) -> &'static str {
    match zero {
        Zero::Extension => "an extension",
        Zero::Distance => "a distance of clamps",
        Zero::Position => "a position of a clamp",
    }
}

/// Returns the meaning of the lengths `written`: the declared one, or the one on which the `first`
/// length over its gauge and the name of the column agree.
fn zero(
    axis: &AxisKeys,
    written: &Numbers,
    first: f64,
    findings: &mut Findings<'_>,
) -> Option<Zero> {
    /// Largest first length, over the gauge, of an extension: a slack strip may begin below zero.
    const FIRST_EXTENSION: f64 = 0.3;
    /// Largest difference of the first length and the gauge, over the gauge, of a distance of
    /// clamps.
    const FIRST_DISTANCE: f64 = 0.3;

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

    let agreed = match (written.kind, by_value) {
        (Some(Kind::Extension | Kind::Strain), Some(Zero::Extension)) => by_value,
        (Some(Kind::Extension | Kind::Strain), _) => None,
        // A position that begins at the gauge by chance gives the same strain as an extension.
        (Some(Kind::Position), Some(Zero::Extension)) if first == 0.0 => by_value,
        (Some(Kind::Position), _) => Some(Zero::Position),
        _ => by_value,
    };
    if agreed.is_none() {
        let message = format!(
            "{} begins at {first:.3} of the gauge: an extension would begin near 0, a distance of the clamps near 1",
            written.column
        );
        let help = "say what it is: zero = \"extension\", \"distance\" or \"position\" (of a clamp), or correct the gauge";
        findings.error(&axis.key, message, help);
    }
    agreed
}

/// Reads the loads per width of `series`. Returns `None` after reporting a mistake.
pub(crate) fn load(
    test: Test,
    axis: &AxisKeys,
    series: &Series,
    findings: &mut Findings<'_>,
) -> Option<AxisValues> {
    let accepted = load_quantities(test);
    let column = AxisColumn { series, column: series.pair.load };
    let written = numbers(axis, accepted, &column, findings)?;
    let width = sizes(axis, series, findings).ok()?;
    let reading = written.reading("load");
    let sign = sign(axis);
    let unit = written.unit;

    // A load per width is only scaled.
    if unit.quantity == accepted[0] {
        if width.is_some() {
            let message = format!("given, but {} is per width already", unit.spelling);
            let help = "remove it, or give the unit of the whole load";
            findings.error(&axis.size_key, message, help);
            return None;
        }
        let si = written.numbers.iter().map(|&load| sign * (load * unit.factor)).collect();
        return Some(AxisValues { si, written: written.as_written(None, None), reading });
    }

    // A whole load is divided by the width of the specimen.
    let Some(width) = sizes_or_file(width, series, WIDTH, findings).ok()? else {
        let message = format!("is missing: a load in {} needs it", unit.spelling);
        let help = "add width = \"20 cm\", or the name of the column that holds it";
        findings.error(&axis.size_key, message, help);
        return None;
    };
    let pairs = written.numbers.iter().zip(&width.lengths);
    let si = pairs.map(|(&load, &width)| sign * (load * unit.factor / width)).collect();
    let reading =
        format!("{reading} over a width of {:.4} mm{}", 1e3 * width.lengths[0], width.origin);
    Some(AxisValues { si, written: written.as_written(Some(width.lengths[0]), None), reading })
}

/// Returns -1 for an axis whose sign the sheet reverses, else 1.
fn sign(axis: &AxisKeys) -> f64 {
    if axis.reversed == Some(true) { -1.0 } else { 1.0 }
}

/// Reads the numbers of `column`, with the unit that the sheet or the header of the file gives.
/// Returns `None` after reporting a mistake.
fn numbers(
    axis: &AxisKeys,
    accepted: &[Quantity],
    column: &AxisColumn<'_>,
    findings: &mut Findings<'_>,
) -> Option<Numbers> {
    let AxisColumn { series, column } = *column;
    let unit = match axis.unit {
        Some(unit) => unit,
        None => unit_of_header(axis, accepted, (series, column), findings)?,
    };
    let numbers = findings.collect(series.numbers(column))?;
    if numbers.is_empty() {
        let finding = Diagnostic::new(&series.path, "the table has no rows of numbers");
        findings.errors.push(finding.help("a curve needs at least two points, one per line"));
        return None;
    }
    let heading = series.block.headings.get(column);
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

/// Reads the unit in the header of a `column` of `series`, of one of the `accepted` quantities.
/// Returns `None` after reporting a mistake.
fn unit_of_header(
    axis: &AxisKeys,
    accepted: &[Quantity],
    (series, column): (&Series, usize),
    findings: &mut Findings<'_>,
) -> Option<Unit> {
    let example = accepted[0].laboratory().spelling;
    let Some(text) = series.unit(column) else {
        let help = format!("add unit = \"{example}\", or the unit that was used");
        let message = "is missing, and the column's header names none";
        findings.error(&axis.unit_key, message, help);
        return None;
    };
    match parse_unit(text, accepted) {
        Ok(unit) => Some(unit),
        Err(error) => {
            let message = format!("column {}: {}", series.block.column_name(column), error.message);
            let help = format!("{}; declare the right one: unit = \"{example}\"", error.help);
            let finding = Diagnostic::new(&series.path, message).help(help);
            let line = series.block.units_line.or(series.block.header_line);
            findings.errors.push(Diagnostic { line, ..finding });
            None
        }
    }
}

/// Reads the gauge or the width that the sheet gives, for each row of `series`, in metres. Returns
/// `Ok(None)` where the sheet gives none.
fn sizes(
    axis: &AxisKeys,
    series: &Series,
    findings: &mut Findings<'_>,
) -> Result<Option<Vec<f64>>, Reported> {
    match &axis.size {
        None => Ok(None),
        Some(ColumnOrLength::Length(length)) => Ok(Some(vec![*length; series.block.rows.len()])),
        Some(ColumnOrLength::Column(column)) => match find_named(&series.block, column) {
            Ok(columns) => lengths(series, columns[0], findings).map(Some),
            Err(reason) => {
                let finding = Diagnostic::new(&series.path, reason.message).help(reason.help);
                findings.errors.push(Diagnostic { line: reason.line, ..finding });
                Err(Reported)
            }
        },
    }
}

/// Returns the lengths that the sheet has `given`, else the lengths that the file of `series`
/// states under one of `words`. Returns `Ok(None)` where neither states any.
fn sizes_or_file(
    given: Option<Vec<f64>>,
    series: &Series,
    words: Words,
    findings: &mut Findings<'_>,
) -> Result<Option<RowLengths>, Reported> {
    if let Some(lengths) = given {
        return Ok(Some(RowLengths { lengths, origin: String::new() }));
    }
    if let Some(stated) = series.stated(words) {
        let origin = format!(", \"{}\" on line {}", stated.name, stated.line);
        let lengths = vec![stated.length; series.block.rows.len()];
        return Ok(Some(RowLengths { lengths, origin }));
    }
    let Some(column) = series.size_column(words) else { return Ok(None) };
    let origin = format!(", column {}", series.block.column_name(column));
    let lengths = lengths(series, column, findings)?;
    Ok(Some(RowLengths { lengths, origin }))
}

/// Reads the lengths of a `column` of `series`, in metres. A column without a unit is in metres.
fn lengths(
    series: &Series,
    column: usize,
    findings: &mut Findings<'_>,
) -> Result<Vec<f64>, Reported> {
    let name = series.block.column_name(column);
    let unit = match series.unit(column).map(|unit| parse_unit(unit, &[Quantity::Length])) {
        None => 1.0,
        Some(Ok(unit)) => unit.factor,
        Some(Err(error)) => {
            let message = format!("column {name}: {}", error.message);
            findings.errors.push(Diagnostic::new(&series.path, message).help(error.help));
            return Err(Reported);
        }
    };

    let lengths = findings.collect(series.numbers(column)).ok_or(Reported)?;
    if let Some(wrong) = lengths.iter().position(|&length| length <= 0.0) {
        let message = format!("column {name} has a length of {}", lengths[wrong]);
        let finding = Diagnostic::new(&series.path, message).help("a length is positive");
        findings.errors.push(finding.on_line(series.block.rows[wrong].line));
        return Err(Reported);
    }
    Ok(lengths.into_iter().map(|length| unit * length).collect())
}
