//! Sheets of a spreadsheet file: `.xlsx`, `.xlsm`, `.xlsb`, `.xls`, `.ods`.

use std::path::Path;

use crate::tables::grid::Grid;

/// Endings of the names of spreadsheets.
const ENDINGS: [&str; 5] = ["xlsx", "xlsm", "xlsb", "xls", "ods"];

/// Returns whether a file is a spreadsheet, by the ending of `path` and its first `bytes`.
///
/// Some programs write text under the ending `.xls`. Such a file is read as text.
pub(crate) fn is_spreadsheet(path: &Path, bytes: &[u8]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("");
    let named = ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known));
    let zip = bytes.starts_with(b"PK\x03\x04");
    let compound = bytes.starts_with(&[0xd0, 0xcf, 0x11, 0xe0]);
    zip || compound || (named && !ending.eq_ignore_ascii_case("xls"))
}

/// Reads the sheets of a spreadsheet from its `bytes`. `Err` holds the reason why the spreadsheet
/// cannot be read.
///
/// Only `.xlsx` files tell which numbers are displayed in percent. A date is read as a text,
/// because it is no number of a test.
#[cfg(feature = "spreadsheets")]
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Grid>, String> {
    use calamine::{Data, Reader, SheetType};

    use crate::tables::grid::{Cell, Row};

    let cursor = std::io::Cursor::new(bytes);
    let mut book =
        calamine::open_workbook_auto_from_rs(cursor).map_err(|error| error.to_string())?;
    let mut grids = Vec::new();
    // Sheets of a chart or a macro have no cells.
    let names: Vec<String> = book
        .sheets_metadata()
        .iter()
        .filter(|sheet| sheet.typ == SheetType::WorkSheet)
        .map(|sheet| sheet.name.clone())
        .collect();
    for sheet in names {
        let range = book.worksheet_range(&sheet).map_err(|error| error.to_string())?;
        let styles = book.worksheet_style(&sheet).ok();
        let (first_row, first_column) = range.start().unwrap_or((0, 0));
        let mut rows = Vec::new();
        for (line, data) in (first_row..).zip(range.rows()) {
            let mut cells = vec![Cell::Text(String::new()); first_column as usize];
            for (column, data) in (first_column..).zip(data) {
                let style = styles.as_ref().and_then(|styles| styles.get((line, column)));
                let format = style.and_then(|style| style.number_format.as_ref());
                let is_percent =
                    format.is_some_and(|format| is_percent_format(&format.format_code));
                cells.push(match data {
                    Data::Float(number) if is_percent => Cell::Percent(100.0 * number),
                    data => cell(data),
                });
            }
            if cells.iter().any(|cell| !cell.is_empty()) {
                rows.push(Row { line: line as usize + 1, cells });
            }
        }
        grids.push(Grid { sheet, rows, ..Grid::default() });
    }
    Ok(grids)
}

/// Returns whether a number `format` displays percent: the sign stands outside of quotes.
#[cfg(feature = "spreadsheets")]
fn is_percent_format(format: &str) -> bool {
    let (mut is_quoted, mut is_escaped) = (false, false);
    for letter in format.chars() {
        match letter {
            _ if is_escaped => is_escaped = false,
            '\\' if !is_quoted => is_escaped = true,
            '"' => is_quoted = !is_quoted,
            '%' if !is_quoted => return true,
            _ => {}
        }
    }
    false
}

/// Returns the cell of `data`.
#[cfg(feature = "spreadsheets")]
fn cell(data: &calamine::Data) -> crate::tables::grid::Cell {
    use calamine::Data;

    use crate::tables::grid::Cell;

    match data {
        Data::Int(number) => Cell::Number(*number as f64),
        Data::Float(number) => Cell::Number(*number),
        Data::Empty => Cell::Text(String::new()),
        Data::DateTime(moment) => {
            let (year, month, day, hour, minute, second, milli) = moment.to_ymd_hms_milli();
            let clock = format!("{hour:02}:{minute:02}:{second:02}.{milli:03}");
            Cell::Text(if moment.is_datetime() && moment.as_f64() >= 1.0 {
                format!("{year:04}-{month:02}-{day:02}")
            } else {
                clock
            })
        }
        // An error of the spreadsheet, such as #DIV/0!, is a text that is not a number.
        data => Cell::Text(data.to_string().trim().to_owned()),
    }
}

/// Reads nothing: the crate was built without its feature `spreadsheets`.
#[cfg(not(feature = "spreadsheets"))]
pub(crate) fn read(_: &[u8]) -> Result<Vec<Grid>, String> {
    Err("this program was built without the feature `spreadsheets`".to_owned())
}

#[cfg(all(test, feature = "spreadsheets"))]
mod tests {
    use super::*;

    #[test]
    fn a_format_shows_percent_by_a_sign_that_is_no_quoted_text() {
        for format in ["0%", "0.00%", "0.0\\ %", "[Red]0%;-0%"] {
            assert!(is_percent_format(format), "{format}");
        }
        for format in ["General", "0.00", "0.0\" %\"", "0.0\\%"] {
            assert!(!is_percent_format(format), "{format}");
        }
    }
}
