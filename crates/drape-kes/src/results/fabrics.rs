//! Names over numbers: of fabrics, each with values of its own, or of specimens of one fabric.

use std::collections::BTreeMap;

use crate::results::average::moments;
use crate::results::item::Item;
use crate::results::label::letters::half_width;
use crate::results::label::{Axis, Cut, Statistic};
use crate::results::reading::Reading;

/// Largest coefficient of variation of the mass and the thickness of specimens of one fabric.
const ALIKE: f64 = 0.08;
/// Largest median coefficient of variation of all values of specimens of one fabric; mechanical
/// values of one fabric scatter by some 5 to 15 %, those of two fabrics differ by factors.
const ALIKE_MEDIAN: f64 = 0.15;

/// Readings of one fabric.
#[derive(Clone, Debug, Default)]
pub(crate) struct OfFabric {
    /// Name in the table; `None` where it has none.
    pub(crate) name: Option<String>,
    pub(crate) readings: Vec<Reading>,
}

/// Parts the readings of a sheet by fabric; adds what was assumed and what was left out to the
/// notes.
pub(crate) fn by_fabric(mut readings: Vec<Reading>, notes: &mut Vec<String>) -> Vec<OfFabric> {
    drop_odd_columns(&mut readings, notes);
    let names = names(&readings);
    let axis = readings.iter().filter(|reading| !reading.name.is_empty()).find_map(|r| r.axis);
    match names.as_slice() {
        [] => return vec![OfFabric { name: None, readings }],
        [name] => {
            let is_fabric = matches!(axis, Some(Axis::Fabric | Axis::Sample));
            return vec![OfFabric { name: is_fabric.then(|| name.clone()), readings }];
        }
        _ => {}
    }
    // A mean of all names is one of specimens.
    let has_mean = readings.iter().any(|reading| {
        reading.name.is_empty()
            && matches!(reading.statistic, Some(Statistic::Mean | Statistic::Deviation))
    });
    let are_numbered = are_numbered(&names);
    let are_specimens = match axis {
        Some(Axis::Specimen) => true,
        Some(Axis::Fabric) => false,
        _ if has_mean => true,
        _ if are_numbered => {
            let alike = are_alike(&readings);
            let (first, last) = (&names[0], &names[names.len() - 1]);
            notes.push(if alike {
                format!(
                    "ASSUMED: {first} to {last} are specimens of one fabric, since their values agree; write \
                     \"Fabric\" above the names where they are several"
                )
            } else {
                format!(
                    "ASSUMED: {first} to {last} are several fabrics, since their values differ; write \"Specimen\" above \
                     the names where they are specimens of one"
                )
            });
            alike
        }
        _ => false,
    };
    if are_specimens {
        for reading in readings.iter_mut().filter(|reading| !reading.name.is_empty()) {
            let place = names.iter().position(|name| *name == reading.name).unwrap_or(0);
            reading.specimen = reading.specimen.or(Some(place as u32 + 1));
        }
        return vec![OfFabric { name: None, readings }];
    }
    // What has no name is of all of them.
    let of_name = |name: String| {
        let own = |reading: &&Reading| reading.name == name || reading.name.is_empty();
        let readings = readings.iter().filter(own).cloned().collect();
        OfFabric { name: Some(name), readings }
    };
    names.iter().cloned().map(of_name).collect()
}

/// Returns the names over readings, in the order of the table.
fn names(readings: &[Reading]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for reading in readings.iter().filter(|reading| !reading.name.is_empty()) {
        if !names.contains(&reading.name) {
            names.push(reading.name.clone());
        }
    }
    names
}

/// Leaves out columns with a name that is no fabric's, beside others that have a direction or no
/// name: limits, methods.
fn drop_odd_columns(readings: &mut Vec<Reading>, notes: &mut Vec<String>) {
    let plain: Vec<(Item, Option<Cut>)> = readings
        .iter()
        .filter(|reading| reading.name.is_empty() && reading.statistic.is_none())
        .map(|reading| (reading.item, reading.cut))
        .collect();
    let is_odd = |reading: &Reading| {
        let beside = |is: &dyn Fn(Option<Cut>) -> bool| {
            plain.iter().any(|(item, cut)| *item == reading.item && is(*cut))
        };
        let is_undirected = reading.cut.is_none() && beside(&|cut| cut.is_some());
        let is_doubled = reading.axis != Some(Axis::Fabric) && beside(&|cut| cut == reading.cut);
        let is_named = !reading.name.is_empty() && reading.axis != Some(Axis::Specimen);
        is_named && (is_undirected || is_doubled)
    };
    let mut odd: BTreeMap<String, usize> = BTreeMap::new();
    for reading in readings.iter().filter(|reading| is_odd(reading)) {
        odd.entry(reading.name.clone()).or_insert(reading.line);
    }
    readings.retain(|reading| !is_odd(reading));
    notes.extend(odd.into_iter().map(|(name, line)| {
        format!("\"{name}\" (line {line}) is left out: it is neither warp nor weft, specimen nor statistic")
    }));
}

/// Returns whether names differ by a number or a letter at their ends only: `S1`, `S2`; `A`, `B`;
/// `Sample 1`.
fn are_numbered(names: &[String]) -> bool {
    let parts: Vec<(String, String)> = names
        .iter()
        .map(|name| {
            let name = half_width(name).to_lowercase();
            let stem = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
            let stem = if stem.len() == name.len() && name.len() == 1 { "" } else { stem };
            (stem.to_owned(), name[stem.len()..].to_owned())
        })
        .collect();
    let (stem, _) = &parts[0];
    parts.iter().all(|(other, end)| other == stem && !end.is_empty())
}

/// Returns whether values under several names agree as those of specimens of one fabric do.
fn are_alike(readings: &[Reading]) -> bool {
    let mut groups: BTreeMap<(Item, Option<Cut>), Vec<f64>> = BTreeMap::new();
    for reading in readings.iter().filter(|reading| !reading.name.is_empty()) {
        if reading.statistic.is_none() {
            groups.entry((reading.item, reading.cut)).or_default().push(reading.number);
        }
    }
    let variation = |numbers: &Vec<f64>| {
        let (mean, deviation) = moments(numbers);
        deviation.unwrap_or(0.0) / mean.abs()
    };
    let of_body =
        |item: &Item| matches!(item, Item::Key("W" | "T" | "T0" | "TM") | Item::Thickness(_));
    let bodies = groups.iter().filter(|((item, _), _)| of_body(item));
    let is_one_body = bodies.map(|(_, numbers)| variation(numbers)).all(|cv| cv <= ALIKE);
    let mut all: Vec<f64> = groups.values().map(variation).collect();
    all.sort_by(f64::total_cmp);
    is_one_body && all.get(all.len() / 2).is_some_and(|median| *median <= ALIKE_MEDIAN)
}
