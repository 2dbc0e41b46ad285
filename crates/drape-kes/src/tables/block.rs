//! Blocks of numbers in a grid, each with its headings, its units and the text above it.

use crate::tables::grid::{Cell, Grid, Row, Separator};
use crate::tables::heading::{self, Heading};
use drape_input::is_unit;

/// Lines of a file that a sheet declares.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lines {
    /// Number of lines to skip at the start.
    pub(crate) skip: usize,
    /// Line of the header; 0 for a file without a header.
    pub(crate) header: Option<usize>,
}

/// Rows of numbers that follow each other, with the text above them.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Sheet of the spreadsheet; empty for a text file.
    pub(crate) sheet: String,
    /// Text above the header, after the block before.
    pub(crate) above: Vec<Row>,
    /// Line of the header.
    pub(crate) header_line: Option<usize>,
    /// Line of the units below the header.
    pub(crate) units_line: Option<usize>,
    /// Headings of the columns; empty without a header.
    pub(crate) headings: Vec<Heading>,
    /// Titles of groups of columns, from the row above the header.
    pub(crate) groups: Vec<String>,
    pub(crate) rows: Vec<Row>,
}

impl Block {
    /// Returns the number of columns.
    pub(crate) fn width(&self) -> usize {
        let rows = self.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        rows.max(self.headings.len())
    }

    /// Returns the columns with numbers in their first rows, and with nothing else in these rows.
    pub(crate) fn number_columns(&self) -> Vec<usize> {
        let mut columns = Vec::new();
        for column in 0..self.width() {
            let first: Vec<&Cell> = self
                .rows
                .iter()
                .take(8)
                .filter_map(|row| row.cells.get(column))
                .filter(|cell| !cell.is_empty())
                .collect();
            if !first.is_empty() && first.iter().all(|cell| cell.is_number()) {
                columns.push(column);
            }
        }
        columns
    }

    /// Returns the name of `column` for messages: its heading, or its number from 1.
    pub(crate) fn column_name(&self, column: usize) -> String {
        match self.headings.get(column).filter(|heading| !heading.name.is_empty()) {
            Some(heading) => format!("\"{}\"", heading.name),
            None => (column + 1).to_string(),
        }
    }

    /// Returns the title of the block: the last line above it that has a single cell, and is
    /// therefore no key with a value. Returns an empty text without such a line.
    pub(crate) fn title(&self) -> String {
        let row = self.above.iter().rev().find(|row| row.filled().count() == 1);
        row.and_then(|row| row.filled().next()).map_or(String::new(), |(_, cell)| cell.text())
    }

    /// Returns the line of the first row of numbers; 0 without rows.
    pub(crate) fn first_line(&self) -> usize {
        self.rows.first().map_or(0, |row| row.line)
    }
}

/// Blocks of a grid, with the lines of the rows of statistics that were skipped.
#[derive(Clone, Debug, Default)]
pub(crate) struct Blocks {
    pub(crate) blocks: Vec<Block>,
    /// Lines of means and deviations below the numbers.
    pub(crate) statistics: Vec<usize>,
}

/// Splits `grid` into blocks. `lines` are the lines that the sheet declares.
pub(crate) fn blocks(grid: &Grid, lines: Lines) -> Blocks {
    let mut found = Blocks::default();
    let mut open = OpenBlock::default();
    let from = lines.header.unwrap_or(0).max(lines.skip + 1);
    for row in grid.rows.iter().filter(|row| row.line >= from) {
        let is_header = lines.header == Some(row.line);

        // A row of numbers above a row of units was text, such as a date.
        if let [only] = &open.rows[..]
            && has_units_in_place(row, only)
        {
            open.above.append(&mut open.rows);
        }

        match row_role(row, open.rows.first(), is_header) {
            RowRole::Numbers => open.rows.push(row.clone()),
            RowRole::Statistics => found.statistics.push(row.line),
            RowRole::Text => {
                open.finish(grid, lines, &mut found);
                open.above.push(row.clone());
            }
        }
    }
    open.finish(grid, lines, &mut found);
    found
}

/// Returns whether `row` has a unit where the row `before`, a date perhaps, has a number.
fn has_units_in_place(row: &Row, before: &Row) -> bool {
    row.numbers() >= 2
        && row.filled().any(|(column, cell)| {
            let number = before.cells.get(column).is_some_and(Cell::is_number);
            number && !cell.is_number() && is_unit(&cell.text())
        })
}

/// Rows of a block that is not complete yet.
#[derive(Default)]
struct OpenBlock {
    above: Vec<Row>,
    rows: Vec<Row>,
}

/// Role of a row in its block.
enum RowRole {
    Numbers,
    /// Mean or deviation of the rows above.
    Statistics,
    Text,
}

/// Returns what `row` holds in a block of a table. `first` is the first row of numbers of the
/// block, or `None` if no row of numbers has come yet.
fn row_role(row: &Row, first: Option<&Row>, is_header: bool) -> RowRole {
    let numbers = row.numbers();
    if is_header || numbers == 0 {
        return RowRole::Text;
    }
    let Some(first) = first else {
        return if numbers >= 2 { RowRole::Numbers } else { RowRole::Text };
    };
    // Text in a column of numbers begins a row of statistics, or the text of the next block.
    let first_filled = row.filled().next();
    let text_over_number = first_filled.filter(|(column, cell)| {
        !cell.is_number() && first.cells.get(*column).is_some_and(Cell::is_number)
    });
    match text_over_number {
        Some((_, cell)) if is_statistic(&cell.text()) => RowRole::Statistics,
        Some(_) => RowRole::Text,
        None => RowRole::Numbers,
    }
}

/// Returns whether `text` names a mean, a deviation or another statistic.
fn is_statistic(text: &str) -> bool {
    const WORDS: [&str; 22] = [
        "mean",
        "average",
        "avg",
        "ave",
        "max",
        "min",
        "maximum",
        "minimum",
        "median",
        "sd",
        "s d",
        "std",
        "std dev",
        "stdev",
        "cv",
        "cv%",
        "cv (%)",
        "mittelwert",
        "moyenne",
        "平均",
        "標準偏差",
        "σ",
    ];
    let text = heading::normal(text);
    WORDS.contains(&text.as_str()) || text.starts_with("standard dev") || text.starts_with("x̄")
}

impl OpenBlock {
    /// Completes the block of the collected rows, if there are any, and adds it to `found`.
    fn finish(&mut self, grid: &Grid, lines: Lines, found: &mut Blocks) {
        if self.rows.is_empty() {
            return;
        }
        let mut block = Block {
            sheet: grid.sheet.clone(),
            above: std::mem::take(&mut self.above),
            header_line: None,
            units_line: None,
            headings: Vec::new(),
            groups: Vec::new(),
            rows: std::mem::take(&mut self.rows),
        };

        if lines.header != Some(0) {
            split_header(&mut block, lines.header, grid.separator == Some(Separator::Space));
        }
        read_unit_columns(&mut block);

        // A block below a title alone has the header of the one above it.
        if block.header_line.is_none()
            && let Some(before) = found.blocks.last()
            && before.width() == block.width()
        {
            block.headings.clone_from(&before.headings);
            block.header_line = before.header_line;
            block.units_line = before.units_line;
        }
        found.blocks.push(block);
    }
}

/// Moves header, units and titles of groups out of the text above `block`. The `declared` line of
/// the header wins. The cells of a `spaced` file are parted by blanks, which may also part the
/// words of a name.
fn split_header(block: &mut Block, declared: Option<usize>, spaced: bool) {
    block.above.retain(|row| !is_rule(row) || declared == Some(row.line));

    // The line above the numbers may hold units.
    let units = match block.above.as_slice() {
        [.., names, units] => Some(units).filter(|units| is_row_of_units(units, Some(names))),
        [units] => Some(units).filter(|units| is_row_of_units(units, None)),
        [] => None,
    };
    let units = units.filter(|row| declared != Some(row.line)).cloned();
    if units.is_some() {
        block.above.pop();
    }

    // The line above the units holds the names.
    let header = block.above.last().filter(|row| match declared {
        Some(line) => row.line == line,
        None => is_row_of_names(row, block.rows.first()),
    });
    let header = header.map(|row| match block.rows.first() {
        Some(first) if spaced && row.cells.len() > first.cells.len() => join_words(row),
        _ => row.clone(),
    });
    if let Some(header) = &header {
        block.above.pop();
        block.header_line = Some(header.line);
        block.headings = header.cells.iter().map(|cell| Heading::parse(&cell.text())).collect();
    }
    if let Some(units) = &units {
        if header.is_some() {
            block.units_line = Some(units.line);
        } else {
            block.header_line = Some(units.line);
        }
        block.headings.resize(block.headings.len().max(units.cells.len()), Heading::default());
        for (column, cell) in units.filled() {
            block.headings[column].unit = Some(without_brackets(&cell.text()).to_owned());
        }
    }

    // A shorter line of texts above the names holds titles of groups of columns.
    if let (Some(header), Some(above)) = (&header, block.above.last())
        && above.line + 1 == header.line
        && above.filled().count() >= 2
        && above.numbers() == 0
        && !above.filled().any(|(_, cell)| cell.text().ends_with(':'))
        && above.filled().count() < header.filled().count()
    {
        block.groups = fill_groups(above, block.headings.len());
        block.above.pop();
    }
}

/// Returns whether `row` is a line that is drawn with signs.
fn is_rule(row: &Row) -> bool {
    row.filled().all(|(_, cell)| cell.text().chars().all(|letter| "-=_+|~".contains(letter)))
}

/// Moves units out of columns that hold only the unit of the column before: `12.5, N, 0.3, mm`.
fn read_unit_columns(block: &mut Block) {
    for column in 1..block.width() {
        let mut cells = block.rows.iter().map(|row| row.cells.get(column));
        let Some(Some(Cell::Text(unit))) = cells.next() else { continue };
        let unit = unit.clone();
        let is_repeated = cells.all(|cell| matches!(cell, Some(Cell::Text(text)) if *text == unit));
        if !is_unit(&unit) || !is_repeated {
            continue;
        }
        block.headings.resize(block.headings.len().max(block.width()), Heading::default());
        let heading = &mut block.headings[column - 1];
        if heading.unit.is_none() {
            heading.unit = Some(unit);
        }
    }
}

/// Joins the words of `row` that blanks have parted: a name ends with its unit in brackets.
fn join_words(row: &Row) -> Row {
    let mut names: Vec<String> = vec![String::new()];
    for (_, cell) in row.filled() {
        let word = cell.text();
        let name = names.last_mut().expect("there is always a last name");
        name.push_str(if name.is_empty() { "" } else { " " });
        name.push_str(&word);
        if word.ends_with([')', ']', '）', '%']) {
            names.push(String::new());
        }
    }
    names.retain(|name| !name.is_empty());
    Row { line: row.line, cells: names.into_iter().map(Cell::Text).collect() }
}

/// Returns the titles of groups in `row`, repeated over each of their columns, for `width` columns.
fn fill_groups(row: &Row, width: usize) -> Vec<String> {
    let mut title = String::new();
    let mut groups = Vec::with_capacity(width);
    for column in 0..width {
        if let Some(cell) = row.cells.get(column).filter(|cell| !cell.is_empty()) {
            title = cell.text();
        }
        groups.push(title.clone());
    }
    groups
}

/// Returns the unit `text` without the brackets around it.
pub(crate) fn without_brackets(text: &str) -> &str {
    let text = text.trim();
    const PAIRS: [(char, char); 5] =
        [('(', ')'), ('[', ']'), ('（', '）'), ('<', '>'), ('［', '］')];
    PAIRS
        .into_iter()
        .find_map(|(open, close)| text.strip_prefix(open)?.strip_suffix(close))
        .map_or(text, str::trim)
}

/// Returns whether every cell of `row` is a unit. Below a row of `names` some units may be unknown:
/// only the columns of unknown units are of no use.
fn is_row_of_units(row: &Row, names: Option<&Row>) -> bool {
    /// Least number of known units in a row that has unknown units.
    const KNOWN_UNITS_LEAST: usize = 2;

    let (known, others): (Vec<_>, Vec<_>) = row.filled().partition(|(_, cell)| is_known_unit(cell));
    let unknown: Vec<_> = others
        .into_iter()
        .filter(|(_, cell)| !["-", "()", "[-]", "(-)", "–"].contains(&cell.text().trim()))
        .collect();
    if unknown.is_empty() {
        return row.filled().count() > 0;
    }
    known.len() >= KNOWN_UNITS_LEAST
        && unknown.len() <= known.len()
        && unknown.iter().all(|&(column, cell)| {
            may_be_unknown_unit(cell, names.and_then(|names| names.cells.get(column)))
        })
}

/// Returns whether `cell` is a known unit, in brackets or not.
fn is_known_unit(cell: &Cell) -> bool {
    let text = cell.text();
    let text = text.trim();
    // A closing bracket belongs to a unit with a bracket inside, as in gf/(cm.deg).
    let is_second = without_brackets(text).eq_ignore_ascii_case("sec");
    is_unit(text) || is_unit(without_brackets(text)) || is_second
}

/// Returns whether `cell` below the cell `name` may be an unknown unit: a short word that is no
/// name of a column.
fn may_be_unknown_unit(cell: &Cell, name: Option<&Cell>) -> bool {
    /// Largest number of letters of an unknown unit. A longer text is a name.
    const LONGEST: usize = 12;

    let text = cell.text();
    let letters = text.chars().count();
    name.is_some_and(|name| !name.is_empty() && !name.is_number())
        && !cell.is_number()
        && letters <= LONGEST
        && !without_brackets(&text).contains(' ')
        && heading::kind(&text).is_none_or(|_| letters == 1)
}

/// Returns whether `row` names the columns of the numbers in the row `first`: text over at least
/// two numbers, and nothing but text.
fn is_row_of_names(row: &Row, first: Option<&Row>) -> bool {
    if row.filled().any(|(_, cell)| cell.is_number()) {
        return false;
    }
    let over_numbers = row.filled().filter(|(column, _)| {
        first.is_some_and(|first| first.cells.get(*column).is_some_and(Cell::is_number))
    });
    over_numbers.count() >= 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::grid::separator;

    fn of(text: &str, lines: Lines) -> Vec<Block> {
        let rows = separator(text).split(text).expect("it splits");
        blocks(&Grid { rows, ..Grid::default() }, lines).blocks
    }

    #[test]
    fn a_block_has_its_header_its_units_and_what_is_above() {
        let text = "Method;KES FB1\nGauge length;50;mm\n\nTime;Extension;Load\n(s);(mm);(N)\n0;0;0\n1;0,5;2\n";
        let [block] = &of(text, Lines::default())[..] else { panic!("not one block") };
        assert_eq!((block.header_line, block.units_line, block.rows.len()), (Some(4), Some(5), 2));
        assert_eq!(block.headings[2], Heading { name: "Load".into(), unit: Some("N".into()) });
        assert_eq!(block.above.len(), 2);
    }

    #[test]
    fn tests_below_each_other_are_blocks_with_titles() {
        let text = "Specimen 1\nExtension (mm),Load (N)\n0,0\n1,2\nSpecimen 2\nExtension (mm),Load (N)\n0,0\n1,3\nMean,2.5\n";
        let found = of(text, Lines::default());
        let titles: Vec<String> = found.iter().map(Block::title).collect();
        assert_eq!(titles, ["Specimen 1", "Specimen 2"]);
        assert_eq!(found[1].rows.len(), 2, "the mean is no point");
    }

    #[test]
    fn groups_of_columns_have_their_titles() {
        let text = "Warp 1,,Warp 2,\nStrain (%),Force (gf/cm),Strain (%),Force (gf/cm)\n0,0,0,0\n1,2,1,3\n";
        let [block] = &of(text, Lines::default())[..] else { panic!("not one block") };
        assert_eq!(block.groups, ["Warp 1", "Warp 1", "Warp 2", "Warp 2"]);
    }

    #[test]
    fn a_unit_that_is_not_known_costs_its_column_only() {
        for unit in ["Nmm/rev", "Ohm", "1/min²", "灰度"] {
            let text = format!("Time,Weg,Kraft,Sonst\ns,mm,N,{unit}\n0,0,0,1.5\n1,0.5,2,1.5\n");
            let [block] = &of(&text, Lines::default())[..] else { panic!("not one block") };
            assert_eq!((block.header_line, block.units_line), (Some(1), Some(2)), "{unit}");
            assert_eq!(block.headings[2].unit.as_deref(), Some("N"), "{unit}");
        }
        // A row of names below a title is no row of units.
        let text = "Test,of,cotton\nF,mm,x\n0,0,0\n1,0.5,2\n";
        let [block] = &of(text, Lines::default())[..] else { panic!("not one block") };
        assert_eq!((block.header_line, block.units_line), (Some(2), None));
    }

    #[test]
    fn declared_lines_stand_above_what_is_found() {
        let text = "1,2\n3,4\n5,6\n7,8\n";
        let header = Lines { header: Some(2), skip: 0 };
        let [block] = &of(text, header)[..] else { panic!("not one block") };
        assert_eq!((block.headings[0].name.as_str(), block.rows.len()), ("3", 2));
        let [block] = &of(text, Lines { skip: 3, header: None })[..] else {
            panic!("not one block")
        };
        assert_eq!(block.rows.len(), 1);
    }

    #[test]
    fn columns_of_numbers_may_have_gaps_but_no_words() {
        let text = "Strain,Note,Empty,Load\n1,first,,3\n2,4,,\n3,5,,7\n";
        let [block] = &of(text, Lines::default())[..] else { panic!("not one block") };
        assert_eq!(block.number_columns(), [0, 3]);
    }
}
