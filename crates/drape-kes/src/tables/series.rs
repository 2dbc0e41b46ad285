//! Series of points of one test as written in a table.

use std::path::PathBuf;

use drape_input::{Diagnostic, Diagnostics};

use crate::tables::block::Block;
use crate::tables::columns::Pair;
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::words::{TIMES, Words, single};
use crate::tables::heading::{has_word, normal};
use crate::tables::number::Decimal;
use crate::tables::stated::{StatedLength, Surroundings, size_column};

/// Points of one specimen as written.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) path: PathBuf,
    /// Table of the series, with the rows of the series only.
    pub(crate) block: Block,
    pub(crate) pair: Pair,
    pub(crate) decimal: Decimal,
    /// Label of the specimen.
    pub(crate) label: String,
    /// Texts and small tables around the series in its file or sheet.
    pub(crate) around: Surroundings,
    /// Whether the table of the series holds other series beside it.
    pub(crate) has_neighbours: bool,
}

impl Series {
    /// Removes rows of longer neighbours, in which both cells of the series are empty.
    pub(crate) fn drop_empty_rows(&mut self) {
        let Pair { deformation, load, .. } = self.pair;
        let has_neighbours = self.has_neighbours;
        self.block.rows.retain(|row| {
            let [no_deformation, no_load] =
                [deformation, load].map(|column| row.cells.get(column).is_none_or(Cell::is_empty));
            let is_of_neighbour = has_neighbours || !row.cells.iter().all(Cell::is_empty);
            !(is_of_neighbour && no_deformation && no_load)
        });
    }

    /// Returns the numbers of `column`, all finite and in one unit.
    pub(crate) fn numbers(&self, column: usize) -> Result<Vec<f64>, Diagnostics> {
        let mut numbers = Vec::with_capacity(self.block.rows.len());
        for row in &self.block.rows {
            match row.cells.get(column).and_then(|cell| cell.number(self.decimal)) {
                Some(number) if number.is_finite() => numbers.push(number),
                _ => return Err(self.number_mistake(row, column).into()),
            }
        }
        match self.first_other_unit(column) {
            Some(row) => Err(self.unit_mistake(row, column).into()),
            None => Ok(numbers),
        }
    }

    /// Returns the first row whose cell in `column` has another unit than the first cell.
    fn first_other_unit(&self, column: usize) -> Option<&Row> {
        let unit = self.cell_unit(column).unwrap_or_default();
        let differs = |row: &&Row| row.cells.get(column).is_some_and(|cell| cell.unit() != unit);
        self.block.rows.iter().find(differs)
    }

    /// Returns the mistake of a `row` that has another unit in `column`.
    fn unit_mistake(&self, row: &Row, column: usize) -> Diagnostic {
        let name = self.block.column_name(column);
        let cell = row.cells.get(column).map(Cell::text).unwrap_or_default();
        let message = match self.cell_unit(column) {
            Some(unit) => {
                format!("column {name} holds \"{cell}\", and its first cell is in {unit}")
            }
            None => format!("column {name} holds \"{cell}\", and its first cell has no unit"),
        };
        let help = "write the whole column in one unit";
        Diagnostic::new(&self.path, message).on_line(row.line).help(help)
    }

    /// Returns the mistake of a `row` without a finite number in `column`.
    fn number_mistake(&self, row: &Row, column: usize) -> Diagnostic {
        let name = self.block.column_name(column);
        let cell = row.cells.get(column).map(Cell::text).unwrap_or_default();
        let (message, help) = if cell.is_empty() {
            (format!("column {name} is empty"), "fill the value in or remove the line")
        } else {
            (
                format!("column {name} holds \"{cell}\", which is not a finite number"),
                "correct the value or remove the line; start comments with #",
            )
        };
        Diagnostic::new(&self.path, message).on_line(row.line).help(help)
    }

    /// Returns the times of the points in the unit of their column. Returns `None` without a column
    /// of times, or if a cell is no number.
    pub(crate) fn times(&self) -> Option<Vec<f64>> {
        self.numbers(self.time_column()?).ok()
    }

    /// Returns the column whose heading is a word for the time.
    pub(crate) fn time_column(&self) -> Option<usize> {
        self.block.headings.iter().position(|heading| {
            let name = normal(&heading.name);
            single(TIMES).any(|word| has_word(&name, word))
        })
    }

    /// Returns the unit of `column`, from its cells or from its heading.
    pub(crate) fn unit(&self, column: usize) -> Option<&str> {
        let heading = self.block.headings.get(column);
        self.cell_unit(column).or(heading.and_then(|heading| heading.unit.as_deref()))
    }

    /// Returns the length that the file states under one of `words`, around the numbers.
    pub(crate) fn stated(&self, words: Words) -> Option<StatedLength> {
        self.around.stated(&self.block.title(), words)
    }

    /// Returns the column of the gauge or the width: its heading is one of `words`, and all its
    /// rows hold one length.
    pub(crate) fn size_column(&self, words: Words) -> Option<usize> {
        let column = size_column(&self.block, &[self.pair.deformation, self.pair.load], words)?;
        let numbers = self.numbers(column).ok()?;
        let is_one = numbers.iter().all(|length| *length > 0.0 && *length == numbers[0]);
        is_one.then_some(column)
    }

    /// Returns the unit within the first cell of `column`; `None` if the cell has none.
    pub(crate) fn cell_unit(&self, column: usize) -> Option<&str> {
        let first = self.block.rows.first().and_then(|row| row.cells.get(column));
        first.map(Cell::unit).filter(|unit| !unit.is_empty())
    }
}
