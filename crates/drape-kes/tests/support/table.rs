//! Tables of cells, written as files.

/// Cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    Text(String),
    Number(f64),
}

/// Returns a cell of text.
pub fn t(text: &str) -> Cell {
    Cell::Text(text.to_owned())
}

/// Returns a cell of a number.
pub fn n(number: f64) -> Cell {
    Cell::Number(number)
}

/// Rows of cells.
pub struct Table(pub Vec<Vec<Cell>>);

impl Table {
    /// Returns the table as text with commas; cells with commas in them stand in quotes.
    pub fn csv(&self) -> Vec<u8> {
        let cell = |cell: &Cell| match cell {
            Cell::Text(text) if text.contains(',') => format!("\"{text}\""),
            Cell::Text(text) => text.clone(),
            Cell::Number(number) => number.to_string(),
        };
        let row = |row: &Vec<Cell>| row.iter().map(cell).collect::<Vec<_>>().join(",");
        (self.0.iter().map(row).collect::<Vec<_>>().join("\n") + "\n").into_bytes()
    }

    /// Returns the table as a workbook with one sheet. An empty cell behind a text in a row of
    /// texts is merged with it.
    pub fn workbook(&self, sheet: &str) -> Vec<u8> {
        let mut book = rust_xlsxwriter::Workbook::new();
        let sheet = book.add_worksheet().set_name(sheet).expect("a name");
        for (row, cells) in self.0.iter().enumerate() {
            let row = row as u32;
            let empty = |cell: &Cell| *cell == t("");
            let mut column = 0;
            while column < cells.len() {
                let behind = cells[column + 1..].iter().take_while(|cell| empty(cell)).count();
                let last = (column + behind) as u16;
                match &cells[column] {
                    Cell::Number(number) => {
                        sheet.write(row, column as u16, *number).expect("written");
                    }
                    Cell::Text(text) if text.is_empty() => {}
                    Cell::Text(text)
                        if behind > 0 && cells.iter().all(|c| matches!(c, Cell::Text(_))) =>
                    {
                        let format = rust_xlsxwriter::Format::new();
                        sheet
                            .merge_range(row, column as u16, row, last, text, &format)
                            .expect("merged");
                    }
                    Cell::Text(text) => {
                        sheet.write(row, column as u16, text).expect("written");
                    }
                }
                column += behind + 1;
            }
        }
        book.save_to_buffer().expect("a workbook")
    }
}
