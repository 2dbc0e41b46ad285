//! Cells of a sheet with their labels, as rows or transposed.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::results::label::letters::half_width;
use crate::results::label::{Face, Label};
use crate::results::number::is_number;
use crate::tables::grid::{Cell, Grid, Row};
use crate::tables::heading::{self, Heading, Kind};

/// Least number of numbers below each other that may be a curve. A table of results has only as
/// many rows as items.
const CURVE_LEAST: usize = 16;
/// Part of the rows of a column of numbers that must begin with an item, if the column holds
/// results.
const SHARE_OF_ITEMS: f64 = 0.8;
/// Number of rows above a column of numbers in which the heading is searched.
const HEADING_ROWS: usize = 4;

/// Cell with its position and its label.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    pub(crate) cell: Cell,
    /// Parts of the text of the cell; `None` for a number or an empty cell.
    pub(crate) label: Option<Label>,
    pub(crate) is_number: bool,
    pub(crate) line: usize,
    /// Row and column in the matrix that is not transposed.
    pub(crate) position: (usize, usize),
}

impl Slot {
    /// Returns the slot of `cell`, with the parts of its text.
    fn new(cell: Cell, line: usize, position: (usize, usize)) -> Self {
        let is_number = !cell.is_empty() && is_number(&cell);
        let label = (!cell.is_empty() && !is_number).then(|| Label::parse(&cell.text()));
        Self { cell, label, is_number, line, position }
    }

    /// Removes the content of the cell.
    fn clear(&mut self) {
        self.cell = Cell::Text(String::new());
        self.label = None;
        self.is_number = false;
    }

    /// Returns whether the label of the cell has an item.
    pub(crate) fn has_item(&self) -> bool {
        self.label.as_ref().is_some_and(|label| label.item.is_some())
    }
}

/// Cells of a sheet in rows of equal length. An empty row stands for lines that are skipped.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    pub(crate) rows: Vec<Vec<Slot>>,
}

impl Matrix {
    /// Returns the matrix of the sheet `grid`, without the cells of curves and without the lines
    /// `without`.
    pub(crate) fn from_grid(grid: &Grid, without: &BTreeSet<usize>) -> Self {
        let mut rows: Vec<Row> = Vec::new();
        for row in grid.rows.iter().filter(|row| !without.contains(&row.line)) {
            if rows.last().is_some_and(|before| before.line + 1 < row.line) {
                rows.push(Row { line: row.line - 1, cells: Vec::new() });
            }
            rows.push(split_keys(row));
        }
        let width = rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        let mut slots = Vec::with_capacity(rows.len());
        for (r, row) in rows.into_iter().enumerate() {
            let mut cells = row.cells;
            cells.resize(width, Cell::Text(String::new()));
            let row =
                cells.into_iter().enumerate().map(|(c, cell)| Slot::new(cell, row.line, (r, c)));
            slots.push(row.collect());
        }

        // Names are recognised along rows, then along columns.
        let mut matrix = Self { rows: slots };
        matrix.name_signs();
        let mut transposed = matrix.transposed();
        transposed.name_signs();
        let mut matrix = transposed.transposed();
        matrix.clear_curves();
        matrix.clear_profiles();
        matrix
    }

    /// Returns the matrix with its columns as rows.
    pub(crate) fn transposed(&self) -> Self {
        let width = self.width();
        let column = |c: usize| self.rows.iter().map(|row| row[c].clone()).collect();
        Self { rows: (0..width).map(column).collect() }
    }

    /// Returns the number of columns.
    pub(crate) fn width(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    /// Returns the label in row `r` and column `c`.
    pub(crate) fn label(&self, r: usize, c: usize) -> Option<&Label> {
        self.rows[r][c].label.as_ref()
    }

    /// Makes the cell at `position`, which seemed to be a symbol, a name.
    pub(crate) fn make_name(&mut self, position: (usize, usize)) {
        for slot in self.rows.iter_mut().flatten().filter(|slot| slot.position == position) {
            let name = slot.cell.text();
            slot.label = Some(Label { name, ..Label::default() });
        }
    }

    /// Makes single letters names if they are a list, such as `A, B, C`: no symbol of KES has an A
    /// before it. A plus beside a minus are the two senses of a test.
    fn name_signs(&mut self) {
        for row in &mut self.rows {
            let filled: Vec<(usize, String)> = row
                .iter()
                .enumerate()
                .filter(|(_, slot)| !slot.cell.is_empty())
                .map(|(c, slot)| {
                    (c, half_width(&slot.cell.text()).to_uppercase().replace('−', "-"))
                })
                .collect();
            if has_neighbours(&filled, ["A", "B"]) {
                for (c, text) in &filled {
                    if text.len() == 1 && text.as_bytes()[0].is_ascii_alphabetic() {
                        let name = row[*c].cell.text();
                        row[*c].label = Some(Label { name, ..Label::default() });
                    }
                }
            }
            if has_neighbours(&filled, ["+", "-"]) {
                for (c, text) in &filled {
                    let face = match text.as_str() {
                        "+" => Face::Face,
                        "-" => Face::Back,
                        _ => continue,
                    };
                    row[*c].label = Some(Label { face: Some(face), ..Label::default() });
                }
            }
        }
    }

    /// Removes the columns of curves: long columns of numbers below the heading of a deformation or
    /// a load, and columns without items beside them.
    fn clear_curves(&mut self) {
        for c in 0..self.width() {
            let mut r = 0;
            while r < self.rows.len() {
                let length = self.rows[r..].iter().take_while(|row| row[c].is_number).count();
                if length >= CURVE_LEAST && self.is_curve(r, c, length) {
                    let top = self.heading_row(r, c).unwrap_or(r);
                    self.rows[top..r + length].iter_mut().for_each(|row| row[c].clear());
                }
                r += length.max(1);
            }
        }
    }

    /// Removes the numbers below an item that stand beside a deformation or a load, such as MIU
    /// along a distance.
    fn clear_profiles(&mut self) {
        for r in 0..self.rows.len() {
            let is_profile = (0..self.width()).any(|c| {
                let slot = &self.rows[r][c];
                let is_plain = slot
                    .label
                    .as_ref()
                    .is_some_and(|label| label.item.is_none() && !label.is_tagged());
                is_plain && names_curve(&slot.cell) && self.numbers_below(r, c).len() > 1
            });
            if !is_profile {
                continue;
            }
            for c in 0..self.width() {
                if self.rows[r][c].has_item() {
                    let numbers = self.numbers_below(r, c);
                    self.rows[numbers].iter_mut().for_each(|row| row[c].clear());
                }
            }
        }
    }

    /// Returns the first run of numbers below the row `r` in the column `c`, as rows.
    fn numbers_below(&self, r: usize, c: usize) -> Range<usize> {
        let below = &self.rows[r + 1..];
        let before = below.iter().take_while(|row| !row[c].is_number).count();
        let count = below[before..].iter().take_while(|row| row[c].is_number).count();
        r + 1 + before..r + 1 + before + count
    }

    /// Returns the row of the heading above the row `r` of the column `c`.
    fn heading_row(&self, r: usize, c: usize) -> Option<usize> {
        (r.saturating_sub(HEADING_ROWS)..r)
            .rev()
            .find(|&row| self.label(row, c).is_some_and(|label| !label.is_unit()))
    }

    /// Returns whether `length` numbers from the row `r` in the column `c` are a curve.
    fn is_curve(&self, r: usize, c: usize, length: usize) -> bool {
        let heading = self.heading_row(r, c);
        if let Some(row) = heading {
            let slot = &self.rows[row][c];
            if names_curve(&slot.cell)
                && !slot.has_item()
                && !slot.label.as_ref().is_some_and(Label::is_tagged)
            {
                return true;
            }
            let items = self.rows[row].iter().filter(|slot| slot.has_item()).count();
            if slot.has_item() && items >= 2 {
                return false;
            }
        }

        // In a table of results most rows begin with an item.
        let rows = &self.rows[r..r + length];
        let with_item = rows.iter().filter(|row| row[..c].iter().any(Slot::has_item)).count();
        (with_item as f64) < SHARE_OF_ITEMS * length as f64
    }
}

/// Returns whether `cell` is the heading of a deformation or a load.
fn names_curve(cell: &Cell) -> bool {
    let heading = Heading::parse(&cell.text());
    // F1 may be a fabric: a symbol is the heading of a curve only if it has a unit.
    let is_word = heading.name.chars().count() > 3 || !heading.name.is_ascii();
    let kind = heading::kind(&heading.name).filter(|_| is_word || heading.unit.is_some());
    kind.is_some_and(|kind| !matches!(kind, Kind::Specimen | Kind::Other))
}

/// Returns whether two neighbouring texts are the given `pair`.
fn has_neighbours(texts: &[(usize, String)], pair: [&str; 2]) -> bool {
    texts.windows(2).any(|texts| texts[0].1 == pair[0] && texts[1].1 == pair[1])
}

/// Splits the cells of `row` into keys and values, if each cell is a key with its value, such as
/// `W: 21.3 mg/cm2`.
fn split_keys(row: &Row) -> Row {
    let filled: Vec<&Cell> = row.filled().map(|(_, cell)| cell).collect();
    let pairs: Vec<[Cell; 2]> = filled.iter().filter_map(|cell| key_and_value(cell)).collect();
    if pairs.is_empty() || pairs.len() < filled.len() {
        return row.clone();
    }
    Row { line: row.line, cells: pairs.concat() }
}

/// Returns the key and the value that `cell` holds; `None` for another cell.
fn key_and_value(cell: &Cell) -> Option<[Cell; 2]> {
    let Cell::Text(text) = cell else { return None };
    let (key, value) = text.split_once([':', '=', '：', '＝'])?;
    let cells = [key, value].map(|text| Cell::Text(text.trim().to_owned()));
    (is_number(&cells[1]) && Label::parse(key).item.is_some()).then_some(cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    fn of(text: &str) -> Matrix {
        let rows = Separator::Semicolon.split(text).expect("it splits");
        Matrix::from_grid(&Grid { rows, ..Grid::default() }, &BTreeSet::new())
    }

    #[test]
    fn a_curve_beside_values_is_no_value() {
        let head = "Parameter;Warp;Weft;;Strain (%);Force (gf/cm)\n";
        let rows: String = (0..40)
            .map(|i| {
                let values = if i == 1 {
                    "B;0.1;0.06"
                } else if i == 2 {
                    "W;21;"
                } else {
                    ";;"
                };
                format!("{values};;{i};{}\n", 3 * i)
            })
            .collect();
        let matrix = of(&format!("{head}{rows}"));
        let numbers: Vec<String> = matrix
            .rows
            .iter()
            .flatten()
            .filter(|slot| slot.is_number)
            .map(|slot| slot.cell.text())
            .collect();
        assert_eq!(numbers, ["0.1", "0.06", "21"]);
    }

    #[test]
    fn a_table_of_many_fabrics_or_many_items_is_no_curve() {
        let fabrics: String = (0..40).map(|i| format!("F{i};0.1;0.05;{}\n", 10 + i)).collect();
        let matrix = of(&format!("Fabric;B;2HB;W\n{fabrics}"));
        assert_eq!(matrix.rows.iter().flatten().filter(|slot| slot.is_number).count(), 120);
        let items =
            ["B", "2HB", "G", "2HG", "2HG5", "LT", "WT", "RT", "EM", "LC", "WC", "RC", "MIU"];
        let rows: String = items
            .iter()
            .chain(&["MMD", "SMD", "T0", "TM", "W"])
            .map(|i| format!("{i};1\n"))
            .collect();
        let matrix = of(&format!("Item;Value\n{rows}"));
        assert_eq!(matrix.rows.iter().flatten().filter(|slot| slot.is_number).count(), 18);
    }

    #[test]
    fn letters_in_a_list_are_names_of_specimens() {
        let matrix = of("Item;A;B;C;Mean\nW;21;22;23;22\n");
        assert!(matrix.rows[0].iter().all(|slot| !slot.has_item()), "{:?}", matrix.rows[0]);
        assert!(matrix.rows[1][0].has_item());
    }

    #[test]
    fn keys_with_their_values_in_one_cell_are_parted() {
        let matrix = of("W: 21.3 mg/cm2;T0 = 0.61 mm\nFabric: B 12\n");
        assert!(matrix.rows[0][0].has_item() && matrix.rows[0][1].is_number);
        assert_eq!(matrix.rows[1][0].cell.text(), "Fabric: B 12");
    }
}
