//! Channels of a test that stand in rows, and are turned into columns.

use crate::tables::block::without_brackets;
use crate::tables::grid::{Cell, Grid, Row};
use crate::tables::heading::{self, Kind};
use drape_input::is_unit;

/// Least count of numbers in a channel. A shorter row holds results, one number per specimen.
const LEAST_NUMBERS: usize = 20;

/// Row of a channel: its heading, and the column where its numbers start.
struct Channel {
    heading: String,
    kind: Option<Kind>,
    start: usize,
}

/// Turns the channels of `grid` that stand in rows into columns. Returns the lines of the channels.
///
/// ```text
/// Extension (mm), 0, 0.1, 0.2, …        Extension (mm), Load (N)
/// Load (N),       0, 0.4, 0.9, …    →   0,              0
///                                       0.1,            0.4 …
/// ```
pub(crate) fn turn_channels(grid: &mut Grid) -> Vec<usize> {
    let mut lines = Vec::new();
    let mut rows: Vec<Row> = Vec::new();
    let mut waiting = std::mem::take(&mut grid.rows).into_iter().peekable();
    while let Some(row) = waiting.next() {
        let Some(first) = channel(&row) else {
            rows.push(row);
            continue;
        };

        // Channels follow each other, without a header above them.
        let names = rows.last().map_or(0, |before: &Row| before.filled().count());
        let has_header = 2 * names > row.numbers();
        let mut run = vec![(first, row)];
        while let Some(next) = waiting.peek().and_then(channel) {
            run.extend(waiting.next().map(|row| (next, row)));
        }

        if has_header || !has_test_axes(&run) {
            rows.extend(run.into_iter().map(|(_, row)| row));
        } else {
            lines.extend(run.iter().map(|(_, row)| row.line));
            rows.extend(columns_of(&run));
        }
    }
    grid.rows = rows;
    lines
}

/// Returns `row` as a channel: a name, perhaps a unit, and nothing but numbers.
fn channel(row: &Row) -> Option<Channel> {
    let mut filled = row.filled();
    let (name_column, name) = filled.next().filter(|(_, cell)| !cell.is_number())?;
    let mut heading = name.text();
    let (mut start, second) = filled.next()?;
    if let Cell::Text(unit) = second
        && is_unit(without_brackets(unit))
    {
        heading = format!("{heading} ({})", without_brackets(unit));
        start += 1;
    } else if !second.is_number() {
        return None;
    }

    // A gap between the name and its numbers belongs to neither.
    let end = row.filled().last().map_or(0, |(column, _)| column);
    let numbers = row.cells.get(start..=end)?;
    let is_channel = start > name_column
        && numbers.len() >= LEAST_NUMBERS
        && numbers.iter().all(Cell::is_number);
    is_channel.then(|| Channel { kind: heading::kind(&name.text()), heading, start })
}

/// Returns whether the channels of `run` hold a load and a deformation.
fn has_test_axes(run: &[(Channel, Row)]) -> bool {
    let kinds: Vec<Kind> = run.iter().filter_map(|(channel, _)| channel.kind).collect();
    let is_load = |kind: &Kind| matches!(kind, Kind::Force | Kind::Moment);
    kinds.iter().any(is_load)
        && kinds.iter().any(|kind| {
            matches!(
                kind,
                Kind::Strain
                    | Kind::Extension
                    | Kind::Position
                    | Kind::Distance
                    | Kind::Angle
                    | Kind::Curvature
            )
        })
}

/// Returns the channels of `run` as a header and rows of numbers, all on the line of the first
/// channel.
fn columns_of(run: &[(Channel, Row)]) -> Vec<Row> {
    let line = run.first().map_or(0, |(_, row)| row.line);
    let header = run.iter().map(|(channel, _)| Cell::Text(channel.heading.clone())).collect();
    let mut rows = vec![Row { line, cells: header }];
    let lengths = run.iter().map(|(channel, row)| row.cells.len() - channel.start);
    for point in 0..lengths.max().unwrap_or(0) {
        let mut cells = Vec::with_capacity(run.len());
        for (channel, row) in run {
            let cell = row.cells.get(channel.start + point).cloned();
            cells.push(cell.unwrap_or_else(|| Cell::Text(String::new())));
        }
        if cells.iter().any(|cell| !cell.is_empty()) {
            rows.push(Row { line, cells });
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::separator;

    fn grid(text: &str) -> Grid {
        let rows = separator(text).split(text).expect("it splits");
        Grid { rows, ..Grid::default() }
    }

    fn numbers(factor: f64) -> String {
        (0..24).map(|k| format!("{}", factor * f64::from(k))).collect::<Vec<_>>().join(",")
    }

    #[test]
    fn channels_in_rows_become_columns() {
        let text = format!(
            "Width,50\nTime (s),{}\nExtension,mm,{}\nLoad (N),{}\n",
            numbers(1.0),
            numbers(0.1),
            numbers(0.5)
        );
        let mut grid = grid(&text);
        assert_eq!(turn_channels(&mut grid), [2, 3, 4]);
        let header: Vec<String> = grid.rows[1].cells.iter().map(Cell::text).collect();
        assert_eq!(header, ["Time (s)", "Extension (mm)", "Load (N)"]);
        assert_eq!((grid.rows.len(), grid.rows[25].line), (26, 2));
        let last: Vec<String> = grid.rows[25].cells.iter().map(Cell::text).collect();
        assert_eq!(last[0], "23");
        assert_eq!(last[2], "11.5");
    }

    #[test]
    fn results_of_specimens_stay_in_their_rows() {
        let specimens = (1..=24).map(|k| format!("S{k}")).collect::<Vec<_>>().join(",");
        let text = format!(
            ",{specimens}\nMaximum load (N),{}\nExtension at maximum (mm),{}\n",
            numbers(1.0),
            numbers(0.1)
        );
        let mut grid = grid(&text);
        assert!(turn_channels(&mut grid).is_empty());
        assert_eq!(grid.rows.len(), 3);
    }
}
