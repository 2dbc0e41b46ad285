//! All numbers of a report to a customer as one table of comma-separated values.
//! A row is a line of the head, a value, a drape, a point of a loop or a girth of a garment.
//! Numbers are in the units of the laboratory. Columns without a number stay empty. Numbers have a
//! decimal point and at most ten digits.

use drape_input::figure_in_digits;

use super::drape::ReportedDrape;
use super::garment::ReportedGarment;
use super::report::{CustomerPage, ReportedLoop};
use super::values::ReportedValue;
use crate::error::Error;
use crate::page::compared_value::ComparedNumber;

/// Columns of the table.
const COLUMNS: [&str; 16] = [
    "fabric",
    "part",
    "item",
    "direction",
    "unit",
    "measured",
    "standard_deviation",
    "law",
    "law_is_assumed",
    "difference_percent",
    "from",
    "to",
    "point",
    "deformation",
    "deformation_unit",
    "text",
];

/// Significant digits of a number.
const DIGITS: usize = 10;

/// Row of the table, with one field for each column.
#[derive(Default)]
struct Row {
    fabric: String,
    part: &'static str,
    item: String,
    direction: String,
    unit: String,
    measured: Option<f64>,
    deviation: Option<f64>,
    law: Option<f64>,
    is_assumed: bool,
    /// Difference between the law and the measured value, as a ratio.
    difference: Option<f64>,
    /// Published range of a value, or interval of a drape.
    range: Option<[f64; 2]>,
    point: Option<usize>,
    deformation: Option<f64>,
    deformation_unit: String,
    text: String,
}

impl Row {
    /// Returns the row as a line, in the order of [`COLUMNS`].
    fn line(&self) -> String {
        let [from, to] = [0, 1].map(|end| optional(self.range.map(|range| range[end])));

        let cells = [
            quoted(&self.fabric),
            self.part.to_owned(),
            quoted(&self.item),
            quoted(&self.direction),
            quoted(&self.unit),
            optional(self.measured),
            optional(self.deviation),
            optional(self.law),
            if self.is_assumed { "yes".to_owned() } else { String::new() },
            optional(self.difference.map(|ratio| 100.0 * ratio)),
            from,
            to,
            self.point.map_or_else(String::new, |point| point.to_string()),
            optional(self.deformation),
            quoted(&self.deformation_unit),
            quoted(&self.text),
        ];
        cells.join(",")
    }
}

/// Returns a number as text, or an empty text for `None`.
fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, rounded)
}

/// Returns a `value` as text, without digits that only show rounding.
fn rounded(value: f64) -> String {
    figure_in_digits(value, DIGITS)
}

/// Returns a `text` as a cell, quoted where RFC 4180 requires quotes.
fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Choice of the rows of a table.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Detail {
    /// All rows.
    All,
    /// All rows but the points of loops.
    WithoutPoints,
}

impl CustomerPage {
    /// Returns all numbers of the report as a table with a head, in the units of the laboratory.
    /// The rows are lines of the head, values, drapes, points of loops and girths of garments.
    ///
    /// # Errors
    /// Errors of [`CustomerPage::check`].
    pub fn to_csv(&self) -> Result<String, Error> {
        self.check()?;
        Ok(table(self, Detail::All))
    }
}

/// Returns the table of a `page` that has been checked, with the rows that `detail` chooses.
pub(super) fn table(page: &CustomerPage, detail: Detail) -> String {
    let mut lines = vec![COLUMNS.join(",")];
    for (index, fabric) in page.fabrics.iter().enumerate() {
        let mut rows: Vec<Row> = Vec::new();
        rows.extend(fabric.record.iter().map(|[title, text]| Row {
            part: "record",
            item: title.clone(),
            text: text.clone(),
            ..Row::default()
        }));
        let values = page.values.iter().chain(&page.others);
        rows.extend(values.filter_map(|value| value_row(value, index)));
        rows.extend(fabric.drape.iter().flat_map(drape_rows));
        if detail == Detail::All {
            rows.extend(fabric.loops.iter().flat_map(point_rows));
        }
        let assumed = page.assumed.iter().filter(|note| note.fabrics.contains(&index));
        rows.extend(assumed.map(|note| Row {
            part: "assumed",
            text: note.text.clone(),
            ..Row::default()
        }));

        let of_fabric = rows.into_iter().map(|row| Row { fabric: fabric.name.clone(), ..row });
        lines.extend(of_fabric.map(|row| row.line()));
    }
    lines.extend(page.garments.iter().flat_map(garment_rows).map(|row| row.line()));
    lines.join("\r\n") + "\r\n"
}

/// Returns the rows of a `garment`: girths and ease at each place, in mm. The rows have no fabric.
fn garment_rows(garment: &ReportedGarment) -> Vec<Row> {
    let mut rows = Vec::new();
    for girth in &garment.girths {
        let [ease, pattern_ease] = girth.ease();

        let figures = [
            ("height", Some(girth.height)),
            ("body", Some(girth.body)),
            ("garment", girth.garment),
            ("ease", ease),
            ("pattern", girth.pattern),
            ("ease in the pattern", pattern_ease),
        ];

        // A girth that is not known has no row.
        rows.extend(figures.into_iter().filter(|(_, length)| length.is_some()).map(
            |(name, length)| Row {
                part: "garment",
                item: format!("{}, {}: {name}", garment.name, girth.place),
                unit: "mm".to_owned(),
                law: length.map(|length| 1e3 * length),
                text: girth.remark.clone(),
                ..Row::default()
            },
        ));
    }
    rows
}

/// Returns the row of a `value` for a `fabric`, `None` if the fabric has no such value.
fn value_row(value: &ReportedValue, fabric: usize) -> Option<Row> {
    let ComparedNumber { measured, deviation, law, is_assumed } = value.number(fabric);
    measured.or(law)?;
    let (unit, in_si) = value.value.units.first();
    Some(Row {
        part: "value",
        item: value.value.symbol.clone(),
        direction: value.value.direction.clone(),
        unit: unit.to_owned(),
        measured: measured.map(|value| value / in_si),
        deviation: deviation.map(|value| value / in_si),
        law: law.map(|value| value / in_si),
        is_assumed,
        difference: value.difference(fabric).map(|difference| difference.ratio),
        range: value.range(fabric).map(|range| range.map(|end| end / in_si)),
        text: value.value.name.clone(),
        ..Row::default()
    })
}

/// Returns the rows of a `drape`: its coefficient, its nodes, and the edge of its shadow.
fn drape_rows(drape: &ReportedDrape) -> Vec<Row> {
    let mut rows = vec![Row {
        part: "drape",
        item: "drape coefficient".to_owned(),
        unit: "%".to_owned(),
        law: Some(100.0 * drape.coefficient),
        deviation: Some(100.0 * drape.deviation),
        range: Some(drape.interval.map(|end| 100.0 * end)),
        text: format!("{}; {}; {}", drape.meter, drape.computed, drape.meaning),
        ..Row::default()
    }];
    rows.extend(drape.nodes.iter().map(|(nodes, times)| Row {
        part: "drape",
        item: "nodes".to_owned(),
        law: Some(*nodes as f64),
        text: format!("{times} specimens"),
        ..Row::default()
    }));

    // The radii stand at even angles of the turn.
    rows.extend(drape.shadow.edge.iter().enumerate().map(|(index, radius)| Row {
        part: "drape",
        item: "radius of the shadow".to_owned(),
        unit: "mm".to_owned(),
        law: Some(1e3 * radius),
        point: Some(index + 1),
        deformation: Some(360.0 * index as f64 / drape.shadow.edge.len() as f64),
        deformation_unit: "°".to_owned(),
        ..Row::default()
    }));
    rows
}

/// Returns the rows of the points of a `reported` loop.
fn point_rows(reported: &ReportedLoop) -> impl Iterator<Item = Row> {
    reported.law.plots.iter().flat_map(|plot| {
        plot.points().enumerate().map(|(index, point)| Row {
            part: "loop",
            item: plot.title.clone(),
            direction: reported.direction.clone(),
            unit: plot.load.unit.clone(),
            measured: point.measured.map(|load| load / plot.load.in_si),
            law: point.fitted.map(|load| load / plot.load.in_si),
            range: point.band.map(|band| band.map(|end| end / plot.load.in_si)),
            point: Some(index + 1),
            deformation: Some(point.deformation / plot.deformation.in_si),
            deformation_unit: plot.deformation.unit.clone(),
            ..Row::default()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_texts_can_be_read_back() {
        assert_eq!(rounded(0.1 + 0.2), "0.3");
        assert_eq!(rounded(-1234.5), "-1234.5");
        assert_eq!(rounded(1.2e-5), "1.2e-5");
        assert_eq!(rounded(0.0), "0");
        assert_eq!(quoted("Mill, \"A\""), "\"Mill, \"\"A\"\"\"");
        let row = Row { measured: Some(0.118), text: "a, b".to_owned(), ..Row::default() };
        assert_eq!(row.line().matches(',').count(), COLUMNS.len(), "one within quotes");
    }
}
