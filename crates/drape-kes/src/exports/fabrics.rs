//! Parts of a draft by fabric: tables and files that hold values of several fabrics are told apart.

use std::collections::BTreeMap;

use drape_input::Quantity;

use crate::exports::found::OpenDraft;
use crate::exports::parts::{FileValue, Parts};
use crate::results::average::{Averaged, moments, rounded};
use crate::results::item::Item;
use crate::results::sheet_value::Sourced;
use crate::tables::heading::{is_specimen, normal};
use crate::test::Direction;

/// Relative difference of two values from which on they are not of one fabric.
const APART: f64 = 0.1;
/// Relative difference of two values from which on one of them is told.
const TOLD: f64 = 0.006;
/// Values that two tables share at least, where they are told to be of two fabrics.
const SHARED_LEAST: usize = 3;

/// Parts of one fabric.
#[derive(Default)]
pub(crate) struct OfFabric {
    /// Name in the files; `None` where they name none.
    pub(crate) name: Option<String>,
    pub(crate) values: Vec<Sourced>,
    pub(crate) parts: Parts,
}

/// Table of values: a file, and its sheet.
type Table = (String, String);

/// Parts what the files hold by fabric.
pub(crate) fn by_fabric(mut parts: Parts) -> Vec<OfFabric> {
    name_by_table(&mut parts);
    let mut names: Vec<String> = Vec::new();
    for value in &parts.values {
        if let Some(name) = value.fabric.as_ref().filter(|name| !names.contains(name)) {
            names.push(name.clone());
        }
    }
    if names.len() < 2 {
        let values = std::mem::take(&mut parts.values);
        let mut notes = Vec::new();
        let values = joined(values.iter(), &mut notes);
        parts.notes.extend(notes);
        return vec![OfFabric { name: names.pop(), values, parts }];
    }
    names.iter().map(|name| of_name(name, &names, &parts)).collect()
}

/// Returns the parts of one of several fabrics.
fn of_name(name: &str, names: &[String], parts: &Parts) -> OfFabric {
    let is_own = |value: &&FileValue| value.fabric.as_deref().is_none_or(|fabric| fabric == name);
    let mut notes = parts.notes.clone();
    let values = joined(parts.values.iter().filter(is_own), &mut notes);
    let mut own = Parts { notes, unread: parts.unread.clone(), ..Parts::default() };
    let fabric = |texts: &[String]| {
        let texts: Vec<String> = texts.iter().map(|text| format!(" {} ", normal(text))).collect();
        let has = |name: &&String| {
            let word = format!(" {} ", normal(name));
            texts.iter().any(|text| text.contains(&word))
        };
        let named: Vec<&String> = names.iter().filter(has).collect();
        // The longest name: "cotton" is in "cotton twill" too.
        named.into_iter().max_by_key(|name| name.len()).cloned()
    };
    for curve in &parts.curves {
        match fabric(&curve.texts()) {
            Some(fabric) if fabric == name => own.curves.push(curve.clone()),
            Some(_) => {}
            None => own.open.push(OpenDraft {
                draft: curve.clone(),
                reason: format!("the files do not say of which fabric it is: {}", names.join(", ")),
            }),
        }
    }
    let may_be =
        |open: &&OpenDraft| fabric(&open.draft.texts()).is_none_or(|fabric| fabric == name);
    own.open.extend(parts.open.iter().filter(may_be).cloned());
    own.bias.extend(parts.bias.iter().filter(may_be).cloned());
    OfFabric { name: Some(name.to_owned()), values, parts: own }
}

/// Joins the values of several tables of one fabric. Tables of one specimen each are averaged; of
/// values that differ otherwise the first is taken, which is noted.
fn joined<'v>(
    values: impl Iterator<Item = &'v FileValue>,
    notes: &mut Vec<String>,
) -> Vec<Sourced> {
    let mut groups: Vec<Vec<&FileValue>> = Vec::new();
    for value in values {
        let key = |value: &FileValue| (value.value.item, value.value.direction);
        match groups.iter_mut().find(|group| key(group[0]) == key(value)) {
            Some(group) => group.push(value),
            None => groups.push(vec![value]),
        }
    }
    groups.into_iter().map(|group| of_group(&group, notes)).collect()
}

/// Joins the values of one item and direction.
fn of_group(group: &[&FileValue], notes: &mut Vec<String>) -> Sourced {
    let of_specimen = |value: &&FileValue| is_specimen(&label(&value.table));
    if group.len() > 1 && group.iter().all(of_specimen) {
        return mean(group);
    }
    let mut taken = group[0];
    for other in &group[1..] {
        if (si(&taken.value) / si(&other.value) - 1.0).abs() < TOLD {
            // Specimens tell more than their mean.
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
    Sourced { value: taken.value.clone(), source: taken.source() }
}

/// Returns the mean of the values of tables of one specimen each.
fn mean(group: &[&FileValue]) -> Sourced {
    let first = &group[0].value;
    let factor = si(first) / first.number;
    let numbers: Vec<f64> = group.iter().map(|value| si(&value.value) / factor).collect();
    let (mean, deviation) = moments(&numbers);
    let value = Averaged {
        number: rounded(mean, 7),
        deviation: deviation.filter(|d| *d > 0.0).map(|d| rounded(d, 4)),
        remark: format!("mean of {} specimens, a table each", group.len()),
        ..first.clone()
    };
    let (first, last) = (group[0].source(), group[group.len() - 1].source());
    Sourced { value, source: format!("{first} to {last}") }
}

/// Returns the name of a table: of its sheet, or of its file.
fn label((file, sheet): &Table) -> String {
    let stem = file.rsplit('/').next().unwrap_or(file);
    let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
    if sheet.is_empty() { stem.to_owned() } else { sheet.clone() }
}

/// Returns a number in SI; a bare one in the unit of a laboratory.
fn si(value: &Averaged) -> f64 {
    let bare = || match value.item.quantity() {
        Some(quantity) if !(quantity == Quantity::Ratio && value.item.is_bare_ratio()) => {
            value.number * quantity.laboratory().factor
        }
        _ => value.number,
    };
    value.si().unwrap_or_else(bare)
}

/// Names values by their tables, where tables without a name hold values that cannot be of one
/// fabric.
fn name_by_table(parts: &mut Parts) {
    if parts.values.iter().any(|value| value.fabric.is_some()) {
        return;
    }
    let mut tables: Vec<Table> = Vec::new();
    for value in &parts.values {
        if !tables.contains(&value.table) {
            tables.push(value.table.clone());
        }
    }
    let values = |table: &Table| -> BTreeMap<(Item, Option<Direction>), f64> {
        let own = parts.values.iter().filter(|value| value.table == *table);
        own.map(|value| ((value.value.item, value.value.direction), si(&value.value))).collect()
    };
    let all: Vec<_> = tables.iter().map(values).collect();
    let differ = |a: usize, b: usize| {
        let shared = all[a].iter().filter_map(|(key, number)| Some((number, all[b].get(key)?)));
        let ratios: Vec<f64> = shared.map(|(one, other)| (one / other - 1.0).abs()).collect();
        let apart = ratios.iter().filter(|ratio| **ratio > APART).count();
        ratios.len() >= SHARED_LEAST && 2 * apart > ratios.len()
    };
    let is_apart = |a: usize| (0..tables.len()).any(|b| a != b && differ(a, b));
    let apart: Vec<&Table> =
        (0..tables.len()).filter(|&a| is_apart(a)).map(|a| &tables[a]).collect();
    if apart.is_empty() {
        return;
    }
    let mut names: Vec<String> = Vec::new();
    for table in apart {
        // Sheets of one name in several files are told apart by the files.
        let name = label(table);
        let file = label(&(table.0.clone(), String::new()));
        let name = if names.contains(&name) { format!("{file} {name}") } else { name };
        let own = parts.values.iter_mut().filter(|value| value.table == *table);
        own.for_each(|value| value.fabric = Some(name.clone()));
        names.push(name);
    }
    let names = names.join(", ");
    parts
        .notes
        .push(format!("ASSUMED: {names} are several fabrics, since most of their values differ"));
}
