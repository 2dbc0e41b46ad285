//! Parts of one table that are series themselves: the rows of a direction, or of a specimen.

use crate::tables::block::Block;
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::{self, Kind};
use crate::tables::layout::Layout;
use crate::tables::series::Series;
use crate::test::Direction;

/// Splits `series` at its column of directions, and each part at its column of specimens.
pub(crate) fn split_parts(series: Series, layout: &Layout) -> Vec<Series> {
    let directed = split_by_direction(series);
    directed.into_iter().flat_map(|series| split_by_specimen(series, layout)).collect()
}

/// Splits `series` at the words of a column that says warp or weft, if there is one.
fn split_by_direction(series: Series) -> Vec<Series> {
    let rows = &series.block.rows;
    let column = (0..series.block.width())
        .find(|&column| rows.iter().all(|row| direction_in(row, column).is_some()));
    let Some(column) = column else { return vec![series] };

    let mut parts = Vec::new();
    for direction in [Direction::Warp, Direction::Weft] {
        let is_directed = |row: &&Row| direction_in(row, column) == Some(direction);
        let rows: Vec<Row> = rows.iter().filter(is_directed).cloned().collect();
        if rows.is_empty() {
            continue;
        }
        let mut part = series.clone();
        part.block.rows = rows;
        part.pair.label = direction.name().to_owned();
        if !part.label.is_empty() {
            part.label += ", ";
        }
        part.label += direction.name();
        parts.push(part);
    }
    parts
}

/// Returns the one direction that the text in a `column` of `row` names.
fn direction_in(row: &Row, column: usize) -> Option<Direction> {
    let text = row.cells.get(column).filter(|cell| !cell.is_number()).map(Cell::text)?;
    match heading::directions(&text).as_slice() {
        [direction] => Some(*direction),
        _ => None,
    }
}

/// Splits `series` at the values of a column of specimens, if there is one, and keeps the specimens
/// that `layout` declares.
fn split_by_specimen(series: Series, layout: &Layout) -> Vec<Series> {
    let columns = (0..series.block.width()).filter(|column| {
        let heading = series.block.headings.get(*column);
        heading.and_then(|heading| heading::kind(&heading.name)) == Some(Kind::Specimen)
            && ![series.pair.deformation, series.pair.load].contains(column)
    });
    let runs = columns.into_iter().find_map(|column| specimen_runs(&series.block, column));
    let Some(runs) = runs else { return vec![series] };

    let title = match series.pair.label.as_str() {
        "" => String::new(),
        label => format!("{label}, "),
    };
    let mut specimens = Vec::new();
    for (index, (value, rows)) in runs.into_iter().enumerate() {
        let number = value.trim_end_matches(".0").parse().unwrap_or(index + 1);
        if layout.specimen.contains(number) {
            let block = Block { rows, ..series.block.clone() };
            let label = format!("{title}specimen {value}");
            specimens.push(Series { block, label, ..series.clone() });
        }
    }
    specimens
}

/// Returns the runs of equal values in a `column` of `block`, with their rows. Returns `None` if
/// the values do not belong to several specimens: a run is short, or a value returns.
fn specimen_runs(block: &Block, column: usize) -> Option<Vec<(String, Vec<Row>)>> {
    /// Least number of rows of a specimen.
    const ROWS_OF_SPECIMEN: usize = 3;

    let mut runs: Vec<(String, Vec<Row>)> = Vec::new();
    for row in &block.rows {
        let value = row.cells.get(column).map(Cell::text).unwrap_or_default();
        match runs.last_mut() {
            Some((last, rows)) if *last == value || value.is_empty() => rows.push(row.clone()),
            _ => runs.push((value, vec![row.clone()])),
        }
    }
    let are_long = runs.iter().all(|(_, rows)| rows.len() >= ROWS_OF_SPECIMEN);
    let are_unique =
        runs.iter().enumerate().all(|(i, (a, _))| runs[..i].iter().all(|(b, _)| a != b));
    (runs.len() > 1 && are_long && are_unique).then_some(runs)
}
