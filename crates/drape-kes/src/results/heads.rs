//! Heads of the columns of a table of results, in one row or in several.

use crate::results::label::{Axis, Label};
use crate::results::matrix::Matrix;
use crate::tables::number::Decimal;

/// Largest whole number that heads a column: that of a specimen.
const SPECIMEN_MAX: f64 = 99.0;

/// Rows of heads above the numbers of an item, the nearest first.
pub(crate) struct Heads<'m> {
    matrix: &'m Matrix,
    rows: Vec<usize>,
    /// Column of the item, and the column behind its numbers.
    columns: (usize, usize),
}

/// Returns whether a number is that of a specimen.
fn is_small(number: f64) -> bool {
    number.fract() == 0.0 && (1.0..=SPECIMEN_MAX).contains(&number)
}

/// Head of a column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Head {
    pub(crate) label: Label,
    /// What the table calls the names in the row of the name.
    pub(crate) axis: Option<Axis>,
}

impl<'m> Heads<'m> {
    /// Finds the rows of heads above an item at a row and a column, whose numbers end before a
    /// column.
    pub(crate) fn above(matrix: &'m Matrix, (r, c): (usize, usize), end: usize) -> Self {
        let mut heads = Self { matrix, rows: Vec::new(), columns: (c, end) };
        for k in (0..r).rev() {
            let row = &matrix.rows[k];
            let is_item = row[c].has_item() || row[c + 1..end].iter().any(|slot| slot.has_item());
            let is_over = row[c + 1..end].iter().any(|slot| !slot.cell.is_empty());
            let is_head = is_over && !is_item && heads.is_head(k);
            if is_head {
                heads.rows.push(k);
            } else if !heads.rows.is_empty() {
                break;
            }
        }
        heads
    }

    /// Returns whether a row heads columns: with directions, specimens, statistics and units, or
    /// with names beside a cell that says nothing or what they are.
    fn is_head(&self, k: usize) -> bool {
        let (c, end) = self.columns;
        let row = &self.matrix.rows[k];
        let over = || row[c + 1..end].iter().filter(|slot| !slot.cell.is_empty());
        let number = |slot: &crate::results::matrix::Slot| slot.cell.number(Decimal::Point);
        let side = row[c].label.as_ref();
        // Fabrics may have any number for a name.
        let of_fabrics = self.side(k).is_some_and(|axis| axis != Axis::Specimen);
        let fits = over().all(|slot| match &slot.label {
            Some(_) => true,
            None => of_fabrics || number(slot).is_some_and(is_small),
        });
        let is_open = row[c].cell.is_empty()
            || side.is_some_and(|label| label.name.is_empty() || label.axis.is_some());
        let has = |is: fn(&Label) -> bool| over().any(|slot| slot.label.as_ref().is_some_and(is));
        let counts = over().filter(|slot| slot.is_number).count();
        if counts == 0 {
            return is_open || has(Label::is_tagged) || has(Label::is_unit);
        }
        // One number alone is a value of something else; several are specimens.
        let is_axis = side.is_some_and(|label| label.axis.is_some());
        fits && is_open && (counts > 1 || is_axis || has(Label::is_tagged))
    }

    /// Returns what the names of a row of heads are called beside them.
    fn side(&self, k: usize) -> Option<Axis> {
        let axis = self.matrix.rows[k][self.columns.0].label.as_ref()?.axis?;
        matches!(axis, Axis::Specimen | Axis::Fabric | Axis::Sample).then_some(axis)
    }

    /// Returns what a cell of a row of heads says: a number is that of a specimen, or the name of a
    /// fabric.
    fn said(&self, k: usize, v: usize) -> Option<Label> {
        let slot = &self.matrix.rows[k][v];
        let side = self.side(k).filter(|axis| *axis != Axis::Specimen);
        if slot.is_number {
            let number = slot.cell.number(Decimal::Point)?;
            let (name, specimen) = match side {
                Some(_) => (slot.cell.text(), None),
                None => (String::new(), is_small(number).then_some(number as u32)),
            };
            return Some(Label { name, specimen, ..Label::default() });
        }
        let label = slot.label.clone()?;
        // "Warp knit" is the name of a fabric.
        let is_name = side == Some(Axis::Fabric) && !label.name.is_empty();
        Some(if is_name { Label { name: slot.cell.text(), ..Label::default() } } else { label })
    }

    /// Returns the head of a column.
    pub(crate) fn at(&self, v: usize) -> Head {
        let (c, _) = self.columns;
        let mut head = Head::default();
        for &k in &self.rows {
            let row = &self.matrix.rows[k];
            // A merged cell stands over its first column only.
            let spread = || {
                let left = (c + 1..v).rev().find(|&l| !row[l].cell.is_empty())?;
                let is_wide = |label: &Label| !label.is_unit() && label.specimen.is_none();
                self.said(k, left).filter(is_wide)
            };
            let label = if row[v].cell.is_empty() { spread() } else { self.said(k, v) };
            let Some(label) = label else { continue };
            let side = self.side(k);
            if head.label.name.is_empty() && !label.name.is_empty() {
                head.axis = side;
            }
            if label.axis.is_some() && head.label.axis.is_none() {
                head.label.axis = label.axis;
            }
            head.label = head.label.or(&label);
        }
        head
    }

    /// Returns what the columns before the item say of its row: the name of its fabric, the number
    /// of its specimen.
    pub(crate) fn leading(&self, start: usize, r: usize) -> Label {
        let (c, _) = self.columns;
        let mut leading = Label::default();
        let top = self.rows.first().copied();
        for l in start..c {
            let axis = self.rows.iter().find_map(|&k| self.matrix.label(k, l)?.axis);
            let (Some(axis), Some(top)) = (axis, top) else { continue };
            // A merged cell stands beside its first row only.
            let filled = (top + 1..=r).rev().find(|&k| !self.matrix.rows[k][l].cell.is_empty());
            let Some(text) = filled.map(|k| self.matrix.rows[k][l].cell.text()) else { continue };
            if axis == Axis::Specimen {
                leading.specimen = text.trim().parse().ok().or(Label::parse(&text).specimen);
            } else {
                (leading.name, leading.axis) = (text, Some(axis));
            }
        }
        leading
    }
}
