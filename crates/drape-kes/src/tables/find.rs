//! Search for the series of one test among the tables of its files. An ambiguous file is refused.

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics};

use crate::tables::block::{Block, Blocks, blocks};
use crate::tables::columns::{AxisQuery, NoColumns, Pair, pairs};
use crate::tables::file::TableFile;
use crate::tables::grid::{Cell, Grid, Row, Separator};
use crate::tables::heading::{self, Kind};
use crate::tables::layout::{Column, Layout, Take};
use crate::tables::number::{Decimal, Evidence};
use crate::tables::parts::split_parts;
use crate::tables::series::Series;
use crate::tables::stated::{Surroundings, has_sizes};
use crate::test::{Direction, Test};

/// Share of the rows of the largest table below which a table holds results, and no curve.
const SMALL: f64 = 0.1;
/// Largest number of rows of a table of results.
const FEW_ROWS: usize = 12;

/// Series of a test, and remarks of the search.
#[derive(Clone, Debug, Default)]
pub(crate) struct FoundSeries {
    pub(crate) series: Vec<Series>,
    /// What the file was taken for, in words.
    pub(crate) reading: Vec<String>,
    /// Repairs and doubts.
    pub(crate) warnings: Vec<Warning>,
}

/// Repair or doubt, with the consequence.
#[derive(Clone, Debug)]
pub(crate) struct Warning {
    pub(crate) message: String,
    pub(crate) help: &'static str,
}

/// Curve that is searched.
#[derive(Clone, Debug)]
pub(crate) struct Request<'a> {
    pub(crate) test: Test,
    pub(crate) direction: Direction,
    pub(crate) deformation: AxisQuery<'a>,
    pub(crate) load: AxisQuery<'a>,
}

/// Finds the series that `request` describes in one `file`.
pub(crate) fn find(
    path: &Path,
    file: &TableFile,
    layout: &Layout,
    request: &Request<'_>,
) -> Result<FoundSeries, Diagnostics> {
    let mut found = find_all(path, file, layout, request)?;
    choose(path, layout, request, &mut found)?;
    for series in &mut found.series {
        series.decimal = decimal_sign(series, layout)?;
        take_cycles(series, layout)?;
    }
    describe(&mut found, layout);
    Ok(found)
}

/// Finds every series of the test of `request` in one `file`, in any direction, in the order in
/// which `table` counts.
pub(crate) fn find_all(
    path: &Path,
    file: &TableFile,
    layout: &Layout,
    request: &Request<'_>,
) -> Result<FoundSeries, Diagnostics> {
    let mut found = FoundSeries { reading: file.reading.clone(), ..FoundSeries::default() };
    let tables = tables(path, file, layout, &mut found)?;
    let mut refused: Option<(usize, NoColumns)> = None;
    for Table { block, around } in tables {
        refuse_ambiguous_comma(path, file, &block)?;
        match pairs(&block, &request.deformation, &request.load) {
            Ok(pairs) => {
                let has_neighbours = pairs.len() > 1;
                let (block, pairs) = join_history(block, pairs, &mut found.reading);
                for pair in pairs {
                    let label = label(&block, &pair);
                    let series = Series {
                        path: path.to_owned(),
                        block: block.clone(),
                        pair,
                        decimal: Decimal::Point,
                        label,
                        around: around.clone(),
                        has_neighbours,
                    };
                    found.series.extend(split_parts(series, layout));
                }
            }
            Err(reason) => {
                let rows = block.rows.len();
                if refused.as_ref().is_none_or(|(most, _)| rows > *most) {
                    refused = Some((rows, reason));
                }
            }
        }
    }

    if found.series.is_empty()
        && let Some((_, NoColumns { line, message, help })) = refused
    {
        let finding = Diagnostic::new(path, message).help(help);
        return Err(Diagnostic { line, ..finding }.into());
    }
    Ok(found)
}

/// Refuses a table whose comma parts both the cells and the digits: `0,5,1,25` below two names.
fn refuse_ambiguous_comma(path: &Path, file: &TableFile, block: &Block) -> Result<(), Diagnostics> {
    let names = block.headings.len();
    let by_comma = file.grids.iter().all(|grid| grid.separator == Some(Separator::Comma));
    let mut widths = block.rows.iter().map(|row| row.cells.len());
    let is_ambiguous = by_comma
        && names >= 2
        && widths.clone().any(|width| width > names)
        && widths.all(|width| (names..=2 * names).contains(&width))
        && block
            .rows
            .iter()
            .flat_map(|row| &row.cells)
            .all(|cell| matches!(cell.evidence(), Some(Evidence::Whole) | None));
    if !is_ambiguous {
        return Ok(());
    }
    let message = format!(
        "{names} names stand above up to {} cells: the comma is both decimal sign and separator",
        block.width()
    );
    let help = "export the file with semicolons or tabs between the cells, or with a decimal point";
    Err(Diagnostic::new(path, message).on_line(block.first_line()).help(help).into())
}

/// Table with the texts and small tables around the curves of its sheet.
struct Table {
    block: Block,
    around: Surroundings,
}

/// Returns the tables of `file` that may be curves, and adds to the reading of `found` what was
/// skipped.
fn tables(
    path: &Path,
    file: &TableFile,
    layout: &Layout,
    found: &mut FoundSeries,
) -> Result<Vec<Table>, Diagnostics> {
    let mut tables: Vec<Table> = Vec::new();
    for grid in selected_grids(path, file, layout)? {
        let Blocks { blocks, statistics } = blocks(grid, layout.lines);
        if let Some(line) = layout.lines.header.filter(|&line| line > 0)
            && blocks.iter().all(|block| block.header_line != Some(line))
        {
            return Err(Diagnostic::new(
                path,
                format!("line {line} is no header: nothing is in it, or no numbers follow"),
            )
            .on_line(line)
            .help("write the line of the names of the columns, counted from 1")
            .into());
        }
        if !statistics.is_empty() {
            let lines = join_numbers(&statistics);
            found.reading.push(format!("means and deviations on line {lines} left out"));
        }

        // Gauge and width may stand in the text above the blocks, or in small tables.
        let around = Surroundings {
            rows: blocks.iter().flat_map(|block| block.above.clone()).collect(),
            tables: blocks
                .iter()
                .filter(|block| block.rows.len() <= FEW_ROWS && has_sizes(block))
                .cloned()
                .collect(),
        };
        let first = tables.len();
        for block in blocks {
            match tables[first..].last_mut() {
                Some(before)
                    if is_part_of_history(&block.title())
                        && before.block.headings == block.headings =>
                {
                    before.block.rows.extend(block.rows);
                }
                _ => tables.push(Table { block, around: around.clone() }),
            }
        }
        if grid.breaks_off
            && let Some(table) = tables[first..].last_mut()
        {
            drop_incomplete_row(&mut table.block, path, found);
        }
    }

    drop_results(&mut tables, &mut found.reading);
    if tables.is_empty() {
        let help = "a curve needs at least two points, one per line";
        return Err(Diagnostic::new(path, "the file has no rows of numbers").help(help).into());
    }
    Ok(tables)
}

/// Returns the grids of `file` that `layout` selects.
fn selected_grids<'f>(
    path: &Path,
    file: &'f TableFile,
    layout: &Layout,
) -> Result<Vec<&'f Grid>, Diagnostics> {
    let grids: Vec<&Grid> = match &layout.sheet {
        None => file.grids.iter().collect(),
        Some(Column::Number(number)) => {
            file.grids.iter().skip(number.saturating_sub(1)).take(1).collect()
        }
        Some(Column::Name(name)) => {
            let name = heading::normal(name);
            file.grids.iter().filter(|grid| heading::normal(&grid.sheet) == name).collect()
        }
    };
    if !grids.is_empty() {
        return Ok(grids);
    }
    let names: Vec<String> = file.grids.iter().map(|grid| format!("\"{}\"", grid.sheet)).collect();
    let wanted = match &layout.sheet {
        Some(Column::Name(name)) => format!("\"{name}\""),
        Some(Column::Number(number)) => number.to_string(),
        None => String::new(),
    };
    let help = match names.as_slice() {
        [name] if name == "\"\"" => "this file is text, without sheets: remove `sheet`".to_owned(),
        _ => format!("sheets of the file: {}", names.join(", ")),
    };
    Err(Diagnostic::new(path, format!("there is no sheet {wanted}")).help(help).into())
}

/// Removes tables of results: tables with few rows beside a table of many rows.
fn drop_results(tables: &mut Vec<Table>, reading: &mut Vec<String>) {
    let largest = tables.iter().map(|table| table.block.rows.len()).max().unwrap_or(0);
    tables.retain(|table| {
        let (rows, line) = (table.block.rows.len(), table.block.first_line());
        let is_result = rows <= FEW_ROWS && (rows as f64) < SMALL * largest as f64;
        if is_result {
            reading.push(format!("a table of {rows} rows on line {line} left out"));
        }
        !is_result
    });
}

/// Returns whether `label` names a part of one history, and no specimen.
fn is_part_of_history(label: &str) -> bool {
    heading::is_part(label) && !heading::is_specimen(label)
}

/// Removes a last row of `block` that has fewer cells than the first, in a text that ends within a
/// line.
fn drop_incomplete_row(block: &mut Block, path: &Path, found: &mut FoundSeries) {
    if let [first, .., last] = block.rows.as_slice()
        && last.cells.len() < first.cells.len()
    {
        let message = format!("line {} of {} breaks off", last.line, path.display());
        found.warnings.push(Warning { message, help: "it was left out" });
        block.rows.pop();
    }
}

/// Returns the label of a series: sheet, title of the table and title of the columns.
fn label(block: &Block, pair: &Pair) -> String {
    let parts = [block.sheet.clone(), block.title(), pair.label.clone()];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join(", ")
}

/// Joins loading and recovery in neighbouring `pairs` into one history in the columns of the first
/// pair.
///
/// A recovery that is listed from zero upwards is reversed, so that it continues where the loading
/// ends. The `reading` says so.
fn join_history(
    mut block: Block,
    pairs: Vec<Pair>,
    reading: &mut Vec<String>,
) -> (Block, Vec<Pair>) {
    if pairs.len() < 2 || !pairs.iter().all(|pair| is_part_of_history(&pair.label)) {
        return (block, pairs);
    }
    let first = pairs[0].clone();
    let mut joined: Vec<Row> = Vec::new();
    for pair in &pairs {
        let is_filled = |row: &&Row| row.cells.get(pair.load).is_some_and(|cell| !cell.is_empty());
        let mut rows: Vec<Row> = block.rows.iter().filter(is_filled).cloned().collect();
        let ends = [rows.first(), rows.last()].map(|row| value(row?, pair.deformation));
        let before = joined.last().and_then(|row| value(row, first.deformation));
        if let (Some(end), [Some(from), Some(to)]) = (before, ends)
            && (to - end).abs() < (from - end).abs()
        {
            rows.reverse();
            reading.push(format!("\"{}\" turned around to go on from its neighbour", pair.label));
        }

        // The cells move to the columns of the first pair.
        for mut row in rows {
            let width = row.cells.len().max(1 + first.deformation.max(first.load));
            row.cells.resize(width.max(1 + pair.deformation), Cell::Text(String::new()));
            let cells = [pair.deformation, pair.load].map(|column| row.cells[column].clone());
            for (column, cell) in [first.deformation, first.load].into_iter().zip(cells) {
                row.cells[column] = cell;
            }
            joined.push(row);
        }
    }
    reading.push(format!("{} parts of one history side by side", pairs.len()));
    block.rows = joined;
    (block, vec![Pair { label: String::new(), ..first }])
}

/// Returns the number in a `column` of `row`, with either decimal sign.
fn value(row: &Row, column: usize) -> Option<f64> {
    row.cells
        .get(column)
        .and_then(|cell| cell.number(Decimal::Comma).or(cell.number(Decimal::Point)))
}

/// Keeps the series of the test and direction of `request`. Several series that are no repeats are
/// refused.
fn choose(
    path: &Path,
    layout: &Layout,
    request: &Request<'_>,
    found: &mut FoundSeries,
) -> Result<(), Diagnostics> {
    let count = found.series.len();
    if let Take::Numbers(numbers) = &layout.table {
        if let Some(number) = numbers.iter().find(|&&number| number == 0 || number > count) {
            let help =
                format!("the tables of this test in the file: {}", list_titles(&found.series));
            let finding = Diagnostic::new(path, format!("there is no table {number}"));
            return Err(finding.help(help).into());
        }
        found.series = numbers.iter().map(|number| found.series[number - 1].clone()).collect();
        found.reading.push(format!("table {} of {count}", join_numbers(numbers)));
        return Ok(());
    }

    // A single series is taken, even if its title contradicts the request.
    let Request { test, direction, .. } = request;
    if let [series] = found.series.as_slice() {
        if contradicts(&series.label, request) {
            let (test, direction) = (test.name(), direction.name());
            let message = format!(
                "its title is \"{}\", and it is given as {test}, {direction}",
                series.label
            );
            found.warnings.push(Warning { message, help: "check test and direction" });
        }
        return Ok(());
    }

    let fitting: Vec<Series> = found
        .series
        .iter()
        .filter(|series| !contradicts(&series.label, request))
        .cloned()
        .collect();
    if fitting.is_empty() {
        let message = format!("no table is {} along the {}", test.name(), direction.name());
        let help = format!("name it: table = 1, of {}", list_titles(&found.series));
        return Err(Diagnostic::new(path, message).help(help).into());
    }
    if fitting.len() < count {
        found.reading.push(format!(
            "of {count} tables the {} of {}, {}",
            fitting.len(),
            test.name(),
            direction.name()
        ));
    }

    let labels: Vec<&str> = fitting.iter().map(|series| series.label.as_str()).collect();
    if fitting.len() > 1 && !is_repeat(&labels) && layout.table == Take::Undeclared {
        let message =
            format!("{} tables could be the curve: {}", fitting.len(), list_titles(&found.series));
        let help = if fitting.iter().any(|series| !series.block.sheet.is_empty()) {
            "name the one to take: sheet = \"…\" or table = 1; repeats of one test: table = \"all\""
        } else {
            "name the one to take: table = 1; repeats of one test: table = \"all\""
        };
        let finding = Diagnostic::new(path, message).help(help);
        return Err(Diagnostic { line: Some(fitting[0].block.first_line()), ..finding }.into());
    }
    found.series = fitting;
    Ok(())
}

/// Returns whether `label` names another test or another direction than `request`.
fn contradicts(label: &str, request: &Request<'_>) -> bool {
    let Request { test, direction, .. } = request;
    let directions = heading::directions(label);
    let tests = heading::tests(label);
    let fits_test = tests.is_empty() || tests.contains(test) || *test == Test::LoopBending;
    !fits_test || !(directions.is_empty() || directions.contains(direction))
}

/// Returns whether `labels` are labels of repeats. Their different parts are numbers of specimens,
/// or name only test and direction.
pub(crate) fn is_repeat(labels: &[&str]) -> bool {
    let labels: Vec<Vec<&str>> = labels.iter().map(|label| label.split(", ").collect()).collect();
    labels.iter().all(|parts| {
        let is_shared = |part: &&str| labels.iter().all(|parts| parts.contains(part));
        let mut different: Vec<&str> =
            parts.iter().copied().filter(|part| !is_shared(part)).collect();
        if different.is_empty() {
            different.clone_from(parts);
        }
        different.iter().any(|part| heading::is_specimen(part))
            && different.iter().all(|part| {
                heading::is_specimen(part)
                    || !heading::directions(part).is_empty()
                    || !heading::tests(part).is_empty()
            })
    })
}

/// Returns the numbers and labels of `series` as one text.
fn list_titles(series: &[Series]) -> String {
    let mut titles = Vec::with_capacity(series.len());
    for (index, series) in series.iter().enumerate() {
        let title = if series.label.is_empty() {
            format!("line {}", series.block.first_line())
        } else {
            format!("\"{}\"", series.label)
        };
        titles.push(format!("{} {title}", index + 1));
    }
    titles.join(", ")
}

/// Returns `numbers` as one text.
fn join_numbers(numbers: &[usize]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Returns the decimal sign of the numbers of `series`: the declared or the detected one. Ambiguous
/// numbers are refused.
pub(crate) fn decimal_sign(series: &Series, layout: &Layout) -> Result<Decimal, Diagnostics> {
    if let Some(declared) = layout.decimal {
        return Ok(declared);
    }

    // The first cells are noted that have a sign for certain, or that may be read either way.
    let (mut with_point, mut with_comma, mut unclear) = (None, None, None);
    let columns = series.block.number_columns();
    for row in &series.block.rows {
        for &column in &columns {
            let Some(cell) = row.cells.get(column) else { continue };
            match cell.evidence() {
                Some(Evidence::Only(Decimal::Point)) => {
                    _ = with_point.get_or_insert((row.line, cell))
                }
                Some(Evidence::Only(Decimal::Comma)) => {
                    _ = with_comma.get_or_insert((row.line, cell))
                }
                Some(Evidence::Either) if cell.text().contains(',') => {
                    _ = unclear.get_or_insert((row.line, cell));
                }
                _ => {}
            }
        }
    }

    let (line, message) = match (with_point, with_comma, unclear) {
        (Some((point_line, point)), Some((comma_line, comma)), _) => {
            let (point, comma) = (point.text(), comma.text());
            let message = format!(
                "\"{point}\" on line {point_line} has a decimal point, \"{comma}\" on line {comma_line} a comma"
            );
            (point_line.max(comma_line), message)
        }
        (None, None, Some((line, cell))) => {
            let text = cell.text();
            let thousands = text.replace(',', "");
            let fraction = text.replace(',', ".");
            let message =
                format!("\"{text}\" may be {fraction} or {thousands}, and no other number tells");
            (line, message)
        }
        (None, Some(_), _) => return Ok(Decimal::Comma),
        _ => return Ok(Decimal::Point),
    };
    let help = "say which it is: decimal = \",\" or decimal = \".\"";
    Err(Diagnostic::new(&series.path, message).on_line(line).help(help).into())
}

/// Keeps the rows of the declared cycles of `series`, numbered by the column of cycles, or by the
/// reversals.
fn take_cycles(series: &mut Series, layout: &Layout) -> Result<(), Diagnostics> {
    let Take::Numbers(wanted) = &layout.cycle else { return Ok(()) };
    let numbers = cycle_of_each_row(series)?;
    if let Some(missing) = wanted.iter().find(|number| !numbers.contains(&Some(**number))) {
        let mut known: Vec<usize> = numbers.iter().flatten().copied().collect();
        known.dedup();
        let finding = Diagnostic::new(&series.path, format!("there is no cycle {missing}"));
        return Err(finding.help(format!("cycles of the file: {}", join_numbers(&known))).into());
    }
    let mut numbers = numbers.into_iter();
    series
        .block
        .rows
        .retain(|_| numbers.next().flatten().is_some_and(|number| wanted.contains(&number)));
    Ok(())
}

/// Returns the number of the cycle of each row of `series`, from 1.
fn cycle_of_each_row(series: &Series) -> Result<Vec<Option<usize>>, Diagnostics> {
    let Series { block, pair, decimal, .. } = series;
    let cycle_column = (0..block.width()).find(|column| {
        let heading = block.headings.get(*column);
        heading.and_then(|heading| heading::kind(&heading.name)) == Some(Kind::Cycle)
    });
    if let Some(column) = cycle_column {
        let cells = block.rows.iter().map(|row| row.cells.get(column));
        return Ok(cells
            .map(|cell| cell?.number(*decimal).map(|number| number as usize))
            .collect());
    }

    // A cycle is a branch and the branch back.
    let deformation = series.numbers(pair.deformation)?;
    let ends = crate::curves::branch::reversals(&deformation);
    let branches =
        (0..block.rows.len()).map(|row| ends.partition_point(|&end| end < row).max(1) - 1);
    Ok(branches.map(|branch| Some(branch / 2 + 1)).collect())
}

/// Adds header, decimal sign and repeats to the reading of `found`.
fn describe(found: &mut FoundSeries, layout: &Layout) {
    let Some(first) = found.series.first() else { return };
    let mut reading = Vec::new();
    let block = &first.block;
    if !block.sheet.is_empty() {
        reading.push(format!("sheet \"{}\"", block.sheet));
    }
    if first.decimal == Decimal::Comma && layout.decimal.is_none() {
        reading.push("decimal comma".to_owned());
    }

    match (block.header_line, block.units_line) {
        (Some(header), Some(units)) => {
            reading.push(format!("header on line {header}, units on line {units}"))
        }
        (Some(header), None) if header > 1 => reading.push(format!("header on line {header}")),
        (None, _) => reading.push("no header".to_owned()),
        _ => {}
    }
    if found.series.len() > 1 {
        let labels: Vec<&str> = found.series.iter().map(|series| series.label.as_str()).collect();
        reading.push(format!("{} repeats: {}", labels.len(), labels.join("; ")));
    }
    found.reading.extend(reading);
}
