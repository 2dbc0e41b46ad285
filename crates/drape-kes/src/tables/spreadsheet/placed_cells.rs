//! Cells of the sheets of a spreadsheet, within limits.

use crate::tables::grid::{CELLS_MAX, Cell, Row};

/// Largest size of a spreadsheet once it is unpacked, in bytes.
pub(super) const UNPACKED_MAX: u64 = 500_000_000;

/// Largest size of the texts of all cells, in bytes. Cells may share a text that is stored once.
const TEXTS_MAX: usize = 100_000_000;

/// Cell with its row and its column, both from 0.
pub(super) struct PlacedCell {
    pub(super) row: u32,
    pub(super) column: u32,
    pub(super) cell: Cell,
}

/// Account of the cells of all sheets of a spreadsheet.
#[derive(Default)]
pub(super) struct PlacedCells {
    /// Number of cells that were placed.
    placed: usize,
    /// Number of cells of all rows.
    laid_out: usize,
    /// Size of the texts of the cells that were placed, in bytes.
    texts: usize,
}

impl PlacedCells {
    /// Appends `placed` to `cells`, the cells of a sheet, if it is not empty. `Err` holds the
    /// reason why a spreadsheet with too many cells is refused.
    pub(super) fn place(
        &mut self,
        cells: &mut Vec<PlacedCell>,
        placed: PlacedCell,
    ) -> Result<(), String> {
        if placed.cell.is_empty() {
            return Ok(());
        }
        if self.placed == CELLS_MAX {
            return Err(too_many_cells());
        }
        if let Cell::Text(text) = &placed.cell {
            self.texts += text.len();
        }
        if self.texts > TEXTS_MAX {
            let size = TEXTS_MAX / 1_000_000;
            return Err(format!("its texts have more than {size} MB: save the results alone"));
        }

        self.placed += 1;
        cells.push(placed);
        Ok(())
    }

    /// Returns the rows of `cells`, the cells of a sheet. All rows are as wide as the sheet, unless
    /// the spreadsheet then has more than [`CELLS_MAX`] cells: then each row ends with its last
    /// cell.
    pub(super) fn rows(&mut self, mut cells: Vec<PlacedCell>) -> Result<Vec<Row>, String> {
        // Of two cells at one place the later one counts.
        cells.sort_by_key(|placed| (placed.row, placed.column));
        let width = cells.iter().map(|placed| placed.column as usize + 1).max().unwrap_or(0);
        let groups = || cells.chunk_by(|one, other| one.row == other.row);
        let left = CELLS_MAX - self.laid_out;
        let is_padded = groups().count().saturating_mul(width) <= left;
        let width_of = |group: &[PlacedCell]| match group.last() {
            Some(last) if !is_padded => last.column as usize + 1,
            _ => width,
        };
        let count: usize = groups().map(width_of).sum();
        if count > left {
            return Err(too_many_cells());
        }
        self.laid_out += count;

        let rows = groups().map(|group| {
            let mut row = vec![Cell::Text(String::new()); width_of(group)];
            for placed in group {
                row[placed.column as usize] = placed.cell.clone();
            }
            Row { line: group.first().map_or(0, |placed| placed.row as usize) + 1, cells: row }
        });
        Ok(rows.collect())
    }
}

/// Returns the reason for which a spreadsheet with too many cells is refused.
fn too_many_cells() -> String {
    format!("it has more than {CELLS_MAX} cells: delete the stray ones, or save the results alone")
}
