//! Sheets of a spreadsheet file: `.xlsx`, `.xlsm`, `.xlsb`, `.xls`, `.ods`.

use std::path::Path;

use crate::tables::grid::Grid;

/// Endings of the files that are spreadsheets.
const ENDINGS: [&str; 5] = ["xlsx", "xlsm", "xlsb", "xls", "ods"];

/// Returns whether a file is a spreadsheet, by its ending and its first bytes.
///
/// Programs write text under `.xls` too, which is read as text.
pub(crate) fn is_spreadsheet(path: &Path, bytes: &[u8]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("");
    let named = ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known));
    let zip = bytes.starts_with(b"PK\x03\x04");
    let compound = bytes.starts_with(&[0xd0, 0xcf, 0x11, 0xe0]);
    zip || compound || (named && !ending.eq_ignore_ascii_case("xls"))
}

/// Reads the sheets of a spreadsheet; `Err` holds the reason why it cannot be read.
///
/// Only `.xlsx` files tell which numbers are shown in percent. A date is a text, since it is no
/// number of a test.
#[cfg(feature = "spreadsheets")]
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Grid>, String> {
    use calamine::{Data, Reader, SheetType};

    use crate::tables::grid::{Cell, Row};

    let cursor = std::io::Cursor::new(bytes);
    let mut book =
        calamine::open_workbook_auto_from_rs(cursor).map_err(|error| error.to_string())?;
    let mut grids = Vec::new();
    // Sheets that hold a chart or a macro have no cells.
    let tables = |sheet: &&calamine::Sheet| sheet.typ == SheetType::WorkSheet;
    let names: Vec<String> =
        book.sheets_metadata().iter().filter(tables).map(|sheet| sheet.name.clone()).collect();
    for sheet in names {
        let range = book.worksheet_range(&sheet).map_err(|error| error.to_string())?;
        let styles = book.worksheet_style(&sheet).ok();
        let (first_row, first_column) = range.start().unwrap_or((0, 0));
        let is_percent = |row: u32, column: u32| {
            let style = styles.as_ref().and_then(|styles| styles.get((row, column)));
            let format = style.and_then(|style| style.number_format.as_ref());
            format.is_some_and(|format| is_of_percent(&format.format_code))
        };
        let row = |(index, cells): (usize, &[Data])| {
            let line = first_row + index as u32;
            let mut row = vec![Cell::Text(String::new()); first_column as usize];
            for (place, data) in cells.iter().enumerate() {
                row.push(match data {
                    Data::Float(number) if is_percent(line, first_column + place as u32) => {
                        Cell::Percent(100.0 * number)
                    }
                    other => cell(other),
                });
            }
            let line = line as usize + 1;
            row.iter().any(|cell| !cell.is_empty()).then_some(Row { line, cells: row })
        };
        let rows = range.rows().enumerate().filter_map(row).collect();
        grids.push(Grid { sheet, rows, ..Grid::default() });
    }
    Ok(grids)
}

/// Returns whether a format of numbers shows them in percent: with the sign outside of quotes.
#[cfg(feature = "spreadsheets")]
fn is_of_percent(format: &str) -> bool {
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

/// Returns what a cell holds.
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
        other => Cell::Text(other.to_string().trim().to_owned()),
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
            assert!(is_of_percent(format), "{format}");
        }
        for format in ["General", "0.00", "0.0\" %\"", "0.0\\%"] {
            assert!(!is_of_percent(format), "{format}");
        }
    }
}
