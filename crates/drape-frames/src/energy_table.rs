//! Energy table: the content of `energy.csv`, the balance of the energy at each frame.

use std::path::Path;

use crate::error::Error;
use crate::text::read_complete_lines;

/// Columns that say which frame a row is of: its number, and its time in s.
const OF_FRAME: [&str; 2] = ["number", "time"];

/// Balance of the energy at each frame.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyTable {
    /// Names of the entries of the balance.
    pub names: Vec<String>,
    /// Entries of each frame, in J; none for frames before the balance begins.
    pub rows: Vec<Option<Vec<f64>>>,
}

impl EnergyTable {
    /// Reads the rows of so many frames; a run that is killed may have begun one more.
    pub(crate) fn read(path: &Path, frames: usize) -> Result<EnergyTable, Error> {
        let text = read_complete_lines(path)?;
        let malformed = |line, reason| Error::Malformed { path: path.to_owned(), line, reason };
        let mut table = csv::Reader::from_reader(text.as_bytes());
        let names = table.headers().map_err(|error| malformed(1, error.to_string()))?;
        let names: Vec<String> = names.iter().map(str::to_owned).collect();
        let Some(own) = names.strip_prefix(&OF_FRAME.map(str::to_owned)) else {
            let reason = format!("it begins with other columns than {}", OF_FRAME.join(", "));
            return Err(malformed(1, reason));
        };
        let (mut rows, mut next) = (vec![None; frames], 0);
        for (index, row) in table.records().enumerate() {
            let line = index + 2;
            let row = row.map_err(|error| malformed(line, error.to_string()))?;
            let number = row[0].parse::<usize>().ok().filter(|number| *number < usize::MAX);
            let number = number.ok_or_else(|| {
                malformed(line, format!("\"{}\" is no number of a frame", &row[0]))
            })?;
            let values: Result<Vec<f64>, _> = row.iter().skip(1).map(str::parse).collect();
            let values = values.map_err(|error| malformed(line, error.to_string()))?;
            if number < next || !values.iter().all(|value| value.is_finite()) {
                let reason = "it is no row of finite numbers of a later frame than the row before";
                return Err(malformed(line, reason.to_owned()));
            }
            next = number + 1;
            if let Some(own) = rows.get_mut(number) {
                *own = Some(values[1..].to_vec());
            }
        }
        Ok(EnergyTable { names: own.to_vec(), rows })
    }
}
