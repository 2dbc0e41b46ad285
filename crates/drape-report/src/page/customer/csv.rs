//! All numbers of a report to a customer as one table of comma-separated values.
//!
//! A row is a line of the head, a value, a drape, a point of a loop or a girth of a garment, in the laboratory's units; columns
//! that a row has no number for are empty. Numbers have a decimal point and at most ten digits.

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

/// Digits of a number.
const DIGITS: usize = 10;

/// Row of the table by column.
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
    /// Difference of the law from what was measured, a ratio.
    difference: Option<f64>,
    /// Published range of a value, or interval of a drape.
    range: Option<[f64; 2]>,
    point: Option<usize>,
    deformation: Option<f64>,
    deformation_unit: String,
    text: String,
}

impl Row {
    /// Returns the row as a line.
    fn line(&self) -> String {
        let number = |value: Option<f64>| value.map_or_else(String::new, rounded);
        let [from, to] = [0, 1].map(|end| number(self.range.map(|range| range[end])));
        let cells = [
            quoted(&self.fabric),
            self.part.to_owned(),
            quoted(&self.item),
            quoted(&self.direction),
            quoted(&self.unit),
            number(self.measured),
            number(self.deviation),
            number(self.law),
            if self.is_assumed { "yes".to_owned() } else { String::new() },
            number(self.difference.map(|ratio| 100.0 * ratio)),
            from,
            to,
            self.point.map_or_else(String::new, |point| point.to_string()),
            number(self.deformation),
            quoted(&self.deformation_unit),
            quoted(&self.text),
        ];
        cells.join(",")
    }
}

/// Returns a number without digits that only show rounding.
fn rounded(value: f64) -> String {
    let text = format!("{value:.*e}", DIGITS - 1);
    let value: f64 = text.parse().unwrap_or(value);
    let size = value.abs();
    if size == 0.0 || (1e-4..1e9).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Returns a text as a cell, quoted where it needs that (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Rows that a table has.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Detail {
    All,
    /// All but the points of loops.
    WithoutPoints,
}

impl CustomerPage {
    /// Returns all numbers of the report as a table with a head: lines of the head, values, drapes, points
    /// of loops, in the laboratory's units.
    ///
    /// # Errors
    /// Those of [`CustomerPage::check`].
    pub fn to_csv(&self) -> Result<String, Error> {
        self.check()?;
        Ok(table(self, Detail::All))
    }
}

/// Returns the table of a report that has been checked.
pub(super) fn table(page: &CustomerPage, detail: Detail) -> String {
    let mut lines = vec![COLUMNS.join(",")];
    for (index, fabric) in page.fabrics.iter().enumerate() {
        let of = |row: Row| Row { fabric: fabric.name.clone(), ..row }.line();
        lines.extend(fabric.record.iter().map(|[title, text]| {
            of(Row { part: "record", item: title.clone(), text: text.clone(), ..Row::default() })
        }));
        let values = page.values.iter().chain(&page.others);
        lines.extend(values.filter_map(|value| value_row(value, index)).map(of));
        lines.extend(fabric.drape.iter().flat_map(drape_rows).map(of));
        for own in fabric.loops.iter().filter(|_| detail == Detail::All) {
            lines.extend(point_rows(own).map(of));
        }
        let assumed = page.assumed.iter().filter(|note| note.fabrics.contains(&index));
        lines
            .extend(assumed.map(|note| {
                of(Row { part: "assumed", text: note.text.clone(), ..Row::default() })
            }));
    }
    lines.extend(page.garments.iter().flat_map(garment_rows).map(|row| row.line()));
    lines.join("\r\n") + "\r\n"
}

/// Returns the rows of a garment: girths and ease at each place, in mm. They belong to no fabric.
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

/// Returns the row of a value of a fabric, if the fabric has one.
fn value_row(value: &ReportedValue, fabric: usize) -> Option<Row> {
    let ComparedNumber { measured, deviation, law, is_assumed } = value.number(fabric);
    measured.or(law)?;
    let (unit, in_si) = value.value.units.first();
    let scaled = |number: Option<f64>| number.map(|number| number / in_si);
    Some(Row {
        part: "value",
        item: value.value.symbol.clone(),
        direction: value.value.direction.clone(),
        unit: unit.to_owned(),
        measured: scaled(measured),
        deviation: scaled(deviation),
        law: scaled(law),
        is_assumed,
        difference: value.difference(fabric).map(|difference| difference.ratio),
        range: value.range(fabric).map(|range| range.map(|end| end / in_si)),
        text: value.value.name.clone(),
        ..Row::default()
    })
}

/// Returns the rows of a drape: its coefficient, its nodes, and the edge of its shadow.
fn drape_rows(drape: &ReportedDrape) -> Vec<Row> {
    let row = |item: &str| Row { part: "drape", item: item.to_owned(), ..Row::default() };
    let mut rows = vec![Row {
        unit: "%".to_owned(),
        law: Some(100.0 * drape.coefficient),
        deviation: Some(100.0 * drape.deviation),
        range: Some(drape.interval.map(|end| 100.0 * end)),
        text: format!("{}; {}; {}", drape.meter, drape.computed, drape.meaning),
        ..row("drape coefficient")
    }];
    rows.extend(drape.nodes.iter().map(|(nodes, times)| Row {
        law: Some(*nodes as f64),
        text: format!("{times} specimens"),
        ..row("nodes")
    }));
    let radius = |(index, radius): (usize, &f64)| Row {
        unit: "mm".to_owned(),
        law: Some(1e3 * radius),
        point: Some(index + 1),
        deformation: Some(360.0 * index as f64 / drape.shadow.edge.len() as f64),
        deformation_unit: "°".to_owned(),
        ..row("radius of the shadow")
    };
    rows.extend(drape.shadow.edge.iter().enumerate().map(radius));
    rows
}

/// Returns the rows of the points of loops.
fn point_rows(own: &ReportedLoop) -> impl Iterator<Item = Row> {
    own.law.plots.iter().flat_map(|plot| {
        plot.points().enumerate().map(|(index, point)| Row {
            part: "loop",
            item: plot.title.clone(),
            direction: own.direction.clone(),
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
