//! Tables of text with aligned columns.

/// Table: rows of cells that become aligned columns.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    /// Columns that are set flush right.
    right: Vec<usize>,
}

impl Table {
    /// Returns a table with a `head`. The columns of the list `right` are set flush right.
    pub(crate) fn new(head: &[&str], right: &[usize]) -> Table {
        Table {
            rows: vec![head.iter().map(|cell| (*cell).to_owned()).collect()],
            right: right.to_vec(),
        }
    }

    /// Adds a row of `cells`.
    pub(crate) fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// Returns the lines of the table, each after `indent` blanks. Columns that are empty below
    /// their head are left out.
    pub(crate) fn lines(&self, indent: usize) -> Vec<String> {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let cell = |row: &'_ [String], column: usize| -> String {
            row.get(column).cloned().unwrap_or_default()
        };
        let used = |column: &usize| self.rows.iter().skip(1).any(|r| !cell(r, *column).is_empty());
        let columns: Vec<usize> = (0..columns).filter(used).collect();
        let length = |text: &str| text.chars().count();
        let width = |column: usize| {
            let widths = self.rows.iter().map(|row| length(&cell(row, column)));
            widths.max().unwrap_or(0)
        };
        let widths: Vec<usize> = columns.iter().map(|&column| width(column)).collect();

        let lines = self.rows.iter().map(|row| {
            let mut line = " ".repeat(indent);
            for (&column, &width) in columns.iter().zip(&widths) {
                let text = cell(row, column);
                let pad = " ".repeat(width - length(&text));
                let parts = if self.right.contains(&column) { [pad, text] } else { [text, pad] };
                line.push_str(&parts.concat());
                line.push_str("  ");
            }
            line.trim_end().to_owned()
        });
        lines.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_by_letters_and_empty_ones_left_out() {
        let mut table = Table::new(&["name", "µ", "none"], &[1]);
        table.row(vec!["a".into(), "1.0".into(), String::new()]);
        table.row(vec!["Größe".into(), "12.0".into(), String::new()]);
        assert_eq!(table.lines(2), ["  name      µ", "  a       1.0", "  Größe  12.0"]);
    }
}
