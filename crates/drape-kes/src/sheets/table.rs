//! Plain-text tables as instruments and spreadsheets write them.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics, closest};

/// Largest table that is read, in bytes: half a million points.
///
/// A curve has some hundred; the limit keeps a wrong path from filling the memory.
const LARGEST: u64 = 32 << 20;

/// Reference to a column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Column {
    /// By its name in the header, without the unit.
    Name(String),
    /// By its number, from 1.
    Number(usize),
}

/// Table of text cells with separators `,` `;` or tab, decimal point or comma, and `#` comments.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    path: PathBuf,
    header: Option<Vec<Heading>>,
    header_line: usize,
    /// Rows of numbers.
    rows: Vec<Row>,
    decimal_comma: bool,
    truncated: Option<usize>,
}

/// Cell of the header: `curvature (1/cm)` or `curvature [1/cm]`.
#[derive(Clone, Debug)]
struct Heading {
    name: String,
    unit: Option<String>,
}

/// Row with its line in the file.
#[derive(Clone, Debug)]
struct Row {
    line: usize,
    cells: Vec<String>,
}

impl Table {
    /// Reads a table from a file.
    pub(crate) fn read(path: &Path) -> Result<Self, Diagnostics> {
        let unreadable = |error: std::io::Error| {
            Diagnostic::new(path, format!("cannot read the file: {error}"))
                .help("check the path and that the file can be read")
        };
        let size = std::fs::metadata(path).map_err(unreadable)?.len();
        if size > LARGEST {
            return Err(Diagnostic::new(path, format!("the file has {size} bytes"))
                .help("a curve has some thousand lines: is this the right file?")
                .into());
        }
        let bytes = std::fs::read(path).map_err(unreadable)?;
        Self::parse(path, &String::from_utf8_lossy(&bytes))
    }

    /// Parses a table; `path` is used in messages only.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Self, Diagnostics> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let separator = separator(text);
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(separator)
            .comment(Some(b'#'))
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| {
                let line = error.position().map_or(1, |position| position.line() as usize);
                Diagnostic::new(path, format!("not a table: {error}")).on_line(line)
            })?;
            let start = record.position().map_or(0, |position| position.byte() as usize);
            let line = line_of_row(text, start);
            if record.iter().any(|cell| !cell.is_empty()) {
                let cells = record.iter().map(str::to_owned).collect();
                rows.push(Row { line, cells });
            }
        }
        let mut table = Self {
            path: path.to_owned(),
            header: None,
            header_line: 0,
            rows,
            decimal_comma: separator != b',',
            truncated: None,
        };
        table.drop_broken_end(text.ends_with('\n'));
        let first_is_header = table
            .rows
            .first()
            .is_some_and(|row| row.cells.iter().all(|cell| table.number(cell).is_none()));
        if first_is_header {
            let Row { line, cells } = table.rows.remove(0);
            table.header_line = line;
            table.header = Some(cells.iter().map(|cell| heading(cell)).collect());
        }
        if table.rows.is_empty() {
            let help = "a curve needs at least two points, one per line";
            return Err(table.finding("the file has no rows of numbers").help(help).into());
        }
        Ok(table)
    }

    /// Leaves out a last row with fewer cells than the first, where the text ends within a line.
    fn drop_broken_end(&mut self, whole: bool) {
        let [first, .., last] = self.rows.as_slice() else {
            return;
        };
        if !whole && last.cells.len() < first.cells.len() {
            self.truncated = Some(last.line);
            self.rows.pop();
        }
    }

    /// Returns the line that was left out because the file ends within it.
    pub(crate) fn truncated(&self) -> Option<usize> {
        self.truncated
    }

    /// Returns the path of the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the index of a column, from 0.
    pub(crate) fn find(&self, column: &Column) -> Result<usize, Diagnostics> {
        match (column, &self.header) {
            (Column::Number(number), _) => {
                let width = self.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
                if (1..=width).contains(number) {
                    return Ok(number - 1);
                }
                let help = format!("columns are counted from 1; this file has {width}");
                Err(self.finding(format!("there is no column {number}")).help(help).into())
            }
            (Column::Name(name), None) => {
                let message = format!("column \"{name}\" is named, but the file has no header");
                let help = "give the column's place instead, counted from 1";
                Err(self.finding(message).help(help).into())
            }
            (Column::Name(name), Some(header)) => {
                let same = |heading: &Heading| heading.name.eq_ignore_ascii_case(name.trim());
                if let Some(index) = header.iter().position(same) {
                    return Ok(index);
                }
                let names: Vec<&str> = header.iter().map(|h| h.name.as_str()).collect();
                let hint = closest(name, names.iter().copied())
                    .map(|close| format!("did you mean `{close}`? "))
                    .unwrap_or_default();
                let help = format!("{hint}columns of the file: {}", names.join(", "));
                let finding = self.finding(format!("there is no column \"{name}\""));
                Err(finding.on_line(self.header_line).help(help).into())
            }
        }
    }

    /// Returns the unit in the header of a column.
    pub(crate) fn unit(&self, column: usize) -> Option<&str> {
        self.header.as_ref()?.get(column)?.unit.as_deref()
    }

    /// Returns the numbers of a column, all finite.
    pub(crate) fn numbers(&self, column: usize) -> Result<Vec<f64>, Diagnostics> {
        self.rows
            .iter()
            .map(|row| {
                let cell = row.cells.get(column).map_or("", String::as_str);
                match self.number(cell) {
                    Some(number) if number.is_finite() => Ok(number),
                    _ => Err(self.not_a_number(row.line, column, cell).into()),
                }
            })
            .collect()
    }

    fn not_a_number(&self, line: usize, column: usize, cell: &str) -> Diagnostic {
        let name = match self.header.as_ref().and_then(|header| header.get(column)) {
            Some(heading) => format!("\"{}\"", heading.name),
            None => (column + 1).to_string(),
        };
        let (message, help) = if cell.is_empty() {
            (format!("column {name} is empty"), "fill the value in or remove the line")
        } else {
            (
                format!("column {name} holds \"{cell}\", which is not a finite number"),
                "correct the value or remove the line; start comments with #",
            )
        };
        Diagnostic::new(&self.path, message).on_line(line).help(help)
    }

    /// Returns a finding about this file.
    pub(crate) fn finding(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(&self.path, message)
    }

    fn number(&self, cell: &str) -> Option<f64> {
        if self.decimal_comma && cell.contains(',') {
            cell.replace(',', ".").parse().ok()
        } else {
            cell.parse().ok()
        }
    }
}

/// Returns the separator of the first line that is neither empty nor a comment.
///
/// Semicolon and tab come before the comma, which may be the decimal sign.
fn separator(text: &str) -> u8 {
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    match first {
        Some(line) if line.contains(';') => b';',
        Some(line) if line.contains('\t') => b'\t',
        _ => b',',
    }
}

/// Returns the line of the row for which the parser began to look at a byte of the text.
///
/// The parser reports its start before the empty lines and comments that it skipped.
fn line_of_row(text: &str, start: usize) -> usize {
    let before = text[..start].matches('\n').count();
    let skipped = text[start..]
        .lines()
        .take_while(|line| line.trim().is_empty() || line.starts_with('#'))
        .count();
    before + skipped + 1
}

/// Splits a header cell into name and unit.
fn heading(cell: &str) -> Heading {
    let bracketed = |open: char, close: char| {
        let inside = cell.strip_suffix(close)?;
        let (name, unit) = inside.split_once(open)?;
        Some(Heading { name: name.trim().to_owned(), unit: Some(unit.trim().to_owned()) })
    };
    bracketed('[', ']')
        .or_else(|| bracketed('(', ')'))
        .unwrap_or_else(|| Heading { name: cell.to_owned(), unit: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(text: &str, column: &Column) -> Result<Vec<f64>, Diagnostics> {
        let table = Table::parse(Path::new("curve.csv"), text)?;
        let index = table.find(column)?;
        table.numbers(index)
    }

    #[test]
    fn the_same_numbers_come_from_every_dialect() {
        let dialects = [
            "strain,force\n0.5,1.25\n1,2\n",
            "\u{feff}strain;force\r\n0,5;1,25\r\n1;2\r\n",
            "# KES FB1\nstrain\tforce\n0,5\t1,25\n\n1,0\t2\n# end\n",
            "strain [%] , force (gf/cm) , note\n0.5 , 1.25 , a\n1 , 2 , b\n",
            "Strain,\"FORCE\"\n\"0.5\",1.25,9\n1,2\n",
        ];
        for text in dialects {
            let force = column(text, &Column::Name("force".to_owned())).unwrap();
            assert_eq!(force, [1.25, 2.0], "{text}");
        }
        assert_eq!(column("0.5,1.25\n1,2\n", &Column::Number(2)).unwrap(), [1.25, 2.0]);
    }

    #[test]
    fn the_header_may_name_the_unit() {
        let table = Table::parse(Path::new("a.csv"), "k [1/cm];m (gf.cm/cm)\n1;2\n").unwrap();
        assert_eq!(table.unit(0), Some("1/cm"));
        assert_eq!(table.unit(1), Some("gf.cm/cm"));
        assert_eq!(table.find(&Column::Name("m".to_owned())), Ok(1));
    }

    #[test]
    fn a_bad_cell_names_its_line_whatever_comes_before_it() {
        let text = "# one\n# two\nk,m\n0,1\n\n0.5,nan\n";
        let error = column(text, &Column::Name("m".to_owned())).unwrap_err();
        assert_eq!(error.0[0].line, Some(6), "{error}");
        let error = column("k,m\n0,1\n0.5,\n", &Column::Name("m".to_owned())).unwrap_err();
        assert_eq!(
            (error.0[0].line, error.0[0].message.as_str()),
            (Some(3), "column \"m\" is empty")
        );
    }

    #[test]
    fn a_missing_column_is_answered_with_the_ones_there_are() {
        let error = column("k,m\n0,1\n", &Column::Name("moment".to_owned())).unwrap_err();
        assert_eq!(error.0[0].help.as_deref(), Some("columns of the file: k, m"));
        assert!(column("k,m\n0,1\n", &Column::Number(3)).is_err());
        assert!(column("0,1\n", &Column::Name("k".to_owned())).is_err());
        assert!(column("k,m\n", &Column::Name("k".to_owned())).is_err());
    }
}
