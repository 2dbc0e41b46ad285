//! Series of points of one test, as they are written in a table.

use std::path::PathBuf;

use drape_input::{Diagnostic, Diagnostics};

use crate::tables::block::Block;
use crate::tables::columns::Pair;
use crate::tables::grid::{Cell, Row};
use crate::tables::heading::words::{TIMES, Words, single};
use crate::tables::heading::{Heading, has_word, normal};
use crate::tables::number::Decimal;
use crate::tables::stated::{Around, Stated, size_column};

/// Points of one specimen as they are written.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) path: PathBuf,
    /// Table of the points, with their rows only.
    pub(crate) block: Block,
    pub(crate) pair: Pair,
    pub(crate) decimal: Decimal,
    /// Label of the specimen.
    pub(crate) label: String,
    /// Text and small tables of its file or sheet.
    pub(crate) around: Around,
    /// Whether its table holds others beside it.
    pub(crate) several: bool,
}

impl Series {
    /// Leaves out the rows of longer neighbours, in which both cells are empty.
    pub(crate) fn trim(&mut self) {
        let Pair { deformation, load, .. } = self.pair;
        let empty = |row: &Row, column: usize| row.cells.get(column).is_none_or(Cell::is_empty);
        let several = self.several;
        self.block.rows.retain(|row| {
            let is_neighbours = several || !row.cells.iter().all(Cell::is_empty);
            !(is_neighbours && empty(row, deformation) && empty(row, load))
        });
    }

    /// Returns the numbers of a column, all finite.
    pub(crate) fn numbers(&self, column: usize) -> Result<Vec<f64>, Diagnostics> {
        let number =
            |row: &Row| match row.cells.get(column).and_then(|cell| cell.number(self.decimal)) {
                Some(number) if number.is_finite() => Ok(number),
                _ => Err(self.not_a_number(row, column).into()),
            };
        let numbers = self.block.rows.iter().map(number).collect::<Result<_, Diagnostics>>()?;
        match self.other_unit(column) {
            Some(row) => Err(self.changed_unit(row, column).into()),
            None => Ok(numbers),
        }
    }

    /// Returns the first row whose cell has another unit than the first cell of the column.
    fn other_unit(&self, column: usize) -> Option<&Row> {
        let unit = self.cell_unit(column).unwrap_or_default();
        let other = |row: &&Row| row.cells.get(column).is_some_and(|cell| cell.unit() != unit);
        self.block.rows.iter().find(other)
    }

    fn changed_unit(&self, row: &Row, column: usize) -> Diagnostic {
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

    fn not_a_number(&self, row: &Row, column: usize) -> Diagnostic {
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

    /// Returns the times of the points in the unit of their column, where there is such a column
    /// and its cells are numbers.
    pub(crate) fn times(&self) -> Option<Vec<f64>> {
        let is_time = |heading: &Heading| {
            let name = normal(&heading.name);
            single(TIMES).any(|word| has_word(&name, word))
        };
        let column = self.block.headings.iter().position(is_time)?;
        self.numbers(column).ok()
    }

    /// Returns the unit of a column, within its cells or of its heading.
    pub(crate) fn unit(&self, column: usize) -> Option<&str> {
        let heading = self.block.headings.get(column);
        self.cell_unit(column).or(heading.and_then(|heading| heading.unit.as_deref()))
    }

    /// Returns the length of one of some names that its file states around the numbers.
    pub(crate) fn stated(&self, words: Words) -> Option<Stated> {
        self.around.stated(&self.block.title(), words)
    }

    /// Returns the column of the gauge or the width: its heading is one of some names, and all its
    /// rows hold the same length.
    pub(crate) fn size_column(&self, words: Words) -> Option<usize> {
        let column = size_column(&self.block, &[self.pair.deformation, self.pair.load], words)?;
        let is_one = |all: Vec<f64>| all.iter().all(|length| *length > 0.0 && *length == all[0]);
        self.numbers(column).is_ok_and(is_one).then_some(column)
    }

    /// Returns the unit within the first cell of a column; `None` where there is none.
    pub(crate) fn cell_unit(&self, column: usize) -> Option<&str> {
        let first = self.block.rows.first().and_then(|row| row.cells.get(column));
        first.map(Cell::unit).filter(|unit| !unit.is_empty())
    }
}
