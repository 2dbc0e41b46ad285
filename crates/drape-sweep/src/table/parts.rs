//! Tables of shards, which are collected separately and joined.

use std::collections::BTreeSet;
use std::path::Path;

use crate::error::Error;
use crate::study::Study;
use crate::table::{Column, RECORDS, Table};

impl Table {
    /// Reads the table of `study`, or of a shard of it, from `text`, which [`to_csv`](Self::to_csv)
    /// wrote. Messages name the file `path`.
    ///
    /// # Errors
    /// [`Error::Io`] if `text` is no table of `study`.
    pub fn from_csv(study: &Study, path: &Path, text: &[u8]) -> Result<Self, Error> {
        let mut columns =
            read_columns(text).map_err(|error| Error::io("read", path)(error.into()))?;

        // The first columns are fixed by the study, and measures follow.
        let inputs = study.axes().map(|axis| axis.name.as_str());
        let expected: Vec<&str> =
            ["point", "key"].into_iter().chain(inputs).chain(RECORDS).collect();
        let names = columns.iter().map(|column| column.name.as_str());
        if !names.take(expected.len()).eq(expected.iter().copied()) {
            let message = "its columns are not those of the study; collect its shards anew";
            return Err(Error::io("use", path)(std::io::Error::other(message)));
        }
        let measures = columns.split_off(expected.len());
        let records = columns.split_off(expected.len() - RECORDS.len());
        let inputs = columns.split_off(2);
        Ok(Self { points: columns, inputs, records, measures })
    }

    /// Joins `parts`, the tables of shards of `study`. The rows are in the order of the plan, and
    /// the table has every measure that a shard has. Returns the table, and the number of points
    /// without a row.
    #[must_use]
    pub fn join(study: &Study, parts: &[Self]) -> (Self, usize) {
        let rows = joined_rows(parts);
        let missing = study.point_count().saturating_sub(rows.len());

        // Measures that the study does not name are sorted by name.
        let mut known = BTreeSet::new();
        let measures = parts.iter().flat_map(|part| &part.measures).map(|column| &column.name);
        let mut names: Vec<&String> = measures.filter(|name| known.insert(*name)).collect();
        if study.measures().is_empty() {
            names.sort();
        }
        let measures = names.into_iter().map(|name| {
            let columns: Vec<Option<&Column>> = parts
                .iter()
                .map(|part| part.measures.iter().find(|column| column.name == *name))
                .collect();
            join_column(name, &columns, &rows)
        });

        let table = Self {
            points: join_columns(parts, &rows, |part| &part.points),
            inputs: join_columns(parts, &rows, |part| &part.inputs),
            records: join_columns(parts, &rows, |part| &part.records),
            measures: measures.collect(),
        };
        (table, missing)
    }
}

/// Row of a point in the table of a shard.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct ShardRow {
    /// Number of the point in the order of the plan.
    point: usize,
    /// Index of the table of the shard.
    part: usize,
    /// Index of the row in this table.
    row: usize,
}

/// Returns the rows of the tables `parts` in the order of the plan, one row for each point.
fn joined_rows(parts: &[Table]) -> Vec<ShardRow> {
    let mut rows = Vec::new();
    for (part, table) in parts.iter().enumerate() {
        let numbers = table.points.first().map_or(&[][..], |column| &column.cells[..]);
        for (row, number) in numbers.iter().enumerate() {
            rows.extend(number.parse().ok().map(|point| ShardRow { point, part, row }));
        }
    }
    rows.sort_unstable();
    rows.dedup_by_key(|row| row.point);
    rows
}

/// Joins those columns of the tables `parts` that `columns` returns and that all tables have.
fn join_columns(
    parts: &[Table],
    rows: &[ShardRow],
    columns: fn(&Table) -> &Vec<Column>,
) -> Vec<Column> {
    let Some(first) = parts.first() else { return Vec::new() };
    let mut joined = Vec::new();
    for (index, column) in columns(first).iter().enumerate() {
        let of_parts: Vec<Option<&Column>> =
            parts.iter().map(|part| columns(part).get(index)).collect();
        joined.push(join_column(&column.name, &of_parts, rows));
    }
    joined
}

/// Joins one column of each table of a shard to the column `name`. Rows of a table without the
/// column have empty cells.
fn join_column(name: &str, columns: &[Option<&Column>], rows: &[ShardRow]) -> Column {
    let cells = rows.iter().map(|&ShardRow { part, row, .. }| {
        columns[part].map_or(String::new(), |column| column.cells[row].clone())
    });
    Column::new(name, cells)
}

/// Reads the columns of the CSV file `text`, whose first line has their names.
fn read_columns(text: &[u8]) -> Result<Vec<Column>, csv::Error> {
    let mut csv = csv::Reader::from_reader(text);
    let mut columns: Vec<Column> =
        csv.headers()?.iter().map(|name| Column::new(name, Vec::new())).collect();
    for row in csv.records() {
        for (column, cell) in columns.iter_mut().zip(&row?) {
            column.cells.push(cell.to_owned());
        }
    }
    Ok(columns)
}
