//! Channels of a test that stand in rows, turned into columns.

use crate::tables::block::unbracketed;
use crate::tables::grid::{Cell, Grid, Row};
use crate::tables::heading::{self, Kind};
use drape_input::is_unit;

/// Least count of numbers in a channel; a shorter row holds results, a number for each specimen.
const LEAST: usize = 20;

/// Row of a channel: its heading, and where its numbers start.
struct Channel {
    heading: String,
    kind: Option<Kind>,
    start: usize,
}

/// Turns the channels of a grid that stand in rows into columns; returns the lines on which they
/// stood.
///
/// ```text
/// Extension (mm), 0, 0.1, 0.2, …        Extension (mm), Load (N)
/// Load (N),       0, 0.4, 0.9, …    →   0,              0
///                                       0.1,            0.4 …
/// ```
pub(crate) fn turn(grid: &mut Grid) -> Vec<usize> {
    let mut lines = Vec::new();
    let mut rows: Vec<Row> = Vec::new();
    let mut waiting = std::mem::take(&mut grid.rows).into_iter().peekable();
    while let Some(row) = waiting.next() {
        let Some(first) = channel(&row) else {
            rows.push(row);
            continue;
        };
        let names = rows.last().map_or(0, |before: &Row| before.filled().count());
        let has_header = 2 * names > row.numbers();
        let mut run = vec![(first, row)];
        while let Some(next) = waiting.peek().and_then(channel) {
            run.extend(waiting.next().map(|row| (next, row)));
        }
        if has_header || !is_test(&run) {
            rows.extend(run.into_iter().map(|(_, row)| row));
        } else {
            lines.extend(run.iter().map(|(_, row)| row.line));
            rows.extend(turned(&run));
        }
    }
    grid.rows = rows;
    lines
}

/// Returns a row as a channel: a name, perhaps a unit, and nothing but numbers.
fn channel(row: &Row) -> Option<Channel> {
    let mut filled = row.filled();
    let (at, name) = filled.next().filter(|(_, cell)| !cell.is_number())?;
    let mut heading = name.text();
    let (mut start, second) = filled.next()?;
    if let Cell::Text(unit) = second
        && is_unit(unbracketed(unit))
    {
        heading = format!("{heading} ({})", unbracketed(unit));
        start += 1;
    } else if !second.is_number() {
        return None;
    }
    // A gap between the name and its numbers belongs to neither.
    let end = row.filled().last().map_or(0, |(column, _)| column);
    let numbers = row.cells.get(start..=end)?;
    let is_channel = start > at && numbers.len() >= LEAST && numbers.iter().all(Cell::is_number);
    is_channel.then(|| Channel { kind: heading::kind(&name.text()), heading, start })
}

/// Returns whether the rows hold a load and a deformation.
fn is_test(run: &[(Channel, Row)]) -> bool {
    let has = |kinds: &[Kind]| {
        run.iter().any(|(channel, _)| channel.kind.is_some_and(|kind| kinds.contains(&kind)))
    };
    has(&[Kind::Force, Kind::Moment])
        && has(&[
            Kind::Strain,
            Kind::Extension,
            Kind::Position,
            Kind::Distance,
            Kind::Angle,
            Kind::Curvature,
        ])
}

/// Returns a header and rows of numbers, all on the line of the first channel.
fn turned(run: &[(Channel, Row)]) -> Vec<Row> {
    let line = run.first().map_or(0, |(_, row)| row.line);
    let row = |cells: Vec<Cell>| Row { line, cells };
    let header = run.iter().map(|(channel, _)| Cell::Text(channel.heading.clone())).collect();
    let numbers = |(channel, row): &(Channel, Row)| row.cells.len() - channel.start;
    let longest = run.iter().map(numbers).max().unwrap_or(0);
    let cell = |(channel, row): &(Channel, Row), place: usize| {
        let cell = row.cells.get(channel.start + place).cloned();
        cell.unwrap_or_else(|| Cell::Text(String::new()))
    };
    let point = |place: usize| row(run.iter().map(|channel| cell(channel, place)).collect());
    let points = (0..longest).map(point).filter(|row| row.filled().count() > 0);
    std::iter::once(row(header)).chain(points).collect()
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
        assert_eq!(turn(&mut grid), [2, 3, 4]);
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
        assert!(turn(&mut grid).is_empty());
        assert_eq!(grid.rows.len(), 3);
    }
}
