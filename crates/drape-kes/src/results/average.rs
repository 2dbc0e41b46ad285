//! Averages the specimens of one fabric: a value with its standard deviation.

use std::collections::BTreeMap;

use drape_input::{Unit, round_digits};

use crate::results::item::Item;
use crate::results::label::{Cut, Statistic};
use crate::results::reading::Reading;
use crate::test::Direction;

/// Relative difference up to which a mean in a table agrees with the mean of its specimens, because
/// printed means are rounded.
const ROUNDED: f64 = 0.006;

/// Value of a fabric, averaged over the specimens.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AveragedValue {
    pub(crate) item: Item,
    pub(crate) direction: Option<Direction>,
    /// Number in `unit`, or a number without unit.
    pub(crate) number: f64,
    /// Standard deviation in the unit of `number`; `None` if it is not known.
    pub(crate) deviation: Option<f64>,
    pub(crate) unit: Option<Unit>,
    /// First and last line of the numbers.
    pub(crate) lines: (usize, usize),
    /// Computation of the number; empty for a number that stands in the table.
    pub(crate) remark: String,
}

impl AveragedValue {
    /// Returns the value with `remark` behind its other remarks.
    pub(crate) fn with_remark(mut self, remark: &str) -> Self {
        let before = if self.remark.is_empty() { "" } else { "; " };
        self.remark = format!("{}{before}{remark}", self.remark);
        self
    }

    /// Returns the number in SI; `None` for a number without unit.
    pub(crate) fn si(&self) -> Option<f64> {
        self.unit.map(|unit| self.number * unit.factor)
    }
}

/// Direction that the name of a sheet or a file gives, with the reason.
pub(crate) struct AssumedDirection {
    pub(crate) direction: Direction,
    pub(crate) why: String,
}

/// Averages the readings of one fabric, and adds to `notes` the readings that are
/// not used.
///
/// `assumed` is the direction of a sheet whose readings name no direction.
pub(crate) fn average_fabric(
    readings: &[Reading],
    assumed: Option<&AssumedDirection>,
    notes: &mut Vec<String>,
) -> Vec<AveragedValue> {
    let is_directed = readings.iter().any(|reading| reading.cut.is_some());
    let why = assumed.filter(|_| !is_directed).map(|assumed| assumed.why.as_str());
    let assumed = assumed.filter(|_| !is_directed).map(|assumed| Cut::Along(assumed.direction));

    let mut groups: Vec<Group<'_>> = Vec::new();
    for reading in readings {
        let Some((item, cut)) = key_of(reading, assumed, notes) else { continue };
        match groups.iter_mut().find(|(key, _)| *key == (item, cut)) {
            Some((_, group)) => group.push(reading),
            None => groups.push(((item, cut), vec![reading])),
        }
    }

    join_statistics(&mut groups);
    let both: Vec<Item> = groups
        .iter()
        .filter(|((item, cut), _)| {
            *cut == Some(Cut::Along(Direction::Warp))
                && groups.iter().any(|((other, cut), _)| {
                    other == item && *cut == Some(Cut::Along(Direction::Weft))
                })
        })
        .map(|((item, _), _)| *item)
        .collect();
    let mut all = Vec::new();
    for ((item, cut), group) in &groups {
        // A mean of both directions says nothing new beside them.
        if cut.is_none() && item.is_directed() && both.contains(item) {
            continue;
        }
        let direction = match cut {
            Some(Cut::Along(direction)) => Some(*direction),
            _ => None,
        };
        let averaged = average(*item, direction, group, notes);
        all.extend(averaged.map(|averaged| match (direction, why) {
            (Some(direction), Some(why)) => {
                averaged.with_remark(&format!("{} {why}", direction.name()))
            }
            _ => averaged,
        }));
    }
    all
}

/// Readings with their item and direction.
type Group<'r> = ((Item, Option<Cut>), Vec<&'r Reading>);

/// Joins means and deviations without direction with the only directed readings of their item.
fn join_statistics(groups: &mut Vec<Group<'_>>) {
    let (undirected, mut kept): (Vec<_>, Vec<_>) =
        groups.drain(..).partition(|((item, cut), readings)| {
            item.is_directed()
                && cut.is_none()
                && readings.iter().all(|reading| reading.statistic.is_some())
        });
    for ((item, cut), readings) in undirected {
        let mut same_item = kept.iter_mut().filter(|((other, _), _)| *other == item);
        match (same_item.next(), same_item.next()) {
            (Some((_, group)), None) => group.extend(readings),
            _ => kept.push(((item, cut), readings)),
        }
    }
    *groups = kept;
}

/// Returns the item and direction under which `reading` is averaged. Returns `None` for a reading
/// on the bias, unless it is the extension that gives the shear stiffness.
fn key_of(
    reading: &Reading,
    given: Option<Cut>,
    notes: &mut Vec<String>,
) -> Option<(Item, Option<Cut>)> {
    let item = reading.item;
    if reading.cut == Some(Cut::Bias) {
        if matches!(item, Item::Extension(5) | Item::BiasExtension) {
            return Some((Item::BiasExtension, None));
        }
        if item.is_directed() {
            let line = reading.line;
            let note = format!(
                "line {line}: {} on the bias is left out: no law is fitted to the bias",
                item.symbol()
            );
            if !notes.contains(&note) {
                notes.push(note);
            }
            return None;
        }
    }

    Some((item, if item.is_directed() { reading.cut.or(given) } else { None }))
}

/// Returns the mean of `numbers` and their sample standard deviation.
pub(crate) fn moments(numbers: &[f64]) -> (f64, Option<f64>) {
    let count = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    let squares: f64 = numbers.iter().map(|number| (number - mean).powi(2)).sum();
    (mean, (numbers.len() > 1).then(|| (squares / (count - 1.0)).sqrt()))
}

/// Returns the root mean square of standard deviations; `None` if one is missing.
fn pooled(deviations: impl ExactSizeIterator<Item = Option<f64>>) -> Option<f64> {
    let count = deviations.len() as f64;
    let squares = deviations.map(|deviation| deviation.map(|d| d.powi(2))).sum::<Option<f64>>()?;
    (count > 0.0).then(|| (squares / count).sqrt())
}

/// Averages the readings of one item and direction. Returns `None` for a `group` without a value.
fn average(
    item: Item,
    direction: Option<Direction>,
    group: &[&Reading],
    notes: &mut Vec<String>,
) -> Option<AveragedValue> {
    let unit = group.iter().find_map(|reading| reading.unit);
    let lines: Vec<usize> = group.iter().map(|reading| reading.line).collect();
    let lines = (*lines.iter().min()?, *lines.iter().max()?);
    let singles = keep_first_table(with_statistic(group, None).collect(), item, notes);
    let means: Vec<&Reading> = with_statistic(group, Some(Statistic::Mean)).collect();
    let stated = means.first().copied();
    let mut averaged = AveragedValue {
        item,
        direction,
        number: 0.0,
        deviation: None,
        unit,
        lines,
        remark: String::new(),
    };

    if singles.is_empty() {
        let stated = stated?;
        averaged.number = stated.in_unit(stated.number, unit);
        averaged.deviation = stated.deviation.map(|deviation| stated.in_unit(deviation, unit));
    } else {
        let specimens = join_faces(&singles, unit);
        let numbers: Vec<f64> = specimens.iter().map(|specimen| specimen.number).collect();
        let (mean, deviation) = moments(&numbers);
        let are_tagged = singles.iter().any(|reading| reading.specimen.is_some());
        averaged.number = if numbers.iter().all(|number| *number == numbers[0]) {
            numbers[0]
        } else {
            round_digits(mean, 7)
        };
        averaged.remark = describe(&singles, specimens.len());

        averaged.deviation = if specimens.len() > 1 && (are_tagged || specimens.len() > 2) {
            deviation.filter(|deviation| *deviation > 0.0)
        } else {
            pooled(specimens.iter().map(|specimen| specimen.deviation))
        };
        // The means of face and back stand for one mean.
        let of_table: Vec<f64> = means.iter().map(|mean| mean.in_unit(mean.number, unit)).collect();
        let of_table = (!of_table.is_empty()).then(|| moments(&of_table).0);
        compare_with_stated(&averaged, of_table, notes);
    }

    // A standard deviation of the table replaces a deviation that could not be computed.
    if averaged.deviation.is_none() {
        let stated = with_statistic(group, Some(Statistic::Deviation)).next();
        let variation = with_statistic(group, Some(Statistic::Variation)).next();
        averaged.deviation = stated
            .map(|reading| reading.in_unit(reading.number, unit))
            .or(variation.map(|reading| 0.01 * reading.number * averaged.number.abs()));
    }
    averaged.deviation = averaged.deviation.filter(|deviation| *deviation > 0.0);
    averaged.deviation = averaged.deviation.map(|deviation| round_digits(deviation, 4));
    Some(averaged)
}

/// Returns the readings of `group` with a `statistic`.
fn with_statistic<'r>(
    group: &[&'r Reading],
    statistic: Option<Statistic>,
) -> impl Iterator<Item = &'r Reading> {
    group.iter().copied().filter(move |reading| reading.statistic == statistic)
}

/// Keeps the readings of the first table if several tables contradict each other about the same
/// specimens, such as before and after washing.
fn keep_first_table<'r>(
    readings: Vec<&'r Reading>,
    item: Item,
    notes: &mut Vec<String>,
) -> Vec<&'r Reading> {
    let Some(first) = readings.first().copied() else { return readings };

    // The same number in another unit is no other specimen.
    let factor = |reading: &Reading| reading.unit.map(|unit| unit.factor);
    let readings: Vec<&Reading> = readings
        .into_iter()
        .filter(|reading| {
            first.specimen.is_some()
                || reading.specimen.is_some()
                || factor(reading) == factor(first)
                || reading.cut != first.cut
        })
        .collect();

    // Readings of one specimen contradict each other if their numbers differ.
    let (of_first, others): (Vec<&Reading>, Vec<&Reading>) =
        readings.iter().copied().partition(|reading| reading.item_position == first.item_position);
    let contradicting = others.iter().find(|other| {
        of_first.iter().any(|reading| {
            reading.specimen == other.specimen
                && reading.face.is_some() == other.face.is_some()
                && reading.cut == other.cut
                && (reading.number / other.number - 1.0).abs() > ROUNDED
        })
    });

    // Repeats of one name in neighbouring rows are specimens without numbers.
    let are_neighbours = readings.windows(2).all(|pair| pair[1].line - pair[0].line <= 1);
    let have_one_name = readings.iter().all(|reading| reading.item_text == first.item_text);
    let are_specimens = first.specimen.is_none() && are_neighbours && have_one_name;
    let Some(contradicting) = contradicting.filter(|_| !are_specimens) else {
        return readings;
    };
    notes.push(format!(
        "{} is there more than once, on lines {} and {}; the first is taken: put the tables into files of their own, or \
         number the specimens",
        item.symbol(),
        first.line,
contradicting.line
    ));
    of_first
}

/// Number of one specimen, averaged over face and back.
struct Specimen {
    number: f64,
    deviation: Option<f64>,
}

/// Joins the readings of each specimen, such as face and back, in `unit`.
fn join_faces(readings: &[&Reading], unit: Option<Unit>) -> Vec<Specimen> {
    let has_faces = readings.iter().any(|reading| reading.face.is_some());
    let mut parts: BTreeMap<(usize, u32, Option<Cut>), Vec<&Reading>> = BTreeMap::new();
    for (index, reading) in readings.iter().enumerate() {
        // Without a number each reading is a specimen, unless the readings are of face and back.
        let alone = if reading.specimen.is_none() && !has_faces { index } else { usize::MAX };
        let cut = reading.cut.filter(|_| !reading.item.is_directed());
        parts.entry((alone, reading.specimen.unwrap_or(0), cut)).or_default().push(reading);
    }

    let mut specimens = Vec::with_capacity(parts.len());
    for parts in parts.into_values() {
        let numbers: Vec<f64> = parts.iter().map(|part| part.in_unit(part.number, unit)).collect();
        let deviations = parts.iter().map(|part| Some(part.in_unit(part.deviation?, unit)));
        specimens.push(Specimen { number: moments(&numbers).0, deviation: pooled(deviations) });
    }

    // One number that stands under both directions is one value.
    let first = specimens.first().map(|specimen| specimen.number);
    let is_tagged = readings.iter().any(|reading| reading.specimen.is_some());
    if !is_tagged && specimens.iter().all(|specimen| Some(specimen.number) == first) {
        specimens.truncate(1);
    }
    specimens
}

/// Returns the computation of the mean of `readings` in words.
fn describe(readings: &[&Reading], specimens: usize) -> String {
    let has_faces = readings.iter().filter(|reading| reading.face.is_some()).count() > 1;
    let faces = if has_faces { "of face and back" } else { "" };
    match (specimens, faces) {
        (0 | 1, "") => String::new(),
        (0 | 1, faces) => format!("mean {faces}"),
        (count, "") => format!("mean of {count} specimens"),
        (count, faces) => format!("mean of {count} specimens, {faces}"),
    }
}

/// Notes a mean that the table states, if it differs from the mean of the specimens.
fn compare_with_stated(averaged: &AveragedValue, stated: Option<f64>, notes: &mut Vec<String>) {
    let Some(stated) = stated else { return };
    let last_digit = 10_f64.powi(-(fraction_digits(stated) as i32));
    let difference = (averaged.number - stated).abs();
    if difference > 0.55 * last_digit && difference > ROUNDED * stated.abs() {
        let line = averaged.lines.0;
        notes.push(format!(
            "line {line}: the table says {} {stated} for the mean, and its specimens have {}, which is taken",
            averaged.item.symbol(),
            round_digits(averaged.number, 5)
        ));
    }
}

/// Returns the number of digits behind the decimal point of `number`.
fn fraction_digits(number: f64) -> usize {
    let text = number.to_string();
    text.split_once('.').map_or(0, |(_, fraction)| fraction.len())
}
