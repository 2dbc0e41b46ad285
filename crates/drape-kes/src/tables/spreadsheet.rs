//! Sheets of a spreadsheet file: `.xlsx`, `.xlsm`, `.xlsb`, `.xls`, `.ods`.

#[cfg(feature = "spreadsheets")]
mod open_document;
#[cfg(feature = "spreadsheets")]
mod placed_cells;

use std::path::Path;

#[cfg(feature = "spreadsheets")]
use self::placed_cells::{PlacedCell, PlacedCells, UNPACKED_MAX};
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
/// Only `.xlsx` and `.ods` files tell which numbers are displayed in percent. A date is read as a
/// text, because it is no number of a test.
#[cfg(feature = "spreadsheets")]
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Grid>, String> {
    use calamine::{Reader, SheetType};

    check_unpacked_size(bytes)?;
    let mut placed = PlacedCells::default();
    let mut grids = Vec::new();
    if open_document::is_open_document(bytes) {
        for open_document::OpenSheet { name, cells } in open_document::sheets(bytes, &mut placed)? {
            let rows = placed.rows(cells).map_err(|reason| in_sheet(&name, &reason))?;
            grids.push(Grid { sheet: name, rows, ..Grid::default() });
        }
        return Ok(grids);
    }

    let cursor = std::io::Cursor::new(bytes);
    let mut book =
        calamine::open_workbook_auto_from_rs(cursor).map_err(|error| error.to_string())?;
    // Sheets of a chart or a macro have no cells.
    let names: Vec<String> = book
        .sheets_metadata()
        .iter()
        .filter(|sheet| sheet.typ == SheetType::WorkSheet)
        .map(|sheet| sheet.name.clone())
        .collect();
    for sheet in names {
        let rows = placed_cells(&mut book, &sheet, &mut placed)
            .and_then(|cells| placed.rows(cells))
            .map_err(|reason| in_sheet(&sheet, &reason))?;
        grids.push(Grid { sheet, rows, ..Grid::default() });
    }
    Ok(grids)
}

/// Returns the `reason` why the sheet called `name` cannot be read, with the sheet.
#[cfg(feature = "spreadsheets")]
fn in_sheet(name: &str, reason: &str) -> String {
    format!("the sheet \"{name}\": {reason}")
}

/// Checks that a packed spreadsheet with these `bytes` does not unpack to more than
/// [`UNPACKED_MAX`].
#[cfg(feature = "spreadsheets")]
fn check_unpacked_size(bytes: &[u8]) -> Result<(), String> {
    let Ok(mut archive) = zip::ZipArchive::new(std::io::Cursor::new(bytes)) else { return Ok(()) };
    let mut size = 0_u64;
    for number in 0..archive.len() {
        let member = archive.by_index_raw(number).map_err(|error| error.to_string())?;
        size = size.saturating_add(member.size());
    }
    if size > UNPACKED_MAX {
        return Err(format!(
            "it unpacks to {} MB, more than {} MB: save the sheet of the results in a file of its own",
            size / 1_000_000,
            UNPACKED_MAX / 1_000_000
        ));
    }
    Ok(())
}

/// Returns the cells of a `sheet` of `book` that are not empty. `placed` limits the cells of all
/// sheets.
#[cfg(feature = "spreadsheets")]
fn placed_cells<R: std::io::Read + std::io::Seek>(
    book: &mut calamine::Sheets<R>,
    sheet: &str,
    placed: &mut PlacedCells,
) -> Result<Vec<PlacedCell>, String> {
    use calamine::{Data, Reader, Sheets};

    let mut cells = Vec::new();
    match book {
        // The cells are read one by one: a stray cell in the last column costs no more than others.
        Sheets::Xlsx(book) => {
            let mut reader = match book.worksheet_cells_reader(sheet) {
                Err(calamine::XlsxError::NotAWorksheet(_)) => return Ok(cells),
                reader => reader.map_err(|error| error.to_string())?,
            };
            let shows_percent: Vec<bool> = reader
                .styles()
                .iter()
                .map(|style| {
                    let format = style.number_format.as_ref();
                    format.is_some_and(|format| is_percent_format(&format.format_code))
                })
                .collect();
            while let Some((read, style)) =
                reader.next_cell_with_style_id().map_err(|error| error.to_string())?
            {
                let (row, column) = read.get_position();
                let is_percent = shows_percent.get(style).copied().unwrap_or(false);
                let cell = cell(&Data::from(read.get_value().clone()), is_percent);
                placed.place(&mut cells, PlacedCell { row, column, cell })?;
            }
        }
        Sheets::Xlsb(book) => {
            let mut reader =
                book.worksheet_cells_reader(sheet).map_err(|error| error.to_string())?;
            while let Some(read) = reader.next_cell().map_err(|error| error.to_string())? {
                let (row, column) = read.get_position();
                let cell = cell(&Data::from(read.get_value().clone()), false);
                placed.place(&mut cells, PlacedCell { row, column, cell })?;
            }
        }
        book => {
            let range = book.worksheet_range(sheet).map_err(|error| error.to_string())?;
            let (first_row, first_column) = range.start().unwrap_or((0, 0));
            for (row, column, data) in range.used_cells() {
                let (row, column) = (first_row + row as u32, first_column + column as u32);
                placed.place(&mut cells, PlacedCell { row, column, cell: cell(data, false) })?;
            }
        }
    }
    Ok(cells)
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

/// Returns the cell of `data`, a number of which may be displayed in percent.
#[cfg(feature = "spreadsheets")]
fn cell(data: &calamine::Data, is_percent: bool) -> crate::tables::grid::Cell {
    use calamine::Data;

    use crate::tables::grid::Cell;

    match data {
        Data::Int(number) => Cell::Number(*number as f64),
        Data::Float(number) if is_percent => Cell::Percent(100.0 * number),
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
