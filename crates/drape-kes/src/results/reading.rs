//! Entry of a table as a number in a unit, with direction, specimen and fabric.

use std::collections::BTreeSet;

use drape_input::{Quantity, Unit, parse_unit};

use crate::results::item::Item;
use crate::results::label::{Cut, Face, HeadKind, Statistic};
use crate::results::number::{self, CellNumber, CellScatter};
use crate::results::table::{Entry, TableEntries};
use crate::test::Direction;

/// Number of one item.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    pub(crate) item: Item,
    pub(crate) cut: Option<Cut>,
    pub(crate) specimen: Option<u32>,
    pub(crate) statistic: Option<Statistic>,
    pub(crate) face: Option<Face>,
    /// Name over the number; empty if there is none.
    pub(crate) name: String,
    pub(crate) axis: Option<HeadKind>,
    /// Number in `unit`, or a number without unit.
    pub(crate) number: f64,
    /// Standard deviation in the cell, in the unit of `number`.
    pub(crate) deviation: Option<f64>,
    /// Unit; `None` for a number without unit.
    pub(crate) unit: Option<Unit>,
    pub(crate) line: usize,
    /// Position and text of the cell of the item.
    pub(crate) item_position: (usize, usize),
    pub(crate) item_text: String,
}

impl Reading {
    /// Converts a number in the unit of the reading to `unit`. A number without unit is returned
    /// unchanged.
    pub(crate) fn in_unit(&self, number: f64, unit: Option<Unit>) -> f64 {
        match (self.unit, unit) {
            (Some(from), Some(to)) => number * (from.factor / to.factor),
            _ => number,
        }
    }
}

/// Converts the entries of a `table` to readings, and adds entries that cannot be read to `notes`.
pub(crate) fn readings(table: TableEntries, notes: &mut Vec<String>) -> Vec<Reading> {
    notes.extend(table.notes);
    let mut useful: Vec<Entry> =
        table.entries.into_iter().filter(|entry| entry.item.quantity().is_some()).collect();
    drop_other_extensions(&mut useful, notes);
    resolve_suffixes(&mut useful);
    let decimal = match number::decimal_sign(useful.iter().map(|entry| (entry.line, &entry.cell))) {
        Ok(decimal) => decimal,
        Err(reason) => {
            notes.push(format!("its values are not read: {reason}"));
            return Vec::new();
        }
    };

    let mut readings = Vec::new();
    for entry in useful {
        let Some(cell) = number::parse_cell(&entry.cell, decimal) else {
            let (line, text) = (entry.line, entry.cell.text());
            notes.push(format!("line {line}: \"{text}\" is no number of {}", entry.item.symbol()));
            continue;
        };
        match reading(&entry, cell) {
            Ok((reading, remark)) => {
                notes.extend(remark);
                readings.push(reading);
            }
            Err(reason) => notes.push(reason),
        }
    }
    readings
}

/// Converts an `entry` with the parsed `cell` to a reading and a remark. `Err` holds the reason why
/// the entry has no use.
fn reading(entry: &Entry, cell: CellNumber) -> Result<(Reading, Option<String>), String> {
    let line = entry.line;
    let is_deviation = number::is_deviation(&entry.cell);
    let (item, unit) = item_and_unit(entry, &cell.unit)?;
    let is_percent = item.quantity() == Some(Quantity::Ratio) && !item.is_ratio();
    // The scatter in the cell is a deviation, an error or a variation.
    let (deviation, remark) = match (cell.scatter, entry.statistic) {
        (None, _) => (None, None),
        (Some(CellScatter::Deviation(error)), Some(Statistic::MeanWithError)) => {
            match deviation_of_error(entry, error) {
                Ok(deviation) => (Some(deviation), None),
                Err(reason) => (None, Some(reason)),
            }
        }
        (
            Some(CellScatter::Deviation(d) | CellScatter::Unclear(d)),
            Some(Statistic::MeanWithVariation),
        ) => (Some(percent_of(d, cell.number)), None),
        (Some(CellScatter::Deviation(deviation)), _) => (Some(deviation), None),
        (Some(CellScatter::Percent(percent)), _) => (Some(percent_of(percent, cell.number)), None),
        (Some(CellScatter::PercentOrUnit(percent, true)), _) if is_percent => (Some(percent), None),
        (Some(CellScatter::PercentOrUnit(percent, false)), _) if is_percent => {
            (None, Some(unclear_scatter(percent, cell.number, &item, line)))
        }
        (Some(CellScatter::PercentOrUnit(percent, _)), _) => {
            (Some(percent_of(percent, cell.number)), None)
        }
        (Some(CellScatter::Unclear(deviation)), _) => {
            (None, Some(unclear_scatter(deviation, cell.number, &item, line)))
        }
    };

    // A standard error is converted to a standard deviation.
    let number = if entry.statistic == Some(Statistic::Error) {
        deviation_of_error(entry, cell.number)?
    } else {
        cell.number
    };
    let reading = Reading {
        item,
        cut: entry.cut,
        specimen: entry.specimen,
        statistic: match entry.statistic {
            Some(Statistic::Error) => Some(Statistic::Deviation),
            _ if is_deviation => Some(Statistic::Deviation),
            Some(Statistic::MeanWithVariation | Statistic::MeanWithError) => Some(Statistic::Mean),
            statistic => statistic,
        },
        face: entry.face,
        name: entry.name.clone(),
        axis: entry.axis,
        number,
        deviation: deviation.filter(|deviation| deviation.is_finite() && *deviation > 0.0),
        unit,
        line,
        item_position: entry.item_position,
        item_text: entry.item_text.clone(),
    };
    Ok((reading, remark))
}

/// Returns the given `percent` of the magnitude of `number`.
fn percent_of(percent: f64, number: f64) -> f64 {
    0.01 * percent * number.abs()
}

/// Returns the note on a `scatter` beside the `number` of an `item`, whose meaning is unclear.
fn unclear_scatter(scatter: f64, number: f64, item: &Item, line: usize) -> String {
    let symbol = item.symbol();
    format!(
        "line {line}: {scatter} beside {number} of {symbol} is not taken for a standard deviation, since it may be \
         something else"
    )
}

/// Returns the standard deviation of a standard `error`. `Err` holds the reason if the number of
/// specimens is not known.
fn deviation_of_error(entry: &Entry, error: f64) -> Result<f64, String> {
    let count = entry.count.filter(|count| *count >= 2.0);
    count.map(|count| error * count.sqrt()).ok_or_else(|| {
        let (line, symbol) = (entry.line, entry.item.symbol());
        format!("line {line}: the standard error of {symbol} is not taken, since the number of specimens is not known")
    })
}

/// Returns the item and the unit of `entry`. The unit `cell_unit` in the cell goes before the unit
/// of the label. `Err` holds the reason if the unit does not fit the item.
fn item_and_unit(entry: &Entry, cell_unit: &str) -> Result<(Item, Option<Unit>), String> {
    // Statistics in percent have no unit of the item.
    if matches!(entry.statistic, Some(Statistic::Variation | Statistic::Count | Statistic::Other)) {
        return Ok((entry.item, None));
    }

    let written = entry.unit.as_ref().map(|unit| unit.text.as_str());
    let text = if cell_unit.is_empty() { written.unwrap_or_default() } else { cell_unit };
    let Some(quantity) = entry.item.quantity().filter(|_| !text.is_empty()) else {
        return Ok((entry.item, None));
    };
    if ["-", "–", "—", "/"].contains(&text) && entry.item.is_ratio() {
        return Ok((entry.item, None));
    }
    if let Ok(unit) = parse_unit(text, &[quantity]) {
        return Ok((entry.item, Some(unit)));
    }
    // G is also the symbol of the flexural rigidity of a cantilever.
    let rigidity = [Quantity::BendingRigidity];
    if let (Item::Key("G"), Ok(unit)) = (entry.item, parse_unit(text, &rigidity)) {
        return Ok((Item::Key("B"), Some(unit)));
    }
    let (line, symbol) = (entry.line, entry.item.symbol());
    let known = quantity.spellings().take(4).collect::<Vec<_>>().join(", ");
    Err(format!(
        "line {line}: {symbol} is not taken, since \"{text}\" is no known unit of {}, such as {known}",
        quantity.name()
    ))
}

/// Removes extensions without a symbol, if the table has no other value of the tensile test of KES:
/// they may come from another test, such as a test until the break.
fn drop_other_extensions(entries: &mut Vec<Entry>, notes: &mut Vec<String>) {
    const TENSILE: [Item; 3] = [Item::Key("LT"), Item::Key("WT"), Item::Key("RT")];
    if entries.iter().any(|entry| TENSILE.contains(&entry.item)) {
        return;
    }
    let is_unclear = |entry: &Entry| entry.item == Item::Key("EM") && entry.is_named;
    if let Some(entry) = entries.iter().find(|entry| is_unclear(entry)) {
        notes.push(format!(
            "\"{}\" (line {}) is left out: it may be of another test than that of KES; call it EM where it is not",
            entry.item_text, entry.line
        ));
    }
    entries.retain(|entry| !is_unclear(entry));
}

/// Interprets the digits behind symbols: 1 and 2 are warp and weft, unless the table names
/// directions or has a 3.
fn resolve_suffixes(entries: &mut [Entry]) {
    let digits: BTreeSet<u32> = entries
        .iter()
        .filter(|entry| entry.cut.is_none())
        .filter_map(|entry| entry.suffix)
        .collect();
    let are_directions = digits.iter().all(|digit| [1, 2].contains(digit));
    for entry in entries.iter_mut() {
        let Some(digit) = entry.suffix.take() else { continue };
        if entry.cut.is_some() || !are_directions {
            entry.specimen = entry.specimen.or(Some(digit));
        } else {
            let direction = if digit == 1 { Direction::Warp } else { Direction::Weft };
            entry.cut = Some(Cut::Along(direction));
        }
    }
}
