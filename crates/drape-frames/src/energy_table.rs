//! Energy table: the content of `energy.csv`, the energy balance at each frame.

use std::path::Path;

use crate::error::Error;
use crate::text::read_complete_lines;

/// Energy balance at each frame.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyTable {
    /// Names of the entries of the balance.
    pub names: Vec<String>,
    /// Entries of the balance at each frame, in J, or `None` for a frame before the balance begins.
    pub rows: Vec<Option<Vec<f64>>>,
}

impl EnergyTable {
    /// Reads the rows of `frame_count` frames from the file `path`.
    ///
    /// Rows of later frames, which a run that was killed may have written, are left out.
    pub(crate) fn read(path: &Path, frame_count: usize) -> Result<EnergyTable, Error> {
        /// Columns that identify the frame of a row: its number, and its time in s.
        const FRAME_COLUMNS: [&str; 2] = ["number", "time"];

        let text = read_complete_lines(path)?;
        let mut table = csv::Reader::from_reader(text.as_bytes());
        let header =
            table.headers().map_err(|error| Error::malformed(path, 1, error.to_string()))?;
        let columns: Vec<String> = header.iter().map(str::to_owned).collect();
        let Some(names) = columns.strip_prefix(&FRAME_COLUMNS.map(str::to_owned)) else {
            let reason = format!("it begins with other columns than {}", FRAME_COLUMNS.join(", "));
            return Err(Error::malformed(path, 1, reason));
        };

        let (mut rows, mut next) = (vec![None; frame_count], 0);
        for (index, row) in table.records().enumerate() {
            let line = index + 2;
            let row = row.map_err(|error| Error::malformed(path, line, error.to_string()))?;
            let number = row[0].parse::<usize>().ok().filter(|number| *number < usize::MAX);
            let Some(number) = number else {
                let reason = format!("\"{}\" is no number of a frame", &row[0]);
                return Err(Error::malformed(path, line, reason));
            };

            // The first value is the time of the frame, the others are the entries of the balance.
            let values = row.iter().skip(1).map(str::parse).collect::<Result<Vec<f64>, _>>();
            let values = values.map_err(|error| Error::malformed(path, line, error.to_string()))?;
            if number < next || !values.iter().all(|value| value.is_finite()) {
                let reason = "it is no row of finite numbers of a later frame than the row before";
                return Err(Error::malformed(path, line, reason));
            }
            next = number + 1;
            if let Some(row) = rows.get_mut(number) {
                *row = Some(values[1..].to_vec());
            }
        }
        Ok(EnergyTable { names: names.to_vec(), rows })
    }
}
