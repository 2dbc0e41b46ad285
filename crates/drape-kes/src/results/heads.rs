//! Heads of the columns of a table of results, in one row or in several rows.

use crate::results::label::{HeadKind, Label};
use crate::results::matrix::{Matrix, Slot};
use crate::tables::number::Decimal;

/// Largest number of a specimen that heads a column.
const SPECIMEN_MAX: f64 = 99.0;

/// Rows of heads above the numbers of an item, nearest rows first.
pub(crate) struct Heads<'m> {
    matrix: &'m Matrix,
    rows: Vec<usize>,
    /// Column of the item, and the first column behind its numbers.
    columns: (usize, usize),
}

/// Returns whether `number` may be the number of a specimen.
fn is_specimen_number(number: f64) -> bool {
    number.fract() == 0.0 && (1.0..=SPECIMEN_MAX).contains(&number)
}

/// Head of a column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Head {
    pub(crate) label: Label,
    /// Kind of the names in the row of the name.
    pub(crate) axis: Option<HeadKind>,
}

impl<'m> Heads<'m> {
    /// Finds the rows of heads above the item in a row and a column of `matrix`, whose numbers end
    /// before the column `end`.
    pub(crate) fn above(matrix: &'m Matrix, (item_row, c): (usize, usize), end: usize) -> Self {
        let mut heads = Self { matrix, rows: Vec::new(), columns: (c, end) };
        for head_row in (0..item_row).rev() {
            let row = &matrix.rows[head_row];
            let is_item = row[c].has_item() || row[c + 1..end].iter().any(|slot| slot.has_item());
            let is_over = row[c + 1..end].iter().any(|slot| !slot.cell.is_empty());
            let heads_columns = is_over && !is_item && heads.heads_columns(head_row);
            if heads_columns {
                heads.rows.push(head_row);
            } else if !heads.rows.is_empty() {
                break;
            }
        }
        heads
    }

    /// Returns whether the row `k` heads columns: with directions, specimens, statistics and units,
    /// or with names beside a cell that is empty or states the kind of the names.
    fn heads_columns(&self, k: usize) -> bool {
        let (c, end) = self.columns;
        let row = &self.matrix.rows[k];
        let side = row[c].label.as_ref();
        let is_open = row[c].cell.is_empty()
            || side.is_some_and(|label| label.name.is_empty() || label.axis.is_some());
        let heads: Vec<&Slot> =
            row[c + 1..end].iter().filter(|slot| !slot.cell.is_empty()).collect();
        let labels = || heads.iter().filter_map(|slot| slot.label.as_ref());
        let is_tagged = labels().any(Label::is_tagged);

        // A row of texts.
        let numbers: Vec<&&Slot> = heads.iter().filter(|slot| slot.is_number).collect();
        if numbers.is_empty() {
            return is_open || is_tagged || labels().any(Label::is_unit);
        }

        // A row with numbers: specimens, or fabrics, which may have any number for a name.
        let are_fabrics = self.kind_of_names(k).is_some_and(|kind| kind != HeadKind::Specimen);
        let fits = heads.iter().filter(|slot| slot.label.is_none()).all(|slot| {
            are_fabrics || slot.cell.number(Decimal::Point).is_some_and(is_specimen_number)
        });
        // A single number is a value of something else; several numbers are specimens.
        let is_axis = side.is_some_and(|label| label.axis.is_some());
        fits && is_open && (numbers.len() > 1 || is_axis || is_tagged)
    }

    /// Returns the kind of the names in the row `k`, which the cell beside them states.
    fn kind_of_names(&self, k: usize) -> Option<HeadKind> {
        let axis = self.matrix.rows[k][self.columns.0].label.as_ref()?.axis?;
        matches!(axis, HeadKind::Specimen | HeadKind::Fabric | HeadKind::Sample).then_some(axis)
    }

    /// Returns the label of the cell in row `k` and column `v` of a head. A number is the number of
    /// a specimen, or the name of a fabric.
    fn label_at(&self, k: usize, v: usize) -> Option<Label> {
        let slot = &self.matrix.rows[k][v];
        let kind_of_names = self.kind_of_names(k).filter(|axis| *axis != HeadKind::Specimen);
        if slot.is_number {
            let number = slot.cell.number(Decimal::Point)?;
            let (name, specimen) = match kind_of_names {
                Some(_) => (slot.cell.text(), None),
                None => (String::new(), is_specimen_number(number).then_some(number as u32)),
            };
            return Some(Label { name, specimen, ..Label::default() });
        }
        let label = slot.label.clone()?;
        // "Warp knit" may be the name of a fabric.
        let is_name = kind_of_names == Some(HeadKind::Fabric) && !label.name.is_empty();
        Some(if is_name { Label { name: slot.cell.text(), ..Label::default() } } else { label })
    }

    /// Returns the head of the column `v`.
    pub(crate) fn at(&self, v: usize) -> Head {
        let (c, _) = self.columns;
        let mut head = Head::default();
        for &k in &self.rows {
            let row = &self.matrix.rows[k];
            // A merged cell stands over its first column only.
            let label = if row[v].cell.is_empty() {
                let filled = (c + 1..v).rev().find(|&l| !row[l].cell.is_empty());
                filled
                    .and_then(|left| self.label_at(k, left))
                    .filter(|label| !label.is_unit() && label.specimen.is_none())
            } else {
                self.label_at(k, v)
            };
            let Some(label) = label else { continue };

            let kind_of_names = self.kind_of_names(k);
            if head.label.name.is_empty() && !label.name.is_empty() {
                head.axis = kind_of_names;
            }
            if label.axis.is_some() && head.label.axis.is_none() {
                head.label.axis = label.axis;
            }
            head.label = head.label.or_from(&label);
        }
        head
    }

    /// Returns the label of the columns from `start` to the item in the row `r`: the name of the
    /// fabric, and the number of the specimen.
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
            if axis == HeadKind::Specimen {
                leading.specimen = text.trim().parse().ok().or(Label::parse(&text).specimen);
            } else {
                (leading.name, leading.axis) = (text, Some(axis));
            }
        }
        leading
    }
}
