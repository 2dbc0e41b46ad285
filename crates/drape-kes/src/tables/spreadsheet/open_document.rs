//! Sheets of an OpenDocument spreadsheet, `.ods`.
//!
//! A cell and a row may state that they are repeated: every file ends with a million rows of empty
//! cells. The empty cells are counted and not laid out, and the other ones are limited in number.

use std::io::{BufRead, BufReader, Cursor, Read};

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};

use super::placed_cells::{PlacedCell, PlacedCells, UNPACKED_MAX};
use crate::tables::grid::Cell;
use drape_input::excerpt;

/// Content of the member `mimetype`.
const MIMETYPE: &str = "application/vnd.oasis.opendocument.spreadsheet";

/// Largest number of blanks that one element of a text stands for.
const BLANKS_MAX: u32 = 100;

/// Sheet with the cells that are not empty.
pub(super) struct OpenSheet {
    pub(super) name: String,
    pub(super) cells: Vec<PlacedCell>,
}

/// Returns whether the archive with these `bytes` is an OpenDocument spreadsheet.
pub(super) fn is_open_document(bytes: &[u8]) -> bool {
    let Ok(mut archive) = zip::ZipArchive::new(Cursor::new(bytes)) else { return false };
    let Ok(member) = archive.by_name("mimetype") else { return false };
    let mut text = String::new();
    let read = member.take(MIMETYPE.len() as u64).read_to_string(&mut text);
    read.is_ok() && text == MIMETYPE
}

/// Reads the sheets of a spreadsheet from its `bytes`. `placed` limits the cells of all sheets.
/// `Err` holds the reason why the spreadsheet cannot be read.
pub(super) fn sheets(bytes: &[u8], placed: &mut PlacedCells) -> Result<Vec<OpenSheet>, String> {
    let mut archive =
        zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    if is_encrypted(&mut archive) {
        return Err("it is protected by a password: save it without one".to_owned());
    }
    let content = archive.by_name("content.xml").map_err(|error| error.to_string())?;
    let mut reader = quick_xml::Reader::from_reader(BufReader::new(content.take(UNPACKED_MAX)));
    reader.config_mut().expand_empty_elements = true;

    let mut reading = Reading::new(placed);
    let mut buffer = Vec::new();
    loop {
        match reader.read_event_into(&mut buffer).map_err(|error| error.to_string())? {
            Event::Start(element) => reading.start(&element)?,
            Event::End(element) => reading.end(element.name().as_ref())?,
            Event::Text(text) => reading.text(&text.xml10_content()),
            Event::GeneralRef(entity) => {
                let character = entity.resolve_char_ref().map_err(|error| error.to_string())?;
                match character {
                    Some(character) => reading.text(character.encode_utf8(&mut [0; 4])),
                    None => reading.text(resolve_predefined_entity(&entity).unwrap_or_default()),
                }
            }
            Event::Eof => return reading.finish(),
            _ => {}
        }
        buffer.clear();
    }
}

/// Returns whether the manifest of `archive` states that a member is encrypted.
fn is_encrypted<R: Read + std::io::Seek>(archive: &mut zip::ZipArchive<R>) -> bool {
    let Ok(member) = archive.by_name("META-INF/manifest.xml") else { return false };
    let mut lines = BufReader::new(member.take(UNPACKED_MAX)).split(b'>');
    lines.any(|line| line.is_ok_and(|line| line.trim_ascii().starts_with(b"<manifest:encryption")))
}

/// Cells of a document up to the element that is read.
struct Reading<'a> {
    placed: &'a mut PlacedCells,
    sheets: Vec<OpenSheet>,
    /// Number of tables that are open: a table may be in a cell of another table.
    tables: usize,
    /// Number of annotations that are open. Their texts are no texts of cells.
    annotations: usize,
    /// Number of the next row of the sheet, from 0.
    next_row: u32,
    /// Row that is read.
    row: Option<Row>,
}

/// Row of a sheet.
struct Row {
    /// Number of the first of its repetitions, from 0.
    number: u32,
    repeats: u32,
    /// Number of the first column that has not been read.
    column: u32,
    /// Cells that are not empty.
    cells: Vec<RepeatedCell>,
    /// Cell that is read.
    open: Option<OpenCell>,
}

/// Cell of a row, and of some columns beside each other.
struct RepeatedCell {
    column: u32,
    repeats: u32,
    cell: Cell,
}

/// Cell that is read.
struct OpenCell {
    repeats: u32,
    /// Value that the attributes state; `None` if the text of the cell is its value.
    value: Option<Cell>,
    text: String,
    paragraphs: usize,
    /// Whether a paragraph is open.
    in_paragraph: bool,
}

impl<'a> Reading<'a> {
    fn new(placed: &'a mut PlacedCells) -> Self {
        Self { placed, sheets: Vec::new(), tables: 0, annotations: 0, next_row: 0, row: None }
    }

    /// Returns the sheets once the whole document was read.
    fn finish(self) -> Result<Vec<OpenSheet>, String> {
        if self.tables > 0 {
            Err("its text ends within a table".to_owned())
        } else {
            Ok(self.sheets)
        }
    }

    /// Reads the start of `element`.
    fn start(&mut self, element: &BytesStart<'_>) -> Result<(), String> {
        match element.name().as_ref() {
            "table:table" => {
                self.tables += 1;
                if self.tables == 1 {
                    let name = attribute(element, "table:name")?.unwrap_or_default();
                    self.sheets.push(OpenSheet { name, cells: Vec::new() });
                    self.next_row = 0;
                }
            }
            "table:table-row" if self.tables == 1 && self.row.is_none() => {
                let repeats = repeats(element, "table:number-rows-repeated")?;
                let number = self.next_row;
                let (cells, open) = (Vec::new(), None);
                self.row = Some(Row { number, repeats, column: 0, cells, open });
            }
            "table:table-cell" | "table:covered-table-cell" if self.tables == 1 => {
                if let Some(row) = &mut self.row {
                    row.open = Some(OpenCell::new(element)?);
                }
            }
            "office:annotation" => self.annotations += 1,
            name => self.start_in_cell(name, element)?,
        }
        Ok(())
    }

    /// Returns the cell that is read, unless a table or an annotation in it is read.
    fn open_cell(&mut self) -> Option<&mut OpenCell> {
        let is_within = self.tables == 1 && self.annotations == 0;
        self.row.as_mut().filter(|_| is_within)?.open.as_mut()
    }

    /// Reads the start of an element with a `name` in a cell.
    fn start_in_cell(&mut self, name: &str, element: &BytesStart<'_>) -> Result<(), String> {
        let Some(cell) = self.open_cell() else { return Ok(()) };
        match name {
            "text:p" => {
                if cell.paragraphs > 0 {
                    cell.text.push('\n');
                }
                cell.paragraphs += 1;
                cell.in_paragraph = true;
            }
            "text:s" => {
                let count = repeats(element, "text:c")?.min(BLANKS_MAX);
                cell.text.extend((0..count).map(|_| ' '));
            }
            "text:tab" => cell.text.push('\t'),
            "text:line-break" => cell.text.push('\n'),
            _ => {}
        }
        Ok(())
    }

    /// Reads the end of the element with a `name`.
    fn end(&mut self, name: &str) -> Result<(), String> {
        match name {
            "table:table" => self.tables = self.tables.saturating_sub(1),
            "office:annotation" => self.annotations = self.annotations.saturating_sub(1),
            "table:table-cell" | "table:covered-table-cell" if self.tables == 1 => {
                if let Some(row) = &mut self.row {
                    row.close_cell();
                }
            }
            "table:table-row" if self.tables == 1 => {
                if let (Some(row), Some(sheet)) = (self.row.take(), self.sheets.last_mut()) {
                    self.next_row = row.number.saturating_add(row.repeats);
                    row.place(self.placed, &mut sheet.cells)?;
                }
            }
            "text:p" => {
                if let Some(cell) = self.open_cell() {
                    cell.in_paragraph = false;
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Reads a `text`, which counts in a paragraph of a cell.
    fn text(&mut self, text: &str) {
        if let Some(cell) = self.open_cell().filter(|cell| cell.in_paragraph) {
            cell.text.push_str(text);
        }
    }
}

impl Row {
    /// Ends the cell that is read.
    fn close_cell(&mut self) {
        let Some(OpenCell { repeats, value, text, .. }) = self.open.take() else { return };
        let cell = value.unwrap_or_else(|| Cell::Text(text.trim().to_owned()));
        if !cell.is_empty() && repeats > 0 {
            self.cells.push(RepeatedCell { column: self.column, repeats, cell });
        }
        self.column = self.column.saturating_add(repeats);
    }

    /// Appends the cells of all repetitions of the row to `cells`.
    fn place(self, placed: &mut PlacedCells, cells: &mut Vec<PlacedCell>) -> Result<(), String> {
        if self.cells.is_empty() {
            return Ok(());
        }
        for row in self.number..self.number.saturating_add(self.repeats) {
            for RepeatedCell { column, repeats, cell } in &self.cells {
                for column in *column..column.saturating_add(*repeats) {
                    placed.place(cells, PlacedCell { row, column, cell: cell.clone() })?;
                }
            }
        }
        Ok(())
    }
}

impl OpenCell {
    /// Returns the cell that begins with `element`.
    fn new(element: &BytesStart<'_>) -> Result<Self, String> {
        let repeats = repeats(element, "table:number-columns-repeated")?;
        let kind = attribute(element, "office:value-type")?.unwrap_or_default();
        let number = || -> Result<f64, String> {
            let text = attribute(element, "office:value")?.unwrap_or_default();
            text.trim().parse().map_err(|_| format!("\"{}\" is no number", excerpt(&text)))
        };
        let stated = |name: &str| -> Result<Option<Cell>, String> {
            let text = attribute(element, name)?;
            Ok(text.map(|text| Cell::Text(text.trim().to_owned())))
        };

        let value = match kind.as_str() {
            "float" | "currency" => Some(Cell::Number(number()?)),
            "percentage" => Some(Cell::Percent(100.0 * number()?)),
            "date" => stated("office:date-value")?,
            "time" => stated("office:time-value")?,
            "boolean" => stated("office:boolean-value")?,
            // The text of an error stands in the cell, beside an empty value.
            "string" => stated("office:string-value")?.filter(|cell| !cell.is_empty()),
            _ => Some(Cell::Text(String::new())),
        };
        let (text, paragraphs, in_paragraph) = (String::new(), 0, false);
        Ok(Self { repeats, value, text, paragraphs, in_paragraph })
    }
}

/// Returns the value of the attribute with a `name` of `element`, if there is one.
fn attribute(element: &BytesStart<'_>, name: &str) -> Result<Option<String>, String> {
    let found = element.try_get_attribute(name).map_err(|error| error.to_string())?;
    let value = found.map(|found| found.normalized_value(XmlVersion::Implicit1_0));
    let value = value.transpose().map_err(|error| error.to_string())?;
    Ok(value.map(|value| value.into_owned()))
}

/// Returns the number of repetitions that the attribute with a `name` of `element` states, 1 if it
/// is missing.
fn repeats(element: &BytesStart<'_>, name: &str) -> Result<u32, String> {
    let Some(text) = attribute(element, name)? else { return Ok(1) };
    text.parse().map_err(|_| format!("{name} is \"{}\", which is no number", excerpt(&text)))
}
