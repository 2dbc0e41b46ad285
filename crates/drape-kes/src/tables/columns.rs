//! Columns of the deformation and of the load in a block: those that the sheet names, or those
//! whose headings say so.

use crate::tables::block::Block;
use crate::tables::heading::{self, Kind};
use crate::tables::layout::Column;
use drape_input::{Quantity, Unit, parse_unit};

/// Axis of a curve, as it is looked for in a block.
#[derive(Clone, Debug)]
pub(crate) struct AxisQuery<'a> {
    /// Name in messages: deformation, load.
    pub(crate) name: &'static str,
    /// Columns that the sheet names; empty where they are to be found.
    pub(crate) columns: &'a [Column],
    /// Unit that the sheet declares.
    pub(crate) unit: Option<Unit>,
    /// Quantities that the axis may have.
    pub(crate) accepted: &'a [Quantity],
    /// Kinds of columns, the preferred ones first: equals stand together.
    pub(crate) kinds: &'a [&'a [Kind]],
    /// Whether a length is preferred to a ratio, since its gauge is given.
    pub(crate) by_length: bool,
}

/// Columns of one curve in a block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) deformation: usize,
    pub(crate) load: usize,
    /// Title of the pair, where there are several.
    pub(crate) label: String,
}

/// Reason why a block has no such columns, with the remedy.
#[derive(Clone, Debug)]
pub(crate) struct NoColumns {
    pub(crate) line: Option<usize>,
    pub(crate) message: String,
    pub(crate) help: String,
}

/// Column that fits an axis.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    column: usize,
    /// Lower is better.
    rank: usize,
}

/// Returns the pairs of columns of a block.
pub(crate) fn pairs(
    block: &Block,
    deformation: &AxisQuery<'_>,
    load: &AxisQuery<'_>,
) -> Result<Vec<Pair>, NoColumns> {
    let numbers = block.number_columns();
    // Two columns that are nothing else can only be the two, where their units are declared.
    let unnamed = block.headings.is_empty() && numbers.len() == 2;
    let both_open = deformation.columns.is_empty() && load.columns.is_empty();
    if unnamed && both_open && deformation.unit.is_some() && load.unit.is_some() {
        let pair = Pair { deformation: numbers[0], load: numbers[1], label: String::new() };
        return Ok(vec![pair]);
    }
    let loads = of_axis(block, load, &[])?;
    let taken: &[usize] = if load.columns.is_empty() { &[] } else { &loads };
    let deformations = of_axis(block, deformation, taken)?;
    joined(block, deformations, loads)
}

/// Joins the columns of both axes.
fn joined(
    block: &Block,
    deformations: Vec<usize>,
    loads: Vec<usize>,
) -> Result<Vec<Pair>, NoColumns> {
    let label = |column: usize| label(block, column);
    let pair = |deformation: usize, load: usize, label: String| Pair { deformation, load, label };
    match (deformations.len(), loads.len()) {
        (1, 1) => Ok(vec![pair(deformations[0], loads[0], label(loads[0]))]),
        (1, _) => Ok(loads.iter().map(|&load| pair(deformations[0], load, label(load))).collect()),
        (all, many) if all == many => {
            let both = deformations.into_iter().zip(loads);
            Ok(both
                .map(|(q, f)| {
                    let of_load = label(f);
                    pair(q, f, if of_load.is_empty() { label(q) } else { of_load })
                })
                .collect())
        }
        (_, 1) => {
            // The deformation of the same group, or the nearest to the left.
            let load = loads[0];
            let group = |column: usize| block.groups.get(column).cloned().unwrap_or_default();
            let same = deformations.iter().copied().filter(|&q| group(q) == group(load));
            let nearest = same.min_by_key(|&q| (q > load, q.abs_diff(load)));
            Ok(vec![pair(nearest.unwrap_or(deformations[0]), load, label(load))])
        }
        (all, many) => Err(NoColumns {
            line: block.header_line,
            message: format!("{all} columns of deformation stand beside {many} of load"),
            help: "name the columns: deformation = { column = 1 }, load = { column = 2 }".into(),
        }),
    }
}

/// Returns the title over a column, or the number in its name.
fn label(block: &Block, column: usize) -> String {
    if let Some(group) = block.groups.get(column).filter(|group| !group.is_empty()) {
        return group.clone();
    }
    let Some(heading) = block.headings.get(column) else { return String::new() };
    let number = |word: &str| {
        let digits = word.trim_start_matches(|letter: char| letter.is_alphabetic());
        digits.parse::<u32>().ok().map(|number| number.to_string())
    };
    let name = heading::normal(&heading.name);
    let direction = heading::directions(&name).first().map_or("", |direction| direction.name());
    let number = name.split(' ').rev().find_map(number).unwrap_or_default();
    [direction, number.as_str()].join(" ").trim().to_owned()
}

/// Returns the name of a column without what tells repeats apart.
fn base(block: &Block, column: usize) -> String {
    let Some(heading) = block.headings.get(column) else { return String::new() };
    let name = heading::normal(&heading.name);
    let words = name.split(' ').map(|word| word.trim_end_matches(|c: char| c.is_ascii_digit()));
    let kept = words.filter(|word| {
        !word.is_empty()
            && heading::directions(word).is_empty()
            && !heading::is_specimen(&format!("{word} 1"))
    });
    kept.collect::<Vec<_>>().join(" ")
}

/// Returns the columns of one axis: several only where they are repeats of one name.
fn of_axis(block: &Block, axis: &AxisQuery<'_>, taken: &[usize]) -> Result<Vec<usize>, NoColumns> {
    if !axis.columns.is_empty() {
        let mut columns = Vec::new();
        for column in axis.columns {
            columns.extend(named(block, column)?);
        }
        return Ok(columns);
    }
    let numbers = block.number_columns();
    let open = numbers.iter().copied().filter(|column| !taken.contains(column));
    let mut fitting: Vec<Candidate> = open
        .filter_map(|column| rank(block, column, axis).map(|rank| Candidate { column, rank }))
        .collect();
    fitting.sort_by_key(|candidate| (candidate.rank, candidate.column));
    let Some(best) = fitting.first().copied() else {
        return Err(none_fits(block, axis));
    };
    fitting.retain(|candidate| candidate.rank == best.rank);
    let unit = |column: usize| block.headings.get(column).and_then(|heading| heading.unit.clone());
    let alike = |candidate: &Candidate| {
        base(block, candidate.column) == base(block, best.column)
            && unit(candidate.column) == unit(best.column)
    };
    if fitting.iter().all(alike) {
        return Ok(fitting.into_iter().map(|candidate| candidate.column).collect());
    }
    let names: Vec<String> =
        fitting.iter().map(|candidate| block.column_name(candidate.column)).collect();
    let alone = names.iter().filter(|name| **name == names[0]).count() == 1;
    let first = if alone { names[0].clone() } else { (best.column + 1).to_string() };
    Err(NoColumns {
        line: block.header_line,
        message: format!("columns {} could each be the {}", names.join(" and "), axis.name),
        help: format!("name the one to take: {} = {{ column = {first} }}", axis.name),
    })
}

fn none_fits(block: &Block, axis: &AxisQuery<'_>) -> NoColumns {
    let names: Vec<String> = (0..block.width())
        .map(|column| match block.headings.get(column) {
            Some(heading) => match &heading.unit {
                Some(unit) => format!("{} ({unit})", heading.name),
                None => heading.name.clone(),
            },
            None => (column + 1).to_string(),
        })
        .collect();
    let what = axis.accepted.iter().map(|quantity| quantity.name()).collect::<Vec<_>>();
    let message = if block.headings.is_empty() {
        format!("no header says which of the {} columns is the {}", block.width(), axis.name)
    } else {
        format!("no column is a {} by its heading: a {}", axis.name, what.join(" or a "))
    };
    let unit = axis.accepted[0].laboratory().spelling;
    // By number, the usual order; without a header both have to be named.
    let number = if axis.name == "load" { 2 } else { 1 };
    let named = if block.headings.is_empty() {
        "deformation = { column = 1, unit = \"…\" } and load = { column = 2, unit = \"…\" }"
            .to_owned()
    } else {
        format!("{} = {{ column = {number}, unit = \"{unit}\" }}", axis.name)
    };
    NoColumns {
        line: block.header_line.or(Some(block.first_line())),
        message,
        help: format!("name it: {named}; columns of the file: {}", names.join(", ")),
    }
}

/// Returns how well a column fits an axis, lower being better; `None` where it does not.
fn rank(block: &Block, column: usize, axis: &AxisQuery<'_>) -> Option<usize> {
    let heading = block.headings.get(column)?;
    let kind = heading::kind(&heading.name);
    let by_kind = kind.map(|kind| axis.kinds.iter().position(|kinds| kinds.contains(&kind)));
    let unit = match &heading.unit {
        Some(unit) => Some(parse_unit(unit, axis.accepted).ok()?),
        None => axis.unit,
    };
    let place = match (by_kind, unit) {
        (Some(Some(place)), _) => place,
        // A known word for something else.
        (Some(None), _) => return None,
        (None, Some(_)) if heading.unit.is_some() => axis.kinds.len(),
        (None, _) => return None,
    };
    let is_length = unit.is_some_and(|unit| unit.quantity == Quantity::Length);
    let is_ratio = unit.is_some_and(|unit| unit.quantity == Quantity::Ratio);
    let behind = if axis.by_length { is_ratio } else { is_length };
    Some(place + if behind { 100 } else { 0 })
}

/// Returns the columns that a name or a number means.
pub(crate) fn named(block: &Block, column: &Column) -> Result<Vec<usize>, NoColumns> {
    match column {
        Column::Number(number) => {
            let width = block.width();
            if (1..=width).contains(number) {
                return Ok(vec![number - 1]);
            }
            Err(NoColumns {
                line: None,
                message: format!("there is no column {number}"),
                help: format!("columns are counted from 1; this file has {width}"),
            })
        }
        Column::Name(name) if block.headings.is_empty() => Err(NoColumns {
            line: None,
            message: format!("column \"{name}\" is named, but the file has no header"),
            help: "give the column's place instead, counted from 1".into(),
        }),
        Column::Name(name) => {
            let all = block.headings.iter().enumerate();
            let found: Vec<usize> =
                all.filter(|(_, heading)| heading.is_named(name)).map(|(index, _)| index).collect();
            if !found.is_empty() {
                return Ok(found);
            }
            let names: Vec<&str> =
                block.headings.iter().map(|heading| heading.name.as_str()).collect();
            let hint = drape_input::closest(name, names.iter().copied())
                .map(|close| format!("did you mean `{close}`? "))
                .unwrap_or_default();
            Err(NoColumns {
                line: block.header_line,
                message: format!("there is no column \"{name}\""),
                help: format!("{hint}columns of the file: {}", names.join(", ")),
            })
        }
    }
}
