//! Series of points of one test, as they are written in a table.

use std::path::PathBuf;

use drape_input::{Diagnostic, Diagnostics};

use crate::tables::block::Block;
use crate::tables::columns::Pair;
use crate::tables::grid::{Cell, Row};
use crate::tables::number::Decimal;

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
    /// Text of its file or sheet outside of the tables.
    pub(crate) stated: Vec<Row>,
    /// Whether its table holds others beside it.
    pub(crate) several: bool,
}

impl Series {
    /// Leaves out the rows of longer neighbours, in which both cells are empty.
    pub(crate) fn trim(&mut self) {
        let Pair { deformation, load, .. } = self.pair;
        let empty = |row: &Row, column: usize| row.cells.get(column).is_none_or(Cell::is_empty);
        if self.several {
            self.block.rows.retain(|row| !(empty(row, deformation) && empty(row, load)));
        }
    }

    /// Returns the numbers of a column, all finite.
    pub(crate) fn numbers(&self, column: usize) -> Result<Vec<f64>, Diagnostics> {
        let number =
            |row: &Row| match row.cells.get(column).and_then(|cell| cell.number(self.decimal)) {
                Some(number) if number.is_finite() => Ok(number),
                _ => Err(self.not_a_number(row, column).into()),
            };
        self.block.rows.iter().map(number).collect()
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

    /// Returns whether the numbers of a column are written with the sign of percent.
    pub(crate) fn is_percent(&self, column: usize) -> bool {
        let first = self.block.rows.first().and_then(|row| row.cells.get(column));
        first.is_some_and(|cell| cell.text().ends_with('%'))
    }
}
