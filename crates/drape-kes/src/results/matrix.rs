//! Cells of a sheet with what they say, in rows or turned by a quarter.

use std::collections::BTreeSet;

use crate::results::label::letters::half_width;
use crate::results::label::{Face, Label};
use crate::results::number::is_number;
use crate::tables::grid::{Cell, Grid, Row};
use crate::tables::heading::{self, Heading, Kind};

/// Numbers below each other from which on they may be a curve: a table of results has as many rows
/// as items.
const CURVE_LEAST: usize = 16;
/// Part of the rows of a column of numbers that begin with an item, where the column is one of
/// results.
const SHARE_OF_ITEMS: f64 = 0.8;
/// Rows above a column of numbers in which its heading is looked for.
const HEADING_ROWS: usize = 4;

/// Cell with its place.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    pub(crate) cell: Cell,
    /// Parts of its text; `None` for a number or an empty cell.
    pub(crate) label: Option<Label>,
    pub(crate) is_number: bool,
    pub(crate) line: usize,
    /// Row and column of the matrix before it is turned.
    pub(crate) at: (usize, usize),
}

impl Slot {
    fn new(cell: Cell, line: usize, at: (usize, usize)) -> Self {
        let is_number = !cell.is_empty() && is_number(&cell);
        let label = (!cell.is_empty() && !is_number).then(|| Label::parse(&cell.text()));
        Self { cell, label, is_number, line, at }
    }

    /// Removes what the cell says.
    fn clear(&mut self) {
        self.cell = Cell::Text(String::new());
        self.label = None;
        self.is_number = false;
    }

    /// Returns whether the cell has an item.
    pub(crate) fn has_item(&self) -> bool {
        self.label.as_ref().is_some_and(|label| label.item.is_some())
    }
}

/// Cells of a sheet, each row as long as the others; an empty row stands for lines that are left
/// out.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    pub(crate) rows: Vec<Vec<Slot>>,
}

impl Matrix {
    /// Makes the matrix of a sheet, without the cells of curves and without the lines of other
    /// tests.
    pub(crate) fn of(grid: &Grid, without: &BTreeSet<usize>) -> Self {
        let mut rows: Vec<Row> = Vec::new();
        for row in grid.rows.iter().filter(|row| !without.contains(&row.line)) {
            if rows.last().is_some_and(|before| before.line + 1 < row.line) {
                rows.push(Row { line: row.line - 1, cells: Vec::new() });
            }
            rows.push(keys_parted(row));
        }
        let width = rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        let slots = |(r, row): (usize, Row)| {
            let mut cells = row.cells;
            cells.resize(width, Cell::Text(String::new()));
            let slot = |(c, cell): (usize, Cell)| Slot::new(cell, row.line, (r, c));
            cells.into_iter().enumerate().map(slot).collect()
        };
        let mut matrix = Self { rows: rows.into_iter().enumerate().map(slots).collect() };
        matrix.name_signs();
        let mut turned = matrix.turned();
        turned.name_signs();
        let mut matrix = turned.turned();
        matrix.clear_curves();
        matrix.clear_profiles();
        matrix
    }

    /// Returns the matrix with rows in place of columns.
    pub(crate) fn turned(&self) -> Self {
        let width = self.width();
        let column = |c: usize| self.rows.iter().map(|row| row[c].clone()).collect();
        Self { rows: (0..width).map(column).collect() }
    }

    pub(crate) fn width(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    pub(crate) fn label(&self, r: usize, c: usize) -> Option<&Label> {
        self.rows[r][c].label.as_ref()
    }

    /// Makes a cell, which seemed to be a symbol, a name.
    pub(crate) fn make_name(&mut self, at: (usize, usize)) {
        for slot in self.rows.iter_mut().flatten().filter(|slot| slot.at == at) {
            let name = slot.cell.text();
            slot.label = Some(Label { name, ..Label::default() });
        }
    }

    /// Makes single letters names where they are a list, as in `A, B, C`: a symbol of KES has no A
    /// before it. A plus beside a minus are the two senses of a test.
    fn name_signs(&mut self) {
        let plain = |slot: &Slot| half_width(&slot.cell.text()).to_uppercase().replace('−', "-");
        for row in &mut self.rows {
            let filled: Vec<(usize, String)> = row
                .iter()
                .enumerate()
                .filter(|(_, slot)| !slot.cell.is_empty())
                .map(|(c, slot)| (c, plain(slot)))
                .collect();
            let follows = |pair: &[(usize, String)], one: &str, next: &str| {
                pair[0].1 == one && pair[1].1 == next
            };
            let mut pairs = filled.windows(2);
            if pairs.any(|pair| follows(pair, "A", "B")) {
                let is_letter =
                    |text: &String| text.len() == 1 && text.as_bytes()[0].is_ascii_alphabetic();
                for (c, _) in filled.iter().filter(|(_, text)| is_letter(text)) {
                    let name = row[*c].cell.text();
                    row[*c].label = Some(Label { name, ..Label::default() });
                }
            }
            if filled.windows(2).any(|pair| follows(pair, "+", "-")) {
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

    /// Removes the columns of curves: long columns of numbers below a heading of a deformation or a
    /// load, and those that no items stand beside.
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

    /// Removes the numbers below an item that stand beside those of a deformation or a load, as MIU
    /// along a distance.
    fn clear_profiles(&mut self) {
        for r in 0..self.rows.len() {
            let below = |matrix: &Self, c: usize| {
                let numbers = matrix.rows[r + 1..].iter().skip_while(|row| !row[c].is_number);
                let before =
                    matrix.rows[r + 1..].iter().take_while(|row| !row[c].is_number).count();
                (r + 1 + before, numbers.take_while(|row| row[c].is_number).count())
            };
            let is_axis = |c: &usize| {
                let slot = &self.rows[r][*c];
                let plain = slot.label.as_ref().is_some_and(|l| l.item.is_none() && !l.is_tagged());
                plain && is_of_curves(&slot.cell) && below(self, *c).1 > 1
            };
            if !(0..self.width()).any(|c| is_axis(&c)) {
                continue;
            }
            for c in (0..self.width()).filter(|&c| self.rows[r][c].has_item()).collect::<Vec<_>>() {
                let (first, count) = below(self, c);
                self.rows[first..first + count].iter_mut().for_each(|row| row[c].clear());
            }
        }
    }

    /// Returns the row of the heading of a column of numbers from a row on.
    fn heading_row(&self, r: usize, c: usize) -> Option<usize> {
        let text =
            |row: &usize| self.rows[*row][c].label.as_ref().is_some_and(|label| !label.is_unit());
        (r.saturating_sub(HEADING_ROWS)..r).rev().find(text)
    }

    fn is_curve(&self, r: usize, c: usize, length: usize) -> bool {
        let heading = self.heading_row(r, c);
        if let Some(row) = heading {
            let slot = &self.rows[row][c];
            if is_of_curves(&slot.cell)
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
        let has_item = |row: &&Vec<Slot>| row[..c].iter().any(Slot::has_item);
        let begun = self.rows[r..r + length].iter().filter(has_item).count();
        (begun as f64) < SHARE_OF_ITEMS * length as f64
    }
}

/// Returns whether a heading is that of a deformation or a load.
fn is_of_curves(cell: &Cell) -> bool {
    let heading = Heading::parse(&cell.text());
    // F1 may be a fabric: a symbol is one of a curve where it has a unit.
    let is_word = heading.name.chars().count() > 3 || !heading.name.is_ascii();
    let kind = heading::kind(&heading.name).filter(|_| is_word || heading.unit.is_some());
    kind.is_some_and(|kind| !matches!(kind, Kind::Specimen | Kind::Other))
}

/// Parts the cells of a row that hold a key with its value, `W: 21.3 mg/cm2`, where each cell of
/// the row is such a pair.
fn keys_parted(row: &Row) -> Row {
    let pair = |cell: &Cell| -> Option<[Cell; 2]> {
        let Cell::Text(text) = cell else { return None };
        let (key, value) = text.split_once([':', '=', '：', '＝'])?;
        let cells = [key, value].map(|text| Cell::Text(text.trim().to_owned()));
        (is_number(&cells[1]) && Label::parse(key).item.is_some()).then_some(cells)
    };
    let filled: Vec<&Cell> = row.filled().map(|(_, cell)| cell).collect();
    let pairs: Vec<[Cell; 2]> = filled.iter().filter_map(|cell| pair(cell)).collect();
    if pairs.is_empty() || pairs.len() < filled.len() {
        return row.clone();
    }
    Row { line: row.line, cells: pairs.concat() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::Separator;

    fn of(text: &str) -> Matrix {
        let rows = Separator::Semicolon.split(text).expect("it splits");
        Matrix::of(&Grid { rows, ..Grid::default() }, &BTreeSet::new())
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
