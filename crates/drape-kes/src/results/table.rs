//! Numbers of a sheet with the items that they are of: each item rules the numbers behind it, in
//! its row or in its column.

use std::collections::{BTreeMap, BTreeSet};

use crate::results::heads::Heads;
use crate::results::item::Item;
use crate::results::label::written_unit::WrittenUnit;
use crate::results::label::{Axis, Cut, Face, Label, Statistic};
use crate::results::matrix::{Matrix, Slot};
use crate::tables::grid::Cell;

/// Number with everything that the table says of it.
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
    /// Name over the number, of a fabric or a specimen, and what the table calls such names.
    pub(crate) name: String,
    pub(crate) axis: Option<Axis>,
    pub(crate) cell: Cell,
    /// Number of specimens that the row states.
    pub(crate) count: Option<f64>,
    pub(crate) line: usize,
    /// Place of the cell of the item, and its text.
    pub(crate) item_at: At,
    pub(crate) item_text: String,
    /// Whether the item is known by its name alone, without a symbol.
    pub(crate) is_named: bool,
}

/// What a sheet says in its tables of results.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    pub(crate) entries: Vec<Entry>,
    /// Cells and rows that have no use, each with the reason.
    pub(crate) notes: Vec<String>,
}

/// Place of a cell in the matrix that is not turned.
pub(crate) type At = (usize, usize);

/// Returns the numbers of a sheet with their items.
pub(crate) fn found(matrix: &Matrix) -> Found {
    let mut matrix = matrix.clone();
    // A symbol of a row and one of a column may both claim a number: that of the longer list of
    // items is one, the other is the name of a fabric.
    for _ in 0..matrix.rows.len().max(1) {
        let lost = lost_claims(&matrix);
        if lost.is_empty() {
            break;
        }
        lost.into_iter().for_each(|at| matrix.make_name(at));
    }
    let mut found = Found::default();
    let sections = Sections::of_matrix(&matrix);
    let turned = matrix.turned();
    let (mut rows, mut columns) = (Rows::new(&matrix, false), Rows::new(&turned, true));
    let both: Vec<At> = rows.items().intersection(&columns.items()).copied().collect();
    for at in both {
        // Numbers behind an item and below it: those of the longer list of items are its own.
        let is_row = rows.strength(at.1) >= columns.strength(at.0);
        if is_row { &mut columns } else { &mut rows }.without.insert(at);
    }
    rows.read(&sections, &mut found);
    columns.read(&sections, &mut found);
    found
}

/// Returns the items whose claims to numbers are weaker than the claims of others.
fn lost_claims(matrix: &Matrix) -> BTreeSet<At> {
    let turned = matrix.turned();
    let (rows, columns) = (Rows::new(matrix, false), Rows::new(&turned, true));
    let claims = [rows.claims(), columns.claims()];
    let both = claims[0].iter().filter_map(|(number, row)| Some((*row, *claims[1].get(number)?)));
    let lost = |(by_row, by_column): (At, At)| {
        let is_row = rows.strength(by_row.1) >= columns.strength(by_column.0);
        if is_row { by_column } else { by_row }
    };
    let pairs: BTreeSet<(At, At)> = both.collect();
    pairs.into_iter().map(lost).collect()
}

/// Reader of the rows of a matrix.
struct Rows<'m> {
    matrix: &'m Matrix,
    /// Whether the rows are the columns of the sheet.
    is_turned: bool,
    /// Items that have their numbers in the other direction.
    without: BTreeSet<At>,
}

impl<'m> Rows<'m> {
    fn new(matrix: &'m Matrix, is_turned: bool) -> Self {
        Self { matrix, is_turned, without: BTreeSet::new() }
    }

    /// Returns the places of the items that have numbers.
    fn items(&self) -> BTreeSet<At> {
        let places = |r: usize| (0..self.matrix.width()).map(move |c| (r, c));
        let all = (0..self.matrix.rows.len()).flat_map(places);
        let with_numbers = all.filter(|&(r, c)| self.first_number(r, c).is_some());
        with_numbers.map(|(r, c)| self.matrix.rows[r][c].at).collect()
    }

    /// Returns the number of different items with numbers in a column of the matrix.
    fn strength(&self, c: usize) -> usize {
        let items: BTreeSet<Item> = (0..self.matrix.rows.len())
            .filter(|&r| self.first_number(r, c).is_some())
            .filter_map(|r| self.matrix.label(r, c)?.item)
            .collect();
        items.len()
    }

    /// Returns the numbers that items claim, each with the place of its item.
    fn claims(&self) -> BTreeMap<At, At> {
        let mut claims = BTreeMap::new();
        for (r, row) in self.matrix.rows.iter().enumerate() {
            for c in (0..row.len()).filter(|&c| row[c].has_item()) {
                let numbers = (c + 1..self.end(r, c)).filter(|&v| row[v].is_number);
                claims.extend(numbers.map(|v| (row[v].at, row[c].at)));
            }
        }
        claims
    }

    /// Returns the column behind the numbers of an item: that of the next item of its row, or the
    /// width. Below the numbers of a column the names of another table may follow.
    fn end(&self, r: usize, c: usize) -> usize {
        let row = &self.matrix.rows[r];
        let is_name = |slot: &Slot| slot.label.as_ref().is_some_and(|label| !label.name.is_empty());
        let of_another = |next: usize| {
            let has_number = |row: &Vec<Slot>| row[next].is_number;
            self.is_turned && is_name(&row[next]) && !self.matrix.rows.iter().any(has_number)
        };
        let is_behind = |next: &usize| row[*next].has_item() || of_another(*next);
        (c + 1..row.len()).find(is_behind).unwrap_or(row.len())
    }

    /// Returns the first number that the item of a cell claims.
    fn first_number(&self, r: usize, c: usize) -> Option<usize> {
        let row = &self.matrix.rows[r];
        let is_item = row[c].has_item() && !self.without.contains(&row[c].at);
        is_item.then(|| (c + 1..self.end(r, c)).find(|&v| row[v].is_number)).flatten()
    }

    /// Adds the numbers of all rows.
    fn read(&self, sections: &Sections, found: &mut Found) {
        let mut last: Option<At> = None;
        let mut title: Option<At> = None;
        let mut columns: BTreeSet<usize> = BTreeSet::new();
        for (r, row) in self.matrix.rows.iter().enumerate() {
            let items: Vec<usize> =
                (0..row.len()).filter(|&c| self.first_number(r, c).is_some()).collect();
            if items.is_empty() {
                let filled: Vec<usize> =
                    (0..row.len()).filter(|&c| !row[c].cell.is_empty()).collect();
                if let [only] = filled[..] {
                    title = row[only].has_item().then_some((r, only));
                }
                last = last.filter(|&(_, c)| self.goes_on(c, r));
                let of_title = || Some((title?, self.is_tagged_row(r, *filled.first()?)?));
                let of_last = || last.map(|item| (item, item.1));
                if let Some(((item_row, item_column), c)) = of_last().or_else(of_title) {
                    let item_at = self.matrix.rows[item_row][item_column].at;
                    let label =
                        self.matrix.label(item_row, item_column).cloned().unwrap_or_default();
                    let section = sections.of(item_at);
                    let text = self.matrix.rows[item_row][item_column].cell.text();
                    self.read_item((r, c), &Own { label, section, item_at, text }, found);
                }
                continue;
            }
            title = None;
            for c in items {
                let section = sections.of(row[c].at);
                let label = self.matrix.label(r, c).cloned().unwrap_or_default();
                self.read_item(
                    (r, c),
                    &Own { label, section, item_at: row[c].at, text: row[c].cell.text() },
                    found,
                );
                columns.insert(c);
                last = Some((r, c));
            }
        }
        columns.into_iter().for_each(|c| self.note_unread(c, found));
    }

    /// Returns the first column of a row below a title that is an item: it says a direction, a
    /// specimen or a statistic, and numbers follow.
    fn is_tagged_row(&self, r: usize, first: usize) -> Option<usize> {
        let row = &self.matrix.rows[r];
        let is_tagged = row[first].label.as_ref().is_some_and(Label::is_tagged);
        let has_numbers = row[first + 1..].iter().any(|slot| slot.is_number);
        (is_tagged && has_numbers && !self.is_turned).then_some(first)
    }

    /// Returns whether a row without an item goes on with that of the row above: the cell below the
    /// item is empty, and another one before the numbers says what is different.
    fn goes_on(&self, c: usize, r: usize) -> bool {
        let row = &self.matrix.rows[r];
        let Some(first) = (c + 1..row.len()).find(|&v| row[v].is_number) else { return false };
        let is_tagged = |slot: &Slot| slot.label.as_ref().is_some_and(Label::is_tagged);
        row[c].cell.is_empty() && row[..first].iter().any(is_tagged)
    }

    /// Adds the numbers of one item in a row.
    fn read_item(&self, (r, c): At, own: &Own, found: &mut Found) {
        let Own { label: own, section, item_at, text } = own;
        let is_named = &own.is_named;
        let Some(item) = own.item else { return };
        let row = &self.matrix.rows[r];
        let end = self.end(r, c);
        let numbers: Vec<usize> = (c + 1..end).filter(|&v| row[v].is_number).collect();
        let Some(&first) = numbers.first() else { return };
        // What stands before the numbers, and a unit behind them.
        let before = (0..c).rev().find(|&l| row[l].has_item());
        let start = before
            .map_or(0, |item| (item..c).rev().find(|&l| row[l].is_number).unwrap_or(item) + 1);
        let mut common = Label { name: String::new(), ..own.clone() };
        // Below a title the cell of the item says what the row is of.
        let below_title = row[c].label.as_ref().filter(|label| label.item.is_none());
        common =
            common.or(&Label { name: String::new(), ..below_title.cloned().unwrap_or_default() });
        for l in (start..c).chain(c + 1..first) {
            let Some(label) = row[l].label.as_ref() else { continue };
            let mut label = label.clone();
            if label.unit.is_none() && !label.is_tagged() && self.is_column_of_units(l, c) {
                let text = std::mem::take(&mut label.name);
                label.unit =
                    Some(WrittenUnit { text, is_known: false }).filter(|u| !u.text.is_empty());
            }
            common = common.or(&Label { name: String::new(), ..label });
        }
        let unit_at = |l: usize| {
            row[l]
                .label
                .as_ref()
                .filter(|label| label.is_unit())
                .and_then(|label| label.unit.clone())
        };
        // A unit behind the first number is of that number, and of those before the next unit.
        let is_before = common.unit.is_some();
        let own_unit = |v: usize| {
            let behind = || (v + 1..end).find_map(unit_at);
            let before = (first + 1..v).rev().find_map(unit_at);
            if is_before { before } else { behind().or(before) }
        };
        let last = numbers.last().map_or(end, |last| last + 1);
        let heads = Heads::above(self.matrix, (r, c), last);
        let mut leading = heads.leading(start, r);
        // Columns of numbers of specimens are no values.
        for &v in &numbers {
            if heads.at(v).label.axis == Some(Axis::Specimen) && numbers.len() > 1 {
                leading.specimen = row[v].cell.text().parse().ok();
            }
        }
        let common = common.or(&leading);
        let is_count = |v: &&usize| heads.at(**v).label.statistic == Some(Statistic::Count);
        let count = numbers.iter().find(is_count).and_then(|&v| row[v].cell.text().parse().ok());
        for (place, &v) in numbers.iter().enumerate() {
            let mut head = heads.at(v);
            head.label.cut = head.label.cut.or_else(|| cut_beside(&heads, &numbers, place));
            let is_number_of_specimen =
                head.label.axis == Some(Axis::Specimen) && numbers.len() > 1;
            if is_number_of_specimen || head.label.statistic == Some(Statistic::Count) {
                continue;
            }
            let sign = row[v - 1].label.as_ref().filter(|_| v > first);
            let sign = sign.and_then(|label| label.statistic);
            let unit = own_unit(v).or_else(|| common.unit.clone());
            let label = Label { unit, ..common.clone() }.or(&head.label).or(section);
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
                item_at: *item_at,
                item_text: text.clone(),
                is_named: *is_named,
            });
        }
    }

    /// Returns whether a column has the units of the items of another.
    fn is_column_of_units(&self, column: usize, items: usize) -> bool {
        let of_units = |row: &Vec<Slot>| {
            let Some(label) = row[column].label.as_ref() else { return false };
            row[items].has_item() && label.is_unit() || label.axis == Some(Axis::Unit)
        };
        self.matrix.rows.iter().any(of_units)
    }

    /// Notes what stands in the table of a column of items and is not read: rows of other items,
    /// and cells that hold no number.
    fn note_unread(&self, c: usize, found: &mut Found) {
        let items: Vec<usize> =
            (0..self.matrix.rows.len()).filter(|&r| self.first_number(r, c).is_some()).collect();
        let (Some(&top), Some(&bottom)) = (items.first(), items.last()) else { return };
        let is_value = |v: &usize| items.iter().any(|&r| self.matrix.rows[r][*v].is_number);
        let values: Vec<usize> = (c + 1..self.matrix.width()).filter(is_value).collect();
        let mut others: Vec<String> = Vec::new();
        for r in top..=(bottom + 1).min(self.matrix.rows.len() - 1) {
            let row = &self.matrix.rows[r];
            let label = row[c].label.as_ref();
            let has_number = values.iter().any(|&v| row[v].is_number);
            match label {
                Some(label) if label.item.is_some() => {
                    let end = self.end(r, c);
                    let own = values.iter().filter(|v| **v < end).map(|&v| &row[v]);
                    let odd = own.filter(|slot| is_odd(slot));
                    found.notes.extend(odd.map(|slot| {
                        let (line, text) = (slot.line, slot.cell.text());
                        let symbol = label.item.map(Item::symbol).unwrap_or_default();
                        format!("line {line}: \"{text}\" is no number, so that {symbol} is not read there{}", of_date(&text))
                    }));
                }
                Some(label) if has_number && !label.name.is_empty() => {
                    others.push(format!("\"{}\" (line {})", row[c].cell.text(), row[c].line));
                }
                _ => {}
            }
        }
        let symbols: BTreeSet<Option<Item>> =
            items.iter().map(|&r| self.matrix.label(r, c).and_then(|label| label.item)).collect();
        // Beside a thickness alone stand the other sizes of specimens.
        let is_of_sizes = symbols.iter().all(|symbol| *symbol == Some(Item::Key("T")));
        if !others.is_empty() && !is_of_sizes {
            let rest = others.len().saturating_sub(NAMES_MAX);
            others.truncate(NAMES_MAX);
            let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            found.notes.push(format!(
                "left out, since it is no value of KES, FAST or a cantilever: {}{more}",
                others.join(", ")
            ));
        }
    }
}

/// Returns the direction of a column of deviations that names none: that of the column before it,
/// where each direction of the row has such a column.
fn cut_beside(heads: &Heads<'_>, numbers: &[usize], place: usize) -> Option<Cut> {
    let all: Vec<Label> = numbers.iter().map(|&v| heads.at(v).label).collect();
    let is_deviation = |label: &Label| {
        use Statistic::{Deviation, Error, Variation};
        label.cut.is_none() && matches!(label.statistic, Some(Deviation | Variation | Error))
    };
    let same = |label: &&Label| is_deviation(label) && label.statistic == all[place].statistic;
    let directions: BTreeSet<Cut> = all.iter().filter_map(|label| label.cut).collect();
    let is_one_each = all.iter().filter(same).count() == directions.len();
    let before = || all[..place].iter().rev().find_map(|label| label.cut);
    (is_deviation(&all[place]) && is_one_each).then(before).flatten()
}

/// Names of other items in a note, at most.
const NAMES_MAX: usize = 6;

/// Item with the titles above its table.
struct Own {
    label: Label,
    section: Label,
    item_at: At,
    /// Text of its cell.
    text: String,
}

/// Titles of tables below each other that name a direction or a fabric, each with its row.
struct Sections(Vec<(usize, Label)>);

impl Sections {
    /// Finds the titles: rows of one cell, or of a word for fabrics and a name.
    fn of_matrix(matrix: &Matrix) -> Self {
        let section = |(r, row): (usize, &Vec<Slot>)| {
            let filled: Vec<&Slot> = row.iter().filter(|slot| !slot.cell.is_empty()).collect();
            let label = |slot: &Slot| slot.label.clone().filter(|label| label.item.is_none());
            let section = match filled[..] {
                [one] => {
                    let label = label(one)?;
                    let first = label.name.split([' ', ':']).next().unwrap_or_default();
                    let axis = Label::parse(first).axis.filter(|axis| *axis != Axis::Specimen);
                    let name = axis.and_then(|_| label.name.split_once([' ', ':']));
                    let name = name.map_or(String::new(), |(_, name)| {
                        name.trim_matches([' ', ':']).to_owned()
                    });
                    let cut = label.cut.filter(|_| label.name.is_empty());
                    Label { cut, name, axis, ..Label::default() }
                }
                [key, name] => {
                    let axis = label(key)?.axis.filter(|axis| *axis != Axis::Specimen)?;
                    Label { name: name.cell.text(), axis: Some(axis), ..Label::default() }
                }
                _ => return None,
            };
            (section.cut.is_some() || !section.name.is_empty()).then_some((r, section))
        };
        Self(matrix.rows.iter().enumerate().filter_map(section).collect())
    }

    /// Returns what the titles above a cell say, the nearest first.
    fn of(&self, (row, _): At) -> Label {
        let above = self.0.iter().rev().filter(|(r, _)| *r < row);
        above.fold(Label::default(), |label, (_, section)| {
            let axis = label.axis.or(section.axis);
            Label { axis, ..label.or(section) }
        })
    }
}

/// Returns whether a cell among numbers holds a text that says something and is no number.
fn is_odd(slot: &Slot) -> bool {
    const NOTHING: [&str; 14] =
        ["-", "–", "—", "/", "n.d.", "n.a.", "na", "n/a", "nd", "none", "*", "k.a.", "なし", "无"];
    let text = slot.cell.text().to_lowercase();
    let is_said = !text.is_empty() && !NOTHING.contains(&text.as_str());
    is_said && slot.label.as_ref().is_some_and(|label| !label.is_unit() && !label.is_tagged())
}

/// Returns the reason of a cell that holds a date.
fn of_date(text: &str) -> &'static str {
    let parts: Vec<&str> = text.split('-').collect();
    let is_date = matches!(parts[..], [year, month, day] if year.len() == 4
        && month.len() == 2 && day.len() == 2 && parts.iter().all(|part| part.parse::<u32>().is_ok()));
    if is_date { ": the spreadsheet has made a date of it" } else { "" }
}
