//! Table: inputs, records and measures of all points of a study.

#[cfg(feature = "parquet")]
mod parquet;
mod parts;
mod summary;

use std::collections::BTreeMap;

use crate::axes::value_of;
use crate::error::Error;
use crate::point::Point;
use crate::storage::PointStorage;
use crate::study::Study;
use crate::table::summary::{cell, chosen, flatten};

/// Names of the columns that say what came of a point.
const RECORDS: [&str; 5] = ["outcome", "exit_code", "retries", "seconds", "message"];

/// Column of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// Cells, one for each point; empty where there is no value.
    pub cells: Vec<String>,
}

impl Column {
    /// Returns the numbers of the cells.
    #[must_use]
    pub fn numbers(&self) -> Vec<Option<f64>> {
        let number = |cell: &String| cell.parse().ok().filter(|x: &f64| x.is_finite());
        self.cells.iter().map(number).collect()
    }
}

/// Table of a study: a row for each point, in the order of the plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Number and key of each point.
    pub points: Vec<Column>,
    /// Levels of the axes.
    pub inputs: Vec<Column>,
    /// What came of each point: status, exit code, number of retries, time in s, message.
    pub records: Vec<Column>,
    /// Values of the summaries, in the order of their names.
    pub measures: Vec<Column>,
}

impl Table {
    /// Collects the points of a study.
    #[must_use]
    pub fn collect(study: &Study, points: &[Point]) -> Self {
        let mut records: Vec<[String; 5]> = Vec::new();
        let mut measures: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (row, point) in points.iter().enumerate() {
            let place = PointStorage::new(study, point);
            let record = place.record();
            let summary = record.as_ref().and_then(|record| place.summary_of(record));
            let mut values = Vec::new();
            summary.iter().for_each(|summary| flatten("", summary, &mut values));
            if !study.measures().is_empty() {
                values = chosen(study.measures(), values);
            }
            for (name, value) in values {
                let cells = measures.entry(name).or_default();
                cells.resize(row, String::new());
                cells.push(value);
            }
            records.push(match record {
                None => ["not run", "", "", "", ""].map(str::to_owned),
                Some(record) => [
                    record.word(summary.as_ref()),
                    record.exit_code.map_or(String::new(), |code| code.to_string()),
                    record.retries.to_string(),
                    format!("{:.3}", record.seconds),
                    record.message,
                ],
            });
        }
        let column = |name: &str, cells: Vec<String>| Column { name: name.to_owned(), cells };
        let inputs = study.axes().enumerate().map(|(index, axis)| {
            let cells = points.iter().map(|point| cell(&value_of(&point.levels[index])));
            column(&axis.name, cells.collect())
        });
        let inputs: Vec<Column> = inputs.collect();
        // Those that the study names keep its order, and are there though no run has them.
        let measures: Vec<(String, Vec<String>)> = match study.measures() {
            [] => measures.into_iter().collect(),
            named => {
                let mut cells = |name: &String| measures.remove(name).unwrap_or_default();
                named.iter().map(|own| (own.name.clone(), cells(&own.name))).collect()
            }
        };
        let taken = |name: &str| inputs.iter().any(|input| input.name == name);
        let measures = measures.into_iter().map(|(name, mut cells)| {
            cells.resize(points.len(), String::new());
            let name = if taken(&name) { format!("summary.{name}") } else { name };
            Column { name, cells }
        });
        let records = RECORDS.into_iter().enumerate().map(|(index, name)| {
            column(name, records.iter().map(|record| record[index].clone()).collect())
        });
        Self {
            points: vec![
                column("point", points.iter().map(|point| point.index.to_string()).collect()),
                column("key", points.iter().map(|point| point.key.clone()).collect()),
            ],
            measures: measures.collect(),
            records: records.collect(),
            inputs,
        }
    }

    /// Returns all columns in their order.
    pub fn columns(&self) -> impl Iterator<Item = &Column> {
        let Self { points, inputs, records, measures } = self;
        points.iter().chain(inputs).chain(records).chain(measures)
    }

    /// Returns the table as CSV, with a line of names.
    ///
    /// # Errors
    /// None but those of memory.
    pub fn to_csv(&self) -> Result<Vec<u8>, Error> {
        let mut csv = csv::Writer::from_writer(Vec::new());
        let path = std::path::Path::new("table.csv");
        let failed = |error: csv::Error| Error::io("write", path)(error.into());
        csv.write_record(self.columns().map(|column| &column.name)).map_err(failed)?;
        let rows = self.points.first().map_or(0, |column| column.cells.len());
        for row in 0..rows {
            csv.write_record(self.columns().map(|column| &column.cells[row])).map_err(failed)?;
        }
        csv.into_inner().map_err(|error| Error::io("write", path)(error.into_error()))
    }
}
