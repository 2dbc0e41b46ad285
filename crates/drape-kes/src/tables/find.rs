//! Search for the series of one test among the tables of its files; refused where several would do.

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics};

use crate::tables::block::{Block, blocks};
use crate::tables::columns::{AxisQuery, NoColumns, Pair, pairs};
use crate::tables::file::TableFile;
use crate::tables::grid::{Cell, Row, Separator};
use crate::tables::heading::{self, Kind};
use crate::tables::layout::{Column, Layout, Take};
use crate::tables::number::{Decimal, Evidence};
use crate::tables::parts::parts;
use crate::tables::series::Series;
use crate::tables::stated::{Around, has_sizes};
use crate::test::{Direction, Test};

/// Share of the rows of the largest table below which a table is one of results, and no curve.
const SMALL: f64 = 0.1;
/// Rows that a table of results has at most.
const FEW_ROWS: usize = 12;

/// Series of a test with what was found on the way.
#[derive(Clone, Debug, Default)]
pub(crate) struct FoundSeries {
    pub(crate) series: Vec<Series>,
    /// Reading, in words.
    pub(crate) reading: Vec<String>,
    /// Repairs and doubts.
    pub(crate) warnings: Vec<Warning>,
}

/// Repair or doubt, with what was done.
#[derive(Clone, Debug)]
pub(crate) struct Warning {
    pub(crate) message: String,
    pub(crate) help: &'static str,
}

/// Curve that is looked for.
#[derive(Clone, Debug)]
pub(crate) struct Request<'a> {
    pub(crate) test: Test,
    pub(crate) direction: Direction,
    pub(crate) deformation: AxisQuery<'a>,
    pub(crate) load: AxisQuery<'a>,
}

/// Finds the series of a test in one file.
pub(crate) fn find(
    path: &Path,
    file: &TableFile,
    layout: &Layout,
    request: &Request<'_>,
) -> Result<FoundSeries, Diagnostics> {
    let mut found = every(path, file, layout, request)?;
    choose(path, layout, request, &mut found)?;
    for series in &mut found.series {
        series.decimal = decimal(series, layout)?;
        take_cycles(series, layout)?;
    }
    describe(&mut found, layout);
    Ok(found)
}

/// Finds every series of a test in one file, whatever its direction, in the order that `table`
/// counts.
pub(crate) fn every(
    path: &Path,
    file: &TableFile,
    layout: &Layout,
    request: &Request<'_>,
) -> Result<FoundSeries, Diagnostics> {
    let mut found = FoundSeries { reading: file.reading.clone(), ..FoundSeries::default() };
    let tables = tables(path, file, layout, &mut found)?;
    let mut refused: Option<(usize, NoColumns)> = None;
    for Table { block, around } in tables {
        refuse_comma_twice(path, file, &block)?;
        match pairs(&block, &request.deformation, &request.load) {
            Ok(pairs) => {
                let several = pairs.len() > 1;
                let (block, pairs) = one_history(block, pairs, &mut found.reading);
                for pair in pairs {
                    let label = title(&block, &pair);
                    let series = Series {
                        path: path.to_owned(),
                        block: block.clone(),
                        pair,
                        decimal: Decimal::Point,
                        label,
                        around: around.clone(),
                        several,
                    };
                    found.series.extend(parts(series, layout));
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
    if let (true, Some((_, NoColumns { line, message, help }))) = (found.series.is_empty(), refused)
    {
        let finding = Diagnostic::new(path, message).help(help);
        return Err(Diagnostic { line, ..finding }.into());
    }
    Ok(found)
}

/// Refuses a table whose comma parts the cells and the numbers: `0,5,1,25` below two names.
fn refuse_comma_twice(path: &Path, file: &TableFile, block: &Block) -> Result<(), Diagnostics> {
    let names = block.headings.len();
    let by_comma = file.grids.iter().all(|grid| grid.separator == Some(Separator::Comma));
    let mut widths = block.rows.iter().map(|row| row.cells.len());
    let whole = |cell: &Cell| matches!(cell.evidence(), Some(Evidence::Whole) | None);
    let twice = by_comma
        && names >= 2
        && widths.clone().any(|width| width > names)
        && widths.all(|width| (names..=2 * names).contains(&width))
        && block.rows.iter().all(|row| row.cells.iter().all(whole));
    if !twice {
        return Ok(());
    }
    let message = format!(
        "{names} names stand above up to {} cells: the comma is both decimal sign and separator",
        block.width()
    );
    let help = "export the file with semicolons or tabs between the cells, or with a decimal point";
    Err(Diagnostic::new(path, message).on_line(block.first_line()).help(help).into())
}

/// Table with what its sheet holds around the curves.
struct Table {
    block: Block,
    around: Around,
}

/// Returns the tables of a file that may be curves.
fn tables(
    path: &Path,
    file: &TableFile,
    layout: &Layout,
    found: &mut FoundSeries,
) -> Result<Vec<Table>, Diagnostics> {
    let grids: Vec<_> = match &layout.sheet {
        None => file.grids.iter().collect(),
        Some(Column::Number(number)) => {
            file.grids.iter().skip(number.saturating_sub(1)).take(1).collect()
        }
        Some(Column::Name(name)) => {
            let same = |sheet: &str| heading::normal(sheet) == heading::normal(name);
            file.grids.iter().filter(|grid| same(&grid.sheet)).collect()
        }
    };
    if grids.is_empty() {
        let names: Vec<String> =
            file.grids.iter().map(|grid| format!("\"{}\"", grid.sheet)).collect();
        let wanted = match &layout.sheet {
            Some(Column::Name(name)) => format!("\"{name}\""),
            Some(Column::Number(number)) => number.to_string(),
            None => String::new(),
        };
        let help = match names.as_slice() {
            [one] if one == "\"\"" => {
                "this file is text, without sheets: remove `sheet`".to_owned()
            }
            _ => format!("sheets of the file: {}", names.join(", ")),
        };
        return Err(Diagnostic::new(path, format!("there is no sheet {wanted}")).help(help).into());
    }
    let mut tables: Vec<Table> = Vec::new();
    for grid in grids {
        let of_grid = blocks(grid, layout.lines);
        if let Some(line) = layout.lines.header.filter(|&line| line > 0)
            && of_grid.blocks.iter().all(|block| block.header_line != Some(line))
        {
            return Err(Diagnostic::new(
                path,
                format!("line {line} is no header: nothing is in it, or no numbers follow"),
            )
            .on_line(line)
            .help("write the line of the names of the columns, counted from 1")
            .into());
        }
        if !of_grid.statistics.is_empty() {
            let lines: Vec<String> = of_grid.statistics.iter().map(ToString::to_string).collect();
            found
                .reading
                .push(format!("means and deviations on line {} left out", lines.join(", ")));
        }
        let around = Around {
            rows: of_grid.blocks.iter().flat_map(|block| block.above.clone()).collect(),
            tables: of_grid
                .blocks
                .iter()
                .filter(|block| block.rows.len() <= FEW_ROWS && has_sizes(block))
                .cloned()
                .collect(),
        };
        let first = tables.len();
        for block in of_grid.blocks {
            let part = heading::is_part(&block.title()) && !heading::is_specimen(&block.title());
            match tables[first..].last_mut() {
                Some(before) if part && before.block.headings == block.headings => {
                    before.block.rows.extend(block.rows);
                }
                _ => tables.push(Table { block, around: around.clone() }),
            }
        }
        if grid.breaks_off
            && let Some(table) = tables[first..].last_mut()
        {
            drop_broken_end(&mut table.block, path, found);
        }
    }
    let largest = tables.iter().map(|table| table.block.rows.len()).max().unwrap_or(0);
    let small = |rows: usize| rows <= FEW_ROWS && (rows as f64) < SMALL * largest as f64;
    for table in tables.iter().filter(|table| small(table.block.rows.len())) {
        let (rows, line) = (table.block.rows.len(), table.block.first_line());
        found.reading.push(format!("a table of {rows} rows on line {line} left out"));
    }
    tables.retain(|table| !small(table.block.rows.len()));
    if tables.is_empty() {
        let help = "a curve needs at least two points, one per line";
        return Err(Diagnostic::new(path, "the file has no rows of numbers").help(help).into());
    }
    Ok(tables)
}

/// Leaves out a last row with fewer cells than the first, where the text ends within a line.
fn drop_broken_end(block: &mut Block, path: &Path, found: &mut FoundSeries) {
    if let [first, .., last] = block.rows.as_slice()
        && last.cells.len() < first.cells.len()
    {
        let message = format!("line {} of {} breaks off", last.line, path.display());
        found.warnings.push(Warning { message, help: "it was left out" });
        block.rows.pop();
    }
}

/// Returns the title of a series: of its columns, its table, or its sheet.
fn title(block: &Block, pair: &Pair) -> String {
    let parts = [block.sheet.clone(), block.title(), pair.label.clone()];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join(", ")
}

/// Joins loading and recovery that stand side by side into one history in the columns of the first.
///
/// A way back that is listed from zero up is turned around, so that it goes on where the way there
/// ends; the reading says so.
fn one_history(
    mut block: Block,
    pairs: Vec<Pair>,
    reading: &mut Vec<String>,
) -> (Block, Vec<Pair>) {
    let part = |pair: &Pair| heading::is_part(&pair.label) && !heading::is_specimen(&pair.label);
    if pairs.len() < 2 || !pairs.iter().all(part) {
        return (block, pairs);
    }
    let first = pairs[0].clone();
    let value = |row: &Row, column: usize| {
        row.cells
            .get(column)
            .and_then(|cell| cell.number(Decimal::Comma).or(cell.number(Decimal::Point)))
    };
    let mut joined: Vec<Row> = Vec::new();
    for pair in &pairs {
        let filled = |row: &&Row| row.cells.get(pair.load).is_some_and(|cell| !cell.is_empty());
        let mut rows: Vec<Row> = block.rows.iter().filter(filled).cloned().collect();
        let ends = [rows.first(), rows.last()].map(|row| value(row?, pair.deformation));
        let before = joined.last().and_then(|row| value(row, first.deformation));
        if let (Some(end), [Some(from), Some(to)]) = (before, ends)
            && (to - end).abs() < (from - end).abs()
        {
            rows.reverse();
            reading.push(format!("\"{}\" turned around to go on from its neighbour", pair.label));
        }
        joined.extend(rows.into_iter().map(|mut row| {
            let width = row.cells.len().max(1 + first.deformation.max(first.load));
            row.cells.resize(width.max(1 + pair.deformation), Cell::Text(String::new()));
            let cells = [pair.deformation, pair.load].map(|column| row.cells[column].clone());
            for (column, cell) in [first.deformation, first.load].into_iter().zip(cells) {
                row.cells[column] = cell;
            }
            row
        }));
    }
    reading.push(format!("{} parts of one history side by side", pairs.len()));
    block.rows = joined;
    (block, vec![Pair { label: String::new(), ..first }])
}

/// Keeps the series of the test and direction; refuses several that are no repeats.
fn choose(
    path: &Path,
    layout: &Layout,
    request: &Request<'_>,
    found: &mut FoundSeries,
) -> Result<(), Diagnostics> {
    let all = found.series.len();
    if let Take::These(numbers) = &layout.table {
        if let Some(number) = numbers.iter().find(|&&number| number == 0 || number > all) {
            let help = format!("the tables of this test in the file: {}", list(&found.series));
            let finding = Diagnostic::new(path, format!("there is no table {number}"));
            return Err(finding.help(help).into());
        }
        found.series = numbers.iter().map(|number| found.series[number - 1].clone()).collect();
        found.reading.push(format!("table {} of {all}", join(numbers)));
        return Ok(());
    }
    let Request { test, direction, .. } = request;
    let other = |label: &str| {
        let directions = heading::directions(label);
        let tests = heading::tests(label);
        let of_test = tests.is_empty() || tests.contains(test) || *test == Test::LoopBending;
        !of_test || !(directions.is_empty() || directions.contains(direction))
    };
    if all == 1 {
        if let Some(series) = found.series.iter().find(|series| other(&series.label)) {
            let (test, direction) = (test.name(), direction.name());
            let message = format!(
                "its title is \"{}\", and it is given as {test}, {direction}",
                series.label
            );
            found.warnings.push(Warning { message, help: "check test and direction" });
        }
        return Ok(());
    }
    let mine: Vec<Series> =
        found.series.iter().filter(|series| !other(&series.label)).cloned().collect();
    if mine.is_empty() {
        let message = format!("no table is {} along the {}", test.name(), direction.name());
        let help = format!("name it: table = 1, of {}", list(&found.series));
        return Err(Diagnostic::new(path, message).help(help).into());
    }
    if mine.len() < all {
        found.reading.push(format!(
            "of {all} tables the {} of {}, {}",
            mine.len(),
            test.name(),
            direction.name()
        ));
    }
    let repeats = is_repeat(&mine.iter().map(|series| series.label.as_str()).collect::<Vec<_>>());
    if mine.len() > 1 && !repeats && layout.table == Take::Undeclared {
        let message = format!("{} tables could be the curve: {}", mine.len(), list(&found.series));
        let help = if mine.iter().any(|series| !series.block.sheet.is_empty()) {
            "name the one to take: sheet = \"…\" or table = 1; repeats of one test: table = \"all\""
        } else {
            "name the one to take: table = 1; repeats of one test: table = \"all\""
        };
        let finding = Diagnostic::new(path, message).help(help);
        return Err(Diagnostic { line: Some(mine[0].block.first_line()), ..finding }.into());
    }
    found.series = mine;
    Ok(())
}

/// Returns whether labels are those of repeats: what they do not share are numbers of specimens, or
/// says nothing but test and direction.
pub(crate) fn is_repeat(labels: &[&str]) -> bool {
    let parts: Vec<Vec<&str>> = labels.iter().map(|label| label.split(", ").collect()).collect();
    let shared = |part: &&str| parts.iter().all(|other| other.contains(part));
    parts.iter().all(|parts| {
        let mut numbered = false;
        let own: Vec<&&str> = parts.iter().filter(|part| !shared(part)).collect();
        let own = if own.is_empty() { parts.iter().collect() } else { own };
        let plain = own.into_iter().fold(true, |plain, part| {
            let specimen = heading::is_specimen(part);
            numbered |= specimen;
            let named = !heading::directions(part).is_empty() || !heading::tests(part).is_empty();
            plain && (specimen || named)
        });
        plain && numbered
    })
}

fn list(series: &[Series]) -> String {
    let one = |(index, series): (usize, &Series)| {
        let title = if series.label.is_empty() {
            format!("line {}", series.block.first_line())
        } else {
            format!("\"{}\"", series.label)
        };
        format!("{} {title}", index + 1)
    };
    series.iter().enumerate().map(one).collect::<Vec<_>>().join(", ")
}

fn join(numbers: &[usize]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Returns the decimal sign of the numbers of a series; refuses them where it cannot be told.
pub(crate) fn decimal(series: &Series, layout: &Layout) -> Result<Decimal, Diagnostics> {
    if let Some(declared) = layout.decimal {
        return Ok(declared);
    }
    let mut seen: [Option<(usize, String)>; 2] = [None, None];
    let mut either = None;
    let columns = series.block.number_columns();
    for row in &series.block.rows {
        for &column in &columns {
            let Some(cell) = row.cells.get(column) else { continue };
            let here = || (row.line, cell.text());
            match cell.evidence() {
                Some(Evidence::Of(Decimal::Point)) => _ = seen[0].get_or_insert_with(here),
                Some(Evidence::Of(Decimal::Comma)) => _ = seen[1].get_or_insert_with(here),
                Some(Evidence::Either) if cell.text().contains(',') => {
                    _ = either.get_or_insert_with(here);
                }
                _ => {}
            }
        }
    }
    let refuse = |line: usize, message: String| {
        let help = "say which it is: decimal = \",\" or decimal = \".\"";
        Err(Diagnostic::new(&series.path, message).on_line(line).help(help).into())
    };
    match (seen, either) {
        ([Some((line, point)), Some((other, comma))], _) => refuse(
            line.max(other),
            format!(
                "\"{point}\" on line {line} has a decimal point, \"{comma}\" on line {other} a comma"
            ),
        ),
        ([None, Some(_)], _) => Ok(Decimal::Comma),
        ([None, None], Some((line, text))) => {
            let thousands = text.replace(',', "");
            let fraction = text.replace(',', ".");
            refuse(
                line,
                format!("\"{text}\" may be {fraction} or {thousands}, and no other number tells"),
            )
        }
        _ => Ok(Decimal::Point),
    }
}

/// Keeps the rows of the declared cycles, by the column of cycles, or by the reversals.
fn take_cycles(series: &mut Series, layout: &Layout) -> Result<(), Diagnostics> {
    let Take::These(wanted) = &layout.cycle else { return Ok(()) };
    let numbers = cycle_of_each_row(series)?;
    if let Some(missing) = wanted.iter().find(|number| !numbers.contains(&Some(**number))) {
        let mut known: Vec<usize> = numbers.iter().flatten().copied().collect();
        known.dedup();
        let finding = Diagnostic::new(&series.path, format!("there is no cycle {missing}"));
        return Err(finding.help(format!("cycles of the file: {}", join(&known))).into());
    }
    let mut number = numbers.iter();
    series.block.rows.retain(|_| {
        number.next().is_some_and(|number| number.is_some_and(|n| wanted.contains(&n)))
    });
    Ok(())
}

fn cycle_of_each_row(series: &Series) -> Result<Vec<Option<usize>>, Diagnostics> {
    let Series { block, pair, decimal, .. } = series;
    let is_cycle = |column: &usize| {
        let heading = block.headings.get(*column);
        heading.and_then(|heading| heading::kind(&heading.name)) == Some(Kind::Cycle)
    };
    if let Some(column) = (0..block.width()).find(is_cycle) {
        let number =
            |row: &Row| row.cells.get(column)?.number(*decimal).map(|number| number as usize);
        return Ok(block.rows.iter().map(number).collect());
    }
    let deformation = series.numbers(pair.deformation)?;
    let ends = crate::curves::branch::reversals(&deformation);
    let branch = |row: usize| ends.partition_point(|&end| end < row).max(1) - 1;
    Ok((0..block.rows.len()).map(|row| Some(branch(row) / 2 + 1)).collect())
}

/// Adds what was found about header, decimal sign and repeats.
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
