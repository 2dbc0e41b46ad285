//! Names over numbers: names of fabrics, each with its values, or names of specimens of one fabric.

use std::collections::BTreeMap;

use crate::results::average::moments;
use crate::results::item::Item;
use crate::results::label::letters::half_width;
use crate::results::label::{Cut, HeadKind, Statistic};
use crate::results::reading::Reading;

/// Largest coefficient of variation of mass and thickness among specimens of one fabric.
const BODY_VARIATION: f64 = 0.08;
/// Largest median coefficient of variation of all values of specimens of one fabric. Mechanical
/// values of one fabric scatter by some 5 to 15 %. Values of two fabrics differ by factors.
const MEDIAN_VARIATION: f64 = 0.15;

/// Readings of one fabric.
#[derive(Clone, Debug, Default)]
pub(crate) struct FabricReadings {
    /// Name in the table; `None` if the table gives none.
    pub(crate) name: Option<String>,
    pub(crate) readings: Vec<Reading>,
}

/// Splits the readings of a sheet by fabric, and adds assumptions and omissions to `notes`.
pub(crate) fn split_by_fabric(
    mut readings: Vec<Reading>,
    notes: &mut Vec<String>,
) -> Vec<FabricReadings> {
    drop_other_columns(&mut readings, notes);
    let names = names(&readings);
    let axis = readings.iter().filter(|reading| !reading.name.is_empty()).find_map(|r| r.axis);
    match names.as_slice() {
        [] => return vec![FabricReadings { name: None, readings }],
        [name] => {
            let is_fabric = matches!(axis, Some(HeadKind::Fabric | HeadKind::Sample));
            return vec![FabricReadings { name: is_fabric.then(|| name.clone()), readings }];
        }
        _ => {}
    }

    // A mean over all names is a mean of specimens.
    let has_mean = readings.iter().any(|reading| {
        reading.name.is_empty()
            && matches!(reading.statistic, Some(Statistic::Mean | Statistic::Deviation))
    });
    let are_numbered = are_numbered(&names);
    let are_specimens = match axis {
        Some(HeadKind::Specimen) => true,
        Some(HeadKind::Fabric) => false,
        _ if has_mean => true,
        _ if are_numbered => {
            let are_alike = are_alike(&readings);
            let (first, last) = (&names[0], &names[names.len() - 1]);
            notes.push(if are_alike {
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
            are_alike
        }
        _ => false,
    };

    if are_specimens {
        for reading in readings.iter_mut().filter(|reading| !reading.name.is_empty()) {
            let place = names.iter().position(|name| *name == reading.name).unwrap_or(0);
            reading.specimen = reading.specimen.or(Some(place as u32 + 1));
        }
        return vec![FabricReadings { name: None, readings }];
    }

    // A reading without a name belongs to every fabric.
    let mut fabrics = Vec::with_capacity(names.len());
    for name in names {
        let readings = readings
            .iter()
            .filter(|reading| reading.name == name || reading.name.is_empty())
            .cloned()
            .collect();
        fabrics.push(FabricReadings { name: Some(name), readings });
    }
    fabrics
}

/// Returns the names over `readings`, in the order of the table.
fn names(readings: &[Reading]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for reading in readings.iter().filter(|reading| !reading.name.is_empty()) {
        if !names.contains(&reading.name) {
            names.push(reading.name.clone());
        }
    }
    names
}

/// Removes readings in columns whose name is no fabric, such as limits and methods. Such columns
/// stand beside columns with a direction or without a name.
fn drop_other_columns(readings: &mut Vec<Reading>, notes: &mut Vec<String>) {
    let plain: Vec<(Item, Option<Cut>)> = readings
        .iter()
        .filter(|reading| reading.name.is_empty() && reading.statistic.is_none())
        .map(|reading| (reading.item, reading.cut))
        .collect();
    let is_other = |reading: &Reading| {
        let mut beside =
            plain.iter().filter(|(item, _)| *item == reading.item).map(|(_, cut)| *cut);
        let is_doubled = reading.axis != Some(HeadKind::Fabric);
        let stands_beside = beside.any(|cut| {
            (reading.cut.is_none() && cut.is_some()) || (is_doubled && cut == reading.cut)
        });
        let is_named = !reading.name.is_empty() && reading.axis != Some(HeadKind::Specimen);
        is_named && stands_beside
    };
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    readings.retain(|reading| {
        let is_other = is_other(reading);
        if is_other {
            names.entry(reading.name.clone()).or_insert(reading.line);
        }
        !is_other
    });
    notes.extend(names.into_iter().map(|(name, line)| {
        format!("\"{name}\" (line {line}) is left out: it is neither warp nor weft, specimen nor statistic")
    }));
}

/// Returns whether `names` differ only by a number or a letter at their ends: `S1`, `S2`; `A`, `B`;
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

/// Returns whether the values under several names agree as values of specimens of one fabric do.
fn are_alike(readings: &[Reading]) -> bool {
    let mut groups: BTreeMap<(Item, Option<Cut>), Vec<f64>> = BTreeMap::new();
    for reading in readings.iter().filter(|reading| !reading.name.is_empty()) {
        if reading.statistic.is_none() {
            groups.entry((reading.item, reading.cut)).or_default().push(reading.number);
        }
    }

    // Mass and thickness scatter least, and are compared alone too.
    let mut variations = Vec::with_capacity(groups.len());
    for ((item, _), numbers) in &groups {
        let (mean, deviation) = moments(numbers);
        let variation = deviation.unwrap_or(0.0) / mean.abs();
        let is_body = matches!(item, Item::Key("W" | "T" | "T0" | "TM") | Item::Thickness(_));
        if is_body && !(variation <= BODY_VARIATION) {
            return false;
        }
        variations.push(variation);
    }
    variations.sort_by(f64::total_cmp);
    let median = variations.get(variations.len() / 2);
    median.is_some_and(|median| *median <= MEDIAN_VARIATION)
}
