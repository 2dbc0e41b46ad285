//! Entry of a table as a number in a unit, with its direction, its specimen and its fabric.

use std::collections::BTreeSet;

use drape_input::{Quantity, Unit, parse_unit};

use crate::results::item::Item;
use crate::results::label::{Axis, Cut, Face, Statistic};
use crate::results::number::{self, CellNumber, Scatter};
use crate::results::table::{Entry, Found};
use crate::test::Direction;

/// Number of one item.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    pub(crate) item: Item,
    pub(crate) cut: Option<Cut>,
    pub(crate) specimen: Option<u32>,
    pub(crate) statistic: Option<Statistic>,
    pub(crate) face: Option<Face>,
    /// Name over the number; empty where there is none.
    pub(crate) name: String,
    pub(crate) axis: Option<Axis>,
    /// Number, in the unit, or bare.
    pub(crate) number: f64,
    /// Standard deviation that the cell gives, as the number.
    pub(crate) deviation: Option<f64>,
    /// Unit; `None` for a bare number.
    pub(crate) unit: Option<Unit>,
    pub(crate) line: usize,
    /// Place of the cell of the item, and its text.
    pub(crate) item_at: (usize, usize),
    pub(crate) item_text: String,
}

/// Makes the entries of a sheet into readings; adds what cannot be read to the notes.
pub(crate) fn readings(found: Found, notes: &mut Vec<String>) -> Vec<Reading> {
    notes.extend(found.notes);
    let is_useful = |entry: &Entry| entry.item.quantity().is_some();
    let mut useful: Vec<Entry> = found.entries.into_iter().filter(is_useful).collect();
    drop_other_extensions(&mut useful, notes);
    resolve_suffixes(&mut useful);
    let decimal = match number::decimal(useful.iter().map(|entry| (entry.line, &entry.cell))) {
        Ok(decimal) => decimal,
        Err(reason) => {
            notes.push(format!("its values are not read: {reason}"));
            return Vec::new();
        }
    };
    let mut readings = Vec::new();
    for entry in useful {
        let Some(cell) = number::of_cell(&entry.cell, decimal) else {
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

/// Makes an entry into a reading; `Err` holds why it has no use.
fn reading(entry: &Entry, cell: CellNumber) -> Result<(Reading, Option<String>), String> {
    let line = entry.line;
    let is_deviation = number::is_deviation(&entry.cell);
    let (item, unit) = unit(entry, &cell.unit)?;
    let is_percent = item.quantity() == Some(Quantity::Ratio) && !item.is_bare_ratio();
    let relative = |percent: f64| Some(0.01 * percent * cell.number.abs());
    let unclear = |deviation: f64| {
        let symbol = item.symbol();
        Some(format!(
            "line {line}: {deviation} beside {} of {symbol} is not taken for a standard deviation, since it may be \
             something else",
            cell.number
        ))
    };
    let (deviation, remark) = match (cell.scatter, entry.statistic) {
        (None, _) => (None, None),
        (Some(Scatter::Deviation(error)), Some(Statistic::MeanWithError)) => {
            match of_error(entry, error) {
                Ok(deviation) => (Some(deviation), None),
                Err(reason) => (None, Some(reason)),
            }
        }
        (Some(Scatter::Deviation(d) | Scatter::Unclear(d)), Some(Statistic::MeanWithVariation)) => {
            (relative(d), None)
        }
        (Some(Scatter::Deviation(deviation)), _) => (Some(deviation), None),
        (Some(Scatter::Percent(percent)), _) => (relative(percent), None),
        (Some(Scatter::PercentOrUnit(percent, true)), _) if is_percent => (Some(percent), None),
        (Some(Scatter::PercentOrUnit(percent, false)), _) if is_percent => (None, unclear(percent)),
        (Some(Scatter::PercentOrUnit(percent, _)), _) => (relative(percent), None),
        (Some(Scatter::Unclear(deviation)), _) => (None, unclear(deviation)),
    };
    let of_error =
        (entry.statistic == Some(Statistic::Error)).then(|| of_error(entry, cell.number));
    let number = of_error.transpose()?.unwrap_or(cell.number);
    let reading = Reading {
        item,
        cut: entry.cut,
        specimen: entry.specimen,
        statistic: match entry.statistic {
            Some(Statistic::Error) => Some(Statistic::Deviation),
            _ if is_deviation => Some(Statistic::Deviation),
            Some(Statistic::MeanWithVariation | Statistic::MeanWithError) => Some(Statistic::Mean),
            other => other,
        },
        face: entry.face,
        name: entry.name.clone(),
        axis: entry.axis,
        number,
        deviation: deviation.filter(|deviation| deviation.is_finite() && *deviation > 0.0),
        unit,
        line,
        item_at: entry.item_at,
        item_text: entry.item_text.clone(),
    };
    Ok((reading, remark))
}

/// Returns the standard deviation of a standard error; `Err` where the number of specimens is not
/// known.
fn of_error(entry: &Entry, error: f64) -> Result<f64, String> {
    let count = entry.count.filter(|count| *count >= 2.0);
    count.map(|count| error * count.sqrt()).ok_or_else(|| {
        let (line, symbol) = (entry.line, entry.item.symbol());
        format!("line {line}: the standard error of {symbol} is not taken, since the number of specimens is not known")
    })
}

/// Returns the item and the unit of an entry; `Err` holds why the unit is not one of the item.
fn unit(entry: &Entry, of_cell: &str) -> Result<(Item, Option<Unit>), String> {
    // Statistics in percent have no unit of the item.
    if matches!(entry.statistic, Some(Statistic::Variation | Statistic::Count | Statistic::Other)) {
        return Ok((entry.item, None));
    }
    let written = entry.unit.as_ref().map(|unit| unit.text.as_str());
    let text = if of_cell.is_empty() { written.unwrap_or_default() } else { of_cell };
    let Some(quantity) = entry.item.quantity().filter(|_| !text.is_empty()) else {
        return Ok((entry.item, None));
    };
    if ["-", "–", "—", "/"].contains(&text) && entry.item.is_bare_ratio() {
        return Ok((entry.item, None));
    }
    if let Ok(unit) = parse_unit(text, &[quantity]) {
        return Ok((entry.item, Some(unit)));
    }
    // G is the symbol of the flexural rigidity of a cantilever too.
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

/// Leaves out extensions without a symbol where nothing else is of the tensile test of KES: they
/// may be those of another test, such as at break.
fn drop_other_extensions(entries: &mut Vec<Entry>, notes: &mut Vec<String>) {
    const TENSILE: [Item; 3] = [Item::Key("LT"), Item::Key("WT"), Item::Key("RT")];
    if entries.iter().any(|entry| TENSILE.contains(&entry.item)) {
        return;
    }
    let is_open = |entry: &Entry| entry.item == Item::Key("EM") && entry.is_named;
    if let Some(entry) = entries.iter().find(|entry| is_open(entry)) {
        notes.push(format!(
            "\"{}\" (line {}) is left out: it may be of another test than that of KES; call it EM where it is not",
            entry.item_text, entry.line
        ));
    }
    entries.retain(|entry| !is_open(entry));
}

/// Gives the digits behind symbols their meaning: 1 and 2 are warp and weft, unless the table names
/// directions or has a 3.
fn resolve_suffixes(entries: &mut [Entry]) {
    let open = |entry: &&Entry| entry.cut.is_none() && entry.suffix.is_some();
    let digits: BTreeSet<u32> =
        entries.iter().filter(open).filter_map(|entry| entry.suffix).collect();
    let are_directions = digits.iter().all(|digit| [1, 2].contains(digit));
    for entry in entries.iter_mut() {
        let Some(digit) = entry.suffix.take() else { continue };
        match (entry.cut, are_directions, digit) {
            (None, true, 1) => entry.cut = Some(Cut::Along(Direction::Warp)),
            (None, true, _) => entry.cut = Some(Cut::Along(Direction::Weft)),
            _ => entry.specimen = entry.specimen.or(Some(digit)),
        }
    }
}
