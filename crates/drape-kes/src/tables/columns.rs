//! Columns of the deformation and of the load in a block: the columns that the sheet names, or the
//! columns whose headings name them.

use crate::tables::block::Block;
use crate::tables::heading::{self, Kind};
use crate::tables::layout::Column;
use drape_input::{Quantity, Unit, parse_unit};

/// Axis of a curve that is searched in a block.
#[derive(Clone, Debug)]
pub(crate) struct AxisQuery<'a> {
    /// Name in messages: deformation, load.
    pub(crate) name: &'static str,
    /// Columns that the sheet names; empty if the columns are to be detected.
    pub(crate) columns: &'a [Column],
    /// Unit that the sheet declares.
    pub(crate) unit: Option<Unit>,
    /// Quantities that the axis may have.
    pub(crate) accepted: &'a [Quantity],
    /// Kinds of columns, preferred kinds first. Kinds of equal rank stand in one list.
    pub(crate) kinds: &'a [&'a [Kind]],
    /// Whether a length is preferred to a ratio, because its gauge is given.
    pub(crate) by_length: bool,
}

/// Numbers of the two columns of one curve in a block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) deformation: usize,
    pub(crate) load: usize,
    /// Title of the pair, where there are several.
    pub(crate) label: String,
}

/// Reason why a block does not have the columns, with the remedy.
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

/// Returns the pairs of columns of `block` for the two axes. Several pairs are repeats.
pub(crate) fn pairs(
    block: &Block,
    deformation: &AxisQuery<'_>,
    load: &AxisQuery<'_>,
) -> Result<Vec<Pair>, NoColumns> {
    let numbers = block.number_columns();
    // Two columns without names can only be the two axes, if both units are declared.
    let unnamed = block.headings.is_empty() && numbers.len() == 2;
    let both_open = deformation.columns.is_empty() && load.columns.is_empty();
    if unnamed && both_open && deformation.unit.is_some() && load.unit.is_some() {
        let pair = Pair { deformation: numbers[0], load: numbers[1], label: String::new() };
        return Ok(vec![pair]);
    }

    let loads = columns_of_axis(block, load, &[])?;
    let taken: &[usize] = if load.columns.is_empty() { &[] } else { &loads };
    let deformations = columns_of_axis(block, deformation, taken)?;
    pair_columns(block, deformations, loads)
}

/// Pairs the columns of both axes. One column of an axis goes with every column of the other axis.
fn pair_columns(
    block: &Block,
    deformations: Vec<usize>,
    loads: Vec<usize>,
) -> Result<Vec<Pair>, NoColumns> {
    let mut pairs = Vec::new();
    match (deformations.len(), loads.len()) {
        (1, _) => {
            for load in loads {
                let label = label(block, load);
                pairs.push(Pair { deformation: deformations[0], load, label });
            }
        }
        (count, load_count) if count == load_count => {
            for (deformation, load) in deformations.into_iter().zip(loads) {
                let load_label = label(block, load);
                let label =
                    if load_label.is_empty() { label(block, deformation) } else { load_label };
                pairs.push(Pair { deformation, load, label });
            }
        }
        (_, 1) => {
            // The deformation of the load's group is taken, and the nearest to the left of several.
            let load = loads[0];
            let nearest = deformations
                .iter()
                .copied()
                .filter(|&column| group(block, column) == group(block, load))
                .min_by_key(|&column| (column > load, column.abs_diff(load)));
            let deformation = nearest.unwrap_or(deformations[0]);
            pairs.push(Pair { deformation, load, label: label(block, load) });
        }
        (count, load_count) => {
            return Err(NoColumns {
                line: block.header_line,
                message: format!(
                    "{count} columns of deformation stand beside {load_count} of load"
                ),
                help: "name the columns: deformation = { column = 1 }, load = { column = 2 }"
                    .into(),
            });
        }
    }
    Ok(pairs)
}

/// Returns the title of the group of `column`; empty without a group.
fn group(block: &Block, column: usize) -> &str {
    block.groups.get(column).map(String::as_str).unwrap_or_default()
}

/// Returns the title over `column`, or the direction and the number in its name.
fn label(block: &Block, column: usize) -> String {
    if let Some(group) = block.groups.get(column).filter(|group| !group.is_empty()) {
        return group.clone();
    }
    let Some(heading) = block.headings.get(column) else { return String::new() };
    let name = heading::normal(&heading.name);
    let direction = heading::directions(&name).first().map_or("", |direction| direction.name());
    let number = name.split(' ').rev().find_map(|word| {
        let digits = word.trim_start_matches(|letter: char| letter.is_alphabetic());
        digits.parse::<u32>().ok().map(|number| number.to_string())
    });
    [direction, number.as_deref().unwrap_or_default()].join(" ").trim().to_owned()
}

/// Returns the name of `column` without the words and numbers that tell repeats apart.
fn name_of_repeats(block: &Block, column: usize) -> String {
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

/// Returns the columns of `axis` that are not `taken`. Several columns are returned only if they
/// are repeats under one name.
fn columns_of_axis(
    block: &Block,
    axis: &AxisQuery<'_>,
    taken: &[usize],
) -> Result<Vec<usize>, NoColumns> {
    if !axis.columns.is_empty() {
        let mut columns = Vec::new();
        for column in axis.columns {
            columns.extend(find_named(block, column)?);
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
        return Err(no_column_fits(block, axis));
    };

    fitting.retain(|candidate| candidate.rank == best.rank);
    let unit = |column: usize| block.headings.get(column).and_then(|heading| heading.unit.as_ref());
    let are_repeats = fitting.iter().all(|candidate| {
        name_of_repeats(block, candidate.column) == name_of_repeats(block, best.column)
            && unit(candidate.column) == unit(best.column)
    });
    if are_repeats {
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

/// Returns the reason that no column of `block` fits `axis`.
fn no_column_fits(block: &Block, axis: &AxisQuery<'_>) -> NoColumns {
    let names: Vec<String> = (0..block.width())
        .map(|column| match block.headings.get(column) {
            Some(heading) => match &heading.unit {
                Some(unit) => format!("{} ({unit})", heading.name),
                None => heading.name.clone(),
            },
            None => (column + 1).to_string(),
        })
        .collect();
    let quantities = axis.accepted.iter().map(|quantity| quantity.name()).collect::<Vec<_>>();

    let message = if block.headings.is_empty() {
        format!("no header says which of the {} columns is the {}", block.width(), axis.name)
    } else {
        format!("no column is a {} by its heading: a {}", axis.name, quantities.join(" or a "))
    };

    let unit = axis.accepted[0].laboratory().spelling;
    // The example has the usual order of columns. Without a header both columns have to be named.
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

/// Returns the rank of `column` for `axis`, lower being better; `None` for a column that does not
/// fit.
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
        // The heading is a known word for something else.
        (Some(None), _) => return None,
        (None, Some(_)) if heading.unit.is_some() => axis.kinds.len(),
        (None, _) => return None,
    };
    let is_length = unit.is_some_and(|unit| unit.quantity == Quantity::Length);
    let is_ratio = unit.is_some_and(|unit| unit.quantity == Quantity::Ratio);
    let behind = if axis.by_length { is_ratio } else { is_length };
    Some(place + if behind { 100 } else { 0 })
}

/// Returns the columns of `block` that a name or a number stands for.
pub(crate) fn find_named(block: &Block, column: &Column) -> Result<Vec<usize>, NoColumns> {
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
