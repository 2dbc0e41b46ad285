//! KES values in tables of results: symbols with numbers, in rows or in columns.

use crate::sheets::spelling;
use crate::tables::block::unbracketed;
use crate::tables::grid::{Cell, Grid, Row};
use crate::tables::heading::{self, Heading, normal};
use crate::tables::number::{Decimal, Evidence};
use crate::test::Direction;

/// Value found in a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FoundValue {
    pub(crate) key: &'static str,
    pub(crate) direction: Option<Direction>,
    pub(crate) number: f64,
    pub(crate) unit: Option<String>,
    pub(crate) line: usize,
}

/// Column of numbers of a table of rows: a direction, or both.
type ColumnOf = Option<Direction>;

/// Returns the values of a grid; a symbol is never one where curves are.
pub(crate) fn values(grid: &Grid, direction: Option<Direction>) -> Vec<FoundValue> {
    let decimal = decimal(grid);
    let mut found = Vec::new();
    for (index, row) in grid.rows.iter().enumerate() {
        let above = grid.rows[..index].last();
        found.extend(of_row(row, above, &Given { decimal, direction, rows: &grid.rows[..index] }));
        found.extend(below(row, &grid.rows[index + 1..], &Given { decimal, direction, rows: &[] }));
    }
    found
}

/// What is known of a table: its decimal sign, the direction of its sheet, the rows above.
struct Given<'a> {
    decimal: Decimal,
    direction: Option<Direction>,
    rows: &'a [Row],
}

fn decimal(grid: &Grid) -> Decimal {
    let cells = || grid.rows.iter().flat_map(|row| &row.cells);
    let shows = |sign| cells().any(|cell| cell.evidence() == Some(Evidence::Of(sign)));
    if shows(Decimal::Comma) && !shows(Decimal::Point) { Decimal::Comma } else { Decimal::Point }
}

/// Returns the symbol of a cell such as `B (gf.cm2/cm)` or `2HG5-warp`.
fn symbol(cell: &Cell) -> Option<(spelling::Spelt, Option<String>)> {
    let Cell::Text(text) = cell else { return None };
    if text.chars().count() > 40 {
        return None;
    }
    let (text, behind) = split_direction(text);
    let bracket = text.find(['(', '[', '（', '［']);
    let (name, unit) = match bracket {
        Some(place) if place > 0 => {
            (text[..place].trim(), Some(unbracketed(&text[place..]).to_owned()))
        }
        _ => {
            let heading = Heading::parse(text);
            return spelling::value(&heading.name).map(|spelt| (spelt, heading.unit));
        }
    };
    let spelt = spelling::value(name)?;
    let spelt = spelling::Spelt { direction: behind.or(spelt.direction), ..spelt };
    // "B (warp)" names a direction where others name a unit.
    match unit.as_deref().and_then(spelling::direction) {
        Some(direction) => Some((spelling::Spelt { direction: Some(direction), ..spelt }, None)),
        None => Some((spelt, unit.filter(|unit| !unit.is_empty() && unit != "-"))),
    }
}

/// Splits a text such as `B (gf.cm2/cm) warp` before the direction behind its bracket.
fn split_direction(text: &str) -> (&str, Option<Direction>) {
    let behind = text.rsplit([')', ']', '）', '］']).next().unwrap_or(text);
    match spelling::direction(behind.trim()) {
        Some(direction) if behind.len() < text.len() => {
            (&text[..text.len() - behind.len()], Some(direction))
        }
        _ => (text, None),
    }
}

/// Returns the values of a row that begins with a symbol: one number, or one below each direction.
fn of_row(row: &Row, above: Option<&Row>, given: &Given<'_>) -> Vec<FoundValue> {
    let Some((_, first)) = row.filled().next() else { return Vec::new() };
    let Some((spelt, unit)) = symbol(first) else { return Vec::new() };
    let number = |(column, cell): (usize, &Cell)| Some((column, cell.number(given.decimal)?));
    let numbers: Vec<(usize, f64)> = row.filled().skip(1).filter_map(number).collect();
    let own = row.filled().skip(1).find(|(_, cell)| !cell.is_number()).map(|(_, cell)| cell.text());
    let unit = unit.or(own).map(|unit| unbracketed(&unit).to_owned());
    let value = |number: f64, direction: ColumnOf| FoundValue {
        key: spelt.key,
        direction: direction.or(spelt.direction).or(given.direction),
        number,
        unit: unit.clone(),
        line: row.line,
    };
    let heads = given.rows.iter().rev().chain(above).find_map(|row| heads(row, &numbers));
    match (numbers.as_slice(), heads) {
        ([], _) => Vec::new(),
        (numbers, Some(heads)) => numbers
            .iter()
            .filter_map(|(column, number)| heads(*column).map(|of| value(*number, of)))
            .collect(),
        ([(_, number)], None) => vec![value(*number, None)],
        _ => Vec::new(),
    }
}

/// Returns what a row of titles says of each column; `None` where it is no such row.
fn heads(
    row: &Row,
    numbers: &[(usize, f64)],
) -> Option<impl Fn(usize) -> Option<ColumnOf> + use<>> {
    let of = |cell: &Cell| {
        let text = normal(&cell.text());
        let named = heading::directions(&text);
        let named = named.first().copied().or_else(|| spelling::direction(&text));
        match named {
            Some(direction) => Some(Some(direction)),
            None if ["mean", "average", "ave", "平均"].contains(&text.as_str()) => Some(None),
            None => None,
        }
    };
    let cells: Vec<(usize, ColumnOf)> =
        row.filled().filter_map(|(column, cell)| Some((column, of(cell)?))).collect();
    let directed = cells.iter().filter(|(_, of)| of.is_some()).count();
    let over = cells.iter().all(|(column, _)| numbers.iter().any(|(other, _)| other == column));
    // A mean beside both directions says nothing new.
    let both = directed >= 2;
    (directed > 0 && over && row.numbers() == 0).then_some(move |column: usize| {
        let found = cells.iter().find(|(other, _)| *other == column).map(|(_, of)| *of)?;
        (found.is_some() || !both).then_some(found)
    })
}

/// Returns the values below a row of symbols: rows of a direction, the mean of several, or one row.
fn below(head: &Row, rows: &[Row], given: &Given<'_>) -> Vec<FoundValue> {
    let symbols: Vec<(usize, (spelling::Spelt, Option<String>))> =
        head.filled().filter_map(|(column, cell)| Some((column, symbol(cell)?))).collect();
    if symbols.len() < 2 || head.numbers() > 0 {
        return Vec::new();
    }
    let (units, rows) = match rows.split_first() {
        Some((first, rest)) if first.numbers() == 0 => (Some(first), rest),
        _ => (None, rows),
    };
    let rows: Vec<&Row> = rows.iter().take_while(|row| row.numbers() > 0).collect();
    let label = |row: &Row| {
        let texts = row.filled().filter(|(_, cell)| !cell.is_number());
        normal(&texts.map(|(_, cell)| cell.text()).collect::<Vec<_>>().join(" "))
    };
    let is_mean = |row: &&&Row| {
        ["mean", "average", "ave", "mittelwert", "moyenne", "平均"]
            .iter()
            .any(|word| label(row).contains(word))
    };
    let of_label = |row: &Row| {
        let label = label(row);
        let named = heading::directions(&label).first().copied();
        named.or_else(|| label.split(' ').find_map(spelling::direction))
    };
    let means: Vec<&&Row> = rows.iter().filter(is_mean).collect();
    let mut directed: Vec<Option<Direction>> = rows.iter().map(|row| of_label(row)).collect();
    directed.sort();
    directed.dedup();
    let taken: Vec<&Row> = if !means.is_empty() {
        means.into_iter().copied().collect()
    } else if rows.len() == 1 || (directed.len() == rows.len() && !directed.contains(&None)) {
        rows
    } else {
        Vec::new()
    };
    let mut found = Vec::new();
    for row in taken {
        let direction = of_label(row).or(given.direction);
        for (column, (spelt, unit)) in &symbols {
            let number = row.cells.get(*column).and_then(|cell| cell.number(given.decimal));
            let Some(number) = number else { continue };
            let own = units.and_then(|units| units.cells.get(*column)).map(Cell::text);
            let own = own.map(|unit| unbracketed(&unit).to_owned());
            let own = own.filter(|text| !text.is_empty() && text != "-");
            found.push(FoundValue {
                key: spelt.key,
                direction: spelt.direction.or(direction),
                number,
                unit: unit.clone().or(own),
                line: row.line,
            });
        }
    }
    found
}
