//! Specimens of one fabric averaged: a value with its standard deviation.

use std::collections::BTreeMap;

use drape_input::Unit;

use crate::results::item::Item;
use crate::results::label::{Cut, Statistic};
use crate::results::reading::Reading;
use crate::test::Direction;

/// Part by which a mean in a table may differ from the mean of its specimens: such means are
/// rounded.
const ROUNDED: f64 = 0.006;

/// Value of a fabric, averaged over its specimens.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Averaged {
    pub(crate) item: Item,
    pub(crate) direction: Option<Direction>,
    /// Number, in the unit, or bare.
    pub(crate) number: f64,
    /// Standard deviation, as the number; `None` where it is not known.
    pub(crate) deviation: Option<f64>,
    pub(crate) unit: Option<Unit>,
    /// Lines of the numbers, first and last.
    pub(crate) lines: (usize, usize),
    /// How the number came about; empty where it stands in the table.
    pub(crate) remark: String,
}

impl Averaged {
    /// Adds a remark.
    pub(crate) fn remarked(mut self, remark: &str) -> Self {
        let before = if self.remark.is_empty() { "" } else { "; " };
        self.remark = format!("{}{before}{remark}", self.remark);
        self
    }

    /// Returns the number in SI; `None` for a bare number.
    pub(crate) fn si(&self) -> Option<f64> {
        self.unit.map(|unit| self.number * unit.factor)
    }
}

/// Direction that the name of a sheet or of a file gives, with the reason.
pub(crate) struct Given {
    pub(crate) direction: Direction,
    pub(crate) why: String,
}

/// Averages the readings of one fabric; adds what has no use to the notes.
///
/// `given` is the direction of readings of a sheet that names no direction at all.
pub(crate) fn averaged(
    readings: &[Reading],
    given: Option<&Given>,
    notes: &mut Vec<String>,
) -> Vec<Averaged> {
    let is_directed = readings.iter().any(|reading| reading.cut.is_some());
    let why = given.filter(|_| !is_directed).map(|given| given.why.as_str());
    let given = given.filter(|_| !is_directed).map(|given| Cut::Along(given.direction));
    let mut groups: Vec<Group<'_>> = Vec::new();
    for reading in readings {
        let Some((item, cut)) = place(reading, given, notes) else { continue };
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
                averaged.remarked(&format!("{} {why}", direction.name()))
            }
            _ => averaged,
        }));
    }
    all
}

/// Item and direction with their readings.
type Group<'r> = ((Item, Option<Cut>), Vec<&'r Reading>);

/// Joins means and deviations without a direction with the readings of the only direction that
/// their item has.
fn join_statistics(groups: &mut Vec<Group<'_>>) {
    let of_statistics = |group: &Group<'_>| {
        let ((item, cut), readings) = group;
        item.is_directed() && cut.is_none() && readings.iter().all(|r| r.statistic.is_some())
    };
    let (open, mut kept): (Vec<_>, Vec<_>) = groups.drain(..).partition(of_statistics);
    for ((item, cut), readings) in open {
        let mut own = kept.iter_mut().filter(|((other, _), _)| *other == item);
        match (own.next(), own.next()) {
            (Some((_, group)), None) => group.extend(readings),
            _ => kept.push(((item, cut), readings)),
        }
    }
    *groups = kept;
}

/// Returns the item and the direction under which a reading is averaged; `None` for one on the
/// bias, which has no use but as the extension that gives the shear stiffness.
fn place(
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

/// Returns the mean of numbers and their standard deviation, that of a sample.
pub(crate) fn moments(numbers: &[f64]) -> (f64, Option<f64>) {
    let count = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    let squares: f64 = numbers.iter().map(|number| (number - mean).powi(2)).sum();
    (mean, (numbers.len() > 1).then(|| (squares / (count - 1.0)).sqrt()))
}

/// Returns the root of the mean square of standard deviations; `None` where one is missing.
fn pooled(deviations: impl ExactSizeIterator<Item = Option<f64>>) -> Option<f64> {
    let count = deviations.len() as f64;
    let square = |deviation: Option<f64>| deviation.map(|deviation| deviation.powi(2));
    let squares = deviations.map(square).sum::<Option<f64>>()?;
    (count > 0.0).then(|| (squares / count).sqrt())
}

/// Averages the readings of one item and direction.
fn average(
    item: Item,
    direction: Option<Direction>,
    group: &[&Reading],
    notes: &mut Vec<String>,
) -> Option<Averaged> {
    let unit = group.iter().find_map(|reading| reading.unit);
    let own = |reading: &Reading, number: f64| match (reading.unit, unit) {
        (Some(from), Some(to)) => number * (from.factor / to.factor),
        _ => number,
    };
    let of = |statistic: Option<Statistic>| {
        group.iter().copied().filter(move |reading| reading.statistic == statistic)
    };
    let lines: Vec<usize> = group.iter().map(|reading| reading.line).collect();
    let lines = (*lines.iter().min()?, *lines.iter().max()?);
    let singles = of_one_table(of(None).collect(), item, notes);
    let means: Vec<&Reading> = of(Some(Statistic::Mean)).collect();
    let stated = means.first().copied();
    let mut averaged = Averaged {
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
        averaged.number = own(stated, stated.number);
        averaged.deviation = stated.deviation.map(|deviation| own(stated, deviation));
    } else {
        let specimens = specimens(&singles, own);
        let numbers: Vec<f64> = specimens.iter().map(|specimen| specimen.number).collect();
        let (mean, deviation) = moments(&numbers);
        let are_tagged = singles.iter().any(|reading| reading.specimen.is_some());
        averaged.number = if numbers.iter().all(|number| *number == numbers[0]) {
            numbers[0]
        } else {
            rounded(mean, 7)
        };
        averaged.remark = remark(&singles, specimens.len());
        averaged.deviation = if specimens.len() > 1 && (are_tagged || specimens.len() > 2) {
            deviation.filter(|deviation| *deviation > 0.0)
        } else {
            pooled(specimens.iter().map(|specimen| specimen.deviation))
        };
        // Means of face and back stand for one.
        let of_table: Vec<f64> = means.iter().map(|mean| own(mean, mean.number)).collect();
        compare(&averaged, (!of_table.is_empty()).then(|| moments(&of_table).0), notes);
    }
    // A standard deviation of the table stands for one that could not be computed.
    let by_table = || {
        let deviation = of(Some(Statistic::Deviation)).next().map(|r| own(r, r.number));
        let variation = of(Some(Statistic::Variation)).next();
        deviation.or(variation.map(|r| 0.01 * r.number * averaged.number.abs()))
    };
    averaged.deviation = averaged.deviation.or_else(by_table).filter(|deviation| *deviation > 0.0);
    averaged.deviation = averaged.deviation.map(|deviation| rounded(deviation, 4));
    Some(averaged)
}

/// Keeps the readings of the first table where several say different things of the same specimens:
/// before washing and after it, perhaps.
fn of_one_table<'r>(
    readings: Vec<&'r Reading>,
    item: Item,
    notes: &mut Vec<String>,
) -> Vec<&'r Reading> {
    // The same number in other units is no other specimen.
    let Some(first) = readings.first().copied() else { return readings };
    let factor = |reading: &Reading| reading.unit.map(|unit| unit.factor);
    let is_repeated = |reading: &&Reading| {
        reading.specimen.is_none() && factor(reading) != factor(first) && reading.cut == first.cut
    };
    let readings: Vec<&Reading> = match first.specimen {
        None => readings.into_iter().filter(|reading| !is_repeated(reading)).collect(),
        Some(_) => readings,
    };
    let key = |reading: &Reading| (reading.specimen, reading.face.is_some(), reading.cut);
    let is_of_first = |reading: &&Reading| reading.item_at == first.item_at;
    let own: Vec<_> = readings.iter().copied().filter(is_of_first).collect();
    let others: Vec<_> = readings.iter().copied().filter(|reading| !is_of_first(reading)).collect();
    let collides = |other: &&&Reading| {
        own.iter().any(|reading| {
            key(reading) == key(other) && (reading.number / other.number - 1.0).abs() > ROUNDED
        })
    };
    // Repeats in rows that follow each other are specimens without numbers.
    let is_next = |pair: &[&Reading]| pair[1].line - pair[0].line <= 1;
    let are_named_alike = readings.iter().all(|reading| reading.item_text == first.item_text);
    let are_neighbours =
        readings.windows(2).all(is_next) && first.specimen.is_none() && are_named_alike;
    let Some(other) = others.iter().find(collides).filter(|_| !are_neighbours) else {
        return readings;
    };
    notes.push(format!(
        "{} is there more than once, on lines {} and {}; the first is taken: put the tables into files of their own, or \
         number the specimens",
        item.symbol(),
        first.line,
        other.line
    ));
    own
}

/// Specimen: its number, over face and back where there are both.
struct Specimen {
    number: f64,
    deviation: Option<f64>,
}

/// Joins the readings of each specimen, those of face and back.
fn specimens(readings: &[&Reading], own: impl Fn(&Reading, f64) -> f64) -> Vec<Specimen> {
    let has_faces = readings.iter().any(|reading| reading.face.is_some());
    let mut parts: BTreeMap<(usize, u32, Option<Cut>), Vec<&Reading>> = BTreeMap::new();
    for (index, reading) in readings.iter().enumerate() {
        // Without a number each reading is a specimen, unless the readings are of two faces.
        let alone = if reading.specimen.is_none() && !has_faces { index } else { usize::MAX };
        let cut = reading.cut.filter(|_| !reading.item.is_directed());
        parts.entry((alone, reading.specimen.unwrap_or(0), cut)).or_default().push(reading);
    }
    let joined = |parts: Vec<&Reading>| {
        let numbers: Vec<f64> = parts.iter().map(|part| own(part, part.number)).collect();
        let deviation = |part: &&Reading| Some(own(part, part.deviation?));
        Specimen { number: moments(&numbers).0, deviation: pooled(parts.iter().map(deviation)) }
    };
    let mut specimens: Vec<Specimen> = parts.into_values().map(joined).collect();
    // A value without a direction that stands under both is one value.
    let first = specimens.first().map(|specimen| specimen.number);
    let is_tagged = readings.iter().any(|reading| reading.specimen.is_some());
    if !is_tagged && specimens.iter().all(|specimen| Some(specimen.number) == first) {
        specimens.truncate(1);
    }
    specimens
}

/// Returns how the mean of readings came about.
fn remark(readings: &[&Reading], specimens: usize) -> String {
    let has_faces = readings.iter().filter(|reading| reading.face.is_some()).count() > 1;
    let faces = if has_faces { "of face and back" } else { "" };
    match (specimens, faces) {
        (0 | 1, "") => String::new(),
        (0 | 1, faces) => format!("mean {faces}"),
        (count, "") => format!("mean of {count} specimens"),
        (count, faces) => format!("mean of {count} specimens, {faces}"),
    }
}

/// Notes a mean of the table that is not the mean of its specimens.
fn compare(averaged: &Averaged, stated: Option<f64>, notes: &mut Vec<String>) {
    let Some(stated) = stated else { return };
    let last_digit = 10_f64.powi(-(fraction_digits(stated) as i32));
    let difference = (averaged.number - stated).abs();
    if difference > 0.55 * last_digit && difference > ROUNDED * stated.abs() {
        let line = averaged.lines.0;
        notes.push(format!(
            "line {line}: the table says {} {stated} for the mean, and its specimens have {}, which is taken",
            averaged.item.symbol(),
            rounded(averaged.number, 5)
        ));
    }
}

/// Returns the number of digits behind the point of a number.
fn fraction_digits(number: f64) -> usize {
    let text = number.to_string();
    text.split_once('.').map_or(0, |(_, fraction)| fraction.len())
}

/// Returns a number with some digits.
pub(crate) fn rounded(number: f64, digits: usize) -> f64 {
    format!("{number:.*e}", digits - 1).parse().unwrap_or(number)
}
