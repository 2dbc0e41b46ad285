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
#[cfg(feature = "spreadsheets")]
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Grid>, String> {
    use calamine::{Data, Reader};

    use crate::tables::grid::{Cell, Row};

    let cell = |data: &Data| match data {
        Data::Int(number) => Cell::Number(*number as f64),
        Data::Float(number) => Cell::Number(*number),
        Data::Empty => Cell::Text(String::new()),
        // An error of the spreadsheet, such as #DIV/0!, is a text that is not a number.
        other => Cell::Text(other.to_string().trim().to_owned()),
    };
    let cursor = std::io::Cursor::new(bytes);
    let mut book =
        calamine::open_workbook_auto_from_rs(cursor).map_err(|error| error.to_string())?;
    let mut grids = Vec::new();
    for sheet in book.sheet_names() {
        let range = book.worksheet_range(&sheet).map_err(|error| error.to_string())?;
        let (first_row, first_column) = range.start().unwrap_or((0, 0));
        let row = |(index, cells): (usize, &[Data])| {
            let mut row = vec![Cell::Text(String::new()); first_column as usize];
            row.extend(cells.iter().map(cell));
            let line = first_row as usize + index + 1;
            row.iter().any(|cell| !cell.is_empty()).then_some(Row { line, cells: row })
        };
        let rows = range.rows().enumerate().filter_map(row).collect();
        grids.push(Grid { sheet, rows, ..Grid::default() });
    }
    Ok(grids)
}

/// Reads nothing: the crate was built without its feature `spreadsheets`.
#[cfg(not(feature = "spreadsheets"))]
pub(crate) fn read(_: &[u8]) -> Result<Vec<Grid>, String> {
    Err("this program was built without the feature `spreadsheets`".to_owned())
}
