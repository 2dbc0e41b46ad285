//! Grid of cells: a text file split at its separators, or a sheet of a spreadsheet.

use crate::tables::number::scattered::scattered;
use crate::tables::number::{self, Decimal, Evidence};
use drape_input::is_unit;

/// Cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    /// Text as written, without blanks around; empty where there is none.
    Text(String),
    /// Number of a spreadsheet.
    Number(f64),
    /// Number of a spreadsheet that is shown in percent, in percent.
    Percent(f64),
}

impl Cell {
    /// Returns whether nothing is written.
    pub(crate) fn is_empty(&self) -> bool {
        matches!(self, Self::Text(text) if text.is_empty())
    }

    /// Returns the cell as text, for names and messages.
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
            Self::Percent(number) => format!("{} %", drape_input::figure(*number)),
        }
    }

    /// Returns whether the cell is a number, whatever its decimal sign, with a unit or without.
    pub(crate) fn is_number(&self) -> bool {
        match self {
            Self::Text(text) => number::evidence(parted(text).0).is_some(),
            Self::Number(_) | Self::Percent(_) => true,
        }
    }

    /// Returns whether the cell is a number, alone or with its scatter: `0.085 ± 0.004`.
    pub(crate) fn is_value(&self) -> bool {
        let is_scattered = |text: &str| {
            let behind_sign = text.strip_prefix('±').map(str::trim);
            scattered(text).is_some() || behind_sign.and_then(number::evidence).is_some()
        };
        self.is_number() || matches!(self, Self::Text(text) if is_scattered(text))
    }

    /// Returns the number of the cell, without its unit.
    pub(crate) fn number(&self, decimal: Decimal) -> Option<f64> {
        match self {
            Self::Text(text) => number::parse(parted(text).0, decimal),
            Self::Number(number) | Self::Percent(number) => Some(*number),
        }
    }

    /// Returns the unit behind the number of the cell; empty where there is none.
    pub(crate) fn unit(&self) -> &str {
        match self {
            Self::Text(text) => parted(text).1,
            Self::Number(_) => "",
            Self::Percent(_) => "%",
        }
    }

    /// Returns the decimal sign that the cell speaks for.
    pub(crate) fn evidence(&self) -> Option<Evidence> {
        match self {
            Self::Text(text) => number::evidence(parted(text).0),
            Self::Number(_) | Self::Percent(_) => None,
        }
    }
}

/// Parts a cell into its number and the unit behind it: `0.5 mm`, `12 %`. A text that is anything
/// else stays whole, with an empty unit.
fn parted(text: &str) -> (&str, &str) {
    let is_figure = |letter: char| letter.is_numeric() && !"²³¹".contains(letter);
    let starts =
        text.trim_start().starts_with(|letter| is_figure(letter) || "+-−.,".contains(letter));
    // Most cells are bare numbers: without a sign or a letter of a unit there is nothing to part.
    let of_unit = |letter: char| {
        (letter.is_alphabetic() && !matches!(letter, 'e' | 'E')) || "%％°".contains(letter)
    };
    if !starts || !text.contains(of_unit) || number::evidence(text).is_some() {
        return (text, "");
    }
    // Units have digits too, and an exponent has a letter: the shortest unit behind a number is
    // taken.
    let ends = text.char_indices().filter(|&(_, letter)| is_figure(letter) || letter == '.');
    let split = |(place, letter): (usize, char)| {
        let (number, unit) = text.split_at(place + letter.len_utf8());
        let unit = unit.trim();
        (number::evidence(number).is_some() && is_unit(unit)).then_some((number, unit))
    };
    ends.filter_map(split).next().unwrap_or((text, ""))
}

/// Row with its line in the file, or its row in the spreadsheet, from 1.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) line: usize,
    pub(crate) cells: Vec<Cell>,
}

impl Row {
    /// Returns the cells that hold something.
    pub(crate) fn filled(&self) -> impl Iterator<Item = (usize, &Cell)> {
        self.cells.iter().enumerate().filter(|(_, cell)| !cell.is_empty())
    }

    /// Returns the number of cells that hold numbers. A number with a unit counts where the row
    /// holds numbers only; elsewhere it is a setting, such as `Gauge length; 50 mm`.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Separator {
    Tab,
    Semicolon,
    Comma,
    Bar,
    /// Blanks and tabs, one or more.
    Space,
}

impl Separator {
    /// Separators, in the order in which equals are preferred.
    pub(crate) const ALL: [Self; 5] =
        [Self::Tab, Self::Semicolon, Self::Comma, Self::Bar, Self::Space];

    /// Returns the name used in sheets and messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Tab => "tab",
            Self::Semicolon => ";",
            Self::Comma => ",",
            Self::Bar => "|",
            Self::Space => "space",
        }
    }

    /// Splits a text into rows, without empty lines and comments.
    pub(crate) fn split(self, text: &str) -> Result<Vec<Row>, BrokenRow> {
        match self {
            Self::Tab => delimited(text, b'\t'),
            Self::Semicolon => delimited(text, b';'),
            Self::Comma => delimited(text, b','),
            Self::Bar => delimited(text, b'|'),
            Self::Space => Ok(text.lines().enumerate().filter_map(blank_separated).collect()),
        }
    }
}

/// Line that cannot be split, with the reason.
#[derive(Clone, Debug)]
pub(crate) struct BrokenRow {
    pub(crate) line: usize,
    pub(crate) reason: String,
}

/// Splits a text at one character, with cells in quotes.
fn delimited(text: &str, delimiter: u8) -> Result<Vec<Row>, BrokenRow> {
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
        // The parser reports its start before the empty lines and comments that it skipped.
        let start = record.position().map_or(0, |position| position.byte() as usize);
        lines += text[counted..start].matches('\n').count();
        counted = start;
        let skipped = text[start..].lines().take_while(|line| is_skipped(line)).count();
        let cells: Vec<Cell> = record.iter().map(|cell| Cell::Text(tidy(cell))).collect();
        if cells.iter().any(|cell| !cell.is_empty()) {
            rows.push(Row { line: lines + skipped + 1, cells });
        }
    }
    Ok(rows)
}

fn is_skipped(line: &str) -> bool {
    line.trim().is_empty() || line.starts_with('#')
}

/// Returns a cell on one line, without a blank more than needed.
fn tidy(cell: &str) -> String {
    if cell.contains(['\n', '\r', '\u{3000}']) || cell.contains("  ") {
        cell.split_whitespace().collect::<Vec<_>>().join(" ")
    } else {
        cell.trim().to_owned()
    }
}

/// Splits a line at its blanks: at every one where all of its words are numbers, else at those of
/// two or more, which leave `Extension (mm)` whole.
fn blank_separated((index, line): (usize, &str)) -> Option<Row> {
    if is_skipped(line) {
        return None;
    }
    let unquoted = |word: &str| word.trim_matches('"').to_owned();
    let words: Vec<String> = line.split_whitespace().map(unquoted).collect();
    let is_number = |word: &String| number::evidence(parted(word).0).is_some();
    let numbers = words.iter().filter(|word| is_number(word)).count();
    let cells = if numbers >= 2 || 2 * numbers > words.len() {
        words
    } else {
        let wide: Vec<String> = line
            .split('\t')
            .flat_map(|part| part.split("  "))
            .map(str::trim)
            .filter(|part| !part.is_empty())
            .map(unquoted)
            .collect();
        if wide.len() > 1 { wide } else { with_their_units(words) }
    };
    Some(Row { line: index + 1, cells: cells.into_iter().map(Cell::Text).collect() })
}

/// Joins words in brackets with the word before: `Extension` and `(mm)`.
fn with_their_units(words: Vec<String>) -> Vec<String> {
    let mut cells: Vec<String> = Vec::new();
    for word in words {
        match cells.last_mut() {
            Some(last) if word.starts_with(['(', '[', '<', '（']) || open(last) => {
                last.push(' ');
                last.push_str(&word);
            }
            _ => cells.push(word),
        }
    }
    cells
}

/// Returns whether a bracket is not closed.
fn open(text: &str) -> bool {
    let count = |brackets: [char; 3]| text.matches(brackets).count();
    count(['(', '[', '（']) > count([')', ']', '）'])
}

/// Returns whether most lines have a sign between cells that stands nowhere else.
fn is_parted(text: &str) -> bool {
    let lines: Vec<&str> = text.lines().filter(|line| !is_skipped(line)).collect();
    let parted = |sign: char| lines.iter().filter(|line| line.trim().contains(sign)).count();
    ['\t', ';', '|'].iter().any(|sign| 2 * parted(*sign) > lines.len())
}

/// Returns whether most lines are a key with its value: `W: 12.4 mg/cm2`.
fn are_keys(text: &str) -> bool {
    let is_key = |line: &&str| {
        let Some((key, value)) = line.split_once([':', '=']) else { return false };
        let is_name = key.trim_start().starts_with(char::is_alphanumeric);
        let starts = value.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '-');
        is_name && number::evidence(key).is_none() && starts && !line.contains([';', '\t', '|'])
    };
    let lines: Vec<&str> = text.lines().filter(|line| !is_skipped(line)).collect();
    2 * lines.iter().filter(|line| is_key(line)).count() > lines.len()
}

/// Lines that the separator is looked for in: more would only cost time.
const LINES_LOOKED_AT: usize = 2000;

/// Returns the separator that splits most lines into numbers, and nothing but numbers.
pub(crate) fn separator(text: &str) -> Separator {
    let end = text.match_indices('\n').nth(LINES_LOOKED_AT).map_or(text.len(), |(end, _)| end);
    // Lines of a key and its value are whole: their blanks and commas part nothing.
    if are_keys(&text[..end]) {
        return Separator::Tab;
    }
    // Names with one number each, a table of results, count where no row has two numbers.
    let score = |separator: Separator, least: usize| -> f64 {
        let rows = separator.split(&text[..end]).unwrap_or_default();
        let is_split = |row: &Row| {
            let other = |cell: &Cell| {
                let text = cell.text();
                text.contains('\t') || (separator != Separator::Tab && text.contains([';', '|']))
            };
            row.filled().all(|(_, cell)| !other(cell))
        };
        let share = |row: &Row| {
            let scattered = |(_, cell): &(usize, &Cell)| !cell.is_number() && cell.is_value();
            let numbers = row.numbers() + row.filled().filter(scattered).count();
            let filled = row.filled().count();
            let counts = numbers >= least && filled >= 2 && is_split(row);
            if counts { numbers as f64 / filled as f64 } else { 0.0 }
        };
        rows.iter().map(share).sum()
    };
    let best = |least: usize| {
        let mut best = (Separator::Comma, 0.0);
        for separator in Separator::ALL {
            // Blanks are within the cells of lines that another sign parts.
            if separator == Separator::Space && best.1 > 0.0 && is_parted(&text[..end]) {
                continue;
            }
            let score = score(separator, least);
            if score > best.1 * (1.0 + 1e-9) {
                best = (separator, score);
            }
        }
        (best.1 > 0.0).then_some(best.0)
    };
    best(2).or_else(|| best(1)).unwrap_or(Separator::Comma)
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
