//! Table: inputs, records and measures of all points of a study.

#[cfg(feature = "parquet")]
mod parquet;
mod parts;
mod summary;

use std::collections::BTreeMap;

use crate::axes::level_value;
use crate::error::Error;
use crate::measure::Measure;
use crate::point::Point;
use crate::storage::PointStorage;
use crate::study::Study;
use crate::table::summary::{cell_text, flatten, measured_values};

/// Names of the columns with the record of a point.
const RECORDS: [&str; 5] = ["outcome", "exit_code", "retries", "seconds", "message"];

/// Column of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name of the column.
    pub name: String,
    /// Cells, one for each point. A cell without a value is empty.
    pub cells: Vec<String>,
}

impl Column {
    /// Returns the column `name` with the given `cells`.
    fn new(name: &str, cells: impl IntoIterator<Item = String>) -> Self {
        Self { name: name.to_owned(), cells: cells.into_iter().collect() }
    }

    /// Returns the number in each cell, or `None` for a cell without a finite number.
    #[must_use]
    pub fn numbers(&self) -> Vec<Option<f64>> {
        let numbers = self.cells.iter().map(|cell| cell.parse().ok());
        numbers.map(|number| number.filter(|x: &f64| x.is_finite())).collect()
    }
}

/// Table of a study: a row for each point, in the order of the plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Number and key of each point.
    pub points: Vec<Column>,
    /// Levels of the axes.
    pub inputs: Vec<Column>,
    /// Record of each point: outcome, exit code, number of retries, time in s, message.
    pub records: Vec<Column>,
    /// Values of the summaries, in the order of their names.
    pub measures: Vec<Column>,
}

impl Table {
    /// Collects the records and summaries of `points` of `study`.
    #[must_use]
    pub fn collect(study: &Study, points: &[Point]) -> Self {
        let mut records: Vec<[String; 5]> = Vec::new();
        let mut measures: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (row, point) in points.iter().enumerate() {
            let storage = PointStorage::new(study, point);
            let record = storage.record();
            let summary = record.as_ref().and_then(|record| storage.summary_of(record));

            // Measures that earlier points do not have get empty cells for them.
            let mut values = Vec::new();
            summary.iter().for_each(|summary| flatten("", summary, &mut values));
            if !study.measures().is_empty() {
                values = measured_values(study.measures(), values);
            }
            for (name, value) in values {
                let cells = measures.entry(name).or_default();
                cells.resize(row, String::new());
                cells.push(value);
            }

            records.push(match record {
                None => ["not run", "", "", "", ""].map(str::to_owned),
                Some(record) => [
                    record.outcome_text(summary.as_ref()),
                    record.exit_code.map_or(String::new(), |code| code.to_string()),
                    record.retries.to_string(),
                    format!("{:.3}", record.seconds),
                    record.message,
                ],
            });
        }

        let inputs: Vec<Column> = study
            .axes()
            .enumerate()
            .map(|(index, axis)| {
                let levels = points.iter().map(|point| &point.levels[index]);
                let cells = levels.map(|level| cell_text(&level_value(level)));
                Column::new(&axis.name, cells)
            })
            .collect();

        // Measures that the study names keep its order, and have a column even if no run has them.
        let measures: Vec<(String, Vec<String>)> = match study.measures() {
            [] => measures.into_iter().collect(),
            named => named
                .iter()
                .map(|Measure { name, .. }| {
                    (name.clone(), measures.remove(name).unwrap_or_default())
                })
                .collect(),
        };
        let measures = measures.into_iter().map(|(name, mut cells)| {
            cells.resize(points.len(), String::new());
            let is_taken = inputs.iter().any(|input| input.name == name);
            let name = if is_taken { format!("summary.{name}") } else { name };
            Column { name, cells }
        });

        let records = RECORDS.into_iter().enumerate().map(|(index, name)| {
            Column::new(name, records.iter().map(|record| record[index].clone()))
        });
        Self {
            points: vec![
                Column::new("point", points.iter().map(|point| point.index.to_string())),
                Column::new("key", points.iter().map(|point| point.key.clone())),
            ],
            measures: measures.collect(),
            records: records.collect(),
            inputs,
        }
    }

    /// Returns all columns in their order: points, inputs, records, measures.
    pub fn columns(&self) -> impl Iterator<Item = &Column> {
        let Self { points, inputs, records, measures } = self;
        points.iter().chain(inputs).chain(records).chain(measures)
    }

    /// Returns the table as CSV. The first line has the names of the columns.
    ///
    /// # Errors
    /// [`Error::Io`] if the memory is exhausted.
    pub fn to_csv(&self) -> Result<Vec<u8>, Error> {
        self.csv().map_err(Error::io("write", std::path::Path::new("table.csv")))
    }

    /// Returns the table as CSV, or the error of the writer.
    fn csv(&self) -> std::io::Result<Vec<u8>> {
        let mut csv = csv::Writer::from_writer(Vec::new());
        csv.write_record(self.columns().map(|column| &column.name))?;
        let row_count = self.points.first().map_or(0, |column| column.cells.len());
        for row in 0..row_count {
            csv.write_record(self.columns().map(|column| &column.cells[row]))?;
        }
        csv.into_inner().map_err(|error| error.into_error())
    }
}
