//! Grid of cells: a text file split at its separators, or a sheet of a spreadsheet.

use crate::tables::number::scattered::scattered;
use crate::tables::number::{self, Decimal, Evidence};
use drape_input::is_unit;

/// Largest number of cells of a table, or of all sheets of a spreadsheet, the empty ones to the
/// left of others included. Larger tables are no results of a laboratory.
pub(crate) const CELLS_MAX: usize = 4_000_000;

/// Cell of a table.
#[cfg_attr(not(feature = "spreadsheets"), expect(dead_code, reason = "cells of text only"))]
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    /// Text as written, without blanks around it; empty for an empty cell.
    Text(String),
    /// Number in a spreadsheet.
    Number(f64),
    /// Number in a spreadsheet that is displayed in percent, in percent.
    Percent(f64),
}

impl Cell {
    /// Returns whether the cell is empty.
    pub(crate) fn is_empty(&self) -> bool {
        matches!(self, Self::Text(text) if text.is_empty())
    }

    /// Returns the cell as a text, for names and messages.
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
            Self::Percent(number) => format!("{} %", drape_input::figure(*number)),
        }
    }

    /// Returns whether the cell is a number, with either decimal sign, with or without a unit.
    pub(crate) fn is_number(&self) -> bool {
        match self {
            Self::Text(text) => number::evidence(split_unit(text).0).is_some(),
            Self::Number(_) | Self::Percent(_) => true,
        }
    }

    /// Returns whether the cell is a number, alone or with its scatter: `0.085 ± 0.004`.
    pub(crate) fn is_value(&self) -> bool {
        if self.is_number() {
            return true;
        }
        let Self::Text(text) = self else { return false };
        let behind_sign = text.strip_prefix('±').map(str::trim);
        scattered(text).is_some() || behind_sign.and_then(number::evidence).is_some()
    }

    /// Returns the number of the cell with the sign `decimal`, without its unit.
    pub(crate) fn number(&self, decimal: Decimal) -> Option<f64> {
        match self {
            Self::Text(text) => number::parse(split_unit(text).0, decimal),
            Self::Number(number) | Self::Percent(number) => Some(*number),
        }
    }

    /// Returns the unit behind the number of the cell; empty without a unit.
    pub(crate) fn unit(&self) -> &str {
        match self {
            Self::Text(text) => split_unit(text).1,
            Self::Number(_) => "",
            Self::Percent(_) => "%",
        }
    }

    /// Returns the evidence of the cell for a decimal sign; `None` for a cell without a written
    /// number.
    pub(crate) fn evidence(&self) -> Option<Evidence> {
        match self {
            Self::Text(text) => number::evidence(split_unit(text).0),
            Self::Number(_) | Self::Percent(_) => None,
        }
    }
}

/// Splits the `text` of a cell into its number and the unit behind it: `0.5 mm`, `12 %`. Every
/// other text is returned whole, with an empty unit.
fn split_unit(text: &str) -> (&str, &str) {
    let begins_as_number =
        text.trim_start().starts_with(|letter| is_figure(letter) || "+-−.,".contains(letter));
    // Most cells are numbers alone: without a sign or a letter of a unit there is no unit.
    let has_unit_letter = text.contains(|letter: char| {
        (letter.is_alphabetic() && !matches!(letter, 'e' | 'E')) || "%％°".contains(letter)
    });
    if !begins_as_number || !has_unit_letter || number::evidence(text).is_some() {
        return (text, "");
    }

    // Units have digits too, and an exponent has a letter: the longest unit behind a number wins.
    for (place, letter) in text.char_indices() {
        if !(is_figure(letter) || letter == '.') {
            continue;
        }
        let (number, unit) = text.split_at(place + letter.len_utf8());
        if number::evidence(number).is_some() && is_unit(unit.trim()) {
            return (number, unit.trim());
        }
    }
    (text, "")
}

/// Returns whether `letter` is a digit, and no exponent of a unit.
fn is_figure(letter: char) -> bool {
    letter.is_numeric() && !"²³¹".contains(letter)
}

/// Row with its line in the file, or its row in the spreadsheet, from 1.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) line: usize,
    pub(crate) cells: Vec<Cell>,
}

impl Row {
    /// Returns the cells that are not empty, with their columns.
    pub(crate) fn filled(&self) -> impl Iterator<Item = (usize, &Cell)> {
        self.cells.iter().enumerate().filter(|(_, cell)| !cell.is_empty())
    }

    /// Returns the number of cells that hold numbers. In a row with other cells a number with a
    /// unit is not counted, because it is a setting, such as `Gauge length; 50 mm`.
    pub(crate) fn numbers(&self) -> usize {
        let filled = self.filled().count();
        let numbers: Vec<&Cell> =
            self.filled().map(|(_, cell)| cell).filter(|cell| cell.is_number()).collect();
        if numbers.len() == filled {
            return filled;
        }
        numbers.iter().filter(|cell| ["", "%"].contains(&cell.unit())).count()
    }
}

/// Rows of one table file, or of one sheet of a spreadsheet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    /// Name of the sheet of a spreadsheet; empty for a text file.
    pub(crate) sheet: String,
    pub(crate) rows: Vec<Row>,
    /// Whether the text ends within a line.
    pub(crate) breaks_off: bool,
    /// Separator of a text file.
    pub(crate) separator: Option<Separator>,
}

/// Sign between the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
pub(crate) enum Separator {
    #[serde(rename = "tab")]
    Tab,
    #[serde(rename = ";")]
    Semicolon,
    #[serde(rename = ",")]
    Comma,
    #[serde(rename = "|")]
    Bar,
    /// Blanks and tabs, one or more.
    #[serde(rename = "space")]
    Space,
}

impl Separator {
    /// Separators. The first of equally good separators is preferred.
    pub(crate) const ALL: [Self; 5] =
        [Self::Tab, Self::Semicolon, Self::Comma, Self::Bar, Self::Space];

    /// Returns the name in sheets and messages, such as `"tab"`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Tab => "tab",
            Self::Semicolon => ";",
            Self::Comma => ",",
            Self::Bar => "|",
            Self::Space => "space",
        }
    }

    /// Returns whether `text` may have more than [`CELLS_MAX`] cells, with whichever separator.
    pub(crate) fn may_exceed_cells(text: &str) -> bool {
        // A cell and its separator have one letter or more.
        text.len() > CELLS_MAX
            && (['\t', ';', ',', '|'].iter().any(|sign| text.matches(*sign).count() > CELLS_MAX)
                || text.split_whitespace().count() > CELLS_MAX)
    }

    /// Splits `text` into rows, without empty lines and comments. `Err` holds the line that cannot
    /// be split.
    pub(crate) fn split(self, text: &str) -> Result<Vec<Row>, BrokenRow> {
        match self {
            Self::Tab => split_delimited(text, b'\t'),
            Self::Semicolon => split_delimited(text, b';'),
            Self::Comma => split_delimited(text, b','),
            Self::Bar => split_delimited(text, b'|'),
            Self::Space => Ok(text.lines().enumerate().filter_map(split_at_blanks).collect()),
        }
    }
}

/// Line that cannot be split, with the reason.
#[derive(Clone, Debug)]
pub(crate) struct BrokenRow {
    pub(crate) line: usize,
    pub(crate) reason: String,
}

/// Splits `text` at the character `delimiter`. Cells may stand in quotes.
fn split_delimited(text: &str, delimiter: u8) -> Result<Vec<Row>, BrokenRow> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());

    let mut rows = Vec::new();
    let (mut counted, mut lines) = (0, 0);
    for record in reader.records() {
        let record = record.map_err(|error| BrokenRow {
            line: error.position().map_or(1, |position| position.line() as usize),
            reason: error.to_string(),
        })?;
        // The parser reports the start of a record before the empty lines and comments above it.
        let start = record.position().map_or(0, |position| position.byte() as usize);
        lines += text[counted..start].matches('\n').count();
        counted = start;
        let skipped = text[start..].lines().take_while(|line| is_skipped(line)).count();
        let cells: Vec<Cell> = record.iter().map(|cell| Cell::Text(on_one_line(cell))).collect();
        if cells.iter().any(|cell| !cell.is_empty()) {
            rows.push(Row { line: lines + skipped + 1, cells });
        }
    }
    Ok(rows)
}

/// Returns whether `line` is empty or a comment.
fn is_skipped(line: &str) -> bool {
    line.trim().is_empty() || line.starts_with('#')
}

/// Returns the text of a cell on one line, with single blanks.
fn on_one_line(cell: &str) -> String {
    if cell.contains(['\n', '\r', '\u{3000}']) || cell.contains("  ") {
        cell.split_whitespace().collect::<Vec<_>>().join(" ")
    } else {
        cell.trim().to_owned()
    }
}

/// Splits a line at its blanks. A line of numbers is split at every blank. Another line is split at
/// two or more blanks, which keep `Extension (mm)` whole.
fn split_at_blanks((index, line): (usize, &str)) -> Option<Row> {
    if is_skipped(line) {
        return None;
    }
    let words: Vec<String> =
        line.split_whitespace().map(|word| word.trim_matches('"').to_owned()).collect();
    let numbers =
        words.iter().filter(|word| number::evidence(split_unit(word).0).is_some()).count();
    let cells = if numbers >= 2 || 2 * numbers > words.len() {
        words
    } else {
        let wide: Vec<String> = line
            .split('\t')
            .flat_map(|part| part.split("  "))
            .map(str::trim)
            .filter(|part| !part.is_empty())
            .map(|part| part.trim_matches('"').to_owned())
            .collect();
        if wide.len() > 1 { wide } else { join_units(words) }
    };
    Some(Row { line: index + 1, cells: cells.into_iter().map(Cell::Text).collect() })
}

/// Joins `words` in brackets with the word before: `Extension` and `(mm)`.
fn join_units(words: Vec<String>) -> Vec<String> {
    let mut cells: Vec<String> = Vec::new();
    for word in words {
        match cells.last_mut() {
            Some(last) if word.starts_with(['(', '[', '<', '（']) || is_open(last) => {
                last.push(' ');
                last.push_str(&word);
            }
            _ => cells.push(word),
        }
    }
    cells
}

/// Returns whether `text` has a bracket that is not closed.
fn is_open(text: &str) -> bool {
    text.matches(['(', '[', '（']).count() > text.matches([')', ']', '）']).count()
}

/// Returns whether most lines of `text` have a tab, a semicolon or a bar.
fn has_separator(text: &str) -> bool {
    let lines: Vec<&str> = text.lines().filter(|line| !is_skipped(line)).collect();
    ['\t', ';', '|'].iter().any(|sign| {
        2 * lines.iter().filter(|line| line.trim().contains(*sign)).count() > lines.len()
    })
}

/// Returns whether most lines of `text` are a key with its value: `W: 12.4 mg/cm2`.
fn has_keys(text: &str) -> bool {
    let lines: Vec<&str> = text.lines().filter(|line| !is_skipped(line)).collect();
    2 * lines.iter().filter(|line| is_key_with_value(line)).count() > lines.len()
}

/// Returns whether `line` is a key with its value.
fn is_key_with_value(line: &str) -> bool {
    let Some((key, value)) = line.split_once([':', '=']) else { return false };
    let is_name = key.trim_start().starts_with(char::is_alphanumeric);
    let is_number = value.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '-');
    is_name && number::evidence(key).is_none() && is_number && !line.contains([';', '\t', '|'])
}

/// Returns the separator that splits most lines of `text` into numbers, and into nothing but
/// numbers.
pub(crate) fn separator(text: &str) -> Separator {
    /// Number of lines that are examined.
    const LINES_EXAMINED: usize = 2000;

    let end = text.match_indices('\n').nth(LINES_EXAMINED).map_or(text.len(), |(end, _)| end);
    let start = &text[..end];
    // A key with its value is one cell: its blanks and commas part nothing.
    if has_keys(start) {
        return Separator::Tab;
    }
    // If no row has two numbers, names with one number each count: a table of results.
    best_separator(start, 2).or_else(|| best_separator(start, 1)).unwrap_or(Separator::Comma)
}

/// Returns the separator with the best score in `text`; `None` if no line has `least` numbers.
fn best_separator(text: &str, least: usize) -> Option<Separator> {
    let mut best = (Separator::Comma, 0.0);
    for separator in Separator::ALL {
        // Blanks stand within the cells of lines that another sign parts.
        if separator == Separator::Space && best.1 > 0.0 && has_separator(text) {
            continue;
        }
        let score = score(text, separator, least);
        if score > best.1 * (1.0 + 1e-9) {
            best = (separator, score);
        }
    }
    (best.1 > 0.0).then_some(best.0)
}

/// Returns the sum of the shares of numbers in the rows into which `separator` splits `text`. A row
/// counts only if it has at least `least` numbers.
fn score(text: &str, separator: Separator, least: usize) -> f64 {
    let mut score = 0.0;
    for row in separator.split(text).unwrap_or_default() {
        let filled = row.filled().count();
        let scattered =
            row.filled().filter(|(_, cell)| !cell.is_number() && cell.is_value()).count();
        let numbers = row.numbers() + scattered;
        let is_split = row.filled().all(|(_, cell)| {
            let text = cell.text();
            !(text.contains('\t') || (separator != Separator::Tab && text.contains([';', '|'])))
        });
        if numbers >= least && filled >= 2 && is_split {
            score += numbers as f64 / filled as f64;
        }
    }
    score
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(rows: &[Row]) -> Vec<Vec<String>> {
        rows.iter().map(|row| row.cells.iter().map(Cell::text).collect()).collect()
    }

    #[test]
    fn the_separator_is_the_one_that_leaves_numbers() {
        let cases = [
            ("a,b\n0.5,1.25\n1,2\n", Separator::Comma),
            ("a;b\n0,5;1,25\n1;2\n", Separator::Semicolon),
            ("Width, mm\t50\na\tb\n0,5\t1,25\n1,0\t2\n", Separator::Tab),
            ("Load cell; 1\n0,5 1,25\n1,0   2\n", Separator::Space),
            ("a|b\n0.5|1.25\n", Separator::Bar),
            ("\"0,5\",\"1,25\"\n\"1,5\",\"2,25\"\n", Separator::Comma),
            ("a,b\n0.5 ± 0.1,1.25 (0.2)\n", Separator::Comma),
            ("a;b\n0,5±0,1;1,25±0,2\n3,5;\n", Separator::Semicolon),
            ("a\tb\tc\nWarp 1\t0.5\t0.7\nWarp 2\t0.6\t0.8\n", Separator::Tab),
            ("a;b;c\nB;0,112 ± 0,003;0,061 ± 0,002\n", Separator::Semicolon),
            ("nothing\n", Separator::Comma),
        ];
        for (text, found) in cases {
            assert_eq!(separator(text), found, "{text}");
        }
    }

    #[test]
    fn names_with_blanks_stay_whole_between_blanks() {
        let text = "Extension (mm) Load (N)\n0.5   1.25\n";
        let rows = Separator::Space.split(text).expect("it splits");
        assert_eq!(texts(&rows), [vec!["Extension (mm)", "Load (N)"], vec!["0.5", "1.25"]]);
        let text = "  Standard travel   Standard force\n";
        let rows = Separator::Space.split(text).expect("it splits");
        assert_eq!(texts(&rows), [vec!["Standard travel", "Standard force"]]);
    }

    #[test]
    fn lines_are_counted_past_comments_and_quoted_ends_of_lines() {
        let text = "# one\n\n\"Extension\n(mm)\",Load\n\n0,1\n# two\n1,2\n";
        let rows = Separator::Comma.split(text).expect("it splits");
        let lines: Vec<usize> = rows.iter().map(|row| row.line).collect();
        assert_eq!(lines, [3, 6, 8]);
        assert_eq!(rows[0].cells[0].text(), "Extension (mm)");
    }
}
