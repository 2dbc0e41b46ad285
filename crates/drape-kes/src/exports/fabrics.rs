//! Contents of a draft by fabric: values of several fabrics in tables and files are separated.

use std::collections::BTreeMap;

use drape_input::{Quantity, round_digits};

use crate::exports::contents::{FileContents, FileValue};
use crate::exports::file_curves::OpenDraft;
use crate::results::average::{AveragedValue, moments};
use crate::results::item::Item;
use crate::results::sheet_value::SourcedValue;
use crate::tables::heading::{is_specimen, normal};
use crate::test::Direction;

/// Relative difference of two values above which the values are of different fabrics.
const APART: f64 = 0.1;
/// Relative difference of two values above which a note names the value that is not taken.
const NOTED: f64 = 0.006;
/// Least number of items that two tables of different fabrics share.
const SHARED_LEAST: usize = 3;

/// Contents of one fabric.
#[derive(Default)]
pub(crate) struct FabricContents {
    /// Name of the fabric in the files; `None` if the files name none.
    pub(crate) name: Option<String>,
    pub(crate) values: Vec<SourcedValue>,
    pub(crate) contents: FileContents,
}

/// Table of values: the name of its file and of its sheet.
type Table = (String, String);

/// Separates the contents of the files by fabric.
pub(crate) fn by_fabric(mut contents: FileContents) -> Vec<FabricContents> {
    name_by_table(&mut contents);
    let mut names: Vec<String> = Vec::new();
    for value in &contents.values {
        if let Some(name) = value.fabric.as_ref().filter(|name| !names.contains(name)) {
            names.push(name.clone());
        }
    }
    if names.len() < 2 {
        let values = std::mem::take(&mut contents.values);
        let mut notes = Vec::new();
        let values = join_values(values.iter(), &mut notes);
        contents.notes.extend(notes);
        return vec![FabricContents { name: names.pop(), values, contents }];
    }
    names.iter().map(|name| contents_of(name, &names, &contents)).collect()
}

/// Returns the part of `contents` that belongs to the fabric `name` among `names`.
fn contents_of(name: &str, names: &[String], contents: &FileContents) -> FabricContents {
    let mut notes = contents.notes.clone();
    let values = contents
        .values
        .iter()
        .filter(|value| value.fabric.as_deref().is_none_or(|fabric| fabric == name));
    let values = join_values(values, &mut notes);
    let mut of_fabric =
        FileContents { notes, unread: contents.unread.clone(), ..FileContents::default() };
    for curve in &contents.curves {
        match fabric_in(&curve.texts(), names) {
            Some(fabric) if fabric == name => of_fabric.curves.push(curve.clone()),
            Some(_) => {}
            None => of_fabric.open.push(OpenDraft {
                draft: curve.clone(),
                reason: format!("the files do not say of which fabric it is: {}", names.join(", ")),
            }),
        }
    }
    for (drafts, kept) in
        [(&contents.open, &mut of_fabric.open), (&contents.bias, &mut of_fabric.bias)]
    {
        let may_be_of_fabric = |open: &&OpenDraft| {
            fabric_in(&open.draft.texts(), names).is_none_or(|fabric| fabric == name)
        };
        kept.extend(drafts.iter().filter(may_be_of_fabric).cloned());
    }
    FabricContents { name: Some(name.to_owned()), values, contents: of_fabric }
}

/// Returns the one of `names` that `texts` contain.
fn fabric_in<'n>(texts: &[String], names: &'n [String]) -> Option<&'n String> {
    let texts: Vec<String> = texts.iter().map(|text| format!(" {} ", normal(text))).collect();
    let named = names.iter().filter(|name| {
        let word = format!(" {} ", normal(name));
        texts.iter().any(|text| text.contains(&word))
    });
    // The longest name wins: "cotton" is in "cotton twill" too.
    named.max_by_key(|name| name.len())
}

/// Joins the values of several tables of one fabric. Tables of one specimen each are averaged. Of
/// other values that differ the first is taken, and a note is added.
fn join_values<'v>(
    values: impl Iterator<Item = &'v FileValue>,
    notes: &mut Vec<String>,
) -> Vec<SourcedValue> {
    let mut groups: Vec<Vec<&FileValue>> = Vec::new();
    for value in values {
        let key = (value.value.item, value.value.direction);
        let group =
            groups.iter_mut().find(|group| (group[0].value.item, group[0].value.direction) == key);
        match group {
            Some(group) => group.push(value),
            None => groups.push(vec![value]),
        }
    }
    groups.into_iter().map(|group| join_group(&group, notes)).collect()
}

/// Joins the values of one item and direction.
fn join_group(group: &[&FileValue], notes: &mut Vec<String>) -> SourcedValue {
    let are_specimens = group.iter().all(|value| is_specimen(&table_name(&value.table)));
    if group.len() > 1 && are_specimens {
        return mean(group);
    }
    let mut taken = group[0];
    for other in &group[1..] {
        if (si(&taken.value) / si(&other.value) - 1.0).abs() < NOTED {
            // A value with a standard deviation tells more.
            if taken.value.deviation.is_none() && other.value.deviation.is_some() {
                taken = other;
            }
            continue;
        }

        let direction =
            taken.value.direction.map_or(String::new(), |d| format!(" of the {}", d.name()));
        notes.push(format!(
            "{}{direction} is there twice; {} is taken, {} is not",
            taken.value.item.symbol(),
            taken.source(),
            other.source()
        ));
    }
    SourcedValue { value: taken.value.clone(), source: taken.source() }
}

/// Returns the mean of the values in `group`, whose tables hold one specimen each.
fn mean(group: &[&FileValue]) -> SourcedValue {
    let first = &group[0].value;
    let factor = si(first) / first.number;
    let numbers: Vec<f64> = group.iter().map(|value| si(&value.value) / factor).collect();
    let (mean, deviation) = moments(&numbers);
    let value = AveragedValue {
        number: round_digits(mean, 7),
        deviation: deviation.filter(|d| *d > 0.0).map(|d| round_digits(d, 4)),
        remark: format!("mean of {} specimens, a table each", group.len()),
        ..first.clone()
    };
    let (first, last) = (group[0].source(), group[group.len() - 1].source());
    SourcedValue { value, source: format!("{first} to {last}") }
}

/// Returns the name of a table: the name of its sheet, or of its file.
fn table_name((file, sheet): &Table) -> String {
    let stem = file.rsplit('/').next().unwrap_or(file);
    let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
    if sheet.is_empty() { stem.to_owned() } else { sheet.clone() }
}

/// Returns the number of `value` in SI. A number without a unit is in the laboratory's unit.
fn si(value: &AveragedValue) -> f64 {
    if let Some(si) = value.si() {
        return si;
    }
    match value.item.quantity() {
        Some(quantity) if !(quantity == Quantity::Ratio && value.item.is_ratio()) => {
            value.number * quantity.laboratory().factor
        }
        _ => value.number,
    }
}

/// Names values by their tables, if tables without a name hold values that cannot be of one fabric.
fn name_by_table(contents: &mut FileContents) {
    if contents.values.iter().any(|value| value.fabric.is_some()) {
        return;
    }
    let mut tables: Vec<Table> = Vec::new();
    for value in &contents.values {
        if !tables.contains(&value.table) {
            tables.push(value.table.clone());
        }
    }

    // A table is of another fabric if most of the values that it shares with a table differ.
    let values: Vec<TableValues> = tables
        .iter()
        .map(|table| {
            let values = contents.values.iter().filter(|value| value.table == *table);
            values
                .map(|value| ((value.value.item, value.value.direction), si(&value.value)))
                .collect()
        })
        .collect();
    let differs = |a: usize| (0..tables.len()).any(|b| a != b && differ(&values[a], &values[b]));
    let apart: Vec<&Table> =
        (0..tables.len()).filter(|&a| differs(a)).map(|a| &tables[a]).collect();
    if apart.is_empty() {
        return;
    }

    let mut names: Vec<String> = Vec::new();
    for table in apart {
        // Sheets of one name in several files are named by the files too.
        let name = table_name(table);
        let file = table_name(&(table.0.clone(), String::new()));
        let name = if names.contains(&name) { format!("{file} {name}") } else { name };
        for value in contents.values.iter_mut().filter(|value| value.table == *table) {
            value.fabric = Some(name.clone());
        }
        names.push(name);
    }
    let names = names.join(", ");
    contents
        .notes
        .push(format!("ASSUMED: {names} are several fabrics, since most of their values differ"));
}

/// Values of a table in SI, by item and direction.
type TableValues = BTreeMap<(Item, Option<Direction>), f64>;

/// Returns whether most of the values that two tables share differ.
fn differ(first: &TableValues, second: &TableValues) -> bool {
    let shared = first.iter().filter_map(|(key, number)| Some((number, second.get(key)?)));
    let ratios: Vec<f64> = shared.map(|(a, b)| (a / b - 1.0).abs()).collect();
    let apart = ratios.iter().filter(|ratio| **ratio > APART).count();
    ratios.len() >= SHARED_LEAST && 2 * apart > ratios.len()
}
