//! Parts of one table that are series of their own: those of a column of directions or specimens.

use crate::tables::block::Block;
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::{self, Kind};
use crate::tables::layout::Layout;
use crate::tables::series::Series;
use crate::test::Direction;

/// Rows that each specimen of a column of specimens has at least.
const ROWS_OF_SPECIMEN: usize = 3;

/// Splits a series at its column of directions, and each part at its column of specimens.
pub(crate) fn parts(series: Series, layout: &Layout) -> Vec<Series> {
    let directed = by_direction(series);
    directed.into_iter().flat_map(|series| by_specimen(series, layout)).collect()
}

/// Splits a series at the words of a column that says warp or weft, if there is one.
fn by_direction(series: Series) -> Vec<Series> {
    let of = |row: &Row, column: usize| {
        let text = row.cells.get(column).filter(|cell| !cell.is_number()).map(Cell::text)?;
        match heading::directions(&text).as_slice() {
            [direction] => Some(*direction),
            _ => None,
        }
    };
    let says = |column: &usize| series.block.rows.iter().all(|row| of(row, *column).is_some());
    let Some(column) = (0..series.block.width()).find(says) else { return vec![series] };
    let part = |direction: Direction| {
        let rows = series.block.rows.iter();
        let rows: Vec<Row> =
            rows.filter(|row| of(row, column) == Some(direction)).cloned().collect();
        (!rows.is_empty()).then(|| {
            let mut part = series.clone();
            part.block.rows = rows;
            part.pair.label = direction.name().to_owned();
            let label = [series.label.as_str(), direction.name()];
            part.label = label.into_iter().filter(|l| !l.is_empty()).collect::<Vec<_>>().join(", ");
            part
        })
    };
    [Direction::Warp, Direction::Weft].into_iter().filter_map(part).collect()
}

/// Splits a series at the values of a column of specimens, if there is one.
fn by_specimen(series: Series, layout: &Layout) -> Vec<Series> {
    let is_specimen = |column: &usize| {
        let heading = series.block.headings.get(*column);
        heading.and_then(|heading| heading::kind(&heading.name)) == Some(Kind::Specimen)
            && ![series.pair.deformation, series.pair.load].contains(column)
    };
    let runs = (0..series.block.width()).filter(is_specimen).find_map(|column| {
        let mut runs: Vec<(String, Vec<Row>)> = Vec::new();
        for row in &series.block.rows {
            let value = row.cells.get(column).map(Cell::text).unwrap_or_default();
            match runs.last_mut() {
                Some((last, rows)) if *last == value || value.is_empty() => rows.push(row.clone()),
                _ => runs.push((value, vec![row.clone()])),
            }
        }
        let whole = runs.iter().all(|(_, rows)| rows.len() >= ROWS_OF_SPECIMEN);
        let once = runs.iter().enumerate().all(|(i, (a, _))| runs[..i].iter().all(|(b, _)| a != b));
        (runs.len() > 1 && whole && once).then_some(runs)
    });
    let Some(runs) = runs else { return vec![series] };
    let title = match series.pair.label.as_str() {
        "" => String::new(),
        label => format!("{label}, "),
    };
    let of_run = |(index, (value, rows)): (usize, (String, Vec<Row>))| {
        let number = value.trim_end_matches(".0").parse().unwrap_or(index + 1);
        layout.specimen.takes(number).then(|| {
            let block = Block { rows, ..series.block.clone() };
            let label = format!("{title}specimen {value}");
            Series { block, label, ..series.clone() }
        })
    };
    runs.into_iter().enumerate().filter_map(of_run).collect()
}
