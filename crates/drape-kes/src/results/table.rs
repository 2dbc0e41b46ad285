//! Numbers of a sheet with their items. Each item owns the numbers behind it in its row, or below
//! it in its column.

use std::collections::{BTreeMap, BTreeSet};

use crate::results::heads::Heads;
use crate::results::item::Item;
use crate::results::label::written_unit::WrittenUnit;
use crate::results::label::{Cut, Face, HeadKind, Label, Statistic};
use crate::results::matrix::{Matrix, Slot};
use crate::tables::grid::Cell;

/// Number with everything that the table states about it.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) item: Item,
    pub(crate) unit: Option<WrittenUnit>,
    pub(crate) cut: Option<Cut>,
    /// Digit behind the symbol.
    pub(crate) suffix: Option<u32>,
    pub(crate) specimen: Option<u32>,
    pub(crate) statistic: Option<Statistic>,
    pub(crate) face: Option<Face>,
    /// Name over the number, and the kind of the name.
    pub(crate) name: String,
    pub(crate) axis: Option<HeadKind>,
    pub(crate) cell: Cell,
    /// Number of specimens that the row states.
    pub(crate) count: Option<f64>,
    pub(crate) line: usize,
    /// Position and text of the cell of the item.
    pub(crate) item_position: Position,
    pub(crate) item_text: String,
    /// Whether the item has a name without a symbol.
    pub(crate) is_named: bool,
}

/// Entries of the tables of results of a sheet.
#[derive(Clone, Debug, Default)]
pub(crate) struct TableEntries {
    pub(crate) entries: Vec<Entry>,
    /// Cells and rows without a use, each with the reason.
    pub(crate) notes: Vec<String>,
}

/// Row and column of a cell in the matrix that is not transposed.
pub(crate) type Position = (usize, usize);

/// Returns the numbers of `matrix` with their items.
pub(crate) fn read_table(matrix: &Matrix) -> TableEntries {
    let mut matrix = matrix.clone();
    // A symbol in a row and a symbol in a column may both claim a number. The longer list of items
    // is right, and the other symbol is the name of a fabric.
    for _ in 0..matrix.rows.len().max(1) {
        let weaker = weaker_claims(&matrix);
        if weaker.is_empty() {
            break;
        }
        weaker.into_iter().for_each(|position| matrix.make_name(position));
    }

    let mut found = TableEntries::default();
    let sections = Sections::from_matrix(&matrix);
    let transposed = matrix.transposed();
    let (mut rows, mut columns) =
        (RowReader::new(&matrix, false), RowReader::new(&transposed, true));
    let both: Vec<Position> = rows.items().intersection(&columns.items()).copied().collect();
    for position in both {
        // The numbers behind an item and the numbers below it cannot both be its numbers. The
        // longer list of items decides.
        let is_row = rows.item_count(position.1) >= columns.item_count(position.0);
        if is_row { &mut columns } else { &mut rows }.without.insert(position);
    }

    rows.read(&sections, &mut found);
    columns.read(&sections, &mut found);
    found
}

/// Returns the positions of items whose claims to numbers are weaker than the claims of other
/// items.
fn weaker_claims(matrix: &Matrix) -> BTreeSet<Position> {
    let transposed = matrix.transposed();
    let (rows, columns) = (RowReader::new(matrix, false), RowReader::new(&transposed, true));
    let column_claims = columns.claims();
    let mut weaker = BTreeSet::new();
    for (number, by_row) in rows.claims() {
        let Some(&by_column) = column_claims.get(&number) else { continue };
        let is_row = rows.item_count(by_row.1) >= columns.item_count(by_column.0);
        weaker.insert(if is_row { by_column } else { by_row });
    }
    weaker
}

/// Reader of the rows of a matrix, or of the columns of a transposed matrix.
struct RowReader<'m> {
    matrix: &'m Matrix,
    /// Whether the rows are columns of the sheet.
    is_transposed: bool,
    /// Items that have their numbers in the other direction.
    without: BTreeSet<Position>,
}

impl<'m> RowReader<'m> {
    /// Returns a reader of the rows of `matrix`.
    fn new(matrix: &'m Matrix, is_transposed: bool) -> Self {
        Self { matrix, is_transposed, without: BTreeSet::new() }
    }

    /// Returns the positions of the items that have numbers.
    fn items(&self) -> BTreeSet<Position> {
        let mut items = BTreeSet::new();
        for (r, row) in self.matrix.rows.iter().enumerate() {
            for (c, slot) in row.iter().enumerate() {
                if self.first_number(r, c).is_some() {
                    items.insert(slot.position);
                }
            }
        }
        items
    }

    /// Returns the number of different items with numbers in the column `c`.
    fn item_count(&self, c: usize) -> usize {
        let items: BTreeSet<Item> = (0..self.matrix.rows.len())
            .filter(|&r| self.first_number(r, c).is_some())
            .filter_map(|r| self.matrix.label(r, c)?.item)
            .collect();
        items.len()
    }

    /// Returns the positions of the numbers that items claim, each with the position of its item.
    fn claims(&self) -> BTreeMap<Position, Position> {
        let mut claims = BTreeMap::new();
        for (r, row) in self.matrix.rows.iter().enumerate() {
            for c in (0..row.len()).filter(|&c| row[c].has_item()) {
                let numbers = (c + 1..self.end(r, c)).filter(|&v| row[v].is_number);
                claims.extend(numbers.map(|v| (row[v].position, row[c].position)));
            }
        }
        claims
    }

    /// Returns the column behind the numbers of the item in row `r` and column `c`: the column of
    /// the next item of the row, or the width. Below the numbers of a column the names of another
    /// table may follow.
    fn end(&self, r: usize, c: usize) -> usize {
        let row = &self.matrix.rows[r];
        let is_other_head = |next: usize| {
            let label = row[next].label.as_ref();
            self.is_transposed
                && label.is_some_and(|label| !label.name.is_empty())
                && !self.matrix.rows.iter().any(|row| row[next].is_number)
        };
        (c + 1..row.len())
            .find(|&next| row[next].has_item() || is_other_head(next))
            .unwrap_or(row.len())
    }

    /// Returns the column of the first number that the item in row `r` and column `c` claims.
    fn first_number(&self, r: usize, c: usize) -> Option<usize> {
        let row = &self.matrix.rows[r];
        let is_item = row[c].has_item() && !self.without.contains(&row[c].position);
        is_item.then(|| (c + 1..self.end(r, c)).find(|&v| row[v].is_number)).flatten()
    }

    /// Adds the numbers of all rows to `found`. The titles in `sections` apply to the tables below
    /// them.
    fn read(&self, sections: &Sections, found: &mut TableEntries) {
        let mut last: Option<Position> = None;
        let mut title: Option<Position> = None;
        let mut columns: BTreeSet<usize> = BTreeSet::new();
        for (r, row) in self.matrix.rows.iter().enumerate() {
            let items: Vec<usize> =
                (0..row.len()).filter(|&c| self.first_number(r, c).is_some()).collect();

            // A row without an item may continue the row above, or belong to a title above.
            if items.is_empty() {
                let filled: Vec<usize> =
                    (0..row.len()).filter(|&c| !row[c].cell.is_empty()).collect();
                if let [only] = filled[..] {
                    title = row[only].has_item().then_some((r, only));
                }
                last = last.filter(|&(_, c)| self.continues(c, r));
                let below_title = || Some((title?, self.tagged_column(r, *filled.first()?)?));
                let continued = last.map(|item| (item, item.1));
                if let Some((item, c)) = continued.or_else(below_title) {
                    self.read_item((r, c), &self.context(item, sections), found);
                }
                continue;
            }
            title = None;
            for c in items {
                self.read_item((r, c), &self.context((r, c), sections), found);
                columns.insert(c);
                last = Some((r, c));
            }
        }

        columns.into_iter().for_each(|c| self.note_unread(c, found));
    }

    /// Returns the item in a row and a column, with the titles above its table.
    fn context(&self, (r, c): (usize, usize), sections: &Sections) -> ItemContext {
        let slot = &self.matrix.rows[r][c];
        ItemContext {
            label: slot.label.clone().unwrap_or_default(),
            section: sections.above(slot.position),
            item_position: slot.position,
            text: slot.cell.text(),
        }
    }

    /// Returns the column `first` if the row `r` below a title begins there: its cell states a
    /// direction, a specimen or a statistic, and numbers follow.
    fn tagged_column(&self, r: usize, first: usize) -> Option<usize> {
        let row = &self.matrix.rows[r];
        let is_tagged = row[first].label.as_ref().is_some_and(Label::is_tagged);
        let has_numbers = row[first + 1..].iter().any(|slot| slot.is_number);
        (is_tagged && has_numbers && !self.is_transposed).then_some(first)
    }

    /// Returns whether the row `r` without an item continues the item above it in the column `c`:
    /// the cell below the item is empty, and another cell before the numbers states a difference.
    fn continues(&self, c: usize, r: usize) -> bool {
        let row = &self.matrix.rows[r];
        let Some(first) = (c + 1..row.len()).find(|&v| row[v].is_number) else { return false };
        row[c].cell.is_empty()
            && row[..first].iter().any(|slot| slot.label.as_ref().is_some_and(Label::is_tagged))
    }

    /// Adds the numbers in the row `r` of the item in the column `c`.
    fn read_item(&self, (r, c): Position, context: &ItemContext, found: &mut TableEntries) {
        let ItemContext { label, section, item_position, text } = context;
        let Some(item) = label.item else { return };
        let row = &self.matrix.rows[r];
        let end = self.end(r, c);
        let numbers: Vec<usize> = (c + 1..end).filter(|&v| row[v].is_number).collect();
        let (Some(&first), Some(last)) = (numbers.first(), numbers.last()) else { return };

        // The cells before the numbers apply to all of them.
        let before = (0..c).rev().find(|&l| row[l].has_item());
        let start = before
            .map_or(0, |item| (item..c).rev().find(|&l| row[l].is_number).unwrap_or(item) + 1);
        let common = self.common_label((r, c), label, (start, first));
        let heads = Heads::above(self.matrix, (r, c), last + 1);
        let mut leading = heads.leading(start, r);
        // A column of numbers of specimens holds no values.
        for &v in &numbers {
            if heads.at(v).label.axis == Some(HeadKind::Specimen) && numbers.len() > 1 {
                leading.specimen = row[v].cell.text().parse().ok();
            }
        }
        let has_unit = common.unit.is_some();
        let common = common.or_from(&leading);
        let count = numbers
            .iter()
            .find(|&&v| heads.at(v).label.statistic == Some(Statistic::Count))
            .and_then(|&v| row[v].cell.text().parse().ok());

        for (place, &v) in numbers.iter().enumerate() {
            let mut head = heads.at(v);
            head.label.cut = head.label.cut.or_else(|| direction_beside(&heads, &numbers, place));
            let is_number_of_specimen =
                head.label.axis == Some(HeadKind::Specimen) && numbers.len() > 1;
            if is_number_of_specimen || head.label.statistic == Some(Statistic::Count) {
                continue;
            }

            let sign = row[v - 1].label.as_ref().filter(|_| v > first);
            let sign = sign.and_then(|label| label.statistic);
            // A unit behind the first number applies until the next unit.
            let unit_before = (first + 1..v).rev().find_map(|l| unit_alone(&row[l]));
            let unit_behind = (v + 1..end).find_map(|l| unit_alone(&row[l])).filter(|_| !has_unit);
            let unit = unit_behind.or(unit_before).or_else(|| common.unit.clone());
            let label = Label { unit, ..common.clone() }.or_from(&head.label).or_from(section);
            found.entries.push(Entry {
                item,
                unit: label.unit,
                cut: label.cut,
                suffix: label.suffix,
                specimen: label.specimen,
                statistic: sign.or(label.statistic),
                face: label.face,
                name: label.name,
                axis: head.axis.or(leading.axis).or(section.axis),
                cell: row[v].cell.clone(),
                count,
                line: row[v].line,
                item_position: *item_position,
                item_text: text.clone(),
                is_named: context.label.is_named,
            });
        }
    }

    /// Returns the label of the cells in the row `r` that apply to all numbers of the item in the
    /// column `c`: the item's `label`, and the cells from the column `start` to the `first` number.
    fn common_label(
        &self,
        (r, c): Position,
        label: &Label,
        (start, first): (usize, usize),
    ) -> Label {
        let row = &self.matrix.rows[r];
        let mut common = Label { name: String::new(), ..label.clone() };
        // Below a title the cell in the column of the item tells the rows apart.
        let below_title = row[c].label.as_ref().filter(|label| label.item.is_none());
        common = common
            .or_from(&Label { name: String::new(), ..below_title.cloned().unwrap_or_default() });
        for l in (start..c).chain(c + 1..first) {
            let Some(mut label) = row[l].label.clone() else { continue };
            if label.unit.is_none() && !label.is_tagged() && self.is_column_of_units(l, c) {
                let text = std::mem::take(&mut label.name);
                label.unit = Some(WrittenUnit { text, is_known: false })
                    .filter(|unit| !unit.text.is_empty());
            }
            common = common.or_from(&Label { name: String::new(), ..label });
        }
        common
    }

    /// Returns whether `column` holds the units of the items in the column `items`.
    fn is_column_of_units(&self, column: usize, items: usize) -> bool {
        self.matrix.rows.iter().any(|row| {
            row[column].label.as_ref().is_some_and(|label| {
                row[items].has_item() && label.is_unit() || label.axis == Some(HeadKind::Unit)
            })
        })
    }

    /// Notes what is not read in the table of the column `c` of items: rows of other items, and
    /// cells without a number.
    fn note_unread(&self, c: usize, found: &mut TableEntries) {
        let items: Vec<usize> =
            (0..self.matrix.rows.len()).filter(|&r| self.first_number(r, c).is_some()).collect();
        let (Some(&top), Some(&bottom)) = (items.first(), items.last()) else { return };
        let values: Vec<usize> = (c + 1..self.matrix.width())
            .filter(|&v| items.iter().any(|&r| self.matrix.rows[r][v].is_number))
            .collect();

        let mut others: Vec<String> = Vec::new();
        for r in top..=(bottom + 1).min(self.matrix.rows.len() - 1) {
            let row = &self.matrix.rows[r];
            let label = row[c].label.as_ref();
            let has_number = values.iter().any(|&v| row[v].is_number);
            match label {
                Some(label) if label.item.is_some() => {
                    let end = self.end(r, c);
                    let slots = values.iter().filter(|v| **v < end).map(|&v| &row[v]);
                    for slot in slots.filter(|slot| is_unreadable(slot)) {
                        let (line, text) = (slot.line, slot.cell.text());
                        let symbol = label.item.map(Item::symbol).unwrap_or_default();
                        found.notes.push(format!("line {line}: \"{text}\" is no number, so that {symbol} is not read there{}", reason_of_date(&text)));
                    }
                }
                Some(label) if has_number && !label.name.is_empty() => {
                    others.push(format!("\"{}\" (line {})", row[c].cell.text(), row[c].line));
                }
                _ => {}
            }
        }

        let symbols: BTreeSet<Option<Item>> =
            items.iter().map(|&r| self.matrix.label(r, c).and_then(|label| label.item)).collect();
        // Beside a thickness alone stand other sizes of specimens.
        let is_of_sizes = symbols.iter().all(|symbol| *symbol == Some(Item::Key("T")));
        if !others.is_empty() && !is_of_sizes {
            let rest = others.len().saturating_sub(NAMES_MAX);
            others.truncate(NAMES_MAX);
            let others_more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            found.notes.push(format!(
                "left out, since it is no value of KES, FAST or a cantilever: {}{others_more}",
                others.join(", ")
            ));
        }
    }
}

/// Returns the direction of a column of deviations without a direction: the direction of the column
/// before, if each direction of the row has such a column.
fn direction_beside(heads: &Heads<'_>, numbers: &[usize], place: usize) -> Option<Cut> {
    let labels: Vec<Label> = numbers.iter().map(|&v| heads.at(v).label).collect();
    let statistic = labels[place].statistic;
    let is_deviation =
        matches!(statistic, Some(Statistic::Deviation | Statistic::Variation | Statistic::Error));
    if labels[place].cut.is_some() || !is_deviation {
        return None;
    }
    let directions: BTreeSet<Cut> = labels.iter().filter_map(|label| label.cut).collect();
    let same = labels.iter().filter(|label| label.cut.is_none() && label.statistic == statistic);
    if same.count() != directions.len() {
        return None;
    }
    labels[..place].iter().rev().find_map(|label| label.cut)
}

/// Returns the unit of a cell that holds nothing but a unit.
fn unit_alone(slot: &Slot) -> Option<WrittenUnit> {
    slot.label.as_ref().filter(|label| label.is_unit()).and_then(|label| label.unit.clone())
}

/// Largest number of names of other items in a note.
const NAMES_MAX: usize = 6;

/// Item with the titles above its table.
struct ItemContext {
    label: Label,
    section: Label,
    item_position: Position,
    /// Text of the cell of the item.
    text: String,
}

/// Titles of tables below each other that name a direction or a fabric, each with its row.
struct Sections(Vec<(usize, Label)>);

impl Sections {
    /// Finds the titles in `matrix`: rows of one cell, or of a word for fabrics and a name.
    fn from_matrix(matrix: &Matrix) -> Self {
        let mut sections = Vec::new();
        for (r, row) in matrix.rows.iter().enumerate() {
            let filled: Vec<&Slot> = row.iter().filter(|slot| !slot.cell.is_empty()).collect();
            let Some(section) = section(&filled) else { continue };
            if section.cut.is_some() || !section.name.is_empty() {
                sections.push((r, section));
            }
        }
        Self(sections)
    }

    /// Returns the label of the titles above a cell. The nearest title wins.
    fn above(&self, (row, _): Position) -> Label {
        let above = self.0.iter().rev().filter(|(r, _)| *r < row);
        above.fold(Label::default(), |label, (_, section)| {
            let axis = label.axis.or(section.axis);
            Label { axis, ..label.or_from(section) }
        })
    }
}

/// Returns the title that the `filled` cells of a row are.
fn section(filled: &[&Slot]) -> Option<Label> {
    match filled {
        [title] => {
            let label = title.label.as_ref().filter(|label| label.item.is_none())?;
            let first = label.name.split([' ', ':']).next().unwrap_or_default();
            let axis = Label::parse(first).axis.filter(|axis| *axis != HeadKind::Specimen);
            let name = axis.and_then(|_| label.name.split_once([' ', ':']));
            let name =
                name.map_or(String::new(), |(_, name)| name.trim_matches([' ', ':']).to_owned());
            let cut = label.cut.filter(|_| label.name.is_empty());
            Some(Label { cut, name, axis, ..Label::default() })
        }
        [key, name] => {
            let label = key.label.as_ref().filter(|label| label.item.is_none())?;
            let axis = label.axis.filter(|axis| *axis != HeadKind::Specimen)?;
            Some(Label { name: name.cell.text(), axis: Some(axis), ..Label::default() })
        }
        _ => None,
    }
}

/// Returns whether a cell among numbers holds a meaningful text that is no number.
fn is_unreadable(slot: &Slot) -> bool {
    const NOTHING: [&str; 14] =
        ["-", "–", "—", "/", "n.d.", "n.a.", "na", "n/a", "nd", "none", "*", "k.a.", "なし", "无"];
    let text = slot.cell.text().to_lowercase();
    let is_meaningful = !text.is_empty() && !NOTHING.contains(&text.as_str());
    is_meaningful && slot.label.as_ref().is_some_and(|label| !label.is_unit() && !label.is_tagged())
}

/// Returns the explanation of a cell that holds the date `text`; empty for another text.
fn reason_of_date(text: &str) -> &'static str {
    let parts: Vec<&str> = text.split('-').collect();
    let is_date = matches!(parts[..], [year, month, day] if year.len() == 4
        && month.len() == 2 && day.len() == 2 && parts.iter().all(|part| part.parse::<u32>().is_ok()));
    if is_date { ": the spreadsheet has made a date of it" } else { "" }
}
